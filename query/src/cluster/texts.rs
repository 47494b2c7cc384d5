//! Replaces the names of robots in a query by the texts of their files, which other machines do not have.

use std::sync::Arc;

use datafusion::common::tree_node::Transformed;
use datafusion::common::{DFSchema, ScalarValue};
use datafusion::config::ConfigOptions;
use datafusion::error::Result;
use datafusion::logical_expr::Expr;
use datafusion::logical_expr::expr_rewriter::FunctionRewrite;

use crate::functions::{takes_robot, text_of};
use crate::robots::Robots;

/// Replaces the names and paths of robots by the texts of their files if other machines compute the query.
#[derive(Debug)]
pub(crate) struct Texts {
    pub(crate) robots: Arc<Robots>,
    /// Whether other machines compute queries.
    pub(crate) distributed: bool,
}

impl FunctionRewrite for Texts {
    fn name(&self) -> &str {
        "texts_of_robots"
    }

    fn rewrite(&self, expr: Expr, _: &DFSchema, _: &ConfigOptions) -> Result<Transformed<Expr>> {
        match expr {
            Expr::ScalarFunction(mut call) if takes_robot(call.func.name()) => {
                let changed = self.replace(call.args.first_mut())?;
                Ok(Transformed::new_transformed(Expr::ScalarFunction(call), changed))
            }
            Expr::AggregateFunction(mut call) if takes_robot(call.func.name()) => {
                let changed = self.replace(call.params.args.first_mut())?;
                Ok(Transformed::new_transformed(Expr::AggregateFunction(call), changed))
            }
            other => Ok(Transformed::no(other)),
        }
    }
}

impl Texts {
    /// Replaces the literal of a robot; returns whether it has changed.
    fn replace(&self, robot: Option<&mut Expr>) -> Result<bool> {
        let Some(Expr::Literal(value, _)) = robot else {
            return Ok(false);
        };
        let Some(name) = text_of(value) else {
            return Ok(false);
        };
        let is_name = self.distributed && !name.contains('\n');
        let text =
            if is_name { self.robots.model(name)?.source.text.clone() } else { name.to_owned() };
        // Aggregates receive the text for each row of a batch; a view repeats it without copying.
        let view = ScalarValue::Utf8View(Some(text));
        let changed = *value != view;
        *value = view;
        Ok(changed)
    }
}
