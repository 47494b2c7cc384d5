//! Numbers of a JSON text that are below the range of `f64`, such as `1e-400`: parsers of JSON read them as 0.

use robot_symbolic::is_below_range;

/// A search in a text that is read in pieces.
#[derive(Default)]
pub(super) struct Exponents {
    /// The end of the last piece that may be the beginning of a number, with the byte before it.
    pending: Vec<u8>,
}

impl Exponents {
    /// The longest beginning of a number that is kept.
    const LONGEST: usize = 4096;

    /// The first number below the range of `f64` that ends in the next piece of the text.
    pub(super) fn below_range(&mut self, piece: &[u8]) -> Option<String> {
        let mut text = std::mem::take(&mut self.pending);
        text.extend_from_slice(piece);
        let is_number = |byte: &u8| byte.is_ascii_digit() || b"+-.eE".contains(byte);
        let signs = text.windows(2).enumerate();
        let signs = signs.filter(|(_, pair)| matches!(pair, [b'e' | b'E', b'-']));
        let found = signs.map(|(place, _)| place).find_map(|place| {
            let (before, after) = text.split_at(place);
            let start = before.iter().rposition(|byte| !is_number(byte)).map_or(0, |at| at + 1);
            let end = place + after.iter().position(|byte| !is_number(byte))?;
            let is_value = start.checked_sub(1).is_none_or(|at| b"[,: \t\r\n".contains(&text[at]));
            let number = std::str::from_utf8(&text[start..end]).ok().filter(|_| is_value)?;
            let value = number.parse::<f64>().ok()?;
            is_below_range(number, value).then(|| number.to_owned())
        });
        // The byte before a number shows that it is not part of a string.
        let end = text.iter().rposition(|byte| !is_number(byte)).unwrap_or(0);
        self.pending = text.split_off(end.max(text.len().saturating_sub(Self::LONGEST)));
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_below_the_range_are_found_in_pieces() {
        for (text, expected) in [
            ("[{\"q\":[1e-400,2]}]", Some("1e-400")),
            ("[{\"q\":[0, -2.5E-999 ]}]", Some("-2.5E-999")),
            ("[{\"q\":[0e-400, 1e-300, 5e-324, 1E+5, 0.5]}]", None),
            ("[{\"e-q1e-400\":[1]}]", None),
            ("[{\"1e-400\":[1]}]", None),
        ] {
            for length in 1..=text.len() {
                let mut search = Exponents::default();
                let pieces = text.as_bytes().chunks(length);
                let found = pieces.filter_map(|piece| search.below_range(piece)).next();
                assert_eq!(found.as_deref(), expected, "{text} in pieces of {length}");
            }
        }
    }
}
