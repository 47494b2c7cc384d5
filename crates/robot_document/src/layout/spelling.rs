//! The layouts of symbols and quantities, derived from their names.

use robot_dynamics::quantity::{Kind, Symbol};
use robot_model::signs::{Accent, Letter};
use robot_model::variable::JointVariable;

use super::math::{Fence, Math, Script};

impl Math {
    /// The layout of a symbol with this name. `q2` has the index 2, `qd2` and `qdd2` also have dots on the q, `Jx1` has
    /// the index x1, `alpha1` is α with the index 1, `v_max` has the upright index max, and `payload` is an upright
    /// word.
    #[must_use]
    pub fn spelled(name: &str) -> Math {
        let mut parts = name.split(['_', '.']).filter(|part| !part.is_empty());
        let Some(first) = parts.next() else {
            return Math::Word(name.to_owned());
        };
        let (mut base, mut indices) = leading(first);
        indices.extend(parts.map(word));
        let lower = Math::row(indices.join(&Math::Sign(',')));
        if !indices.is_empty()
            && let Some(last) = base.pop()
        {
            base.push(last.with_lower(lower));
        }
        Math::row(base)
    }

    /// The layout of a vector, `\bar{F}_{l}^{5}`: like that of its components, but with a bar and without the axis.
    #[must_use]
    pub fn vector(kind: Kind, number: usize) -> Math {
        let (letter, index) = kind.name().split_once('_').unwrap_or((kind.name(), ""));
        let base = Math::Letter(letter.chars().next().unwrap_or('F')).with_bar();
        let lower = index.chars().next().map(Math::Letter);
        Math::Script(Box::new(Script { base, lower, upper: Some(Math::integer(number)) }))
    }

    /// The layout of a vector in the paper's relations, `\bar{F}_{l_5}^{5}`: the lower index has the link and the upper
    /// one the axes. A moment also has its reference point, `\bar{M}_{l_{o_5}}^{5}`.
    #[must_use]
    pub fn vector_in_paper(kind: Kind, number: usize) -> Math {
        let Math::Script(script) = Math::vector(kind, number) else { return Math::default() };
        let number = match kind {
            Kind::LinkMoment => Math::Letter('o').with_lower(Math::integer(number)),
            _ => Math::integer(number),
        };
        let lower = match script.lower.clone() {
            Some(index) => index.with_lower(number),
            None => number,
        };
        Math::Script(Box::new(Script { lower: Some(lower), ..*script }))
    }

    /// The layout of a vector that the paper writes as a column: `[\bar{F}_l]_5^5`, or `[\bar{M}_l]_{O_5}^5` for a
    /// moment.
    #[must_use]
    pub fn column_in_paper(kind: Kind, number: usize) -> Math {
        let Math::Script(script) = Math::vector(kind, number) else { return Math::default() };
        let Script { base, lower, upper } = *script;
        let vector = match lower {
            Some(index) => base.with_lower(index),
            None => base,
        };
        let lower = match kind {
            Kind::LinkMoment => Math::Letter('O').with_lower(Math::integer(number)),
            _ => Math::integer(number),
        };
        let base = Math::Fenced(Fence::Brackets, Box::new(vector));
        Math::Script(Box::new(Script { base, lower: Some(lower), upper }))
    }

    /// The layout of a quantity in the paper: `Q_m^{1}` for a joint torque, otherwise as in [`Math::quantity`].
    #[must_use]
    pub fn in_paper(symbol: Symbol) -> Math {
        match symbol.kind {
            Kind::JointTorque => {
                let (lower, upper) = (Math::Letter('m'), Math::integer(symbol.number));
                let base = Math::Letter('Q');
                Math::Script(Box::new(Script { base, lower: Some(lower), upper: Some(upper) }))
            }
            _ => Math::quantity(symbol),
        }
    }

    /// The piece with a bar above it.
    #[must_use]
    pub fn with_bar(self) -> Math {
        Math::Accent(Accent::Bar, Box::new(self))
    }

    /// The layout of a quantity: `Q_1`, `F_{l_x}^{5}`.
    #[must_use]
    pub fn quantity(symbol: Symbol) -> Math {
        let number = Math::integer(symbol.number);
        let name = symbol.kind.name();
        let (letter, index) = name.split_once('_').unwrap_or((name, ""));
        let base = Math::Letter(letter.chars().next().unwrap_or('Q'));
        let Some(component) = symbol.component else {
            return base.with_lower(number);
        };
        let axis = Math::Letter(['x', 'y', 'z'][component.min(2)]);
        let lower = match index.chars().next() {
            Some(index) => Math::Letter(index).with_lower(axis),
            None => axis,
        };
        Math::Script(Box::new(Script { base, lower: Some(lower), upper: Some(number) }))
    }
}

/// Splits the first part of a name into its base and its lower indices.
fn leading(part: &str) -> (Vec<Math>, Vec<Vec<Math>>) {
    let letters = part.trim_end_matches(|c: char| c.is_ascii_digit());
    let digits = part.get(letters.len()..).unwrap_or_default();
    let index = match digits {
        "" => vec![],
        _ => vec![vec![Math::Number(digits.to_owned())]],
    };
    let rate = |accent| vec![Math::Accent(accent, Box::new(Math::Letter('q')))];
    let mut characters = letters.chars();
    let first = characters.next();
    let tail = characters.as_str();
    match (JointVariable::from_name(letters), first) {
        (Some(JointVariable::Velocity), _) => (rate(Accent::Dot), index),
        (Some(JointVariable::Acceleration), _) => (rate(Accent::DoubleDot), index),
        // A letter with axes as its lower index, such as Jx and Ixx.
        (_, Some(first)) if first.is_ascii_uppercase() && !tail.is_empty() && is_axes(tail) => {
            let mut index = axes(tail);
            if !digits.is_empty() {
                index.push(Math::Number(digits.to_owned()));
            }
            (vec![Math::Letter(first)], vec![index])
        }
        (_, None) => (vec![Math::Number(digits.to_owned())], vec![]),
        _ => (word(letters), index),
    }
}

fn is_axes(text: &str) -> bool {
    text.len() <= 2 && text.bytes().all(|byte| matches!(byte, b'x' | b'y' | b'z'))
}

fn axes(text: &str) -> Vec<Math> {
    text.chars().map(Math::Letter).collect()
}

/// The layout of a part of a name: a single letter, a number, a Greek letter by its name, or otherwise an upright word.
fn word(text: &str) -> Vec<Math> {
    if let Some(letter) = Letter::greek(text) {
        return vec![Math::Letter(letter.character)];
    }
    let letters = text.trim_end_matches(|c: char| c.is_ascii_digit());
    let digits = text.get(letters.len()..).unwrap_or_default();
    let mut pieces = match letters {
        "" => vec![],
        _ if is_axes(text) => return axes(text),
        single if single.len() == 1 && single.bytes().all(|byte| byte.is_ascii_alphabetic()) => {
            single.chars().map(Math::Letter).collect()
        }
        _ => return vec![Math::Word(text.to_owned())],
    };
    if !digits.is_empty() {
        pieces.push(Math::Number(digits.to_owned()));
    }
    pieces
}
