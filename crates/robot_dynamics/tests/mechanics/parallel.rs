//! Groups of parallel joints: which joints belong to them, in which direction, and in which order.

use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_symbolic::{Graph, print};

/// The groups of a robot with the given joints, written as `q1`, `-q2 after q1`. A joint is given as
/// `kind axis parent more`.
fn groups(joints: &[(&str, &str, &str, &str)]) -> Vec<Vec<String>> {
    let mut text = "format = 1\n[robot]\nname = \"arm\"\n".to_owned();
    for (place, (kind, axis, parent, more)) in joints.iter().enumerate() {
        text += &format!(
            "[[link]]\nname = \"l{}\"\n{parent}\njoint = {{ type = \"{kind}\", axis = {axis}{more} }}\n\
             origin = {{ xyz = [0.3, 0.1, 0.2] }}\nmass = 1\ncenter_of_mass = [0.1, 0, 0]\n\
             inertia = {{ xx = 0.1, yy = 0.1, zz = 0.1 }}\n",
            place + 1
        );
    }
    let robot = robot_model::description::read_toml("arm.toml", &text).unwrap().robot;
    let graph = Graph::new();
    let mechanism = Mechanism::new(&robot, &graph, &MechanismOptions::EXACT);
    let groups = mechanism.parallel_angles();
    let shown = |group: &robot_symbolic::collected::ParallelAngles<'_>| {
        let name = |place: usize| print::to_text(group.turns[place].coordinate).unwrap();
        let turn = |place: usize| {
            let turn = &group.turns[place];
            let sign = if turn.negative { "-" } else { "" };
            let after = turn.parent.map(|parent| format!(" after {}", name(parent)));
            format!("{sign}{}{}", name(place), after.unwrap_or_default())
        };
        (0..group.turns.len()).map(turn).collect()
    };
    groups.iter().map(shown).collect()
}

#[test]
fn joints_with_parallel_axes_are_a_group() {
    let revolute = |axis: &'static str| ("revolute", axis, "", "");
    let chain = [revolute("\"z\""), revolute("\"z\""), revolute("\"z\"")];
    assert_eq!(groups(&chain), [["q1", "q2 after q1", "q3 after q2"]]);
    // An axis in the opposite direction, in its own frame or because of a joint in between.
    let back = [revolute("\"z\""), revolute("[0, 0, -1]"), revolute("\"z\"")];
    assert_eq!(groups(&back), [["q1", "-q2 after q1", "q3 after q2"]]);
    // A prismatic joint does not turn; a joint with another axis ends the group.
    let sliding = [revolute("\"y\""), ("prismatic", "\"x\"", "", ""), revolute("\"y\"")];
    assert_eq!(groups(&sliding), [["q1", "q3 after q1"]]);
    let two = [revolute("\"y\""), revolute("\"y\""), revolute("\"x\""), revolute("\"x\"")];
    assert_eq!(groups(&two), [["q1", "q2 after q1"], ["q3", "q4 after q3"]]);
    assert!(groups(&[revolute("\"x\""), revolute("\"y\""), revolute("\"x\"")]).is_empty());
    assert!(groups(&[revolute("\"x\"")]).is_empty());
}

#[test]
fn branches_and_followers_of_a_group() {
    let revolute = |parent: &'static str| ("revolute", "\"z\"", parent, "");
    // Two joints follow the first one.
    let tree = [revolute(""), revolute("parent = \"l1\""), revolute("parent = \"l1\"")];
    assert_eq!(groups(&tree), [["q1", "q2 after q1", "q3 after q1"]]);
    // A mimic joint with a ratio other than 1 and −1 belongs to no group; one with the ratio −1 turns back, in a
    // separate group.
    let following = |ratio: &str| {
        let more = format!(", mimic = {{ joint = \"l1\", ratio = {ratio} }}");
        let more: &'static str = Box::leak(more.into_boxed_str());
        groups(&[revolute(""), ("revolute", "\"z\"", "", more), revolute("")])
    };
    assert_eq!(following("2"), Vec::<Vec<String>>::new());
    assert_eq!(following("-1"), [["-q1", "q2 after q1"]]);
}
