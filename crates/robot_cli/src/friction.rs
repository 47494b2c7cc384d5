//! The options with which a command takes friction into account.

use clap::Args;
use robot_build::{Effects, FunctionKind};
use robot_model::description::{LARGEST, LEAST};
use robot_model::diagnostic::number;
use robot_model::robot::{Friction, Robot};
use robot_symbolic::Formula;

use crate::failure::Failure;
use crate::values;

/// Checks that the robot has friction, if the command is to take it into account.
pub(crate) fn has_friction(file: &str, robot: &Robot) -> Result<(), Failure> {
    match FunctionKind::InverseDynamics(Effects::FRICTION).missing_in(robot) {
        None => Ok(()),
        Some(why) => Err(Failure::input(format!("{file}: --friction: {why}"))),
    }
}

/// Parses the width of a smooth sign function, whose magnitude is in the range of robot files.
fn width(text: &str) -> Result<Formula, String> {
    let width = values::number(text)?;
    match (LEAST..=LARGEST).contains(&width) {
        true => Formula::parse(&width.to_string()).map_err(|error| error.message),
        false => Err(format!(
            "it is {}; it must be a positive velocity from {LEAST:e} to {LARGEST:e}",
            number(width)
        )),
    }
}

/// Friction in the joints.
#[derive(Args)]
pub(crate) struct FrictionArguments {
    /// Include the friction in the robot file
    #[arg(long)]
    friction: bool,
    /// Smooth Coulomb friction without a `smoothing`: replace sign(qd) with tanh(qd / WIDTH), rad/s or m/s
    #[arg(long, value_name = "WIDTH", requires = "friction", allow_hyphen_values = true, value_parser = width)]
    smoothing: Option<Formula>,
}

impl FrictionArguments {
    /// Whether the command takes friction into account.
    pub(crate) fn is_wanted(&self) -> bool {
        self.friction
    }

    /// Replaces the sign function in dry friction with a smooth one, if the option is given.
    pub(crate) fn apply_smoothing(&self, robot: &mut Robot) {
        let Some(formula) = &self.smoothing else { return };
        for link in &mut robot.links {
            if link.friction != Friction::none() && link.friction.smoothing.is_none() {
                link.friction.smoothing = Some(formula.clone());
            }
        }
    }
}
