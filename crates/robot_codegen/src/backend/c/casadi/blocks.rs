//! Jacobians of functions, computed by other functions of the module.

use super::super::Header;
use super::external::{External, Port, call, given, model, taken};
use crate::backend::flat::Function;

/// The functions that compute the blocks of a Jacobian, one block for each input: the name of a function and the names
/// of its outputs that are blocks. Inputs of this function that the differentiated one does not have are set to 0.
type Blocks = &'static [(&'static str, &'static [&'static str])];

/// Returns the blocks of ∂f/∂x for the function with this name. The derivative of inverse dynamics with respect to
/// accelerations is the mass matrix. `bias` is inverse dynamics with accelerations 0, `gravity` also with velocities 0.
fn blocks(name: &str) -> Blocks {
    match name {
        "inverse_dynamics" => &[
            ("inverse_dynamics_derivatives", &["dtau_dq", "dtau_dqd"]),
            ("mass_matrix", &["mass_matrix"]),
        ],
        "bias" => &[("inverse_dynamics_derivatives", &["dtau_dq", "dtau_dqd"])],
        "gravity" => &[("inverse_dynamics_derivatives", &["dtau_dq"])],
        "forward_dynamics" => {
            &[("forward_dynamics_derivatives", &["dqdd_dq", "dqdd_dqd", "dqdd_dtau"])]
        }
        _ => &[],
    }
}

/// Makes the external function `jac_f`, if the module has the functions that compute it.
pub(super) fn jacobian(
    header: &Header<'_>,
    function: &Function<'_>,
    of: &External,
) -> Option<External> {
    let [output] = of.outputs.as_slice() else { return None };
    let blocks = blocks(&function.source.name);
    let count: usize = blocks.iter().map(|(_, outputs)| outputs.len()).sum();
    // A bundle with other inputs can have the same name.
    if count == 0 || count != of.variables {
        return None;
    }
    let mut body = vec![];
    let mut inputs = of.inputs.clone();
    inputs.push(Port::zero(format!("out_{}", output.name), output.rows, output.columns));
    body.extend(taken(&of.inputs));
    body.extend(model(header, of.variables));
    let mut outputs: Vec<Port> = vec![];
    let mut stores = vec![];
    for (number, (name, wanted)) in blocks.iter().enumerate() {
        let given_by = header.tree.functions.iter().find(|one| one.source.name == *name)?;
        let mut arguments = vec![];
        for (index, input) in given_by.source.inputs.iter().enumerate() {
            let same = function.source.inputs.iter().position(|one| one.name == input.name);
            arguments.push(same.map_or_else(
                || {
                    let length = input.symbols.len();
                    let zero = format!("zero{number}_{index}");
                    body.push(format!("const double {zero}[{length}] = {{0.0}};"));
                    zero
                },
                |same| format!("x{same}"),
            ));
        }
        let results = format!("y{number}_");
        body.extend(call(header, given_by, arguments.into_iter(), &results));
        for wanted in *wanted {
            let found = given_by.source.outputs.iter().position(|one| one.name == *wanted)?;
            let index = outputs.len();
            let name = format!("jac_{}_{}", output.name, of.inputs[index].name);
            let port = Port::dense(name, output.size(), of.inputs[index].size());
            stores.push(given(index, &format!("{results}{found}"), &port));
            outputs.push(port);
        }
    }
    // Parameters do not count as variables.
    for input in &of.inputs[of.variables..] {
        let name = format!("jac_{}_{}", output.name, input.name);
        outputs.push(Port::zero(name, output.size(), input.size()));
    }
    body.extend(stores);
    let name = format!("jac_{}", of.name);
    Some(External { name, inputs, outputs, variables: of.variables, body })
}
