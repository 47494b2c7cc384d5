//! A session with an editor: its documents, and the answers to its messages.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::address::{Addressed, addressed, is_robot_file};
use super::findings::findings;
use super::hover::hover;
use super::lines::Lines;
use crate::NAME;
use crate::commands::check::ExaminationArguments;

/// Codes of errors that the protocol defines.
#[derive(Clone, Copy)]
enum ErrorCode {
    InvalidRequest = -32600,
    MethodNotFound = -32601,
    InvalidParams = -32602,
    ServerNotInitialized = -32002,
}

/// The phase of the session.
#[derive(Clone, Copy, PartialEq)]
enum Phase {
    /// `initialize` has not been received.
    New,
    Running,
    /// `shutdown` has been received; only `exit` may follow.
    ShutDown,
}

/// An open document.
struct Document {
    text: String,
    /// The version that the editor gives.
    version: Value,
    /// Whether the diagnostics of this text have been sent.
    is_checked: bool,
}

/// A session with an editor.
pub(super) struct Session<'a> {
    options: &'a ExaminationArguments,
    phase: Phase,
    /// The open documents by their URIs.
    documents: BTreeMap<String, Document>,
    /// Whether the editor shows places that are related to a diagnostic.
    relates: bool,
}

impl<'a> Session<'a> {
    pub(super) const fn new(options: &'a ExaminationArguments) -> Session<'a> {
        Session { options, phase: Phase::New, documents: BTreeMap::new(), relates: false }
    }

    /// Whether the editor has sent `shutdown`, as it must before it sends `exit`.
    pub(super) fn is_shut_down(&self) -> bool {
        self.phase == Phase::ShutDown
    }

    /// Receives a message; returns the answer, if there is one.
    ///
    /// # Errors
    ///
    /// The reason why a message without an answer cannot be used; the session continues.
    pub(super) fn receive(&mut self, message: Value) -> Result<Option<Value>, String> {
        let method = message.get("method").and_then(Value::as_str);
        match (message.get("id"), method) {
            (Some(id), Some(method)) => {
                let nothing = Value::Null;
                let params = message.get("params").unwrap_or(&nothing);
                let answer = match self.request(method, params) {
                    Ok(result) => json!({ "jsonrpc": "2.0", "id": id, "result": result }),
                    Err((code, reason)) => {
                        let error = json!({ "code": code as i32, "message": reason });
                        json!({ "jsonrpc": "2.0", "id": id, "error": error })
                    }
                };
                Ok(Some(answer))
            }
            (None, Some(method)) if self.phase == Phase::Running => {
                let method = method.to_owned();
                self.notification(&method, message)
                    .map_err(|reason| format!("`{method}`: {reason}"))
            }
            // Notifications before the start and after the end are dropped, as the protocol says.
            (None, Some(_)) => Ok(None),
            // An answer of the editor; this server sends no requests.
            (Some(_), None) if message.get("result").or(message.get("error")).is_some() => Ok(None),
            _ => Err("a message has no `method`".to_owned()),
        }
    }

    fn request(&mut self, method: &str, params: &Value) -> Result<Value, (ErrorCode, String)> {
        match (method, self.phase) {
            ("initialize", Phase::New) => {
                self.phase = Phase::Running;
                let relates = params
                    .pointer("/capabilities/textDocument/publishDiagnostics/relatedInformation");
                self.relates = relates.and_then(Value::as_bool).unwrap_or_default();
                Ok(capabilities())
            }
            (_, Phase::New) => {
                Err((ErrorCode::ServerNotInitialized, "`initialize` comes first".to_owned()))
            }
            ("initialize", _) => {
                Err((ErrorCode::InvalidRequest, "`initialize` comes only once".to_owned()))
            }
            (_, Phase::ShutDown) => {
                let reason = "only `exit` may follow `shutdown`";
                Err((ErrorCode::InvalidRequest, reason.to_owned()))
            }
            ("shutdown", Phase::Running) => {
                self.phase = Phase::ShutDown;
                Ok(Value::Null)
            }
            ("textDocument/hover", Phase::Running) => {
                let uri = params.pointer("/textDocument/uri").and_then(Value::as_str);
                let position = params.get("position");
                let (Some(uri), Some(position)) = (uri, position) else {
                    let reason = "it has no `textDocument.uri` or no `position`";
                    return Err((ErrorCode::InvalidParams, reason.to_owned()));
                };
                let document = self.documents.get(uri);
                Ok(document.map_or(Value::Null, |document| hover(&document.text, position)))
            }
            (_, Phase::Running) => {
                Err((ErrorCode::MethodNotFound, format!("there is no method `{method}`")))
            }
        }
    }

    fn notification(&mut self, method: &str, mut message: Value) -> Result<Option<Value>, String> {
        let of_documents = ["didOpen", "didChange", "didSave", "didClose"];
        let event = method.strip_prefix("textDocument/").unwrap_or_default();
        if !of_documents.contains(&event) {
            return Ok(None);
        }
        let document = message.pointer("/params/textDocument");
        let uri = document.and_then(|document| document.get("uri")).and_then(Value::as_str);
        let uri = uri.ok_or("it names no document (`params.textDocument.uri`)")?.to_owned();
        let version = document.and_then(|document| document.get("version")).cloned();
        let version = version.unwrap_or_default();
        match event {
            "didOpen" => {
                let text = message.pointer_mut("/params/textDocument/text").map(Value::take);
                let Some(Value::String(text)) = text else {
                    return Err("it has no text (`params.textDocument.text`)".to_owned());
                };
                let left_alone = (!is_robot_file(&uri, &text)).then(|| left_alone(&uri));
                self.documents.insert(uri, Document { text, version, is_checked: false });
                return Ok(left_alone);
            }
            "didClose" => {
                let closed = self.documents.remove(&uri);
                closed.ok_or_else(|| not_open(&uri))?;
                // The diagnostics that were shown refer to a text that may not have been saved.
                return Ok(Some(published(&uri, &Value::Null, &[])));
            }
            _ => {
                let document = self.documents.get_mut(&uri).ok_or_else(|| not_open(&uri))?;
                if event == "didChange" {
                    document.text = changed(&mut message)?;
                    document.version = version;
                }
                // After a save, the plan beside the file may be another.
                document.is_checked = false;
            }
        }
        Ok(None)
    }

    /// Checks one of the documents that have changed; returns the message with its diagnostics, or `None` if all
    /// documents are checked.
    pub(super) fn publication(&mut self) -> Option<Value> {
        let (uri, document) =
            self.documents.iter_mut().find(|(_, document)| !document.is_checked)?;
        document.is_checked = true;
        let found = if is_robot_file(uri, &document.text) {
            let examination = match addressed(uri, &document.text) {
                Addressed::File(file) => self.options.of_file(&file),
                Addressed::Text(source) => self.options.of_source(&source),
            };
            findings(&examination, &Lines::new(&document.text), uri, self.relates)
        } else {
            vec![]
        };
        Some(published(uri, &document.version, &found))
    }
}

/// The capabilities of the server.
fn capabilities() -> Value {
    // `change` 1: each change has the whole text.
    let sync = json!({ "openClose": true, "change": 1, "save": true });
    json!({
        "capabilities": { "positionEncoding": "utf-16", "textDocumentSync": sync, "hoverProvider": true },
        "serverInfo": { "name": NAME, "version": env!("CARGO_PKG_VERSION") },
    })
}

fn published(uri: &str, version: &Value, diagnostics: &[Value]) -> Value {
    let mut params = json!({ "uri": uri, "diagnostics": diagnostics });
    if version.is_number() {
        params["version"] = version.clone();
    }
    let method = "textDocument/publishDiagnostics";
    json!({ "jsonrpc": "2.0", "method": method, "params": params })
}

/// A line for the log of the editor about a document that is not a robot file.
fn left_alone(uri: &str) -> Value {
    const INFO: u8 = 3;
    let text = format!(
        "{uri} is not checked: it has neither `format = 1` nor a table `[robot]` or `[[link]]`, \
         nor an element `<robot>`"
    );
    let params = json!({ "type": INFO, "message": text });
    json!({ "jsonrpc": "2.0", "method": "window/logMessage", "params": params })
}

fn not_open(uri: &str) -> String {
    format!("the document {uri} is not open")
}

/// The text after the last of the changes in a message.
fn changed(message: &mut Value) -> Result<String, String> {
    let changes = message.pointer_mut("/params/contentChanges").and_then(Value::as_array_mut);
    let last = changes.and_then(|changes| changes.last_mut());
    let last = last.ok_or("it has no changes (`params.contentChanges`)")?;
    if last.get("range").is_some_and(|range| !range.is_null()) {
        return Err("a change has a range; this server accepts only whole documents".to_owned());
    }
    match last.get_mut("text").map(Value::take) {
        Some(Value::String(text)) => Ok(text),
        _ => Err("a change has no text".to_owned()),
    }
}
