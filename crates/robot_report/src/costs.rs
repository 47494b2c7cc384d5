//! The operation counts of the generated code: by function, by pass and by option of the recursion.

use robot_build::ablation::Ablation;
use robot_codegen::{Counts, Module};
use robot_document::markup::{Element, Node, element, holding};

use crate::table::Table;

/// The operations of one function in a sentence.
pub(crate) fn summary(module: &Module, function: &str) -> Option<Element> {
    let Counts { mul, add, div, sqrt, sin, cos, .. } =
        module.counts(module.function(function)?).call;
    let counts = [
        (mul, "multiplication"),
        (add, "addition"),
        (div, "division"),
        (sqrt, "square root"),
        (sin + cos, "sine or cosine"),
    ];
    let counts =
        counts.into_iter().filter(|(count, _)| *count > 0).map(|(count, name)| match name {
            _ if count == 1 => format!("1 {name}"),
            "sine or cosine" => format!("{count} sines and cosines"),
            _ => format!("{count} {name}s"),
        });
    let counts: Vec<String> = counts.collect();
    let listed = match counts.split_last() {
        None => "no operation".to_owned(),
        Some((only, [])) => only.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
    };
    let code = holding("code", function);
    Some(element("p").with("A call of ").with(code).with(format!(" takes {listed}.")))
}

/// The kinds of operations in the columns of tables.
const KINDS: [&str; 5] =
    ["multiplications", "additions", "divisions", "square roots", "sines and cosines"];

/// The operations of each function, per call and once per set of parameters.
pub(crate) fn functions(module: &Module) -> Element {
    let rows = module.functions.iter().map(|function| {
        let counts = module.counts(function);
        let once = counts.constructor.operations();
        (holding("code", function.name.as_str()).into(), of_kinds(&counts.call), Some(once))
    });
    let caption = "Operations per call of each function. Subtractions count as additions; sign changes are not counted; \
        operations are multiplications, additions and divisions together. The last column counts the operations that \
        are done only once for each set of parameters.";
    counted(caption, ["Function", "Once per set of parameters"], rows.collect())
}

/// The operations of a function after each pass.
pub(crate) fn passes(module: &Module, function: &str) -> Option<Element> {
    let rows = module.function(function)?.passes.iter().map(|pass| {
        let mut counts = of_kinds(&pass.counts);
        // Passes do not change the sines and cosines, which are computed before the program.
        counts[4] = 0;
        (of_pass(pass.pass).into(), counts, None)
    });
    let caption = format!(
        "Operations of {function} after each step of its generation, apart from sines and cosines. Some steps run \
         several times."
    );
    Some(counted(&caption, ["After", ""], rows.collect()))
}

/// The subject of a row, the operations of each kind, and the operations per set of parameters, if they are shown.
type Row = (Node, [usize; 5], Option<usize>);

/// A table of operations. Kinds of operations that no row has are omitted. `titles` are those of the first and last
/// columns.
fn counted(caption: &str, titles: [&str; 2], rows: Vec<Row>) -> Element {
    let occurs = |kind: &usize| rows.iter().any(|(_, counts, _)| counts[*kind] > 0);
    let kinds: Vec<usize> = (0..KINDS.len()).filter(occurs).collect();
    let [first, last] = titles;
    let mut columns = vec![first.to_owned()];
    columns.extend(kinds.iter().map(|kind| capitalized(KINDS[*kind])));
    columns.push("Operations".to_owned());
    if rows.iter().any(|(_, _, once)| once.is_some()) {
        columns.push(last.to_owned());
    }
    let mut table = Table::new(caption, columns);
    for (subject, counts, once) in rows {
        let [mul, add, div, ..] = counts;
        let shown = kinds.iter().map(|kind| counts[*kind]);
        let cells = shown.chain([mul + add + div]).chain(once);
        table.row("", subject, cells.map(|count| count.to_string()));
    }
    table.build()
}

fn capitalized(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map(|first| first.to_ascii_uppercase()).into_iter().chain(letters).collect()
}

/// What the pass of this name does.
fn of_pass(name: &'static str) -> &'static str {
    match name {
        "as built" => "derivation of the function",
        "value numbering" => "merging of equal operations",
        "dead code" => "removal of unused operations",
        "factoring" => "factoring, a b + a c = a (b + c)",
        "pair reuse" => "reuse of pairs of terms or factors",
        "resubstitution" => "reuse of equal values and multiples",
        "constructor" => "moving operations on parameters alone out of the call",
        "arrival" => "ordering of operands by availability",
        "product last" => "ordering of operands for multiply-adds",
        "fusing" => "joining products and sums to multiply-adds",
        "signs" => "moving signs into differences",
        "schedule" => "ordering of statements",
        "any pass" => "all passes",
        other => other,
    }
}

/// What the option of the recursion or the pass of this name does.
fn of_option(name: &'static str) -> &'static str {
    match name {
        "origin" => "origins of working frames shifted along the joint axes",
        "turn" => "working frames rotated about the joint axes",
        "angle_sum" => "sums of the angles of parallel joints",
        "column" => "third column of U = [ε]× + [ω]×² from that of the parent",
        "doubled" => "third row of U from doubled products of angular velocities",
        "moment" => "moments from products of angular velocities instead of U",
        "diagonal" => "differences of squared angular velocities from U",
        "residual" => "inertia left with a link so that an entry of its parent's is 0",
        "composite_sum" => "composite inertias in axes that parallel joints share",
        "unit_length" => "a length of the robot as the unit of length",
        other => of_pass(other),
    }
}

/// The savings by each option of the recursion and each pass.
pub(crate) fn options(found: &[Ablation], function: &str) -> Option<Element> {
    let operations = |ablation: &Ablation| {
        let mut counts = ablation.counts.iter();
        counts.find(|(name, _)| name == function).map(|(_, counts)| counts.call.operations())
    };
    let (all, without) = found.split_first()?;
    let least = operations(all)?;
    let caption = format!(
        "Multiplications, additions and divisions of {function} if one option of the recursion or one pass is \
         left out. The savings do not add up, because the options interact. ω and ε are the angular velocity and \
         acceleration of a link."
    );
    let mut table = Table::new(&caption, ["Without", "Operations", "More than with all"]);
    table.row("", "nothing: all options and passes", [least.to_string(), String::new()]);
    for ablation in without {
        let count = operations(ablation)?;
        let more = match count.checked_sub(least) {
            Some(more) => more.to_string(),
            None => format!("−{}", least - count),
        };
        table.row("", of_option(ablation.without), [count.to_string(), more]);
    }
    Some(table.build())
}

/// The operations of each of the [`KINDS`].
const fn of_kinds(counts: &Counts) -> [usize; 5] {
    let Counts { mul, add, div, sqrt, sin, cos, .. } = *counts;
    [mul, add, div, sqrt, sin + cos]
}

#[cfg(test)]
mod tests {
    use super::*;
    use robot_build::ablation::ablation;
    use robot_build::{Options, Source, programs};

    /// The page of the planar arm names no pass or option by its name in the program.
    #[test]
    fn steps_and_options_have_words() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/planar_2r.toml");
        let text = std::fs::read_to_string(path).unwrap();
        let source = Source { name: "planar_2r.toml".to_owned(), text };
        let options = Options::default();
        let module = programs(&source, &options).unwrap().module;
        let passes = module.function("inverse_dynamics").unwrap().passes.iter();
        for name in passes.map(|pass| pass.pass) {
            assert!(of_pass(name) != name, "{name}");
        }
        let found = ablation(&source, &options).unwrap();
        for name in found.iter().skip(1).map(|one| one.without) {
            assert!(of_option(name) != name, "{name}");
        }
    }

    #[test]
    fn kinds_of_operations_that_never_occur_have_no_column() {
        let row = |name: &str, counts| (name.into(), counts, None);
        let shown = counted("c", ["After", ""], vec![row("a", [2, 1, 0, 0, 0]), row("b", [0; 5])]);
        let shown = shown.to_string();
        assert!(shown.contains("Multiplications") && shown.contains("Additions"), "{shown}");
        assert!(!shown.contains("Divisions") && !shown.contains("Sines"), "{shown}");
        assert!(shown.contains(">3<"), "{shown}");
    }
}
