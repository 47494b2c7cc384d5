//! Checks that the plans that are pinned beside the robot files are those that a search finds.

use robot_build::{Source, pin_text, read};
use robot_dynamics::economical::search::{Measure, search};
use robot_dynamics::mechanism::MechanismOptions;
use robot_testing::robot_files;

/// This test fails after a change of the recursion or of the search; `robot-symbolic search` then rewrites the pins.
#[test]
fn pins_are_what_a_search_finds() {
    let differ: Vec<String> = std::thread::scope(|scope| {
        let searches =
            robot_files().into_iter().map(|(name, text)| scope.spawn(move || differs(&name, text)));
        let searches: Vec<_> = searches.collect();
        searches.into_iter().filter_map(|search| search.join().unwrap()).collect()
    });
    assert!(differ.is_empty(), "robots/NAME.plan is out of date for {}", differ.join(", "));
}

/// The difference between a pin and the result of a search, if there is one.
fn differs(name: &str, text: String) -> Option<String> {
    let source = Source { name: format!("robots/{name}.toml"), text };
    let robot = read(&source).unwrap().robot;
    let found = search(&robot, &MechanismOptions::ROUNDED, Measure::Operations).unwrap();
    let path = format!("{}/robots/{name}.plan", env!("CARGO_MANIFEST_DIR"));
    let pinned = std::fs::read_to_string(path).unwrap();
    let found = robot_build::counted(&robot, found, None).unwrap();
    let operations = found.operations;
    println!("{name}: {operations} operations, the best of {} forms", found.tried);
    (pinned != pin_text(&robot, &found)).then(|| format!("{name} ({operations} operations)"))
}
