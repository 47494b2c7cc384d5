//! `lsp`, spoken with as an editor does.

use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use serde_json::{Value, json};

use crate::{folder, robot, run, run_with};

const ARM: &str = "format = 1
[robot]
name = \"arm\"
description = \"Ärm 🦾\"
[[link]]
name = \"1\"
joint = { type = \"revolute\", axis = \"z\" }
mass = 2
center_of_mass = [0.1, 0, 0]
inertia = { xx = 0.01, yy = 0.02, zz = 0.02 }
";

/// An editor that has started the command.
struct Editor {
    server: Child,
    input: Option<ChildStdin>,
    messages: Receiver<Value>,
    /// The number of the last request.
    request: u64,
}

/// Reads a message; `None` at the end. Nothing but messages may be written.
fn message(output: &mut impl BufRead) -> Option<Value> {
    let mut header = String::new();
    if output.read_line(&mut header).unwrap() == 0 {
        return None;
    }
    let length = header.strip_prefix("Content-Length: ").unwrap().trim_end().parse().unwrap();
    let mut empty = String::new();
    output.read_line(&mut empty).unwrap();
    assert_eq!(empty, "\r\n");
    let mut bytes = vec![0; length];
    output.read_exact(&mut bytes).unwrap();
    Some(serde_json::from_slice(&bytes).unwrap())
}

fn framed(message: &Value) -> Vec<u8> {
    let text = message.to_string();
    format!("Content-Length: {}\r\n\r\n{text}", text.len()).into_bytes()
}

impl Editor {
    /// Starts the command, without `initialize`.
    fn start(arguments: &[&str]) -> Editor {
        let mut server = Command::new(env!("CARGO_BIN_EXE_robot-symbolic"))
            .arg("lsp")
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let (sender, messages) = channel();
        let mut output = BufReader::new(server.stdout.take().unwrap());
        std::thread::spawn(move || {
            while let Some(message) = message(&mut output) {
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        let input = server.stdin.take();
        Editor { server, input, messages, request: 0 }
    }

    /// Starts the command and a session.
    fn open(arguments: &[&str]) -> Editor {
        let mut editor = Editor::start(arguments);
        let shows = json!({ "relatedInformation": true });
        let capabilities = json!({ "textDocument": { "publishDiagnostics": shows } });
        let answer = editor.ask("initialize", &json!({ "capabilities": capabilities }));
        assert_eq!(answer["result"]["capabilities"]["positionEncoding"], "utf-16");
        editor.tell("initialized", &json!({}));
        editor
    }

    fn send(&mut self, bytes: &[u8]) {
        let input = self.input.as_mut().unwrap();
        input.write_all(bytes).unwrap();
        input.flush().unwrap();
    }

    fn tell(&mut self, method: &str, params: &Value) {
        self.send(&framed(&json!({ "jsonrpc": "2.0", "method": method, "params": params })));
    }

    /// Sends a request; returns the answer.
    fn ask(&mut self, method: &str, params: &Value) -> Value {
        self.request += 1;
        let request = self.request;
        let message =
            json!({ "jsonrpc": "2.0", "id": request, "method": method, "params": params });
        self.send(&framed(&message));
        let answer = self.next();
        assert_eq!((&answer["jsonrpc"], &answer["id"]), (&json!("2.0"), &json!(request)));
        answer
    }

    fn next(&self) -> Value {
        self.messages.recv_timeout(Duration::from_secs(60)).unwrap()
    }

    /// The diagnostics that come next, which must be those of a document.
    fn diagnostics(&self, uri: &str) -> Vec<Value> {
        let message = self.next();
        assert_eq!(message["method"], "textDocument/publishDiagnostics", "{message}");
        assert_eq!(message["params"]["uri"], uri);
        message["params"]["diagnostics"].as_array().unwrap().clone()
    }

    fn opened(&mut self, uri: &str, text: &str) -> Vec<Value> {
        let document = json!({ "uri": uri, "languageId": "toml", "version": 1, "text": text });
        self.tell("textDocument/didOpen", &json!({ "textDocument": document }));
        self.diagnostics(uri)
    }

    fn change(&mut self, uri: &str, version: u64, text: &str) {
        let document = json!({ "uri": uri, "version": version });
        let changes = json!([{ "text": text }]);
        let params = json!({ "textDocument": document, "contentChanges": changes });
        self.tell("textDocument/didChange", &params);
    }

    /// Closes standard input; returns the exit code, messages that were not received and standard error.
    fn end(mut self) -> (Option<i32>, Vec<Value>, String) {
        drop(self.input.take());
        let mut errors = String::new();
        self.server.stderr.take().unwrap().read_to_string(&mut errors).unwrap();
        let code = self.server.wait().unwrap().code();
        (code, self.messages.iter().collect(), errors)
    }

    /// Ends the session as the protocol says.
    fn close(mut self) {
        assert_eq!(self.ask("shutdown", &Value::Null)["result"], Value::Null);
        self.tell("exit", &Value::Null);
        assert_eq!(self.end(), (Some(0), vec![], String::new()));
    }
}

/// The range of a protocol from line, character to line, character.
fn range([line, character, end_line, end_character]: [usize; 4]) -> Value {
    json!({
        "start": { "line": line, "character": character },
        "end": { "line": end_line, "character": end_character },
    })
}

#[test]
fn diagnostics_follow_the_text_in_the_editor() {
    let mut editor = Editor::open(&[]);
    let uri = "file:///none/my%20robots/%C3%A4rm.toml";
    // The file does not exist: only the text of the editor counts.
    let found = editor.opened(uri, &format!("{ARM}# 🦾\nmas = 1\n"));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0]["range"], range([11, 0, 11, 3]));
    let named = ["code", "severity", "source"].map(|key| found[0][key].clone());
    assert_eq!(named, [json!("R0101"), json!(1), json!("robot-symbolic")]);
    let message = found[0]["message"].as_str().unwrap();
    assert!(
        message.starts_with("`mas` has no meaning here") || message.contains("`mas`"),
        "{message}"
    );
    assert!(message.contains("\nhelp: "), "{message}");
    assert_eq!(message.lines().nth(1), Some("did you mean `massless`?"), "{message}");
    editor.change(uri, 2, ARM);
    assert_eq!(editor.diagnostics(uri), Vec::<Value>::new());
    // Characters outside the basic plane are two code units.
    editor.change(
        uri,
        3,
        &ARM.replace(
            "[robot]\nname = \"arm\"\ndescription = \"Ärm 🦾\"",
            "robot = { description = \"Ärm 🦾\", frob = \"𝒒\", name = \"arm\" }",
        ),
    );
    let found = editor.diagnostics(uri);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0]["range"], range([1, 34, 1, 38]));
    let document = json!({ "uri": uri });
    editor.tell("textDocument/didClose", &json!({ "textDocument": document }));
    assert_eq!(editor.diagnostics(uri), Vec::<Value>::new());
    editor.close();
}

#[test]
fn related_places_are_shown_as_the_editor_can() {
    let text = ARM.replace("0.01, yy = 0.02, zz = 0.02", "10000, yy = 20000, zz = 20000");
    let uri = "untitled:Untitled-1";
    let mut editor = Editor::open(&["--stdio"]);
    let found = editor.opened(uri, &text);
    assert_eq!(
        (found.len(), &found[0]["code"], &found[0]["severity"]),
        (1, &json!("R0605"), &json!(2))
    );
    let location = json!({ "uri": uri, "range": range([7, 7, 7, 8]) });
    let related = json!([{ "location": location, "message": "2 kg" }]);
    assert_eq!(found[0]["relatedInformation"], related);
    editor.close();
    let mut editor = Editor::start(&[]);
    editor.ask("initialize", &json!({ "capabilities": {} }));
    let found = editor.opened(uri, &text);
    assert_eq!(found[0].get("relatedInformation"), None);
    assert!(found[0]["message"].as_str().unwrap().contains("\nline 8: 2 kg\n"), "{found:?}");
    editor.close();
    let mut editor = Editor::open(&["--allow", "R0605"]);
    assert_eq!(editor.opened(uri, &text), Vec::<Value>::new());
    let unused = ARM.replace("[[link]]", "[parameters]\nl = 1\n[[link]]");
    editor.change(uri, 2, &unused);
    let found = editor.diagnostics(uri);
    assert_eq!((&found[0]["code"], &found[0]["tags"]), (&json!("R0601"), &json!([1])));
    editor.close();
}

/// The place of a line and column that `check` counts, in UTF-16.
fn place(text: &str, line: &Value, column: &Value) -> Value {
    let [line, column] = [line, column].map(|one| usize::try_from(one.as_u64().unwrap()).unwrap());
    let shown = text.split('\n').nth(line - 1).unwrap_or_default();
    let units: usize = shown.chars().take(column - 1).map(char::len_utf16).sum();
    json!({ "line": line - 1, "character": units })
}

fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let is_robot = |path: &PathBuf| {
        path.extension().is_some_and(|end| end == "toml" || end == "urdf" || end == "xacro")
    };
    let mut files: Vec<PathBuf> = entries.filter(is_robot).collect();
    files.sort();
    files
}

/// Code, place, severity and message of a diagnostic, and its related places.
type Shown = (Value, Value, Value, String, Vec<(Value, Value)>);

/// What `check` reports about a file, as the protocol has it.
fn checked(path: &str, text: &str) -> Vec<Shown> {
    let outcome = run(&["check", path, "--format", "json"]);
    let document: Value = serde_json::from_str(&outcome.output).unwrap();
    let range = |one: &Value| {
        json!({
            "start": place(text, &one["line"], &one["column"]),
            "end": place(text, &one["end_line"], &one["end_column"]),
        })
    };
    let diagnostics = document["diagnostics"].as_array().unwrap().iter();
    let shown = diagnostics.map(|one| {
        let severity = match one["severity"].as_str().unwrap() {
            "error" => json!(1),
            "warning" => json!(2),
            _ => json!(3),
        };
        let message = one["message"].as_str().unwrap().to_owned();
        let related = one["related"].as_array().unwrap().iter();
        // The protocol demands a text for each place.
        let related = related.map(|place| match place["message"].as_str().unwrap() {
            "" => (range(place), json!(message)),
            text => (range(place), json!(text)),
        });
        let related = related.collect();
        (one["code"].clone(), range(one), severity, message, related)
    });
    shown.collect()
}

/// The same of diagnostics from the server.
fn received(diagnostics: &[Value]) -> Vec<Shown> {
    let shown = diagnostics.iter().map(|one| {
        let message = one["message"].as_str().unwrap().lines().next().unwrap().to_owned();
        let related = one["relatedInformation"].as_array().into_iter().flatten();
        let related = related.map(|one| (one["location"]["range"].clone(), one["message"].clone()));
        let [code, range, severity] = ["code", "range", "severity"].map(|key| one[key].clone());
        (code, range, severity, message, related.collect())
    });
    shown.collect()
}

#[test]
fn every_broken_file_has_the_diagnostics_of_check() {
    let mut editor = Editor::open(&[]);
    let (mut compared, mut codes, mut others) = (0, std::collections::BTreeSet::new(), vec![]);
    let folders = ["crates/robot_model/tests/broken", "robots", "tests/fixtures/limbs"];
    for path in folders.iter().flat_map(|folder| files(folder)) {
        let shown = path.to_str().unwrap();
        let Ok(text) = std::fs::read_to_string(&path) else {
            others.push(path.file_name().unwrap().to_owned());
            continue;
        };
        let uri = format!("file://{shown}");
        let document = json!({ "uri": uri, "version": 1, "text": text });
        editor.tell("textDocument/didOpen", &json!({ "textDocument": document }));
        let mut message = editor.next();
        if message["method"] == "window/logMessage" {
            assert!(message["params"]["message"].as_str().unwrap().contains("is not checked"));
            others.push(path.file_name().unwrap().to_owned());
            message = editor.next();
            assert_eq!(message["params"]["diagnostics"], json!([]));
            continue;
        }
        let found = received(message["params"]["diagnostics"].as_array().unwrap());
        assert_eq!(found, checked(shown, &text), "{shown}");
        codes.extend(found.into_iter().map(|one| one.0.to_string()));
        compared += 1;
    }
    assert!(compared > 150 && codes.len() > 50, "{compared} files, {} codes", codes.len());
    // Nothing in a TOML file that is empty or contains JSON, XML or a table of numbers says that it will be a robot file.
    let expected =
        ["empty_file.toml", "syntax_json.toml", "syntax_xml.toml", "table_of_numbers.toml"];
    assert_eq!(others, expected);
    editor.close();
}

#[test]
fn keys_and_parameters_are_explained() {
    let mut editor = Editor::open(&[]);
    let uri = "file:///arm.toml";
    let text = ARM
        .replace(
            "[[link]]",
            "[parameters]\nm1 = { value = 2.5, unit = \"kg\", doc = \"🦾\" }\n[[link]]",
        )
        .replace("mass = 2", "mass = \"m1\" # 🦾");
    editor.opened(uri, &text);
    let mut ask = |line: u64, character: u64| {
        let position = json!({ "line": line, "character": character });
        let params = json!({ "textDocument": { "uri": uri }, "position": position });
        editor.ask("textDocument/hover", &params)["result"].clone()
    };
    let found = ask(9, 2);
    assert_eq!(
        found["contents"]["value"],
        "mass: a number or an expression, optional\nPositive, kg."
    );
    assert_eq!(
        (&found["contents"]["kind"], &found["range"]),
        (&json!("plaintext"), &range([9, 0, 9, 4]))
    );
    let found = ask(9, 9);
    assert_eq!(found["contents"]["value"], "m1 = 2.5 kg\n🦾");
    assert_eq!(found["range"], range([9, 8, 9, 10]));
    let found = ask(8, 10);
    assert!(
        found["contents"]["value"].as_str().unwrap().starts_with("type: \"revolute\" or "),
        "{found}"
    );
    assert_eq!(ask(9, 16), Value::Null);
    assert_eq!(ask(999, 0), Value::Null);
    let params = json!({ "textDocument": { "uri": "file:///other" }, "position": {} });
    assert_eq!(editor.ask("textDocument/hover", &params)["result"], Value::Null);
    assert_eq!(editor.ask("textDocument/hover", &json!(null))["error"]["code"], -32602);
    editor.close();
}

#[test]
fn a_stale_plan_beside_the_file_is_reported() {
    let folder = folder("lsp plan é");
    let path = folder.join("arm 1.toml");
    std::fs::copy(robot("planar_2r"), &path).unwrap();
    std::fs::copy(robot("planar_2r").replace(".toml", ".plan"), folder.join("arm 1.plan")).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let uri =
        format!("file://{}", path.to_str().unwrap().replace(' ', "%20").replace('é', "%C3%A9"));
    let mut editor = Editor::open(&[]);
    assert_eq!(editor.opened(&uri, &text), Vec::<Value>::new());
    // Not saved, and yet the plan is that of another robot.
    editor.change(&uri, 2, &text.replacen("axis = \"z\"", "axis = \"y\"", 1));
    let found = editor.diagnostics(&uri);
    assert!(found.iter().any(|one| one["code"] == "R0803"), "{found:?}");
    std::fs::remove_file(folder.join("arm 1.plan")).unwrap();
    editor.tell("textDocument/didSave", &json!({ "textDocument": { "uri": uri } }));
    let found = editor.diagnostics(&uri);
    assert!(found.iter().all(|one| one["code"] != "R0803"), "{found:?}");
    editor.close();
}

#[test]
fn a_session_begins_and_ends_by_the_protocol() {
    let mut editor = Editor::start(&[]);
    assert_eq!(editor.ask("textDocument/hover", &json!({}))["error"]["code"], -32002);
    editor.ask("initialize", &json!({ "capabilities": {} }));
    assert_eq!(editor.ask("initialize", &json!({}))["error"]["code"], -32600);
    assert_eq!(editor.ask("textDocument/rename", &json!({}))["error"]["code"], -32601);
    editor.tell("$/setTrace", &json!({ "value": "off" }));
    editor.send(&framed(&json!({ "id": 7, "result": null })));
    editor.ask("shutdown", &Value::Null);
    assert_eq!(editor.ask("shutdown", &Value::Null)["error"]["code"], -32600);
    editor.tell("exit", &Value::Null);
    assert_eq!(editor.end(), (Some(0), vec![], String::new()));

    let mut editor = Editor::open(&[]);
    editor.tell("exit", &Value::Null);
    let (code, _, errors) = editor.end();
    assert_eq!(
        (code, errors.as_str()),
        (Some(1), "error: the editor sent `exit` without `shutdown`\n")
    );
    let (code, _, errors) = Editor::open(&[]).end();
    assert_eq!(code, Some(1));
    assert_eq!(errors, "error: the input ended without the message `exit`\n");
    assert_eq!(run(&["lsp", "--allow", "R9999"]).code, 2);
}

#[test]
fn wrong_messages_are_told_on_standard_error_alone() {
    for bytes in [
        &b"hello\r\n\r\n"[..],
        b"Content-Length: 9\r\n\r\n{\"a\":",
        b"Content-Length: 99999999999\r\n\r\n",
    ] {
        let outcome = run_with(&["lsp"], bytes);
        assert_eq!((outcome.code, outcome.output.as_str()), (1, ""));
        let reason = "error: the input is not a protocol message: ";
        assert!(outcome.errors.starts_with(reason), "{}", outcome.errors);
    }
    // A message that cannot be used does not end the session.
    let mut editor = Editor::open(&[]);
    let uri = "file:///arm.toml";
    let document = json!({ "uri": uri });
    let ranged = json!([{ "range": range([0; 4]), "text": "a" }]);
    editor.tell("textDocument/didOpen", &json!(null));
    editor.tell("textDocument/didOpen", &json!({ "textDocument": document }));
    editor.change(uri, 2, ARM);
    assert_eq!(editor.opened(uri, ARM), Vec::<Value>::new());
    editor.tell(
        "textDocument/didChange",
        &json!({ "textDocument": document, "contentChanges": ranged }),
    );
    editor
        .tell("textDocument/didChange", &json!({ "textDocument": document, "contentChanges": [] }));
    editor.tell("textDocument/didClose", &json!({ "textDocument": { "uri": 5 } }));
    editor.send(&framed(&json!({})));
    editor.send(&framed(&json!({ "id": 1, "method": 5 })));
    editor.ask("shutdown", &Value::Null);
    editor.tell("exit", &Value::Null);
    let (code, left, errors) = editor.end();
    assert_eq!((code, left), (Some(0), vec![]));
    let lines: Vec<&str> = errors.lines().collect();
    assert_eq!(lines.len(), 8, "{errors}");
    assert!(lines.iter().all(|line| line.starts_with("warning: message ignored: ")), "{errors}");
}

#[test]
fn large_and_hostile_texts_are_answered() {
    let mut editor = Editor::open(&[]);
    let uri = "file:///arm.toml";
    let large = format!("{ARM}# {}\n", "🦾\\\"".repeat(10_000_000 / 6));
    assert_eq!(editor.opened(uri, &large)[0]["code"], "R0001");
    let keys: String = (0..5000).map(|index| format!("k{index} = 1, ")).collect();
    let many = ARM.replace("xx = 0.01", &format!("{keys} xx = 0.01"));
    editor.change(uri, 2, &many);
    let found = editor.diagnostics(uri);
    assert_eq!(found.len(), 1001);
    let rest = found[1000]["message"].as_str().unwrap();
    assert_eq!(rest, "4000 more errors, warnings and notes are not shown");
    let texts = [
        "\0",
        "\r",
        "\u{feff}",
        "[robot]\r\r",
        "format = 1\r",
        "[[link]]\nname = \"\u{202e}",
        "[robot",
    ];
    let deep = format!("format = 1\na = {}", "[".repeat(100_000));
    for (version, text) in texts.into_iter().chain([deep.as_str()]).enumerate() {
        editor.change(uri, version as u64, text);
        editor.diagnostics(uri);
    }
    editor.close();
}
