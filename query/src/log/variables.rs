//! The columns of a log that have the joints' variables.

use datafusion::arrow::datatypes::{DataType, Schema};
use datafusion::logical_expr::Expr;
use datafusion::prelude::ident;

use crate::error::Error;
use crate::robots::Model;
use robot_model::variable::JointVariable;

/// The names of columns where they are not the usual ones.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// Of q, q̇, q̈ and τ, by the variable's place in [`JointVariable::ALL`].
    pub variables: [Option<String>; 4],
}

impl Names {
    /// The columns of variables of a robot's joints, in the order of a call: a list or struct of the name, or numbers
    /// with the name and the number of the joint behind it, as `q1` or `q_1`.
    ///
    /// # Errors
    ///
    /// Columns that are missing.
    pub fn columns(
        &self,
        schema: &Schema,
        variables: &[JointVariable],
        model: &Model,
    ) -> Result<Vec<Expr>, Error> {
        let mut found = vec![];
        for variable in variables {
            let place = JointVariable::ALL.iter().position(|other| other == variable);
            let given = place.and_then(|place| self.variables[place].as_deref());
            let name = given.unwrap_or(variable.name());
            found.extend(columns(schema, name, model.joints()).ok_or_else(|| {
                missing(schema, *variable, name, model)
            })?);
        }
        Ok(found)
    }
}

fn columns(schema: &Schema, name: &str, joints: usize) -> Option<Vec<Expr>> {
    let is_nested = |kind: &DataType| kind.is_nested() || joints == 1;
    if schema.column_with_name(name).is_some_and(|(_, field)| is_nested(field.data_type())) {
        return Some(vec![ident(name)]);
    }
    ["", "_"].iter().find_map(|between| {
        let names = (1..=joints).map(|joint| format!("{name}{between}{joint}"));
        let names: Vec<String> = names.collect();
        let are_there = names.iter().all(|name| schema.column_with_name(name).is_some());
        are_there.then(|| names.into_iter().map(ident).collect())
    })
}

fn missing(schema: &Schema, variable: JointVariable, name: &str, model: &Model) -> Error {
    let there: Vec<&str> = schema.fields().iter().map(|field| field.name().as_str()).collect();
    let joints = model.joints();
    Error::Columns(format!(
        "the log has no column `{name}` with a list, nor {name}1 to {name}{joints}, for {} of {}; its columns are {}; \
         name it with --{}",
        variable.meaning(),
        model.robot.name,
        there.join(", "),
        variable.name()
    ))
}
