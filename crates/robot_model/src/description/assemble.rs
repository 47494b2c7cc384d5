//! Builds the robot from its links in order: fixed links are merged into the links that carry them.

use super::draft::{Draft, DraftFrame, DraftLink, DraftPayload, Parent};
use super::locations::{DroppedBody, FrameLocation, Locations, ParameterLocation};
use super::mimic::{self, Following};
use super::payload;
use super::placement::{Row, without_zero_moves};
use super::reader::{Named, Reader};
use crate::robot::{
    Coordinate, DhConvention, DhRow, Frame, Joint, JointKind, Link, Parameter, Placement, Robot,
};

/// The moving link that carries a link of the file (`None` for the base), and the frame of the link in that of its
/// carrier.
#[derive(Clone)]
struct Carried {
    by: Option<usize>,
    frame: Placement,
}

impl Carried {
    fn base() -> Carried {
        Carried { by: None, frame: Placement::default() }
    }
}

/// Builds the robot from links whose parents are resolved, and reports wrong mimics.
pub(super) fn robot(
    reader: &mut Reader<'_>,
    draft: Draft,
    order: &[usize],
    parameters: (Vec<Parameter>, Vec<ParameterLocation>),
) -> (Robot, Locations) {
    let mut robot = Robot {
        name: draft.name.name,
        description: draft.description,
        gravity: draft.gravity,
        snap: draft.snap,
        base_frames: draft.base_frames,
        parameters: parameters.0,
        coordinates: Vec::new(),
        links: Vec::new(),
        frames: Vec::new(),
        dh: Vec::new(),
        payload: None,
    };
    let mut locations = Locations {
        name: draft.name.span,
        gravity: draft.gravity_place,
        parameters: parameters.1,
        ..Locations::default()
    };
    let motions = coordinates(reader, &mut robot, &draft.links, order);
    let mut carried: Vec<Carried> = vec![Carried::base(); draft.links.len()];
    let mut links: Vec<Option<DraftLink>> = draft.links.into_iter().map(Some).collect();
    for (index, motion) in order.iter().zip(motions) {
        let Some(link) = links.get_mut(*index).and_then(Option::take) else {
            continue;
        };
        let on = parent(&link.parent, &carried);
        let own = match motion {
            Some(motion) => moving(&mut robot, &mut locations, link, on, motion),
            None => fixed(&mut robot, &mut locations, link, on),
        };
        if let Some(slot) = carried.get_mut(*index) {
            *slot = own;
        }
    }
    for frame in draft.frames {
        let on = parent(&frame.parent, &carried);
        push_frame(&mut robot, &mut locations, frame, on);
    }
    if let Some(DraftPayload { parent: on, placement, place }) = draft.payload {
        let Carried { by, frame } = parent(&on, &carried);
        let carrier = by.and_then(|by| {
            Some((robot.links.get_mut(by)?, &mut locations.links.get_mut(by)?.bodies))
        });
        let named = Named { name: "payload".to_owned(), span: place };
        robot.payload = payload::attach(reader, carrier, frame.then(&placement), &named);
    }
    (robot, locations)
}

fn parent(parent: &Parent, carried: &[Carried]) -> Carried {
    match parent {
        Parent::Link(index) => carried.get(*index).cloned().unwrap_or_else(Carried::base),
        Parent::Base | Parent::Name(_) => Carried::base(),
    }
}

/// The motion of a joint: its kind, and its relation to the coordinate that moves it.
struct Motion {
    kind: JointKind,
    following: Following,
}

/// Numbers the coordinates in the order of the links. Returns the motion of each link in this order, `None` for a fixed
/// link.
fn coordinates(
    reader: &mut Reader<'_>,
    robot: &mut Robot,
    links: &[DraftLink],
    order: &[usize],
) -> Vec<Option<Motion>> {
    let links: Vec<&DraftLink> = order.iter().filter_map(|index| links.get(*index)).collect();
    for link in &links {
        if let (Some(kind), None) = (link.joint.kind, &link.joint.mimic) {
            robot.coordinates.push(Coordinate {
                joint: link.joint.name.name.clone(),
                kind,
                limits: link.joint.limits.clone(),
            });
        }
    }
    let mut motion = |link: &DraftLink| {
        let kind = link.joint.kind?;
        let following = mimic::follow(reader, &links, &robot.coordinates, link);
        Some(Motion { kind, following })
    };
    links.iter().map(|link| motion(link)).collect()
}

fn moving(
    robot: &mut Robot,
    locations: &mut Locations,
    link: DraftLink,
    on: Carried,
    motion: Motion,
) -> Carried {
    let index = robot.links.len();
    let mut places = link.places;
    let mut bodies = Vec::new();
    if let Some((mut body, place)) = link.body {
        body.placement = link.after.clone().then(&body.placement);
        bodies.push(body);
        places.bodies.push(place);
    }
    push_dh(robot, &link.name, link.dh, Some(index));
    if !link.after.0.is_empty() {
        robot.frames.push(Frame {
            name: format!("{}_dh", link.name.name),
            link: Some(index),
            placement: link.after.clone(),
            wrench: None,
        });
        locations.frames.push(FrameLocation {
            name: link.name.span.clone(),
            origin: places.origin.clone(),
            wrench: None,
        });
    }
    robot.links.push(Link {
        name: link.name.name,
        parent: on.by,
        placement: without_zero_moves(on.frame.then(&link.before)),
        joint: Joint {
            name: link.joint.name.name,
            kind: motion.kind,
            axis: link.joint.axis,
            coordinate: motion.following.coordinate,
            ratio: motion.following.ratio,
            offset: motion.following.offset,
        },
        bodies,
        friction: link.friction,
        drive: link.drive,
    });
    locations.links.push(places);
    Carried { by: Some(index), frame: link.after }
}

/// Merges a fixed link into the link that carries it, as a body and a named frame.
fn fixed(robot: &mut Robot, locations: &mut Locations, link: DraftLink, on: Carried) -> Carried {
    let own = Carried { by: on.by, frame: on.frame.then(&link.before).then(&link.after) };
    if let Some((mut body, place)) = link.body {
        body.placement = own.frame.clone().then(&body.placement);
        let carrier = own.by.and_then(|by| robot.links.get_mut(by));
        let places = own.by.and_then(|by| locations.links.get_mut(by));
        match carrier.zip(places) {
            Some((carrier, places)) => {
                carrier.bodies.push(body);
                places.bodies.push(place);
            }
            None => locations.dropped.push(DroppedBody {
                link: link.name.name.clone(),
                mass: body.mass,
                place,
            }),
        }
    }
    push_dh(robot, &link.name, link.dh, None);
    let frame = DraftFrame {
        name: link.name,
        parent: Parent::Base,
        placement: Placement::default(),
        wrench: None,
        places: FrameLocation { name: link.places.name, origin: link.places.origin, wrench: None },
    };
    push_frame(robot, locations, frame, own.clone());
    own
}

/// Keeps the Denavit–Hartenberg row of a link, if the file places the link by one.
fn push_dh(
    robot: &mut Robot,
    link: &Named,
    row: Option<(DhConvention, Row)>,
    moving: Option<usize>,
) {
    if let Some((convention, Row { a, alpha, d, theta })) = row {
        robot.dh.push(DhRow { link: link.name.clone(), moving, convention, a, alpha, d, theta });
    }
}

fn push_frame(robot: &mut Robot, locations: &mut Locations, frame: DraftFrame, on: Carried) {
    robot.frames.push(Frame {
        name: frame.name.name,
        link: on.by,
        placement: on.frame.then(&frame.placement),
        wrench: frame.wrench,
    });
    locations.frames.push(frame.places);
}
