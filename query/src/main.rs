//! The command `robot-query`.

mod commands;

use std::process::ExitCode;

use mimalloc::MiMalloc;

/// Blocks of a log are a few megabytes. The system's allocator asks the kernel for fresh pages for each of them, which
/// takes longer than their torques; this one uses them again.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

fn main() -> ExitCode {
    match commands::run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
