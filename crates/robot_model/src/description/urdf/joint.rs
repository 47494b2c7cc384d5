//! `<joint>`: its type, links, origin, axis, limits, and the joint that it mimics.

use robot_symbolic::{Formula, Rational};

use super::super::placement::zero;
use super::super::reader::Reader;
use super::element::{Attribute, Element};
use super::name::{self, Name};
use super::number::{formulas, numbers};
use super::origin::{self, Origin};
use crate::diagnostic::significant;
use crate::diagnostic::{Diagnostic, Span, code, quote};
use crate::robot::JointKind;

/// A joint of the file.
pub(super) struct UrdfJoint<'a> {
    pub(super) name: Name<'a>,
    pub(super) tag: Span,
    /// `None` for a fixed joint.
    pub(super) kind: Option<JointKind>,
    pub(super) is_continuous: bool,
    pub(super) parent: Attribute<'a>,
    pub(super) child: Attribute<'a>,
    pub(super) origin: Origin,
    pub(super) axis: [Formula; 3],
    pub(super) of_axis: Option<Span>,
    pub(super) limits: Option<[Rational; 2]>,
    pub(super) of_limits: Option<Span>,
    pub(super) mimic: Option<UrdfMimic<'a>>,
    pub(super) dynamics: Option<Dynamics>,
    pub(super) unread: Vec<Unread>,
}

/// An attribute of `<limit>` that has no effect here.
pub(super) struct Unread {
    pub(super) name: &'static str,
    /// The place of its value.
    pub(super) span: Span,
}

/// The law of a mimic joint: joint position = `multiplier` × position of `joint` + `offset`.
pub(super) struct UrdfMimic<'a> {
    pub(super) joint: Attribute<'a>,
    pub(super) multiplier: Formula,
    pub(super) offset: Formula,
}

/// The friction of a joint.
pub(super) struct Dynamics {
    /// The viscous friction, N m s/rad or N s/m.
    pub(super) damping: Formula,
    /// The constant dry friction, N m or N.
    pub(super) friction: Formula,
    pub(super) span: Span,
}

impl Dynamics {
    /// The values as text on one line.
    pub(super) fn values_text(&self) -> String {
        format!("damping {}, friction {}", self.damping, self.friction)
    }
}

/// Reads a joint; `None` if a property that other links and joints depend on is invalid.
pub(super) fn read<'a>(
    reader: &mut Reader<'_>,
    element: &Element<'a, '_>,
) -> Option<UrdfJoint<'a>> {
    let name = element.require(reader, "name", "joint_1");
    let name = name.and_then(|attribute| name::label(reader, &attribute, "a joint"));
    let kind = element.require(reader, "type", "revolute");
    let kind = kind.and_then(|attribute| kind_of(reader, &attribute));
    let parent = end(reader, element, "parent");
    let child = end(reader, element, "child");
    let origin = origin::read(reader, element);
    let moving = match kind {
        Some(Some((_, has_limits))) => Some(moving(reader, element, has_limits)),
        _ => None,
    };
    let Moving { axis, of_axis, limits, of_limits, mimic, dynamics, unread } =
        moving.unwrap_or_default();
    Some(UrdfJoint {
        name: name?,
        tag: element.tag(),
        kind: kind?.map(|(kind, _)| kind),
        is_continuous: matches!(kind, Some(Some((_, false)))),
        parent: parent?,
        child: child?,
        origin: origin?,
        axis,
        of_axis,
        limits,
        of_limits,
        mimic,
        dynamics,
        unread,
    })
}

/// Reads the type: `Some(None)` for a fixed joint. The flag is whether a moving joint has limits.
#[allow(clippy::option_option, reason = "no type, no motion, a motion")]
fn kind_of(
    reader: &mut Reader<'_>,
    attribute: &Attribute<'_>,
) -> Option<Option<(JointKind, bool)>> {
    const TYPES: &[&str] = &["revolute", "continuous", "prismatic", "fixed"];
    let word = attribute.text;
    let message = format!("`{}` is not a supported joint type", quote(word));
    let diagnostic = Diagnostic::error(code::UNKNOWN_WORD, message);
    let diagnostic = match word {
        "revolute" => return Some(Some((JointKind::Revolute, true))),
        "continuous" => return Some(Some((JointKind::Revolute, false))),
        "prismatic" => return Some(Some((JointKind::Prismatic, true))),
        "fixed" => return Some(None),
        "floating" => diagnostic
            .at(&attribute.span, "six degrees of freedom")
            .because("the base frame is fixed")
            .help(
                "write \"fixed\" if the link does not move; otherwise use three prismatic and three continuous joints, \
                 with massless links between them (and allow massless links)",
            ),
        "planar" => diagnostic.at(&attribute.span, "three degrees of freedom").help(
            "use two prismatic joints and a continuous one, with massless links between them \
             (and allow massless links)",
        ),
        "spherical" | "ball" => diagnostic.at(&attribute.span, "three degrees of freedom").help(
            "use three revolute joints, with massless links between them (and allow massless links)",
        ),
        _ => {
            let label = match reader.nearest(word, TYPES.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => "not a joint type".to_owned(),
            };
            diagnostic
                .at(&attribute.span, label)
                .help("use one of `revolute`, `continuous`, `prismatic` and `fixed`")
        }
    };
    reader.report(diagnostic);
    None
}

/// The link that `<parent link="…"/>` or `<child link="…"/>` names.
fn end<'a>(
    reader: &mut Reader<'_>,
    element: &Element<'a, '_>,
    name: &str,
) -> Option<Attribute<'a>> {
    let example = format!("<{name} link=\"…\"/>");
    let element = element.require_child(reader, name, &example)?;
    element.require(reader, "link", "name of a link")
}

/// The properties of a moving joint.
struct Moving<'a> {
    axis: [Formula; 3],
    of_axis: Option<Span>,
    limits: Option<[Rational; 2]>,
    of_limits: Option<Span>,
    mimic: Option<UrdfMimic<'a>>,
    dynamics: Option<Dynamics>,
    unread: Vec<Unread>,
}

/// The default values. A joint without an axis has the axis x in URDF.
impl Default for Moving<'_> {
    fn default() -> Self {
        Moving {
            axis: [Formula::number(&Rational::ONE), zero(), zero()],
            of_axis: None,
            limits: None,
            of_limits: None,
            mimic: None,
            dynamics: None,
            unread: Vec::new(),
        }
    }
}

/// The name of a joint in the file; empty if it has none, which is reported elsewhere.
fn written_name<'a>(joint: &Element<'a, '_>) -> &'a str {
    joint.attribute("name").map_or("", |name| name.text)
}

fn moving<'a>(reader: &mut Reader<'_>, element: &Element<'a, '_>, has_limits: bool) -> Moving<'a> {
    let mut moving = Moving::default();
    match element.child(reader, "axis") {
        Some(axis) => {
            let attribute = axis.require(reader, "xyz", "0 0 1");
            if let Some(attribute) = attribute {
                if let Some(vector) = direction(reader, &attribute) {
                    moving.axis = vector;
                }
                moving.of_axis = Some(attribute.span);
            }
        }
        None => {
            let message = format!(
                "the joint `{}` has no axis; URDF's default is x",
                quote(written_name(element))
            );
            reader.report(
                Diagnostic::note(code::TAKEN_DEFAULT, message)
                    .at(&element.tag(), "`<axis>` is missing"),
            );
        }
    }
    moving.mimic = element.child(reader, "mimic").and_then(|mimic| follows(reader, &mimic));
    let limit = element.child(reader, "limit");
    let mimics = moving.mimic.is_some();
    match &limit {
        Some(limit) => {
            if has_limits {
                (moving.limits, moving.of_limits) = limits(reader, limit, element, mimics);
            }
            moving.unread = unread(reader, limit);
        }
        None if has_limits && !mimics => {
            let message = format!(
                "the joint `{}` has no `<limit>`, which URDF requires; it has no limits",
                quote(written_name(element))
            );
            let note = Diagnostic::note(code::TAKEN_DEFAULT, message);
            reader.report(note.at(&element.tag(), "`<limit>` is missing"));
        }
        None => {}
    }
    if mimics && moving.limits.is_some() {
        // The leading joint determines the motion.
        moving.unread.extend(limit.iter().flat_map(|limit| attributes(limit, &["lower", "upper"])));
    }
    let dynamics = element.child(reader, "dynamics");
    moving.dynamics = dynamics.and_then(|dynamics| friction(reader, &dynamics));
    moving
}

/// Reads the limits of force and velocity and similar attributes, which have no effect on the motion. A negative one is
/// a warning.
fn unread(reader: &mut Reader<'_>, element: &Element<'_, '_>) -> Vec<Unread> {
    const NAMES: [&str; 5] = ["effort", "velocity", "acceleration", "deceleration", "jerk"];
    let mut unread = Vec::new();
    for name in NAMES {
        let Some(attribute) = element.attribute(name) else { continue };
        let value = attribute.text.trim().parse::<f64>().ok();
        if let Some(value) = value.filter(|value| *value < 0.0) {
            let message = format!("the {name} limit is {value}");
            reader.report(
                Diagnostic::warning(code::LIMIT_SIGN, message)
                    .at(&attribute.span, "below 0")
                    .because("the limit bounds the magnitude, in both directions")
                    .help("correct the value, or remove it; it does not affect the equations"),
            );
        }
        unread.push(Unread { name, span: attribute.span });
    }
    unread
}

/// The attributes with these names, without their values.
fn attributes(element: &Element<'_, '_>, names: &[&'static str]) -> Vec<Unread> {
    let of = |name: &&'static str| {
        let attribute = element.attribute(name)?;
        Some(Unread { name, span: attribute.span })
    };
    names.iter().filter_map(of).collect()
}

/// Reads an axis: a nonzero vector.
fn direction(reader: &mut Reader<'_>, attribute: &Attribute<'_>) -> Option<[Formula; 3]> {
    /// The tolerance for taking a vector as a unit vector whose components are rounded, such as 0.707 for √½.
    const ROUNDED: f64 = 1e-3;
    let numbers = numbers::<3>(reader, attribute, "a joint axis", "0 0 1")?;
    if numbers.iter().all(Rational::is_zero) {
        reader.report(
            Diagnostic::error(code::ZERO_AXIS, "the joint axis is zero")
                .at(&attribute.span, "this vector has no direction")
                .because(
                    "a joint rotates about an axis or slides along it, and 0 0 0 is not a \
                    direction",
                )
                .help("write a direction such as \"0 0 1\""),
        );
        return None;
    }
    let length =
        numbers.each_ref().map(Rational::to_f64).iter().fold(0.0, |sum: f64, x| sum.hypot(*x));
    if (length - 1.0).abs() > ROUNDED {
        let message = format!("the joint axis has length {}", significant(length));
        reader.report(
            Diagnostic::warning(code::AXIS_LENGTH, message)
                .at(&attribute.span, "only its direction is used")
                .because("URDF requires a unit vector; programs treat other vectors differently")
                .help("write the vector with length 1"),
        );
    }
    Some(numbers.each_ref().map(Formula::number))
}

/// Reads the lower and upper limits, and their place. As URDF specifies, one limit that is left out is 0, which is noted
/// unless the joint `mimics` another. `None` if both are left out or equal, or if one is infinite or invalid.
fn limits(
    reader: &mut Reader<'_>,
    element: &Element<'_, '_>,
    joint: &Element<'_, '_>,
    mimics: bool,
) -> (Option<[Rational; 2]>, Option<Span>) {
    let attributes = [element.attribute("lower"), element.attribute("upper")];
    let name = quote(written_name(joint));
    if attributes.iter().all(Option::is_none) {
        if !mimics {
            let message = format!(
                "the joint `{name}` has neither a lower nor an upper limit; it has no limits"
            );
            let note = Diagnostic::note(code::TAKEN_DEFAULT, message);
            reader.report(note.at(&element.tag(), "`lower` and `upper` are missing"));
        }
        return (None, None);
    }
    // Some files express the absence of limits by infinite ones.
    let [lower, upper] = attributes.each_ref();
    match [infinite(lower) == Some('-'), infinite(upper) == Some('+')] {
        [true, true] => return (None, None),
        [false, false] => {}
        _ => {
            let message =
                format!("one limit of the joint `{name}` is infinite, so it has no limits");
            let label = "the other limit is ignored";
            reader.report(Diagnostic::note(code::LEFT_OUT, message).at(&element.span(), label));
            return (None, None);
        }
    }
    let mut limit = |(attribute, what): (&Option<Attribute<'_>>, &str)| match attribute {
        Some(attribute) => {
            numbers::<1>(reader, attribute, "a limit", "1.57").map(|[number]| number)
        }
        None if mimics => Some(Rational::ZERO),
        None => {
            let message = format!("the joint `{name}` has no {what} limit; URDF's default is 0");
            let note = Diagnostic::note(code::TAKEN_DEFAULT, message);
            reader.report(note.at(&element.tag(), format!("`{what}` is missing")));
            Some(Rational::ZERO)
        }
    };
    let [Some(lower), Some(upper)] = [(lower, "lower"), (upper, "upper")].map(&mut limit) else {
        return (None, None);
    };
    let span = element.span();
    if lower < upper {
        return (Some([lower, upper]), Some(span));
    }
    let equal = lower == upper;
    reader.report(if equal {
        let message = format!("the limits of joint `{name}` leave no room to move and are ignored");
        Diagnostic::note(code::LEFT_OUT, message).at(&span, "lower and upper limit are equal")
    } else {
        Diagnostic::error(code::LIMITS, "the lower limit is not below the upper limit")
            .at(&span, "")
            .help(match attributes.iter().position(Option::is_none) {
                Some(0) => "add `lower`; URDF's default is 0",
                Some(_) => "add `upper`; URDF's default is 0",
                None => "swap them, or write \"continuous\" for a joint without limits",
            })
    });
    (None, None)
}

/// The sign of an infinite number; `None` for other values.
fn infinite(attribute: &Option<Attribute<'_>>) -> Option<char> {
    let text = attribute.as_ref()?.text.trim().to_ascii_lowercase();
    let sign = if text.starts_with('-') { '-' } else { '+' };
    let unsigned = text.trim_start_matches(['+', '-']);
    ["inf", "infinity"].contains(&unsigned).then_some(sign)
}

fn follows<'a>(reader: &mut Reader<'_>, element: &Element<'a, '_>) -> Option<UrdfMimic<'a>> {
    let joint = element.require(reader, "joint", "name of the leading joint");
    let mut number_of = |name: &str, what: &str, missing: Rational| match element.attribute(name) {
        Some(attribute) => {
            let [number] = numbers::<1>(reader, &attribute, what, "1")?;
            Some((number, Some(attribute.span)))
        }
        None => Some((missing, None)),
    };
    let multiplier = number_of("multiplier", "the multiplier", Rational::ONE);
    let offset = number_of("offset", "the offset", Rational::ZERO);
    let ((multiplier, span), (offset, _)) = (multiplier?, offset?);
    if multiplier.is_zero() {
        reader.report(
            Diagnostic::error(
                code::MIMIC,
                "a joint that mimics another with multiplier 0 is fixed",
            )
            .at(&span.unwrap_or(element.tag()), "the multiplier is 0")
            .help("write the type \"fixed\", or correct the multiplier"),
        );
    }
    Some(UrdfMimic {
        joint: joint?,
        multiplier: Formula::number(&multiplier),
        offset: Formula::number(&offset),
    })
}

fn friction(reader: &mut Reader<'_>, element: &Element<'_, '_>) -> Option<Dynamics> {
    let mut formula_of = |name: &str| {
        let Some(attribute) = element.attribute(name) else {
            return Some(zero());
        };
        let [formula] = formulas::<1>(reader, &attribute, &format!("the {name}"), "0.1")?;
        let value = formula.evaluate(|_| f64::NAN);
        if value < 0.0 {
            let message = format!("the {name} is {value}");
            reader.report(
                Diagnostic::error(code::FRICTION, message)
                    .at(&attribute.span, "must not be negative")
                    .help("correct the value, or leave it out"),
            );
        }
        Some(formula)
    };
    let (damping, friction) = (formula_of("damping"), formula_of("friction"));
    let (damping, friction) = (damping?, friction?);
    if Reader::is_zero(&damping) && Reader::is_zero(&friction) {
        return None;
    }
    Some(Dynamics { damping, friction, span: element.span() })
}
