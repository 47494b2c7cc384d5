//! Any bytes as URDF.
#![no_main]

use libfuzzer_sys::fuzz_target;
use robot_model::description::{decode, read_urdf};

fuzz_target!(|data: &[u8]| {
    let Ok(text) = decode("robot.urdf", data.to_vec()) else { return };
    match read_urdf("robot.urdf", &text) {
        Ok(described) => {
            robot_fuzz::imports("robot.urdf", &text, &described);
            robot_fuzz::follow(&text, &described);
        }
        Err(found) => robot_fuzz::show(&found),
    }
});
