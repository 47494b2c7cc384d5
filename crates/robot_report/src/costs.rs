//! The cost of the generated code: operation counts by function, by compiler stage and by option.

use robot_build::ablation::Ablation;
use robot_codegen::{Counts, Module};
use robot_document::markup::{Element, element, holding};

use crate::table::Table;

const COLUMNS: [&str; 6] = ["×", "+ −", "÷", "√", "sin, cos", "× + ÷ together"];

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

/// The operations of each function, per call and once per set of parameters.
pub(crate) fn functions(module: &Module) -> Element {
    let mut columns = vec!["Function"];
    columns.extend(COLUMNS);
    columns.push("once per set of parameters");
    let caption = "Operations per call of each function. Subtractions count as additions, sign \
        changes are not counted.";
    let mut table = Table::new(caption, columns);
    for function in &module.functions {
        let counts = module.counts(function);
        let mut cells = count_cells(&counts.call);
        cells.push(counts.constructor.operations().to_string());
        table.row("", holding("code", function.name.as_str()), cells);
    }
    table.build()
}

/// The operations of a function after each compiler pass.
pub(crate) fn passes(module: &Module, function: &str) -> Option<Element> {
    let mut columns = vec!["After"];
    columns.extend(COLUMNS.iter().filter(|name| **name != "sin, cos"));
    let caption = format!("Operations of {function} after each stage of the compiler");
    let mut table = Table::new(&caption, columns);
    for pass in &module.function(function)?.passes {
        let mut cells = count_cells(&pass.counts);
        cells.remove(4);
        table.row("", pass.pass, cells);
    }
    Some(table.build())
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
        "Operations of {function} (multiplications plus additions) without one option or \
         pass. The savings do not add up, because the options interact."
    );
    let mut table = Table::new(&caption, ["Without", "Operations", "More than with all"]);
    table.row("", "nothing (all options and passes)", [least.to_string(), String::new()]);
    for ablation in without {
        let count = operations(ablation)?;
        let more = match count.checked_sub(least) {
            Some(more) => more.to_string(),
            None => format!("−{}", least - count),
        };
        table.row("", ablation.without, [count.to_string(), more]);
    }
    Some(table.build())
}

fn count_cells(counts: &Counts) -> Vec<String> {
    let Counts { mul, add, div, sqrt, sin, cos, .. } = *counts;
    let count_cells = [mul, add, div, sqrt, sin + cos, counts.operations()];
    count_cells.map(|value| value.to_string()).to_vec()
}
