//! A state on the command line: `--q 0.3,-0.5 --qd 0,0`.

use clap::Args;
use robot_model::robot::Robot;
use robot_model::variable::{JointVariable, WRENCH};

use super::{Layout, State};
use crate::text;
use crate::values::{list, miscounted, number, of_joints};

/// A state, each variable as an option.
#[derive(Args)]
pub(crate) struct StateArguments {
    /// Joint positions of one state, instead of --states, separated by commas; in rad or m, such as 0.5, pi/2 or 90deg
    #[arg(long, value_name = "Q1,Q2,…", allow_hyphen_values = true, conflicts_with = "states")]
    q: Option<String>,
    /// Joint velocities of the state; rad/s or m/s
    #[arg(long, value_name = "QD1,…", allow_hyphen_values = true, conflicts_with = "states")]
    qd: Option<String>,
    /// Joint accelerations of the state; rad/s² or m/s²
    #[arg(long, value_name = "QDD1,…", allow_hyphen_values = true, conflicts_with = "states")]
    qdd: Option<String>,
    /// Joint torques of the state; N m or N
    #[arg(long, value_name = "TAU1,…", allow_hyphen_values = true, conflicts_with = "states")]
    tau: Option<String>,
    /// Wrench of the state that the tip exerts on its surroundings; TIP=FX,… for each of several tips
    #[arg(
        long,
        value_name = "FX,FY,FZ,MX,MY,MZ",
        allow_hyphen_values = true,
        conflicts_with = "states"
    )]
    wrench: Vec<String>,
}

impl StateArguments {
    /// Whether any variable is given.
    pub(crate) fn is_given(&self) -> bool {
        let given = [&self.q, &self.qd, &self.qdd, &self.tau];
        given.iter().any(|one| one.is_some()) || !self.wrench.is_empty()
    }

    /// The joint positions as they are written.
    pub(crate) fn positions(&self) -> &str {
        self.q.as_deref().unwrap_or_default()
    }

    /// The given variables, without the wrench, that are not among these inputs.
    pub(crate) fn unused(&self, inputs: &[&str]) -> Vec<&'static str> {
        let given = JointVariable::ALL.into_iter().zip([&self.q, &self.qd, &self.qdd, &self.tau]);
        let given = given.filter(|(_, text)| text.is_some()).map(|(variable, _)| variable.name());
        given.filter(|name| !inputs.contains(name)).collect()
    }

    /// Returns the state and all its errors.
    pub(crate) fn state<'l>(&self, robot: &Robot, layout: &'l Layout) -> (State<'l>, Vec<String>) {
        let (mut state, mut wrong) = (State::new(layout), vec![]);
        let given = [&self.q, &self.qd, &self.qdd, &self.tau];
        for (variable, text) in JointVariable::ALL.into_iter().zip(given) {
            let (Some(text), Some(index)) = (text, layout.position(variable.name())) else {
                continue;
            };
            let option = format!("--{}", variable.name());
            // A wrong array counts as given, so that it is not also reported as missing.
            let array = state.begin_array(index);
            match of_joints(&option, text, variable, robot) {
                Ok(values) => {
                    wrong.extend(miscounted(&option, &values, &robot.symbols(variable)));
                    *array = values;
                }
                Err(found) => wrong.extend(found),
            }
        }
        for text in &self.wrench {
            match wrench(text, layout) {
                Ok((index, _)) if state.at(index).is_some() => {
                    let name = &layout.arrays[index].name;
                    wrong.push(format!("--wrench: `{name}` is given twice; leave one out"));
                }
                Ok((index, values)) => *state.begin_array(index) = values,
                Err(found) => wrong.extend(found),
            }
        }
        (state, wrong)
    }
}

/// Parses a wrench such as `0,0,-10,0,0,0` or `left=0,0,-10,0,0,0`.
fn wrench(text: &str, layout: &Layout) -> Result<(usize, Vec<f64>), Vec<String>> {
    let (tip, entries) = text.split_once('=').map_or(("", text), |(tip, rest)| (tip.trim(), rest));
    if tip.is_empty() && text.contains('=') {
        return Err(vec!["--wrench: the name before `=` is missing".to_owned()]);
    }
    let name = if tip.is_empty() { WRENCH.to_owned() } else { format!("{WRENCH}_{tip}") };
    let Some(index) = layout.position(&name) else {
        let of_tip = |name: &&str| name.starts_with(&format!("{WRENCH}_"));
        let tips: Vec<&str> = layout.names().into_iter().filter(of_tip).collect();
        let tips: Vec<&str> = tips.iter().map(|name| &name[WRENCH.len() + 1..]).collect();
        return Err(vec![match tip {
            "" => format!(
                "--wrench: the robot has several tips; write TIP=FX,FY,FZ,MX,MY,MZ for one of {}",
                tips.join(", ")
            ),
            tip if tips.is_empty() => {
                format!("--wrench: the robot does not have several tips; leave out `{tip}=`")
            }
            tip => format!("--wrench: {}", text::unknown("tip", tip, &tips)),
        }]);
    };
    let columns = &layout.arrays[index].columns;
    let values = list("--wrench", entries, columns, |_, entry| number(entry))?;
    match miscounted("--wrench", &values, columns) {
        Some(wrong) => Err(vec![wrong]),
        None => Ok((index, values)),
    }
}
