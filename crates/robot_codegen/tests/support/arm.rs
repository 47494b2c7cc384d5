//! A planar arm in closed form.

use robot_codegen::spec::*;
use robot_symbolic::{Expr, Graph};

/// A planar arm of two links with point masses at their ends, in closed form.
pub(crate) fn planar_arm(graph: &Graph) -> ModuleSpec<'_> {
    let symbol = |name: &str| graph.symbol(name);
    let (m1, m2, l1, l2, g) = (symbol("m1"), symbol("m2"), symbol("l1"), symbol("l2"), symbol("g"));
    let (q1, q2, qd1, qd2) = (symbol("q1"), symbol("q2"), symbol("qd1"), symbol("qd2"));
    let (a1, a2) = (symbol("qdd1"), symbol("qdd2"));
    let h = m2 * l1 * l2;
    let (c2, c1, c12) = (q2.cos(), q1.cos(), (q1 + q2).cos());
    let m22 = m2 * l2 * l2;
    let m12 = m22 + h * c2;
    let m11 = (m1 + m2) * l1 * l1 + m22 + h * c2 * 2;
    let far = m2 * g * l2 * c12;
    let tau1 = m11 * a1 + m12 * a2 - h * q2.sin() * (qd1 * qd2 * 2 + qd2 * qd2)
        + (m1 + m2) * g * l1 * c1
        + far;
    let tau2 = m12 * a1 + m22 * a2 + h * q2.sin() * qd1 * qd1 + far;
    ModuleSpec {
        name: "planar_arm".into(),
        doc: vec!["A planar arm of two links.".into()],
        parameters: [
            ("m1", 2.0, "kg"),
            ("m2", 1.5, "kg"),
            ("l1", 0.5, "m"),
            ("l2", 0.3, "m"),
            ("g", 9.81, "m/s^2"),
        ]
        .map(|(name, nominal, unit)| ParameterSpec {
            name: name.into(),
            doc: format!("parameter {name}"),
            unit: unit.into(),
            nominal: Some(nominal),
        })
        .into(),
        functions: vec![
            Function {
                name: "inverse_dynamics".into(),
                doc: vec!["Joint torques of a motion.".into()],
                inputs: vec![joints("q", "rad"), joints("qd", "rad/s"), joints("qdd", "rad/s^2")],
                outputs: vec![vector("tau", "N m", vec![tau1, tau2])],
            },
            Function {
                name: "mass_matrix".into(),
                doc: vec![],
                inputs: vec![joints("q", "rad")],
                outputs: vec![
                    Output { shape: vec![2, 2], ..vector("m", "kg m^2", vec![m11, m12, m12, m22]) },
                    Output { shape: vec![], ..vector("trace", "kg m^2", vec![m11 + m22]) },
                ],
            },
        ],
    }
}

pub(crate) fn joints(name: &str, unit: &str) -> Input {
    Input {
        name: name.into(),
        doc: format!("joint {name}"),
        unit: unit.into(),
        symbols: (1..=2).map(|i| format!("{name}{i}")).collect(),
    }
}

pub(crate) fn vector<'g>(name: &str, unit: &str, values: Vec<Expr<'g>>) -> Output<Vec<Expr<'g>>> {
    Output {
        name: name.into(),
        doc: String::new(),
        unit: unit.into(),
        shape: vec![values.len()],
        values,
    }
}
