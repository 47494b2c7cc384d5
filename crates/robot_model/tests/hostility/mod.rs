//! The common part of the tests with malicious files, for all formats: corruption of files, and a limit on the time
//! until a message is given.

use std::fs;
use std::time::{Duration, Instant};

use robot_check::doctor::examine;
use robot_model::description::Described;
use robot_model::diagnostic::Diagnostics;
use robot_numeric::random::Random;

/// The codes of errors, which must be found within a few seconds.
pub(crate) fn soon(errors: impl FnOnce() -> Diagnostics) -> Vec<&'static str> {
    let start = Instant::now();
    let found = errors();
    let rendered = found.to_string();
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
    assert!(rendered.len() < 200_000, "{}", rendered.len());
    found.iter().map(|diagnostic| diagnostic.code).collect()
}

/// The files in a folder of this package with the given extension.
pub(crate) fn files(folder: &str, extension: &str) -> Vec<Vec<u8>> {
    let folder = format!("{}/{folder}", env!("CARGO_MANIFEST_DIR"));
    let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|end| end == extension)).collect();
    paths.sort();
    paths.iter().map(|path| fs::read(path).unwrap()).collect()
}

/// Corrupts files at random.
pub(crate) struct Spoiler {
    /// Groups of files, such as valid and invalid ones. Each group is chosen equally often.
    pub(crate) groups: Vec<Vec<Vec<u8>>>,
    /// Fragments that have a meaning in some context.
    pub(crate) pieces: &'static [&'static str],
}

impl Spoiler {
    fn seed(&self, random: &mut Random) -> &[u8] {
        let group = &self.groups[random.index(self.groups.len())];
        &group[random.index(group.len())]
    }

    /// Applies a few random edits to a file.
    fn spoil(&self, random: &mut Random) -> Vec<u8> {
        let mut text = self.seed(random).to_vec();
        for _ in 0..1 + random.index(4) {
            let at = random.index(text.len() + 1);
            let most = 1 + random.index(60);
            let end = (at + random.index(most)).min(text.len());
            match random.index(6) {
                0 => drop(text.drain(at..end)),
                1 => {
                    let piece = self.pieces[random.index(self.pieces.len())];
                    drop(text.splice(at..end, piece.bytes()));
                }
                2 => {
                    let piece = text[at..end].to_vec();
                    let to = random.index(text.len() + 1);
                    drop(text.splice(to..to, piece));
                }
                3 if !text.is_empty() => {
                    let at = at.min(text.len() - 1);
                    text[at] ^= 1 << random.index(8);
                }
                4 => {
                    let other = self.seed(random);
                    let from = random.index(other.len());
                    let to = (from + random.index(200)).min(other.len());
                    drop(text.splice(at..end, other[from..to].iter().copied()));
                }
                _ => text.truncate(text.len() - random.index(20).min(text.len())),
            }
        }
        text
    }

    /// Reads corrupted files and checks that every diagnostic can be rendered and lies within the file. Returns how
    /// many files gave a robot, which is passed to `also`, and how many caused errors.
    pub(crate) fn run(
        &self,
        seed: u64,
        rounds: usize,
        read: impl Fn(&str) -> Result<Described, Diagnostics>,
        also: impl Fn(&str, &Described),
    ) -> [usize; 2] {
        let mut random = Random::new(seed);
        let mut counts = [0; 2];
        for round in 0..rounds {
            let bytes = self.spoil(&mut random);
            let text = String::from_utf8_lossy(&bytes).into_owned();
            let one = || match read(&text) {
                Ok(described) => {
                    assert!(!described.warnings.has_errors());
                    let examination = examine(&described);
                    is_in_place(&text, &examination.found);
                    is_in_place(&text, &examination.choices);
                    also(&text, &described);
                    0
                }
                Err(found) => {
                    assert!(found.has_errors());
                    is_in_place(&text, &found);
                    1
                }
            };
            match std::panic::catch_unwind(std::panic::AssertUnwindSafe(one)) {
                Ok(kind) => counts[kind] += 1,
                Err(_) => panic!("seed {seed}, round {round}:\n{text}"),
            }
        }
        counts
    }
}

fn is_in_place(text: &str, found: &Diagnostics) {
    for diagnostic in found.iter() {
        for label in diagnostic.primary.iter().chain(&diagnostic.secondary) {
            assert!(text.get(label.span.clone()).is_some(), "{diagnostic:?}");
        }
    }
    assert!(found.to_string().ends_with('\n'));
}

/// The number of rounds from the environment variable, or the usual number.
pub(crate) fn rounds(usual: usize) -> usize {
    match std::env::var("FUZZ_ROUNDS") {
        Ok(rounds) => rounds.parse().unwrap(),
        Err(_) => usual,
    }
}
