//! The coefficients of velocity products that are zero because the mass matrix does not depend on a joint position.

use robot_model::robot::Robot;

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

#[cfg(test)]
mod tests {
    use super::*;

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
}
