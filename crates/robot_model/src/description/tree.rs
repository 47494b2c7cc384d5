//! The order of the links: parents before children, otherwise as in the file.

use std::collections::BTreeSet;

use super::draft::{Draft, DraftFrame, DraftLink, Parent};
use super::input_limits::MAX_JOINTS;
use super::names::Registry;
use super::reader::{Named, Reader};
use crate::diagnostic::{Diagnostic, code, quote};

/// Checks names and parents. Returns the indices of the links in their new order if the links form a tree.
pub(super) fn order(reader: &mut Reader<'_>, draft: &mut Draft) -> Option<Vec<usize>> {
    let Draft { links, frames, payload, .. } = draft;
    names(reader, links, frames);
    let known: Vec<Named> = links.iter().map(|link| link.name.clone()).collect();
    let mut complete = true;
    let of_link = "name a link of this file, or \"base\"";
    for link in &mut *links {
        complete &= resolve(reader, &mut link.parent, &known, of_link);
    }
    let of_frames: Vec<String> = frames.iter().map(|frame| frame.name.name.clone()).collect();
    for frame in &mut *frames {
        let help = match &frame.parent {
            Parent::Name(parent) if of_frames.contains(&parent.name) => {
                "links carry frames: name the link of that frame, and give the pose relative to the link"
            }
            _ => of_link,
        };
        complete &= resolve(reader, &mut frame.parent, &known, help);
    }
    if let Some(payload) = payload {
        let help = "name a moving link of this file, a tip or a frame";
        complete &= resolve(reader, &mut payload.parent, &known, help);
    }
    if !complete {
        return None;
    }
    let parents: Vec<Option<usize>> = links
        .iter()
        .map(|link| match link.parent {
            Parent::Link(index) => Some(index),
            Parent::Base | Parent::Name(_) => None,
        })
        .collect();
    let order = sorted(&parents);
    if order.len() < links.len() {
        report_cycles(reader, links, &parents, &order);
        return None;
    }
    let moving = links.iter().filter(|link| link.joint.kind.is_some()).count();
    if moving > MAX_JOINTS {
        let message = format!("at most {MAX_JOINTS} moving joints are allowed; found {moving}");
        let span = order.last().and_then(|last| links.get(*last)).map(|link| &link.name.span);
        let diagnostic = Diagnostic::error(code::LIMIT, message);
        let diagnostic = diagnostic.at(span.unwrap_or(&(0..0)), "the last one");
        reader.report(
            diagnostic.help("describe one arm or limb per file, or fix joints that do not move"),
        );
        return None;
    }
    Some(order)
}

/// Checks that names are unique: links and frames share one set of names; joints have a separate one.
fn names(reader: &mut Reader<'_>, links: &[DraftLink], frames: &[DraftFrame]) {
    let mut registry = Registry::exact("link or frame");
    let own = links.iter().map(|link| &link.name);
    for name in own.chain(frames.iter().map(|frame| &frame.name)) {
        if let Some(diagnostic) = registry.add(name) {
            reader.report(diagnostic);
        }
    }
    let mut registry = Registry::exact("joint");
    let explicit = |link: &&DraftLink| link.joint.name != link.name;
    let (named, mut unnamed): (Vec<_>, Vec<_>) = links.iter().partition(explicit);
    // Duplicate names of links are already reported.
    let mut seen = BTreeSet::new();
    unnamed.retain(|link| seen.insert(&link.name.name));
    for link in named.iter().chain(&unnamed) {
        if let Some(diagnostic) = registry.add(&link.joint.name) {
            reader.report(diagnostic);
        }
    }
}

/// Replaces a parent's name by its index, or reports it with this `help`.
fn resolve(reader: &mut Reader<'_>, parent: &mut Parent, known: &[Named], help: &str) -> bool {
    let Parent::Name(name) = parent else {
        return true;
    };
    if let Some(index) = known.iter().position(|known| known.name == name.name) {
        *parent = Parent::Link(index);
        return true;
    }
    let message = format!("`{}` is not a link of this robot", quote(&name.name));
    let names = known.iter().map(|known| known.name.as_str());
    let label = match reader.nearest(&name.name, names.chain(["base"])) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "no link has this name".to_owned(),
    };
    reader.report(Diagnostic::error(code::UNKNOWN_LINK, message).at(&name.span, label).help(help));
    false
}

/// Repeatedly takes the first link whose parent has been taken. Links on a cycle, or attached to one, are left out.
fn sorted(parents: &[Option<usize>]) -> Vec<usize> {
    let mut order = Vec::new();
    let mut taken = vec![false; parents.len()];
    loop {
        let free = |index: &usize| {
            let ready = parents.get(*index).copied().flatten();
            !taken.get(*index).copied().unwrap_or(true)
                && ready.is_none_or(|parent| taken.get(parent).copied().unwrap_or_default())
        };
        let Some(next) = (0..parents.len()).find(free) else {
            return order;
        };
        if let Some(taken) = taken.get_mut(next) {
            *taken = true;
        }
        order.push(next);
    }
}

/// Reports each cycle with one diagnostic. Links that are attached to a cycle are not reported separately.
fn report_cycles(
    reader: &mut Reader<'_>,
    links: &[DraftLink],
    parents: &[Option<usize>],
    order: &[usize],
) {
    let mut seen: Vec<usize> = order.to_vec();
    for start in 0..links.len() {
        let mut path: Vec<usize> = Vec::new();
        let mut next = Some(start);
        while let Some(index) = next.filter(|index| !seen.contains(index)) {
            seen.push(index);
            path.push(index);
            next = parents.get(index).copied().flatten();
        }
        let from = next.and_then(|again| path.iter().position(|index| *index == again));
        let Some(cycle) = from.and_then(|from| path.get(from..)) else {
            continue;
        };
        let on_cycle: Vec<&DraftLink> =
            cycle.iter().filter_map(|index| links.get(*index)).collect();
        let Some((first, others)) = on_cycle.split_first() else {
            continue;
        };
        let names: Vec<String> =
            on_cycle.iter().chain([first]).map(|link| written(reader.text, link)).collect();
        let place = |link: &DraftLink| link.places.parent.clone().unwrap_or(link.name.span.clone());
        let message = match names.as_slice() {
            [name, _] => format!("the link {name} is its own parent"),
            _ => format!("links form a cycle, each a child of the next: {}", names.join(", ")),
        };
        let remedy = match others {
            [] => format!(
                "make another link or the base the parent of {}",
                written(reader.text, first)
            ),
            _ => "make a link outside the cycle, such as the base, the parent of one of them"
                .to_owned(),
        };
        let mut diagnostic = Diagnostic::error(code::CYCLE, message)
            .at(&place(first), "this parent")
            .because("every link must lead back to the base; closed loops are not supported")
            .help(remedy);
        for link in others.iter().take(8) {
            diagnostic = diagnostic.and_at(&place(link), "and this one");
        }
        reader.report(diagnostic);
    }
}

/// The name of a link, with that of the file if it was renamed.
fn written(text: &str, link: &DraftLink) -> String {
    let name = &link.name.name;
    let found = text.get(link.name.span.clone()).unwrap_or_default().trim_matches(['"', '\'']);
    // If the file does not contain the name, its place is that of something else.
    let is_name = !found.is_empty() && !found.contains(['[', '{', '=', '\n']);
    match !is_name || found == name {
        true => format!("`{name}`"),
        false => format!("`{}` (renamed `{name}`)", quote(found)),
    }
}

#[cfg(test)]
mod tests {
    use super::sorted;

    #[test]
    fn the_file_order_is_kept_if_possible() {
        assert_eq!(sorted(&[None, Some(0), Some(0), None]), [0, 1, 2, 3]);
        assert_eq!(sorted(&[None, Some(2), Some(0), Some(1)]), [0, 2, 1, 3]);
        assert_eq!(sorted(&[Some(1), Some(0), None, Some(0)]), [2]);
    }
}
