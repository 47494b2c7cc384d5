//! The symbols and quantities of a robot, found by their LaTeX.

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};

use robot_document::latex;
use robot_document::math::Math;
use robot_dynamics::quantity::{Kind, Symbol};
use robot_model::robot::Robot;
use robot_model::variable::JointVariable;

use super::latex::symbol_key;

/// Accents on a letter that only indicate that it is a vector.
const VECTOR_SIGNS: [&str; 5] = [r"\bar", r"\overline", r"\vec", r"\overrightarrow", r"\widetilde"];

/// The names of a robot's symbols and quantities by the keys of their LaTeX.
#[derive(Default)]
pub(super) struct Symbols {
    names: HashMap<String, String>,
    quantities: HashMap<String, String>,
    vectors: HashMap<String, String>,
    /// The names that occur in the derived equations.
    used: BTreeSet<String>,
}

impl Symbols {
    /// Collects the symbols of a robot, with the LaTeX of its file and the spelling of printed equations.
    pub(super) fn of(robot: &Robot, quantities: &[Symbol], used: BTreeSet<String>) -> Symbols {
        let mut symbols = Symbols { used, ..Symbols::default() };
        for parameter in &robot.parameters {
            symbols.insert(&parameter.name, parameter.latex.as_deref());
        }
        for (_, wrench) in robot.tips() {
            for (name, latex) in wrench.components().zip(&wrench.latex) {
                symbols.insert(name, latex.as_deref());
            }
        }
        for index in 0..robot.degrees_of_freedom() {
            for variable in JointVariable::MOTION {
                symbols.insert(&variable.symbol(index), None);
            }
        }
        for quantity in quantities {
            symbols.insert_quantity(*quantity);
        }
        symbols
    }

    fn insert(&mut self, name: &str, latex: Option<&str>) {
        let spelt = symbol_key(&latex::formula(&Math::spelled(name)));
        self.names.entry(spelt).or_insert_with(|| name.to_owned());
        if let Some(latex) = latex {
            self.names.insert(symbol_key(latex), name.to_owned());
        }
    }

    fn insert_quantity(&mut self, symbol: Symbol) {
        let (name, number) = (symbol.to_string(), symbol.number);
        if symbol.component.is_some() {
            let vector = symbol.kind.name();
            let name = format!("{vector}{number}");
            let orders = [format!("{vector}^{number}"), format!("{vector}_{number}")];
            self.vectors.extend(orders.map(|key| (key, name.clone())));
        }
        let key = symbol_key(&latex::formula(&Math::quantity(symbol)));
        if let Some((lower, upper)) = key.split_once('^') {
            let (letter, index) = lower.split_once('_').unwrap_or((lower, ""));
            self.quantities.insert(format!("{letter}^{upper}_{index}"), name.clone());
        }
        if symbol.kind == Kind::JointTorque {
            let others = [format!("Q_m^{number}"), format!(r"\tau_{number}")];
            self.quantities.extend(others.map(|key| (key, name.clone())));
        }
        self.quantities.insert(key, name);
    }

    /// The name of a symbol on a right side.
    pub(super) fn name(&self, key: &str) -> Option<String> {
        let known = self.names.get(key);
        // `c_2` is a cosine unless an equation contains a parameter with this name.
        if let Some(index) = key.strip_prefix("s_").or(key.strip_prefix("c_"))
            && index.bytes().all(|byte| byte.is_ascii_digit())
        {
            return known.filter(|name| self.used.contains(*name)).cloned();
        }
        // A power of a symbol of the robot is not a quantity.
        let power = key.split_once('^').is_some_and(|(base, _)| self.names.contains_key(base));
        known.or_else(|| self.quantities.get(key).filter(|_| !power)).cloned()
    }

    /// The name of the quantity that infix text on a left side denotes, such as `Q1`, `tau1` or `tau_1`; what is not a
    /// quantity of the robot is returned unchanged.
    pub(super) fn quantity_in_text(&self, text: &str) -> String {
        let joined = text.replacen('_', "", 1);
        let names = [in_text(text), in_text(&joined)];
        let is_known = |name: &&Cow<'_, str>| self.quantities.values().any(|known| known == *name);
        names.iter().find(is_known).map_or_else(|| text.to_owned(), ToString::to_string)
    }

    /// The name of the quantity, or of the vector of quantities, that LaTeX on a left side denotes. Other text is
    /// returned unchanged.
    pub(super) fn quantity(&self, latex: &str, vector: bool) -> String {
        let known = if vector { &self.vectors } else { &self.quantities };
        known.get(&plain_key(latex)).cloned().unwrap_or_else(|| latex.trim().to_owned())
    }

    /// Whether LaTeX on a left side denotes a quantity or a vector of quantities.
    pub(super) fn has_quantity(&self, latex: &str) -> bool {
        self.quantities.contains_key(&plain_key(latex)) || self.is_vector(latex)
    }

    /// Whether LaTeX on a left side denotes a vector of quantities.
    pub(super) fn is_vector(&self, latex: &str) -> bool {
        self.vectors.contains_key(&plain_key(latex))
    }
}

/// The key of a symbol without the signs of a vector.
fn plain_key(latex: &str) -> String {
    VECTOR_SIGNS.iter().fold(symbol_key(latex), |key, sign| key.replace(sign, ""))
}

/// The name of the symbol or quantity that infix text denotes: `tau1` is the joint torque `Q1`. Other text is returned
/// unchanged.
pub(super) fn in_text(text: &str) -> Cow<'_, str> {
    match JointVariable::parse(text) {
        Some((JointVariable::Torque, joint)) => {
            Cow::Owned(format!("{}{}", Kind::JointTorque.name(), joint + 1))
        }
        _ => Cow::Borrowed(text),
    }
}
