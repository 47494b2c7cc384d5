//! Pinned plans: the result of a search is kept as text beside the robot file, so that builds need not search.

use std::fmt::Write as _;

use toml::de::{DeTable, DeValue};

use crate::economical::plan::search::Measure;
use crate::economical::plan::{Entry, FreeAcceleration, LinkPlan, Origin, Place, Plan, Turn};

/// A plan and the mechanics for which it was searched.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pin {
    /// Identifies the [mechanics](crate::economical::mechanics()) for which the plan was searched. If a robot has
    /// another fingerprint, the plan is stale.
    pub fingerprint: String,
    /// Identifies the rest of the text, [`Pin::content`]. If the content has another digest, the text was edited.
    pub digest: String,
    /// The measure that the search minimized.
    pub measure: Measure,
    /// The number of multiplications and additions of inverse dynamics with the plan.
    pub operations: usize,
    /// Whether the plan was chosen among several by the run time of its code on the machine of the search. Another
    /// machine or another run may choose another plan.
    pub tuned: bool,
    /// The plan.
    pub plan: Plan,
}

/// The error for a text that is not a pinned plan; it describes the problem and what was expected.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct PinError(String);

/// The version of the format that is written and read.
const FORMAT: usize = 3;

/// The name of an option that is on or off, with access to it.
type Flag = (&'static str, fn(&mut LinkPlan) -> &mut bool);

const FLAGS: [Flag; 8] = [
    ("angle_sum", |plan| &mut plan.angle_sum),
    ("column", |plan| &mut plan.column),
    ("doubled", |plan| &mut plan.doubled),
    ("diagonal", |plan| &mut plan.diagonal),
    ("moment_x", |plan| &mut plan.moment[0]),
    ("moment_y", |plan| &mut plan.moment[1]),
    ("moment_z", |plan| &mut plan.moment[2]),
    ("composite_sum", |plan| &mut plan.composite_sum),
];

const ORIGINS: [(&str, Origin); 7] = [
    ("file", Origin::File),
    ("next_normal", Origin::NextNormal),
    ("previous_normal", Origin::PreviousNormal),
    ("zero_xz", Origin::ZeroXz),
    ("zero_yz", Origin::ZeroYz),
    ("center_of_mass", Origin::CenterOfMass),
    ("parent", Origin::Parent),
];

const TURNS: [(&str, Turn); 3] =
    [("file", Turn::File), ("next_normal", Turn::NextNormal), ("first_moment", Turn::FirstMoment)];

const ENTRIES: [(&str, Option<Entry>); 9] = [
    ("none", None),
    ("x", Some(Entry::X)),
    ("y", Some(Entry::Y)),
    ("xx", Some(Entry::Xx)),
    ("yy", Some(Entry::Yy)),
    ("xy", Some(Entry::Xy)),
    ("xz", Some(Entry::Xz)),
    ("yz", Some(Entry::Yz)),
    ("xx_yy", Some(Entry::XxYy)),
];

const RATES: [(&str, FreeAcceleration); 6] = [
    ("zero", FreeAcceleration::Zero),
    ("still", FreeAcceleration::Still),
    ("upper", FreeAcceleration::Upper),
    ("lower", FreeAcceleration::Lower),
    ("next_x", FreeAcceleration::NextX),
    ("next_y", FreeAcceleration::NextY),
];

const MEASURES: [(&str, Measure); 2] =
    [("operations", Measure::Operations), ("instructions", Measure::Instructions)];

impl Pin {
    /// The pinned plan as TOML text.
    #[must_use]
    pub fn to_text(&self) -> String {
        let mut text = String::from(
            "# The cheapest form of the recursion for the robot file beside this one. Written by\n\
             # `robot-symbolic search`; after a change of the robot's mechanics, run it again.\n",
        );
        // Writing to a string does not fail.
        let _ = writeln!(text, "format = {FORMAT}\ndigest = \"{}\"", self.digest);
        text.push_str(&self.content());
        text
    }

    /// The result of the search and the mechanics for which it holds, as [`Pin::to_text`] writes them: without remarks,
    /// format and digest.
    #[must_use]
    pub fn content(&self) -> String {
        let mut text = format!("fingerprint = \"{}\"\n", self.fingerprint);
        if self.measure == Measure::Instructions {
            text.push_str("measure = \"instructions\"\n");
        }
        // Writing to a string does not fail.
        let _ = writeln!(text, "operations = {}", self.operations);
        if self.tuned {
            text.push_str("tuned = true\n");
        }
        if let Some((link, component)) = self.plan.unit_length {
            let _ = writeln!(text, "unit_length = [{link}, {component}]");
        }
        for link in &self.plan.links {
            text.push_str(&link_text(link));
        }
        text
    }

    /// Reads text that [`Pin::to_text`] wrote.
    ///
    /// # Errors
    ///
    /// An error if the text is not a pinned plan, or is one in another version of the format.
    pub fn from_text(text: &str) -> Result<Pin, PinError> {
        let (table, faults) = DeTable::parse_recoverable(text);
        if let Some(fault) = faults.first() {
            let start = fault.span().map_or(text.len(), |span| span.start);
            let line = 1 + text.get(..start).unwrap_or(text).matches('\n').count();
            return Err(PinError(format!(
                "line {line} is not that of a plan: {}",
                fault.message()
            )));
        }
        if table.get_ref().iter().any(|(key, _)| key.get_ref() == "robot") {
            return Err(PinError("the pinned plan is a robot file".to_owned()));
        }
        let mut keys = Keys::new(table.get_ref());
        // The format is checked first, because other formats may have other keys.
        let format = keys.required("format", number)?;
        match format {
            FORMAT => {}
            1 | 2 => {
                return Err(PinError(format!(
                    "the pinned plan has format {format}, which earlier versions wrote; expected {FORMAT}"
                )));
            }
            other => {
                return Err(PinError(format!(
                    "the pinned plan has format {other}, which this version does not know; expected {FORMAT}"
                )));
            }
        }
        let pin = Pin {
            fingerprint: keys.required("fingerprint", text_of)?,
            digest: keys.required("digest", text_of)?,
            measure: match keys.optional("measure", text_of)? {
                Some(name) => value_of(&MEASURES, &name)?,
                None => Measure::Operations,
            },
            operations: keys.required("operations", number)?,
            tuned: keys.optional("tuned", flag)?.unwrap_or_default(),
            plan: Plan {
                unit_length: keys
                    .optional("unit_length", |value| exactly(value, number))?
                    .map(|[link, component]| (link, component)),
                links: keys.optional("link", |value| list(value, link_of))?.unwrap_or_default(),
            },
        };
        keys.end()?;
        Ok(pin)
    }
}

fn link_text(link: &LinkPlan) -> String {
    let mut plan = link.clone();
    let flags: Vec<String> = FLAGS
        .iter()
        .filter(|(_, flag)| *flag(&mut plan))
        .map(|(name, _)| format!("\"{name}\""))
        .collect();
    let residual = link.residual.map(|entry| format!("\"{}\"", name_of(&ENTRIES, entry)));
    let mut text = format!(
        "\n[[link]]\norigin = \"{}\"\nturn = \"{}\"\noptions = [{}]\nresidual = [{}]\nfree = \"{}\"\n",
        name_of(&ORIGINS, link.origin),
        name_of(&TURNS, link.turn),
        flags.join(", "),
        residual.join(", "),
        name_of(&RATES, link.free),
    );
    if let Some(Place { link, turned }) = link.projected_at {
        let _ = writeln!(text, "meeting = {{ link = {link}, turned = {turned} }}");
    }
    text
}

fn name_of<T: PartialEq + Copy>(table: &[(&'static str, T)], value: T) -> &'static str {
    table.iter().find(|(_, known)| *known == value).map_or("", |(name, _)| *name)
}

fn value_of<T: Copy>(table: &[(&'static str, T)], name: &str) -> Result<T, PinError> {
    let known = table.iter().find(|(known, _)| *known == name).map(|(_, value)| *value);
    known.ok_or_else(|| {
        let names: Vec<&str> = table.iter().map(|(name, _)| *name).collect();
        PinError(format!("`{name}` is unknown; expected one of {}", names.join(", ")))
    })
}

fn link_of(value: &DeValue<'_>) -> Result<LinkPlan, PinError> {
    let mut keys = Keys::of(value)?;
    let residual = keys.required("residual", |value| exactly(value, text_of))?;
    let [mass, first, second] = residual.map(|name| value_of(&ENTRIES, &name));
    let mut plan = LinkPlan {
        origin: value_of(&ORIGINS, &keys.required("origin", text_of)?)?,
        turn: value_of(&TURNS, &keys.required("turn", text_of)?)?,
        residual: [mass?, first?, second?],
        free: value_of(&RATES, &keys.required("free", text_of)?)?,
        projected_at: keys.optional("meeting", place_of)?,
        ..LinkPlan::BASIC
    };
    for name in keys.required("options", |value| list(value, text_of))? {
        let flag = value_of(&FLAGS, &name)?;
        *flag(&mut plan) = true;
    }
    keys.end()?;
    Ok(plan)
}

fn place_of(value: &DeValue<'_>) -> Result<Place, PinError> {
    let mut keys = Keys::of(value)?;
    let link = keys.required("link", number)?;
    let turned = keys.required("turned", flag)?;
    keys.end()?;
    Ok(Place { link, turned })
}

/// The keys of a table, and those that have been read so far.
struct Keys<'a> {
    table: &'a DeTable<'a>,
    known: Vec<&'static str>,
}

impl<'a> Keys<'a> {
    const fn new(table: &'a DeTable<'a>) -> Keys<'a> {
        Keys { table, known: Vec::new() }
    }

    fn of(value: &'a DeValue<'a>) -> Result<Keys<'a>, PinError> {
        value.as_table().map(Keys::new).ok_or_else(wrong_type)
    }

    fn optional<T>(
        &mut self,
        key: &'static str,
        read: impl Fn(&DeValue<'_>) -> Result<T, PinError>,
    ) -> Result<Option<T>, PinError> {
        self.known.push(key);
        let value = self.table.get(key).map(|value| read(value.get_ref()));
        value.transpose().map_err(|error| PinError(format!("`{key}`: {error}")))
    }

    fn required<T>(
        &mut self,
        key: &'static str,
        read: impl Fn(&DeValue<'_>) -> Result<T, PinError>,
    ) -> Result<T, PinError> {
        self.optional(key, read)?.ok_or_else(|| PinError(format!("`{key}` is missing")))
    }

    /// Returns an error if the table has other keys than those that have been read.
    fn end(self) -> Result<(), PinError> {
        let mut names = self.table.keys().map(|key| key.get_ref().as_ref());
        match names.find(|name| !self.known.contains(name)) {
            Some(name) => Err(PinError(format!(
                "`{name}` is unknown; expected one of {}",
                self.known.join(", ")
            ))),
            None => Ok(()),
        }
    }
}

fn wrong_type() -> PinError {
    PinError("a value of another type is expected".to_owned())
}

fn flag(value: &DeValue<'_>) -> Result<bool, PinError> {
    value.as_bool().ok_or_else(wrong_type)
}

fn text_of(value: &DeValue<'_>) -> Result<String, PinError> {
    value.as_str().map(str::to_owned).ok_or_else(wrong_type)
}

fn number(value: &DeValue<'_>) -> Result<usize, PinError> {
    let integer = value.as_integer().filter(|integer| integer.radix() == 10);
    integer.and_then(|integer| integer.as_str().parse().ok()).ok_or_else(wrong_type)
}

fn list<T>(
    value: &DeValue<'_>,
    read: impl Fn(&DeValue<'_>) -> Result<T, PinError>,
) -> Result<Vec<T>, PinError> {
    let entries = value.as_array().ok_or_else(wrong_type)?;
    entries.iter().map(|entry| read(entry.get_ref())).collect()
}

fn exactly<T, const N: usize>(
    value: &DeValue<'_>,
    read: impl Fn(&DeValue<'_>) -> Result<T, PinError>,
) -> Result<[T; N], PinError> {
    list(value, read)?.try_into().map_err(|_| PinError(format!("{N} entries are expected")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_option_survives_the_round_trip() {
        let links = ORIGINS.iter().enumerate().map(|(index, (_, origin))| LinkPlan {
            origin: *origin,
            turn: TURNS[index % 3].1,
            column: index % 2 == 0,
            moment: [index == 1, index == 2, index == 3],
            residual: [ENTRIES[index].1, ENTRIES[index + 1].1, ENTRIES[index + 2].1],
            free: RATES[index % 6].1,
            projected_at: (index > 3).then_some(Place { link: index, turned: index == 5 }),
            ..LinkPlan::BASIC
        });
        let plan = Plan { links: links.collect(), unit_length: Some((3, 1)) };
        let fingerprint = "ab12".to_owned();
        let digest = "cd34".to_owned();
        let (measure, operations, tuned) = (Measure::Operations, 239, false);
        let pin = Pin { fingerprint, digest, measure, operations, tuned, plan };
        assert!(pin.to_text().ends_with(&pin.content()) && !pin.content().contains("cd34"));
        assert_eq!(Pin::from_text(&pin.to_text()), Ok(pin.clone()));
        let pin = Pin { measure: Measure::Instructions, tuned: true, ..pin };
        assert_eq!(Pin::from_text(&pin.to_text()), Ok(pin));
    }

    #[test]
    fn other_text_is_not_a_pinned_plan() {
        let pin = Pin {
            fingerprint: String::new(),
            digest: String::new(),
            measure: Measure::Operations,
            operations: 0,
            tuned: false,
            plan: Plan { links: vec![LinkPlan::BASIC], unit_length: None },
        };
        let text = pin.to_text();
        for (good, bad) in [
            ("format = 3", "format = 4"),
            ("format = 3", "format = 1"),
            ("format = 3", "format = 2"),
            ("next_normal", "next_norm"),
            ("options = []", "options = [\"colum\"]"),
            ("operations", "operation"),
            ("fingerprint = \"\"", "fingerprint = 1"),
            ("operations = 0", "operations = -1"),
            ("operations = 0", "operations = 0\ntuned = 1"),
            ("turn = ", "other = 1\nturn = "),
            ("turn = ", "meeting = { link = 1 }\nturn = "),
            ("turn = ", "turn "),
        ] {
            assert!(text.contains(good), "{good}");
            let error = Pin::from_text(&text.replacen(good, bad, 1)).unwrap_err();
            assert!(error.to_string().len() > 10, "{bad}: {error}");
        }
        // Another format may have other keys, so the error must be about the format.
        let other = Pin::from_text("format = 4\nplan = \"cheap\"").unwrap_err().to_string();
        assert!(other.contains("format 4") && other.contains("expected 3"), "{other}");
        for format in ["format = 1", "format = 2"] {
            let earlier = Pin::from_text(&text.replacen("format = 3", format, 1)).unwrap_err();
            assert!(earlier.to_string().contains("earlier version"), "{earlier}");
        }
    }
}
