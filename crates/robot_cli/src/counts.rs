//! Operation counts as JSON and text.

use robot_build::{Snapping, snapping::Tried};
use robot_codegen::{Counts, FunctionCounts};
use serde_json::{Map, Value, json};

/// A named count of [`Counts`].
type Column = (&'static str, fn(&Counts) -> usize);

/// The counts, by their names in JSON.
pub(crate) const COLUMNS: [Column; 8] = [
    ("mul", |counts| counts.mul),
    ("add", |counts| counts.add),
    ("div", |counts| counts.div),
    ("sqrt", |counts| counts.sqrt),
    ("other", |counts| counts.other),
    ("sin", |counts| counts.sin),
    ("cos", |counts| counts.cos),
    ("temporaries", |counts| counts.temporaries),
];

/// `{"mul": …, …, "constructor": {"mul": …, …}}`
pub(crate) fn json(counts: &FunctionCounts) -> Value {
    let mut object = cells(&counts.call);
    object.insert("constructor".to_owned(), Value::Object(cells(&counts.constructor)));
    Value::Object(object)
}

/// `{"tolerance": …, "angles": …, "largest_change": …, "operations": …, "larger": […]}`
pub(crate) fn snapping_json(snapping: &Snapping) -> Value {
    let one = |tried: &Tried| {
        json!({
            "tolerance": tried.tolerance,
            "angles": tried.snapped.len(),
            "largest_change": tried.largest().map_or(0.0, |snap| snap.change.abs()),
            "operations": tried.operations,
        })
    };
    let mut shown = one(&snapping.taken);
    shown["larger"] = snapping.larger.iter().map(one).collect();
    shown
}

/// `{"mul": …, …}`
pub(crate) fn cells(counts: &Counts) -> Map<String, Value> {
    COLUMNS.iter().map(|(name, count)| ((*name).to_owned(), json!(count(counts)))).collect()
}
