//! Connects the links and joints of the file by their names and builds a draft.

use std::collections::BTreeMap;

use robot_symbolic::{Formula, Rational};

use super::super::draft::{DraftJoint, DraftLink, Mimic, Parent};
use super::super::locations::LinkLocation;
use super::super::placement::zero;
use super::super::reader::{Named, Reader};
use super::element::Attribute;
use super::joint::{Dynamics, UrdfJoint};
use super::link::UrdfLink;
use super::name::Name;
use crate::diagnostic::{Diagnostic, code, quote};
use crate::robot::{Drive, Friction, Placement};

/// The links of a draft without their bodies, and for each one the index of the corresponding link of the file.
pub(super) struct Connected {
    pub(super) links: Vec<DraftLink>,
    pub(super) sources: Vec<usize>,
}

/// The parent and child link of a joint, as indices.
struct Ends {
    parent: usize,
    child: usize,
}

/// Connects the links: the root first, then the children of the joints in the order of the file. A root named `base` is
/// the base itself.
pub(super) fn connect(
    reader: &mut Reader<'_>,
    links: &[UrdfLink<'_>],
    joints: &[UrdfJoint<'_>],
    friction: bool,
) -> Option<Connected> {
    let by_name = index(reader, "link", links.iter().map(|link| &link.name));
    let joints_by_name = index(reader, "joint", joints.iter().map(|joint| &joint.name));
    let (by_name, joints_by_name) = (by_name?, joints_by_name?);
    let ends = ends(reader, joints, &by_name)?;
    let root = root(reader, links, &ends)?;
    for name in joints.iter().map(|joint| &joint.name) {
        name.report_renaming(reader);
    }
    let mut connected = Connected { links: Vec::new(), sources: Vec::new() };
    let is_base = |link: usize| links.get(link).is_some_and(|link| link.name.written == "base");
    // The index in the draft of each link of the file.
    let mut drafted: BTreeMap<usize, usize> = BTreeMap::new();
    if let Some((index, link)) = root.filter(|(index, _)| !is_base(*index)) {
        connected.links.push(base(link, joints));
        connected.sources.push(index);
        drafted.insert(index, 0);
    }
    let first = connected.links.len();
    for (number, ends) in ends.iter().enumerate() {
        drafted.insert(ends.child, first + number);
    }
    for (joint, ends) in joints.iter().zip(&ends) {
        let Some(child) = links.get(ends.child) else { continue };
        let parent = drafted.get(&ends.parent).map_or(Parent::Base, |index| Parent::Link(*index));
        let mimic = mimic(reader, joint, joints, &joints_by_name);
        connected.links.push(draft(joint, child, parent, mimic, friction));
        connected.sources.push(ends.child);
    }
    for link in &connected.sources {
        if let Some(link) = links.get(*link) {
            link.name.report_renaming(reader);
        }
    }
    Some(connected)
}

/// The index of each name. Reports names that are not unique.
fn index<'n>(
    reader: &mut Reader<'_>,
    what: &str,
    names: impl Iterator<Item = &'n Name<'n>>,
) -> Option<BTreeMap<&'n str, usize>> {
    let mut found: BTreeMap<&str, (usize, &Named)> = BTreeMap::new();
    let mut unique = true;
    for (index, Name { written, named }) in names.enumerate() {
        let Some((_, first)) = found.get(written) else {
            found.insert(written, (index, named));
            continue;
        };
        unique = false;
        let message = format!("the {what} `{}` is defined twice", quote(written));
        reader.report(
            Diagnostic::error(code::DUPLICATE, message)
                .at(&named.span, "defined again here")
                .and_at(&first.span, "first defined here")
                .help("rename one of them"),
        );
    }
    unique.then(|| found.into_iter().map(|(name, (index, _))| (name, index)).collect())
}

/// The parent and child of each joint. Reports names that are not links, and links that are the child of two joints.
fn ends(
    reader: &mut Reader<'_>,
    joints: &[UrdfJoint<'_>],
    links: &BTreeMap<&str, usize>,
) -> Option<Vec<Ends>> {
    let mut found = Vec::new();
    let mut above: BTreeMap<usize, &UrdfJoint<'_>> = BTreeMap::new();
    let mut complete = true;
    for joint in joints {
        let parent = link(reader, &joint.parent, links);
        let child = link(reader, &joint.child, links);
        let (Some(parent), Some(child)) = (parent, child) else {
            complete = false;
            continue;
        };
        if let Some(first) = above.get(&child) {
            complete = false;
            let message =
                format!("the link `{}` is the child of two joints", quote(joint.child.text));
            reader.report(
                Diagnostic::error(code::TWO_PARENTS, message)
                    .at(&joint.child.span, "again a child here")
                    .and_at(&first.child.span, "already a child here")
                    .because(
                        "in a tree, each link has one parent; the torques of a closed loop are not \
                        uniquely determined",
                    )
                    .help(
                        "cut the loop at one of the joints; if there is no loop, exchange parent \
                        and child of a joint",
                    ),
            );
        }
        above.entry(child).or_insert(joint);
        found.push(Ends { parent, child });
    }
    complete.then_some(found)
}

fn link(
    reader: &mut Reader<'_>,
    name: &Attribute<'_>,
    links: &BTreeMap<&str, usize>,
) -> Option<usize> {
    let found = links.get(name.text).copied();
    if found.is_none() {
        let message = format!("`{}` is not a link of this robot", quote(name.text));
        let label = match reader.nearest(name.text, links.keys().copied()) {
            Some(near) => format!("did you mean `{}`?", quote(near)),
            None => "no link has this name".to_owned(),
        };
        reader.report(
            Diagnostic::error(code::UNKNOWN_LINK, message)
                .at(&name.span, label)
                .help("name a link of this file"),
        );
    }
    found
}

/// The only link that is not the child of a joint. `Some(None)` if every link is a child: then there are cycles, which
/// are reported later.
#[allow(clippy::type_complexity)]
fn root<'l, 'a>(
    reader: &mut Reader<'_>,
    links: &'l [UrdfLink<'a>],
    ends: &[Ends],
) -> Option<Option<(usize, &'l UrdfLink<'a>)>> {
    let mut is_child = vec![false; links.len()];
    for ends in ends {
        if let Some(slot) = is_child.get_mut(ends.child) {
            *slot = true;
        }
    }
    let roots: Vec<(usize, &UrdfLink<'_>)> = links
        .iter()
        .enumerate()
        .zip(&is_child)
        .filter(|(_, is)| !**is)
        .map(|(one, _)| one)
        .collect();
    let [root, others @ ..] = roots.as_slice() else {
        return Some(None);
    };
    // The base is the first link without a parent that is the parent of another link; if there is none, the first link
    // without a parent.
    let carries = |index: usize| ends.iter().any(|ends| ends.parent == index);
    let base = roots.iter().find(|(index, _)| carries(*index)).unwrap_or(root);
    for (index, link) in &roots {
        if index == &base.0 {
            continue;
        }
        let message = format!("the link `{}` has no parent", quote(link.name.written));
        reader.report(
            Diagnostic::error(code::UNREACHABLE, message)
                .at(&link.name.named.span, "not the child of any joint")
                .and_at(&base.1.name.named.span, "the base")
                .because("every link except the base must be the child of a joint")
                .help("connect it with a joint, or remove it"),
        );
    }
    others.is_empty().then_some(Some(*root))
}

/// The root as a link that is fixed to the base.
fn base(link: &UrdfLink<'_>, joints: &[UrdfJoint<'_>]) -> DraftLink {
    // The file has no joint for this link; its name must differ from the names of all joints.
    let mut name = link.name.named.clone();
    while joints.iter().any(|joint| joint.name.named.name == name.name) {
        name.name.push_str("_base");
    }
    DraftLink {
        name: link.name.named.clone(),
        parent: Parent::Base,
        joint: DraftJoint {
            kind: None,
            name,
            axis: [zero(), zero(), Formula::number(&Rational::ONE)],
            limits: None,
            mimic: None,
        },
        before: Placement::default(),
        after: Placement::default(),
        dh: None,
        body: None,
        friction: Friction::none(),
        left_out: None,
        drive: Drive::none(),
        places: LinkLocation {
            name: link.name.named.span.clone(),
            joint: link.tag.clone(),
            ..LinkLocation::default()
        },
    }
}

fn draft(
    joint: &UrdfJoint<'_>,
    child: &UrdfLink<'_>,
    parent: Parent,
    mimic: Option<Mimic>,
    with_friction: bool,
) -> DraftLink {
    let friction = joint.dynamics.as_ref().map(friction);
    let (taken, left_out) = if with_friction { (friction, None) } else { (None, friction) };
    DraftLink {
        name: child.name.named.clone(),
        parent,
        joint: DraftJoint {
            kind: joint.kind,
            name: joint.name.named.clone(),
            axis: joint.axis.clone(),
            // The limits of a mimic joint are not used, because the leading joint determines its motion.
            limits: joint.limits.clone().filter(|_| joint.mimic.is_none()),
            mimic,
        },
        before: joint.origin.placement.clone(),
        after: Placement::default(),
        dh: None,
        body: None,
        friction: taken.unwrap_or_else(Friction::none),
        left_out,
        drive: Drive::none(),
        places: LinkLocation {
            name: child.name.named.span.clone(),
            parent: Some(joint.parent.span.clone()),
            joint: joint.tag.clone(),
            axis: joint.of_axis.clone(),
            limits: joint.of_limits.clone(),
            origin: joint.origin.span.clone(),
            friction: joint.dynamics.as_ref().map(|dynamics| dynamics.span.clone()),
            drive: None,
            bodies: Vec::new(),
        },
    }
}

/// The friction of a joint: damping is viscous friction, and friction is constant dry friction.
fn friction(dynamics: &Dynamics) -> Friction {
    Friction {
        viscous: dynamics.damping.clone(),
        coulomb_positive: dynamics.friction.clone(),
        coulomb_negative: dynamics.friction.clone(),
        ..Friction::none()
    }
}

fn mimic(
    reader: &mut Reader<'_>,
    joint: &UrdfJoint<'_>,
    joints: &[UrdfJoint<'_>],
    by_name: &BTreeMap<&str, usize>,
) -> Option<Mimic> {
    let mimic = joint.mimic.as_ref()?;
    let span = mimic.joint.span.clone();
    let leader = by_name.get(mimic.joint.text).and_then(|index| joints.get(*index));
    let Some(leader) = leader else {
        let message = format!("`{}` is not a joint of this robot", quote(mimic.joint.text));
        let label = match reader.nearest(mimic.joint.text, by_name.keys().copied()) {
            Some(near) => format!("did you mean `{}`?", quote(near)),
            None => "no joint has this name".to_owned(),
        };
        reader.report(
            Diagnostic::error(code::MIMIC, message)
                .at(&span, label)
                .help("name a joint that moves"),
        );
        return None;
    };
    Some(Mimic {
        joint: Named { name: leader.name.named.name.clone(), span },
        ratio: mimic.multiplier.clone(),
        of_ratio: None,
        offset: mimic.offset.clone(),
    })
}
