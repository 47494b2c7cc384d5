//! Lowering: converts formulas to expressions and moves to rotations and translations, and combines the bodies of a
//! link.

use robot_model::robot::{Axis, Body, Frame, Friction, Inertia, Link, Move, Placement, Robot};
use robot_model::variable::JointVariable;
use robot_symbolic::{Expr, Formula, Graph, Number, walk};

use super::direction::unit_vector;
use super::snapped::{changes, near};
use super::{Mechanism, MechanismFrame, MechanismFriction, MechanismLink, MechanismOptions};
use crate::vector::{Matrix, Vector};

/// Expresses the robot in symbols of `graph`.
pub(super) fn lower<'g>(
    robot: &Robot,
    graph: &'g Graph,
    options: &MechanismOptions,
) -> Mechanism<'g> {
    let lowering = Lowering { graph, options };
    // The symbols are in the order of the mechanism and the file, whatever symbols the formulas use first.
    for symbol in JointVariable::MOTION.into_iter().flat_map(|variable| robot.symbols(variable)) {
        graph.symbol(&symbol);
    }
    for parameter in &robot.parameters {
        graph.symbol(&parameter.name);
    }
    let gravity = lowering.vector(&robot.gravity);
    let links = robot.links.iter().map(|link| lowering.link(link)).collect();
    let frames = robot.frames.iter().map(|frame| lowering.frame(frame)).collect();
    Mechanism {
        graph,
        gravity,
        links,
        frames,
        degrees_of_freedom: robot.coordinates.len(),
        snapped: changes(robot, options.snap),
        base: None,
    }
}

struct Lowering<'g, 'o> {
    graph: &'g Graph,
    options: &'o MechanismOptions,
}

impl<'g> Lowering<'g, '_> {
    fn value(&self, formula: &Formula) -> Expr<'g> {
        self.round(formula.lower(self.graph, &mut |name| self.graph.symbol(name)))
    }

    fn vector(&self, formulas: &[Formula; 3]) -> Vector<'g> {
        Vector([0, 1, 2].map(|i| self.value(&formulas[i])))
    }

    /// An irrational constant as a floating-point number if code needs it; any other expression unchanged.
    fn round(&self, expr: Expr<'g>) -> Expr<'g> {
        let keep = !self.options.rounded || expr.as_number().is_some();
        if keep || !walk::symbols(&[expr]).is_empty() {
            return expr;
        }
        self.graph.number(Number::real(expr.evaluate(|_| f64::NAN)))
    }

    fn link(&self, link: &Link) -> MechanismLink<'g> {
        let (rotation, translation) = self.placement(&link.placement);
        let joint = &link.joint;
        let (ratio, offset) = (self.value(&joint.ratio), self.value(&joint.offset));
        let motion =
            |variable: JointVariable| ratio * self.graph.symbol(&variable.symbol(joint.coordinate));
        let (mass, center_of_mass, inertia) = self.bodies(&link.bodies);
        let drive = &link.drive;
        let (rotor_inertia, gear_ratio) =
            (self.value(&drive.rotor_inertia), self.value(&drive.gear_ratio));
        let coupled = drive.gyroscopic && link.parent.is_some();
        MechanismLink {
            parent: link.parent,
            rotation,
            translation,
            kind: joint.kind,
            axis: unit_vector(self.vector(&joint.axis), |expr| self.round(expr)),
            coordinate: joint.coordinate,
            ratio,
            position: motion(JointVariable::Position) + offset,
            velocity: motion(JointVariable::Velocity),
            acceleration: motion(JointVariable::Acceleration),
            mass,
            center_of_mass,
            inertia,
            friction: self.friction(&link.friction),
            reflected_inertia: self.value(&drive.armature)
                + rotor_inertia * gear_ratio * gear_ratio,
            rotor_coupling: if coupled { rotor_inertia * gear_ratio } else { self.graph.zero() },
        }
    }

    fn friction(&self, friction: &Friction) -> MechanismFriction<'g> {
        MechanismFriction {
            viscous: self.value(&friction.viscous),
            coulomb: self.value(&friction.coulomb),
            spindle_diameter: self.value(&friction.spindle_diameter),
            coulomb_positive: self.value(&friction.coulomb_positive),
            coulomb_negative: self.value(&friction.coulomb_negative),
            offset: self.value(&friction.offset),
            smoothing: friction.smoothing.as_ref().map(|width| self.value(width)),
        }
    }

    fn frame(&self, frame: &Frame) -> MechanismFrame<'g> {
        let (rotation, translation) = self.placement(&frame.placement);
        let symbols = |names: &[String; 3]| Vector([0, 1, 2].map(|i| self.graph.symbol(&names[i])));
        MechanismFrame {
            name: frame.name.clone(),
            link: frame.link,
            rotation,
            translation,
            wrench: frame
                .wrench
                .as_ref()
                .map(|wrench| (symbols(&wrench.force), symbols(&wrench.moment))),
        }
    }

    /// The rotation R and translation p of a displacement: x_outer = R x_inner + p.
    fn placement(&self, placement: &Placement) -> (Matrix<'g>, Vector<'g>) {
        let mut rotation = Matrix::identity(self.graph);
        let mut translation = Vector::zero(self.graph);
        for step in &placement.0 {
            match step {
                Move::Translate(by) => translation = translation + rotation * self.vector(by),
                Move::Rotate(axis, angle) => {
                    let angle = self.angle(angle);
                    let (sine, cosine) = (self.round(angle.sin()), self.round(angle.cos()));
                    let axis = self.coordinate_axis(*axis);
                    rotation = rotation * Matrix::rotation(axis, sine, cosine);
                }
            }
        }
        (rotation, translation)
    }

    /// A constant angle within the tolerance of a multiple of π/2 becomes that multiple.
    fn angle(&self, formula: &Formula) -> Expr<'g> {
        // The exact value is needed, because rounding would make `pi/2` a floating-point number, whose cosine is not 0.
        let exact = formula.lower(self.graph, &mut |name| self.graph.symbol(name));
        match near(formula, self.options.snap) {
            Some(near) => self.graph.pi() * near.quarters / 2,
            None => exact,
        }
    }

    fn coordinate_axis(&self, axis: Axis) -> Vector<'g> {
        let column = match axis {
            Axis::X => 0,
            Axis::Y => 1,
            Axis::Z => 2,
        };
        Matrix::identity(self.graph).column(column)
    }

    /// The mass, center of mass and inertia tensor about the center of mass of all bodies together.
    fn bodies(&self, bodies: &[Body]) -> (Expr<'g>, Vector<'g>, Matrix<'g>) {
        let parts: Vec<_> = bodies.iter().map(|body| self.body(body)).collect();
        if let [single] = parts[..] {
            return single;
        }
        let zero = (self.graph.zero(), Vector::zero(self.graph), Matrix::zero(self.graph));
        let mass = parts.iter().fold(zero.0, |sum, part| sum + part.0);
        if mass.is_zero() {
            let inertia = parts.iter().fold(zero.2, |sum, part| sum + part.2);
            return (mass, zero.1, inertia);
        }
        let moment = parts.iter().fold(zero.1, |sum, part| sum + part.1 * part.0);
        let center = moment.map(|component| component / mass);
        let inertia = parts.iter().fold(zero.2, |sum, (mass, own_center, inertia)| {
            sum + *inertia + steiner(*mass, *own_center - center)
        });
        (mass, center, inertia)
    }

    fn body(&self, body: &Body) -> (Expr<'g>, Vector<'g>, Matrix<'g>) {
        let (rotation, center) = self.placement(&body.placement);
        let Inertia { xx, yy, zz, xy, xz, yz } = &body.inertia;
        let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let inertia = Matrix::from_fn(|row, column| self.value(rows[row][column]));
        (self.value(&body.mass), center, rotation * inertia * rotation.transpose())
    }
}

/// The contribution of a point mass at `r` to an inertia tensor: m (r² 1 − r rᵀ).
fn steiner<'g>(mass: Expr<'g>, r: Vector<'g>) -> Matrix<'g> {
    (Matrix::identity(mass.graph()) * r.dot(r) - Matrix::outer(r, r)) * mass
}
