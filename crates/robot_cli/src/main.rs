//! The command `robot-symbolic`.

fn main() {}
