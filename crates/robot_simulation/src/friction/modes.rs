//! Which coordinates at rest stay there, and in which direction the others set off.

use super::{Balance, Mode, balance};
use crate::dynamics::{DryFriction, State};
use crate::error::Cause;

/// The most exchanges of modes. Without friction by load a few are enough, and the end is certain.
const MAX_EXCHANGES: usize = 300;
/// The most modes of all coordinates at rest that are tried one by one: those of five coordinates.
const MAX_TRIED: usize = 243;
/// Rounds in which all wrong modes are exchanged though that makes them no fewer.
const PATIENCE: usize = 5;

/// The first guess: what moves slides, what is at rest stays.
pub(crate) fn starting(friction: &dyn DryFriction, qd: &[f64]) -> Vec<Mode> {
    let mode = |(qd, can_stick): (&f64, &bool)| match (can_stick, *qd == 0.0) {
        (false, _) => Mode::Free,
        (true, true) => Mode::Held,
        (true, false) => Mode::Sliding(qd.signum()),
    };
    qd.iter().zip(friction.can_stick()).map(mode).collect()
}

/// The modes of a state that agree with the accelerations that they bring about: what is held asks no
/// more of its friction than that can give, and what sets off does so in its direction. `guess` has
/// the modes of the coordinates that move.
///
/// It is a linear complementarity problem with bounds, whose matrix M⁻¹ is positive definite, and is
/// solved by exchanging all wrong modes at once and, where these become no fewer, one by one (Júdice
/// and Pires, Computers & Operations Research 21, 1994), which ends. Friction by load makes it
/// nonlinear; then the end is not certain, and few coordinates are tried out.
///
/// # Errors
///
/// [`Cause::Friction`] where no modes agree, or none is found; those of [`balance`].
pub(crate) fn chosen(
    friction: &dyn DryFriction,
    state: &State,
    tau: &[f64],
    mut guess: Vec<Mode>,
) -> Result<(Vec<Mode>, Balance), Cause> {
    let at_rest: Vec<usize> = (0..guess.len())
        .filter(|index| guess[*index] != Mode::Free && state.qd[*index] == 0.0)
        .collect();
    let (mut fewest, mut patience) = (usize::MAX, PATIENCE);
    for _ in 0..MAX_EXCHANGES {
        let found = match balance(friction, state, tau, &guess) {
            Ok(found) => found,
            Err(Cause::Friction) => break,
            Err(cause) => return Err(cause),
        };
        let wrong = wrong(&at_rest, &guess, &found);
        if wrong.is_empty() {
            return Ok((guess, found));
        }
        let all = wrong.len() < fewest || patience > 0;
        patience = if wrong.len() < fewest { PATIENCE } else { patience.saturating_sub(1) };
        fewest = fewest.min(wrong.len());
        let exchanged = if all { &wrong[..] } else { &wrong[wrong.len() - 1..] };
        for (index, mode) in exchanged {
            guess[*index] = *mode;
        }
    }
    tried(friction, state, tau, guess, &at_rest)
}

/// The coordinates at rest whose modes do not agree with the accelerations, and what to try instead.
fn wrong(at_rest: &[usize], modes: &[Mode], found: &Balance) -> Vec<(usize, Mode)> {
    let size = found.qdd.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
    let other = |index: &usize| match (modes[*index], &found.holding[*index]) {
        (Mode::Held, Some(holding)) => {
            let holds = holding.excess() <= 0.0;
            (!holds).then(|| (*index, Mode::Sliding(holding.direction())))
        }
        (Mode::Sliding(direction), _) => {
            let follows = direction * found.qdd[*index] >= -1e-12 * size;
            (!follows).then_some((*index, Mode::Held))
        }
        _ => None,
    };
    at_rest.iter().filter_map(other).collect()
}

/// All modes of the coordinates at rest, one by one.
fn tried(
    friction: &dyn DryFriction,
    state: &State,
    tau: &[f64],
    mut modes: Vec<Mode>,
    at_rest: &[usize],
) -> Result<(Vec<Mode>, Balance), Cause> {
    const CHOICES: [Mode; 3] = [Mode::Held, Mode::Sliding(1.0), Mode::Sliding(-1.0)];
    let count = u32::try_from(at_rest.len()).ok().and_then(|count| 3_usize.checked_pow(count));
    let Some(count) = count.filter(|count| *count <= MAX_TRIED) else {
        return Err(Cause::Friction);
    };
    for number in 0..count {
        let mut digits = number;
        for index in at_rest {
            modes[*index] = CHOICES[digits % 3];
            digits /= 3;
        }
        match balance(friction, state, tau, &modes) {
            Ok(found) if wrong(at_rest, &modes, &found).is_empty() => return Ok((modes, found)),
            Ok(_) | Err(Cause::Friction) => {}
            Err(cause) => return Err(cause),
        }
    }
    Err(Cause::Friction)
}
