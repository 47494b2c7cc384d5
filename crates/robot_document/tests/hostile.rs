//! Text from robot files stays plain text.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

use robot_document::latex::text;

#[test]
fn signs_of_latex_are_escaped() {
    for (given, latex) in [
        (r"\input{x}", r"\textbackslash{}input\{x\}"),
        ("100 % $x$", r"100 \% \$x\$"),
        ("a_b^c~d", r"a\_b\textasciicircum{}c\textasciitilde{}d"),
        ("</script>", r"\(<\)/script\(>\)"),
        ("ä\u{202e}", r#"\"{a}[U+202E]"#),
        ("a\n\nb", "a  b"),
    ] {
        assert_eq!(text(given), latex);
    }
}

/// No text gives a command other than those of the escapes.
#[test]
fn no_text_becomes_a_command() {
    let mut state: u32 = 1;
    for round in 0..2000 {
        let mut given = String::new();
        for _ in 0..12 {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let signs: Vec<char> = r"\{}$%&#_^~inputend@`'-<>|é中".chars().collect();
            given.push(signs[(state >> 16) as usize % signs.len()]);
        }
        let mut rest = text(&given);
        for known in [
            r"\textbackslash{}",
            r"\textasciitilde{}",
            r"\textasciicircum{}",
            r"\allowbreak{}",
            r"\(<\)",
            r"\(>\)",
            r"\(|\)",
            r"\'{e}",
            "{}",
        ] {
            rest = rest.replace(known, "");
        }
        for sign in ["{", "}", "$", "%", "&", "#", "_"] {
            rest = rest.replace(&format!("\\{sign}"), "");
        }
        let left = rest.contains(['\\', '{', '}', '$', '%', '&', '#', '_', '^', '~']);
        assert!(!left, "round {round}: {given} {rest}");
    }
}
