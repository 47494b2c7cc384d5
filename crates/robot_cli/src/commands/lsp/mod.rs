//! `lsp`: errors, likely mistakes and the meaning of keys in an editor, by the Language Server Protocol.

mod address;
mod findings;
mod hover;
mod lines;
mod session;
mod wire;

use std::io::{BufReader, Read};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

use clap::Args;
use serde_json::Value;

use super::check::ExaminationArguments;
use crate::Terminal;
use crate::failure::Failure;
use session::Session;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic lsp --allow R0607

An editor starts this command and speaks the Language Server Protocol with it over standard input and output. It
then shows what `check` reports while a file is edited, saved or not, for robot files in TOML and URDF, and the
meaning of keys and parameters in TOML. Files of other programs are left alone. The page about robot files
(docs/robot-file.md) has settings for editors.

Exit codes: 0 after `shutdown` and `exit`; 1 after `exit` alone, at the end of the input, or after input that
is not a protocol message; 2 if the command line is wrong.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    examination: ExaminationArguments,
    /// Use standard input and output, as always: editors may add this option
    #[arg(long)]
    stdio: bool,
}

/// A message of the editor, or the reason why there are no more.
type Received = Result<Value, String>;

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        self.examination.check()?;
        if terminal.screen.is_some() {
            writeln!(
                terminal.errors,
                "note: this command speaks with an editor, which starts it; Ctrl-C ends it"
            )?;
        }
        let mut nothing = std::io::empty();
        let (input, mut terminal) = terminal.without_input(&mut nothing);
        let (sender, receiver) = channel();
        std::thread::scope(|scope| {
            scope.spawn(move || read_all(input, &sender));
            serve(&receiver, &mut Session::new(&self.examination), &mut terminal)
        })
    }
}

/// Reads messages up to the last one. Messages are read while documents are checked, so that a text that has changed
/// again is not checked.
fn read_all(input: &mut dyn Read, sender: &Sender<Received>) {
    let mut input = BufReader::new(input);
    while let Some(message) = wire::read(&mut input).transpose() {
        let is_last = message.as_ref().map_or(true, is_exit);
        if sender.send(message).is_err() || is_last {
            return;
        }
    }
}

fn is_exit(message: &Value) -> bool {
    message.get("method").and_then(Value::as_str) == Some("exit")
}

/// Answers messages until the last one; checks documents when there are no messages.
fn serve(
    receiver: &Receiver<Received>,
    session: &mut Session<'_>,
    terminal: &mut Terminal<'_>,
) -> Result<(), Failure> {
    loop {
        let next = match receiver.try_recv() {
            Ok(message) => Some(message),
            Err(TryRecvError::Disconnected) => None,
            Err(TryRecvError::Empty) => match session.publication() {
                Some(publication) => {
                    wire::write(&publication, terminal.output)?;
                    continue;
                }
                None => receiver.recv().ok(),
            },
        };
        let Some(message) = next else {
            return Err(Failure::input("the input ended without the message `exit`"));
        };
        let message = message.map_err(|reason| {
            Failure::input(format!("the input is not a protocol message: {reason}"))
        })?;
        if is_exit(&message) {
            let reason = "the editor sent `exit` without `shutdown`";
            return if session.is_shut_down() { Ok(()) } else { Err(Failure::input(reason)) };
        }
        match session.receive(message) {
            Ok(Some(answer)) => wire::write(&answer, terminal.output)?,
            Ok(None) => {}
            Err(reason) => writeln!(terminal.errors, "warning: message ignored: {reason}")?,
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use serde_json::json;

    use super::*;

    #[derive(Parser)]
    struct Command {
        #[command(flatten)]
        arguments: Arguments,
    }

    /// The messages that are written if all messages have arrived before the first is handled.
    fn written(messages: &[Value]) -> Vec<Value> {
        let (sender, receiver) = channel();
        messages.iter().for_each(|message| sender.send(Ok(message.clone())).unwrap());
        drop(sender);
        let arguments = Command::parse_from(["lsp"]).arguments;
        let (mut output, mut errors) = (vec![], vec![]);
        let mut terminal = Terminal {
            input: &mut std::io::empty(),
            output: &mut output,
            errors: &mut errors,
            colors: false,
            progress: false,
            screen: None,
        };
        let mut session = Session::new(&arguments.examination);
        let _ = serve(&receiver, &mut session, &mut terminal);
        while let Some(publication) = session.publication() {
            wire::write(&publication, &mut output).unwrap();
        }
        let mut output = output.as_slice();
        std::iter::from_fn(|| wire::read(&mut output).unwrap()).collect()
    }

    #[test]
    fn only_the_last_of_rapid_changes_is_checked() {
        let message = |method: &str, params: Value| json!({ "method": method, "params": params });
        let document = |version| json!({ "uri": "a.toml", "version": version, "text": "[robot]" });
        let mut messages = vec![json!({ "id": 1, "method": "initialize" })];
        messages.push(message("textDocument/didOpen", json!({ "textDocument": document(1) })));
        for version in 2..50 {
            let change = json!({ "text": format!("format = {version}") });
            let params = json!({ "textDocument": document(version), "contentChanges": [change] });
            messages.push(message("textDocument/didChange", params));
        }
        let written = written(&messages);
        assert_eq!(written.len(), 2, "{written:?}");
        assert_eq!(written[1]["params"]["version"], 49);
        assert_eq!(written[1]["params"]["diagnostics"][0]["code"], "R0107");
    }
}
