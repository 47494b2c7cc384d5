//! Projection of the wrenches of outer joints on the motions of inner joints.

use crate::economical::composite::Accumulate;
use crate::economical::frames::Frames;
use crate::economical::plan::Place;
use crate::economical::spatial::Twist;

/// An entry (i, j) of a product over joints: the projection of link j's wrench on the motion of joint i.
#[derive(Clone, Debug)]
pub(crate) struct Projection {
    /// The link of the inner joint; in the first projection, the outer link itself.
    pub(crate) inner: usize,
    /// The place at which both are expressed.
    pub(crate) place: Place,
    /// The places through which the inner joint's motion is propagated from its home axes, ordered from outside inward.
    route: Vec<Place>,
}

/// The projections of a link's wrench on its own joint and on all joints inward of it. The wrench is propagated inward
/// as far as `projected_at`; the motions of joints farther inward are propagated outward to that place.
pub(crate) fn projections(
    frames: &Frames<'_, '_>,
    link: usize,
    projected_at: Option<Place>,
) -> Vec<Projection> {
    let mut here = Place { link, turned: false };
    let mut found = vec![Projection { inner: link, place: here, route: vec![] }];
    let (mut place, mut route) = (here, vec![]);
    while let Some(next) = frames.inward(place) {
        if Some(here) == projected_at {
            route.push(place);
        } else {
            here = next;
        }
        if !next.turned {
            found.push(Projection { inner: next.link, place: here, route: route.clone() });
        }
        place = next;
    }
    found
}

impl Projection {
    /// A motion, given in the inner link's home axes, at the place of the projection.
    pub(crate) fn twist<'g>(&self, frames: &Frames<'_, 'g>, at_home: &Twist<'g>) -> Twist<'g> {
        self.route.iter().rev().fold(*at_home, |twist, place| frames.twist_outward(*place, &twist))
    }
}

/// A quantity that can be propagated inward along the mechanism from place to place.
pub(crate) trait Propagate<'g> {
    /// The quantity at the next place inward from `place`.
    fn inward(&self, frames: &Frames<'_, 'g>, place: Place) -> Self;
}

impl<'g, T: Accumulate<'g>> Propagate<'g> for T {
    fn inward(&self, frames: &Frames<'_, 'g>, place: Place) -> Self {
        let link = &frames.chain.links[place.link];
        let joint_frame = &frames.joint_frames[place.link];
        if place.turned {
            self.turned(&joint_frame.group_turn)
        } else if frames.is_joined(place.link) {
            self.shifted(frames.arm_at_home(place.link))
        } else {
            self.rotated(&link.rotation).shifted(joint_frame.origin)
        }
    }
}

/// A quantity that is being propagated inward, with the place that it has reached.
#[derive(Clone, Debug)]
pub(crate) struct Propagated<T> {
    place: Place,
    pub(crate) load: T,
}

impl<T> Propagated<T> {
    /// Creates a quantity in a link's home axes.
    pub(crate) fn from_home(link: usize, load: T) -> Propagated<T> {
        Propagated { place: Place { link, turned: false }, load }
    }

    /// Propagates the quantity to a place farther inward; does nothing if it is already there.
    pub(crate) fn propagate_to<'g>(&mut self, frames: &Frames<'_, 'g>, place: Place)
    where
        T: Propagate<'g>,
    {
        while self.place != place
            && let Some(next) = frames.inward(self.place)
        {
            self.load = self.load.inward(frames, self.place);
            self.place = next;
        }
    }
}
