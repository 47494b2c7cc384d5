//! Generates the module of TRTTR1, whose functions the command's demonstration calls.

fn main() -> Result<(), robot_build::Errors> {
    robot_build::Builder::new().allow_outside(true).compile(&["../../robots/trttr1.toml"])
}
