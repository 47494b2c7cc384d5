//! Where the wrenches of outer joints meet the motions of inner joints.

use crate::economical::plan::Place;
use crate::economical::spatial::{Twist, Ways, Wrench};
use crate::vector::Vector;

/// A meeting of what an outer link asks for with the motion of an inner joint.
#[derive(Clone, Debug)]
pub(crate) struct Encounter {
    /// The link of the inner joint; at first the outer link itself.
    pub(crate) inner: usize,
    /// Where they meet.
    pub(crate) place: Place,
    /// The places through which the inner joint's motion comes from its home axes, from outside in.
    route: Vec<Place>,
}

/// The encounters of a link with itself and all links inward of it: wrenches go inward as far as
/// `meeting`, and from farther inward the motions come there.
pub(crate) fn encounters(
    ways: &Ways<'_, '_>,
    link: usize,
    meeting: Option<Place>,
) -> Vec<Encounter> {
    let mut here = Place { link, turned: false };
    let mut found = vec![Encounter { inner: link, place: here, route: vec![] }];
    let (mut place, mut route) = (here, vec![]);
    while let Some(next) = ways.inward(place) {
        if Some(here) == meeting {
            route.push(place);
        } else {
            here = next;
        }
        if !next.turned {
            found.push(Encounter { inner: next.link, place: here, route: route.clone() });
        }
        place = next;
    }
    found
}

impl Encounter {
    /// A motion in the inner link's home axes, at the meeting place.
    pub(crate) fn twist<'g>(&self, ways: &Ways<'_, 'g>, at_home: &Twist<'g>) -> Twist<'g> {
        self.route.iter().rev().fold(*at_home, |twist, place| ways.twist_outward(*place, &twist))
    }
}

/// Something that goes inward from place to place.
pub(crate) trait GoesInward<'g> {
    /// The same at the next place inward of `place`.
    fn inward(&self, ways: &Ways<'_, 'g>, place: Place) -> Self;
}

impl<'g> GoesInward<'g> for Wrench<'g> {
    fn inward(&self, ways: &Ways<'_, 'g>, place: Place) -> Self {
        ways.wrench_inward(place, self)
    }
}

/// Components in the axes of a place.
impl<'g> GoesInward<'g> for Vector<'g> {
    fn inward(&self, ways: &Ways<'_, 'g>, place: Place) -> Self {
        ways.vector_inward(place, *self)
    }
}

/// A traveller inward.
#[derive(Clone, Debug)]
pub(crate) struct Traveller<T> {
    place: Place,
    pub(crate) load: T,
}

impl<T> Traveller<T> {
    /// Sets out from a link's home axes.
    pub(crate) fn from_home(link: usize, load: T) -> Traveller<T> {
        Traveller { place: Place { link, turned: false }, load }
    }

    /// Goes on to a place farther inward, or stays.
    pub(crate) fn go_to<'g>(&mut self, ways: &Ways<'_, 'g>, place: Place)
    where
        T: GoesInward<'g>,
    {
        while self.place != place
            && let Some(next) = ways.inward(self.place)
        {
            self.load = self.load.inward(ways, self.place);
            self.place = next;
        }
    }
}
