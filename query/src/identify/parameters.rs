//! The base parameters of a robot as numbers.

use nalgebra::{DMatrix, DVector};
use robot_dynamics::base_parameters::{StandardParameter, base_parameters};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_symbolic::Graph;

use crate::error::Error;
use crate::robots::Model;

/// The maximum number of expressions in the derivation.
const MOST_EXPRESSIONS: usize = 500_000;

/// The base parameters β = B π at the nominal values of the robot file.
#[derive(Clone, Debug)]
pub(crate) struct Parameters {
    /// Their names, such as `ZZR_2`.
    pub(crate) names: Vec<String>,
    /// Their values.
    pub(crate) nominal: DVector<f64>,
    /// B: a row for each base parameter, a column for each standard one.
    pub(crate) regrouping: DMatrix<f64>,
    /// The standard parameters: ten of each link, and those of drives.
    pub(crate) standard: Vec<StandardParameter>,
    /// π, the values of the standard parameters.
    pub(crate) values: DVector<f64>,
}

impl Parameters {
    /// Derives the base parameters of a robot.
    ///
    /// # Errors
    ///
    /// A robot whose base parameters cannot be derived; parameters without a nominal value.
    pub(crate) fn of(model: &Model) -> Result<Parameters, Error> {
        let robot = &model.robot;
        let failed = |reason: &str| Error::Robot {
            robot: model.source.name.clone(),
            reason: reason.to_owned(),
        };
        let graph = Graph::limited(MOST_EXPRESSIONS);
        let options = MechanismOptions::ROUNDED.with_snap(None, robot);
        let derivation = Derivation::new(robot, &graph, &options, None);
        let found = base_parameters(&derivation).ok_or_else(|| {
            let reason = robot_build::functions::out_of_reach(robot);
            failed(reason.unwrap_or("its base parameters cannot be found"))
        })?;
        if graph.is_full() {
            return Err(failed("its base parameters need too many expressions"));
        }
        let value = |symbol| robot.nominal_value(&graph.symbol_name(symbol));
        let values = found.standard.iter().map(|(_, value_of)| value_of.evaluate(value));
        let values = DVector::from_iterator(found.standard.len(), values);
        let mut regrouping = DMatrix::zeros(found.base.len(), found.standard.len());
        for (row, parameter) in found.base.iter().enumerate() {
            for (column, coefficient) in &parameter.terms {
                regrouping[(row, *column)] = coefficient.evaluate(value);
            }
        }
        if values.iter().chain(regrouping.iter()).any(|value| !value.is_finite()) {
            return Err(failed("a parameter has no nominal value; give each one a value"));
        }
        Ok(Parameters {
            names: found.base.iter().map(|parameter| parameter.name()).collect(),
            nominal: &regrouping * &values,
            regrouping,
            standard: found.standard.iter().map(|(parameter, _)| *parameter).collect(),
            values,
        })
    }
}
