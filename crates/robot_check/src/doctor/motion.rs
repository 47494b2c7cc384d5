//! Checks for gravity that points up, joints that move no mass or the same mass as others, and bodies without extent.

use robot_dynamics::functions::undetermined;
use robot_model::diagnostic::significant;
use robot_model::diagnostic::{Diagnostic, Span, code};
use robot_model::robot::JointKind;
use robot_numeric::Mechanism;
use robot_numeric::random::Random;

use super::facts::{LinkFacts, RobotFacts};

/// The fraction of the largest inertia below which a coordinate counts as having no inertia. Rounding errors are a
/// thousand times smaller, and the inertia of the smallest joint of an arm is about a millionth.
const NOTHING: f64 = 1e-12;
/// The number of configurations that are tried. In a single one, a joint may move no mass by chance.
const CONFIGURATIONS: usize = 3;
const SEED: u64 = 1;

pub(super) fn check(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    gravity(facts, found);
    points(facts, found);
    let before = found.len();
    idle(facts, found);
    if found.len() == before {
        together(facts, found);
    }
}

fn gravity(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    let gravity = &facts.gravity;
    let Some(place) =
        facts.locations.gravity.as_ref().filter(|_| {
            gravity.z > 0.0 && gravity.z > gravity.x.abs() && gravity.z > gravity.y.abs()
        })
    else {
        return;
    };
    let message = format!("gravity points up: {} m/s^2 along z", significant(gravity.z));
    found.push(
        Diagnostic::warning(code::GRAVITY_UP, message)
            .at(place, "the acceleration of gravity, or its opposite?")
            .because("with the wrong sign, every torque that should hold up a link pushes it down")
            .help(
                "write the vector that points down, [0, 0, -9.81] for a base on the floor; if \
                 the base's z axis points down, as on a ceiling, the value is correct",
            ),
    );
}

/// Reports bodies that rotate and have mass but no moments of inertia.
fn points(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    for (index, link) in facts.links.iter().enumerate() {
        let is_point = |link: &LinkFacts<'_>| {
            link.bodies.iter().all(|body| body.mass > 0.0 && body.tensor.norm() == 0.0)
        };
        let Some(body) = link.bodies.first().filter(|_| is_point(link)) else { continue };
        if !rotates(facts, index) {
            continue;
        }
        let message = format!("`{}` has mass but no moments of inertia", body.body.name);
        found.push(
            Diagnostic::warning(code::POINT_MASS, message)
                .at(body.of_tensor(), "a point mass?")
                .and_at(body.of_mass(), format!("{} kg", significant(body.mass)))
                .because("zeros are often placeholders for missing values")
                .help("give the moments of inertia about the center of mass"),
        );
    }
}

/// Whether the link or a link that carries it has a revolute joint.
fn rotates(facts: &RobotFacts<'_>, index: usize) -> bool {
    let mut next = Some(index);
    while let Some(link) = next.and_then(|index| facts.robot.links.get(index)) {
        match link.joint.kind {
            JointKind::Revolute => return true,
            JointKind::Prismatic => {}
        }
        next = link.parent;
    }
    false
}

/// Reports coordinates whose inertia is 0, or next to 0 beside the largest, in every configuration.
fn idle(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    let Ok(mechanism) = Mechanism::nominal(facts.robot) else {
        return;
    };
    let mut random = Random::new(SEED);
    let mut largest = vec![0.0_f64; mechanism.coordinates()];
    for _ in 0..CONFIGURATIONS {
        let Ok(matrix) = mechanism.mass_matrix(&random.state(&mechanism).q) else {
            return;
        };
        for (largest, own) in largest.iter_mut().zip(matrix.diagonal().iter()) {
            *largest = largest.max(own.abs());
        }
    }
    let most = largest.iter().copied().fold(0.0, f64::max);
    for (index, (coordinate, own)) in facts.robot.coordinates.iter().zip(&largest).enumerate() {
        if *own > NOTHING * most {
            continue;
        }
        let place = place(facts, index);
        let [how_much, label, why] = match *own == 0.0 {
            true => [
                "no mass",
                "no inertia about or along its axis",
                "the mass matrix is singular, so forward dynamics has no solution",
            ],
            false => [
                "almost no mass",
                "its inertia is below 10⁻¹² of the largest",
                "the mass matrix is nearly singular, so accelerations can lose significant digits",
            ],
        };
        let message = format!("the joint `{}` moves {how_much}", coordinate.joint);
        found.push(
            Diagnostic::warning(code::MOVES_NOTHING, message).at(&place, label).because(why).help(
                "give mass or inertia to the links that it moves, or `armature` to its drive",
            ),
        );
    }
}

/// Reports coordinates that move mass, but of which several move the same mass in the same way.
fn together(facts: &RobotFacts<'_>, found: &mut Vec<Diagnostic>) {
    let coordinates = undetermined(facts.robot);
    let Some(first) = coordinates.first() else { return };
    let of_robot = coordinates.iter().filter_map(|index| facts.robot.coordinates.get(*index));
    let names: Vec<String> = of_robot.map(|one| format!("`{}`", one.joint)).collect();
    let message =
        format!("joint torques do not determine the accelerations of {}", names.join(", "));
    found.push(
        Diagnostic::warning(code::MOVES_NOTHING, message)
            .at(&place(facts, *first), "the first of these joints")
            .because(
                "the mass matrix is singular in every configuration, so forward dynamics has no \
                 solution",
            )
            .help(
                "give mass or inertia to each link that these joints move, or `armature` to their \
                 drives",
            ),
    );
}

fn place(facts: &RobotFacts<'_>, coordinate: usize) -> Span {
    let links = facts.links.iter();
    let mut moved = links.filter(|link| link.link.joint.coordinate == coordinate);
    moved.next().map(|link| link.place.joint.clone()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use robot_model::diagnostic::code;

    use crate::doctor::{Options, check};

    #[test]
    fn joints_that_move_the_same_mass_are_reported_once() {
        let sliders = |axis: &str| {
            format!(
                "format = 1\n[robot]\nname = \"two\"\n[[link]]\nname = \"1\"\n\
                 joint = {{ type = \"prismatic\", axis = \"x\" }}\nmassless = true\n[[link]]\nname = \"2\"\n\
                 joint = {{ type = \"prismatic\", axis = \"{axis}\" }}\nmass = 1\ncenter_of_mass = [0, 0, 0]\n\
                 inertia = {{ xx = 0.01, yy = 0.01, zz = 0.01 }}\n"
            )
        };
        let found = check("two.toml", &sliders("x"), &Options::default()).found;
        assert_eq!(found.iter().map(|one| one.code).collect::<Vec<_>>(), [code::MOVES_NOTHING]);
        assert!(
            found.to_string().contains("do not determine the accelerations of `1`, `2`"),
            "{found}"
        );
        assert!(check("two.toml", &sliders("y"), &Options::default()).found.is_empty());
    }
}
