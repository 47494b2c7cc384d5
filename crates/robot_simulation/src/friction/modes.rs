//! The choice of which coordinates at rest stay at rest, and of the directions in which the others start to move.

use super::{Balance, Mode, balance};
use crate::dynamics::{DryFriction, State};
use crate::error::Cause;

/// The largest number of exchanges of modes. Without load-dependent friction a few are enough, and the method
/// terminates.
const MAX_EXCHANGES: usize = 300;
/// The largest number of combinations of modes that are tried one by one: those of five coordinates at rest.
const MAX_TRIED: usize = 243;
/// The number of exchanges of all wrong modes that do not reduce their number before only one is exchanged.
const PATIENCE: usize = 5;

/// The first guess: coordinates with a velocity slide, and those at rest stay at rest.
pub(crate) fn starting(friction: &dyn DryFriction, qd: &[f64]) -> Vec<Mode> {
    let mode = |(qd, can_stick): (&f64, &bool)| match (can_stick, *qd == 0.0) {
        (false, _) => Mode::Free,
        (true, true) => Mode::Held,
        (true, false) => Mode::Sliding(qd.signum()),
    };
    qd.iter().zip(friction.can_stick()).map(mode).collect()
}

/// Chooses modes that are consistent with the accelerations that they cause: the friction of held coordinates can
/// supply the required force, and the others start to move in the direction of their mode. `guess` has a first guess of
/// all modes ([`starting`]); the modes of coordinates that move are kept.
///
/// This is a linear complementarity problem with bounds and the positive definite matrix M⁻¹. All wrong modes are
/// exchanged at once and, if their number does not decrease, one by one (Júdice and Pires, Computers & Operations
/// Research 21, 1994), which terminates. Load-dependent friction makes the problem nonlinear. Then the method need not
/// terminate, and if there are only a few coordinates, all combinations are tried.
///
/// # Errors
///
/// [`Cause::Friction`] if no consistent modes exist or are found, and the errors of [`balance`].
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
    first_consistent(friction, state, tau, guess, &at_rest)
}

/// The coordinates at rest whose modes are not consistent with the accelerations, and the modes to try instead.
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

/// Tries all combinations of modes of the coordinates at rest.
fn first_consistent(
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

#[cfg(test)]
mod tests {
    use super::{Balance, Mode, chosen, starting};
    use crate::dynamics::{DryFriction, State};
    use crate::error::Cause;

    /// Constant dry friction on coordinates with a constant mass matrix.
    struct Rubbing {
        mass: Vec<f64>,
        limits: Vec<f64>,
        can_stick: Vec<bool>,
    }

    impl DryFriction for Rubbing {
        fn can_stick(&self) -> &[bool] {
            &self.can_stick
        }

        fn is_by_load(&self) -> bool {
            false
        }

        fn mass_matrix(&self, _: &[f64]) -> Result<Vec<f64>, Cause> {
            Ok(self.mass.clone())
        }

        fn joint_torques(
            &self,
            state: &State,
            qdd: &[f64],
            friction: bool,
        ) -> Result<Vec<f64>, Cause> {
            let rows = self.mass.chunks(qdd.len()).zip(&state.qd).zip(&self.limits);
            let force = |((row, qd), limit): ((&[f64], &f64), &f64)| {
                let inertia: f64 = row.iter().zip(qdd).map(|(m, qdd)| m * qdd).sum();
                inertia + if friction { limit * qd.signum() } else { 0.0 }
            };
            Ok(rows.map(force).collect())
        }
    }

    /// The modes of coordinates at rest and their accelerations.
    fn at_rest(mass: Vec<f64>, limits: Vec<f64>, tau: &[f64]) -> (Vec<Mode>, Balance) {
        let can_stick = vec![true; tau.len()];
        let rubbing = Rubbing { mass, limits, can_stick };
        let state = State { q: vec![0.0; tau.len()], qd: vec![0.0; tau.len()] };
        chosen(&rubbing, &state, tau, starting(&rubbing, &state.qd)).unwrap()
    }

    /// If both are held, the friction of neither is enough. If both are free, the second moves backward, so the motion
    /// of the first holds it.
    #[test]
    fn what_sets_off_the_wrong_way_is_held() {
        let (modes, found) = at_rest(vec![4.0, 1.0, 1.0, 1.0], vec![1.0; 2], &[9.0, 1.2]);
        assert_eq!(modes, [Mode::Sliding(1.0), Mode::Held]);
        assert_eq!(found.qdd, [2.0, 0.0]);
    }

    /// The friction λ = τ − M q̈ is within its limits; it is at the limit that opposes the acceleration if there is
    /// one.
    #[test]
    fn friction_is_within_its_limits_and_against_what_sets_off() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 33) as f64 / f64::from(u32::MAX >> 1) * 2.0 - 1.0
        };
        let (mut held, mut slid) = (0, 0);
        for case in 0..300 {
            let count = 1 + case % 12;
            let factor: Vec<f64> = (0..count * count).map(|_| random()).collect();
            let entry = |i: usize, j: usize| -> f64 {
                let dot: f64 =
                    (0..count).map(|k| factor[i * count + k] * factor[j * count + k]).sum();
                dot + if i == j { 0.01 } else { 0.0 }
            };
            let mass: Vec<f64> = (0..count * count).map(|n| entry(n / count, n % count)).collect();
            let limits: Vec<f64> = (0..count).map(|_| random().abs()).collect();
            let tau: Vec<f64> = (0..count).map(|_| 2.0 * random()).collect();
            let (_, Balance { qdd, .. }) = at_rest(mass.clone(), limits.clone(), &tau);
            for (i, row) in mass.chunks(count).enumerate() {
                let friction = tau[i] - row.iter().zip(&qdd).map(|(m, qdd)| m * qdd).sum::<f64>();
                assert!(friction.abs() <= limits[i] + 1e-9, "{friction} of {}", limits[i]);
                if qdd[i] == 0.0 {
                    held += 1;
                } else {
                    slid += 1;
                    let expected = limits[i] * qdd[i].signum();
                    assert!((friction - expected).abs() < 1e-9, "{friction} is not {expected}");
                }
            }
        }
        assert!(held > 200 && slid > 200, "{held} and {slid}");
    }
}
