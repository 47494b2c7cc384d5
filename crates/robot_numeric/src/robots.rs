//! Random robots for tests and checks. They are the same on every machine for equal seeds.
//!
//! The values are short decimals and therefore exact; the numeric solver reads the same robot with
//! [`crate::Mechanism::nominal`].

use robot_symbolic::{Formula, Rational};

pub use crate::random::{Random, Recipe, State};

use robot_model::robot::{
    BaseFrames, Body, Coordinate, Drive, Frame, Friction, Inertia, Joint, JointKind, Link, Move,
    Parameter, Placement, Robot, Wrench,
};

/// A robot: links of 0.2 to 5 kg with offset centers of mass and rotated inertias; joints of both kinds about arbitrary
/// axes (half of them are coordinate axes, and one placement in three is at right angles); gravity in an arbitrary
/// direction; a tip with a wrench on the last link; and a frame `sensor` on any link or on the base.
///
/// [`Recipe::fixed`] gives some links a second body; [`Recipe::mimic`] gives some joints a ratio, an offset and the
/// coordinate of another joint; [`Recipe::drives`] adds rotors and friction.
#[must_use]
pub fn robot(random: &mut Random, recipe: &Recipe) -> Robot {
    let mut draw = Draw { random, recipe };
    let mut coordinates: Vec<Coordinate> = vec![];
    let links: Vec<Link> =
        (0..recipe.joints).map(|index| draw.link(index, &mut coordinates)).collect();
    let gravity = draw.vector(981).map(|decimal| decimal.formula(100));
    let last = links.len().checked_sub(1);
    let any = draw.random.index(links.len() + 1).checked_sub(1);
    let tip = Wrench {
        force: ["Fx", "Fy", "Fz"].map(str::to_owned),
        moment: ["Mx", "My", "Mz"].map(str::to_owned),
        latex: Default::default(),
    };
    let mut frame = |name: &str, link: Option<usize>, wrench: Option<Wrench>| Frame {
        name: name.to_owned(),
        link,
        placement: draw.placement(),
        wrench,
    };
    let frames = vec![frame("tip", last, last.map(|_| tip)), frame("sensor", any, None)];
    Robot {
        name: "random".to_owned(),
        description: None,
        gravity,
        snap: None,
        base_frames: BaseFrames::File,
        parameters: vec![],
        coordinates,
        links,
        frames,
        dh: vec![],
        payload: None,
    }
}

/// The robot with every mass, center of mass and inertia, and with each inertia of drives and each value of friction
/// (except smoothing) that is not 0, replaced by a parameter whose nominal value is the former value: `m1`, `cx1`,
/// `Ixx1` for the first body of the first link, `m1_2` for its second body, `FV1` for the viscous friction of its
/// joint.
#[must_use]
pub fn parameterized(robot: &Robot) -> Robot {
    let mut robot = robot.clone();
    let parameters = &mut robot.parameters;
    let mut replace = |formula: &mut Formula, name: String| {
        let value = formula.as_number().and_then(|number| number.as_rational().cloned());
        if value.is_none() {
            return;
        }
        *formula = Formula::symbol(&name);
        parameters.push(Parameter { name, value, unit: None, latex: None, doc: None });
    };
    for (number, link) in (1..).zip(&mut robot.links) {
        for (part, body) in (1..).zip(&mut link.bodies) {
            let suffix = if part == 1 { number.to_string() } else { format!("{number}_{part}") };
            replace(&mut body.mass, format!("m{suffix}"));
            if let Some(Move::Translate(center)) = body.placement.0.first_mut() {
                for (formula, axis) in center.iter_mut().zip(["x", "y", "z"]) {
                    replace(formula, format!("c{axis}{suffix}"));
                }
            }
            let Inertia { xx, yy, zz, xy, xz, yz } = &mut body.inertia;
            let entries = [xx, yy, zz, xy, xz, yz];
            for (formula, axes) in entries.into_iter().zip(Inertia::NAMES) {
                replace(formula, format!("I{axes}{suffix}"));
            }
        }
        let (friction, drive) = (&mut link.friction, &mut link.drive);
        let of_joint = [
            (&mut friction.viscous, "FV"),
            (&mut friction.coulomb, "FC"),
            (&mut friction.spindle_diameter, "FD"),
            (&mut friction.coulomb_positive, "FP"),
            (&mut friction.coulomb_negative, "FN"),
            (&mut friction.offset, "FO"),
            (&mut drive.armature, "IA"),
            (&mut drive.rotor_inertia, "IR"),
        ];
        for (formula, name) in of_joint {
            if !formula.as_number().is_some_and(|value| value.is_zero()) {
                replace(formula, format!("{name}{number}"));
            }
        }
    }
    robot
}

/// An integer that is written as a decimal fraction.
#[derive(Clone, Copy)]
struct Decimal(i64);

impl Decimal {
    fn formula(self, denominator: i64) -> Formula {
        Formula::number(&Rational::new(self.0, denominator).unwrap_or(Rational::ZERO))
    }
}

struct Draw<'r> {
    random: &'r mut Random,
    recipe: &'r Recipe,
}

impl Draw<'_> {
    /// A random integer between −`size` and `size`.
    fn decimal(&mut self, size: i64) -> Decimal {
        Decimal(self.between(-size, size))
    }

    fn between(&mut self, low: i64, high: i64) -> i64 {
        // The ranges that are used here are far below those of `usize` and `i64`.
        low + self.random.index((high - low + 1) as usize) as i64
    }

    fn vector(&mut self, size: i64) -> [Decimal; 3] {
        [0; 3].map(|_| self.decimal(size))
    }

    /// A translation of up to half a meter along each axis and a rotation by arbitrary angles; in one of three cases, a
    /// rotation by right angles and a translation along some axes only.
    fn placement(&mut self) -> Placement {
        let (xyz, rpy) = if self.random.once_in(3) {
            let angle = |quarters: i64| match quarters {
                -1 => "-1.5707963267948966",
                1 => "1.5707963267948966",
                2 => "3.141592653589793",
                _ => "0",
            };
            let rpy = [self.between(-1, 2), 0, self.between(-1, 2)].map(|quarters| {
                let angle = Rational::from_decimal(angle(quarters));
                Formula::number(&angle.unwrap_or(Rational::ZERO))
            });
            let xyz = self.vector(500).map(|Decimal(n)| Decimal(if n % 2 == 0 { 0 } else { n }));
            (xyz, rpy)
        } else {
            (self.vector(500), self.vector(3000).map(|angle| angle.formula(1000)))
        };
        Placement::from_xyz_rpy(xyz.map(|decimal| decimal.formula(1000)), rpy)
    }

    fn link(&mut self, index: usize, coordinates: &mut Vec<Coordinate>) -> Link {
        let name = (index + 1).to_string();
        let joint = self.joint(&name, coordinates);
        let parent = if self.recipe.branching {
            // The index is counted from 1, so that 0 stands for the base.
            self.random.index(index + 1).checked_sub(1)
        } else {
            index.checked_sub(1)
        };
        let placement = self.placement();
        let mut bodies = vec![self.body(&name)];
        if self.recipe.fixed && self.random.once_in(3) {
            bodies.push(self.body(&format!("{name} extra")));
        }
        let (friction, drive) = if self.recipe.drives {
            (self.friction(), self.drive())
        } else {
            (Friction::none(), Drive::none())
        };
        Link { name, parent, placement, joint, bodies, friction, drive }
    }

    fn joint(&mut self, name: &str, coordinates: &mut Vec<Coordinate>) -> Joint {
        let kind = if self.random.once_in(3) { JointKind::Prismatic } else { JointKind::Revolute };
        let mut axis = self.vector(9);
        if self.random.once_in(2) || axis.iter().all(|decimal| decimal.0 == 0) {
            axis = [Decimal(0); 3];
            axis[self.random.index(3)] = Decimal(if self.random.once_in(2) { 1 } else { -1 });
        }
        let (mut ratio, mut offset) = (Decimal(100), Decimal(0));
        let mut coordinate = coordinates.len();
        if self.recipe.mimic && coordinate > 0 && self.random.once_in(3) {
            coordinate = self.random.index(coordinate);
            (ratio, offset) = (self.decimal(300), self.decimal(50));
        } else {
            coordinates.push(Coordinate { joint: name.to_owned(), kind, limits: None });
        }
        Joint {
            name: name.to_owned(),
            kind,
            axis: axis.map(|decimal| decimal.formula(1)),
            coordinate,
            ratio: ratio.formula(100),
            offset: offset.formula(100),
        }
    }

    /// A box with sides of 2 to 30 cm in an arbitrary orientation; its inertia is therefore positive definite and
    /// satisfies the triangle inequality.
    fn body(&mut self, name: &str) -> Body {
        let mass = self.between(20, 500);
        let squares = [0; 3].map(|_| self.between(20, 300).pow(2) * mass / 12);
        let [x, y, z] = squares;
        let principal = [y + z, x + z, x + y].map(|entry| Decimal(entry).formula(100_000_000));
        let [xx, yy, zz] = principal;
        let zero = || Formula::number(&Rational::ZERO);
        let center = self.vector(300).map(|decimal| decimal.formula(1000));
        let angles = self.vector(3000).map(|angle| angle.formula(1000));
        Body {
            name: name.to_owned(),
            mass: Decimal(mass).formula(100),
            placement: Placement::from_xyz_rpy(center, angles),
            inertia: Inertia { xx, yy, zz, xy: zero(), xz: zero(), yz: zero() },
        }
    }

    fn friction(&mut self) -> Friction {
        let mut upto = |size: i64| Decimal(self.between(0, size)).formula(1000);
        Friction {
            viscous: upto(2000),
            coulomb: upto(300),
            spindle_diameter: upto(100),
            coulomb_positive: upto(1000),
            coulomb_negative: upto(1000),
            offset: self.decimal(200).formula(1000),
            smoothing: self.random.once_in(3).then(|| Decimal(self.between(10, 200)).formula(1000)),
        }
    }

    fn drive(&mut self) -> Drive {
        Drive {
            armature: Decimal(self.between(0, 300)).formula(1000),
            rotor_inertia: Decimal(self.between(0, 30)).formula(100_000),
            gear_ratio: self.decimal(30).formula(1),
            gyroscopic: self.random.once_in(2),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mechanism;

    fn everything(joints: usize) -> Recipe {
        Recipe { joints, branching: true, mimic: true, fixed: true, drives: true }
    }

    #[test]
    fn robots_are_mechanisms_and_seeds_tell_them_apart() {
        for seed in 0..40 {
            let recipe = everything(1 + seed as usize % 8);
            let robot = robot(&mut Random::new(seed), &recipe);
            assert_eq!(robot.links.len(), recipe.joints);
            let mechanism = Mechanism::nominal(&robot).unwrap();
            let q = vec![0.3; mechanism.coordinates()];
            mechanism.inverse_mass_matrix(&q).expect("positive definite");
            assert_eq!(robot, super::robot(&mut Random::new(seed), &recipe));
            assert_ne!(robot, super::robot(&mut Random::new(seed + 1), &recipe));
        }
    }

    #[test]
    fn parameters_stand_for_their_figures() {
        let robot = robot(&mut Random::new(5), &everything(6));
        let with_parameters = parameterized(&robot);
        assert!(with_parameters.parameters.len() >= 60);
        let plain = Mechanism::nominal(&robot).unwrap();
        assert_eq!(plain, Mechanism::nominal(&with_parameters).unwrap());
    }
}
