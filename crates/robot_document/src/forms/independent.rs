//! The coefficients of velocity products that are zero because the mass matrix does not depend on a joint position.

use robot_model::robot::Robot;
use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, walk};

use super::Writer;
use super::coefficients::motions;
use super::naming::named_length;

/// The joints of a robot, of which the mass matrix has an entry for each pair.
///
/// The entry of two joints is zero unless one is before the other in the tree or they are the same. It then depends only
/// on the positions of the joints from behind the first to the second, and of those behind the second: a common motion of
/// both changes nothing, and the inertia of a body about an axis does not change when the body turns about it.
pub(super) struct Joints<'r> {
    robot: &'r Robot,
    /// For each link, whether each link is the link itself or before it.
    before: Vec<Vec<bool>>,
}

impl<'r> Joints<'r> {
    pub(super) fn new(robot: &'r Robot) -> Joints<'r> {
        let mut before: Vec<Vec<bool>> = vec![];
        for (index, link) in robot.links.iter().enumerate() {
            let parent = link.parent.and_then(|parent| before.get(parent)).cloned();
            let mut own = parent.unwrap_or_else(|| vec![false; robot.links.len()]);
            if let Some(own) = own.get_mut(index) {
                *own = true;
            }
            before.push(own);
        }
        Joints { robot, before }
    }

    /// Whether the coefficient of q̇ⱼ q̇ₖ in the joint torque i is zero for this reason. It is
    /// ∂Mᵢⱼ/∂qₖ + ∂Mᵢₖ/∂qⱼ − ∂Mⱼₖ/∂qᵢ, of which two terms cancel if i is j or k.
    pub(super) fn is_zero(&self, i: usize, j: usize, k: usize) -> bool {
        match () {
            () if i == j => !self.depends(i, i, k),
            () if i == k => !self.depends(i, i, j),
            () => !self.depends(i, j, k) && !self.depends(i, k, j) && !self.depends(j, k, i),
        }
    }

    /// Whether the entry (i, j) of the mass matrix can depend on coordinate k.
    fn depends(&self, i: usize, j: usize, k: usize) -> bool {
        self.of(i).any(|one| {
            self.of(j).any(|other| {
                let pair = [(one, other), (other, one)];
                let pair = pair.into_iter().find(|(first, last)| self.is_before(*first, *last));
                pair.is_some_and(|(first, last)| {
                    self.of(k).any(|joint| {
                        let is_behind = joint != first && self.is_before(first, joint);
                        let is_between = self.is_before(joint, last) && first != last;
                        let is_after = joint != last && self.is_before(last, joint);
                        is_behind && (is_between || is_after)
                    })
                })
            })
        })
    }

    /// The joints that a coordinate moves.
    fn of(&self, coordinate: usize) -> impl Iterator<Item = usize> {
        let links = self.robot.links.iter().enumerate();
        links.filter(move |(_, link)| link.joint.coordinate == coordinate).map(|(index, _)| index)
    }

    /// Whether a joint is another one or before it.
    fn is_before(&self, one: usize, other: usize) -> bool {
        self.before.get(other).and_then(|before| before.get(one)).copied().unwrap_or_default()
    }
}

/// The joint torques without the joint velocities that do not act on them, for the same reason: in the recursion, their
/// terms are in several parts, which cancel. A torque keeps them if it would share fewer parts with others, so that the
/// equations would be longer.
pub(super) fn without_velocities<'g>(
    writer: &Writer<'_, 'g>,
    mut torques: Vec<Expr<'g>>,
) -> Vec<Expr<'g>> {
    let joints = Joints::new(writer.robot);
    let rates = motions(writer, JointVariable::Velocity);
    let all = 0..rates.len();
    let mut least = named_length(&torques, writer.options.digits);
    for (index, torque) in torques.clone().into_iter().enumerate() {
        // Friction is a function of the joint's own velocity.
        let others = all.clone().filter(|j| !(writer.options.friction && *j == index));
        let idle = others.filter(|j| all.clone().all(|k| joints.is_zero(index, *j, k)));
        let idle: Vec<Expr<'g>> = idle.filter_map(|j| rates.get(j).copied()).collect();
        let replace = |part: Expr<'g>| idle.contains(&part).then(|| writer.graph.zero());
        let mut attempt = torques.clone();
        if let Some(attempt) = attempt.get_mut(index) {
            *attempt =
                walk::rebuild_above(&[torque], writer.graph, replace).pop().unwrap_or(torque);
        }
        let length = named_length(&attempt, writer.options.digits);
        if attempt != torques && length <= least {
            (torques, least) = (attempt, length);
        }
    }
    torques
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{EquationOptions, Form, equations};

    fn zeros(joints: &str) -> Vec<[usize; 3]> {
        let text = format!("format = 1\n[robot]\nname = \"arm\"\n{joints}");
        let robot = robot_model::description::read_toml("arm", &text).unwrap().robot;
        let joints = Joints::new(&robot);
        let all = 0..robot.degrees_of_freedom();
        let mut zeros = vec![];
        for i in all.clone() {
            for j in all.clone() {
                zeros.extend(
                    all.clone().skip(j).filter(|k| joints.is_zero(i, j, *k)).map(|k| [i, j, k]),
                );
            }
        }
        zeros
    }

    fn link(name: &str, parent: &str, more: &str) -> String {
        format!(
            "[[link]]\nname = \"{name}\"\n{parent}joint = {{ type = \"revolute\", {more} }}\nmass = 1\n\
             center_of_mass = [0, 0, 0]\ninertia = {{ xx = 1, yy = 1, zz = 1 }}\n"
        )
    }

    #[test]
    fn a_chain_has_no_terms_of_its_own_and_of_outer_velocities() {
        let chain = ["a", "b", "c"].map(|name| link(name, "", "axis = \"z\"")).concat();
        let expected = [[0, 0, 0], [1, 0, 1], [1, 1, 1], [2, 0, 2], [2, 1, 2], [2, 2, 2]];
        assert_eq!(zeros(&chain), expected);
    }

    #[test]
    fn branches_do_not_act_on_each_other() {
        let tree =
            link("a", "", "axis = \"z\"") + &link("b", "parent = \"base\"\n", "axis = \"z\"");
        assert_eq!(zeros(&tree).len(), 6);
    }

    #[test]
    fn a_joint_that_mimics_another_moves_with_it() {
        let mimic = "axis = \"z\", mimic = { joint = \"a\", ratio = 2 }";
        let chain = link("a", "", "axis = \"z\"") + &link("b", "", mimic);
        assert!(zeros(&chain).is_empty());
    }

    /// The recursion has centrifugal terms of a single joint, which cancel.
    #[test]
    fn a_single_joint_has_no_velocity_in_its_torque() {
        let text = "format = 1\n[robot]\nname = \"one\"\n[[link]]\nname = \"1\"\n\
             joint = { type = \"revolute\", axis = [1, 1, 0] }\n\
             origin = { xyz = [0, 0, 0], rpy = [0.3, 0, 0] }\nmass = 2\n\
             center_of_mass = [0.1, -0.05, 0.2]\n\
             inertia = { xx = 0.3, yy = 0.35, zz = 0.4, xy = 0.01, yz = -0.02 }\n\
             friction = { viscous = 2 }\n";
        let robot = robot_model::description::read_toml("one", text).unwrap().robot;
        for (friction, count) in [(false, 0), (true, 1)] {
            let options =
                EquationOptions { form: Form::Compact, friction, ..EquationOptions::default() };
            let printed = equations(&robot, &options).unwrap();
            let texts: String = printed.quantities().map(|one| one.text.as_str()).collect();
            let all: Vec<&str> = printed.definitions().map(|one| one.text.as_str()).collect();
            let found = [texts, all.concat()].concat();
            assert_eq!(found.matches("qd1").count(), count, "{found}");
        }
    }
}
