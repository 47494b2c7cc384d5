//! Random mechanisms and states for tests and checks. They are the same on every machine for equal seeds.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Matrix3, Vector3};

use super::{
    friction::{Friction, Sign},
    mechanism::{Frame, Joint, JointKind, Link, Mechanism, Wrench},
    pose::Pose,
};

/// A generator of random numbers, vectors, bodies and mechanisms.
#[derive(Debug, Clone)]
pub struct Random {
    numbers: robot_symbolic::Random,
}

/// The properties of random mechanisms.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recipe {
    /// The number of moving joints. Each has its own coordinate unless `mimic` is set.
    pub joints: usize,
    /// Whether the parent of a link may be any preceding link or the base. If not, it is the link before.
    pub branching: bool,
    /// Whether some joints share the coordinate of another joint, with a ratio and an offset.
    pub mimic: bool,
    /// Whether some additional links are fixed to others.
    pub fixed: bool,
    /// Whether the joints have rotors and friction.
    pub drives: bool,
}

impl Recipe {
    /// A chain of links, each with its own coordinate, without rotors and friction.
    pub fn serial(joints: usize) -> Self {
        Self { joints, branching: false, mimic: false, fixed: false, drives: false }
    }

    /// A tree of links that is otherwise like [`Recipe::serial`].
    pub fn tree(joints: usize) -> Self {
        Self { branching: true, ..Self::serial(joints) }
    }
}

/// A state of a mechanism, with all inputs that its functions can take.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// The joint positions, rad or m.
    pub q: Vec<f64>,
    /// The joint velocities, rad/s or m/s.
    pub qd: Vec<f64>,
    /// The joint accelerations, rad/s² or m/s².
    pub qdd: Vec<f64>,
    /// The joint torques, N m or N, which are independent of the accelerations.
    pub tau: Vec<f64>,
    /// The wrenches, one for each frame.
    pub wrenches: Vec<Wrench>,
}

impl Random {
    /// Creates a generator; equal seeds give equal numbers.
    pub fn new(seed: u64) -> Self {
        Self { numbers: robot_symbolic::Random::new(seed) }
    }

    /// Returns 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.numbers.bits()
    }

    /// Returns a number between `low` and `high`; `high` is excluded except for rounding.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        self.numbers.uniform(low, high)
    }

    /// Returns an index below `count`, or 0 if `count` is 0.
    pub fn index(&mut self, count: usize) -> usize {
        self.numbers.index(count)
    }

    /// Returns true on average once in `every` calls.
    pub fn once_in(&mut self, every: usize) -> bool {
        self.index(every) == 0
    }

    /// Returns a vector whose entries are between −`size` and `size`.
    pub fn vector(&mut self, size: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.uniform(-size, size))
    }

    /// Returns a unit vector; all directions have the same probability.
    pub fn unit_vector(&mut self) -> Vector3<f64> {
        let (z, angle) = (self.uniform(-1.0, 1.0), self.uniform(0.0, TAU));
        let radius = (1.0 - z * z).sqrt();
        Vector3::new(radius * angle.cos(), radius * angle.sin(), z).normalize()
    }

    /// Returns a placement with an arbitrary rotation (from roll, pitch and yaw) and up to half a meter of translation
    /// along each axis.
    pub fn pose(&mut self) -> Pose {
        let rpy =
            [self.uniform(-PI, PI), self.uniform(-FRAC_PI_2, FRAC_PI_2), self.uniform(-PI, PI)];
        Pose::from_xyz_rpy(self.vector(0.5).into(), rpy)
    }

    /// Returns a placement as it is common in robots: rotated by right angles and translated along some axes only.
    fn square_pose(&mut self) -> Pose {
        let mut right_angle = || (self.index(4) as f64 - 1.0) * FRAC_PI_2;
        let rpy = [right_angle(), 0.0, right_angle()];
        let xyz = self.vector(0.5).map(|x| if self.once_in(2) { 0.0 } else { x });
        let mut pose = Pose::from_xyz_rpy(xyz.into(), rpy);
        pose.rotation = pose.rotation.map(f64::round);
        pose
    }

    /// Returns the inertia tensor about the center of mass of a body with the given mass: a box with sides of 2 to 30
    /// cm in an arbitrary orientation. It is therefore positive definite and satisfies the triangle inequality.
    pub fn inertia(&mut self, mass: f64) -> Matrix3<f64> {
        let squares = Vector3::from_fn(|_, _| self.uniform(0.02, 0.3).powi(2)) * (mass / 12.0);
        let principal = Matrix3::from_diagonal(&squares.map(|square| squares.sum() - square));
        let axes = self.pose().rotation;
        let tensor = axes * principal * axes.transpose();
        (tensor + tensor.transpose()) / 2.0
    }

    /// Returns a mechanism: links of 0.2 to 5 kg with offset centers of mass and rotated inertias; joints of both kinds
    /// about arbitrary axes (one in three is a coordinate axis, and one placement in three is at right angles); gravity
    /// in an arbitrary direction; one frame on the last link and one on a random link.
    pub fn mechanism(&mut self, recipe: &Recipe) -> Mechanism {
        let mut links: Vec<Link> = Vec::new();
        let mut coordinates = 0;
        while links.iter().filter(|link| link.joint.driver().is_some()).count() < recipe.joints {
            let fixed = recipe.fixed && self.once_in(4);
            let joint = if fixed { Joint::fixed() } else { self.joint(recipe, &mut coordinates) };
            let link = self.link(recipe, joint, links.len());
            links.push(link);
        }
        let gravity = self.unit_vector() * 9.81;
        let frames =
            [links.len().checked_sub(1), links.len().checked_sub(1 + self.index(links.len()))]
                .map(|link| Frame { link, placement: self.pose() });
        Mechanism::assemble(gravity, links, frames.to_vec())
    }

    fn joint(&mut self, recipe: &Recipe, coordinates: &mut usize) -> Joint {
        let axis = if self.once_in(3) {
            let sign = if self.once_in(2) { 1.0 } else { -1.0 };
            Vector3::ith(self.index(3), sign)
        } else {
            self.unit_vector()
        };
        let kind = if self.once_in(3) { JointKind::Prismatic } else { JointKind::Revolute };
        let mut joint = Joint { kind, axis, coordinate: *coordinates, ratio: 1.0, offset: 0.0 };
        if recipe.mimic && *coordinates > 0 && self.once_in(3) {
            joint.coordinate = self.index(*coordinates);
            joint.ratio = self.uniform(-3.0, 3.0);
            joint.offset = self.uniform(-0.5, 0.5);
        } else {
            *coordinates += 1;
        }
        joint
    }

    fn link(&mut self, recipe: &Recipe, joint: Joint, index: usize) -> Link {
        let mut parent = index.checked_sub(1);
        if recipe.branching {
            // The index is counted from 1, so that 0 stands for the base.
            parent = self.index(index + 1).checked_sub(1);
        }
        let placement = if self.once_in(3) { self.square_pose() } else { self.pose() };
        let mass = self.uniform(0.2, 5.0);
        let mut link =
            Link::new(parent, placement, joint, mass, self.vector(0.3), self.inertia(mass));
        if recipe.drives {
            link.rotor_inertia = self.uniform(0.0, 0.5);
            link.friction = Friction {
                viscous: self.uniform(0.0, 2.0),
                coulomb: self.uniform(0.0, 0.3),
                spindle_diameter: self.uniform(0.01, 0.1),
                constant: [self.uniform(0.0, 1.0), self.uniform(0.0, 1.0)],
                offset: self.uniform(-0.2, 0.2),
                sign: if self.once_in(3) {
                    Sign::Smooth(self.uniform(0.01, 0.2))
                } else {
                    Sign::Exact
                },
            };
        }
        link
    }

    /// Returns a state: angles within ±π, distances within ±0.5 m, velocities within ±2, accelerations within ±5,
    /// torques within ±20, forces of wrenches within ±10 N and their moments within ±3 N m.
    pub fn state(&mut self, mechanism: &Mechanism) -> State {
        let n = mechanism.coordinates();
        let mut ranges = vec![PI; n];
        for joint in mechanism.links().iter().map(|link| &link.joint) {
            match joint.kind {
                JointKind::Prismatic => ranges[joint.coordinate] = 0.5,
                JointKind::Revolute | JointKind::Fixed => {}
            }
        }
        let q = ranges.into_iter().map(|range| self.uniform(-range, range)).collect();
        let mut numbers = |size: f64| (0..n).map(|_| self.uniform(-size, size)).collect();
        let (qd, qdd, tau) = (numbers(2.0), numbers(5.0), numbers(20.0));
        let wrench = |_| Wrench { force: self.vector(10.0), moment: self.vector(3.0) };
        State { q, qd, qdd, tau, wrenches: mechanism.frames().iter().map(wrench).collect() }
    }
}
