//! What a command does before a signal ends it.

/// The exit code of a command that Ctrl-C ends, as shells have it: 128 and the number of the signal.
const INTERRUPTED: i32 = 130;

/// From now on, the compiler's temporary folders are removed if Ctrl-C or a signal ends the process.
pub(crate) fn remove_folders() {
    // Without a handler, or with that of another command in this process, only these folders can remain.
    let _ = ctrlc::set_handler(|| {
        robot_evidence::remove_temporary_folders();
        std::process::exit(INTERRUPTED);
    });
}
