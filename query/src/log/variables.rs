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
            let columns = self.of(schema, *variable, model);
            let missing = || missing(schema, *variable, self.name(*variable), model);
            found.extend(columns.ok_or_else(missing)?.into_iter().map(ident));
        }
        Ok(found)
    }

    /// The names of the columns of a variable; `None` if they are missing.
    pub(super) fn of(
        &self,
        schema: &Schema,
        variable: JointVariable,
        model: &Model,
    ) -> Option<Vec<String>> {
        let (name, joints) = (self.name(variable), model.joints());
        let is_nested = |kind: &DataType| kind.is_nested() || joints == 1;
        if schema.column_with_name(name).is_some_and(|(_, field)| is_nested(field.data_type())) {
            return Some(vec![name.to_owned()]);
        }
        ["", "_"].iter().find_map(|between| {
            let names = (1..=joints).map(|joint| format!("{name}{between}{joint}"));
            let names: Vec<String> = names.collect();
            let are_there = names.iter().all(|name| schema.column_with_name(name).is_some());
            are_there.then_some(names)
        })
    }

    /// The name of a variable's column, or the beginning of the names of several.
    fn name(&self, variable: JointVariable) -> &str {
        let place = JointVariable::ALL.iter().position(|other| *other == variable);
        let given = place.and_then(|place| self.variables[place].as_deref());
        given.unwrap_or(variable.name())
    }
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
