//! Documents of robots that are given by Denavit–Hartenberg parameters.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

use robot_document::document::{Block, Inline, Table};
use robot_document::latex::formula;
use robot_document::robot::{Extras, document};
use robot_document::{EquationOptions, Form};
use robot_dynamics::mechanism;
use robot_model::description::read_toml;
use robot_model::robot::Robot;

/// A rotating column and a sliding arm. The twist is nearly a right angle.
fn robot(convention: &str) -> Robot {
    let link = "mass = 1\ncenter_of_mass = [0.1, 0, 0]\ninertia = { xx = 1, yy = 1, zz = 1 }\n";
    let text = format!(
        "format = 1\n[robot]\nname = \"arm\"\n[parameters]\nl1 = {{ value = 0.4, unit = \"m\" }}\n\
         [[link]]\nname = \"column\"\n{link}joint = {{ type = \"revolute\" }}\n\
         dh = {{ convention = \"{convention}\", a = \"l1/2\", alpha = 1.570796, d = \"l1\", theta = \"pi/2\" }}\n\
         [[link]]\nname = \"arm\"\n{link}joint = {{ type = \"prismatic\" }}\n\
         dh = {{ convention = \"{convention}\", d = 0.25 }}\n"
    );
    read_toml("arm.toml", &text).unwrap().robot
}

fn tables(robot: &Robot) -> Vec<(Table, Option<Block>)> {
    let forms = [Form::Grouped];
    let found = document(robot, &EquationOptions::default(), &forms, Extras::default()).unwrap();
    let blocks = found.blocks.iter().enumerate();
    let tables = blocks.filter_map(|(index, block)| match block {
        Block::Table(table) => Some((table.clone(), found.blocks.get(index + 1).cloned())),
        _ => None,
    });
    tables.filter(|(table, _)| table.caption.contains("Denavit")).collect()
}

/// The text of a line, with formulas in LaTeX without braces, spaces and fonts.
fn shown(inlines: &[Inline]) -> String {
    let plain = |math: &str| {
        let math = math.replace(r"\left", "").replace(r"\right", "").replace(r"\mathrm", "");
        math.replace(['{', '}', ' '], "")
    };
    let one = |inline: &Inline| match inline {
        Inline::Math(math) => plain(&formula(math)),
        Inline::Text(text) => text.clone(),
        other => panic!("{other:?}"),
    };
    inlines.iter().map(one).collect()
}

#[test]
fn a_table_has_the_parameters_with_their_symbols() {
    for convention in ["standard", "modified"] {
        let (snapped, _) = mechanism::snapped(&robot(convention), 1e-5);
        let found = tables(&snapped);
        let [(table, Some(Block::Paragraph(below)))] = found.as_slice() else {
            panic!("{convention}: {found:?}")
        };
        assert!(table.caption.contains(&format!("{convention} convention")), "{}", table.caption);
        let rows: Vec<Vec<String>> =
            table.rows.iter().map(|row| row.iter().map(|cell| shown(cell)).collect()).collect();
        assert_eq!(rows[0][..2], ["1", "column"]);
        assert_eq!(rows[0][2..5], [r"\frac12l_1", r"\pi/2", "l_1"]);
        assert_eq!(rows[0][5], r"q_1+\pi/2");
        assert_eq!(rows[1][2..], ["0", "0", "q_2+0.25", "0"]);
        let (head, moves) = match convention {
            "standard" => (["a_i", r"\alpha_i"], r"R_z(\theta_i)T_z(d_i)T_x(a_i)R_x(\alpha_i)"),
            _ => (["a_i-1", r"\alpha_i-1"], r"R_x(\alpha_i-1)T_x(a_i-1)R_z(\theta_i)T_z(d_i)"),
        };
        assert_eq!([shown(&table.head[2]), shown(&table.head[3])], head);
        let below = shown(below);
        assert!(below.contains(moves), "{below}");
    }
}

#[test]
fn robots_without_such_parameters_have_no_table() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/planar_2r.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let robot = read_toml("planar_2r.toml", &text).unwrap().robot;
    assert_eq!(tables(&robot), []);
}
