//! `search`: the form of the recursion with the fewest operations.

use std::time::SystemTime;

use clap::Args;
use robot_build::{Output, Ownership, pin_path, pin_text, shown, snapping};
use robot_dynamics::economical::search::{Measure, search};
use robot_dynamics::economical::{Plan, plan::LinkPlan};
use robot_dynamics::mechanism::MechanismOptions;

use crate::Terminal;
use crate::delivery::ForceArgument;
use crate::failure::Failure;
use crate::progress::watched;
use crate::robot::RobotArgument;
use crate::text;

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic search robots/ur5.toml

Tries the options of the economical recursion for inverse dynamics link by link and counts what each
costs. All forms give the same torques. What is found is pinned beside the robot file, as ur5.plan,
where builds find it: they do not search. After a change of the robot's mechanics, search again: then the
plan is stale, which builds refuse and other commands warn of. Remarks, names and values of parameters
are no such change.

The time of the robot file is set to now, its text is not touched: builds that made code before there
was a plan look again.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    /// Minimise instructions, a product and the sum that alone uses it as one: for code generated with
    /// --fused, on targets that multiply and add in one instruction
    #[arg(long)]
    fused: bool,
    /// Show what is found and pin nothing
    #[arg(long)]
    dry_run: bool,
    #[command(flatten)]
    force: ForceArgument,
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let path = pin_path(self.robot.path());
        let remedy = "move it away, or have it replaced with --force";
        let writer = self.force.writer([self.robot.path().to_owned()]).remedy(remedy);
        if !self.dry_run {
            if path.exists() && !path.is_file() {
                return Err(Failure::input(format!(
                    "{}: a plan is pinned in a regular file, which this is not; move it away",
                    shown(&path)
                )));
            }
            writer.check(&[(&path, Ownership::Marked)])?;
        }
        let robot = self.robot.read(terminal)?.robot;
        let options = MechanismOptions::ROUNDED.with_snap(self.robot.snap(), &robot);
        let measure = if self.fused { Measure::Instructions } else { Measure::Operations };
        let find = || search(&robot, &options, measure);
        let Some(found) = watched("searching", terminal, find) else {
            return Err(Failure::input(format!(
                "{}: a joint axis depends on parameters; the economical recursion has no forms for it",
                robot.name
            )));
        };
        let snapping = snapping(&robot, self.robot.snap(), Some(&found.plan))?;
        // First, so that it is done if nobody reads what is shown.
        if !self.dry_run {
            let text = pin_text(&robot, &found);
            let (bytes, ownership) = (text.as_bytes(), Ownership::Marked);
            writer.write(&[Output { path: path.clone(), bytes, ownership }])?;
            self.touch(terminal)?;
        }
        writeln!(
            terminal.output,
            "{}: {} multiplications and additions, {} with multiply-adds; the best of {} forms{}\n",
            robot.name,
            found.operations,
            found.instructions,
            found.tried,
            if found.cut_short { ", and the robot is too long to try more" } else { "" }
        )?;
        let names: Vec<&str> = robot.links.iter().map(|link| link.name.as_str()).collect();
        write!(terminal.output, "{}", text::table(&rows(&found.plan, &names)))?;
        if let Some((link, component)) = found.plan.unit_length {
            let name = names.get(link).copied().unwrap_or_default();
            let axis = ["x", "y", "z"][component.min(2)];
            writeln!(terminal.output, "\nunit of length: {axis} of the position of link {name}")?;
        }
        writeln!(terminal.output, "\n{}", text::snapping(&snapping))?;
        if !self.dry_run {
            writeln!(terminal.output, "\npinned in {}", shown(&path))?;
        }
        Ok(())
    }

    /// Sets the robot file's time of change to now: builds watch the file, and before its first search there
    /// was no plan to watch.
    fn touch(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let path = self.robot.path();
        let file = std::fs::OpenOptions::new().append(true).open(path);
        if let Err(error) = file.and_then(|file| file.set_modified(SystemTime::now())) {
            writeln!(
                terminal.errors,
                "warning: the time of {} cannot be set: {error}\n  a build that made code before there was a plan \
                 sees the plan at the next change of the file",
                shown(path)
            )?;
        }
        Ok(())
    }
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
        Some(entry) => format!("{entry:?}"),
        None => "-".to_owned(),
    });
    vec![
        name.to_owned(),
        format!("{:?}", plan.origin),
        format!("{:?}", plan.turn),
        yes(plan.angle_sum).to_owned(),
        yes(plan.column).to_owned(),
        yes(plan.doubled).to_owned(),
        yes(plan.diagonal).to_owned(),
        moment.join(" "),
        residual.join(" "),
    ]
}
