//! The robot for commands about motions, made from its file.

use robot_build::{FunctionKind, Functions, Options, Programs, programs_of};
use robot_model::robot::Robot;

use crate::Terminal;
use crate::failure::Failure;
use crate::friction::{FrictionArguments, has_friction};
use crate::robot::OpenRobot;
use crate::settings::Settings;

/// Makes the robot, whose parameters must all have values, with friction as chosen by the options.
pub(crate) fn robot(
    file: &OpenRobot<'_>,
    settings: &Settings,
    friction: &FrictionArguments,
    terminal: &mut Terminal<'_>,
) -> Result<Robot, Failure> {
    settings.check_once()?;
    let described = file.read(terminal)?;
    file.argument().check_base_frames(&[], terminal)?;
    let wrong = settings.wrong(&described.robot);
    if !wrong.is_empty() {
        return Err(Failure::Input(wrong));
    }
    settings.check(file, &described, terminal)?;
    let mut robot = described.robot;
    if friction.is_wanted() {
        has_friction(&file.source().name, &robot)?;
    }
    friction.apply_smoothing(&mut robot);
    Ok(robot)
}

/// Compiles its functions, with the options of the file.
pub(crate) fn programs(
    file: &OpenRobot<'_>,
    robot: Robot,
    functions: Vec<FunctionKind>,
    options: Options,
) -> Result<Programs, Failure> {
    let options = Options { functions: Functions::Chosen(functions), ..options };
    Ok(programs_of(robot, &file.source().name, &options)?)
}
