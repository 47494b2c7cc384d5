//! Printed equations are read back and proved equal to the values that the program computes: by polynomials if these
//! are short enough, otherwise by values at several states.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

use std::collections::BTreeMap;
use std::path::Path;

use robot_document::base_parameters::base;
use robot_document::document::NumberedEquation;
use robot_document::latex::{self, Layout};
use robot_document::math::Math;
use robot_document::meaning::{Looks, meaning};
use robot_document::{
    Cell, Equation, EquationOptions, Equations, Form, Room, Trigonometry, equations,
};
use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_dynamics::newton_euler::newton_euler;
use robot_dynamics::quantity::Kind;
use robot_model::description::read_toml;
use robot_model::functions::{Effects, FunctionKind};
use robot_model::robot::{BaseFrames, Robot};
use robot_symbolic::walk::derivatives;
use robot_symbolic::{AngleSums, Expr, Graph, Polynomial, PolynomialOptions};

/// The limits of a proof by polynomials.
const PROOF: PolynomialOptions =
    PolynomialOptions { angle_sums: AngleSums::Expand, max_terms: 20_000, max_products: 100_000 };

fn robots() -> Vec<Robot> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    let robots: Vec<Robot> = paths
        .iter()
        .map(|path| {
            let text = std::fs::read_to_string(path).unwrap();
            read_toml(&path.display().to_string(), &text).unwrap().robot
        })
        .collect();
    assert!(robots.len() >= 9);
    robots
}

#[test]
fn a_tolerance_that_is_no_small_angle_is_refused() {
    let robot = robots().remove(0);
    for snap in [1.0, -1e-3, f64::NAN, f64::INFINITY] {
        let options = EquationOptions { snap: Some(snap), ..EquationOptions::default() };
        let found = equations(&robot, &options).map(|_| ()).unwrap_err().to_string();
        assert!(found.contains("between 0 and 0.1"), "{found}");
        assert!(base(&robot, Some(snap)).is_err(), "{snap}");
    }
}

/// The values of the quantities as the program computes them, by their names.
fn expected<'g>(
    robot: &Robot,
    graph: &'g Graph,
    options: &EquationOptions,
) -> BTreeMap<String, Expr<'g>> {
    let exact = MechanismOptions::EXACT.with_snap(options.snap, robot);
    let derivation = Derivation::new(robot, graph, &exact, None);
    let effects = Effects { wrench: true, friction: options.friction };
    let iterations = newton_euler(&derivation.mechanism, effects);
    let mut values: BTreeMap<String, Expr<'g>> = Kind::ALL
        .iter()
        .flat_map(|kind| iterations.quantities(*kind))
        .map(|quantity| (quantity.symbol.to_string(), quantity.value))
        .collect();
    let kind = match options.friction {
        true => FunctionKind::InverseDynamics(Effects::BOTH),
        false => FunctionKind::InverseDynamics(Effects::WRENCH),
    };
    let program = derivation.functions(kind).remove(0).outputs.remove(0).values;
    for (value, number) in program.into_iter().zip(1..) {
        values.insert(format!("Q{number}"), value);
    }
    values
}

/// The equations printed as LaTeX for this line width and read back: the expression of each quantity and definition,
/// with definitions substituted.
fn read_back<'g>(
    printed: &Equations,
    width: f64,
    graph: &'g Graph,
) -> Result<BTreeMap<String, Expr<'g>>, robot_document::Error> {
    let looks = Looks::new(&printed.symbols).unwrap();
    let mut values: BTreeMap<String, Expr<'g>> = BTreeMap::new();
    // Definitions and the quantities that they use are in order; quantities that use definitions can stand before
    // these.
    let (definitions, quantities): (Vec<_>, Vec<_>) =
        printed.groups.iter().partition(|group| group.definitions || group.used);
    for group in definitions.into_iter().chain(quantities) {
        let list: Vec<NumberedEquation> = group
            .equations
            .iter()
            .map(|equation| NumberedEquation {
                label: None,
                number: None,
                equation: equation.clone(),
            })
            .collect();
        let latex = latex::equations(&list, Layout::of_centimeters(width))?;
        let read = latex::read_equations(&latex).unwrap();
        assert_eq!(read.len(), list.len(), "{latex}");
        for ([left, right], one) in read.iter().zip(&list) {
            assert_eq!(latex::formula(left), latex::formula(&one.equation.left));
            let mut sides = right.pieces().split(|piece| *piece == Math::Sign('=')).map(|side| {
                meaning(&Math::row(side.to_vec()), graph, &looks)
                    .unwrap_or_else(|error| panic!("{error}: {latex}"))
                    .substitute(|name| values.get(name).copied())
            });
            let value = sides.next().unwrap();
            for other in sides {
                assert_equal(&one.equation.name, graph, value, other);
            }
            values.insert(one.equation.name.clone(), value);
        }
    }
    Ok(values)
}

/// Asserts that two expressions are equal.
fn assert_equal(what: &str, graph: &Graph, found: Expr<'_>, expected: Expr<'_>) {
    if let Ok(difference) = Polynomial::of(found - expected, &PROOF)
        && difference.is_zero()
    {
        return;
    }
    for state in 1..=3 {
        let value = |symbol| {
            let name: String = graph.symbol_name(symbol);
            let hash = name.bytes().fold(17 * state, |hash: u32, byte| {
                hash.wrapping_mul(31).wrapping_add(u32::from(byte)).wrapping_mul(2_654_435_761)
            });
            0.2 + f64::from(hash >> 8) / f64::from(1 << 24)
        };
        let (found, expected) = (found.evaluate(value), expected.evaluate(value));
        let error = (found - expected).abs();
        assert!(error <= 1e-9 * expected.abs().max(1.0), "{what}: {found} {expected}");
    }
}

fn check(robot: &Robot, options: &EquationOptions, widths: &[f64]) {
    let printed = match equations(robot, options) {
        Ok(printed) => printed,
        Err(error) => {
            // Expanded and collected joint torques of a robot with many joints are too long.
            let whole = matches!(options.form, Form::Expanded | Form::Collected);
            assert!(whole, "{}: {error} {options:?}", robot.name);
            return;
        }
    };
    let graph = Graph::new();
    let expected = expected(robot, &graph, options);
    for width in widths {
        let found = read_back(&printed, *width, &graph)
            .unwrap_or_else(|error| panic!("{} {options:?}: {error}", robot.name));
        let mut compared = 0;
        for (name, value) in &expected {
            let Some(found) = found.get(name) else { continue };
            let what = format!("{} {name} {options:?}", robot.name);
            assert_equal(&what, &graph, *found, *value);
            compared += 1;
        }
        assert!(compared >= robot.degrees_of_freedom());
    }
}

fn in_form(form: Form) -> EquationOptions {
    EquationOptions { form, ..EquationOptions::default() }
}

#[test]
fn every_form_of_every_robot_reads_back_as_the_program() {
    for robot in robots() {
        for form in Form::ALL {
            check(&robot, &in_form(form), &[8.2, 16.0]);
        }
    }
}

#[test]
fn moments_in_other_frames_read_back_as_the_program() {
    for robot in robots() {
        let robot = Robot { base_frames: BaseFrames::DenavitHartenberg, ..robot };
        check(&robot, &in_form(Form::Regrouped), &[16.0]);
    }
}

#[test]
fn every_quantity_reads_back_in_the_forms_that_have_it() {
    for robot in robots().iter().filter(|robot| robot.degrees_of_freedom() < 6) {
        for form in [Form::Expanded, Form::Compact] {
            check(robot, &EquationOptions { kinds: Kind::ALL.to_vec(), ..in_form(form) }, &[8.2]);
        }
    }
}

#[test]
fn every_style_reads_back() {
    for robot in robots().iter().filter(|robot| robot.degrees_of_freedom() < 6) {
        for trigonometry in [Trigonometry::Short, Trigonometry::Paper] {
            for angle_sums in [AngleSums::Expand, AngleSums::Keep] {
                for form in Form::ALL {
                    let angle_sums = Some(angle_sums);
                    let options = EquationOptions { trigonometry, angle_sums, ..in_form(form) };
                    check(robot, &EquationOptions { christoffel: true, ..options }, &[8.2]);
                }
            }
        }
    }
}

#[test]
fn double_angles_read_back() {
    for robot in robots().iter().filter(|robot| robot.degrees_of_freedom() < 6) {
        for trigonometry in [Trigonometry::Named, Trigonometry::Short] {
            for form in [Form::Collected, Form::Grouped, Form::Regrouped] {
                let options = EquationOptions { trigonometry, ..in_form(form) };
                check(robot, &EquationOptions { double_angles: true, ..options }, &[8.2]);
            }
        }
    }
}

/// A reflected inertia that acts against gravity is regrouped with a constant offset, which is not printed without
/// friction.
#[test]
fn regrouped_torques_without_friction_are_whole() {
    let link = |name: &str, axis: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ type = \"prismatic\", axis = \"{axis}\" }}\nmass = 2\n\
             center_of_mass = [0, 0, 0]\ninertia = {{ xx = 0.1, yy = 0.1, zz = 0.1 }}\ndrive = {{ armature = 0.5 }}\n\
             friction = {{ viscous = 0.2, coulomb_positive = 0.1, coulomb_negative = 0.2, offset = 0.3 }}\n"
        )
    };
    let text =
        format!("format = 1\n[robot]\nname = \"lift\"\n{}{}", link("a", "z"), link("b", "x"));
    let robot = read_toml("lift.toml", &text).unwrap().robot;
    for friction in [false, true] {
        check(&robot, &EquationOptions { friction, ..in_form(Form::Regrouped) }, &[8.2]);
    }
}

/// A joint force that equals another one is defined too, because friction depends on its symbol.
#[test]
fn equal_joint_forces_are_defined() {
    for gravity in ["[\"g\", \"g\", 0]", "[\"g\", \"-g\", 0]"] {
        let text = format!(
            "format = 1\n[robot]\nname = \"slide\"\ngravity = {gravity}\n[parameters]\ng = 9.81\nm = 2\n\
             [[link]]\nname = \"1\"\njoint = {{ type = \"prismatic\", axis = \"z\" }}\nmass = \"m\"\n\
             center_of_mass = [0, 0, 0]\ninertia = {{ xx = 0.1, yy = 0.1, zz = 0.1 }}\nfriction = {{ coulomb = 0.02 }}\n"
        );
        let robot = read_toml("slide.toml", &text).unwrap().robot;
        for christoffel in [false, true] {
            let options = EquationOptions { friction: true, christoffel, ..in_form(Form::Grouped) };
            let printed = equations(&robot, &options).unwrap();
            let names: Vec<&str> = printed
                .groups
                .iter()
                .flat_map(|group| &group.equations)
                .map(|one| one.name.as_str())
                .collect();
            assert!(names.contains(&"F_l1_x") && names.contains(&"F_l1_y"), "{names:?}");
            check(&robot, &options, &[8.2]);
        }
    }
}

#[test]
fn friction_reads_back() {
    let robots = robots();
    let mut with_friction = robots.iter().filter(|robot| robot.has_friction()).peekable();
    assert!(with_friction.peek().is_some());
    for robot in with_friction {
        for form in Form::ALL {
            check(robot, &EquationOptions { friction: true, ..in_form(form) }, &[8.2, 16.0]);
        }
    }
}

/// The matrices and columns, by their names, printed as LaTeX for this line width and read back; arrays that did not
/// fit are read from their entries. Also returns the number of arrays that fit.
fn arrays<'g>(
    printed: &Equations,
    width: f64,
    graph: &'g Graph,
) -> (BTreeMap<String, Vec<Vec<Expr<'g>>>>, usize) {
    let values = read_back(printed, width, graph).unwrap();
    let looks = Looks::new(&printed.symbols).unwrap();
    let layout = Layout::of_centimeters(width);
    let arranged = printed.arranged(Room::Points(layout.width - 44.0));
    let mut shown: BTreeMap<String, Math> = BTreeMap::new();
    for group in &arranged.groups {
        let numbered = |one: &Equation| NumberedEquation {
            label: Some(one.label()),
            number: None,
            equation: one.clone(),
        };
        let list: Vec<NumberedEquation> = group.equations.iter().map(numbered).collect();
        let latex = latex::equations(&list, layout).unwrap();
        let read = latex::read_equations(&latex).unwrap_or_else(|error| panic!("{error}: {latex}"));
        assert_eq!(read.len(), list.len(), "{latex}");
        for ([_, right], one) in read.into_iter().zip(list) {
            shown.insert(one.equation.name, right);
        }
    }
    let value = |math: &Math| {
        let value =
            meaning(math, graph, &looks).unwrap_or_else(|error| panic!("{error}: {math:?}"));
        // Entries can be known by the names of entries of other rows.
        value.substitute(|name| values.get(name).copied())
    };
    let mut found = BTreeMap::new();
    let mut matrices = 0;
    for array in printed.arrays() {
        let rows = match shown.get(&array.name) {
            Some(Math::Matrix(rows)) => {
                matrices += 1;
                rows.iter().map(|row| row.iter().map(value).collect()).collect()
            }
            _ => {
                let entry = |cell: &Cell| match shown.get(&cell.name) {
                    Some(math) => value(math),
                    None => value(&cell.whole.as_ref().unwrap().math),
                };
                array.rows.iter().map(|row| row.iter().map(entry).collect()).collect()
            }
        };
        found.insert(array.name.clone(), rows);
    }
    (found, matrices)
}

#[test]
fn joint_torques_are_those_of_the_matrices() {
    let mut matrices = 0;
    for robot in robots().iter().filter(|robot| robot.degrees_of_freedom() > 1) {
        // Robots with many joints take seconds for each width.
        let widths: &[f64] =
            if robot.degrees_of_freedom() < 6 { &[8.2, 16.0, 60.0] } else { &[16.0] };
        for christoffel in [false, true] {
            for width in widths.iter().copied() {
                let options = EquationOptions { christoffel, ..in_form(Form::Grouped) };
                let (printed, graph) = (equations(robot, &options).unwrap(), Graph::new());
                let (found, shown) = arrays(&printed, width, &graph);
                matrices += shown;
                let rate = |name: &str, place: usize| graph.symbol(&format!("{name}{}", place + 1));
                for row in 0..robot.degrees_of_freedom() {
                    let mut force = graph.zero();
                    for (name, rows) in &found {
                        let cells = rows[row].iter().enumerate();
                        force += match (name.as_str(), rows[row].len()) {
                            (_, 1) => rows[row][0],
                            (name, _) if name.ends_with("(q)") => cells
                                .fold(graph.zero(), |sum, (at, cell)| {
                                    sum + *cell * rate("qdd", at)
                                }),
                            _ => cells
                                .fold(graph.zero(), |sum, (at, cell)| sum + *cell * rate("qd", at)),
                        };
                    }
                    let name = format!("Q{}", row + 1);
                    let expected = expected(robot, &graph, &options)[&name];
                    assert_equal(
                        &format!("{} {name} {width}", robot.name),
                        &graph,
                        force,
                        expected,
                    );
                }
            }
        }
    }
    assert!(matrices > 100, "{matrices}");
}

#[test]
fn the_title_of_the_velocity_terms_names_what_is_shown() {
    const SYMBOLS: &str = "Christoffel symbols";
    const MATRIX: &str = "Matrix of the Coriolis and centrifugal terms";
    let both = format!("{MATRIX}, {SYMBOLS}");
    for (name, title) in [("planar_2r", MATRIX), ("planar_3r", both.as_str())] {
        let robot = robots().into_iter().find(|robot| robot.name == name).unwrap();
        let options = EquationOptions { christoffel: true, ..in_form(Form::Grouped) };
        let printed = equations(&robot, &options).unwrap();
        let titles = |shown: &Equations| -> Vec<String> {
            shown.groups.iter().map(|group| group.title.clone()).collect()
        };
        let arranged = printed.arranged(Room::Points(470.0));
        assert_eq!([&titles(&printed)[2], &titles(&arranged)[2]], [SYMBOLS, title], "{name}");
    }
}

#[test]
fn the_velocity_matrix_by_christoffel_symbols_leaves_a_skew_symmetric_rest() {
    for robot in robots().iter().filter(|robot| (2..6).contains(&robot.degrees_of_freedom())) {
        let options = EquationOptions { christoffel: true, ..in_form(Form::Grouped) };
        let (printed, graph) = (equations(robot, &options).unwrap(), Graph::new());
        let (found, _) = arrays(&printed, 60.0, &graph);
        let matrix = |end: &str| {
            let mut all = found.iter();
            all.find(|(name, rows)| name.ends_with(end) && rows[0].len() > 1).map(|(_, rows)| rows)
        };
        let Some((masses, velocities)) = matrix("(q)").zip(matrix("(q, qd)")) else { continue };
        let count = robot.degrees_of_freedom();
        let change = |row: usize, column: usize| {
            (1..=count).fold(graph.zero(), |sum, joint| {
                let slope = derivatives(&[masses[row][column]], graph.symbol(&format!("q{joint}")));
                sum + slope[0] * graph.symbol(&format!("qd{joint}"))
            })
        };
        for (row, column) in (0..count).flat_map(|row| (0..=row).map(move |column| (row, column))) {
            let both = velocities[row][column] + velocities[column][row];
            let what = format!("{} {row} {column}", robot.name);
            assert_equal(&what, &graph, change(row, column), both);
        }
    }
}

#[test]
fn columns_of_vectors_read_back_as_the_program() {
    for robot in robots().iter().filter(|robot| robot.degrees_of_freedom() < 6) {
        let all = EquationOptions { kinds: Kind::ALL.to_vec(), ..EquationOptions::default() };
        for form in [Form::Recursive, Form::Expanded, Form::Compact] {
            let options = EquationOptions { form, ..all.clone() };
            let (printed, graph) = (equations(robot, &options).unwrap(), Graph::new());
            let (found, shown) = arrays(&printed, 16.0, &graph);
            assert!(shown > 0, "{} {form:?}", robot.name);
            let expected = expected(robot, &graph, &options);
            for (name, rows) in found {
                for (row, axis) in rows.iter().zip(["x", "y", "z"]) {
                    let component = format!("{name}.{axis}");
                    let Some(expected) = expected.get(&component) else { continue };
                    assert_equal(&format!("{} {component}", robot.name), &graph, row[0], *expected);
                }
            }
        }
    }
}
