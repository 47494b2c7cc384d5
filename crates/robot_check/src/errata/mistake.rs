//! The kinds of mistakes that turn a derived term into the printed one.

use std::fmt;

use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, View};

use super::term::{Power, Term};

/// The kinds of mistakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum MistakeKind {
    /// A derived term is not printed.
    MissingTerm,
    /// A printed term is not derived.
    ExtraTerm,
    /// The sign is wrong.
    Sign,
    /// The coefficient of the term is wrong, not only its sign.
    Coefficient,
    /// A coordinate has too few or too many dots.
    Dot,
    /// An index is wrong: the printed symbol has the same letter but another number or axis.
    Index,
    /// A function is wrong, such as a sine instead of a cosine of the same argument.
    Function,
    /// The power of a right factor is wrong.
    Power,
    /// A derived factor is not printed.
    MissingFactor,
    /// A printed factor is not derived.
    ExtraFactor,
    /// A factor is replaced by another one that does not resemble it.
    Factor,
}

impl MistakeKind {
    /// The kind in words, such as `dot` or `missing factor`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            MistakeKind::MissingTerm => "missing term",
            MistakeKind::ExtraTerm => "extra term",
            MistakeKind::Sign => "sign",
            MistakeKind::Coefficient => "coefficient",
            MistakeKind::Dot => "dot",
            MistakeKind::Index => "index",
            MistakeKind::Function => "function",
            MistakeKind::Power => "power",
            MistakeKind::MissingFactor => "missing factor",
            MistakeKind::ExtraFactor => "extra factor",
            MistakeKind::Factor => "factor",
        }
    }

    /// A number of mistakes of the kind in words, such as `1 sign` or `9 indices`.
    #[must_use]
    pub fn counted(self, count: usize) -> String {
        match (self, count) {
            (_, 1) => format!("1 {}", self.name()),
            (MistakeKind::Index, _) => format!("{count} indices"),
            _ => format!("{count} {}s", self.name()),
        }
    }
}

/// One mistake in a term.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// The kind of the mistake.
    pub kind: MistakeKind,
    /// The printed part, if the mistake concerns a part of the term.
    pub printed: Option<String>,
    /// The derived part in place of the printed one.
    pub derived: Option<String>,
}

/// The text of the mistake, such as `dot: qd1 for qdd1`, `missing factor: cos(q2)` or `sign`.
impl fmt::Display for Mistake {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.kind.name())?;
        match (&self.printed, &self.derived) {
            (Some(printed), Some(derived)) => write!(formatter, ": {printed} for {derived}"),
            (Some(one), None) | (None, Some(one)) => write!(formatter, ": {one}"),
            (None, None) => Ok(()),
        }
    }
}

/// A factor of one term that the other term does not have to the same power: the remaining power.
type Odd<'g> = Power<'g>;

/// The mistakes in a printed term compared with a derived one. If only one of them is given, it has no counterpart.
pub(super) fn mistakes(printed: Option<&Term<'_>>, derived: Option<&Term<'_>>) -> Vec<Mistake> {
    let bare = |kind| Mistake { kind, printed: None, derived: None };
    let (printed, derived) = match (printed, derived) {
        (Some(printed), Some(derived)) => (printed, derived),
        (Some(_), None) => return vec![bare(MistakeKind::ExtraTerm)],
        (None, _) => return vec![bare(MistakeKind::MissingTerm)],
    };
    let mut mistakes = vec![];
    if printed.stands_for(&-&derived.coefficient) {
        mistakes.push(bare(MistakeKind::Sign));
    } else if !printed.stands_for(&derived.coefficient) {
        let [one, other] = [printed, derived].map(|term| Some(term.coefficient_text()));
        mistakes.push(Mistake { kind: MistakeKind::Coefficient, printed: one, derived: other });
    }
    let (mut gone, mut come) = (odd(printed, derived), odd(derived, printed));
    powers(printed, derived, &mut gone, &mut come, &mut mistakes);
    while let Some((i, j, kind)) = related(&gone, &come) {
        mistakes.push(replaced(kind, &gone.remove(i), &come.remove(j)));
    }
    if let ([one], [other]) = (gone.as_slice(), come.as_slice()) {
        mistakes.push(replaced(MistakeKind::Factor, one, other));
        return mistakes;
    }
    let one = |kind, printed, derived| Mistake { kind, printed, derived };
    let extra = gone.iter().map(|odd| one(MistakeKind::ExtraFactor, Some(odd.to_string()), None));
    let missing =
        come.iter().map(|odd| one(MistakeKind::MissingFactor, None, Some(odd.to_string())));
    mistakes.extend(extra.chain(missing));
    mistakes
}

fn replaced(kind: MistakeKind, printed: &Power<'_>, derived: &Power<'_>) -> Mistake {
    Mistake { kind, printed: Some(printed.to_string()), derived: Some(derived.to_string()) }
}

/// The factors of a term that remain after the factors common with another term are removed.
fn odd<'g>(term: &Term<'g>, other: &Term<'g>) -> Vec<Odd<'g>> {
    let beyond = term.factors.iter().filter_map(|power| {
        let common = other.exponent(power.atom);
        let exponent = if power.exponent.signum() == common.signum() {
            power.exponent.saturating_sub(common)
        } else {
            power.exponent
        };
        (exponent.signum() == power.exponent.signum()).then_some(Power { exponent, ..*power })
    });
    beyond.collect()
}

/// Removes the factors that both terms have to different powers and records them as mistakes, unless some of the
/// remaining factors are easily confused.
fn powers<'g>(
    printed: &Term<'g>,
    derived: &Term<'g>,
    gone: &mut Vec<Odd<'g>>,
    come: &mut Vec<Odd<'g>>,
    mistakes: &mut Vec<Mistake>,
) {
    if related(gone, come).is_some() {
        return;
    }
    for side in [gone, come] {
        side.retain(|power| {
            let [one, other] = [printed, derived].map(|term| term.exponent(power.atom));
            if one == 0 || other == 0 {
                return true;
            }
            let raised = |exponent| Power { exponent, ..*power };
            mistakes.push(replaced(MistakeKind::Power, &raised(one), &raised(other)));
            false
        });
    }
}

/// The first two factors that are easily confused.
fn related(gone: &[Odd<'_>], come: &[Odd<'_>]) -> Option<(usize, usize, MistakeKind)> {
    let pairs = (0..gone.len()).flat_map(|i| (0..come.len()).map(move |j| (i, j)));
    pairs.into_iter().find_map(|(i, j)| {
        let (one, other) = (gone.get(i)?, come.get(j)?);
        let same = one.exponent == other.exponent;
        likeness(one.atom, other.atom).filter(|_| same).map(|kind| (i, j, kind))
    })
}

/// The kind of mistake that turns one of two similar atoms into the other.
fn likeness(one: Expr<'_>, other: Expr<'_>) -> Option<MistakeKind> {
    match (one.view(), other.view()) {
        (View::Symbol(a), View::Symbol(b)) => {
            names_differ(&one.graph().symbol_name(a), &other.graph().symbol_name(b))
        }
        (View::Call(_, a), View::Call(_, b)) if a == b => Some(MistakeKind::Function),
        (View::Call(f, a), View::Call(g, b)) if f == g => {
            // Angles are mostly single symbols; different sums count as a wrong index.
            likeness(a, b).or(Some(MistakeKind::Index))
        }
        _ => None,
    }
}

fn names_differ(one: &str, other: &str) -> Option<MistakeKind> {
    let motion = |name: &str| {
        JointVariable::parse(name).filter(|(variable, _)| JointVariable::MOTION.contains(variable))
    };
    if let (Some((one, i)), Some((other, j))) = (motion(one), motion(other)) {
        return match (one == other, i == j) {
            (false, true) => Some(MistakeKind::Dot),
            (true, _) => Some(MistakeKind::Index),
            (false, false) => None,
        };
    }
    let stem = |name: &str| name.trim_end_matches(|c: char| c.is_ascii_digit()).to_owned();
    let (a, b) = (stem(one), stem(other));
    // The symbols have different numbers, or differ in one letter after the first.
    let alike = one.len() == other.len()
        && one.bytes().zip(other.bytes()).skip(1).filter(|(x, y)| x != y).count() == 1
        && one.bytes().next() == other.bytes().next();
    (a == b || alike).then_some(MistakeKind::Index)
}
