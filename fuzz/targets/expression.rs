//! Any text as an expression: it is read, put into a graph, printed, and read again.
#![no_main]

use libfuzzer_sys::fuzz_target;
use robot_document::{SymbolTable, Trigonometry, latex};
use robot_symbolic::polynomial::{Polynomial, PolynomialOptions};
use robot_symbolic::{Formula, Graph, print};

/// The maximum number of nodes of an expression that is printed or expanded.
const MAX_NODES: usize = 80;
const MAX_SIZE: u64 = 500;

fuzz_target!(|text: &str| {
    if let Err(error) = Formula::parse_with_dots(text) {
        assert!(text.get(error.span.clone()).is_some(), "{error:?}");
    }
    let Ok(formula) = Formula::parse(text) else { return };
    assert!(formula.symbols().all(|(name, place)| text.get(place) == Some(name)));
    let graph = Graph::new();
    let expr = formula.lower(&graph, &mut |name| graph.symbol(name));
    let _ = expr.evaluate(|_| 0.75);
    if graph.len() > MAX_NODES {
        return;
    }
    // Long powers and deep sums can print as text that exceeds the limits of the reader.
    if let Ok(printed) = print::to_text_limited(expr, MAX_SIZE)
        && let Ok(again) = graph.parse(&printed)
    {
        let _ = again.evaluate(|_| 0.75);
    }
    if print::check_length(expr, MAX_SIZE).is_ok()
        && let Ok(formula) = SymbolTable::spelled(Trigonometry::Short).expression(expr)
    {
        robot_fuzz::harmless_latex(&latex::formula(&formula));
    }
    // Expansions can take long, so only some inputs are expanded.
    if !robot_fuzz::chosen(text.as_bytes(), 8) {
        return;
    }
    let options =
        PolynomialOptions { max_terms: 100, max_products: 500, ..PolynomialOptions::default() };
    if let Ok(polynomial) = Polynomial::of(expr, &options) {
        assert!(polynomial.len() <= 100);
    }
});
