//! The panels of a figure as they are drawn: their heights and axes, the strokes of their curves and of their legends.

use super::strokes::{Stroke, bare, strokes};
use super::{Axis, Figure, Panel};

/// The smallest height of a panel, in px.
pub(super) const PANEL: u32 = 190;
/// The distance of a legend from the top of its panel, and the height of its rows, in px.
pub(super) const MARGIN: u32 = 12;
pub(super) const ROW: u32 = 21;
/// The most rows of a legend; robots have at most 64 coordinates.
const MOST_ROWS: u32 = 64;

/// A panel as it is drawn.
pub(super) struct Shown<'f> {
    /// The panel.
    pub(super) panel: &'f Panel,
    /// The height, in px, in which the legend has room.
    pub(super) height: u32,
    /// The axis of its values.
    pub(super) axis: Axis,
    /// The number of pixels per unit of the axis.
    pub(super) up: f64,
    /// The strokes of its curves.
    pub(super) strokes: Vec<Stroke>,
    /// The order in which its curves are drawn.
    pub(super) order: Vec<usize>,
    /// The strokes that its legend shows, if it has one.
    pub(super) legend: Option<Vec<Stroke>>,
}

/// The panels of a figure. If several have the same curves, one legend is enough, beside the first; it shows no dashes
/// of curves that lie on each other, which differ between panels. Otherwise each panel has its own legend.
pub(super) fn panels(figure: &Figure) -> Vec<Shown<'_>> {
    let is_shared = figure.panels.len() > 1
        && figure.panels.windows(2).all(|pair| looks(&pair[0]) == looks(&pair[1]));
    let shown = |(index, panel): (usize, _)| shown(&figure.t, panel, is_shared, index == 0);
    figure.panels.iter().enumerate().map(shown).collect()
}

fn shown<'f>(t: &[f64], panel: &'f Panel, is_shared: bool, is_first: bool) -> Shown<'f> {
    let has_legend = is_first || !is_shared;
    let rows = u32::try_from(panel.curves.len()).unwrap_or(u32::MAX).min(MOST_ROWS);
    let height = if has_legend { PANEL.max(2 * MARGIN + rows * ROW) } else { PANEL };
    let axis = Axis::of(panel.curves.iter().flat_map(|curve| curve.values.iter().copied()));
    let up = f64::from(height) / (axis.high - axis.low);
    let (strokes, order) = strokes(t, &panel.curves, &axis, up);
    let legend = has_legend.then(|| match is_shared {
        true => panel.curves.iter().map(bare).collect(),
        false => strokes.clone(),
    });
    Shown { panel, height, axis, up, strokes, order, legend }
}

/// What a legend shows of the curves of a panel.
fn looks(panel: &Panel) -> Vec<(&str, bool, usize)> {
    panel.curves.iter().map(|curve| (curve.name.as_str(), curve.is_sum, curve.color)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Curve;

    #[test]
    fn panels_of_the_same_curves_have_one_legend() {
        let curve =
            |name: &str| Curve { name: name.to_owned(), values: vec![0.5; 2], ..Curve::default() };
        let panel = |names: &[&str]| Panel {
            curves: names.iter().map(|name| curve(name)).collect(),
            ..Panel::default()
        };
        let figure = |panels: Vec<Panel>| Figure { t: vec![0.0, 1.0], panels, ..Figure::default() };
        let count = |figure: &Figure| {
            let svg = figure.svg().unwrap();
            ["inertia", "gravity"].map(|name| svg.matches(name).count())
        };
        let same = figure(vec![panel(&["inertia", "gravity"]); 3]);
        assert_eq!(count(&same), [1, 1]);
        let other = figure(vec![panel(&["inertia"]), panel(&["inertia", "gravity"])]);
        assert_eq!(count(&other), [2, 1]);
        // Both curves are seen in each panel, and the legend of all shows their colors.
        for shown in panels(&same) {
            let are_dashed = shown.strokes.iter().map(|stroke| stroke.dashes.is_some());
            assert_eq!(are_dashed.collect::<Vec<_>>(), [false, true]);
            assert!(shown.legend.iter().flatten().all(|stroke| stroke.dashes.is_none()));
        }
    }
}
