//! Check values: the results of a function at a stated state, so that users can test their copy.

use robot_codegen::{Interpreter, OutputValues, Trigonometry};
use robot_model::diagnostic::Source;

use crate::driver::programs::Programs;
use crate::error::Errors;

/// Entries of inputs, used in turn: short decimals of either sign. No sum of up to five successive ones with any signs
/// is near a multiple of π/2, so that no sine or cosine of a sum of joint angles is 0 or 1 at the stated state.
const ENTRIES: [f64; 8] = [0.53, 0.31, 0.78, -0.64, -0.21, 1.05, -1.19, 0.79];
/// Values for parameters without nominal values, used in turn.
const PARAMETERS: [f64; 5] = [1.5, 0.8, 1.2, 0.6, 1.1];

/// The values of a function at a stated state.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckValue {
    /// The function.
    pub function: String,
    /// The parameters without nominal values, with the values used for them.
    pub parameters: Vec<(String, f64)>,
    /// The inputs.
    pub inputs: Vec<(String, Vec<f64>)>,
    /// The outputs.
    pub outputs: Vec<OutputValues>,
}

/// Computes the check value of a function of a robot.
///
/// # Errors
///
/// The module does not have the function.
pub fn check_value(
    name: &str,
    programs: &Programs,
    function: &str,
    trigonometry: Trigonometry,
) -> Result<CheckValue, Errors> {
    let code = |errors| Errors::of_code(name, &errors);
    let parameters = stated_parameters(programs);
    let given: Vec<(&str, f64)> =
        parameters.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let interpreter =
        Interpreter::new(&programs.module, &given).map_err(code)?.with_trigonometry(trigonometry);
    let inputs = stated_inputs(programs, function);
    let given: Vec<(&str, &[f64])> =
        inputs.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect();
    let outputs = interpreter.call(function, &given).map_err(code)?;
    Ok(CheckValue { function: function.to_owned(), parameters, inputs, outputs })
}

/// Computes the check values of all functions that have finite ones: at placeholder values of parameters, a root or a
/// quotient can be undefined.
pub(crate) fn finite_check_values(
    source: &Source,
    programs: &Programs,
    trigonometry: Trigonometry,
) -> Result<Vec<CheckValue>, Errors> {
    let functions = programs.module.functions.iter();
    let checks =
        functions.map(|function| check_value(&source.name, programs, &function.name, trigonometry));
    let checks: Vec<CheckValue> = checks.collect::<Result<_, _>>()?;
    Ok(checks.into_iter().filter(is_finite).collect())
}

/// Whether all results are finite.
pub(crate) fn is_finite(check: &CheckValue) -> bool {
    check.outputs.iter().flat_map(|output| &output.values).all(|value| value.is_finite())
}

fn stated_parameters(programs: &Programs) -> Vec<(String, f64)> {
    let parameters = programs.module.parameters.iter();
    let unknown = parameters.filter(|parameter| parameter.nominal.is_none());
    let values = PARAMETERS.into_iter().cycle();
    unknown.zip(values).map(|(parameter, value)| (parameter.name.clone(), value)).collect()
}

fn stated_inputs(programs: &Programs, function: &str) -> Vec<(String, Vec<f64>)> {
    let Some(function) = programs.module.function(function) else {
        return vec![];
    };
    let inputs = function.inputs.iter().enumerate().map(|(index, input)| {
        let entries = ENTRIES.into_iter().cycle().skip(3 * index).take(input.symbols.len());
        (input.name.clone(), entries.collect())
    });
    inputs.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_sum_of_successive_entries_is_a_special_angle() {
        for start in 0..ENTRIES.len() {
            for signs in 0..16_u32 {
                let mut sum = 0.0;
                for count in 0..5 {
                    let entry = ENTRIES[(start + count) % ENTRIES.len()];
                    let negative = count > 0 && signs >> (count - 1) & 1 == 1;
                    sum += if negative { -entry } else { entry };
                    let quarters = sum / std::f64::consts::FRAC_PI_2;
                    assert!((quarters - quarters.round()).abs() > 0.02, "{start} {count} {signs}");
                }
            }
        }
    }
}
