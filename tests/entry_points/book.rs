//! The package on the book's page for Rust developers.

use robot_testing::pages::blocks;

use crate::package::{Package, dependency};

const PAGE: &str = include_str!("../../docs/users/rust.md");

#[test]
fn the_package_of_the_page_prints_what_it_shows() {
    let runtime = dependency("robot_runtime", "");
    let (macros, build) = (dependency("robot_macros", ""), dependency("robot_build", ""));
    let tables = format!("[dependencies]\n{runtime}{macros}\n[build-dependencies]\n{build}");
    let package = Package::new("by_the_book", &tables);
    package.write("ur5.toml", include_str!("../../robots/ur5.toml"));
    package.write("ur5.plan", include_str!("../../robots/ur5.plan"));
    package.write("planar_2r.toml", include_str!("../../robots/planar_2r.toml"));
    let blocks = blocks(PAGE);
    for block in &blocks {
        if let Some(file) = block.value("file") {
            package.write(file, &block.text);
        }
    }
    let shown: Vec<&str> = blocks
        .iter()
        .filter(|block| block.is("printed"))
        .map(|block| block.text.as_str())
        .collect();
    assert_eq!(shown, [package.run(&["run"])]);
}
