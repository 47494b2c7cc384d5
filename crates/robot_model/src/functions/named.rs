//! The names of functions: the list of all names, and the lookup by name.

use std::fmt;

use robot_symbolic::nearest_word;

use super::{ALL_FUNCTIONS, FunctionKind};
use crate::diagnostic::quote;
use crate::robot::Robot;

/// A frame for which a Jacobian can be generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FrameRef {
    /// A named frame, an index into [`Robot::frames`].
    Named(usize),
    /// The frame of a moving link, as in `forward_kinematics`: an index into [`Robot::links`].
    Link(usize),
}

impl FrameRef {
    /// The name of the frame or link in the robot file; `None` if the robot has no such frame.
    #[must_use]
    pub fn name(self, robot: &Robot) -> Option<&str> {
        match self {
            FrameRef::Named(index) => Some(robot.frames.get(index)?.name.as_str()),
            FrameRef::Link(index) => Some(robot.links.get(index)?.name.as_str()),
        }
    }

    /// All frames of a robot: the named frames, then the frames of the links.
    fn of(robot: &Robot) -> impl Iterator<Item = FrameRef> {
        let named = (0..robot.frames.len()).map(FrameRef::Named);
        named.chain((0..robot.links.len()).map(FrameRef::Link))
    }

    /// The frames for which a kind of function is generated if no frame is specified: the named frames that move or, if
    /// there are none, the frames of the links without children.
    #[must_use]
    pub fn usual(robot: &Robot) -> Vec<FrameRef> {
        let moving =
            |index: &usize| robot.frames.get(*index).is_some_and(|frame| frame.link.is_some());
        let named: Vec<usize> = (0..robot.frames.len()).filter(moving).collect();
        if !named.is_empty() {
            return named.into_iter().map(FrameRef::Named).collect();
        }
        let is_last = |index: &usize| robot.links.iter().all(|link| link.parent != Some(*index));
        (0..robot.links.len()).filter(is_last).map(FrameRef::Link).collect()
    }
}

/// The suffix of the names of each frame's functions: the frame's name as an identifier in lower case, made unique if
/// several frames would have the same.
pub(super) fn suffixes(robot: &Robot) -> Vec<(FrameRef, String)> {
    let frames: Vec<(FrameRef, String)> =
        FrameRef::of(robot).map(|frame| (frame, identifier(frame, robot))).collect();
    let mut found: Vec<(FrameRef, String)> = vec![];
    for (frame, name) in &frames {
        let is_named = |frame: &FrameRef| matches!(frame, FrameRef::Named(_));
        let is_same = |(other, same): &&(FrameRef, String)| {
            is_named(other) == is_named(frame) && same == name
        };
        // If only one of several had the number, its name could be the other's name in the file.
        let mut suffix = match (frame, frames.iter().filter(is_same).count()) {
            (_, 1) => name.clone(),
            (FrameRef::Named(index) | FrameRef::Link(index), _) => format!("{name}_{}", index + 1),
        };
        // A suffix `dot_qd…` would make the name look like that of the other kind, `jacobian_dot_qd…`.
        if suffix == "dot_qd" || suffix.starts_with("dot_qd_") {
            suffix = format!("frame_{suffix}");
        }
        // A suffix that was made must not be the name of anything else in the file.
        let of_others = |suffix: &String| {
            found.iter().any(|(_, other)| other == suffix)
                || frames.iter().any(|(other, others)| {
                    let counts = matches!(other, FrameRef::Named(_)) || suffix != name;
                    counts && other != frame && others == suffix
                })
        };
        while of_others(&suffix) {
            suffix.push_str(match frame {
                FrameRef::Named(_) => "_frame",
                FrameRef::Link(_) => "_link",
            });
        }
        found.push((*frame, suffix));
    }
    found
}

/// The name in lower case, with one `_` for the characters between those that an identifier can have, and none at its
/// ends: printers of code write names of functions like this, too, and the name of a function must not depend on which
/// other functions are generated. A name that would be longer than that of any function in any language, or empty, ends
/// with the frame's number.
fn identifier(frame: FrameRef, robot: &Robot) -> String {
    let name = frame.name(robot).unwrap_or_default().to_ascii_lowercase();
    let words = name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let name = words.collect::<Vec<_>>().join("_");
    let (what, number) = match frame {
        FrameRef::Named(index) => ("frame", index + 1),
        FrameRef::Link(index) => ("link", index + 1),
    };
    match name.get(..SHORTENED) {
        _ if name.is_empty() => format!("{what}_{number}"),
        Some(start) if name.len() > LONGEST => format!("{}_{number}", start.trim_end_matches('_')),
        _ => name,
    }
}

/// The largest length of a suffix: with `jacobian_dot_qd_`, a name has the 63 characters that MATLAB and C distinguish.
const LONGEST: usize = 47;
/// The length to which a longer suffix is cut, with room for a number and what makes it unique.
const SHORTENED: usize = 32;

/// The names of all functions of a robot, with their kinds: first the kinds that the robot has, then the functions of
/// single frames, of named frames before moving links.
#[must_use]
pub fn names(robot: &Robot) -> Vec<(String, FunctionKind)> {
    let kinds = FunctionKind::of_robot(robot);
    let mut names: Vec<(String, FunctionKind)> =
        kinds.iter().map(|kind| (kind.name().to_owned(), *kind)).collect();
    let suffixes = suffixes(robot);
    for kind in [FunctionKind::Jacobian, FunctionKind::JacobianDotQd] {
        let one = |(frame, suffix): &(FrameRef, String)| {
            Some((format!("{}_{suffix}", kind.name()), kind.of_frame(*frame)?))
        };
        names.extend(suffixes.iter().filter_map(one));
    }
    names
}

/// Whether a name has the form of a name of a function of one frame. Whether the frame exists depends on the robot.
#[must_use]
pub fn is_of_frame(name: &str) -> bool {
    FunctionKind::from_name(name).is_none() && name.starts_with("jacobian_")
}

/// The function with a name: either the name of a kind, whether the robot has it or not, or the name of a kind followed
/// by that of a frame or moving link, as in the robot file or as in the function's name. If a frame and a link have the
/// same name, the frame is meant.
///
/// # Errors
///
/// An error if the robot has no function with this name, or if several frames have the name in its form as an
/// identifier.
pub fn named(robot: &Robot, name: &str) -> Result<FunctionKind, WrongName> {
    if let Some(kind) = FunctionKind::from_name(name) {
        return Ok(kind);
    }
    let known = names(robot);
    if let Some((_, kind)) = known.iter().find(|(known, _)| known == name) {
        return Ok(*kind);
    }
    // The kind with the longer name is tried first: `jacobian_dot_qd_tool` is hardly the Jacobian of a frame
    // `dot_qd_tool`.
    for kind in [FunctionKind::JacobianDotQd, FunctionKind::Jacobian] {
        let rest = name.strip_prefix(kind.name()).and_then(|rest| rest.strip_prefix('_'));
        let Some(rest) = rest else { continue };
        let exact = FrameRef::of(robot).find(|frame| frame.name(robot) == Some(rest));
        if let Some(kind) = exact.and_then(|frame| kind.of_frame(frame)) {
            return Ok(kind);
        }
        let is_alike = |frame: &FrameRef| identifier(*frame, robot) == rest.to_lowercase();
        let alike: Vec<FrameRef> = FrameRef::of(robot).filter(is_alike).collect();
        match alike.as_slice() {
            [] => {}
            [frame] => return kind.of_frame(*frame).ok_or_else(|| unknown(name, &known)),
            several => {
                let of = several.iter().filter_map(|frame| kind.of_frame(*frame));
                return Err(WrongName {
                    name: name.to_owned(),
                    near: None,
                    known: of.map(|kind| kind.full_name(robot)).collect(),
                    several: true,
                });
            }
        }
    }
    Err(unknown(name, &known))
}

fn unknown(name: &str, known: &[(String, FunctionKind)]) -> WrongName {
    let names = known.iter().map(|(name, _)| name.as_str()).chain([ALL_FUNCTIONS]);
    WrongName {
        name: name.to_owned(),
        near: nearest_word(name, names).map(str::to_owned),
        known: shown(known),
        several: false,
    }
}

/// The names to show in messages: all kinds, and at most a limited number of functions of single frames.
fn shown(known: &[(String, FunctionKind)]) -> Vec<String> {
    const MOST: usize = 24;
    let of_frame = |kind: &FunctionKind| kind.frame().is_some();
    let (frames, kinds): (Vec<_>, Vec<_>) = known.iter().partition(|(_, kind)| of_frame(kind));
    let name = |(name, _): &(String, FunctionKind)| name.clone();
    let mut shown: Vec<String> = kinds.into_iter().map(name).collect();
    shown.extend(frames.iter().take(MOST).copied().map(name));
    if frames.len() > MOST {
        shown.push(format!("and {} more", frames.len() - MOST));
    }
    shown
}

/// The error for a name that is not the name of a function, or that may mean several.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongName {
    /// The name.
    pub name: String,
    /// The function that was probably meant.
    pub near: Option<String>,
    /// The names of all functions, or of those that the name may mean.
    pub known: Vec<String>,
    /// Whether the name may mean several functions.
    pub several: bool,
}

impl fmt::Display for WrongName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = quote(&self.name);
        if self.several {
            let names = self.known.join("`, `");
            return write!(formatter, "`{name}` may be several functions: choose one of `{names}`");
        }
        if self.name == ALL_FUNCTIONS {
            return write!(
                formatter,
                "`{name}` selects all functions, but only where functions are generated one by one; \
                 here, name the functions. Available: {}.",
                self.known.join(", ")
            );
        }
        write!(formatter, "there is no function `{name}`.")?;
        if let Some(near) = &self.near {
            write!(formatter, " Did you mean `{near}`?")?;
        }
        write!(formatter, " Available: {}.", self.known.join(", "))
    }
}

impl std::error::Error for WrongName {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_word_for_all_is_not_offered_for_itself() {
        let known = [("bias".to_owned(), FunctionKind::Bias)];
        let [all, other] = [ALL_FUNCTIONS, "bais"].map(|name| unknown(name, &known).to_string());
        assert!(
            all.contains("here, name the functions") && all.ends_with("Available: bias."),
            "{all}"
        );
        assert!(!all.contains("mean"), "{all}");
        assert_eq!(other, "there is no function `bais`. Did you mean `bias`? Available: bias.");
    }
}
