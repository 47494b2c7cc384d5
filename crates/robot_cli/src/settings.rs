//! Parameters that a command sets.

use clap::Args;
use robot_model::description::Described;
use robot_model::diagnostic::number;
use robot_model::robot::Robot;

use crate::Terminal;
use crate::failure::Failure;
use crate::function::check_once;
use crate::robot::OpenRobot;
use crate::text;
use crate::values;

/// Parameters' values in place of the nominal ones.
#[derive(Args)]
pub(crate) struct Settings {
    /// Set a parameter to a value other than the nominal one; the checks of robot files apply
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = setting)]
    settings: Vec<(String, f64)>,
}

/// Parses a setting such as `M5=2.5`.
fn setting(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("expected NAME=VALUE, such as M5=2.5")?;
    let name = name.trim();
    match name.is_empty() {
        true => Err("the name before `=` is missing".to_owned()),
        false => Ok((name.to_owned(), values::number(value)?)),
    }
}

impl Settings {
    /// The names and values of the parameters that are set.
    pub(crate) fn pairs(&self) -> Vec<(&str, f64)> {
        self.settings.iter().map(|(name, value)| (name.as_str(), *value)).collect()
    }

    /// Applies the reader's checks to the robot file with these values instead of the nominal ones.
    pub(crate) fn check(
        &self,
        file: &OpenRobot<'_>,
        described: &Described,
        terminal: &mut Terminal<'_>,
    ) -> Result<(), Failure> {
        let pairs = self.pairs();
        if pairs.is_empty() {
            return Ok(());
        }
        let checked = file.check_values(described, &pairs, terminal);
        if let Err(Failure::Robot(_)) = &checked {
            let values: Vec<String> =
                pairs.iter().map(|(name, value)| format!("{name}={}", number(*value))).collect();
            writeln!(terminal.errors, "with --set {}:", values.join(" --set "))?;
        }
        checked
    }

    /// Returns an error for each parameter that is set twice.
    pub(crate) fn check_once(&self) -> Result<(), Failure> {
        let names: Vec<String> = self.settings.iter().map(|(name, _)| name.clone()).collect();
        check_once("--set", &names)
    }

    /// Finds parameters that do not exist or have no value.
    pub(crate) fn wrong(&self, robot: &Robot) -> Vec<String> {
        let mut wrong = vec![];
        let parameters = &robot.parameters;
        let known: Vec<&str> = parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        for (name, _) in &self.settings {
            if !known.contains(&name.as_str()) {
                wrong.push(format!("--set: {}", text::unknown("parameter", name, &known)));
            }
        }
        for parameter in parameters.iter().filter(|parameter| parameter.value.is_none()) {
            let name = &parameter.name;
            if self.settings.iter().all(|(set, _)| set != name) {
                wrong.push(format!(
                    "`{name}` does not have a nominal value: set it with --set \
                    {name}=…"
                ));
            }
        }
        wrong
    }
}
