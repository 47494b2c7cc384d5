//! Messages of the protocol: JSON after a header with its length.

use std::io::{BufRead, Read, Write};

use serde_json::Value;

/// The maximum length of a message, bytes. A document of 10 MB fits even if all of its characters are escaped.
const MAX_BYTES: u64 = 1 << 26;

/// The maximum length of a line of a header, bytes.
const MAX_HEADER: u64 = 1 << 12;

/// Reads a message, which is an object of JSON; `None` at the end of the input.
///
/// # Errors
///
/// The reason why the input is not a message. The server ends then: if the header is wrong, it is not known where the
/// next message begins.
pub(super) fn read(stream: &mut dyn BufRead) -> Result<Option<Value>, String> {
    let Some(length) = header(stream)? else { return Ok(None) };
    let mut bytes = vec![];
    let found = stream.take(length).read_to_end(&mut bytes).map_err(|error| unreadable(&error))?;
    if (found as u64) < length {
        return Err(format!("it ends after {found} of {length} bytes"));
    }
    let message: Value = serde_json::from_slice(&bytes).map_err(|error| {
        let (line, column) = (error.line(), error.column());
        // serde_json reports this limit only in its text.
        let why = match error.to_string().starts_with("recursion limit") {
            true => "its brackets are nested too deeply",
            false => "its content cannot be read as JSON",
        };
        format!("{why}: line {line}, column {column}")
    })?;
    if message.is_object() { Ok(Some(message)) } else { Err("it is not a JSON object".to_owned()) }
}

/// Reads the header up to and including the empty line after it; returns the length of the content.
fn header(stream: &mut dyn BufRead) -> Result<Option<u64>, String> {
    let mut length = None;
    let mut is_first = true;
    loop {
        let mut bytes = vec![];
        (&mut *stream)
            .take(MAX_HEADER)
            .read_until(b'\n', &mut bytes)
            .map_err(|error| unreadable(&error))?;
        if bytes.is_empty() && is_first {
            return Ok(None);
        }
        is_first = false;
        let Some(line) = bytes.strip_suffix(b"\n") else {
            return Err("its header is not complete".to_owned());
        };
        let line = String::from_utf8_lossy(line.strip_suffix(b"\r").unwrap_or(line)).into_owned();
        if line.is_empty() {
            return match length {
                Some(length) => Ok(Some(length)),
                None => Err("its header has no `Content-Length`".to_owned()),
            };
        }
        let expected = "expected `Content-Length: NUMBER`";
        let Some((name, value)) = line.split_once(':') else {
            return Err(format!("its header has a line {line:?}; {expected}"));
        };
        if name.trim().eq_ignore_ascii_case("Content-Length") {
            let number: Option<u64> = value.trim().parse().ok();
            let number = number.ok_or_else(|| format!("its header has {line:?}; {expected}"))?;
            if number > MAX_BYTES {
                return Err(format!("it has {number} bytes; at most {MAX_BYTES} are allowed"));
            }
            length = Some(number);
        }
    }
}

fn unreadable(error: &std::io::Error) -> String {
    format!("it cannot be read: {error}")
}

/// Writes a message with its header.
pub(super) fn write(message: &Value, stream: &mut dyn Write) -> std::io::Result<()> {
    let text = message.to_string();
    write!(stream, "Content-Length: {}\r\n\r\n{text}", text.len())?;
    stream.flush()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn all(mut bytes: &[u8]) -> Vec<Result<Value, String>> {
        let mut found = vec![];
        while let Some(one) = read(&mut bytes).transpose() {
            let is_last = one.is_err();
            found.push(one);
            if is_last {
                break;
            }
        }
        found
    }

    #[test]
    fn messages_are_read_as_they_are_written() {
        let messages = [json!({ "method": "é𝒒\r\n" }), json!({ "id": 1, "params": [1, null] })];
        let mut bytes = vec![];
        for message in &messages {
            write(message, &mut bytes).unwrap();
        }
        assert!(bytes.starts_with(b"Content-Length: 23\r\n\r\n{"), "{bytes:?}");
        assert_eq!(all(&bytes), messages.map(Ok));
        let other = b"content-type: application/vscode-jsonrpc; charset=utf-8\r\ncontent-length:2\r\n\r\n{}";
        assert_eq!(all(other), [Ok(json!({}))]);
        assert_eq!(all(b""), []);
    }

    #[test]
    fn what_is_not_a_message_has_its_reason() {
        for (bytes, reason) in [
            (&b"hello\n"[..], "its header has a line \"hello\"; expected `Content-Length: NUMBER`"),
            (b"hello", "its header is not complete"),
            (b"Content-Length: 2\r\n", "its header is not complete"),
            (b"Content-Length: 2", "its header is not complete"),
            (b"Content-Length: -1\r\n\r\n", "its header has \"Content-Length: -1\""),
            (b"Content-Length: 99999999999999999999\r\n\r\n", "its header has"),
            (b"Content-Length: 9999999999999999\r\n\r\n", "it has 9999999999999999 bytes"),
            (b"Host: here\r\n\r\n{}", "its header has no `Content-Length`"),
            (b"\r\n{}", "its header has no `Content-Length`"),
            (b"Content-Length: 9\r\n\r\n{}", "it ends after 2 of 9 bytes"),
            (b"Content-Length: 2\r\n\r\n{]", "its content cannot be read as JSON: line "),
            (b"Content-Length: 1\r\n\r\n\xff", "its content cannot be read as JSON: line "),
            (b"Content-Length: 0\r\n\r\n", "its content cannot be read as JSON: line "),
            (b"Content-Length: 4\r\n\r\n[{}]", "it is not a JSON object"),
        ] {
            let found = all(bytes);
            let shown = String::from_utf8_lossy(bytes);
            assert!(
                matches!(found.as_slice(), [Err(found)] if found.starts_with(reason)),
                "{shown:?}: {found:?}"
            );
        }
        let deep = "[".repeat(1 << 20);
        let deep = format!("Content-Length: {}\r\n\r\n{deep}", deep.len());
        assert!(
            all(deep.as_bytes())[0].as_ref().unwrap_err().contains("nested too deeply: line 1")
        );
        assert!(all(&[b'a'; 1 << 20])[0].as_ref().unwrap_err().contains("not complete"));
    }

    /// An input that fails.
    struct Broken;

    impl Read for Broken {
        fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
            Err(std::io::Error::other("the cable is cut"))
        }
    }

    #[test]
    fn an_input_that_fails_has_its_reason() {
        let header = &b"Content-Length: 2\r\n\r\n"[..];
        for mut stream in [Box::new(Broken) as Box<dyn Read>, Box::new(header.chain(Broken))] {
            let found = read(&mut std::io::BufReader::new(&mut stream));
            assert_eq!(found, Err("it cannot be read: the cable is cut".to_owned()));
        }
    }
}
