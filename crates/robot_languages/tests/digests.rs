//! The committed digests are those of the interpreter, which other tests compare with generated Rust.

use std::collections::BTreeMap;

use robot_codegen::Scalar;
use robot_languages::digests::{self, committed, digest};
use robot_languages::work::{Work, robots};

#[test]
fn digests_are_those_of_the_interpreter() {
    let mut found = BTreeMap::new();
    for robot in robots().unwrap() {
        let work = Work::new(&robot, Scalar::F64).unwrap();
        for calls in &work.functions {
            found.insert(digests::name(&work, &calls.name), digest(&calls.expected));
        }
    }
    let stated = committed().unwrap();
    for (name, digest) in &found {
        assert_eq!(
            Some(digest),
            stated.get(name),
            "{name}: cargo run -p robot_languages -- --write"
        );
    }
    assert_eq!(found.len(), stated.len());
}
