//! Inertia tensors: reading, the shift to the center of mass, and the check that a body can have them.

use robot_symbolic::Formula;

use super::compute::compute;
use super::locations::BodyLocation;
use super::placement::{RPY, zero};
use super::reader::Reader;
use super::shape::{INERTIA, POINTS};
use super::table::{Entry, Table};
use super::value::{Quantity, quantity};
use crate::diagnostic::{Diagnostic, Span, code};
use crate::physics::{TOLERANCE, Verdict, judge_shifted};
use crate::robot::{Axis, Inertia, Move};

const MOMENT: Quantity = quantity("a moment of inertia", 1, 2, 0);

/// A tensor about the center of mass, and the rotations from the link's axes to the axes of the tensor.
pub(super) struct Tensor {
    pub(super) inertia: Inertia,
    pub(super) turns: Vec<Move>,
}

impl Tensor {
    pub(super) fn none() -> Tensor {
        Tensor {
            inertia: Inertia {
                xx: zero(),
                yy: zero(),
                zz: zero(),
                xy: zero(),
                xz: zero(),
                yz: zero(),
            },
            turns: Vec::new(),
        }
    }
}

/// Reads `inertia` of a body with the given mass and center of mass.
pub(super) fn read(
    reader: &mut Reader<'_>,
    entry: &Entry<'_>,
    mass: &Formula,
    center: &[Formula; 3],
    place: &mut BodyLocation,
) -> Tensor {
    let span = entry.value.span();
    place.inertia = Some(span.clone());
    let mut tensor = Tensor::none();
    let Some(mut table) = reader.table(entry.value, &INERTIA) else {
        return tensor;
    };
    let unchecked = table.get("unchecked");
    let is_given = unchecked.is_some();
    let unchecked = unchecked.and_then(|entry| reader.boolean(entry.value));
    place.unchecked = unchecked == Some(true);
    // If the value is not a Boolean, it is not known which entries are required.
    let optional = place.unchecked || (is_given && unchecked.is_none());
    tensor.inertia = entries(reader, &mut table, optional);
    if let Some(entry) = table.get("rpy") {
        place.axes = Some(entry.value.span());
        let [roll, pitch, yaw] = reader.angle_vector(entry.value, RPY);
        tensor.turns = vec![
            Move::Rotate(Axis::Z, yaw),
            Move::Rotate(Axis::Y, pitch),
            Move::Rotate(Axis::X, roll),
        ];
    }
    let shifted = about(reader, &mut table, !tensor.turns.is_empty());
    let given = tensor.inertia.clone();
    table.finish(reader);
    if shifted {
        match shift(&tensor.inertia, mass, center) {
            Some(inertia) => {
                tensor.inertia = inertia;
                finite(reader, &tensor.inertia, &span);
            }
            None => reader.report(
                Diagnostic::error(
                    code::LIMIT,
                    "the expressions are too large for the tensor to \
                    be shifted",
                )
                .at(&span, "about the origin of the link frame")
                .help("give the tensor about the center of mass"),
            ),
        }
    }
    if !place.unchecked {
        check(reader, &tensor.inertia, &given, &span, shifted);
    }
    tensor
}

/// Reads the six entries. Products of inertia default to 0; if they are `optional`, all entries do.
fn entries(reader: &mut Reader<'_>, table: &mut Table<'_>, optional: bool) -> Inertia {
    let mut entry = |key: &'static str, needed: bool| {
        let entry = if needed && !optional {
            let help = format!("add `{key} = …`, or `unchecked = true` if it has no effect");
            table.require_with(reader, key, &help)
        } else {
            table.get(key)
        };
        match entry {
            Some(entry) => reader.formula(entry.value, MOMENT),
            None if needed && !optional => Reader::unknown(),
            None => zero(),
        }
    };
    Inertia {
        xx: entry("xx", true),
        yy: entry("yy", true),
        zz: entry("zz", true),
        xy: entry("xy", false),
        xz: entry("xz", false),
        yz: entry("yz", false),
    }
}

/// Reads `about`: whether the tensor is about the origin of the link's frame.
fn about(reader: &mut Reader<'_>, table: &mut Table<'_>, turned: bool) -> bool {
    let Some(entry) = table.get("about") else {
        return false;
    };
    let origin = reader.word(entry.value, "a point of the link", POINTS) == Some("origin");
    if origin && turned {
        reader.report(
            Diagnostic::error(code::CONFLICT, "an inertia about the origin cannot have `rpy`")
                .at(&entry.value.span(), "about the origin of the link frame")
                .help("leave out `rpy`, or give the tensor about the center of mass"),
        );
    }
    origin && !turned
}

/// Shifts a tensor to the center of mass by the parallel-axis theorem: I_c = I_o − m (c·c 1 − c cᵀ).
fn shift(about_origin: &Inertia, mass: &Formula, [x, y, z]: &[Formula; 3]) -> Option<Inertia> {
    let moment = |own: &Formula, a: &Formula, b: &Formula| {
        let squares = compute(&[a, b], "(#0)^2 + (#1)^2", |v| &(v[0] * v[0]) + &(v[1] * v[1]))?;
        compute(&[own, mass, &squares], "(#0) - (#1)*(#2)", |v| v[0] - &(v[1] * v[2]))
    };
    let product = |own: &Formula, a: &Formula, b: &Formula| {
        compute(&[own, mass, a, b], "(#0) + (#1)*(#2)*(#3)", |v| v[0] + &(&(v[1] * v[2]) * v[3]))
    };
    Some(Inertia {
        xx: moment(&about_origin.xx, y, z)?,
        yy: moment(&about_origin.yy, x, z)?,
        zz: moment(&about_origin.zz, x, y)?,
        xy: product(&about_origin.xy, x, y)?,
        xz: product(&about_origin.xz, x, z)?,
        yz: product(&about_origin.yz, y, z)?,
    })
}

/// Reports a shifted entry that exceeds the range of floating-point numbers.
fn finite(reader: &mut Reader<'_>, inertia: &Inertia, span: &Span) {
    let known = inertia.entries().map(|entry| reader.known(entry));
    if known.iter().flatten().all(|value| value.is_finite()) {
        return;
    }
    reader.report(
        Diagnostic::error(
            code::NUMBER,
            "the inertia tensor about the center of mass is not finite",
        )
        .at(span, "about the origin of the link frame")
        .help("check that mass, center of mass and inertia are in kg, m and kg m^2"),
    );
}

/// The rounding error of a tensor that is shifted to the center of mass, relative to the largest entry of the given one.
const ROUNDING: f64 = 1e-12;

/// Reports a tensor that no body can have, with the tensor as it is given. Tensors with symbols that have no nominal
/// values are not checked; a tensor of zeros describes a point mass.
fn check(reader: &mut Reader<'_>, inertia: &Inertia, given: &Inertia, span: &Span, shifted: bool) {
    let Some(tensor) = values(reader, inertia) else {
        return;
    };
    let largest = values(reader, given).into_iter().flatten().map(f64::abs).fold(0.0, f64::max);
    let verdict = judge_shifted(tensor, if shifted { ROUNDING * largest } else { 0.0 });
    let diagnostic = match &verdict {
        Verdict::Possible => return,
        Verdict::Negative(_) => Diagnostic::error(verdict.code(), verdict.message())
            .because("a moment of inertia is a sum of mass times distance squared, so it is never negative")
            .help(if shifted {
                "shifted to the center of mass, the tensor has a negative principal moment: check \
                 whether the given one is already about the center of mass"
            } else {
                "check the signs of the products of inertia (entries of the tensor, xy = -∫xy \
                 dm) and that all values are in kg m^2"
            }),
        Verdict::Triangle(..) => Diagnostic::error(verdict.code(), verdict.message())
            .because(format!(
                "x² + y² ≤ (y² + z²) + (z² + x²) for every point of a body; {} % of the largest \
                 moment is allowed for rounding",
                TOLERANCE * 100.0
            ))
            .help(
                "correct the values; if they are published this way, or if entries without \
                 effect are left out, add `unchecked = true`",
            ),
    };
    reader.report(diagnostic.graded(reader.options.unphysical()).at(span, verdict.label()));
}

fn values(reader: &Reader<'_>, inertia: &Inertia) -> Option<[f64; 6]> {
    let known = inertia.entries().map(|entry| reader.known(entry));
    let mut values = [0.0; 6];
    for (value, known) in values.iter_mut().zip(known) {
        *value = known.filter(|known| known.is_finite())?;
    }
    Some(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shift_is_exact() {
        let number = |text: &str| Formula::parse(text).unwrap();
        let mut tensor = Tensor::none().inertia;
        tensor.xx = number("1");
        tensor.zz = number("J");
        let center = [number("0.1"), number("0.2"), number("c")];
        let shifted = shift(&tensor, &number("10"), &center).unwrap();
        assert_eq!(shifted.xy, number("0.2"));
        assert_eq!(shifted.zz.text(), "(J) - (10)*(0.05)");
        assert_eq!(shifted.xx.evaluate(|_| 0.3), 1.0 - 10.0 * (0.04 + 0.09));
    }
}
