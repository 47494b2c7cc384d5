//! Limbs that are alike: parts on a fixed base that differ only in numbers.
//!
//! Here, a limb is a link on the base together with everything that it carries: a leg, a finger, or one of two arms. A
//! base at rest couples nothing, so the joint torques of a limb depend only on its own motion, and the placement of its
//! first link matters only through its orientation relative to gravity. Limbs that differ only in numbers, including
//! the signs of mirror images, are therefore described by one robot with parameters.

mod numbers;

use robot_model::robot::{Link, Parameter, Robot};
use robot_symbolic::{Formula, Rational};

use numbers::{Number, numbers};

/// A group of limbs that differ only in numbers.
#[derive(Clone, Debug)]
pub struct LikeLimbs {
    /// One of the limbs, alone on the base. The numbers in which the limbs differ are its parameters, whose nominal
    /// values are those of the first limb.
    pub robot: Robot,
    /// The limbs, in the order of the robot's links.
    pub limbs: Vec<Limb>,
}

/// A limb of a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Limb {
    /// The indices of its links, parents before children.
    pub links: Vec<usize>,
    /// The indices of its coordinates: coordinate i of [`LikeLimbs::robot`] is `coordinates[i]` of the whole robot.
    pub coordinates: Vec<usize>,
    /// The limb's values of the parameters of [`LikeLimbs::robot`].
    pub values: Vec<f64>,
}

/// The groups of limbs of a robot that differ only in numbers, in the order of their first links.
///
/// `None` if the robot has parameters, if a coordinate moves joints of several limbs, or if no two limbs are alike.
#[must_use]
pub fn like_limbs(robot: &Robot) -> Option<Vec<LikeLimbs>> {
    if !robot.parameters.is_empty() {
        return None;
    }
    let limbs: Vec<Limb> = limbs(robot);
    let coordinates: usize = limbs.iter().map(|limb| limb.coordinates.len()).sum();
    if coordinates != robot.coordinates.len() {
        return None;
    }
    let mut kinds: Vec<(Robot, Vec<(Limb, Robot)>)> = vec![];
    for limb in limbs {
        let alone = alone(robot, &limb);
        let pattern = pattern(&alone);
        match kinds.iter_mut().find(|(known, _)| *known == pattern) {
            Some((_, like)) => like.push((limb, alone)),
            None => kinds.push((pattern, vec![(limb, alone)])),
        }
    }
    let are_alike = kinds.iter().any(|(_, limbs)| limbs.len() > 1);
    are_alike.then(|| kinds.into_iter().map(|(_, limbs)| joined(limbs)).collect())
}

/// The limbs, without the values of parameters.
fn limbs(robot: &Robot) -> Vec<Limb> {
    let mut limbs: Vec<Limb> = vec![];
    let mut limb_of = vec![0; robot.links.len()];
    for (index, link) in robot.links.iter().enumerate() {
        limb_of[index] = link.parent.map_or(limbs.len(), |parent| limb_of[parent]);
        let coordinate = link.joint.coordinate;
        match limbs.get_mut(limb_of[index]) {
            Some(limb) => {
                limb.links.push(index);
                if !limb.coordinates.contains(&coordinate) {
                    limb.coordinates.push(coordinate);
                }
            }
            None => {
                limbs.push(Limb {
                    links: vec![index],
                    coordinates: vec![coordinate],
                    values: vec![],
                });
            }
        }
    }
    limbs
}

/// A limb as a separate robot, without the names and limits that distinguish it from other limbs.
fn alone(robot: &Robot, limb: &Limb) -> Robot {
    let place = |among: &[usize], index: usize| among.iter().position(|other| *other == index);
    let link = |(number, index): (usize, &usize)| {
        let mut link: Link = robot.links[*index].clone();
        link.name = format!("link {}", number + 1);
        link.joint.name.clone_from(&link.name);
        link.parent = link.parent.and_then(|parent| place(&limb.links, parent));
        link.joint.coordinate = place(&limb.coordinates, link.joint.coordinate).unwrap_or_default();
        for body in &mut link.bodies {
            body.name.clear();
        }
        link
    };
    let links: Vec<Link> = limb.links.iter().enumerate().map(link).collect();
    let coordinate = |(number, index): (usize, &usize)| {
        let mut coordinate = robot.coordinates[*index].clone();
        coordinate.joint = format!("joint {}", number + 1);
        coordinate.limits = None;
        coordinate
    };
    Robot {
        description: None,
        coordinates: limb.coordinates.iter().enumerate().map(coordinate).collect(),
        links,
        frames: vec![],
        dh: vec![],
        payload: None,
        ..robot.clone()
    }
}

/// A limb without the numbers in which similar limbs may differ.
fn pattern(limb: &Robot) -> Robot {
    let mut pattern = limb.clone();
    for (number, formula) in numbers(&mut pattern.links) {
        let value = formula.evaluate(|_| f64::NAN);
        // Equal numbers may be written in different ways.
        *formula = match number {
            Number::Shape => {
                Rational::from_f64(value).map_or(formula.clone(), |value| Formula::number(&value))
            }
            Number::Size => Formula::number(&Rational::ZERO),
        };
    }
    pattern
}

/// One robot for several limbs, in which the numbers that differ are parameters.
fn joined(limbs: Vec<(Limb, Robot)>) -> LikeLimbs {
    let (mut limbs, mut robots): (Vec<Limb>, Vec<Robot>) = limbs.into_iter().unzip();
    let values: Vec<Vec<f64>> = robots.iter_mut().map(values).collect();
    let mut robot = robots.swap_remove(0);
    for (index, (_, formula)) in numbers(&mut robot.links).into_iter().enumerate() {
        let of_limbs: Vec<f64> = values.iter().map(|values| values[index]).collect();
        let differ = of_limbs.iter().any(|value| *value != of_limbs[0]);
        if differ {
            let name = format!("limb_{}", robot.parameters.len() + 1);
            *formula = Formula::symbol(&name);
            robot.parameters.push(parameter(name, of_limbs[0]));
            for (limb, value) in limbs.iter_mut().zip(of_limbs) {
                limb.values.push(value);
            }
        }
    }
    LikeLimbs { robot, limbs }
}

fn values(limb: &mut Robot) -> Vec<f64> {
    let numbers = numbers(&mut limb.links).into_iter();
    numbers.map(|(_, formula)| formula.evaluate(|_| f64::NAN)).collect()
}

fn parameter(name: String, value: f64) -> Parameter {
    Parameter { name, value: Rational::from_f64(value), unit: None, latex: None, doc: None }
}
