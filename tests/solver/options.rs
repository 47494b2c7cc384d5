//! Tests every option of the economical recursion, switched on and off both alone and together with all others, against
//! the numeric solver. An option counts as in effect if it changes the expressions; the tests fail if an option never
//! does.

use std::collections::BTreeMap;

use robot_dynamics::economical::{
    Plan, Recursion, Solver,
    plan::{Entry, FreeAcceleration, LinkPlan, Origin, Place, Turn},
};
use robot_dynamics::matrix::Pivots;
use robot_dynamics::mechanism::{Mechanism, MechanismOptions};
use robot_model::robot::{Move, Robot};
use robot_numeric::random::{Random, Recipe, State};
use robot_numeric::robots;
use robot_symbolic::{Expr, Graph};

use robot_testing::{evaluate, largest_difference, magnitude, robot_files};

const STATES: usize = 8;
const TOLERANCE: f64 = 1e-12;

/// The number of times that each option was in effect.
type Effects = BTreeMap<String, usize>;

/// The quantity that shows the effect of an option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shown {
    /// The torques.
    Torques,
    /// The mass matrix.
    MassMatrix,
    /// The accelerations of each solver that applies, compared by the torques that they require.
    Accelerations,
}

/// An option, switched off and on; both plans are equal in everything else.
struct Forced {
    option: String,
    shown: Shown,
    off: Plan,
    on: Plan,
}

/// The name of an option, and a function that changes it in a link's plan.
type Switch = (String, fn(&mut LinkPlan, bool));

/// The options that can be on or off.
fn switches() -> Vec<Switch> {
    let named = |name: &str, switch: fn(&mut LinkPlan, bool)| (name.to_owned(), switch);
    vec![
        named("angle sum", |plan, on| plan.angle_sum = on),
        named("column", |plan, on| plan.column = on),
        // Without the column, doubling has no effect.
        named("doubled", |plan, on| (plan.column, plan.doubled) = (true, on)),
        named("moment x", |plan, on| plan.moment[0] = on),
        named("moment y", |plan, on| plan.moment[1] = on),
        named("moment z", |plan, on| plan.moment[2] = on),
        named("diagonal", |plan, on| plan.diagonal = on),
    ]
}

/// A plan with all options at once.
fn all() -> LinkPlan {
    LinkPlan {
        origin: Origin::PreviousNormal,
        turn: Turn::File,
        angle_sum: true,
        column: true,
        doubled: true,
        moment: [true; 3],
        diagonal: true,
        residual: [Some(Entry::X), Some(Entry::Xz), Some(Entry::XxYy)],
        free: FreeAcceleration::Still,
        composite_sum: true,
        projected_at: None,
    }
}

/// Every option off and on; the others are as in `base`.
fn forced(robot: &Robot, base: &LinkPlan) -> Vec<Forced> {
    let links = robot.links.len();
    let mut found = vec![];
    let mut add =
        |option: String, shown, off: &dyn Fn(&mut LinkPlan), on: &dyn Fn(&mut LinkPlan)| {
            let plan = |change: &dyn Fn(&mut LinkPlan)| {
                let mut link = base.clone();
                change(&mut link);
                Plan::uniform(links, &link)
            };
            found.push(Forced { option, shown, off: plan(off), on: plan(on) });
        };
    for (name, switch) in switches() {
        add(name, Shown::Torques, &|plan| switch(plan, false), &|plan| switch(plan, true));
    }
    for origin in [
        Origin::NextNormal,
        Origin::PreviousNormal,
        Origin::ZeroXz,
        Origin::ZeroYz,
        Origin::CenterOfMass,
        Origin::Parent,
    ] {
        let off = |plan: &mut LinkPlan| plan.origin = Origin::File;
        add(format!("origin {origin:?}"), Shown::Torques, &off, &|plan| plan.origin = origin);
    }
    for turn in [Turn::NextNormal, Turn::FirstMoment] {
        let off = |plan: &mut LinkPlan| plan.turn = Turn::File;
        add(format!("turn {turn:?}"), Shown::Torques, &off, &|plan| plan.turn = turn);
    }
    for (kind, entry) in (0..3).flat_map(|kind| Entry::ALL.map(|entry| (kind, entry))) {
        // A second moment has no first moment that could make that of the parent vanish.
        if kind == 2 && [Entry::X, Entry::Y].contains(&entry) {
            continue;
        }
        let name = format!("{} residual {entry:?}", ["mass", "first", "second"][kind]);
        let off = |plan: &mut LinkPlan| plan.residual[kind] = None;
        add(name, Shown::Torques, &off, &|plan| plan.residual[kind] = Some(entry));
    }
    for free in FreeAcceleration::ALL.into_iter().skip(1) {
        let off = |plan: &mut LinkPlan| plan.free = FreeAcceleration::Zero;
        add(format!("free {free:?}"), Shown::Accelerations, &off, &|plan| plan.free = free);
    }
    let off = |plan: &mut LinkPlan| plan.composite_sum = false;
    let on = |plan: &mut LinkPlan| plan.composite_sum = true;
    add("composite sum".to_owned(), Shown::MassMatrix, &off, &on);
    add("composite sum, accelerations".to_owned(), Shown::Accelerations, &off, &on);
    let base = Plan::uniform(links, base);
    for (link, turned) in (0..links).flat_map(|link| [(link, false), (link, true)]) {
        let mut on = base.clone();
        for plan in &mut on.links[link..] {
            plan.projected_at = Some(Place { link, turned });
        }
        let option = format!("meeting, {}", if turned { "turned" } else { "at home" });
        found.push(Forced { option, shown: Shown::MassMatrix, off: base.clone(), on });
    }
    found.extend(units_of_length(&base, links));
    found
}

/// Each length that can be the unit of length, compared with none.
fn units_of_length(base: &Plan, links: usize) -> Vec<Forced> {
    let mut found = vec![];
    for unit in (0..links).map(|link| (link, link % 3)) {
        let on = Plan { unit_length: Some(unit), ..base.clone() };
        for (what, shown) in [("", Shown::Torques), (", accelerations", Shown::Accelerations)] {
            let (option, off) = (format!("unit of length{what}"), base.clone());
            found.push(Forced { option, shown, off, on: on.clone() });
        }
    }
    found
}

/// The results of the numeric solver, and the recursion that is compared with them.
struct Bench<'m, 'g> {
    robot: &'m Robot,
    solver: robot_numeric::Mechanism,
    states: Vec<State>,
    mechanism: &'m Mechanism<'g>,
    tau: Vec<Expr<'g>>,
}

impl<'g> Bench<'_, 'g> {
    fn roots(&self, shown: Shown, plan: &Plan) -> Vec<Expr<'g>> {
        let recursion = Recursion::new(self.mechanism, plan).unwrap();
        match shown {
            Shown::Torques => recursion.inverse_dynamics(false),
            Shown::MassMatrix => recursion.mass_matrix().rows(),
            Shown::Accelerations => {
                let by =
                    |solver| recursion.forward_dynamics(&self.tau, false, solver, Pivots::Checked);
                let ways =
                    [Solver::MassMatrix, Solver::ArticulatedBodies, Solver::SmallPivots].map(by);
                ways.into_iter().flatten().flatten().collect()
            }
        }
    }

    /// The largest error over the states, relative to the largest value.
    fn error(&self, shown: Shown, roots: &[Expr<'g>]) -> f64 {
        let (mut worst, mut size) = (0.0_f64, 0.0_f64);
        for state in &self.states {
            let State { q, qd, qdd, tau, .. } = state;
            let found = evaluate(self.robot, roots, state);
            let (found, expected) = match shown {
                Shown::Torques => (found, self.torques(q, qd, qdd)),
                Shown::MassMatrix => {
                    let matrix = self.solver.mass_matrix(q).unwrap();
                    (found, matrix.as_slice().to_vec())
                }
                Shown::Accelerations => {
                    let ways = found.chunks(tau.len());
                    let torques = ways.clone().flat_map(|way| self.torques(q, qd, way)).collect();
                    (torques, ways.flat_map(|_| tau.clone()).collect())
                }
            };
            worst = worst.max(largest_difference(&found, &expected));
            size = size.max(magnitude(&expected));
        }
        worst / size
    }

    fn torques(&self, q: &[f64], qd: &[f64], qdd: &[f64]) -> Vec<f64> {
        self.solver.inverse_dynamics(q, qd, qdd).unwrap().as_slice().to_vec()
    }
}

/// The largest error over all options, both on and off.
fn check(robot: &Robot, seed: u64, name: &str, effects: &mut Effects) -> f64 {
    let mut random = Random::new(seed);
    let solver = robot_numeric::Mechanism::nominal(robot).unwrap();
    let states = (0..STATES).map(|_| random.state(&solver)).collect();
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, &MechanismOptions::ROUNDED);
    let tau = (1..=solver.coordinates()).map(|k| graph.symbol(&format!("tau{k}"))).collect();
    let bench = Bench { robot, solver, states, mechanism: &mechanism, tau };
    let mut seen: Vec<(Shown, Vec<Expr<'_>>)> = vec![];
    let mut worst = 0.0_f64;
    for base in [LinkPlan::BASIC, all()] {
        for Forced { option, shown, off, on } in forced(robot, &base) {
            let [off, on] = [off, on].map(|plan| bench.roots(shown, &plan));
            *effects.entry(option.clone()).or_default() += usize::from(off != on);
            for (word, roots) in [("off", off), ("on", on)] {
                // Equal expressions are the same node of the graph, so they are checked only once.
                if seen.contains(&(shown, roots.clone())) {
                    continue;
                }
                let error = bench.error(shown, &roots);
                assert!(
                    error <= TOLERANCE,
                    "{name}, seed {seed}: {shown:?} with `{option}` {word} are off by {error:e}"
                );
                worst = worst.max(error);
                seen.push((shown, roots));
            }
        }
    }
    worst
}

/// Checks many robots; only the options in `lacking` may never be in effect.
fn check_all(what: &str, robots: impl IntoIterator<Item = (String, u64, Robot)>, lacking: &[&str]) {
    let (mut effects, mut worst) = (Effects::new(), 0.0_f64);
    for (name, seed, robot) in robots {
        worst = worst.max(check(&robot, seed, &name, &mut effects));
    }
    println!("{what}: worst error {worst:.1e}; how often options were in effect: {effects:?}");
    let never = effects.iter().filter(|(_, count)| **count == 0).map(|(option, _)| option.as_str());
    assert_eq!(never.collect::<Vec<_>>(), lacking, "{what}: options that were never in effect");
}

#[test]
fn options_on_robot_files() {
    let robot = |(name, text): (String, String)| {
        let robot = robot_testing::read(&name, &text);
        (name, 11, robot)
    };
    let robots = robot_files().into_iter().map(robot);
    // With right angles, these entries cannot be made to vanish.
    let lacking = [
        "first residual Xx",
        "mass residual Yz",
        "second residual Xy",
        "second residual Xz",
        "second residual Yz",
    ];
    check_all("robot files", robots, &lacking);
}

#[test]
fn options_on_random_chains() {
    let robots = (0..64).map(|seed| {
        let recipe = Recipe::serial(1 + seed as usize % 8);
        ("chain".to_owned(), seed, robots::robot(&mut Random::new(seed), &recipe))
    });
    // Random axes are not parallel.
    check_all("chains", robots, &["angle sum"]);
}

/// Random axes are rarely parallel; here the axis of every second joint is parallel to its parent's.
fn with_parallel_axes(mut robot: Robot) -> Robot {
    for index in (1..robot.links.len()).step_by(2) {
        let Some(parent) = robot.links[index].parent else { continue };
        let axis = robot.links[parent].joint.axis.clone();
        let link = &mut robot.links[index];
        link.placement.0.retain(|step| matches!(step, Move::Translate(_)));
        link.joint.axis = axis;
    }
    robot
}

#[test]
fn options_on_random_chains_with_parallel_axes() {
    let robots = (5000..5032).map(|seed| {
        let recipe = Recipe::serial(2 + seed as usize % 6);
        let robot = robots::robot(&mut Random::new(seed), &recipe);
        ("parallel axes".to_owned(), seed, with_parallel_axes(robot))
    });
    check_all("chains with parallel axes", robots, &[]);
}

#[test]
fn options_on_random_trees() {
    let robots = (1000..1040).map(|seed| {
        let joints = 2 + seed as usize % 9;
        let recipe = Recipe { drives: true, mimic: true, fixed: true, ..Recipe::tree(joints) };
        ("tree".to_owned(), seed, robots::robot(&mut Random::new(seed), &recipe))
    });
    check_all("trees", robots, &[]);
}

/// An arm with three links of 2 kg. The center of mass of the second one is `center` away from its axis, and the third
/// one is `lever` away along it.
fn arm(center: f64, lever: f64, axis: &str) -> Robot {
    let link = |name: &str, position: [f64; 3], axis: &str, center: [f64; 3]| {
        format!(
            "[[link]]\nname = \"{name}\"\nparent = \"{}\"\norigin = {{ xyz = {position:?} }}\n\
             joint = {{ type = \"revolute\", axis = \"{axis}\" }}\nmass = 2\n\
             center_of_mass = {center:?}\n\
             inertia = {{ xx = 0.3, yy = 0.3, zz = 0.3, xz = 0.1 }}\n",
            name.parse::<u8>().unwrap() - 1
        )
    };
    let text = [
        "format = 1\n[robot]\nname = \"arm\"\n".to_owned(),
        link("1", [0.0, 0.0, 0.4], "y", [0.1, 0.1, 0.2]).replace("parent = \"0\"\n", ""),
        link("2", [0.3, 0.0, 0.2], "z", [center, 0.0, 0.0]),
        link("3", [lever, 0.0, 0.3], axis, [0.0, 0.1, 0.2]),
    ];
    robot_testing::read("arm", &text.concat())
}

/// Whether an option of one link changes the expressions; the torques must be right in any case.
fn in_effect(robot: &Robot, link: usize, off: &LinkPlan, on: &LinkPlan) -> bool {
    let solver = robot_numeric::Mechanism::nominal(robot).unwrap();
    let states = (0..STATES).map(|seed| Random::new(seed as u64).state(&solver)).collect();
    let graph = Graph::new();
    let mechanism = Mechanism::new(robot, &graph, &MechanismOptions::ROUNDED);
    let bench = Bench { robot, solver, states, mechanism: &mechanism, tau: vec![] };
    let mut plan = Plan::uniform(robot.links.len(), off);
    let off = bench.roots(Shown::Torques, &plan);
    plan.links[link] = on.clone();
    let on = bench.roots(Shown::Torques, &plan);
    let error = bench.error(Shown::Torques, &on);
    assert!(error <= 1e-14, "off by {error:e}");
    off != on
}

/// If 2 + 2 c / l kilograms remain with link 3, the first moment of link 2 vanishes.
#[test]
fn residuals_weigh_no_more_than_three_robots() {
    let residual = [Some(Entry::X), None, None];
    let on = LinkPlan { residual, ..LinkPlan::BASIC };
    // The first two levers require 4.5 kg and 16.3 kg; the others 27 kg and 502 kg, while the limit of three times the
    // robot's mass is 18 kg.
    for (lever, taken) in [(0.4, true), (0.07, true), (0.04, false), (0.002, false)] {
        assert_eq!(in_effect(&arm(0.5, lever, "z"), 2, &LinkPlan::BASIC, &on), taken, "{lever}");
    }
}

/// Σxz of link 2 vanishes at a distance of 0.1 / 2 c along its axis from its origin.
#[test]
fn origins_lie_no_farther_than_three_reaches() {
    let off = LinkPlan { origin: Origin::File, turn: Turn::File, ..LinkPlan::BASIC };
    let on = LinkPlan { origin: Origin::ZeroXz, ..off.clone() };
    // The first two require shifts by 0.1 m and 2.5 m; the others by 5 m and 25 m, while the limit of three times the
    // reach is 3.6 m.
    for (center, taken) in [(0.5, true), (0.02, true), (0.01, false), (0.002, false)] {
        assert_eq!(in_effect(&arm(center, 0.0, "x"), 1, &off, &on), taken, "{center}");
    }
}
