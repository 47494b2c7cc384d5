//! The order of the terms of printed equations.

use robot_document::TermOrder;
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_model::diagnostic::{Diagnostics, Source};
use robot_model::robot::Robot;
use robot_symbolic::Graph;

use super::{Options, read};

/// The order in which printed equations, as [`compare`](super::compare) reads them, have the terms and factors of a robot's
/// quantities, and the numbers that they give them; of a quantity printed twice those of the later equation, and no order if it only
/// names a quantity.
///
/// # Errors
///
/// Everything that cannot be read, with its place; quantities that the robot does not have.
pub fn term_order(
    robot: &Robot,
    source: &Source,
    options: &Options,
) -> Result<TermOrder, Diagnostics> {
    let graph = Graph::new();
    let exact = MechanismOptions::EXACT.with_snap(options.snap, robot);
    let mechanism = Mechanism::new(robot, &graph, &exact);
    let printed = read(robot, source, options, &mechanism)
        .map_err(|errors| Diagnostics::new(source.clone(), errors))?;
    let mut order = TermOrder::default();
    for equation in printed {
        order.set_number(&equation.quantity, &equation.number);
        // With one term there is nothing to order but its factors, and that term may be another quantity's name.
        match equation.terms.len() {
            0 | 1 => order.insert_name(&equation.quantity),
            _ => order.insert(&equation.quantity, equation.terms),
        }
    }
    Ok(order)
}
