//! The variables of a robot: their kinds, names, order and number.
//!
//! Equations, code, and files of states and trajectories use the same names: `q1` for the first joint position, `qd1`
//! for its velocity, `qdd1` for its acceleration and `tau1` for the joint torque or force, with numbers from 1 in the
//! order of [`Robot::coordinates`]. Parameters and the components of wrenches have the names of the robot file.

use crate::robot::{Frame, JointKind, Robot, Wrench};

/// A quantity with one value for each coordinate; functions take it as an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum JointVariable {
    /// The joint position q: rad or m.
    Position,
    /// The joint velocity q̇: rad/s or m/s.
    Velocity,
    /// The joint acceleration q̈: rad/s² or m/s².
    Acceleration,
    /// The joint torque or force τ: N m or N.
    Torque,
}

use JointVariable::{Acceleration, Position, Torque, Velocity};

impl JointVariable {
    /// All variables, in the order in which functions take them.
    pub const ALL: [JointVariable; 4] = [Position, Velocity, Acceleration, Torque];
    /// The motion of a joint: its position, velocity and acceleration.
    pub const MOTION: [JointVariable; 3] = [Position, Velocity, Acceleration];

    /// The name of the array: `q`, `qd`, `qdd`, `tau`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Position => "q",
            Velocity => "qd",
            Acceleration => "qdd",
            Torque => "tau",
        }
    }

    /// The symbol of a coordinate with an index from 0: `q1` for the first position.
    #[must_use]
    pub fn symbol(self, coordinate: usize) -> String {
        format!("{}{}", self.name(), coordinate + 1)
    }

    /// The symbols of the first `count` coordinates, in order.
    #[must_use]
    pub fn symbols(self, count: usize) -> Vec<String> {
        (0..count).map(|coordinate| self.symbol(coordinate)).collect()
    }

    /// The variable and the index of a symbol, for a robot with any number of coordinates.
    #[must_use]
    pub fn parse(symbol: &str) -> Option<(JointVariable, usize)> {
        let letters = symbol.trim_end_matches(|letter: char| letter.is_ascii_digit());
        let number = &symbol[letters.len()..];
        let variable = JointVariable::ALL.into_iter().find(|one| one.name() == letters)?;
        let is_written_so = !number.starts_with('0');
        let number: usize = number.parse().ok().filter(|_| is_written_so)?;
        Some((variable, number.checked_sub(1)?))
    }

    /// The variable whose array has the given name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<JointVariable> {
        JointVariable::ALL.into_iter().find(|one| one.name() == name)
    }

    /// The order of the variable as a time derivative of the position; `None` for the torque.
    #[must_use]
    pub const fn order(self) -> Option<i8> {
        match self {
            Position => Some(0),
            Velocity => Some(1),
            Acceleration => Some(2),
            Torque => None,
        }
    }

    /// The meaning of the array in words.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Position => "Joint positions",
            Velocity => "Joint velocities",
            Acceleration => "Joint accelerations",
            Torque => "Joint torques",
        }
    }

    /// The unit of an entry for a kind of joint.
    #[must_use]
    pub const fn unit(self, kind: JointKind) -> &'static str {
        match (self, kind) {
            (Position, JointKind::Revolute) => "rad",
            (Position, JointKind::Prismatic) => "m",
            (Velocity, JointKind::Revolute) => "rad/s",
            (Velocity, JointKind::Prismatic) => "m/s",
            (Acceleration, JointKind::Revolute) => "rad/s²",
            (Acceleration, JointKind::Prismatic) => "m/s²",
            (Torque, JointKind::Revolute) => "N m",
            (Torque, JointKind::Prismatic) => "N",
        }
    }
}

/// A variable of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Variable {
    /// A joint variable of a coordinate: an index into [`Robot::coordinates`].
    Joint(JointVariable, usize),
    /// A parameter: an index into [`Robot::parameters`].
    Parameter(usize),
    /// A component of the wrench at a frame: an index into [`Robot::frames`], and the component in the order force x y
    /// z, moment x y z.
    Wrench(usize, usize),
}

/// The name of the input that holds the wrench, or the prefix of the names if there are several.
pub const WRENCH: &str = "wrench";

/// The names of the components of a wrench in columns of files: force, N, then moment, N m.
pub const WRENCH_COMPONENTS: [&str; 6] = ["fx", "fy", "fz", "mx", "my", "mz"];

impl Wrench {
    /// The names of the components: force x y z, then moment x y z.
    pub fn components(&self) -> impl Iterator<Item = &str> {
        self.force.iter().chain(&self.moment).map(String::as_str)
    }
}

impl Robot {
    /// The number of entries of an array over the joints.
    #[must_use]
    pub fn count(&self, variable: JointVariable) -> usize {
        match variable {
            // Each coordinate has one velocity. (A ball joint's position would have more entries than its velocity.)
            Position | Velocity | Acceleration | Torque => self.coordinates.len(),
        }
    }

    /// The symbols of an array over the joints, in order.
    #[must_use]
    pub fn symbols(&self, variable: JointVariable) -> Vec<String> {
        variable.symbols(self.count(variable))
    }

    /// The variable that a symbol denotes in this robot.
    #[must_use]
    pub fn variable(&self, symbol: &str) -> Option<Variable> {
        if let Some(index) = self.parameters.iter().position(|one| one.name == symbol) {
            return Some(Variable::Parameter(index));
        }
        if let Some((variable, index)) = JointVariable::parse(symbol) {
            let is_there = index < self.count(variable);
            return is_there.then_some(Variable::Joint(variable, index));
        }
        self.frames.iter().enumerate().find_map(|(index, frame)| {
            let mut components = frame.wrench.as_ref()?.components();
            let component = components.position(|component| component == symbol)?;
            Some(Variable::Wrench(index, component))
        })
    }

    /// The suffix of the names of a tip's wrench and of its components: empty if it is the only tip, otherwise `_NAME`.
    #[must_use]
    pub fn wrench_suffix(&self, tip: &Frame) -> String {
        match self.tips().count() {
            0 | 1 => String::new(),
            _ => format!("_{}", tip.name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_read_back() {
        for variable in JointVariable::ALL {
            assert_eq!(JointVariable::from_name(variable.name()), Some(variable));
            for index in [0, 1, 9, 47] {
                let symbol = variable.symbol(index);
                assert_eq!(JointVariable::parse(&symbol), Some((variable, index)), "{symbol}");
            }
        }
        for wrong in
            ["", "q", "q0", "q01", "qq1", "Q1", "1", "tau", "qd-1", "q1x", "q99999999999999999999"]
        {
            assert_eq!(JointVariable::parse(wrong), None, "{wrong}");
        }
    }
}
