//! The strokes of curves: colors, and dashes for curves that would otherwise hide each other.

use super::{Axis, Curve};

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    /// The number of the color.
    pub(super) color: usize,
    /// Whether the curve is the sum of others.
    pub(super) is_sum: bool,
    /// The dashes; `None` for a solid line.
    pub(super) dashes: Option<Dashes>,
}

/// The dashes of a line, in px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dashes {
    /// The length of a dash.
    pub(super) length: f64,
    /// The distance between the beginnings of two dashes.
    pub(super) period: f64,
}

/// The number of different colors of curves that are not sums.
pub(super) const COLORS: usize = 6;

/// The dashes of curves whose colors occur for the second and for the third time.
const AGAIN: [Dashes; 2] =
    [Dashes { length: 8.0, period: 12.0 }, Dashes { length: 3.0, period: 4.5 }];

/// The distance between the beginnings of the dashes of curves that lie on another curve, in px.
const PERIOD: f64 = 16.0;
/// What is added to this distance each time that a color occurs again, in px.
const LONGER: f64 = 8.0;
/// The number of curves on each other that have different dashes; further ones have those of the last.
const LAYERS: i32 = 4;
/// The distance within which one curve hides another, in px.
const NEAR: f64 = 1.0;
/// The largest fraction of the plotted time for which a solid curve may hide another; beyond it, the curve is dashed. Where
/// the curves differ, both are visible anyway.
const SHARE: f64 = 0.3;

/// The strokes of the curves of a panel, in their order, and the order in which they are drawn: sums first. `up` is the
/// number of pixels per unit of the axis of values.
///
/// A curve that lies on an earlier one is dashed, so that both are seen; a third one has shorter dashes, which leave
/// parts of the second visible.
pub(super) fn strokes(
    t: &[f64],
    curves: &[Curve],
    axis: &Axis,
    up: f64,
) -> (Vec<Stroke>, Vec<usize>) {
    let (sums, others): (Vec<usize>, Vec<usize>) =
        (0..curves.len()).partition(|index| curves[*index].is_sum);
    let order: Vec<usize> = sums.into_iter().chain(others).collect();
    let mut layers = vec![0_i32; curves.len()];
    for (place, index) in order.iter().enumerate() {
        let below = order.iter().take(place);
        let below = below.filter(|below| hides(t, &curves[*index], &curves[**below], axis, up));
        layers[*index] = below.map(|below| layers[*below] + 1).max().unwrap_or(0);
    }
    let strokes = curves.iter().zip(layers).map(|(curve, layer)| stroke(curve, layer));
    (strokes.collect(), order)
}

/// The stroke of a curve that lies on no other.
pub(super) fn bare(curve: &Curve) -> Stroke {
    stroke(curve, 0)
}

/// The stroke of a curve with as many curves below it as `layer` says.
fn stroke(curve: &Curve, layer: i32) -> Stroke {
    let again = curve.color / COLORS;
    let dashes = match (layer, again) {
        (0, 0) => None,
        (0, again) => AGAIN.get((again - 1).min(AGAIN.len() - 1)).copied(),
        (layer, again) => {
            let period = PERIOD + LONGER * again as f64;
            Some(Dashes { length: period / 2_f64.powi(layer.min(LAYERS)), period })
        }
    };
    Stroke { color: curve.color % COLORS, is_sum: curve.is_sum, dashes }
}

/// Whether a curve, drawn solid, would hide another for more than [`SHARE`] of the time.
fn hides(t: &[f64], curve: &Curve, other: &Curve, axis: &Axis, up: f64) -> bool {
    let is_near = |index: usize| match (curve.values.get(index), other.values.get(index)) {
        (Some(one), Some(other)) => (axis.scaled(*one) - axis.scaled(*other)).abs() * up <= NEAR,
        _ => false,
    };
    let mut hidden = 0.0;
    for (index, ends) in t.windows(2).enumerate() {
        if is_near(index) && is_near(index + 1) {
            hidden += ends[1] - ends[0];
        }
    }
    let whole = t.last().zip(t.first()).map_or(0.0, |(last, first)| last - first);
    whole > 0.0 && hidden > SHARE * whole
}

/// The dashes of a line through points.
pub(super) fn dashed(points: &[(f64, f64)], dashes: &Dashes) -> Vec<Vec<(f64, f64)>> {
    let Dashes { length, period } = *dashes;
    let mut pieces = vec![];
    let mut piece: Vec<(f64, f64)> = points.first().copied().into_iter().collect();
    // The position within the period.
    let mut at = 0.0;
    for ends in points.windows(2) {
        let ((x0, y0), (x1, y1)) = (ends[0], ends[1]);
        let whole = (x1 - x0).hypot(y1 - y0);
        let point = |done: f64| (x0 + (x1 - x0) * done / whole, y0 + (y1 - y0) * done / whole);
        let mut done = 0.0;
        while done < whole {
            let is_dash = at < length;
            let left = if is_dash { length - at } else { period - at };
            let step = left.min(whole - done);
            done += step;
            if is_dash {
                piece.push(point(done));
            }
            if step < left {
                at += step;
                break;
            }
            // A dash or a gap ends here.
            match is_dash {
                true => pieces.push(std::mem::take(&mut piece)),
                false => piece = vec![point(done)],
            }
            at = if is_dash { length } else { 0.0 };
        }
    }
    pieces.push(piece);
    pieces.retain(|piece| piece.len() > 1);
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(color: usize, values: &[f64], is_sum: bool) -> Curve {
        Curve { name: String::new(), values: values.to_vec(), is_sum, color }
    }

    const AXIS: Axis = Axis { low: 0.0, high: 1.0, exponent: 0 };

    fn lengths(curves: &[Curve]) -> Vec<Option<f64>> {
        let (strokes, _) = strokes(&[0.0, 1.0, 2.0], curves, &AXIS, 100.0);
        strokes.iter().map(|stroke| stroke.dashes.map(|dashes| dashes.length)).collect()
    }

    #[test]
    fn curves_on_each_other_have_different_dashes() {
        let low = [0.1, 0.2, 0.3];
        let high = [0.9, 0.8, 0.7];
        let both = [curve(0, &low, false), curve(1, &high, false)];
        assert_eq!(lengths(&both), [None, None]);
        let three = [curve(0, &low, false), curve(1, &high, false), curve(2, &low, false)];
        assert_eq!(lengths(&three), [None, None, Some(8.0)]);
        let same = [0, 1, 2].map(|color| curve(color, &low, false));
        assert_eq!(lengths(&same), [None, Some(8.0), Some(4.0)]);
        // Where a color occurs again, the dashes are others.
        let again = [curve(0, &low, false), curve(1, &low, false), curve(7, &low, false)];
        let again = [&again[..], &[curve(2, &high, false), curve(7, &high, false)]].concat();
        assert_eq!(lengths(&again), [None, Some(8.0), Some(6.0), None, Some(12.0)]);
    }

    #[test]
    fn a_sum_is_below_its_only_part() {
        let values = [0.1, 0.2, 0.3];
        let curves = [curve(0, &values, false), curve(1, &values, true)];
        assert_eq!(lengths(&curves), [Some(8.0), None]);
        let (_, order) = strokes(&[0.0, 1.0, 2.0], &curves, &AXIS, 100.0);
        assert_eq!(order, [1, 0]);
    }

    #[test]
    fn curves_that_cross_or_part_or_have_no_values_stay_solid() {
        let crossing = [curve(0, &[0.0, 0.5, 1.0], false), curve(1, &[1.0, 0.5, 0.0], false)];
        assert_eq!(lengths(&crossing), [None, None]);
        let parting = [curve(0, &[0.1, 0.1, 0.9], false), curve(1, &[0.1, 0.1, 0.2], false)];
        let (strokes, _) = strokes(&[0.0, 0.2, 1.0], &parting, &AXIS, 100.0);
        assert!(strokes.iter().all(|stroke| stroke.dashes.is_none()));
        let none = [curve(0, &[f64::NAN; 3], false), curve(1, &[f64::NAN; 3], false)];
        assert_eq!(lengths(&none), [None, None]);
        assert_eq!(lengths(&[curve(0, &[], false), curve(1, &[], false)]), [None, None]);
        assert_eq!(lengths(&[curve(6, &[0.1; 3], false)]), [Some(8.0)]);
    }

    #[test]
    fn dashes_go_around_corners() {
        let line = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)];
        let pieces = dashed(&line, &Dashes { length: 6.0, period: 8.0 });
        let expected: [&[(f64, f64)]; 3] = [
            &[(0.0, 0.0), (6.0, 0.0)],
            &[(8.0, 0.0), (10.0, 0.0), (10.0, 4.0)],
            &[(10.0, 6.0), (10.0, 10.0)],
        ];
        assert_eq!(pieces, expected);
        assert_eq!(dashed(&[], &Dashes { length: 6.0, period: 8.0 }).len(), 0);
        assert_eq!(dashed(&[(1.0, 1.0); 3], &Dashes { length: 6.0, period: 8.0 }).len(), 0);
    }
}
