//! Operation counts as JSON and text.

use robot_build::{Snapping, snapping::Tried};
use robot_codegen::code_size::{GIGAHERTZ, INSTRUCTION_CACHE};
use robot_codegen::{CodeSize, Counts, FunctionCounts};
use serde_json::{Map, Value, json};

/// A named count of [`Counts`].
type Column = (&'static str, fn(&Counts) -> usize);

/// The counts, with their names in JSON.
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

/// The counts of a function as `{"mul": …, …, "constructor": {"mul": …, …}, "code": {…}}`.
pub(crate) fn json(counts: &FunctionCounts, size: CodeSize) -> Value {
    let mut object = cells(&counts.call);
    object.insert("constructor".to_owned(), Value::Object(cells(&counts.constructor)));
    let code = json!({
        "bytes": size.bytes,
        "fits_instruction_cache": size.fits(),
        "fetch_ns": size.fetching().map(f64::round),
    });
    object.insert("code".to_owned(), code);
    Value::Object(object)
}

/// Prints a line about the size of code: `NAME: about 23 kB of code: fits …`.
pub(crate) fn size_line(name: &str, size: CodeSize) -> String {
    let cache = INSTRUCTION_CACHE / 1024;
    let kilobytes = size.bytes as f64 / 1000.0;
    let about = match kilobytes < 9.95 {
        true => format!("{kilobytes:.1}"),
        false => format!("{kilobytes:.0}"),
    };
    let verdict = match size.fetching() {
        None => format!("fits a {cache} KB instruction cache"),
        Some(time) => format!(
            "does not fit a {cache} KB instruction cache; expect the time to fetch it, about \
             {time:.0} ns at {GIGAHERTZ} GHz"
        ),
    };
    format!("{name}: about {about} kB of code: {verdict}\n")
}

/// The effect of snapping as `{"tolerance": …, "angles": …, "largest_change": …, "operations": …, "larger": […]}`.
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

/// The counts as `{"mul": …, …}`.
pub(crate) fn cells(counts: &Counts) -> Map<String, Value> {
    COLUMNS.iter().map(|(name, count)| ((*name).to_owned(), json!(count(counts)))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_rounded_and_said_to_fit_or_not() {
        for (bytes, about) in
            [(0, "0.0"), (9_940, "9.9"), (9_950, "10"), (10_400, "10"), (32_768, "33")]
        {
            let shown = size_line("gravity", CodeSize { bytes });
            let expected =
                format!("gravity: about {about} kB of code: fits a 32 KB instruction cache\n");
            assert_eq!(shown, expected);
        }
        let shown = size_line("bias", CodeSize { bytes: 32_769 });
        assert!(
            shown
                .starts_with("bias: about 33 kB of code: does not fit a 32 KB instruction cache; "),
            "{shown}"
        );
        assert!(shown.ends_with(" ns at 3.7 GHz\n"), "{shown}");
    }
}
