//! What functions say about themselves: units and paragraphs.

use robot_dynamics::functions::Derivation;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::functions::{Effects, FunctionKind};
use robot_symbolic::Graph;

/// Units of arrays over the coordinates name the prismatic joints only if there are both kinds.
#[test]
fn units_name_the_prismatic_joints_among_others() {
    let unit = |kinds: &[&str]| {
        let links = kinds.iter().enumerate().map(|(index, kind)| {
            format!(
                "[[link]]\nname = \"{index}\"\njoint = {{ type = \"{kind}\", axis = \"z\" }}\n\
                 mass = 1.0\ncenter_of_mass = [0.1, 0.2, 0]\ninertia = {{ xx = 1, yy = 1, zz = 1 }}\n"
            )
        });
        let text = format!("format = 1\n[robot]\nname = \"arm\"\n{}", links.collect::<String>());
        let robot = robot_model::description::read_toml("arm.toml", &text).unwrap().robot;
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let kind = FunctionKind::InverseDynamics(Effects::NONE);
        derivation.functions(kind).remove(0).outputs.remove(0).unit
    };
    let (r, p) = ("revolute", "prismatic");
    assert_eq!(unit(&[r, r]), "N m");
    assert_eq!(unit(&[p, p]), "N");
    assert_eq!(unit(&[r, p]), "N m; N for the prismatic joint (the second entry)");
    assert_eq!(unit(&[p, r, p]), "N m; N for the prismatic joints (the first and third entries)");
}

/// The documentation of the regressor describes the columns of drives, if there are any.
#[test]
fn drives_of_the_regressor_are_described() {
    for (name, columns) in [("planar_2r", None), ("trttr1", Some("of `"))] {
        let robot = robot_testing::robot(name);
        let graph = Graph::new();
        let derivation = Derivation::new(&robot, &graph, &MechanismOptions::ROUNDED, None);
        let doc = derivation.functions(FunctionKind::Regressor).remove(0).doc;
        let drives: Vec<&String> =
            doc.iter().filter(|paragraph| paragraph.starts_with("Columns of the drives")).collect();
        assert_eq!(drives.len(), usize::from(columns.is_some()), "{name}: {doc:?}");
        assert!(
            drives.iter().all(|text| columns.is_some_and(|word| text.contains(word))),
            "{name}"
        );
    }
}
