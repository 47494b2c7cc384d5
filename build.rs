//! Generates a module for each robot file in `robots/`.

fn main() -> Result<(), robot_build::Errors> {
    robot_build::Builder::new().batch(robot_build::DEFAULT_BATCH).compile_folder("robots")
}
