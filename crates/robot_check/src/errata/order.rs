//! The order of the terms of printed equations.

use robot_document::TermOrder;
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_model::diagnostic::{Diagnostics, Source};
use robot_model::robot::Robot;
use robot_symbolic::Graph;

use super::{Options, read};

/// The order of the terms and factors of a robot's quantities in printed equations, which are read as by
/// [`compare`](super::compare), and the printed numbers. If a quantity is printed twice, the later equation counts. An
/// equation that only names another quantity has no order.
///
/// # Errors
///
/// Everything that cannot be read, with its place, and quantities that the robot does not have.
pub fn term_order(
    robot: &Robot,
    source: &Source,
    options: &Options,
) -> Result<TermOrder, Diagnostics> {
    let graph = Graph::new();
    let exact = MechanismOptions::EXACT.with_snap(options.snap, robot);
    let mechanism = Mechanism::new(robot, &graph, &exact);
    let (printed, _) = read(robot, source, options, &mechanism)
        .map_err(|errors| Diagnostics::new(source.clone(), errors))?;
    let mut order = TermOrder::default();
    for equation in printed {
        order.set_number(&equation.quantity, &equation.number);
        // With a single term, only its factors could be ordered, and the term may be the name of another quantity.
        match equation.terms.len() {
            0 | 1 => order.insert_name(&equation.quantity),
            _ => order.insert(&equation.quantity, equation.terms),
        }
    }
    Ok(order)
}
