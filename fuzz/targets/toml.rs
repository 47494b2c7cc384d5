//! Any bytes as a robot file in TOML.
#![no_main]

use libfuzzer_sys::fuzz_target;
use robot_model::description::{decode, read_toml};

fuzz_target!(|data: &[u8]| {
    let Ok(text) = decode("robot.toml", data.to_vec()) else { return };
    match read_toml("robot.toml", &text) {
        Ok(described) => robot_fuzz::follow(&text, &described),
        Err(found) => robot_fuzz::show(&found),
    }
});
