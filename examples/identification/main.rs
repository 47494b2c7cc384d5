//! Identification of the PUMA 560's base parameters from simulated measurements with noise.
//!
//! ```sh
//! cargo run --release -p robots --example identification -- [SEED] [CSV]
//! ```
//!
//! Prints the true value, the estimate and its standard deviation of each base parameter; writes the torques that
//! the estimate predicts along another trajectory, with their differences from the torques measured there.

mod report;
mod study;
mod trajectory;

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let seed = arguments.next().map_or(Ok(report::SEED), |seed| seed.parse())?;
    let path = arguments.next().unwrap_or_else(|| "target/identification.csv".to_owned());
    let (text, csv) = report::report(seed)?;
    std::fs::write(&path, csv)?;
    print!("{text}");
    eprintln!("wrote {path}");
    Ok(())
}
