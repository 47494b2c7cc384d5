use super::*;

#[test]
fn comments_stay_in_their_line() {
    let hostile = "a\n}\u{2028}fn b() {}\u{85}c\u{b}d\u{c}e\r f".to_owned();
    let lines: Vec<String> = comment(&[hostile]).collect();
    assert_eq!(lines, ["// a }fn b() {} c d e  f"]);
}

#[test]
fn numbers_are_of_single_precision() {
    assert_eq!(
        [0.1, -2.0, 1e-7, 3.0e38].map(number),
        ["0.1f", "-2.0f", "1e-7f", "3e38f"].map(str::to_owned)
    );
}
