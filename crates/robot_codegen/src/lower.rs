//! Lowering of a specification to programs that still load parameters.

use robot_symbolic::walk::reachable;
use robot_symbolic::{Expr, Function as Call, Id, SymbolId, View};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::error::{Error, Errors};
use crate::program::{Builder, DoubleDouble, Program, Source, Value};
use crate::spec::{Function, ModuleSpec};

/// The programs of one function.
pub(crate) struct Lowered {
    pub(crate) angles: Program,
    pub(crate) core: Program,
}

/// Checks the specification and lowers its functions.
pub(crate) fn lower(spec: &ModuleSpec<'_>) -> Result<Vec<Lowered>, Errors> {
    let mut errors = vec![];
    check_module(spec, &mut errors);
    // Expressions of several graphs cannot be examined together.
    if errors.iter().any(|error| matches!(error, Error::ForeignGraph { .. })) {
        return Errors::check(errors, vec![]);
    }
    let functions = spec.functions.iter();
    let lowered = functions.map(|function| lower_function(spec, function, &mut errors)).collect();
    Errors::check(errors, lowered)
}

fn check_module(spec: &ModuleSpec<'_>, errors: &mut Vec<Error>) {
    let module = format!("module `{}`", spec.name);
    let parameters = || spec.parameters.iter().map(|parameter| parameter.name.as_str());
    check_names(&module, "parameter", parameters(), errors);
    let functions = spec.functions.iter().map(|function| function.name.as_str());
    check_names(&module, "function", functions, errors);
    for parameter in &spec.parameters {
        if parameter.nominal.is_some_and(|value| !value.is_finite()) {
            let parameter = parameter.name.clone();
            errors.push(Error::NominalNotFinite { parameter });
        }
    }
    let mut values = spec.functions.iter().flat_map(|function| &function.outputs);
    let graph = values.find_map(|output| output.values.first()).map(|value| value.graph());
    for function in &spec.functions {
        let place = format!("function `{}`", function.name);
        let inputs = || function.inputs.iter();
        check_names(&place, "input", inputs().map(|input| input.name.as_str()), errors);
        let symbols = inputs().flat_map(|input| input.symbols.iter().map(String::as_str));
        check_names(&place, "symbol", symbols.chain(parameters()), errors);
        let outputs = function.outputs.iter().map(|output| output.name.as_str());
        check_names(&place, "output", outputs, errors);
        if function.outputs.is_empty() {
            errors.push(Error::NoOutputs { function: function.name.clone() });
        }
        for output in &function.outputs {
            let (function, name) = (function.name.clone(), output.name.clone());
            let length: usize = output.shape.iter().product();
            if output.shape.len() > 2 || length != output.values.len() {
                errors.push(Error::Shape {
                    function: function.clone(),
                    output: name.clone(),
                    shape: output.shape.clone(),
                    values: output.values.len(),
                });
            }
            let foreign =
                |value: &Expr<'_>| graph.is_some_and(|graph| !std::ptr::eq(graph, value.graph()));
            if output.values.iter().any(foreign) {
                errors.push(Error::ForeignGraph { function, output: name });
            }
        }
    }
}

fn check_names<'a>(
    place: &str,
    kind: &'static str,
    names: impl Iterator<Item = &'a str>,
    errors: &mut Vec<Error>,
) {
    let (mut seen, mut reported) = (FxHashSet::default(), FxHashSet::default());
    for name in names {
        if !seen.insert(name) && reported.insert(name) {
            errors.push(Error::Duplicate { place: place.to_owned(), kind, name: name.to_owned() });
        }
    }
}

/// The stage that a node depends on, in order of precedence.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Class {
    Constant,
    Parameter,
    /// Depends on entries of inputs, but not on a sine or cosine of one.
    Input,
    /// Depends on a sine or cosine of inputs.
    Circular,
}

fn lower_function(
    spec: &ModuleSpec<'_>,
    function: &Function<'_>,
    errors: &mut Vec<Error>,
) -> Lowered {
    let roots: Vec<Expr<'_>> =
        function.outputs.iter().flat_map(|o| o.values.iter().copied()).collect();
    let mut lowering = Lowering::new(spec, function, &roots);
    lowering.classify();
    let angles = lowering.angles();
    let core = lowering.build(&angles, &roots);
    let angles = lowering.build(&[], &angles);
    let unknown = std::mem::take(&mut lowering.unknown);
    let no_values = std::mem::take(&mut lowering.not_finite);
    for symbol in unknown {
        errors.push(Error::UnknownSymbol {
            function: function.name.clone(),
            output: output_with(function, symbol.id()),
            symbol: symbol
                .as_symbol()
                .map_or_else(String::new, |id| symbol.graph().symbol_name(id)),
        });
    }
    if let Some(id) = no_values.first() {
        errors.push(Error::NotFinite {
            function: function.name.clone(),
            output: output_with(function, *id),
        });
    }
    Lowered { angles, core }
}

/// Returns the name of the first output that contains a node.
fn output_with(function: &Function<'_>, id: Id) -> String {
    let contains = |values: &[Expr<'_>]| reachable(values).iter().any(|expr| expr.id() == id);
    let output = function.outputs.iter().find(|output| contains(&output.values));
    output.map_or_else(String::new, |output| output.name.clone())
}

struct Lowering<'g> {
    /// The source that each symbol reads.
    sources: FxHashMap<SymbolId, Source>,
    nodes: Vec<Expr<'g>>,
    classes: FxHashMap<Id, Class>,
    constants: FxHashMap<Id, DoubleDouble>,
    unknown: Vec<Expr<'g>>,
    not_finite: Vec<Id>,
}

impl<'g> Lowering<'g> {
    fn new(spec: &ModuleSpec<'_>, function: &Function<'_>, roots: &[Expr<'g>]) -> Self {
        let mut sources = FxHashMap::default();
        if let Some(graph) = roots.first().map(|root| root.graph()) {
            let parameters = spec.parameters.iter().map(|parameter| &parameter.name);
            let symbols = function.inputs.iter().flat_map(|input| &input.symbols);
            let numbered = (0..).map(Source::Parameter).zip(parameters);
            for (source, name) in numbered.chain((0..).map(Source::Input).zip(symbols)) {
                let symbol = graph.find_symbol(name).and_then(Expr::as_symbol);
                sources.extend(symbol.map(|symbol| (symbol, source)));
            }
        }
        Lowering {
            sources,
            nodes: reachable(roots),
            classes: FxHashMap::default(),
            constants: FxHashMap::default(),
            unknown: vec![],
            not_finite: vec![],
        }
    }

    fn classify(&mut self) {
        for expr in std::mem::take(&mut self.nodes) {
            let view = expr.view();
            let class = match &view {
                View::Number(_) | View::Pi => Class::Constant,
                View::Symbol(symbol) => match self.sources.get(symbol) {
                    Some(Source::Parameter(_)) => Class::Parameter,
                    Some(_) => Class::Input,
                    None => {
                        self.unknown.push(expr);
                        Class::Parameter
                    }
                },
                _ => {
                    let operands = expr.operands();
                    let operands = operands.iter().map(|operand| self.classes[&operand.id()]);
                    let class = operands.max().unwrap_or(Class::Constant);
                    match &view {
                        View::Call(Call::Sin | Call::Cos, _) if class == Class::Input => {
                            Class::Circular
                        }
                        _ => class,
                    }
                }
            };
            if class == Class::Constant {
                let value = self.evaluate(&view);
                if !value.to_f64().is_finite() {
                    self.not_finite.push(expr.id());
                }
                self.constants.insert(expr.id(), value);
            }
            self.classes.insert(expr.id(), class);
            self.nodes.push(expr);
        }
    }

    fn evaluate(&self, view: &View<'g>) -> DoubleDouble {
        let at = |operand: &Expr<'g>| self.constants[&operand.id()];
        match view {
            View::Number(number) => DoubleDouble::from_number(number),
            View::Pi => DoubleDouble::PI,
            View::Symbol(_) => DoubleDouble::ZERO,
            View::Add(a, b) => at(a) + at(b),
            View::Sub(a, b) => at(a) - at(b),
            View::Mul(a, b) => at(a) * at(b),
            View::Div(a, b) => at(a) / at(b),
            View::Neg(a) => -at(a),
            View::Call(function, a) => at(a).apply(*function),
        }
    }

    /// Returns the argument of a sine or cosine of inputs. An argument that itself contains such a sine or cosine is
    /// not an angle of the function; its sine or cosine is computed in the arithmetic.
    fn angle(&self, expr: Expr<'g>) -> Option<(Call, Expr<'g>)> {
        match expr.view() {
            View::Call(function @ (Call::Sin | Call::Cos), argument)
                if self.classes[&argument.id()] == Class::Input =>
            {
                Some((function, argument))
            }
            _ => None,
        }
    }

    fn angles(&self) -> Vec<Expr<'g>> {
        let mut angles: Vec<_> = self.nodes.iter().filter_map(|expr| self.angle(*expr)).collect();
        angles.sort_by_key(|(_, argument)| {
            let input = argument.as_symbol().and_then(|symbol| self.sources.get(&symbol));
            (input.is_none(), input.copied(), argument.id())
        });
        angles.dedup_by_key(|(_, argument)| argument.id());
        angles.into_iter().map(|(_, argument)| argument).collect()
    }

    fn build(&self, angles: &[Expr<'g>], roots: &[Expr<'g>]) -> Program {
        let angles: FxHashMap<Id, u32> = angles.iter().map(|angle| angle.id()).zip(0..).collect();
        let mut builder = Builder::new();
        let mut values: FxHashMap<Id, Value> = FxHashMap::default();
        for expr in self.needed(&angles, roots) {
            let at = |operand: Expr<'g>| values[&operand.id()];
            let value = if let Some(constant) = self.constants.get(&expr.id()) {
                builder.constant(constant.to_f64())
            } else if let Some((function, index)) = self.known_angle(expr, &angles) {
                builder.load(match function {
                    Call::Sin => Source::Sin(index),
                    _ => Source::Cos(index),
                })
            } else {
                match expr.view() {
                    // Constants are in the table above.
                    View::Number(_) | View::Pi => builder.constant(0.0),
                    View::Symbol(symbol) => {
                        let source = self.sources.get(&symbol).copied();
                        builder.load(source.unwrap_or(Source::Parameter(0)))
                    }
                    View::Add(a, b) => builder.add(at(a), at(b)),
                    View::Sub(a, b) => builder.sub(at(a), at(b)),
                    View::Mul(a, b) => builder.mul(at(a), at(b)),
                    View::Div(a, b) => builder.div(at(a), at(b)),
                    View::Neg(a) => builder.neg(at(a)),
                    View::Call(function, a) => builder.call(function, at(a)),
                }
            };
            values.insert(expr.id(), value);
        }
        let results = roots.iter().map(|root| values[&root.id()]).collect();
        builder.finish(results)
    }

    fn known_angle(&self, expr: Expr<'g>, angles: &FxHashMap<Id, u32>) -> Option<(Call, u32)> {
        let (function, argument) = self.angle(expr)?;
        Some((function, *angles.get(&argument.id())?))
    }

    /// Returns the nodes from which `roots` are built, operands first, without the operands of angles and of
    /// constants.
    fn needed(&self, angles: &FxHashMap<Id, u32>, roots: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let mut seen = FxHashSet::default();
        let mut needed = vec![];
        let mut pending = roots.to_vec();
        while let Some(expr) = pending.pop() {
            if seen.insert(expr.id()) {
                needed.push(expr);
                let whole = self.constants.contains_key(&expr.id());
                if !whole && self.known_angle(expr, angles).is_none() {
                    pending.extend(expr.operands());
                }
            }
        }
        needed.sort_unstable_by_key(|expr| expr.id());
        needed
    }
}
