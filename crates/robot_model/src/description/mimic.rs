//! Joints that mimic others. Every chain of them must end at a joint that has a coordinate.

use robot_symbolic::{Formula, Rational};

use super::compute::{product, sum};
use super::draft::{DraftLink, Mimic};
use super::placement::zero;
use super::reader::{Named, Reader};
use super::value::quantity;
use crate::diagnostic::{Diagnostic, code, quote};
use crate::robot::{Coordinate, JointKind};

/// Joint position = `ratio` · q + `offset`.
pub(super) struct Following {
    pub(super) coordinate: usize,
    pub(super) ratio: Formula,
    pub(super) offset: Formula,
}

/// The motion of the joint of `link` as a function of a coordinate. Errors in its mimic are reported. `links` must be
/// in order.
pub(super) fn follow(
    reader: &mut Reader<'_>,
    links: &[&DraftLink],
    coordinates: &[Coordinate],
    link: &DraftLink,
) -> Following {
    check_ratio(reader, links, link);
    let leader = leader(reader, links, link);
    let leader = leader.unwrap_or(Leader { name: "", ratio: one(), offset: zero() });
    let found = coordinates.iter().position(|one| one.joint == leader.name);
    Following { coordinate: found.unwrap_or_default(), ratio: leader.ratio, offset: leader.offset }
}

/// Reports a ratio whose unit is not that of this joint's position divided by that of the leading joint's position.
fn check_ratio(reader: &mut Reader<'_>, links: &[&DraftLink], link: &DraftLink) {
    let Some(Mimic { joint, ratio, of_ratio: Some(place), .. }) = &link.joint.mimic else {
        return;
    };
    let followed = links.iter().find(|other| other.joint.name.name == joint.name);
    let kinds = followed.and_then(|followed| link.joint.kind.zip(followed.joint.kind));
    let Some((own, followed)) = kinds else {
        return;
    };
    // The exponent of the meter in the unit of a joint position.
    let length = |kind| match kind {
        JointKind::Revolute => 0,
        JointKind::Prismatic => 1,
    };
    let length = length(own) - length(followed);
    reader.fits(ratio, quantity("the ratio", 0, length, 0), place);
}

fn one() -> Formula {
    Formula::number(&Rational::ONE)
}

struct Leader<'l> {
    name: &'l str,
    ratio: Formula,
    offset: Formula,
}

/// The joint at the end of the chain, with the laws of the chain combined: q = r₁ (r₂ p + o₂) + o₁. An error is
/// reported only for the link in which it occurs.
fn leader<'l>(
    reader: &mut Reader<'_>,
    links: &[&'l DraftLink],
    link: &'l DraftLink,
) -> Option<Leader<'l>> {
    let Some(mimic) = &link.joint.mimic else {
        return Some(Leader { name: &link.joint.name.name, ratio: one(), offset: zero() });
    };
    let (mut ratio, mut offset) = (mimic.ratio.clone(), mimic.offset.clone());
    let mut chain = vec![link];
    let mut wanted = &mimic.joint;
    loop {
        let next = links.iter().copied().find(|link| link.joint.name.name == wanted.name);
        let Some(next) = next.filter(|next| next.joint.kind.is_some()) else {
            // A wrong name further along the chain is reported for the link that contains it.
            if chain.len() == 1 {
                let diagnostic = no_leader(reader, wanted, links);
                reader.report(diagnostic);
            }
            return None;
        };
        if chain.iter().any(|passed| passed.joint.name == next.joint.name) {
            let place = |link: &DraftLink| link.joint.name.span.start;
            let is_first = chain.iter().all(|passed| place(passed) >= place(link));
            if is_first && next.joint.name == link.joint.name {
                reader.report(circle(&chain, wanted));
            }
            return None;
        }
        let Some(mimic) = &next.joint.mimic else {
            return Some(Leader { name: &next.joint.name.name, ratio, offset });
        };
        let folded = product(&ratio, &mimic.offset)
            .and_then(|moved| sum(&moved, &offset))
            .zip(product(&ratio, &mimic.ratio));
        let Some((folded_offset, folded_ratio)) = folded else {
            reader.report(
                Diagnostic::error(
                    code::LIMIT,
                    "the expressions of this chain of mimic joints \
                    are too large",
                )
                .at(&wanted.span, "part of a chain in which each joint mimics the next")
                .help(
                    "let the joint mimic the leading joint directly, with the combined ratio and \
                     offset",
                ),
            );
            return None;
        };
        (ratio, offset) = (folded_ratio, folded_offset);
        chain.push(next);
        wanted = &mimic.joint;
    }
}

fn circle(chain: &[&DraftLink], wanted: &Named) -> Diagnostic {
    let [_] = chain else {
        let names: Vec<String> =
            chain.iter().map(|link| format!("`{}`", quote(&link.joint.name.name))).collect();
        let message = format!("joints mimic each other in a cycle: {}", names.join(", "));
        let mut diagnostic = Diagnostic::error(code::MIMIC, message)
            .at(&wanted.span, "leads back to the first")
            .because("at least one of them must move independently")
            .help("remove `mimic` from one of these joints");
        for link in chain.iter().take(8) {
            if let Some(mimic) = link.joint.mimic.as_ref().filter(|mimic| mimic.joint != *wanted) {
                diagnostic = diagnostic.and_at(&mimic.joint.span, "");
            }
        }
        return diagnostic;
    };
    let name = quote(&wanted.name);
    Diagnostic::error(code::MIMIC, format!("the joint `{name}` mimics itself"))
        .at(&wanted.span, "its own name")
        .help("name the leading joint, or remove `mimic`")
}

/// The error for a name that is not the name of a moving joint.
fn no_leader(reader: &Reader<'_>, wanted: &Named, links: &[&DraftLink]) -> Diagnostic {
    let name = quote(&wanted.name);
    if links.iter().any(|link| link.joint.name.name == wanted.name) {
        return Diagnostic::error(
            code::MIMIC,
            format!("the joint `{name}` is fixed and cannot lead another"),
        )
        .at(&wanted.span, "a fixed joint")
        .help("make this joint fixed too, or name a joint that moves");
    }
    let moving = links.iter().filter(|link| link.joint.kind.is_some());
    let names = moving.map(|link| link.joint.name.name.as_str());
    let of_link = links.iter().find(|link| link.name.name == wanted.name);
    let label = match (of_link, reader.nearest(&wanted.name, names)) {
        (Some(link), _) => format!("a link; its joint is `{}`", quote(&link.joint.name.name)),
        (None, Some(near)) => format!("did you mean `{near}`?"),
        (None, None) => "no joint has this name".to_owned(),
    };
    Diagnostic::error(code::MIMIC, format!("`{name}` is not a joint of this robot"))
        .at(&wanted.span, label)
        .help("name a joint that moves; a joint without a name has the name of its link")
}
