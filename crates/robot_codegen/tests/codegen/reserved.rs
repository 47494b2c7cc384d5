//! Names that are reserved in Rust or used by the printed module itself, together with names that equal possible
//! adapted forms of these.

use std::fmt::Write;

use robot_codegen::backend::common::{ConstantItem, ConstantValue, Setter, SetterArgument};
use robot_codegen::backend::rust::{RustOptions, generate, names, output_names};
use robot_codegen::spec::*;
use robot_codegen::{Interpreter, Module, Options};
use robot_symbolic::{Expr, Graph};

use crate::support::{self, arm::vector};

/// The names of the parameters. Names with `_2` and `_` equal possible adapted forms of others. Several underscores
/// become one.
const PARAMETERS: [&str; 20] = [
    "match",
    "match_",
    "match__2",
    "fn",
    "self",
    "Self",
    "crate",
    "gen",
    "f64",
    "f32",
    "core",
    "std",
    "T",
    "Model",
    "Parameters",
    "parameters",
    "T_2",
    "type",
    "self_",
    "box",
];
/// The names of the functions: reserved words, names of forms of other functions, of items of a model, and of a
/// constant.
const FUNCTIONS: [&str; 12] = [
    "fn",
    "fn_",
    "f",
    "f_sc",
    "f_batch",
    "new",
    "NOMINAL",
    "model",
    "with_payload",
    "DOF",
    "into",
    "try_into",
];
const INPUTS: [(&str, [&str; 2]); 3] =
    [("self", ["as", "in"]), ("loop", ["loop_", "s"]), ("result", ["count", "half"])];
const OUTPUTS: [&str; 3] = ["match", "match_", "self"];

fn input((name, symbols): (&str, [&str; 2])) -> Input {
    let symbols = symbols.map(str::to_owned).to_vec();
    Input { name: name.into(), doc: String::new(), unit: String::new(), symbols }
}

fn specification(graph: &Graph) -> ModuleSpec<'_> {
    let mut sum: Expr<'_> = graph.integer(0);
    for (index, name) in PARAMETERS.iter().enumerate() {
        sum += graph.symbol(name).powi(2) * (index as i64 + 1);
    }
    let symbols = INPUTS.iter().flat_map(|(_, symbols)| symbols).map(|name| graph.symbol(name));
    let symbols: Vec<Expr<'_>> = symbols.collect();
    let value = |index: usize| {
        let copies = PARAMETERS.iter().zip(symbols.iter().cycle());
        let copies = copies.fold(sum, |sum, (name, x)| sum + graph.symbol(name) * *x);
        copies * symbols[index].sin() + symbols[0] * (index as i64 + 2)
    };
    let parameters = PARAMETERS.iter().enumerate().map(|(index, name)| ParameterSpec {
        name: (*name).into(),
        doc: String::new(),
        unit: String::new(),
        nominal: Some(0.25 * index as f64 - 1.0),
    });
    let functions = FUNCTIONS.iter().enumerate().map(|(index, name)| Function {
        name: (*name).into(),
        doc: vec![],
        inputs: INPUTS.into_iter().map(input).collect(),
        outputs: match index % 2 {
            0 => vec![vector("y", "", vec![value(index % 6)])],
            _ => OUTPUTS.map(|name| vector(name, "", vec![value(index % 6)])).into(),
        },
    });
    ModuleSpec {
        name: "core".into(),
        doc: vec![],
        parameters: parameters.collect(),
        functions: functions.collect(),
    }
}

fn setter() -> Setter {
    let argument = |name: &str, parameters: &[&str]| SetterArgument {
        name: name.into(),
        doc: String::new(),
        unit: String::new(),
        parameters: parameters.iter().map(|name| (*name).into()).collect(),
    };
    Setter {
        name: "with_payload".into(),
        doc: vec![],
        arguments: vec![argument("self", &["match"]), argument("type", &["match_", "fn"])],
    }
}

fn constant() -> ConstantItem {
    ConstantItem { name: "dof".into(), doc: String::new(), value: ConstantValue::Size(2) }
}

/// Valid names stay as they are; the others are adapted to differ from them.
#[test]
fn names_that_can_stand_stand() {
    let graph = Graph::new();
    let module = Module::compile(&specification(&graph), &Options::default()).unwrap();
    let found = names(&module, &[setter()], &[constant()]);
    assert_eq!(
        found.parameters.join(" "),
        "match__2 match_ match_2 fn_ self__2 Self_ crate_ gen_ f64_ f32_ core_ std_ T Model \
         Parameters parameters T_2 type_ self_ box_"
    );
    assert_eq!(
        found.functions.join(" "),
        "fn__2 fn_ f f_sc f_batch new_2 NOMINAL_2 model with_payload_2 DOF_2 into_2 try_into_2"
    );
    assert_eq!((found.module.as_str(), found.setters.join(" ")), ("core_", "with_payload".into()));
    assert_eq!(output_names(&module.functions[1]).join(" "), "match__2 match_ self_");
}

#[test]
fn code_with_reserved_names_compiles_and_gives_the_values() {
    let graph = Graph::new();
    let module = Module::compile(&specification(&graph), &Options::default()).unwrap();
    let (setters, constants) = (vec![setter()], vec![constant()]);
    let names = names(&module, &setters, &constants);
    let options =
        RustOptions { setters, constants, generic: true, batch: Some(4), ..RustOptions::default() };
    let code = generate(&module, &options).unwrap().to_text();
    let mut text = format!("#![deny(warnings)]\n{code}\nfn main() {{\n");
    let state = [[0.5, -1.25], [0.75, 2.0], [-0.5, 1.5]];
    let [a, b, c] = state;
    writeln!(text, "let model = core_::Model::with_payload(9.0, [8.0, 7.0]);").unwrap();
    for (function, name) in module.functions.iter().zip(&names.functions) {
        writeln!(text, "let result = model.{name}(&{a:?}, &{b:?}, &{c:?});").unwrap();
        if let [_] = function.outputs[..] {
            writeln!(text, "println!(\"{{}}\", result[0].to_bits());").unwrap();
        } else {
            for field in output_names(function) {
                writeln!(text, "println!(\"{{}}\", result.{field}[0].to_bits());").unwrap();
            }
        }
    }
    text.push_str("}\n");
    let printed = support::rustc::output_of("reserved", &text, &["-O"]);
    let mut found = printed.lines().map(|bits| f64::from_bits(bits.parse().unwrap()));
    let given = [("match", 9.0), ("match_", 8.0), ("fn", 7.0)];
    let interpreter = Interpreter::new(&module, &given).unwrap();
    let inputs = [0, 1, 2].map(|index| (INPUTS[index].0, &state[index][..]));
    for function in &module.functions {
        for output in interpreter.call(&function.name, &inputs).unwrap() {
            assert_eq!(found.next(), Some(output.values[0]), "{} {}", function.name, output.name);
        }
    }
    assert_eq!(found.next(), None);
}
