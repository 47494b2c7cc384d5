//! Inertia tensors: reading, the shift to the centre of mass, and what no body can have.

use nalgebra::{Matrix3, SymmetricEigen};
use robot_symbolic::{Formula, Rational};

use super::locations::BodyLocation;
use super::placement::{RPY, zero};
use super::reader::Reader;
use super::table::{Entry, Table};
use super::value::{Quantity, quantity};
use crate::diagnostic::{Diagnostic, Span, code};
use crate::model::{Axis, Inertia, Move};

const MOMENT: Quantity = quantity("a moment of inertia", 1, 2, 0);

/// Figures are rounded: this part of the largest principal moment is no violation.
pub(super) const TOLERANCE: f64 = 1e-3;

/// A tensor about the centre of mass, and the turns from the link's axes to its own.
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

/// Reads `inertia` of a body of that mass and centre of mass.
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
    let Some(mut table) = reader.table(entry.value, "an inertia") else {
        return tensor;
    };
    let unchecked = table.get("unchecked");
    place.unchecked = unchecked.and_then(|entry| reader.boolean(entry.value)) == Some(true);
    tensor.inertia = entries(reader, &mut table, place.unchecked);
    if let Some(entry) = table.get("rpy") {
        let [roll, pitch, yaw] = reader.vector(entry.value, RPY);
        tensor.turns = vec![
            Move::Rotate(Axis::Z, yaw),
            Move::Rotate(Axis::Y, pitch),
            Move::Rotate(Axis::X, roll),
        ];
    }
    let shifted = about(reader, &mut table, !tensor.turns.is_empty());
    table.finish(reader);
    if shifted {
        match shift(&tensor.inertia, mass, center) {
            Some(inertia) => {
                tensor.inertia = inertia;
                finite(reader, &tensor.inertia, &span);
            }
            None => reader.report(
                Diagnostic::error(code::LIMIT, "the expressions are too large to be shifted")
                    .at(&span, "about the origin of the link's frame")
                    .help("give the tensor about the centre of mass"),
            ),
        }
    }
    if !place.unchecked {
        check(reader, &tensor.inertia, &span, shifted);
    }
    tensor
}

/// The six entries; products are 0 where they are left out, and so is all of an unchecked tensor.
fn entries(reader: &mut Reader<'_>, table: &mut Table<'_>, unchecked: bool) -> Inertia {
    let mut entry = |key: &'static str, needed: bool| {
        let entry = if needed && !unchecked {
            let help = format!("add `{key} = …`, or `unchecked = true` where it never acts");
            table.require_with(reader, key, &help)
        } else {
            table.get(key)
        };
        match entry {
            Some(entry) => reader.formula(entry.value, MOMENT),
            None if needed && !unchecked => Reader::unknown(),
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

/// Whether the tensor is about the origin of the link's frame.
fn about(reader: &mut Reader<'_>, table: &mut Table<'_>, turned: bool) -> bool {
    let Some(entry) = table.get("about") else {
        return false;
    };
    let words = &["center_of_mass", "origin"];
    let origin = reader.word(entry.value, "a point of the link", words) == Some("origin");
    if origin && turned {
        reader.report(
            Diagnostic::error(code::CONFLICT, "an inertia about the origin is in link axes")
                .at(&entry.value.span(), "about the origin of the link's frame")
                .help("leave out `rpy`, or give the tensor about the centre of mass"),
        );
    }
    origin && !turned
}

/// Steiner: I_c = I_o − m (c·c 1 − c cᵀ).
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

/// Reports an entry that the shift has carried beyond the range of numbers.
fn finite(reader: &mut Reader<'_>, inertia: &Inertia, span: &Span) {
    let known = entries_of(inertia).map(|entry| reader.known(entry));
    if known.iter().flatten().all(|value| value.is_finite()) {
        return;
    }
    reader.report(
        Diagnostic::error(code::NUMBER, "the tensor about the centre of mass is not finite")
            .at(span, "about the origin of the link's frame")
            .help("see whether mass, centre of mass and inertia are in kg, m and kg m^2"),
    );
}

fn entries_of(inertia: &Inertia) -> [&Formula; 6] {
    let Inertia { xx, yy, zz, xy, xz, yz } = inertia;
    [xx, yy, zz, xy, xz, yz]
}

/// A formula of formulas: a number where all of them are, else `pattern` with each `#i` replaced
/// by the text of the i-th; `None` where the text grows beyond what a formula may be.
fn compute(
    operands: &[&Formula],
    pattern: &str,
    number: impl Fn(&[&Rational]) -> Rational,
) -> Option<Formula> {
    let numbers: Vec<_> = operands.iter().map(|operand| operand.as_number()).collect();
    let rationals: Vec<_> =
        numbers.iter().filter_map(|number| number.as_ref()?.as_rational()).collect();
    if rationals.len() == operands.len() {
        return Some(Formula::number(&number(&rationals)));
    }
    let mut text = pattern.to_owned();
    for (index, operand) in operands.iter().enumerate() {
        text = text.replace(&format!("#{index}"), operand.text());
    }
    Formula::parse(&text).ok()
}

/// Reports a tensor that no body has. Symbols without nominal values are left alone; all zeros are
/// a point mass.
fn check(reader: &mut Reader<'_>, inertia: &Inertia, span: &Span, shifted: bool) {
    let Some([xx, yy, zz, xy, xz, yz]) = values(reader, inertia) else {
        return;
    };
    let Some(moments) = principal_moments([xx, yy, zz, xy, xz, yz]) else {
        return;
    };
    let [least, middle, largest] = moments;
    let tolerance = TOLERANCE * largest.abs();
    let negative = least < -tolerance || xx.min(yy).min(zz) < 0.0;
    let triangle = largest > least + middle + tolerance;
    let printed = moments.map(significant).join(", ");
    let label = format!("principal moments {printed} kg m^2");
    let diagnostic = if negative {
        Diagnostic::error(
            code::INERTIA_SIGN,
            "no body has this inertia: a principal moment is negative",
        )
        .because("a moment of inertia is a sum of masses times squares")
        .help(if shifted {
            "about the centre of mass the tensor is negative: see whether the figures are about \
             the centre of mass already"
        } else {
            "see that products of inertia have the tensor's sign and that all are in kg m^2"
        })
    } else if triangle {
        Diagnostic::error(
            code::INERTIA_TRIANGLE,
            "no body has this inertia: one principal moment exceeds the sum of the others",
        )
        .because(format!(
            "x² + y² ≤ (y² + z²) + (z² + x²) for every part of a body; {} % of the largest moment \
             is allowed for rounding",
            TOLERANCE * 100.0
        ))
        .help(
            "correct the figures; where they are published so, or entries that never act are left \
             out, add `unchecked = true`",
        )
    } else {
        return;
    };
    reader.report(diagnostic.at(span, label));
}

fn values(reader: &Reader<'_>, inertia: &Inertia) -> Option<[f64; 6]> {
    let known = entries_of(inertia).map(|entry| reader.known(entry));
    let mut values = [0.0; 6];
    for (value, known) in values.iter_mut().zip(known) {
        *value = known.filter(|known| known.is_finite())?;
    }
    Some(values)
}

/// The eigenvalues of the tensor `[xx, yy, zz, xy, xz, yz]` in ascending order; `None` where all
/// entries are 0.
pub(super) fn principal_moments(tensor: [f64; 6]) -> Option<[f64; 3]> {
    // Scaled, so that no square overflows.
    let scale = tensor.iter().fold(0.0_f64, |scale, entry| scale.max(entry.abs()));
    if scale == 0.0 {
        return None;
    }
    let [xx, yy, zz, xy, xz, yz] = tensor.map(|entry| entry / scale);
    let matrix = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let eigen = SymmetricEigen::try_new(matrix, f64::EPSILON, 1000)?;
    let mut moments: [f64; 3] = eigen.eigenvalues.into();
    moments.sort_by(f64::total_cmp);
    Some(moments.map(|moment| moment * scale))
}

/// Six significant digits.
fn significant(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if rounded != 0.0 && !(1e-4..1e6).contains(&rounded.abs()) {
        return format!("{rounded:e}");
    }
    rounded.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_moments_are_eigenvalues() {
        assert_eq!(principal_moments([0.0; 6]), None);
        let moments = principal_moments([2.0, 2.0, 5.0, 1.0, 0.0, 0.0]).unwrap();
        for (found, expected) in moments.iter().zip([1.0, 3.0, 5.0]) {
            assert!((found - expected).abs() < 1e-14, "{moments:?}");
        }
        let [least, ..] = principal_moments([1e300, 1e300, 1e300, 2e300, 0.0, 0.0]).unwrap();
        assert!((least + 1e300).abs() < 1e286);
    }

    #[test]
    fn digits_are_few() {
        assert_eq!(significant(0.1 + 0.2), "0.3");
        assert_eq!(significant(1.234_567_8e-7), "1.23457e-7");
        assert_eq!(significant(0.0), "0");
    }

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
