//! The changes of a link's options that a search tries.

use crate::economical::plan::{Entry, LinkPlan, Origin, Turn};

/// A change of a link's options.
pub(super) type Change = Box<dyn Fn(&mut LinkPlan)>;

/// Changes of working frames and of residuals.
pub(super) fn frame_changes(current: &LinkPlan) -> Vec<Change> {
    let mut changes: Vec<Change> = vec![];
    let origins = [
        Origin::File,
        Origin::NextNormal,
        Origin::PreviousNormal,
        Origin::ZeroXz,
        Origin::ZeroYz,
        Origin::CenterOfMass,
        Origin::Parent,
    ];
    for turn in [current.turn, Turn::File, Turn::NextNormal, Turn::FirstMoment] {
        for origin in origins {
            changes.push(Box::new(move |plan| {
                (plan.origin, plan.turn) = (origin, turn);
            }));
        }
    }
    for kind in 0..3 {
        changes.push(Box::new(move |plan| plan.residual[kind] = None));
        for entry in Entry::ALL {
            changes.push(Box::new(move |plan| plan.residual[kind] = Some(entry)));
        }
    }
    changes
}

/// Changes of the recursion over motions and forces.
pub(super) fn motion_changes() -> Vec<Change> {
    let mut changes: Vec<Change> = vec![
        Box::new(|plan| plan.angle_sum ^= true),
        Box::new(|plan| plan.column ^= true),
        Box::new(|plan| plan.diagonal ^= true),
        Box::new(|plan| plan.doubled ^= true),
        Box::new(|plan| {
            plan.column ^= true;
            plan.diagonal ^= true;
        }),
        Box::new(|plan| {
            plan.angle_sum ^= true;
            plan.column ^= true;
        }),
    ];
    for k in 0..3 {
        changes.push(Box::new(move |plan| plan.moment[k] ^= true));
    }
    changes
}
