//! Values of the file: numbers, expressions, words and lists.

use std::array;

use robot_symbolic::{Formula, MAX_DIGITS, Rational};
use toml::Spanned;
use toml::de::{DeString, DeValue};

use super::locations::AngleLocation;
use super::reader::Reader;
use super::shape::Shape;
use super::strings;
use super::table::{Table, Value, list};
use crate::diagnostic::{Diagnostic, Span, code, is_invisible, quote};
use crate::unit::Dimension;

/// The maximum length of a text.
const MAX_TEXT: usize = 4096;

/// The name of a value in messages, and its dimension if it is fixed.
#[derive(Clone, Copy)]
pub(super) struct Quantity {
    pub(super) what: &'static str,
    pub(super) dimension: Option<Dimension>,
}

/// A quantity in kg^`mass` m^`length` s^`time`.
pub(super) const fn quantity(what: &'static str, mass: i8, length: i8, time: i8) -> Quantity {
    Quantity { what, dimension: Some(Dimension::new(mass, length, time)) }
}

/// Whether a character is a control character other than line ends and tabs, or invisible.
pub(super) fn is_hidden(character: char) -> bool {
    let is_control = character.is_control() && !matches!(character, '\n' | '\r' | '\t');
    is_control || is_invisible(character)
}

/// An inline table of this shape, for messages.
fn example(shape: &Shape) -> &'static str {
    match shape.what {
        "a joint" => "{ type = \"revolute\", axis = \"z\" }",
        "an origin" => "{ xyz = [0, 0, 1] }",
        "an inertia" => "{ xx = 1, yy = 1, zz = 1 }",
        "a `friction` table" => "{ viscous = 0.1 }",
        "a drive" => "{ armature = 0.1 }",
        "a `mimic` table" => "{ joint = \"1\" }",
        _ => "{ … }",
    }
}

impl Reader<'_> {
    pub(super) fn wrong_type(&mut self, value: Value<'_>, expected: &str) {
        let found = match value.get_ref() {
            DeValue::String(_) => "a string",
            DeValue::Float(_) if expected.contains("number") => "a number with a decimal point",
            DeValue::Integer(_) | DeValue::Float(_) => "a number",
            DeValue::Boolean(_) => "a Boolean",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a table",
        };
        self.report(
            Diagnostic::error(code::WRONG_TYPE, format!("expected {expected}, found {found}"))
                .at(&value.span(), format!("this is {found}"))
                .help(format!("write {expected}")),
        );
    }

    pub(super) fn table<'a>(
        &mut self,
        value: Value<'a>,
        shape: &'static Shape,
    ) -> Option<Table<'a>> {
        match value.get_ref() {
            DeValue::Table(keys) => Some(Table::new(keys, value.span(), shape)),
            _ => {
                let (what, example) = (shape.what, example(shape));
                let expected = match (what.starts_with('['), what.strip_suffix(" table")) {
                    (true, _) => format!("one table {what}"),
                    (false, Some(named)) => format!("{named} table `{example}`"),
                    (false, None) => format!("{what} as a table `{example}`"),
                };
                self.wrong_type(value, &expected);
                None
            }
        }
    }

    /// The entries of a list; `expected` describes the list for messages.
    pub(super) fn list<'a>(
        &mut self,
        value: Value<'a>,
        expected: &str,
    ) -> Option<&'a [Spanned<DeValue<'a>>]> {
        match value.get_ref() {
            DeValue::Array(entries) => Some(entries),
            _ => {
                self.wrong_type(value, expected);
                None
            }
        }
    }

    /// A list of exactly `N` entries.
    pub(super) fn entries<'a, const N: usize>(
        &mut self,
        value: Value<'a>,
        expected: &str,
    ) -> Option<[Value<'a>; N]> {
        let entries = self.list(value, expected)?;
        if entries.len() == N {
            return entries.iter().collect::<Vec<_>>().try_into().ok();
        }
        self.report(
            Diagnostic::error(
                code::WRONG_COUNT,
                match entries.len() {
                    1 => format!("expected {expected}, found one entry"),
                    count => format!("expected {expected}, found {count} entries"),
                },
            )
            .at(&value.span(), format!("{N} entries are expected here"))
            .help(format!("write {expected}")),
        );
        None
    }

    pub(super) fn boolean(&mut self, value: Value<'_>) -> Option<bool> {
        match value.get_ref() {
            DeValue::Boolean(value) => Some(*value),
            _ => {
                self.wrong_type(value, "`true` or `false`");
                None
            }
        }
    }

    pub(super) fn string<'a>(
        &mut self,
        value: Value<'a>,
        expected: &str,
    ) -> Option<&'a DeString<'a>> {
        match value.get_ref() {
            DeValue::String(text) => Some(text),
            _ => {
                self.wrong_type(value, expected);
                None
            }
        }
    }

    /// Reads a text for human readers, in which control and invisible characters other than line ends and tabs are not
    /// allowed.
    pub(super) fn prose(&mut self, value: Value<'_>) -> Option<String> {
        let text = self.string(value, "text in quotes")?.as_ref();
        let bad = |(_, character): &(usize, char)| is_hidden(*character);
        if let Some((at, character)) = text.char_indices().find(bad) {
            let range = at..at + character.len_utf8();
            let span = strings::place(self.text, &value.span(), text, range);
            self.report(
                Diagnostic::error(code::TEXT, "the text contains an invisible character")
                    .at(&span, format!("U+{:04X}", u32::from(character)))
                    .because("with such characters, a text can look different from what it is")
                    .help("remove it"),
            );
            return None;
        }
        if text.len() > MAX_TEXT {
            let message = format!("the text has {} bytes; the limit is {MAX_TEXT}", text.len());
            let start = value.span().start;
            self.report(
                Diagnostic::error(code::LIMIT, message)
                    .at(&(start..start), "this text")
                    .help("move long remarks to a document beside the file"),
            );
            return None;
        }
        Some(text.to_owned())
    }

    /// Reads one of the given words; `what` names the property that they specify.
    pub(super) fn word<'n>(
        &mut self,
        value: Value<'_>,
        what: &str,
        words: &[&'n str],
    ) -> Option<&'n str> {
        let text = self.string(value, &format!("{what}, one of {}", list(words)))?;
        let found = words.iter().copied().find(|word| word == text);
        if found.is_none() {
            let label = match self.nearest(text, words.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("not {what}"),
            };
            let message = format!("`{}` is not {what}", quote(text));
            self.report(
                Diagnostic::error(code::UNKNOWN_WORD, message)
                    .at(&value.span(), label)
                    .help(format!("use one of {}", list(words))),
            );
        }
        found
    }

    /// Reads a number exactly as it is written.
    pub(super) fn number(&mut self, value: Value<'_>, expected: &str) -> Option<Rational> {
        let number = match value.get_ref() {
            DeValue::Float(float) => Rational::from_decimal(float.as_str()),
            DeValue::Integer(integer) if integer.radix() == 10 => {
                Rational::from_decimal(integer.as_str())
            }
            DeValue::Integer(integer) => {
                i64::from_str_radix(integer.as_str(), integer.radix()).ok().map(Rational::integer)
            }
            _ => {
                self.wrong_type(value, expected);
                return None;
            }
        };
        let usable = number.filter(|number| {
            let float = number.to_f64();
            float.is_finite() && (float != 0.0 || number.is_zero())
        });
        if usable.is_none() {
            let text = self.text.get(value.span()).unwrap_or_default();
            let too_long = format!("longer than {MAX_DIGITS} digits");
            let (message, help) = match text.trim_start_matches(['+', '-']) {
                "nan" => ("not a number", "give a number"),
                "inf" => ("infinite", "give a finite value"),
                digits if digits.len() > MAX_DIGITS => {
                    (too_long.as_str(), "write the number with fewer digits")
                }
                _ => (
                    "outside the range of floating-point numbers",
                    "magnitudes may be at most 1e30; write 0 for a value that is negligible",
                ),
            };
            self.report(
                Diagnostic::error(code::NUMBER, format!("`{}` is {message}", quote(text)))
                    .at(&value.span(), message)
                    .help(help),
            );
        }
        usable
    }

    /// Reads a number, or an expression over the parameters, for a quantity with a dimension. An invalid one is
    /// reported and replaced by [`Reader::unknown`].
    pub(super) fn formula(&mut self, value: Value<'_>, quantity: Quantity) -> Formula {
        let text = match value.get_ref() {
            DeValue::String(text) => text.as_ref(),
            DeValue::Integer(_) | DeValue::Float(_) => {
                let number = self.number(value, quantity.what);
                return number.map_or_else(Reader::unknown, |number| Formula::number(&number));
            }
            _ => {
                let what = quantity.what;
                self.wrong_type(
                    value,
                    &format!("{what} as a number or as an expression in quotes"),
                );
                return Reader::unknown();
            }
        };
        let (file, span) = (self.text, value.span());
        let place = |range: Span| strings::place(file, &span, text, range);
        match Formula::parse(text) {
            Ok(formula) => {
                let whole = place(0..text.len());
                let usable = self.resolve(&formula, &place)
                    && self.finite(&formula, &whole)
                    && self.fits(&formula, quantity, &whole);
                if usable { formula } else { Reader::unknown() }
            }
            Err(error) => {
                let message = match text.trim() {
                    "" => "an empty string is not an expression".to_owned(),
                    _ => format!("`{}` is not an expression: {}", quote(text), error.message),
                };
                let mut diagnostic =
                    Diagnostic::error(code::EXPRESSION, message).at(&place(error.span), "");
                diagnostic.help = error.help;
                self.report(diagnostic);
                Reader::unknown()
            }
        }
    }

    /// Reads an angle, rad, and records it with its place.
    pub(super) fn angle(&mut self, value: Value<'_>, quantity: Quantity) -> Formula {
        let angle = self.formula(value, quantity);
        self.angles.push(AngleLocation { value: angle.clone(), place: value.span() });
        angle
    }

    /// Reads three angles, rad.
    pub(super) fn angle_vector(&mut self, value: Value<'_>, quantity: Quantity) -> [Formula; 3] {
        self.three(value, quantity, Reader::angle)
    }

    /// Reads three numbers or expressions.
    pub(super) fn vector(&mut self, value: Value<'_>, quantity: Quantity) -> [Formula; 3] {
        self.three(value, quantity, Reader::formula)
    }

    fn three(
        &mut self,
        value: Value<'_>,
        quantity: Quantity,
        read_entry: impl Fn(&mut Self, Value<'_>, Quantity) -> Formula,
    ) -> [Formula; 3] {
        let expected = format!("{} as `[x, y, z]`", quantity.what);
        match self.entries::<3>(value, &expected) {
            Some(entries) => entries.map(|entry| read_entry(self, entry, quantity)),
            None => array::from_fn(|_| Reader::unknown()),
        }
    }
}
