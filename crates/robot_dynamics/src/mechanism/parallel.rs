//! Groups of revolute joints with parallel axes, whose angles add up.

use robot_model::robot::JointKind;
use robot_symbolic::collected::{ParallelAngles, Turn};
use robot_symbolic::polynomial::expands_to_zero;
use robot_symbolic::{Expr, Polynomial, PolynomialOptions};

use super::Mechanism;
use crate::vector::Vector;

/// The position of a joint in its group.
#[derive(Clone, Copy)]
struct Member {
    group: usize,
    place: usize,
    /// Whether its axis is opposite to that of the group's first joint.
    opposite: bool,
}

impl<'g> Mechanism<'g> {
    /// The groups of two or more revolute joints with parallel axes that follow each other along the mechanism, with
    /// or without prismatic joints between them.
    ///
    /// A joint whose position is neither its coordinate nor the negative of it, apart from a constant, such as a geared
    /// mimic joint, belongs to no group.
    #[must_use]
    pub fn parallel_angles(&self) -> Vec<ParallelAngles<'g>> {
        let mut groups: Vec<ParallelAngles<'g>> = vec![];
        let mut members: Vec<Option<Member>> = vec![];
        for (index, link) in self.links.iter().enumerate() {
            members.push(None);
            let Some(reversed) = self.reversed(index) else { continue };
            let coordinate = self.coordinate(link.coordinate);
            let before = self.parallel_parent(index).and_then(|(parent, opposite)| {
                let member = members.get(parent).copied().flatten()?;
                let turns = &groups.get(member.group)?.turns;
                let is_new = turns.iter().all(|turn| turn.coordinate != coordinate);
                is_new.then_some((member, opposite != member.opposite))
            });
            let (group, opposite) = match before {
                Some((member, opposite)) => (member.group, opposite),
                None => {
                    groups.push(ParallelAngles { turns: vec![] });
                    (groups.len() - 1, false)
                }
            };
            let turns = &mut groups[group].turns;
            members[index] = Some(Member { group, place: turns.len(), opposite });
            let parent = before.map(|(member, _)| member.place);
            turns.push(Turn { coordinate, negative: opposite != reversed, parent });
        }
        groups.retain(|group| group.turns.len() > 1);
        groups
    }

    /// Whether a revolute joint turns by the negative of its coordinate, apart from a constant. `None` if it turns by
    /// neither the coordinate nor its negative, or if it is not revolute.
    fn reversed(&self, index: usize) -> Option<bool> {
        let link = self.links.get(index)?;
        match link.kind {
            JointKind::Revolute => link.ratio.as_number()?.as_rational()?.to_integer(),
            JointKind::Prismatic => None,
        }
        .and_then(|ratio| match ratio {
            1 => Some(false),
            -1 => Some(true),
            _ => None,
        })
    }

    /// The next revolute joint toward the base if its axis is parallel, and whether the two axes are opposite.
    fn parallel_parent(&self, index: usize) -> Option<(usize, bool)> {
        let link = self.links.get(index)?;
        let mut axis = link.axis_in_parent();
        let mut parent = link.parent?;
        loop {
            let link = self.links.get(parent)?;
            match link.kind {
                JointKind::Revolute => return Some((parent, opposite(link.axis, axis)?)),
                JointKind::Prismatic => {
                    axis = link.rotation * axis;
                    parent = link.parent?;
                }
            }
        }
    }
}

/// Whether two parallel unit vectors point in opposite directions; `None` if they are not parallel.
fn opposite<'g>(a: Vector<'g>, b: Vector<'g>) -> Option<bool> {
    let is_zero = |value: Expr<'g>| expands_to_zero(value).unwrap_or(false);
    if !a.cross(b).0.into_iter().all(is_zero) {
        return None;
    }
    let product = Polynomial::of(a.dot(b), &PolynomialOptions::default()).ok()?;
    Some(product.as_number()?.is_negative())
}
