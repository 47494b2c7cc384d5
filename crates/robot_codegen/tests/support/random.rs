//! Random modules from a seed.

use robot_codegen::spec::*;
use robot_symbolic::{Expr, Graph, Random, Rational};

/// A number between −2 and 2.
pub(crate) fn real(random: &mut Random) -> f64 {
    random.uniform(-2.0, 2.0)
}

pub(crate) const PARAMETERS: usize = 6;
pub(crate) const ENTRIES: usize = 4;

/// A module of one function over two inputs, `q` and `v`, with `operations` random operations.
/// A value is never far from 1 in size, so that no result is infinite.
pub(crate) fn module<'g>(
    graph: &'g Graph,
    random: &mut Random,
    operations: usize,
) -> ModuleSpec<'g> {
    let names = |prefix: &str, count: usize| -> Vec<String> {
        (1..=count).map(|index| format!("{prefix}{index}")).collect()
    };
    let (parameters, q, v) = (names("p", PARAMETERS), names("q", ENTRIES), names("v", ENTRIES));
    let symbols = parameters.iter().chain(&q).chain(&v);
    let mut pool: Vec<Expr<'g>> = symbols.map(|name| graph.symbol(name)).collect();
    for _ in 0..operations {
        let value = operation(graph, random, &pool);
        pool.push(value);
    }
    let outputs = pool.split_off(pool.len() - (operations / 12).max(3));
    ModuleSpec {
        name: "random".into(),
        doc: vec![],
        parameters: parameters
            .iter()
            .map(|name| ParameterSpec {
                name: name.clone(),
                doc: String::new(),
                unit: String::new(),
                nominal: Some(real(random)),
            })
            .collect(),
        functions: vec![Function {
            name: "f".into(),
            doc: vec![],
            inputs: vec![input("q", q), input("v", v)],
            outputs: vec![super::arm::vector("y", "", outputs)],
        }],
    }
}

fn input(name: &str, symbols: Vec<String>) -> Input {
    Input { name: name.into(), doc: String::new(), unit: String::new(), symbols }
}

/// An operation on values of the pool, preferably recent ones, whose result keeps a size near 1.
fn operation<'g>(graph: &'g Graph, random: &mut Random, pool: &[Expr<'g>]) -> Expr<'g> {
    let pick = |random: &mut Random| {
        let recent = pool.len().min(30);
        let start = if random.index(4) == 0 { 0 } else { pool.len() - recent };
        pool[start + random.index(pool.len() - start)]
    };
    let (a, b) = (pick(random), pick(random));
    let bounded = |x: Expr<'g>| x / (x * x + 1);
    match random.index(22) {
        0..=5 => a + b,
        6..=9 => a - b,
        10..=15 => bounded(a) * b,
        16 => a / (b * b + 2),
        17 => graph.number(Rational::new(random.index(2000) as i64 - 1000, 700).unwrap()) * a,
        18 => -a,
        19 => (a * a + 1).sqrt() / 2,
        20 => match random.index(4) {
            0 => a.sign() + bounded(b),
            1 => a.abs() - bounded(b).abs(),
            2 => a.tanh(),
            _ => graph.number(Rational::new(random.index(9) as i64, 7).unwrap()).cos() * b,
        },
        _ => {
            let angle = graph.symbol(&format!("q{}", 1 + random.index(ENTRIES)));
            let angle = if random.index(3) == 0 { angle * 2 + graph.symbol("p1") } else { angle };
            let angle = if random.index(6) == 0 { bounded(a) } else { angle };
            if random.index(2) == 0 { angle.sin() * a } else { angle.cos() + b }
        }
    }
}
