//! `excite`: a trajectory for identification.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use robot_query::Error;
use robot_query::log::{check_vacant, write_new};
use robot_query::motion::{Excitation, excite, limits};

use super::{Engine, noise, positive};

/// Finds a periodic trajectory within the joint limits that determines the base parameters well
///
/// The trajectory is a Fourier series for each joint, chosen for a small condition number of the regressor. The
/// output is CSV with t, q1 …, qd1 … and qdd1 …, which `robot-symbolic torques --trajectory` reads.
#[derive(Args)]
#[command(after_help = "Example:
  robot-query excite robots/ur5.toml -o excitation.csv --noise 1,1,1,0.1,0.1,0.1")]
pub(super) struct Arguments {
    /// The robot: a path, or a name in a folder of --robots
    robot: String,
    /// The period, s
    #[arg(long, value_name = "S", default_value_t = 10.0, value_parser = positive, allow_negative_numbers = true)]
    period: f64,
    /// Rows per second
    #[arg(long, value_name = "HZ", default_value_t = 100.0, value_parser = positive, allow_negative_numbers = true)]
    rate: f64,
    /// The largest speed of the joints, rad/s or m/s
    #[arg(long, value_name = "SPEED", default_value_t = 2.0, value_parser = positive, allow_negative_numbers = true)]
    speed: f64,
    /// The standard deviations of the torques' noise, N m or N: one, or one for each joint
    #[arg(long, value_delimiter = ',', value_name = "NUMBERS", default_value = "1", value_parser = positive, allow_negative_numbers = true)]
    noise: Vec<f64>,
    /// The number of trajectories to try
    #[arg(long, value_name = "N", default_value_t = 1000)]
    tries: usize,
    /// The seed of the random numbers
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// The CSV file to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

impl Arguments {
    pub(super) fn run(&self, engine: &Engine) -> Result<(), Error> {
        check_vacant(&self.output)?;
        let model = engine.robots()?.model(&self.robot)?;
        let joints = model.joints();
        let how = Excitation {
            limits: limits(&model, self.speed),
            period: self.period,
            noise: noise(&self.noise, joints)?,
            tries: self.tries,
            seed: self.seed,
        };
        let (trajectory, condition) = excite(&model, &how)?;
        let mut text = "t".to_owned();
        for name in ["q", "qd", "qdd"] {
            (1..=joints).for_each(|joint| text.push_str(&format!(",{name}{joint}")));
        }
        text.push('\n');
        let mut row = vec![0.0; 3 * joints];
        let samples = (self.period * self.rate).round() as u64;
        for sample in 0..=samples {
            let time = sample as f64 / self.rate;
            trajectory.at(time, &mut row);
            let _ = write!(text, "{time}");
            row.iter().for_each(|value| text.push_str(&format!(",{value}")));
            text.push('\n');
        }
        write_new(&self.output, text.as_bytes())?;
        eprintln!("condition {condition:.3}");
        Ok(())
    }
}
