//! The search for the end of a mode within a step.

use crate::system::Overrun;

/// An interval of time in which a mode ends. At its start, the [`Base`], all coordinates are in their modes; at its
/// end, which is stored here, some are beyond them.
#[derive(Clone, Debug)]
pub(crate) struct Bracket {
    t: f64,
    y: Vec<f64>,
    overruns: Vec<Overrun>,
    /// The number of steps that have been tried within the interval.
    tries: usize,
}

/// A time at which all coordinates are in their modes.
pub(crate) struct Base<'s> {
    pub(crate) t: f64,
    pub(crate) y: &'s [f64],
    pub(crate) overruns: &'s [Overrun],
}

/// An event: the end of one or more modes.
pub(crate) struct Event {
    pub(crate) t: f64,
    pub(crate) y: Vec<f64>,
    /// The coordinates whose modes end.
    pub(crate) ended: Vec<usize>,
}

/// Whether a coordinate is beyond the end of its mode.
pub(crate) fn any_ended(overruns: &[Overrun]) -> bool {
    overruns.iter().any(|overrun| overrun.value > 0.0)
}

impl Bracket {
    /// The interval that ends at a time when some coordinates are beyond the ends of their modes; `earlier` is the
    /// interval within which this time was found.
    pub(crate) fn new(
        t: f64,
        y: &[f64],
        overruns: Vec<Overrun>,
        earlier: Option<&Bracket>,
    ) -> Bracket {
        let tries = earlier.map_or(0, |earlier| earlier.tries);
        Bracket { t, y: y.to_vec(), overruns, tries }
    }

    /// The length of the next step to try from the last state before the end of a mode. It leads to the time at which secants predict the first end of
    /// a mode; every third step leads to the middle, so that the interval always shrinks.
    pub(crate) fn step(&mut self, base: &Base<'_>, shortest: f64) -> f64 {
        self.tries += 1;
        let whole = self.t - base.t;
        let to_end = |(before, after): (&Overrun, &Overrun)| {
            // The step aims slightly beyond the end, so that the mode has ended there.
            let aim = after.value.min(after.tolerance) / 2.0;
            let part = (aim - before.value) / (after.value - before.value);
            (after.value > 0.0).then_some(if before.value < 0.0 { part } else { 0.5 })
        };
        let parts = base.overruns.iter().zip(&self.overruns).filter_map(to_end);
        let part = parts.fold(1.0, f64::min);
        let part = if self.tries.is_multiple_of(3) || part >= 1.0 { 0.5 } else { part };
        (whole * part).max(shortest / 2.0).min(whole)
    }

    /// The end of the mode, if it is known precisely enough: no coordinate is far beyond its end, or the interval is so
    /// short that everything within it is linear in time.
    pub(crate) fn event(&self, base: &Base<'_>, shortest: f64) -> Option<Event> {
        let ended = self.overruns.iter().enumerate().filter(|(_, overrun)| overrun.value > 0.0);
        let ended: Vec<usize> = ended.map(|(index, _)| index).collect();
        let near = |index: &usize| {
            let overrun = &self.overruns[*index];
            overrun.value <= overrun.tolerance
        };
        if ended.iter().all(near) {
            return Some(Event { t: self.t, y: self.y.clone(), ended });
        }
        if self.t - base.t > shortest {
            return None;
        }
        let part = |index: usize| match base.overruns.get(index).map(|overrun| overrun.value) {
            Some(before) if before < 0.0 => before / (before - self.overruns[index].value),
            _ => 0.0,
        };
        let first = ended.iter().map(|index| part(*index)).fold(1.0, f64::min);
        let between = |(from, to): (&f64, &f64)| from + (to - from) * first;
        let y = base.y.iter().zip(&self.y).map(between).collect();
        let ended = ended.into_iter().filter(|index| part(*index) <= first).collect();
        Some(Event { t: self.t, y, ended })
    }
}
