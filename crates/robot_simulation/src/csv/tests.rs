use super::*;

/// Pseudo-random numbers: SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }
}

/// Random bits, decimals with few digits, binary fractions, and special values.
fn samples() -> Vec<f64> {
    let mut random = Random(7);
    let mut found = vec![
        0.0,
        -0.0,
        1.0,
        1e-4,
        9.999_999_999_999_999e-5,
        1e-5,
        1e15,
        9.999_999_999_999_998e15,
        1e16,
        5e-324,
        f64::MIN_POSITIVE,
        f64::MAX,
        0.1 + 0.2,
        9_007_199_254_740_993.0,
        1.000_007_629_394_531_2,
    ];
    for round in 0..200_000_i32 {
        let bits = random.next();
        found.push(f64::from_bits(bits));
        let digits = (bits % 10_u64.pow(1 + round.unsigned_abs() % 17)) as f64;
        found.push(digits / 10_f64.powi(round % 20));
        found.push(-((bits >> (11 + round % 50)) as f64) / 2_f64.powi(round % 60));
    }
    found.retain(|number| number.is_finite());
    found
}

#[test]
fn numbers_are_printed_as_the_standard_library_does() {
    let (mut text, mut midway) = (String::new(), 0);
    for number in samples() {
        text.clear();
        push_number(&mut text, number);
        assert_eq!(text, format!("{number:?}"));
        let mut buffer = zmij::Buffer::new();
        let in_range = (1e-4..1e16).contains(&number.abs());
        midway += usize::from(in_range && buffer.format_finite(number) != text);
    }
    assert!(midway > 100, "{midway}");
}

#[test]
fn numbers_are_read_as_the_standard_library_does() {
    let mut found = vec![];
    for number in samples() {
        for text in [format!("{number:?}"), format!("{number:e}"), format!("{number:.4}")] {
            let line = format!("{text},1, {text}\r\n");
            assert!(numbers(&line, &mut found), "{line}");
            let expected = text.parse::<f64>().unwrap();
            let expected = [expected, 1.0, expected].map(f64::to_bits);
            assert_eq!(found.iter().map(|one| one.to_bits()).collect::<Vec<_>>(), expected);
        }
    }
    for text in [
        "",
        "+1",
        "1.",
        ".5",
        ".",
        "-",
        "+-1",
        "1e",
        "1e+",
        "1e5",
        "1E-5",
        "1e400",
        "1e-400",
        "nan",
        "inf",
        "-infinity",
        "1_0",
        "0x10",
        "1 2",
        "１",
        " 7 ",
        "\"7\"",
        "\" 7\"",
        "1d",
        "1f64",
        "\u{a0}3",
        "00012",
        "179769313486231580793728971405301e277",
    ] {
        let expected = cells(text).first().and_then(|cell| number(cell));
        assert_eq!(numbers(text, &mut found), expected.is_some(), "{text:?}");
        for line in [format!("2,{text}"), format!("{text},2")] {
            assert_eq!(numbers(&line, &mut found), expected.is_some(), "{line:?}");
            if let Some(number) = expected {
                assert!(found.contains(&number) && found.len() == 2, "{line:?}: {found:?}");
            }
        }
    }
}

/// A quote without a partner is part of its cell, which is then not a number.
#[test]
fn commas_in_quotes_do_not_separate() {
    for (line, expected) in [
        ("a,b", &["a", "b"][..]),
        ("\"a\", \"b\" ,c\n", &["a", "b", "c"]),
        ("\"0\",\"1,5\"", &["0", "1,5"]),
        ("0,\"1", &["0", "\"1"]),
        ("\"1,2,3", &["\"1,2,3"]),
        ("\"1\"\"", &["1\""]),
        ("1\",2", &["1\",2"]),
        ("\"\"", &[""]),
        ("\"", &["\""]),
        ("", &[""]),
        ("1,", &["1", ""]),
        (",,", &["", "", ""]),
    ] {
        assert_eq!(cells(line), expected, "{line:?}");
        let mut found = vec![];
        let is_right = numbers(line, &mut found);
        let expected: Option<Vec<f64>> = expected.iter().map(|cell| number(cell)).collect();
        assert_eq!(is_right.then_some(found), expected, "{line:?}");
    }
}

/// The lines with their numbers, or the error.
fn lines(bytes: &[u8]) -> Result<Vec<(usize, String)>, String> {
    // The ends of a buffer of three bytes are in all kinds of places in the text.
    let mut lines = Lines::new("a", std::io::BufReader::with_capacity(3, bytes));
    let mut found = vec![];
    while let Some((number, line)) = lines.next_line().map_err(|error| error.to_string())? {
        found.push((number, line.trim_end().to_owned()));
    }
    Ok(found)
}

#[test]
fn lines_are_those_of_the_whole_text() {
    for text in [
        "",
        "a",
        "\n\na\r\n \t\nb",
        "\u{feff}a\n\u{feff}b\n",
        "\u{feff}\n\u{a0}\nä\n",
        "\u{b}\u{c}\nq\r",
    ] {
        let whole = text.strip_prefix('\u{feff}').unwrap_or(text);
        let whole = whole.lines().zip(1..).filter(|(line, _)| !line.trim().is_empty());
        let expected: Vec<_> =
            whole.map(|(line, number)| (number, line.trim_end().to_owned())).collect();
        assert_eq!(lines(text.as_bytes()), Ok(expected), "{text:?}");
    }
}

#[test]
fn what_is_not_text_is_reported_with_its_place_in_the_whole() {
    for bytes in
        [&b"ab\nc\xff\nd"[..], b"ab\nc\xe2\x82\nd", b"ab\nc\xe2\x82", b"\xef\xbb\xbf1\n\x80"]
    {
        let whole = String::from_utf8(bytes.to_vec()).unwrap_err();
        let byte = whole.utf8_error().valid_up_to() + 1;
        let expected = format!("a is not UTF-8 text from byte {byte} on; save it as UTF-8");
        assert_eq!(lines(bytes), Err(expected));
    }
}

#[test]
fn a_line_without_end_is_refused() {
    let mut lines = Lines::new("a", std::io::BufReader::new(std::io::repeat(b'1')));
    assert_eq!(
        lines.next_line().unwrap_err().to_string(),
        "a: line 1 has more than 1 MiB; write one state per line"
    );
}
