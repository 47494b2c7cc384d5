//! The forms of the equations of motion.

mod aliases;
mod angle_sums;
mod arranged;
mod arrays;
mod canceled;
mod coefficients;
mod compact;
mod definitions;
mod expanded;
mod grouped;
mod independent;
mod letters;
mod loads;
mod matrices;
mod multiples;
mod naming;
mod numbers;
mod options;
pub(crate) mod paper;
mod parts;
mod published;
mod recursive;
mod references;
mod regrouped;
mod residues;
mod roots;
mod shapes;
mod signs;
mod size;
mod uses;
mod vectors;

use std::borrow::Cow;
use std::collections::BTreeMap;

use robot_dynamics::economical::plan::{LinkPlan, Plan, Turn};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_dynamics::newton_euler::{NewtonEuler, newton_euler};
use robot_dynamics::quantity::{Kind, Quantity, Symbol};
use robot_model::functions::{Effects, FunctionKind};
use robot_model::robot::Robot;
use robot_model::snap;
use robot_model::variable::JointVariable;
use robot_symbolic::collected::{Collector, ParallelAngles, length};
use robot_symbolic::print::{ArrangedFactor, ArrangedTerm, arranged_text};
use robot_symbolic::{AngleSums, Expr, Graph, Polynomial, walk};

use crate::document::NumberedEquation;
use crate::error::Error;
use crate::layout::{BRACKETS, Order, SymbolTable, has_longer, tidied, tidied_text};
use crate::math::Math;
pub(crate) use grouped::titles;
pub(crate) use letters::candidates::LINK_MASS;
pub use letters::{InvalidLetters, Letters};
pub(crate) use numbers::{with_values, without_functions};

pub use options::{EquationOptions, Form};
pub use published::{Differences, TermOrder};
pub(crate) use size::MAX_NODES;

pub use arrays::{Array, Cell, Room, Written};
pub use paper::Relation;

/// The equations of a robot in one form.
#[derive(Clone, Debug)]
pub struct Equations {
    /// The groups of equations, in the order in which they are read.
    pub groups: Vec<Group>,
    /// The layouts of all symbols.
    pub symbols: SymbolTable,
    /// Whether decimals were rounded to [`EquationOptions::digits`].
    pub rounded: bool,
    /// The published equations in [`EquationOptions::order`] that have nothing in common with these.
    pub differences: Differences,
}

/// Equations that belong together.
#[derive(Clone, Debug)]
pub struct Group {
    /// The title.
    pub title: String,
    /// Remarks before the equations, in plain text.
    pub introduction: String,
    /// Whether the equations define symbols that other equations use.
    pub definitions: bool,
    /// Whether later definitions use the quantities of these equations.
    pub used: bool,
    /// The equations.
    pub equations: Vec<Equation>,
    /// The same equations as one equation of vectors.
    pub vector: Option<Equation>,
    /// The matrices and columns whose entries the equations define; `None` if the group has none. Vectors that are only
    /// other names of earlier ones are not included.
    pub arrays: Option<Vec<Array>>,
    /// The vector relations from which quantities follow; they are shown before these quantities if vectors are
    /// columns.
    pub relations: Vec<Relation>,
    /// The numbers of equations in a published text, by the names of the equations; empty if equations are numbered
    /// consecutively.
    pub numbers: BTreeMap<String, String>,
}

/// An equation: a quantity or a defined symbol on the left side, and its value on the right side.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Equation {
    /// The left side as text, such as `F_l5.x`.
    pub name: String,
    /// The right side as infix text that can be parsed again, by [`Formula::parse_with_dots`](robot_symbolic::Formula::parse_with_dots).
    pub text: String,
    /// The left side.
    pub left: Math,
    /// The right side, which is a sum; empty if only the left side is shown.
    pub right: Math,
}

impl Group {
    /// Writes the numbers of the right sides as people do and returns whether any was rounded.
    fn tidy(&mut self, digits: Option<usize>) -> bool {
        let mut is_rounded = false;
        let cells = self.arrays.iter_mut().flatten().flat_map(Array::cells_mut);
        let written = cells.flat_map(|cell| [&mut cell.whole, &mut cell.parts]).flatten();
        let entries = written.map(|written| &mut written.math);
        let equations = self.equations.iter_mut().chain(&mut self.vector);
        for math in equations.map(|equation| &mut equation.right).chain(entries) {
            is_rounded |= digits.is_some_and(|digits| has_longer(math, digits));
            *math = tidied(math, digits);
        }
        is_rounded
    }

    /// Creates a group of definitions of symbols that other equations use.
    pub(crate) fn of_definitions(title: &str, equations: Vec<Equation>) -> Group {
        let (title, introduction) = (title.to_owned(), String::new());
        Group {
            title,
            introduction,
            definitions: true,
            used: false,
            equations,
            vector: None,
            arrays: None,
            relations: vec![],
            numbers: BTreeMap::new(),
        }
    }

    /// The equation with its label and number. If a published text numbers equations but not this one, it has neither.
    #[must_use]
    pub fn numbered(&self, equation: &Equation, label: Option<String>) -> NumberedEquation {
        let number = label.as_ref().and_then(|_| self.numbers.get(&equation.name)).cloned();
        let label = label.filter(|_| number.is_some() || self.numbers.is_empty());
        NumberedEquation { label, number, equation: equation.clone() }
    }

    /// Creates a group of quantities of the robot.
    pub(crate) fn of_quantities(
        title: &str,
        introduction: String,
        equations: Vec<Equation>,
    ) -> Group {
        Group { definitions: false, introduction, ..Group::of_definitions(title, equations) }
    }
}

impl Equation {
    /// Whether the equation is only a name, without a right side.
    pub(crate) fn is_name(&self) -> bool {
        self.right.pieces().is_empty()
    }

    /// A label for the equation: its name, with `-` for `_` and `:` for the point before a component. The name of a
    /// matrix is used without its arguments.
    #[must_use]
    pub fn label(&self) -> String {
        let name = self.name.split_once('(').map_or(self.name.as_str(), |(name, _)| name);
        name.replace('_', "-").replace('.', ":")
    }
}

impl Equations {
    /// The equations of quantities of the robot, without definitions.
    pub fn quantities(&self) -> impl Iterator<Item = &Equation> {
        self.groups.iter().filter(|group| !group.definitions).flat_map(|group| &group.equations)
    }

    /// The equations with texts for readers, which are not exact: decimals are rounded to `digits` significant digits
    /// or, without a number of digits, to those of a double.
    #[must_use]
    pub fn readable(&self, digits: Option<usize>) -> Equations {
        let mut equations = self.clone();
        for group in &mut equations.groups {
            let cells = group.arrays.iter_mut().flatten().flat_map(Array::cells_mut);
            let written = cells.flat_map(|cell| [&mut cell.whole, &mut cell.parts]).flatten();
            let entries = written.map(|written| &mut written.text);
            let all = group.equations.iter_mut().chain(&mut group.vector);
            for text in all.map(|equation| &mut equation.text).chain(entries) {
                *text = tidied_text(text, digits);
            }
        }
        equations
    }

    /// The matrices and columns, in the order of their groups.
    pub fn arrays(&self) -> impl Iterator<Item = &Array> {
        self.groups.iter().filter_map(|group| group.arrays.as_ref()).flatten()
    }

    /// The definitions that other equations use, each before its first use by another definition, with the quantities
    /// that definitions use among them.
    pub fn definitions(&self) -> impl Iterator<Item = &Equation> {
        let groups = self.groups.iter().filter(|group| group.definitions || group.used);
        groups.flat_map(|group| &group.equations)
    }
}

/// The largest number of terms of a sum that is collected as a whole. In longer sums, each coefficient of an
/// acceleration or of a product of velocities is collected by itself. A joint torque of a 6-joint arm has thousands of terms.
const MAX_WHOLE: usize = 200;

/// Derives the equations of a robot.
///
/// # Errors
///
/// If the equations are too long, with the forms to use instead, or if two symbols would look the same.
pub fn equations(robot: &Robot, options: &EquationOptions) -> Result<Equations, Error> {
    options.snap.map(snap::check).transpose()?;
    let graph = Graph::limited(MAX_NODES);
    let mut writer = Writer {
        robot,
        options,
        graph: &graph,
        symbols: SymbolTable::new(robot, options.trigonometry)?
            .beside_components(options.has_components()),
        order: Order::new(robot),
        parallel: vec![],
        differences: Differences::default(),
    };
    if writer.angle_sums() == AngleSums::Keep && options.form != Form::Recursive {
        writer.parallel = writer.derivation().mechanism.parallel_angles();
    }
    writer.reserve_letters()?;
    let groups = match options.form {
        Form::Expanded | Form::Collected => expanded::groups(&mut writer),
        Form::Grouped => grouped::groups(&mut writer),
        Form::Recursive => recursive::groups(&mut writer),
        Form::Compact => compact::groups(&mut writer),
        Form::Regrouped => regrouped::groups(&mut writer),
    };
    writer.check_size()?;
    let groups = groups.map_err(|error| writer.blamed(error))?;
    // A column can have entries that are all defined in other groups.
    let is_shown = |group: &Group| !group.equations.is_empty() || group.arrays.is_some();
    let mut groups: Vec<Group> = groups.into_iter().filter(is_shown).collect();
    writer.check_letters(&groups)?;
    let mut rounded = false;
    for group in &mut groups {
        rounded |= group.tidy(options.digits);
        let own = group.equations.iter_mut().filter(|_| !group.definitions);
        own.chain(&mut group.vector).for_each(|equation| writer.name_torque(equation));
        group.numbers = options.order.numbers();
    }
    writer.check_left_sides(&groups)?;
    Ok(Equations { groups, symbols: writer.symbols, rounded, differences: writer.differences })
}

/// The state that all forms share.
struct Writer<'r, 'g> {
    robot: &'r Robot,
    options: &'r EquationOptions,
    graph: &'g Graph,
    symbols: SymbolTable,
    order: Order<'r>,
    /// The groups of parallel joints, whose sums of angles are written.
    parallel: Vec<ParallelAngles<'g>>,
    /// The published equations that have nothing in common with the derived ones.
    differences: Differences,
}

impl<'g> Writer<'_, 'g> {
    fn mechanism_options(&self) -> MechanismOptions {
        MechanismOptions::EXACT.with_snap(self.options.snap, self.robot)
    }

    /// The iterations of the paper.
    fn iterations(&self, effects: Effects) -> NewtonEuler<'g> {
        let derivation = self.derivation();
        newton_euler(&derivation.mechanism, effects)
    }

    fn derivation(&self) -> Derivation<'_, 'g> {
        Derivation::new(self.robot, self.graph, &self.mechanism_options(), None)
    }

    /// Whether sines and cosines of sums of angles are written or expanded.
    fn angle_sums(&self) -> AngleSums {
        self.options.angle_sums.unwrap_or(match self.options.form {
            Form::Expanded => AngleSums::Expand,
            _ => AngleSums::Keep,
        })
    }

    /// The joint torques from the economical recursion, including the wrenches of the tips.
    fn economical_forces(&self, friction: bool) -> Vec<Expr<'g>> {
        let kind = match friction {
            true => FunctionKind::InverseDynamics(Effects::BOTH),
            false => FunctionKind::InverseDynamics(Effects::WRENCH),
        };
        forces_of(&self.derivation(), kind)
    }

    /// The joint torques like [`Writer::economical_forces`], but with the exact numbers of the file: without the turns of
    /// frames by rounded angles, which the recursion can need.
    fn exact_forces(&self) -> Vec<Expr<'g>> {
        let kind = FunctionKind::InverseDynamics(Effects::WRENCH);
        let derivation = self.derivation();
        let forces = forces_of(&derivation, kind);
        let numbers = walk::reachable(&forces).into_iter().filter_map(Expr::as_number);
        if numbers.into_iter().all(|number| number.as_rational().is_some()) {
            return forces;
        }
        let own = LinkPlan { turn: Turn::File, ..LinkPlan::DEFAULT };
        forces_of(&derivation.with_plan(&Plan::uniform(self.robot.links.len(), &own)), kind)
    }

    /// The requested quantities, with or without friction.
    fn quantities(&self, friction: bool) -> Vec<Quantity<'g>> {
        let effects = Effects { wrench: true, friction };
        let iterations = self.iterations(effects);
        let of_kind = |kind: &Kind| {
            let mut quantities = iterations.quantities(*kind);
            if self.options.paper && matches!(kind, Kind::LinkForce | Kind::LinkMoment) {
                // The sort is stable, so components keep their order.
                quantities.sort_by_key(|quantity| std::cmp::Reverse(quantity.symbol.number));
            }
            quantities
        };
        self.options.kinds.iter().flat_map(of_kind).collect()
    }

    /// The layout of a quantity on the left side.
    fn look(&self, symbol: Symbol) -> Math {
        match self.options.paper {
            true => Math::in_paper(symbol),
            false => Math::quantity(symbol),
        }
    }

    /// Defines a combination of parameters.
    fn define_parameter(&mut self, name: &str, shape: Math) -> Result<(), Error> {
        self.order.define_parameter(name);
        self.symbols.define(name, shape)
    }

    /// Defines a symbol.
    fn define(&mut self, name: &str, shape: Math) -> Result<(), Error> {
        self.order.define(name);
        self.symbols.define(name, shape)
    }

    /// An equation whose right side is a polynomial, multiplied out.
    fn of_polynomial(
        &self,
        name: String,
        left: Math,
        value: &Polynomial<'_>,
    ) -> Result<Equation, Error> {
        let value = self.with_decimals(value);
        let text = value.to_text_by(|atom| self.order.rank(atom))?;
        let right = self.symbols.polynomial(&value, &self.order)?;
        Ok(Equation { name, text, left, right })
    }

    /// An equation whose right side is a polynomial, written as the form requires.
    fn of_collected(
        &self,
        name: String,
        left: Math,
        value: &Polynomial<'g>,
    ) -> Result<Equation, Error> {
        self.of_terms(name, left, &self.collected(value))
    }

    /// The terms of a polynomial as the form requires: collected or multiplied out, in both cases with the sums of
    /// angles that make it shortest.
    ///
    /// In the forms [`Form::Collected`] and [`Form::Compact`], the terms of inertia and gravity, of friction, and of the
    /// wrenches of the tips are collected separately. Long numbers with roots become decimals if that is shorter or the
    /// numbers below the roots are long, and [`EquationOptions::rounds_roots`] is set.
    fn collected(&self, value: &Polynomial<'g>) -> Vec<ArrangedTerm<'g>> {
        let exact = self.collected_exactly(value);
        match self.with_decimals(value) {
            Cow::Owned(decimal) => {
                let decimal = self.collected_exactly(&decimal);
                let is_shorter = length(&decimal) < length(&exact);
                if is_shorter || numbers::has_long_root(value) { decimal } else { exact }
            }
            Cow::Borrowed(_) => exact,
        }
    }

    /// The polynomial with decimals for long numbers with functions if [`EquationOptions::rounds_roots`] is set.
    fn with_decimals<'p, 'h>(&self, value: &'p Polynomial<'h>) -> Cow<'p, Polynomial<'h>> {
        let decimal = self.options.rounds_roots.then(|| without_functions(value)).flatten();
        decimal.map_or(Cow::Borrowed(value), Cow::Owned)
    }

    fn collected_exactly(&self, value: &Polynomial<'g>) -> Vec<ArrangedTerm<'g>> {
        let factors = !self.options.expand && self.options.form != Form::Expanded;
        if !factors && self.parallel.is_empty() {
            return value.arranged(|atom| self.order.rank(atom));
        }
        let double_angles = factors && self.options.double_angles;
        let collector = Collector { angles: &self.parallel, factors, double_angles };
        let collect = |part: &Polynomial<'g>| {
            collector.collect(part, |atom| self.order.rank(atom), &BRACKETS)
        };
        match self.options.form {
            Form::Collected | Form::Compact => {
                let parts = value.split_by(|factors| parts::of(factors, &self.order, self.graph));
                let part = |part: &Polynomial<'g>| match part.len() <= MAX_WHOLE {
                    true => collect(part),
                    false => self.by_rates(part, collect),
                };
                parts.values().flat_map(part).collect()
            }
            _ => collect(value),
        }
    }

    /// A long sum by its coefficients of accelerations and of products of velocities, which are collected separately.
    fn by_rates(
        &self,
        value: &Polynomial<'g>,
        collect: impl Fn(&Polynomial<'g>) -> Vec<ArrangedTerm<'g>>,
    ) -> Vec<ArrangedTerm<'g>> {
        let rates = [JointVariable::Acceleration, JointVariable::Velocity];
        let symbols: Vec<String> =
            rates.iter().flat_map(|variable| self.robot.symbols(*variable)).collect();
        let names: Vec<&str> = symbols.iter().map(String::as_str).collect();
        let groups = value.collect(&names);
        let terms = groups.iter().flat_map(|(monomial, coefficient)| {
            let factors = monomial.factors().iter();
            let rates = factors.map(|factor| {
                (ArrangedFactor::Atom(self.graph.expr(factor.atom())), factor.exponent())
            });
            let rates: Vec<_> = rates.collect();
            match rates.is_empty() {
                true => collect(coefficient),
                false => vec![ArrangedTerm::product(&collect(coefficient), rates)],
            }
        });
        terms.collect()
    }

    /// An equation whose right side is a sum of terms.
    fn of_terms(
        &self,
        name: String,
        left: Math,
        terms: &[ArrangedTerm<'_>],
    ) -> Result<Equation, Error> {
        let mut terms = roots::reduced(terms);
        if !self.options.paper && self.options.order.is_empty() {
            terms = signs::fewer(&terms);
        }
        let text = arranged_text(&terms)?;
        let right = self.symbols.terms(&terms)?;
        Ok(Equation { name, text, left, right })
    }

    /// An equation whose right side is an expression in the structure in which it was built.
    fn of_expression(&self, name: String, left: Math, value: Expr<'_>) -> Result<Equation, Error> {
        let text = robot_symbolic::print::to_text(value)?;
        let right = self.symbols.expression(value)?;
        Ok(Equation { name, text, left, right })
    }
}

/// The joint torques of a function.
fn forces_of<'g>(derivation: &Derivation<'_, 'g>, kind: FunctionKind) -> Vec<Expr<'g>> {
    let outputs = derivation.functions(kind).into_iter().flat_map(|function| function.outputs);
    outputs.flat_map(|output| output.values).collect()
}

/// The symbol of a joint torque.
fn joint_torque(index: usize) -> Symbol {
    Symbol { kind: Kind::JointTorque, number: index + 1, component: None }
}

/// The entry of `values`, one for each coordinate, that belongs to a joint torque; `None` for other quantities.
fn of_joint_torque<'g>(quantity: &Quantity<'g>, values: &[Expr<'g>]) -> Option<Expr<'g>> {
    let place = quantity.symbol.number.checked_sub(1)?;
    values.get(place).copied().filter(|_| quantity.symbol.kind == Kind::JointTorque)
}
