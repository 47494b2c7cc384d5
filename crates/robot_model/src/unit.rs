//! Units of parameters.

use std::fmt;
use std::ops::Range;

use robot_symbolic::Rational;

/// A unit: a product of powers of the SI base units of mechanics and the radian.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// The text in the file, such as `kg m^2`.
    pub text: String,
    /// The exponents of kilogram, meter and second; radians are dimensionless.
    pub dimension: Dimension,
}

/// Exponents of kilogram, meter and second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of the kilogram.
    pub mass: i8,
    /// Exponent of the meter.
    pub length: i8,
    /// Exponent of the second.
    pub time: i8,
}

impl Dimension {
    /// A pure number or an angle.
    pub const NONE: Dimension = Dimension::new(0, 0, 0);
    /// An acceleration, m/s².
    pub const ACCELERATION: Dimension = Dimension::new(0, 1, -2);
    /// A force, N.
    pub const FORCE: Dimension = Dimension::new(1, 1, -2);
    /// A moment, N m.
    pub const MOMENT: Dimension = Dimension::new(1, 2, -2);

    /// The dimension kg^`mass` m^`length` s^`time`.
    #[must_use]
    pub const fn new(mass: i8, length: i8, time: i8) -> Dimension {
        Dimension { mass, length, time }
    }

    /// The dimension of a product.
    #[must_use]
    pub const fn product(self, other: Dimension) -> Dimension {
        Dimension::new(
            self.mass.saturating_add(other.mass),
            self.length.saturating_add(other.length),
            self.time.saturating_add(other.time),
        )
    }

    /// The dimension of a power.
    #[must_use]
    pub const fn to_power(self, exponent: i8) -> Dimension {
        Dimension::new(
            self.mass.saturating_mul(exponent),
            self.length.saturating_mul(exponent),
            self.time.saturating_mul(exponent),
        )
    }
}

/// The dimension as text, such as `kg m^2 s^-2`; `1` for a pure number.
impl fmt::Display for Dimension {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let factors = [("kg", self.mass), ("m", self.length), ("s", self.time)];
        let factors: Vec<String> = factors
            .iter()
            .filter(|(_, exponent)| *exponent != 0)
            .map(|(name, exponent)| match exponent {
                1 => (*name).to_owned(),
                _ => format!("{name}^{exponent}"),
            })
            .collect();
        if factors.is_empty() {
            return formatter.write_str("1");
        }
        formatter.write_str(&factors.join(" "))
    }
}

/// The units that robot files may contain, with their dimensions.
const UNITS: &[(&str, Dimension)] = &[
    ("1", Dimension::new(0, 0, 0)),
    ("rad", Dimension::new(0, 0, 0)),
    ("kg", Dimension::new(1, 0, 0)),
    ("m", Dimension::new(0, 1, 0)),
    ("s", Dimension::new(0, 0, 1)),
    ("Hz", Dimension::new(0, 0, -1)),
    ("N", Dimension::new(1, 1, -2)),
    ("Pa", Dimension::new(1, -1, -2)),
    ("J", Dimension::new(1, 2, -2)),
    ("W", Dimension::new(1, 2, -3)),
];

/// Other common units. Each is `numerator / denominator` of a unit above, or 0 / 1 if the factor is not rational.
const OTHERS: &[(&str, &str, i64, i64)] = &[
    ("mm", "m", 1, 1000),
    ("cm", "m", 1, 100),
    ("dm", "m", 1, 10),
    ("um", "m", 1, 1_000_000),
    ("km", "m", 1000, 1),
    ("in", "m", 127, 5000),
    ("inch", "m", 127, 5000),
    ("ft", "m", 381, 1250),
    ("g", "kg", 1, 1000),
    ("mg", "kg", 1, 1_000_000),
    ("t", "kg", 1000, 1),
    ("lb", "kg", 45_359_237, 100_000_000),
    ("ms", "s", 1, 1000),
    ("us", "s", 1, 1_000_000),
    ("min", "s", 60, 1),
    ("h", "s", 3600, 1),
    ("kN", "N", 1000, 1),
    ("mN", "N", 1, 1000),
    ("kgf", "N", 980_665, 100_000),
    ("kW", "W", 1000, 1),
    ("deg", "rad", 0, 1),
    ("°", "rad", 0, 1),
    ("rev", "rad", 0, 1),
    ("rpm", "rad/s", 0, 1),
];

/// The reason why a text is not a valid unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UnitError {
    /// An unknown unit or invalid notation: the bytes and the problem.
    Unknown(Range<usize>, String),
    /// A unit that is not a coherent SI unit.
    NotSi {
        /// The bytes of the first such unit.
        span: Range<usize>,
        /// The SI unit to write instead.
        unit: String,
        /// The factor by which values must be multiplied; `None` if it is not rational.
        factor: Option<Rational>,
    },
}

/// The names of the units that robot files may contain.
#[must_use]
pub fn known_units() -> Vec<&'static str> {
    UNITS.iter().map(|(name, _)| *name).collect()
}

impl Unit {
    /// Reads a unit: names with powers, separated by spaces or `*`, and at most one `/`, which applies only to the
    /// factor that follows it.
    ///
    /// Only coherent SI units, whose values need no factor, are accepted: 1, rad, kg, m, s, Hz, N, Pa, J, W.
    ///
    /// # Errors
    ///
    /// An error if the text is not a unit, or is not a coherent SI unit; in the latter case, the error contains the
    /// replacement.
    pub fn parse(text: &str) -> Result<Unit, UnitError> {
        let mut dimension = Dimension::default();
        let mut foreign: Option<Range<usize>> = None;
        let mut factor = Some(Rational::ONE);
        let (mut si, mut copied) = (String::new(), 0);
        for part in factors(text)? {
            let (unit, scale) = part.resolve()?;
            if let Some((name, numerator, denominator)) = scale {
                foreign.get_or_insert(part.span.clone());
                si += text.get(copied..part.span.start).unwrap_or_default();
                si += name;
                copied = part.span.start + part.name.len();
                let scale = Rational::new(numerator, denominator).filter(|scale| !scale.is_zero());
                factor = factor
                    .zip(scale)
                    .and_then(|(factor, scale)| Some(&factor * &power(&scale, part.exponent)?));
            }
            dimension = dimension
                .times(unit, part.exponent)
                .ok_or_else(|| part.fault("the exponent is too large"))?;
        }
        si += text.get(copied..).unwrap_or_default();
        match foreign {
            Some(span) => Err(UnitError::NotSi { span, unit: si, factor }),
            None => Ok(Unit { text: text.to_owned(), dimension }),
        }
    }
}

impl Dimension {
    fn times(self, other: Dimension, exponent: i8) -> Option<Dimension> {
        let combine = |own: i8, other: i8| own.checked_add(other.checked_mul(exponent)?);
        Some(Dimension {
            mass: combine(self.mass, other.mass)?,
            length: combine(self.length, other.length)?,
            time: combine(self.time, other.time)?,
        })
    }
}

/// `base^exponent` for a small exponent.
fn power(base: &Rational, exponent: i8) -> Option<Rational> {
    let base = if exponent < 0 { base.recip()? } else { base.clone() };
    let steps = 0..exponent.unsigned_abs();
    Some(steps.fold(Rational::ONE, |product, _| &product * &base))
}

/// One factor of a unit.
struct Factor<'t> {
    name: &'t str,
    span: Range<usize>,
    exponent: i8,
}

impl Factor<'_> {
    fn fault(&self, what: impl Into<String>) -> UnitError {
        UnitError::Unknown(self.span.clone(), what.into())
    }

    /// The dimension of the factor, and its replacement if it is not a coherent SI unit.
    #[allow(clippy::type_complexity)]
    fn resolve(&self) -> Result<(Dimension, Option<(&'static str, i64, i64)>), UnitError> {
        let si = |name: &str| UNITS.iter().find(|(known, _)| *known == name);
        if let Some((_, dimension)) = si(self.name) {
            return Ok((*dimension, None));
        }
        let other = OTHERS.iter().find(|(known, ..)| *known == self.name);
        let Some((_, unit, numerator, denominator)) = other else {
            let name = crate::diagnostic::quote(self.name);
            let meant = meant(self.name).map(|meant| format!("; did you mean `{meant}`?"));
            let meant = meant.unwrap_or_default();
            return Err(self.fault(format!("`{name}` is not a unit{meant}")));
        };
        let dimension = si(unit).map_or_else(Dimension::default, |(_, dimension)| *dimension);
        Ok((dimension, Some((unit, *numerator, *denominator))))
    }
}

/// The notation that was probably meant: `kg` for `Kg`, `N m` for `Nm`, `m^2` for `m²` and `m2`.
fn meant(name: &str) -> Option<String> {
    let is_known = |name: &&str| UNITS.iter().any(|(known, _)| known == name);
    if let Some((known, _)) = UNITS.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)) {
        return Some((*known).to_owned());
    }
    if let Some(one) = name.strip_suffix('s').filter(|one| one.len() > 1 && is_known(one)) {
        return Some(one.to_owned());
    }
    let powers = [('²', '2'), ('³', '3'), ('2', '2'), ('3', '3')];
    for (sign, exponent) in powers {
        if let Some(base) = name.strip_suffix(sign).filter(is_known) {
            return Some(format!("{base}^{exponent}"));
        }
    }
    let (first, second) = (1..name.len())
        .filter_map(|at| name.split_at_checked(at))
        .find(|(first, second)| is_known(first) && is_known(second))?;
    Some(format!("{first} {second}"))
}

/// Splits a text into factors; the exponent of the factor after `/` is negated.
fn factors(text: &str) -> Result<Vec<Factor<'_>>, UnitError> {
    let mut found = Vec::new();
    let mut divided = None;
    let mut position = 0;
    let separator = |character: char| matches!(character, ' ' | '*' | '·' | '/');
    while position < text.len() {
        let rest = text.get(position..).unwrap_or_default();
        let token = rest.split(separator).next().unwrap_or_default();
        if token.is_empty() {
            let character = rest.chars().next().unwrap_or(' ');
            if character == '/' && divided.replace(found.len()).is_some() {
                let message = "only one `/` is allowed: write negative exponents, as in `N m \
                    rad^-1 s^-1`";
                return Err(UnitError::Unknown(position..position + 1, message.to_owned()));
            }
            position += character.len_utf8();
            continue;
        }
        let span = position..position + token.len();
        position = span.end;
        let (name, exponent) = token.split_once('^').unwrap_or((token, "1"));
        let exponent = match exponent.parse::<i8>() {
            Ok(exponent) if (-9..=9).contains(&exponent) => exponent,
            _ => {
                let message = "expected an integer exponent between -9 and 9";
                return Err(UnitError::Unknown(span, message.to_owned()));
            }
        };
        let exponent = if divided.is_some() { -exponent } else { exponent };
        found.push(Factor { name, span, exponent });
    }
    let after = divided.map_or(1, |at| found.len() - at);
    if found.is_empty() || after != 1 {
        let message = "expected a unit such as `kg m^2`, with at most one factor after a `/`";
        return Err(UnitError::Unknown(0..text.len(), message.to_owned()));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dimension(text: &str) -> (i8, i8, i8) {
        let Dimension { mass, length, time } = Unit::parse(text).unwrap().dimension;
        (mass, length, time)
    }

    #[test]
    fn units_have_their_dimensions() {
        assert_eq!(dimension("kg m^2"), (1, 2, 0));
        assert_eq!(dimension("kg*m^2"), (1, 2, 0));
        assert_eq!(dimension("m/s^2"), (0, 1, -2));
        assert_eq!(dimension("N m"), (1, 2, -2));
        assert_eq!(dimension("N s/m"), (1, 0, -1));
        assert_eq!(dimension("N m s/rad"), (1, 2, -1));
        assert_eq!(dimension("N m rad^-1 s^1"), (1, 2, -1));
        assert_eq!(dimension("1"), (0, 0, 0));
        assert_eq!(dimension("1/s"), (0, 0, -1));
        assert_eq!(dimension("kg·m"), (1, 1, 0));
        assert_eq!(Unit::parse("N s/m").unwrap().dimension.to_string(), "kg s^-1");
    }

    #[test]
    fn other_units_come_with_the_factor() {
        let not_si = |text: &str| match Unit::parse(text) {
            Err(UnitError::NotSi { unit, factor, .. }) => (unit, factor),
            other => panic!("{text}: {other:?}"),
        };
        let rational = |numerator, denominator| Rational::new(numerator, denominator);
        assert_eq!(not_si("mm"), ("m".to_owned(), rational(1, 1000)));
        assert_eq!(not_si("g mm^2"), ("kg m^2".to_owned(), rational(1, 1_000_000_000)));
        assert_eq!(not_si("kg g").0, "kg kg");
        assert_eq!(not_si("N/mm"), ("N/m".to_owned(), rational(1000, 1)));
        assert_eq!(not_si("deg"), ("rad".to_owned(), None));
    }

    #[test]
    fn usual_notations_are_suggested() {
        for (text, meant) in [
            ("Kg", "kg"),
            ("n", "N"),
            ("Nm", "N m"),
            ("kgm", "kg m"),
            ("m2", "m^2"),
            ("kg m²", "m^2"),
            ("rads", "rad"),
            ("Ns", "N s"),
        ] {
            let Err(UnitError::Unknown(_, message)) = Unit::parse(text) else { panic!("{text}") };
            assert!(message.ends_with(&format!("did you mean `{meant}`?")), "{text}: {message}");
        }
        for text in ["furlong", "é", "²", "stone"] {
            let Err(UnitError::Unknown(_, message)) = Unit::parse(text) else { panic!("{text}") };
            assert!(!message.contains("mean"), "{text}: {message}");
        }
    }

    #[test]
    fn nonsense_is_not_a_unit() {
        for text in ["", " ", "/", "m/", "furlong", "m^x", "m^99", "m/s/s", "m/s kg", "kg m²", "m^"]
        {
            let error = Unit::parse(text).unwrap_err();
            assert!(matches!(error, UnitError::Unknown(..)), "{text}: {error:?}");
        }
    }
}
