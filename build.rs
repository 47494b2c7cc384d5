//! Generates a module for each robot file in `robots/`.

fn main() -> Result<(), robot_build::Errors> {
    robot_build::Builder::new().compile_folder("robots")
}
