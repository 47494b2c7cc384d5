//! The font of equations in HTML: the letters and signs that formulas can contain, taken from STIX Two Math, so that a
//! page looks the same where no math font is installed.
//!
//! `font/math.woff2` is a subset under a name of its own; its license, the SIL Open Font License 1.1, is in the same
//! folder.

use std::sync::LazyLock;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

const FONT: &[u8] = include_bytes!("../../font/math.woff2");

/// The CSS rules that set formulas in the font, which they contain as a `data:` address. A content security policy
/// allows it with `font-src data:`.
pub static RULES: LazyLock<String> = LazyLock::new(|| {
    let font = BASE64_STANDARD.encode(FONT);
    format!(
        "/* STIX Two Math, a subset. Copyright 2001-2021 The STIX Fonts Project Authors, SIL Open Font License 1.1 */\n\
         @font-face {{ font-family: \"Robot Equations Math\"; src: url(data:font/woff2;base64,{font}) format(\"woff2\") }}\n\
         math {{ font-family: \"Robot Equations Math\", math }}\n"
    )
});

#[cfg(test)]
mod tests {
    use robot_model::signs::{Accent, Font, LETTERS};

    use super::*;

    /// The characters in the list from which the font was made.
    fn characters() -> Vec<char> {
        let of = |digits: &str| u32::from_str_radix(digits, 16).unwrap();
        let lines =
            include_str!("../../font/characters.txt").lines().filter(|line| !line.starts_with('#'));
        let ranges = lines.map(|line| {
            let range = line.split(' ').next().unwrap();
            let (first, last) = range.split_once('-').unwrap_or((range, range));
            of(first)..=of(last)
        });
        ranges.flatten().filter_map(char::from_u32).collect()
    }

    #[test]
    fn it_has_what_formulas_may_have() {
        let known = characters();
        let letters = || ('A'..='Z').chain('a'..='z');
        let fonts =
            Font::ALL.iter().flat_map(|font| letters().map(|letter| font.character(letter)));
        let accents =
            Accent::ALL.iter().flat_map(|accent| accent.sign().chars().chain(accent.mark()));
        let all = LETTERS.iter().map(|letter| letter.character).chain(fonts).chain(accents);
        let lacking: String = all
            .chain("0123456789.,+−=/()[]|√".chars())
            .filter(|one| !known.contains(one))
            .collect();
        assert_eq!(lacking, "");
    }

    #[test]
    fn pages_stay_small() {
        assert!(FONT.starts_with(b"wOF2") && FONT.len() < 60_000, "{}", FONT.len());
        assert!(!RULES.contains(['<', '&']));
    }
}
