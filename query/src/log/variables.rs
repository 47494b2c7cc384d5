//! The columns of a log that contain the joints' variables, and their units.

use datafusion::arrow::datatypes::{DataType, Schema};
use datafusion::functions_nested::expr_fn::make_array;
use datafusion::logical_expr::{Expr, lit};
use datafusion::prelude::ident;

use crate::error::Error;
use crate::functions::scaled;
use crate::robots::Model;
use robot_model::robot::JointKind;
use robot_model::variable::JointVariable;

/// The names and units of columns that differ from the usual ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Names {
    /// The names for q, q̇, q̈ and τ, by the variable's place in [`JointVariable::ALL`]: one name, or one for each
    /// joint.
    pub variables: [Option<Vec<String>>; 4],
    /// Whether angles are in degrees, and their derivatives in degrees per s and s².
    pub degrees: bool,
    /// The factors that convert torques to N m or N: none, one number, or one for each joint.
    pub tau_factor: Vec<f64>,
}

/// The columns of a variable in a log.
enum Found {
    Columns(Vec<String>),
    Missing,
    /// Columns with all numbers from 0 to the number of joints, one more than the joints.
    Ambiguous(String),
}

impl Names {
    /// The expressions for the variables of a robot's joints, in the order of a call and in SI units. A variable is
    /// a list or struct with its name, or columns of numbers with its name and the number of the joint, such as
    /// `q1` or `q_1`, from 1 or from 0. `{}` in a name is replaced by the name of the joint.
    ///
    /// # Errors
    ///
    /// Columns that are missing or ambiguous; a number of factors that differs from the number of joints.
    pub fn columns(
        &self,
        schema: &Schema,
        variables: &[JointVariable],
        model: &Model,
    ) -> Result<Vec<Expr>, Error> {
        let mut found = vec![];
        for variable in variables {
            let columns = self.of(schema, *variable, model)?;
            let columns = columns.ok_or_else(|| self.missing(schema, *variable, model))?;
            let columns: Vec<Expr> = columns.into_iter().map(ident).collect();
            match self.factors(*variable, model)? {
                None => found.extend(columns),
                Some(factors) => {
                    let factors = make_array(factors.into_iter().map(lit).collect());
                    found.push(scaled().call(std::iter::once(factors).chain(columns).collect()));
                }
            }
        }
        Ok(found)
    }

    /// The factors that convert a variable's entries to SI units; `None` if the entries are in SI units.
    ///
    /// # Errors
    ///
    /// A number of factors that differs from the number of joints.
    pub(super) fn factors(
        &self,
        variable: JointVariable,
        model: &Model,
    ) -> Result<Option<Vec<f64>>, Error> {
        let joints = model.joints();
        match (variable, self.tau_factor.as_slice()) {
            (JointVariable::Torque, []) => Ok(None),
            (JointVariable::Torque, [one]) => Ok(Some(vec![*one; joints])),
            (JointVariable::Torque, all) if all.len() == joints => Ok(Some(all.to_vec())),
            (JointVariable::Torque, all) => Err(Error::Columns(format!(
                "--tau-factor has {} numbers; give one, or one for each of {joints} joints",
                all.len()
            ))),
            _ if self.degrees => {
                let factor = |kind: JointKind| match kind {
                    JointKind::Revolute => 1_f64.to_radians(),
                    JointKind::Prismatic => 1.0,
                };
                let coordinates = model.robot.coordinates.iter();
                Ok(Some(coordinates.map(|coordinate| factor(coordinate.kind)).collect()))
            }
            _ => Ok(None),
        }
    }

    /// The names of the columns of a variable; `None` if they are missing.
    ///
    /// # Errors
    ///
    /// Columns that are ambiguous.
    pub(super) fn of(
        &self,
        schema: &Schema,
        variable: JointVariable,
        model: &Model,
    ) -> Result<Option<Vec<String>>, Error> {
        match found(schema, &self.given(variable), model) {
            Found::Columns(columns) => Ok(Some(columns)),
            Found::Missing => Ok(None),
            Found::Ambiguous(name) => {
                let (joints, option) = (model.joints(), variable.name());
                Err(Error::Columns(format!(
                    "the log has {name}0 to {name}{joints}, one more than {} has joints; name a column for each joint, \
                     as in --{option} {name}1,{name}2",
                    model.robot.name
                )))
            }
        }
    }

    /// The names to search for.
    fn given(&self, variable: JointVariable) -> Vec<String> {
        let place = JointVariable::ALL.iter().position(|other| *other == variable);
        let given = place.and_then(|place| self.variables[place].clone());
        given.unwrap_or_else(|| vec![variable.name().to_owned()])
    }

    fn missing(&self, schema: &Schema, variable: JointVariable, model: &Model) -> Error {
        let there: Vec<&str> = schema.fields().iter().map(|field| field.name().as_str()).collect();
        let (there, joints) = (there.join(", "), model.joints());
        let (meaning, option) = (variable.meaning().to_lowercase(), variable.name());
        let robot = &model.robot.name;
        let names = self.given(variable);
        let reason = match names.as_slice() {
            [name] if name.contains("{}") => {
                let wanted: Vec<String> = by_joints(name, model);
                format!(
                    "the log has not the columns {} for {meaning} of {robot}",
                    wanted.join(", ")
                )
            }
            [name] => format!(
                "the log has no column `{name}` with a list, nor {name}1 to {name}{joints}, for {meaning} of {robot}"
            ),
            names if names.len() != joints => format!(
                "--{option} names {} columns for {meaning} of {robot}, which has {joints} joints",
                names.len()
            ),
            names => {
                let is_missing = |name: &&String| schema.column_with_name(name).is_none();
                let gone: Vec<&str> = names.iter().filter(is_missing).map(String::as_str).collect();
                format!("the log has no column `{}` for {meaning} of {robot}", gone.join("`, `"))
            }
        };
        Error::Columns(format!(
            "{reason}; its columns are {there}; name it with --{option}: a list, the beginning of numbered columns, a \
             column for each joint with commas between them, or {{}} for the joint's name as in --{option} \
             '{option}_{{}}'"
        ))
    }
}

/// A name for each joint, with `{}` replaced by the joint's name.
fn by_joints(name: &str, model: &Model) -> Vec<String> {
    let coordinates = model.robot.coordinates.iter();
    coordinates.map(|coordinate| name.replace("{}", &coordinate.joint)).collect()
}

fn found(schema: &Schema, names: &[String], model: &Model) -> Found {
    let joints = model.joints();
    let are_there =
        |names: &[String]| names.iter().all(|name| schema.column_with_name(name).is_some());
    let [name] = names else {
        let are_all = names.len() == joints && are_there(names);
        return if are_all { Found::Columns(names.to_vec()) } else { Found::Missing };
    };
    let is_nested = |kind: &DataType| kind.is_nested() || joints == 1;
    if schema.column_with_name(name).is_some_and(|(_, field)| is_nested(field.data_type())) {
        return Found::Columns(vec![name.clone()]);
    }
    if name.contains("{}") {
        let names = by_joints(name, model);
        return if are_there(&names) { Found::Columns(names) } else { Found::Missing };
    }
    for between in ["", "_"] {
        let numbered = |first: usize| -> Option<Vec<String>> {
            let names = (first..first + joints).map(|joint| format!("{name}{between}{joint}"));
            Some(names.collect()).filter(|names: &Vec<String>| are_there(names))
        };
        match (numbered(1), numbered(0)) {
            (Some(_), Some(_)) => return Found::Ambiguous(format!("{name}{between}")),
            (Some(names), None) | (None, Some(names)) => return Found::Columns(names),
            (None, None) => {}
        }
    }
    Found::Missing
}
