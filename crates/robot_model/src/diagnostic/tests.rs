use super::*;

fn source(text: &str) -> Source {
    Source { name: "arm.toml".to_owned(), text: text.to_owned() }
}

fn shown(text: &str, span: Span) -> String {
    let diagnostic = Diagnostic::error(code::NUMBER, "wrong").at(&span, "here");
    render(&source(text), &diagnostic, Style::Plain)
}

#[test]
fn the_offending_text_is_underlined_in_its_line() {
    let text = "a = 1\nmass = nan # kg\nb = 2\n";
    let expected = "\
error[R0301]: wrong
 --> arm.toml:2:8
  |
2 | mass = nan # kg
  |        ^^^ here";
    assert_eq!(shown(text, 13..16), expected);
}

#[test]
fn tabs_line_ends_and_wide_characters_keep_their_columns() {
    let text = "\ta = \"é中\"\r\n\tmass\t= nan\r\n";
    let start = text.find("nan").unwrap();
    let rendered = shown(text, start..start + 3);
    assert!(rendered.contains("arm.toml:2:9\n"), "{rendered}");
    let lines: Vec<&str> = rendered.lines().collect();
    let column = |line: &str, text: &str| line.find(text).unwrap();
    assert_eq!(column(lines[3], "nan"), column(lines[4], "^^^"), "{rendered}");
    assert!(!rendered.contains(['\r', '␍']), "{rendered:?}");
}

#[test]
fn a_long_line_is_cut_around_the_place() {
    let text = format!("a = \"{}\" # {}\n", "x".repeat(500_000), "y".repeat(500_000));
    let rendered = shown(&text, 250_000..250_003);
    assert!(rendered.len() < 1000, "{}", rendered.len());
    assert!(rendered.contains("arm.toml:1:250001\n"), "{rendered}");
    assert!(rendered.contains("^^^ here"), "{rendered}");
}

#[test]
fn places_out_of_the_text_are_brought_in() {
    for span in [0..0, 2..2, 3..3, 7..9, 1..900, 900..900] {
        assert!(shown("aé\n", span.clone()).contains("arm.toml:"), "{span:?}");
    }
    assert!(shown("", 0..0).contains("arm.toml:1:1"));
}

#[test]
fn diagnostics_come_in_the_order_of_their_places() {
    let at = |start: usize| Diagnostic::error(code::NAME, "n").at(&(start..start + 1), "");
    let whole = Diagnostic::warning(code::SYNTAX, "whole");
    let list = vec![at(3), at(1), whole.clone(), at(2), at(1)];
    let found = Diagnostics::new(source("abcdef"), list);
    let order: Vec<_> = found.iter().cloned().collect();
    assert_eq!(order, [whole, at(1), at(2), at(3)]);
    assert!(found.has_errors());
    assert!(found.to_string().ends_with("\n\narm.toml: 3 errors, 1 warning\n"));
}

#[test]
fn many_diagnostics_are_counted() {
    let text = "x\n".repeat(500);
    // No two of these are of the same kind.
    let list = (0..500).map(|line| {
        Diagnostic::error(code::NAME, "n".repeat(line + 1)).at(&(2 * line..2 * line + 1), "")
    });
    let rendered = Diagnostics::new(source(&text), list.collect()).to_string();
    assert_eq!(rendered.matches("error[").count(), 40);
    assert!(rendered.ends_with("arm.toml: 500 errors (460 more not shown)\n"));
}

#[test]
fn quotes_show_what_cannot_be_seen() {
    assert_eq!(quote("l_1 é"), "l_1 é");
    assert_eq!(quote("a\u{202e}\n\u{0}"), "a\\u{202e}\\u{a}\\u{0}");
    let long = quote(&"x".repeat(1000));
    assert_eq!(long.chars().count(), 51);
}

#[test]
fn positions_are_counted_from_one() {
    let source = source("ab\r\né\tx");
    assert_eq!(source.position(0), (1, 1));
    assert_eq!(source.position(4), (2, 1));
    assert_eq!(source.position(5), (2, 1));
    assert_eq!(source.position(7), (2, 3));
    assert_eq!(source.position(999), (2, 4));
}

#[test]
fn codes_are_unique_and_in_order() {
    let codes: Vec<_> = code::TABLE.iter().map(|(code, _)| code).collect();
    assert!(codes.is_sorted());
    assert!(codes.windows(2).all(|pair| pair[0] != pair[1]));
}

#[test]
fn digits_are_few() {
    assert_eq!(significant(0.1 + 0.2), "0.3");
    assert_eq!(significant(1.234_567_8e-7), "1.23457e-7");
    assert_eq!(significant(0.0), "0");
}

#[test]
fn numbers_are_short_and_read_back() {
    for (value, expected) in [
        (5.0, "5"),
        (0.01, "0.01"),
        (-0.0, "-0"),
        (1e-300, "1e-300"),
        (-2.5e300, "-2.5e300"),
        (1e16, "1e16"),
        (123456.75, "123456.75"),
        (f64::NAN, "NaN"),
        (f64::INFINITY, "inf"),
    ] {
        assert_eq!(number(value), expected);
    }
}

/// The number of the block and the number within it: (6, 16) for R0616.
fn block(code: &str) -> (u32, u32) {
    let digits = code.strip_prefix('R').filter(|digits| digits.len() == 4).unwrap();
    let number: u32 = digits.parse().unwrap();
    (number / 100, number % 100)
}

#[test]
fn numbers_of_codes_are_used_once_and_gaps_are_retired() {
    let declared: Vec<_> = code::TABLE.iter().map(|(code, _)| block(code)).collect();
    assert!(declared.is_sorted_by(|a, b| a < b), "codes are in order, each once");
    for retired in code::RETIRED {
        assert!(!declared.contains(&block(retired)), "{retired} is retired: take the next number");
        assert_eq!(code::page(retired), None, "{retired}");
    }
    let retired: Vec<_> = code::RETIRED.iter().map(|code| block(code)).collect();
    for (block, last) in &declared {
        for number in 1..*last {
            let found = (*block, number);
            let is_known = declared.contains(&found) || retired.contains(&found);
            assert!(is_known, "R{block:02}{number:02} is neither declared nor retired");
        }
    }
}
