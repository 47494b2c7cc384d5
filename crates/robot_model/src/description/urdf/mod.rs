//! Reads URDF, the description format of ROS, into a draft.
//!
//! The links with their inertials and the joints are read; shapes, materials, controllers and the like do not affect
//! the motion. No other file is ever opened.

mod connect;
mod element;
mod guard;
mod joint;
mod link;
mod masses;
mod name;
mod number;
mod origin;
mod report;
mod unread;
mod xml;

use robot_symbolic::{Formula, Rational};
use roxmltree::Node;

use super::draft::Draft;
use super::input_limits::MAX_LINKS;
use super::options::Options;
use super::placement::zero;
use super::reader::{Named, Reader};
use super::wanted::Wanted;
use super::{Lowered, tree};
use crate::diagnostic::{Diagnostic, code, quote};
use crate::robot::BaseFrames;
use element::{Element, JOINT, ROBOT};
use joint::UrdfJoint;
use link::UrdfLink;

/// The acceleration of gravity along z in the base frame, in cm/s². URDF does not specify it.
const GRAVITY: i64 = -981;

/// Lowers the text of a file and reports its errors and the choices that the reader made.
pub(super) fn lower(reader: &mut Reader<'_>, options: &Options) -> Option<Lowered> {
    let document = xml::parse(reader)?;
    let root = root(reader, document.root_element())?;
    let name = root.require(reader, "name", "arm");
    let name = name.and_then(|attribute| name::identifier(reader, &attribute));
    let (links, joints) = parts(reader, &root)?;
    let connected = connect::connect(reader, &links, &joints, options.friction)?;
    // A placeholder, so that the rest of the file is checked even if the name is not valid.
    let named = name.clone().unwrap_or(Named { name: String::new(), span: root.tag() });
    let down = Rational::new(GRAVITY, 100).unwrap_or(Rational::ZERO);
    let mut draft = Draft {
        name: named,
        description: None,
        gravity: [zero(), zero(), Formula::number(&down)],
        gravity_place: None,
        snap: None,
        base_frames: BaseFrames::File,
        links: connected.links,
        frames: Vec::new(),
        payload: None,
    };
    let order = tree::order(reader, &mut draft)?;
    let sources: Vec<&UrdfLink<'_>> =
        connected.sources.iter().filter_map(|index| links.get(*index)).collect();
    masses::add(reader, &mut draft, &order, &sources, options);
    report::choices(reader, &root, &draft, &order, &joints, options);
    name?;
    let parameters = (Vec::new(), Vec::new());
    Some(Lowered { draft, order, parameters, wanted: Wanted::default(), budgets: Vec::new() })
}

/// The root element, if it is a `<robot>`.
fn root<'a, 'i>(reader: &mut Reader<'_>, node: Node<'a, 'i>) -> Option<Element<'a, 'i>> {
    let name = node.tag_name().name();
    let place = element::tag(node);
    if name == ROBOT.name {
        return Some(Element::new(reader, node, &ROBOT));
    }
    let diagnostic = match name {
        "sdf" | "mujoco" | "mujocoinclude" | "model" | "COLLADA" | "launch" => {
            let message = format!("the file is not URDF: its root element is `<{name}>`");
            Diagnostic::error(code::FORMAT, message).at(&place, "").help("convert it to URDF")
        }
        _ => {
            let message = format!("the root element is `<{}>`", quote(name));
            let near = reader.nearest(name, [ROBOT.name].into_iter());
            let label = if near.is_some() { "did you mean `robot`?" } else { "not a robot" };
            Diagnostic::error(code::UNKNOWN_KEY, message)
                .at(&place, label)
                .help("describe the robot in `<robot name=\"arm\"> … </robot>`")
        }
    };
    reader.report(diagnostic);
    None
}

/// Reads links and joints. `None` if there are none or too many, or if a property that others depend on is invalid.
fn parts<'a>(
    reader: &mut Reader<'_>,
    root: &Element<'a, '_>,
) -> Option<(Vec<UrdfLink<'a>>, Vec<UrdfJoint<'a>>)> {
    let (links, joints): (Vec<_>, Vec<_>) =
        (root.nodes("link").collect(), root.nodes("joint").collect());
    let most = links.len().max(joints.len());
    if most > MAX_LINKS {
        let message =
            format!("at most {MAX_LINKS} links and {MAX_LINKS} joints are allowed; found {most}");
        let diagnostic = Diagnostic::error(code::LIMIT, message).at(&root.tag(), "");
        reader.report(diagnostic.help("describe one robot per file"));
        return None;
    }
    if links.is_empty() {
        reader.report(
            Diagnostic::error(code::MISSING_KEY, "the robot has no links")
                .at(&root.tag(), "`<link>` is missing")
                .help("add the links and joints of the robot"),
        );
    }
    let read_links: Vec<UrdfLink<'a>> =
        links.iter().filter_map(|node| link::read(reader, *node)).collect();
    let read_joints: Vec<UrdfJoint<'a>> = joints
        .iter()
        .filter_map(|node| {
            let element = Element::new(reader, *node, &JOINT);
            joint::read(reader, &element)
        })
        .collect();
    let complete =
        !links.is_empty() && read_links.len() == links.len() && read_joints.len() == joints.len();
    complete.then_some((read_links, read_joints))
}
