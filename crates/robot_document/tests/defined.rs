//! Each symbol in printed equations is a variable or parameter of the robot, or is defined by one of them, and it looks
//! the same where it is defined and where it is used.

#![allow(clippy::unwrap_used, reason = "a test that fails panics")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use robot_document::math::{Math, Symbol};
use robot_document::{
    Array, EquationOptions, Equations, Form, Group, Letters, Room, Trigonometry, equations,
};
use robot_dynamics::quantity::Kind;
use robot_model::description::read_toml;
use robot_model::robot::{BaseFrames, Robot};
use robot_model::variable::JointVariable;

fn robots() -> Vec<Robot> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots");
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<_> = paths.filter(|path| path.extension().unwrap() == "toml").collect();
    paths.sort();
    let read = |path: &std::path::PathBuf| {
        let text = std::fs::read_to_string(path).unwrap();
        read_toml(&path.display().to_string(), &text).unwrap().robot
    };
    let robots: Vec<Robot> = paths.iter().map(read).collect();
    assert!(robots.iter().any(Robot::has_friction));
    robots
}

/// The symbols within a formula.
fn symbols(math: &Math) -> Vec<&Symbol> {
    match math {
        Math::Symbol(symbol) => vec![symbol],
        other => other.parts().into_iter().flat_map(symbols).collect(),
    }
}

/// The layout of a left side or of an entry of a matrix.
fn shape(look: &Math) -> &Math {
    match look {
        Math::Symbol(symbol) => &symbol.shape,
        other => other,
    }
}

/// The layouts of the variables and parameters of a robot, by their names.
fn inputs(robot: &Robot, printed: &Equations) -> BTreeMap<String, Math> {
    let motions = JointVariable::MOTION.iter().flat_map(|variable| robot.symbols(*variable));
    let parameters = robot.parameters.iter().map(|parameter| parameter.name.clone());
    let wrenches = robot.tips().flat_map(|(_, wrench)| wrench.components().map(str::to_owned));
    let names = motions.chain(parameters).chain(wrenches);
    names.map(|name| (name.clone(), shape(&printed.symbols.look(&name)).clone())).collect()
}

/// The names of the entries that a printed matrix or column defines, with their layouts: an entry that is printed by its
/// name is only defined elsewhere.
fn written_out(group: &Group, array: &Array) -> Vec<(String, Math)> {
    let printed = group.equations.iter().find(|equation| equation.name == array.name).unwrap();
    let rows = if let Math::Matrix(rows) = &printed.right { rows.as_slice() } else { &[] };
    assert_eq!(rows.len(), array.rows.len(), "{}", array.name);
    let cells = array.rows.iter().flatten().zip(rows.iter().flatten());
    let defined = cells.filter(|(cell, math)| {
        let of_name = |symbol: &&Symbol| symbol.name == cell.name;
        !symbols(math).iter().any(of_name)
    });
    defined.map(|(cell, _)| (cell.name.clone(), shape(&cell.look).clone())).collect()
}

/// Asserts that the equations define what they use.
fn check(what: &str, robot: &Robot, printed: &Equations) {
    let mut known = inputs(robot, printed);
    let all = || printed.groups.iter().flat_map(|group| &group.equations);
    for group in &printed.groups {
        let arrays = group.arrays.iter().flatten();
        known.extend(arrays.flat_map(|array| written_out(group, array)));
    }
    known.extend(all().map(|one| (one.name.clone(), shape(&one.left).clone())));
    for equation in all() {
        for symbol in symbols(&equation.right) {
            let defined = known.get(&symbol.name);
            assert_eq!(
                defined,
                Some(&*symbol.shape),
                "{what}: {} in {}",
                symbol.name,
                equation.name
            );
        }
    }
}

/// The equations as they are printed if matrices and columns have this room: arrays that are not printed define nothing.
fn arranged(printed: &Equations, room: Room) -> Equations {
    let mut arranged = printed.arranged(room);
    for group in &mut arranged.groups {
        // Where the matrix C is shown, it is in the title of the group.
        let title = match group.title.starts_with("Matrix of the Coriolis") {
            true => "Christoffel symbols",
            false => &group.title,
        };
        let original = printed.groups.iter().find(|one| one.title == title).unwrap();
        let is_shown = |name: &str| group.equations.iter().any(|one| one.name == name);
        let arrays = original.arrays.iter().flatten().filter(|array| is_shown(&array.name));
        group.arrays = Some(arrays.cloned().collect());
    }
    arranged
}

fn check_all(robot: &Robot, options: &EquationOptions) {
    // Expanded and collected joint torques of a robot with many joints are too long.
    let Ok(printed) = equations(robot, options) else { return };
    let what = format!("{} {options:?}", robot.name);
    let without_arrays = |group: &Group| Group { arrays: None, ..group.clone() };
    let groups = printed.groups.iter().map(without_arrays).collect();
    let plain = Equations { groups, ..printed.clone() };
    check(&what, robot, &plain);
    for room in
        [Room::Points(200.0), Room::Points(450.0), Room::Points(2000.0), Room::Characters(100)]
    {
        check(&format!("{what} {room:?}"), robot, &arranged(&printed, room));
    }
}

#[test]
fn every_symbol_is_defined_and_looks_the_same() {
    for robot in robots() {
        let friction = robot.has_friction();
        for form in Form::ALL {
            check_all(&robot, &EquationOptions { form, friction, ..EquationOptions::default() });
        }
    }
}

/// A horizontal arm with a payload on its last link.
const CARRYING: &str = include_str!("carrying.toml");

/// Parts that cancel and moments of inertia that do not act have no names.
#[test]
fn every_name_is_used() {
    let files = [("carrying", CARRYING), ("skew", SKEW), ("gantry", GANTRY), ("arrow", ARROW)];
    let own = files.map(|(name, text)| read_toml(name, text).unwrap().robot);
    let mut names = 0;
    for robot in robots().iter().chain(&own) {
        for form in [Form::Compact, Form::Grouped, Form::Recursive] {
            let friction = robot.has_friction();
            let options = EquationOptions { form, friction, ..EquationOptions::default() };
            let printed = equations(robot, &options).unwrap();
            let all = || printed.groups.iter().flat_map(|group| &group.equations);
            let used: BTreeSet<&str> = all().flat_map(|one| one.right.symbols()).collect();
            let titles = ["Combinations", "Expressions", "Parameters of the links"];
            let is_of_parts =
                |group: &&Group| titles.iter().any(|title| group.title.starts_with(title));
            for one in printed.groups.iter().filter(is_of_parts).flat_map(|one| &one.equations) {
                names += 1;
                assert!(used.contains(&*one.name), "{}, {form:?}: {}", robot.name, one.name);
            }
        }
    }
    assert!(names > 100, "{names}");
}

/// Two links with skew axes; the principal moments of the second about two axes are the same.
const SKEW: &str = include_str!("skew.toml");

/// A chain of which one constant is named and not used, and used if it has no name.
const GANTRY: &str = include_str!("gantry.toml");

/// Skew axes with dry friction.
const ARROW: &str = include_str!("arrow.toml");

/// A Furuta pendulum, whose common parts are written where they are used.
#[test]
fn what_is_used_once_has_no_name() {
    let text = include_str!("furuta.toml");
    let robot = read_toml("furuta", text).unwrap().robot;
    let options = EquationOptions { form: Form::Compact, ..EquationOptions::default() };
    let found = equations(&robot, &options).unwrap();
    let names: Vec<&str> = found.definitions().map(|one| one.name.as_str()).collect();
    assert_eq!(names, [""; 0]);
}

/// The lengths of these axes are roots of long numbers.
#[test]
fn roots_of_long_numbers_are_not_printed() {
    // The wrench of the third link is long.
    let third = SKEW.rsplit_once("[[link]]").unwrap().1.replace("\"2\"", "\"3\"");
    let third = third.replace("0.7071067811865476, 0, 0.7071067811865475", "0.211, 0.817, -0.061");
    let long = format!("{SKEW}[[link]]{third}");
    let of_two = Form::ALL.into_iter().map(|form| (SKEW, form));
    for (text, form) in of_two.chain([(long.as_str(), Form::Recursive)]) {
        let robot = read_toml("skew.toml", text).unwrap().robot;
        let options = EquationOptions {
            form,
            rounds_roots: true,
            digits: Some(10),
            ..EquationOptions::default()
        };
        let printed = equations(&robot, &options).unwrap();
        let texts = printed.groups.iter().flat_map(|group| &group.equations).map(|one| &one.text);
        for text in texts {
            for root in text.split("sqrt(").skip(1) {
                let number = root.split(')').next().unwrap();
                assert!(number.len() < 5, "{form:?}: {text}");
            }
        }
        assert_no_rounding_errors(&printed);
    }
}

#[test]
fn every_symbol_is_defined_with_each_option() {
    for robot in robots().iter().filter(|robot| robot.degrees_of_freedom() < 6) {
        for form in Form::ALL {
            let usual = EquationOptions { form, ..EquationOptions::default() };
            let kinds = Kind::ALL.to_vec();
            let letters = Letters::parse("field").unwrap();
            for options in [
                EquationOptions { letters, friction: true, ..usual.clone() },
                EquationOptions { kinds: kinds.clone(), ..usual.clone() },
                EquationOptions { kinds, paper: true, friction: true, ..usual.clone() },
                EquationOptions { christoffel: true, references: false, ..usual.clone() },
                EquationOptions { expand: true, digits: Some(4), rounds_roots: true, ..usual },
            ] {
                check_all(robot, &options);
            }
        }
    }
}

#[test]
fn given_letters_name_nothing_else() {
    let robots = robots();
    let planar = robots.iter().find(|robot| robot.name == "planar_2r").unwrap();
    let printed = |letters: &str, form: Form, trigonometry: Trigonometry| {
        let letters = Letters::parse(letters).unwrap();
        equations(
            planar,
            &EquationOptions { form, letters, trigonometry, ..EquationOptions::default() },
        )
    };
    for form in Form::ALL {
        for refused in ["q,M,C,g", "tau,q,C,g", "tau,M,q,g", "tau,M,C,q"] {
            let why = printed(refused, form, Trigonometry::Named).unwrap_err().to_string();
            assert_eq!(
                why,
                "the letter q already stands for the joint positions; choose another letter for the joint torques or the matrices"
            );
        }
        let sines = printed("tau,M,c,g", form, Trigonometry::Short).unwrap_err().to_string();
        assert!(sines.contains("the letter c already stands for sines and cosines;"), "{sines}");
        // The letters that the forms choose give way.
        for taken in ["x,M,C,g", "tau,w,C,g", "tau,M,w,t", "tau,k,x,g", "Y,M,C,g", "h,w,x,k"] {
            let printed = printed(taken, form, Trigonometry::Named).unwrap();
            let mut known = BTreeSet::new();
            for equation in printed.groups.iter().flat_map(|group| &group.equations) {
                assert!(known.insert(&equation.name), "{taken} {form:?}: {} twice", equation.name);
            }
            for letter in taken.split(',') {
                let of =
                    |group: &Group| group.equations.iter().any(|one| of_letter(&one.name, letter));
                let used = printed.groups.iter().filter(|group| of(group)).count();
                assert!(used <= 1, "{taken} {form:?}: {letter} is used by {used} groups");
            }
        }
    }
    let why = printed("omega,M,C,g", Form::Recursive, Trigonometry::Named).unwrap_err().to_string();
    assert!(
        why.contains("the letter omega already stands for other symbols of these equations"),
        "{why}"
    );
}

/// A symbol of the robot that is printed like something that the equations define is refused, and the letter is named.
#[test]
fn symbols_of_the_robot_name_nothing_else() {
    let text = include_str!("../../../robots/planar_2r.toml");
    let printed = |from: &str, to: &str, form: Form| {
        let robot = read_toml("robot.toml", &text.replace(from, to)).unwrap().robot;
        equations(&robot, &EquationOptions { form, ..EquationOptions::default() })
    };
    let latex = |latex: &str| format!("\nr1 = {{ latex = '{latex}',");
    let why =
        |latex: String, form: Form| printed("\nr1 = {", &latex, form).unwrap_err().to_string();
    for form in [Form::Expanded, Form::Collected, Form::Grouped, Form::Regrouped] {
        assert!(
            why(latex("Q_1"), form).starts_with("the letter Q already stands for other symbols")
        );
        assert!(why(latex(r"\pi"), form).contains("`r1` and `pi` are both printed as"));
        assert!(why(latex(r"\mathrm{sin}"), form).contains("`r1` and `sin` are both printed as"));
        assert!(why(latex("r_2^2"), form).contains("`r1` and `r2^2` are both printed as"));
    }
    for vector in ["q", r"\dot{q}", r"\ddot{q}"] {
        assert!(why(latex(vector), Form::Grouped).contains("`r1` and `q"), "{vector}");
        assert!(printed("\nr1 = {", &latex(vector), Form::Expanded).is_ok());
    }
    assert!(why(latex("Q"), Form::Grouped).starts_with("the letter Q already stands for a symbol"));
    // Without a joint 3, `Q_3` is only a parameter.
    assert!(printed("\nr1 = {", &latex("Q_3"), Form::Grouped).is_ok());
}

/// The columns of friction and wrenches are printed as symbols, which no parameter may have.
#[test]
fn names_of_columns_are_those_of_no_parameter() {
    let text = include_str!("../../../robots/planar_2r.toml").replace("r1", "Q_f");
    let text = text.replacen("joint = {", "friction = { viscous = 1 }\njoint = {", 1);
    let robot = read_toml("robot.toml", &text).unwrap().robot;
    let options = EquationOptions { friction: true, ..EquationOptions::default() };
    let of = |form: Form| equations(&robot, &EquationOptions { form, ..options.clone() }).unwrap();
    for typeset in [true, false] {
        let refused = of(Form::Grouped).check_array_names(typeset).unwrap_err().to_string();
        assert!(refused.contains("name a vector `Q_f`"), "{refused}");
        assert!(of(Form::Expanded).check_array_names(typeset).is_ok());
    }
    // The acceleration of link 1 is `a1` as text, but has a bar in print.
    let text = include_str!("../../../robots/planar_2r.toml").replace("r1", "a1");
    let robot = |text: &str| read_toml("robot.toml", text).unwrap().robot;
    let options = EquationOptions { form: Form::Recursive, ..EquationOptions::default() };
    let found = equations(&robot(&text), &options).unwrap();
    assert!(found.check_array_names(true).is_ok() && found.check_array_names(false).is_err());
}

/// A joint force that is 0, as a sum of terms that cancel, does not occur in friction.
#[test]
fn forces_that_are_zero_are_not_in_friction() {
    let link = |name: &str, joint: &str, friction: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ {joint} }}\nmass = 1\ncenter_of_mass = [0, 0, 0]\n\
             inertia = {{ xx = 1, yy = 1, zz = 1 }}\n{friction}"
        )
    };
    let slide =
        link("slide", "type = \"prismatic\", axis = \"y\"", "friction = { coulomb = 0.1 }\n");
    let turn = link("turn", "type = \"revolute\", axis = \"z\"", "");
    let text = format!("format = 1\n[robot]\nname = \"rob\"\n{slide}{turn}");
    let robot = read_toml("robot.toml", &text).unwrap().robot;
    for form in Form::ALL {
        check_all(&robot, &EquationOptions { form, friction: true, ..EquationOptions::default() });
    }
}

/// Terms that cancel leave nothing: joints about and along axes between those of the frames, whose directions have roots
/// or are rounded.
#[test]
fn rounding_errors_are_not_terms() {
    let text = |kind: &str, [first, second]: [&str; 2], pose: &str| {
        let link = |name: &str, axis: &str, origin: &str| {
            format!(
                "[[link]]\nname = \"{name}\"\njoint = {{ type = \"{kind}\", axis = {axis} }}\nmass = 2\n{origin}\n\
                 center_of_mass = [0, \"l/2\", \"l/2\"]\ninertia = {{ xx = 1, yy = 1.1, zz = 1.2 }}\n"
            )
        };
        let links = [link("a", first, ""), link("b", second, &format!("origin = {pose}"))];
        format!(
            "format = 1\n[robot]\nname = \"rob\"\ngravity = [0, \"-g\", 0]\n[parameters]\ng = 9.81\nl = 0.3\n{}",
            links.concat()
        )
    };
    let turned = "{ rpy = [0, 0, 0.3] }";
    for (kind, axes, pose) in [
        ("prismatic", ["[1, -2, 2]", "\"z\""], turned),
        ("revolute", ["[1, 0, 1]", "\"x\""], "{ xyz = [0.1, \"l\", 0], rpy = [0.4, \"pi/2\", 0] }"),
        ("revolute", ["[1, 1, 1]", "[0, 1, 1]"], "{ xyz = [\"l\", 0, 0.2], rpy = [0, 0.4, 0] }"),
    ] {
        let robot = read_toml("robot.toml", &text(kind, axes, pose)).unwrap().robot;
        for base_frames in [BaseFrames::File, BaseFrames::DenavitHartenberg] {
            let robot = Robot { base_frames, ..robot.clone() };
            for form in Form::ALL {
                let options = EquationOptions { form, ..EquationOptions::default() };
                let Ok(printed) = equations(&robot, &options) else { continue };
                assert_no_rounding_errors(&printed);
            }
            let base = robot_document::base_parameters::base(&robot, None).unwrap();
            for entry in base.list {
                let text = entry.formula.text + &entry.value.text;
                assert!(!is_rounding_error(&text), "{text}");
            }
        }
    }
}

/// Terms that cancel one after the other leave nothing either: the first joint's position has no effect on the mass
/// matrix, so b₁₁₁ is 0.
#[test]
fn rounding_errors_of_many_terms_are_not_terms() {
    let link = |name: &str, joint: &str, body: &str| {
        format!(
            "[[link]]\nname = \"{name}\"\njoint = {{ type = \"revolute\", axis = {joint}\nmass = {body}\n\
             inertia = {{ xx = 0.8, yy = 0.9, zz = 1 }}\n"
        )
    };
    let text = [
        "format = 1\n[robot]\nname = \"rob\"\ngravity = [0, 0, \"-g\"]\n[parameters]\ng = 9.81\nc = 0.677\nm = 3.226\n",
        &link("1", "\"z\" }\norigin = { rpy = [0, 0, \"-pi/2\"] }", "1\ncenter_of_mass = [0, 1, 0]"),
        &link(
            "2",
            "[1, -2, 2] }\norigin = { xyz = [\"c\", 0, 0], rpy = [\"pi/6\", 0, \"pi/3\"] }",
            "2.644016\ncenter_of_mass = [0, 0, 0]",
        ),
        &link(
            "3",
            "[-1, 0, 0] }\norigin = { xyz = [1, 0.90, 0.13], rpy = [0, 0, \"-pi/2\"] }",
            "\"m\"\ncenter_of_mass = [\"3/5\", 0, 0]",
        ),
    ]
    .concat();
    let robot = read_toml("robot.toml", &text).unwrap().robot;
    let options = EquationOptions { form: Form::Grouped, ..EquationOptions::default() };
    let printed = equations(&robot, &options).unwrap();
    assert_no_rounding_errors(&printed);
    assert!(
        printed.groups.iter().flat_map(|group| &group.equations).all(|one| one.name != "b_1_1_1")
    );
}

#[track_caller]
fn assert_no_rounding_errors(printed: &Equations) {
    for equation in printed.groups.iter().flat_map(|group| &group.equations) {
        assert!(!is_rounding_error(&equation.text), "{}: {}", equation.name, equation.text);
    }
}

fn is_rounding_error(text: &str) -> bool {
    (13..20).any(|exponent: u32| text.contains(&format!("e-{exponent}")))
}

/// Whether a name is the letter with a number, such as `x_1` or `tau1`.
fn of_letter(name: &str, letter: &str) -> bool {
    let tail = name.strip_prefix(letter).map(|tail| tail.trim_start_matches('_'));
    tail.is_some_and(|tail| tail.starts_with(|first: char| first.is_ascii_digit()))
}

#[test]
fn entries_with_long_numbers_are_printed_once() {
    let is_long = |word: &str| word.bytes().filter(u8::is_ascii_digit).count() > 7;
    for robot in robots().iter().filter(|robot| robot.degrees_of_freedom() <= 6) {
        let options = EquationOptions { form: Form::Grouped, ..EquationOptions::default() };
        let printed = equations(robot, &options).unwrap();
        for group in printed.groups.iter().filter(|group| group.definitions) {
            let mut known: BTreeMap<&str, &str> = BTreeMap::new();
            for equation in &group.equations {
                let words: Vec<&str> = equation.text.split(['*', ' ', '(']).collect();
                if words.len() > 1 && words.iter().any(|word| is_long(word)) {
                    let other = known.insert(&equation.text, &equation.name);
                    assert_eq!(other, None, "{} {}", robot.name, equation.name);
                }
            }
        }
    }
}

/// An entry on or above the diagonal is 0, stands in the matrix, or has an equation, also if it equals another entry: a
/// reader takes an entry that is not printed as 0.
#[test]
fn entries_of_matrices_and_columns_are_all_printed() {
    let mut equal = 0;
    for robot in robots() {
        let printed = equations(
            &robot,
            &EquationOptions { form: Form::Grouped, ..EquationOptions::default() },
        );
        let printed = printed.unwrap();
        for room in [Room::Points(150.0), Room::Points(450.0), Room::Characters(40)] {
            let shown = printed.arranged(room);
            let is_shown = |name: &str| {
                shown.groups.iter().flat_map(|group| &group.equations).any(|one| one.name == name)
            };
            for array in printed.arrays().filter(|array| !is_shown(&array.name)) {
                for cell in array.rows.iter().flatten() {
                    let is_zero = cell.whole.as_ref().is_some_and(|whole| whole.text == "0");
                    let own = cell.alias.as_ref().map_or(&cell.name, |alias| &alias.name);
                    assert!(is_zero || is_shown(own), "{} {room:?}: {own}", robot.name);
                    equal += usize::from(cell.alias.is_some());
                }
            }
        }
        // The places of equal entries are those of the mass matrix.
        let masses = printed.arrays().next().unwrap();
        for (row, cells) in masses.rows.iter().enumerate() {
            for (column, cell) in cells.iter().enumerate().skip(row) {
                let own = cell.alias.as_ref().map_or(&cell.name, |alias| &alias.name);
                let place = format!("_{}_{}", row + 1, column + 1);
                assert!(own.starts_with("0_") || own.ends_with(&place), "{}: {own}", robot.name);
            }
        }
    }
    assert!(equal >= 8, "{equal}");
}
