//! The kinematic scheme, as in figure 3 of the paper: joints with the symbols of revolute and prismatic joints, frames
//! with their axes, offsets as dimension lines, and links with their names.
//!
//! `layout` places the robot at q = 0 on the page, `view` chooses the direction from which it is seen, `symbols` draws
//! the symbols, `writing` writes dimensions and labels, `labels` finds space for them, and
//! `settling` chooses among the places.

mod draw;
mod labels;
mod layout;
mod pdf;
mod picture;
mod settling;
mod shape;
mod style;
mod symbols;
mod view;
mod writing;

use robot_document::figure::Figure;
use robot_document::markup::Element;
use robot_model::robot::Robot;

pub use pdf::scheme_pdf;
pub use picture::scheme_picture;

pub(crate) use layout::drawn_frames;
pub(crate) use view::upright;

use layout::{Layout, confusion, layout, tallness};
use view::View;

/// The scheme as SVG.
pub(crate) struct Picture {
    /// The SVG element.
    pub(crate) element: Element,
    /// The width in pixels.
    pub(crate) width: f64,
    /// The height in pixels.
    pub(crate) height: f64,
}

/// Draws the scheme as SVG.
pub(crate) fn scheme(robot: &Robot) -> Picture {
    let (layout, view) = best(robot);
    draw::Drawing::of(robot, &layout, view).build()
}

/// The caption of the scheme.
pub(crate) const CAPTION: &str = "The robot at q = 0. Cylinders rotate about their axes, boxes slide along \
    their guides; the arrow on or beside an axis points in the positive direction of its \
    coordinate. Directions are true; short offsets are enlarged, and joints at the same point are drawn \
    apart along a dotted line.";

/// Draws the scheme with lines, curves and labels, for documents.
#[must_use]
pub fn figure(robot: &Robot) -> Figure {
    let (layout, view) = best(robot);
    draw::Drawing::of(robot, &layout, view).figure(CAPTION)
}

/// The factor by which the offsets of a crowded robot are enlarged.
const ENLARGED: f64 = 1.25;
/// The least decrease of the faults for which they are enlarged, and the greatest height of joints and frames above
/// each other, so that the scheme stays within a screen.
const GAIN: f64 = 300.0;
const TALLEST: f64 = 480.0;

/// The layout and the view with the fewest faults.
fn best(robot: &Robot) -> (Layout, View) {
    let (usual, faults) = least(robot, 1.0);
    let (enlarged, rest) = least(robot, ENLARGED);
    let is_better = rest + GAIN < faults && tallness(&enlarged.0, &enlarged.1) <= TALLEST;
    if is_better { enlarged } else { usual }
}

/// The layout with offsets enlarged by a factor and the view with the fewest faults, and these.
fn least(robot: &Robot, enlarged: f64) -> ((Layout, View), f64) {
    let [first, others @ ..] =
        view::views(robot).map(|view| (layout(robot, &view, enlarged), view));
    let blame = |(layout, view): &(Layout, View)| confusion(layout, view);
    let mut best = (blame(&first), first);
    for other in others {
        let found = blame(&other);
        if found < best.0 {
            best = (found, other);
        }
    }
    (best.1, best.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The robots of this project.
    fn robots() -> Vec<Robot> {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots");
        let mut paths: Vec<_> =
            std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        paths.retain(|path| path.extension().is_some_and(|end| end == "toml"));
        paths.sort();
        let read = |path: &std::path::PathBuf| {
            let text = std::fs::read_to_string(path).unwrap();
            robot_model::description::read_toml("robot.toml", &text).unwrap().robot
        };
        paths.iter().map(read).collect()
    }

    /// Symbols and letters keep their sizes, so that a crowded robot is drawn larger, but not one that is tall.
    #[test]
    fn crowded_robots_are_enlarged() {
        for robot in robots() {
            let (drawn, view) = best(&robot);
            let usual = layout(&robot, &view, 1.0);
            let ratio = tallness(&drawn, &view) / tallness(&usual, &view);
            assert_eq!(ratio > 1.1, robot.name == "ur5", "{}: {ratio}", robot.name);
        }
    }

    #[test]
    fn no_label_lies_on_another() {
        for robot in robots() {
            let (layout, view) = best(&robot);
            let labels = draw::Drawing::of(&robot, &layout, view).labels();
            for (index, (words, label, _)) in labels.iter().enumerate() {
                for (others, other, _) in &labels[index + 1..] {
                    let overlap = label.overlap(other);
                    assert!(overlap < 0.5, "{}: {words} on {others}: {overlap}", robot.name);
                }
            }
        }
    }

    #[test]
    fn a_length_between_two_joints_is_drawn_once() {
        for (name, length, count) in
            [("ur5", "0.0823 m", 1), ("panda", "0.0825 m", 1), ("panda", "0.384 m", 1)]
        {
            let robot = robots().into_iter().find(|robot| robot.name == name).unwrap();
            let (layout, view) = best(&robot);
            let labels = draw::Drawing::of(&robot, &layout, view).labels();
            let found = labels.iter().filter(|(words, ..)| words == length).count();
            assert_eq!(found, count, "{name}: {length}");
        }
    }

    /// Lines of links, joints and dimensions leave names and lengths readable.
    #[test]
    fn no_line_runs_through_a_label() {
        for robot in robots() {
            let (layout, view) = best(&robot);
            for (words, _, crossed) in draw::Drawing::of(&robot, &layout, view).labels() {
                let is_letter = ["x", "y", "z"].contains(&words.as_str());
                assert!(is_letter || crossed < 2.0, "{}: {words}, {crossed}", robot.name);
            }
        }
    }

    /// Nobody could tell to which frame leaders belong that cross each other, or one that runs through another joint.
    #[test]
    fn leaders_cross_no_leader_and_no_joint() {
        for robot in robots() {
            let (layout, view) = best(&robot);
            let leaders = draw::Drawing::of(&robot, &layout, view).leaders();
            for (index, (words, leader)) in leaders.iter().enumerate() {
                for (others, other) in &leaders[index + 1..] {
                    let cross = labels::do_cross(leader, other);
                    assert!(!cross, "{}: {words} and {others}", robot.name);
                }
                let length = (leader[1] - leader[0]).norm();
                assert!(length < 90.0, "{}: {words}, {length}", robot.name);
                for link in &layout.links {
                    let distance = labels::distance(view.point(&link.position), leader);
                    assert!(distance > 12.0, "{}: {words}, {distance}", robot.name);
                }
            }
        }
    }

    /// Joints that mimic another are drawn where they are at coordinate 0, and their arrows show where the coordinate
    /// grows.
    #[test]
    fn joints_that_mimic_others_are_drawn_at_coordinate_zero() {
        let robot_along = |axis: &str, more: &str, kind: &str| {
            let link = |name: &str, more: &str| {
                format!(
                    "[[link]]\nname = \"{name}\"\njoint = {{ type = \"{kind}\", axis = {axis}{more} }}\n\
                     origin = {{ xyz = [0.4, 0, 0] }}\nmass = 1\ncenter_of_mass = [0.1, 0, 0]\n\
                     inertia = {{ xx = 0.1, yy = 0.1, zz = 0.1 }}\n"
                )
            };
            let mimic = format!(", mimic = {{ joint = \"a\"{more} }}");
            let links = [link("a", ""), link("b", &mimic), link("c", "")].concat();
            let text = format!("format = 1\n[robot]\nname = \"arm\"\n{links}");
            robot_model::description::read_toml("arm", &text).unwrap().robot
        };
        let robot = |more: &str, kind: &str| robot_along("\"z\"", more, kind);
        let view = best(&robot("", "revolute")).1;
        let places = |more: &str, kind: &str| layout(&robot(more, kind), &view, 1.0).links;
        let usual = places("", "revolute");
        let turned = places(", offset = 1.5707963267948966", "revolute");
        assert!((usual[2].position - turned[2].position).norm() > 50.0);
        assert!((usual[1].position - turned[1].position).norm() < 1e-9);
        let back = places(", ratio = -1", "revolute");
        assert!((back[1].axis + usual[1].axis).norm() < 1e-9 && back[0].axis == usual[0].axis);
        let straight = places("", "prismatic");
        let moved = places(", offset = 0.3", "prismatic");
        let up = moved[1].position - straight[1].position;
        assert!(up.z > 20.0, "{up}");
        let down = robot_along("[0, 0, -2]", ", offset = 0.3", "prismatic");
        let down = layout(&down, &view, 1.0).links[1].position - straight[1].position;
        assert!(down.z < -20.0, "{down}");
    }

    #[test]
    fn joints_lie_apart_on_the_page() {
        for robot in robots() {
            let (layout, view) = best(&robot);
            let points = layout.links.iter().map(|link| view.point(&link.position));
            let points: Vec<_> = points.collect();
            for (index, point) in points.iter().enumerate() {
                for other in points.iter().skip(index + 1) {
                    let distance = (point - other).norm();
                    assert!(distance > 30.0, "{}: {distance}", robot.name);
                }
            }
        }
    }
}
