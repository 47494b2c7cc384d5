use robot_symbolic::Number;
use robot_testing::robot;

use super::*;

const SCOPE: Scope = Scope { motions: true, composites: false, free: false };

fn cost(robot: &Robot, plan: &Plan) -> usize {
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, &MechanismOptions::ROUNDED);
    let torques = Recursion::new(&mechanism, plan).unwrap().inverse_dynamics(false);
    let parameters: BTreeSet<SymbolId> = robot
        .parameters
        .iter()
        .filter_map(|parameter| graph.find_symbol(&parameter.name).and_then(Expr::as_symbol))
        .collect();
    Counter::default().count(&torques, |symbol| parameters.contains(&symbol)).flops()
}

/// Marsaglia's xorshift generator with the shifts 13, 7 and 17: its first six states, beginning with 1.
#[test]
fn the_steps_are_those_of_xorshift() {
    let states: [u64; 6] = [
        1_082_269_761,
        1_152_992_998_833_853_505,
        11_177_516_664_432_764_457,
        17_678_023_832_001_937_445,
        9_659_130_143_999_365_733,
        17_775_799_001_133_815_809,
    ];
    for bound in [1, 3, 10, 1_000_003] {
        let mut steps = Steps(1);
        let found = states.map(|_| steps.below(bound));
        assert_eq!(found, states.map(|state| (state >> 33) as usize % bound), "{bound}");
    }
    assert_eq!(Steps(1).below(0), 0);
}

/// The values at which plans are compared differ between symbols and between states.
#[test]
fn states_differ_in_every_symbol() {
    let states: Vec<Vec<f64>> = (0..4).map(|state| test_state(state, 60)).collect();
    let mut all = states.concat();
    assert!(all.iter().all(|value| (0.4..1.4).contains(value)));
    all.sort_by(f64::total_cmp);
    assert!(all.windows(2).all(|pair| pair[1] - pair[0] > 1e-6));
}

/// The plan that is found has the stated cost, which is no higher than that of any starting plan and lower than that of
/// at least one.
#[test]
fn no_start_is_cheaper_than_what_is_found() {
    for name in ["scara", "stanford", "planar_3r"] {
        let robot = robot(name);
        let found = search(&robot, &MechanismOptions::ROUNDED, Measure::Operations).unwrap();
        assert_eq!(cost(&robot, &found.plan), found.operations, "{name}");
        let costs = starts().map(|start| cost(&robot, &Plan::uniform(robot.links.len(), &start)));
        assert!(costs.iter().all(|start| found.operations <= *start), "{name}: {costs:?}");
        assert!(costs.iter().any(|start| found.operations < *start), "{name}: {costs:?}");
        assert!(found.instructions < found.operations && found.tried > 10 && !found.tuned);
    }
}

/// A plan with wrong values is not accepted, however low its cost: neither as a starting plan nor as a change, and
/// whether the values deviate or are NaN.
#[test]
fn a_cheap_plan_with_wrong_values_is_not_taken() {
    let robot = robot("scara");
    let is_wrong: [fn(&LinkPlan) -> bool; 3] = [
        |link| link.column,
        |link| link.residual != [None; 3],
        |link| link.origin == Origin::CenterOfMass,
    ];
    for (place, is_wrong) in is_wrong.into_iter().enumerate() {
        for spoil in [1.0 + 1e-9, f64::NAN] {
            let found =
                search_for(&robot, &MechanismOptions::ROUNDED, SCOPE, &|mechanism, recursion| {
                    let torques = recursion.inverse_dynamics(false);
                    if !recursion.plan().links.iter().any(is_wrong) {
                        return Objective::new(torques);
                    }
                    let factor = mechanism.graph.number(Number::real(spoil));
                    let checked = torques.iter().map(|torque| *torque * factor).collect();
                    Objective { counted: vec![], checked }
                });
            let found = found.unwrap();
            assert!(!found.plan.links.iter().any(is_wrong), "{place}: {:?}", found.plan);
            assert_eq!(found.operations, cost(&robot, &found.plan), "{place}");
        }
    }
}

/// Trees and long chains are searched limb by limb, other chains as a whole.
#[test]
fn limbs_are_searched_if_there_are_several_or_a_long_one() {
    use robot_numeric::random::{Random, Recipe};
    let applies = |joints: usize, change: &dyn Fn(&mut Robot)| {
        let mut robot = robot_numeric::robots::robot(&mut Random::new(3), &Recipe::serial(joints));
        change(&mut robot);
        let graph = Graph::new();
        limbs::applies(&Mechanism::new(&robot, &graph, &MechanismOptions::ROUNDED))
    };
    for (joints, expected) in [(1, false), (3, false), (10, false), (11, true)] {
        assert_eq!(applies(joints, &|_| {}), expected, "{joints}");
    }
    assert!(applies(3, &|robot| robot.links[2].parent = Some(0)));
    assert!(applies(3, &|robot| robot.links[2].parent = None));
}
