//! Comparison of texts with committed files.

use std::path::Path;

/// Compares a text with a file in the sources of this crate. With `UPDATE_SNAPSHOTS` set, it writes the file first;
/// review the difference before you keep it.
pub(crate) fn assert_snapshot(path: &str, found: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(path);
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        std::fs::write(&path, found).unwrap();
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_default();
    let mut lines = expected.lines().zip(found.lines()).enumerate();
    let first = lines.find(|(_, (expected, found))| expected != found);
    assert!(
        expected == found,
        "{} is another from line {} on; UPDATE_SNAPSHOTS=1 writes it\n{}",
        path.display(),
        first.map_or(expected.lines().count(), |(line, _)| line) + 1,
        first.map_or(String::new(), |(_, (expected, found))| format!("-{expected}\n+{found}")),
    );
}
