//! Evidence about the code from the compiler and from the numeric solver.

use robot_document::markup::{Element, Node, element, holding};
use robot_evidence::{Evidence, Module};

use crate::folded::folded;
use crate::table::Table;

/// The evidence from the compiler.
#[derive(Clone, Debug)]
pub enum Compiled {
    /// The compiled objects were analyzed.
    Read {
        /// The compiler, with its version and target.
        compiler: String,
        /// The evidence about the functions, for each profile.
        modules: Vec<Module>,
    },
    /// There is no evidence from the compiler.
    Unread {
        /// The reason.
        reason: String,
    },
}

/// The differences between the programs and an independent solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// A description of the states at which they were compared.
    pub states: String,
    /// The largest relative error of each function.
    pub worst: Vec<(String, f64)>,
}

/// The evidence from the object files.
pub(crate) fn compiled(compiled: &Compiled) -> Vec<Node> {
    match compiled {
        Compiled::Unread { reason } => {
            let words = format!("The machine code was not analyzed: {reason}");
            vec![holding("p", words).class("note").into()]
        }
        Compiled::Read { compiler, modules } => {
            let words = format!(
                "The functions, compiled by {compiler}. The counts of a function include \
                 all functions that it calls, each once; the stack is that of the deepest \
                 chain of calls."
            );
            let words = Node::from(holding("p", words));
            std::iter::once(words).chain(modules.iter().map(|one| profile(one).into())).collect()
        }
    }
}

fn profile(module: &Module) -> Element {
    let columns = [
        "Function",
        "Claim",
        "Conditional jumps",
        "Panics",
        "Calls",
        "Instructions",
        "Bytes",
        "Stack, bytes",
    ];
    let mut table = Table::new(&format!("Profile {}", module.profile.name()), columns);
    for Evidence { name, measurements, calls, violations, takes_states } in &module.functions {
        let claim = match (violations.as_slice(), *takes_states) {
            ([], false) => "flat".to_owned(),
            ([], true) => "loops over states".to_owned(),
            (violations, _) => {
                let all: Vec<String> = violations.iter().map(ToString::to_string).collect();
                format!("broken: {}", all.join("; "))
            }
        };
        let calls: Vec<String> =
            calls.iter().map(|(symbol, count)| format!("{count} {symbol}")).collect();
        let cells = [
            claim,
            measurements.conditional_jumps.to_string(),
            measurements.panics.to_string(),
            calls.join(", "),
            measurements.instructions.to_string(),
            measurements.bytes.to_string(),
            measurements.stack.to_string(),
        ];
        table.row("", holding("code", name.as_str()), cells);
    }
    folded(format!("Machine code, profile {}", module.profile.name()), [table.build()])
}

/// The comparison of the programs with the numeric solver.
pub(crate) fn accuracy(accuracy: &Result<Accuracy, String>) -> Vec<Node> {
    match accuracy {
        Ok(Accuracy { states, worst }) => {
            let caption = format!(
                "Straight-line programs compared with the numeric solver at {states}: the \
                 largest difference in a component, relative to the largest component of the \
                 result"
            );
            let mut table = Table::new(&caption, ["Function", "Largest error"]);
            for (function, error) in worst {
                table.row(
                    "",
                    holding("code", function.as_str()),
                    [format!("{error:.1e}").replace('-', "−")],
                );
            }
            vec![table.build().into()]
        }
        Err(reason) => {
            let words = format!("The programs were not compared with the numeric solver: {reason}");
            vec![element("p").class("note").with(words).into()]
        }
    }
}
