//! `search`: the form of the recursion with the fewest operations.

mod tune;

use std::time::SystemTime;

use clap::Args;
use robot_build::{
    Options, Output, Ownership, pin_text, robot_inputs, search_code, shown, snapping, system_reason,
};
use robot_dynamics::economical::Plan;
use robot_dynamics::economical::plan::{Entry, LinkPlan, Origin, Turn};
use robot_dynamics::economical::search::{Found, Measure};
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::robot::Robot;

use crate::Terminal;
use crate::delivery::{ForceArgument, named};
use crate::failure::Failure;
use crate::progress::watched;
use crate::robot::RobotArgument;
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic search robots/ur5.toml

Tries the options of the economical recursion for inverse dynamics, link by link, and counts the operations of
each. All forms give the same torques. The best plan is pinned beside the robot file, as ur5.plan; builds, which
do not search themselves, use it. After a change of the robot's mechanics the plan is stale: builds refuse it
and other commands warn, until you search again. Remarks, names and values of parameters may change.

With --tune the plans with the fewest operations are also compiled in memory and timed on this machine: a call
of inverse dynamics at one state, and the time per state in a batch. The plan with the fastest call is pinned if
it is 1 % faster than the one with the fewest operations. Another run or machine may choose another plan, and
the pinned plan says so. Without --tune the result is the same everywhere.

For each link the table shows the position of its frame's origin on the joint axis (for example at the foot of
the common normal to the next or previous axis), the direction of its x axis, further options, and the first and
second moments S of the parent that parts of the link make vanish (residual).

The modification time of the robot file is set to the current time, so builds that ran before there was a plan
run again; its text does not change.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// Minimize instructions, with a multiply-add counted as one: for code generated with --fused, on
    /// targets that multiply and add in one instruction
    #[arg(long)]
    fused: bool,
    /// Among the plans with the fewest operations, pin the one that is fastest on this machine
    #[arg(long)]
    tune: bool,
    /// Show the result without pinning it
    #[arg(long)]
    dry_run: bool,
    #[command(flatten)]
    force: ForceArgument,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        // Plans are read next to the file that a symbolic link leads to.
        let [_, path] = robot_inputs(self.robot.path());
        let remedy = "move it away, or replace it with --force";
        let writer =
            self.force.writer([self.robot.path().to_owned()], !self.dry_run)?.remedy(remedy);
        if !self.dry_run {
            if path.exists() && !path.is_file() {
                return Err(Failure::input(format!(
                    "{}: a pinned plan must be a regular file, and this one is not; move it away",
                    shown(&path)
                )));
            }
            writer.check(&[(&path, Ownership::Marked)])?;
        }
        let robot = self.robot.read(terminal)?.robot;
        self.robot.check_base_frames(&[], terminal)?;
        let options = MechanismOptions::ROUNDED.with_snap(self.robot.snap(), &robot);
        let measure = if self.fused { Measure::Instructions } else { Measure::Operations };
        let find = || match self.tune {
            true => tune::search(&robot, (&options, measure), &self.code_options()),
            false => {
                let found = search_code(&robot, measure, self.robot.snap())?;
                Ok(found.map(|found| (found, vec![])))
            }
        };
        let Some((found, times)) = watched("searching", terminal, find)? else {
            return Err(Failure::input(format!(
                "{}: no plan is needed: a joint axis depends on parameters, so code is generated from \
                 the paper's iterations; to search for a plan, give the axis in numbers",
                shown(self.robot.path())
            )));
        };
        let snapping = snapping(&robot, self.robot.snap(), Some(&found.plan))?;
        // The plan is written first, so that this is done even if nobody reads the output.
        if !self.dry_run {
            let text = pin_text(&robot, &found);
            let (bytes, ownership) = (text.as_bytes(), Ownership::Marked);
            writer.write(&[Output { path: path.clone(), bytes, ownership }])?;
            self.touch(terminal)?;
        }
        show(&robot, &found, &times, terminal)?;
        writeln!(terminal.output, "\n{}", text::snapping(&snapping))?;
        if !self.dry_run {
            writeln!(terminal.output, "\npinned in {}", named(&path))?;
        }
        Ok(())
    }

    /// The options of the code that `--tune` times.
    fn code_options(&self) -> Options {
        Options { fused: self.fused, snap: self.robot.snap(), ..Options::default() }
    }

    /// Sets the modification time of the robot file to now. Builds watch this file, because a plan did not exist
    /// before the first search.
    fn touch(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let path = self.robot.path();
        let file = std::fs::OpenOptions::new().append(true).open(path);
        if let Err(error) = file.and_then(|file| file.set_modified(SystemTime::now())) {
            writeln!(
                terminal.errors,
                "warning: the modification time of {} cannot be set: {}\n  a build that ran before there was a plan \
                 will use it after the next change of the file",
                shown(path),
                system_reason(&error)
            )?;
        }
        Ok(())
    }
}

/// Prints the result: counts, times if plans were timed, and the plan.
fn show(
    robot: &Robot,
    found: &Found,
    times: &[Vec<String>],
    terminal: &mut Terminal<'_>,
) -> Result<(), Failure> {
    writeln!(
        terminal.output,
        "{}: {} multiplications and additions, {} with multiply-adds; {} of {} forms{}\n",
        robot.name,
        found.operations,
        found.instructions,
        if found.tuned { "the fastest of those timed" } else { "the best" },
        found.tried,
        if found.cut_short { ", the limit for a robot of this size" } else { "" }
    )?;
    if !times.is_empty() {
        writeln!(terminal.output, "{}", text::table(times))?;
    }
    let names: Vec<&str> = robot.links.iter().map(|link| link.name.as_str()).collect();
    write!(terminal.output, "{}", text::table(&rows(&found.plan, &names)))?;
    if let Some((link, component)) = found.plan.unit_length {
        let name = names.get(link).copied().unwrap_or_default();
        let axis = ["x", "y", "z"][component.min(2)];
        writeln!(
            terminal.output,
            "\nunit of length: the {axis} component of the position of \
            link {name}"
        )?;
    }
    Ok(())
}

fn rows(plan: &Plan, names: &[&str]) -> Vec<Vec<String>> {
    let title = [
        "link",
        "origin",
        "turn",
        "angle sum",
        "column",
        "doubled",
        "diagonal",
        "moment",
        "residual",
    ];
    let mut rows = vec![title.map(str::to_owned).to_vec()];
    for (link, name) in plan.links.iter().zip(names) {
        rows.push(row(link, name));
    }
    rows
}

fn row(plan: &LinkPlan, name: &str) -> Vec<String> {
    let yes = |flag: bool| if flag { "yes" } else { "-" };
    let moment: Vec<&str> = plan.moment.into_iter().map(yes).collect();
    let residual = plan.residual.map(|entry| match entry {
        Some(entry) => moment_of(entry),
        None => "-",
    });
    vec![
        name.to_owned(),
        origin(plan.origin).to_owned(),
        turn(plan.turn).to_owned(),
        yes(plan.angle_sum).to_owned(),
        yes(plan.column).to_owned(),
        yes(plan.doubled).to_owned(),
        yes(plan.diagonal).to_owned(),
        moment.join(" "),
        residual.join(" "),
    ]
}

/// Describes the position of a frame's origin on its joint axis.
const fn origin(origin: Origin) -> &'static str {
    match origin {
        Origin::File => "as in the file",
        Origin::NextNormal => "normal to next",
        Origin::PreviousNormal => "normal to previous",
        Origin::ZeroXz => "where Sxz = 0",
        Origin::ZeroYz => "where Syz = 0",
        Origin::CenterOfMass => "center of mass",
        Origin::Parent => "as the parent's",
    }
}

/// Describes the direction of a frame's x axis.
const fn turn(turn: Turn) -> &'static str {
    match turn {
        Turn::File => "as in the file",
        Turn::NextNormal => "normal to next",
        Turn::FirstMoment => "first moment",
    }
}

/// Describes the moment of the parent that vanishes because a part of the inertia stays with the link.
const fn moment_of(entry: Entry) -> &'static str {
    match entry {
        Entry::X => "Sx",
        Entry::Y => "Sy",
        Entry::Xx => "Sxx",
        Entry::Yy => "Syy",
        Entry::Xy => "Sxy",
        Entry::Xz => "Sxz",
        Entry::Yz => "Syz",
        Entry::XxYy => "Sxx-Syy",
    }
}

#[cfg(test)]
mod tests {
    use clap::{Command, FromArgMatches};

    use super::*;

    #[test]
    fn the_code_that_is_timed_has_the_options_of_the_search() {
        for (more, expected) in [
            (&[][..], Options::default()),
            (&["--fused"], Options { fused: true, ..Options::default() }),
            (&["--snap", "0.01"], Options { snap: Some(0.01), ..Options::default() }),
        ] {
            let line = [&["search", "arm.toml", "--tune"], more].concat();
            let command = Arguments::augment_args(Command::new("search"));
            let matches = command.try_get_matches_from(line).unwrap();
            let arguments = Arguments::from_arg_matches(&matches).unwrap();
            assert_eq!(arguments.code_options(), expected, "{more:?}");
        }
    }
}
