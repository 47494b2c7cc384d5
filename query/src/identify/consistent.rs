//! Physically possible standard parameters that explain the measurements.
//!
//! The ten parameters of a link are those of a rigid body if and only if its pseudo-inertia [[Σ, h], [hᵀ, m]] is
//! positive definite, with Σ = ½ tr(I) 1 − I (P. M. Wensing, S. Kim, J.-J. E. Slotine, Linear matrix inequalities
//! for physically consistent inertial parameter identification, 2018). Friction and reflected inertias must be
//! positive. Least squares under these conditions is a convex problem, which is solved by a barrier method with
//! Newton's steps (S. Boyd, L. Vandenberghe, Convex optimization, 2004, chapter 11). Estimates have about a hundred
//! parameters at most, so a barrier method needs neither a sparse solver nor LAPACK.

use nalgebra::{DMatrix, DVector, Matrix4};
use robot_dynamics::base_parameters::Quantity;
use robot_model::robot::LINK_PARAMETERS;

use super::estimate::Estimate;
use super::parameters::Parameters;
use crate::error::Error;
use crate::robots::Model;

/// The weight of the distance from the robot file, relative to measurements in units of their noise: that of a
/// value that is known to 100 times its size. It determines the parameters that the measurements do not.
const PRIOR: f64 = 1e-4;

/// The iteration ends when the barrier changes half the sum of squares by no more than this.
const GAP: f64 = 1e-4;

/// The steps for a weight end when another step would lower the function by less than this fraction of the weight.
const CENTERED: f64 = 1e-3;

/// The most Newton steps.
const MOST_STEPS: usize = 500;

/// Physically possible standard parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Consistent {
    /// π: ten parameters of each link, then those of drives, in the order of the full regressor.
    pub values: Vec<f64>,
    /// β = B π.
    pub base: Vec<f64>,
    /// Whether β is the estimate itself, which is then physically possible.
    pub is_estimate: bool,
    /// The factor by which the root mean square of all residuals, in units of their noise, exceeds that of the
    /// estimate.
    pub growth: f64,
}

impl Estimate {
    /// The physically possible standard parameters that explain the measurements best and, of these, are nearest to
    /// those of the robot file.
    ///
    /// # Errors
    ///
    /// A robot that is not that of the estimate; a robot whose base parameters cannot be derived.
    pub fn consistent(&self, model: &Model) -> Result<Consistent, Error> {
        let parameters = Parameters::of(model)?;
        if parameters.names != self.names {
            return Err(Error::Identification(format!(
                "the estimate is of {}, whose base parameters are not those of {}",
                self.robot, model.robot.name
            )));
        }
        let estimate = DVector::from_column_slice(&self.values);
        let problem = Problem::new(self, &parameters, &estimate)?;
        let found = problem.minimum()?;
        let moved = with_base(&parameters, &problem.sizes, &found, &estimate);
        let is_estimate = moved.as_ref().is_some_and(|moved| problem.is_inside(moved));
        let values = moved.filter(|_| is_estimate).unwrap_or(found);
        let base = &parameters.regrouping * &values;
        let growth = if is_estimate { 1.0 } else { self.growth(&base) };
        Ok(Consistent {
            values: values.as_slice().to_vec(),
            base: base.as_slice().to_vec(),
            is_estimate,
            growth,
        })
    }

    /// The factor by which the residuals for other base parameters exceed those for the estimate.
    fn growth(&self, base: &DVector<f64>) -> f64 {
        let square = |values: &[f64]| -> f64 {
            let rows = self.explained(values);
            rows.into_iter().map(|(explained, torque)| (torque - explained).powi(2)).sum()
        };
        let (there, here) = (square(base.as_slice()), square(&self.values));
        if there > here { (there / here).sqrt() } else { 1.0 }
    }
}

/// The problem min ½ ‖R B (π − π̂)‖² / s² + ½ ε ‖D (π − π₀)‖² over π with positive definite pseudo-inertias, in the
/// variable x = D π. B π̂ is the estimate, so the first term is the growth of the sum of squares from there.
struct Problem {
    /// R B D⁻¹ / s.
    map: DMatrix<f64>,
    /// The curvature of the function without the barrier.
    curvature: DMatrix<f64>,
    /// x̂ and x₀.
    estimate: DVector<f64>,
    nominal: DVector<f64>,
    /// 1/D.
    sizes: DVector<f64>,
    links: usize,
    /// The drives' parameters that must be positive.
    positive: Vec<usize>,
}

impl Problem {
    fn new(
        estimate: &Estimate,
        parameters: &Parameters,
        base: &DVector<f64>,
    ) -> Result<Problem, Error> {
        let count = parameters.standard.len();
        let mut triangle = DMatrix::zeros(base.len(), base.len());
        let mut packed = estimate.triangle.iter();
        for row in 0..base.len() {
            for column in row..base.len() {
                triangle[(row, column)] = packed.next().copied().unwrap_or(0.0);
            }
            // The entry of the torque.
            packed.next();
        }
        let is_link = |place: usize| {
            matches!(parameters.standard[place].quantity, Quantity::Link(_) | Quantity::Moment(_))
        };
        let links = (0..count).filter(|place| is_link(*place)).count() / LINK_PARAMETERS;
        let sizes = sizes(&parameters.values, links);
        let scale = if estimate.scale > 0.0 { estimate.scale } else { 1.0 };
        let map = triangle * &parameters.regrouping * DMatrix::from_diagonal(&sizes) / scale;
        let failed =
            || Error::Identification("the base parameters depend on one another".to_owned());
        let found = with_base(parameters, &sizes, &parameters.values, base).ok_or_else(failed)?;
        let curvature = map.tr_mul(&map) + DMatrix::identity(count, count) * PRIOR;
        let is_positive = |place: &usize| {
            let quantity = parameters.standard[*place].quantity;
            let is_free = matches!(quantity, Quantity::Offset | Quantity::RotorCoupling);
            !is_link(*place) && !is_free
        };
        Ok(Problem {
            positive: (0..count).filter(is_positive).collect(),
            estimate: found.component_div(&sizes),
            nominal: parameters.values.component_div(&sizes),
            map,
            curvature,
            sizes,
            links,
        })
    }

    /// A point at which the barrier is finite: the values of the robot file, with additional mass if necessary.
    fn interior(&self) -> DVector<f64> {
        let mut point = self.nominal.clone();
        for place in &self.positive {
            point[*place] = point[*place].max(1e-3);
        }
        let mut added = 0.0;
        while !self.is_inside(&point.component_mul(&self.sizes)) && added < 1e6 {
            added = if added == 0.0 { 1e-4 } else { 2.0 * added };
            for link in 0..self.links {
                // The added body consists of points on all axes: m, I_xx, I_yy, I_zz.
                for (entry, weight) in [(0, 1.0), (4, 2.0), (6, 2.0), (9, 2.0)] {
                    let place = link * LINK_PARAMETERS + entry;
                    point[place] = self.nominal[place] + weight * added;
                }
            }
        }
        point
    }

    /// Whether standard parameters are physically possible.
    fn is_inside(&self, values: &DVector<f64>) -> bool {
        let links = (0..self.links).all(|link| pseudo_inertia(values, link).cholesky().is_some());
        links && self.positive.iter().all(|place| values[*place] > 0.0)
    }

    /// Minimizes the function by Newton's steps for a barrier with decreasing weight.
    fn minimum(&self) -> Result<DVector<f64>, Error> {
        let mut point = self.interior();
        let conditions = 4 * self.links + self.positive.len();
        let mut weight = 1.0;
        let failed = || {
            Error::Identification("the physically consistent estimate does not converge".to_owned())
        };
        for _ in 0..MOST_STEPS {
            let (slope, curvature) = self.derivatives(&point, weight).ok_or_else(failed)?;
            let step = curvature.cholesky().ok_or_else(failed)?.solve(&-&slope);
            let decrement = -slope.dot(&step);
            if decrement < CENTERED * weight {
                if weight * conditions as f64 <= GAP {
                    return Ok(point.component_mul(&self.sizes));
                }
                weight *= 0.2;
                continue;
            }
            point = self.searched(&point, &step, -decrement, weight).ok_or_else(failed)?;
        }
        Err(failed())
    }

    /// A point along a step at which the function has decreased enough (Armijo's rule).
    fn searched(
        &self,
        point: &DVector<f64>,
        step: &DVector<f64>,
        slope: f64,
        weight: f64,
    ) -> Option<DVector<f64>> {
        let here = self.value(point, weight)?;
        let mut length = 1.0;
        for _ in 0..60 {
            let next = point + step * length;
            let rounding = 1e-12 * here.abs();
            let fallen = self.value(&next, weight);
            if fallen.is_some_and(|value| value <= here + 0.1 * length * slope + rounding) {
                return Some(next);
            }
            length *= 0.5;
        }
        None
    }

    fn value(&self, point: &DVector<f64>, weight: f64) -> Option<f64> {
        let values = point.component_mul(&self.sizes);
        let mut barrier = 0.0;
        for link in 0..self.links {
            let root = pseudo_inertia(&values, link).cholesky()?;
            barrier -= root.l_dirty().diagonal().iter().map(|entry| 2.0 * entry.ln()).sum::<f64>();
        }
        for place in &self.positive {
            if values[*place] <= 0.0 {
                return None;
            }
            barrier -= values[*place].ln();
        }
        let squares = (&self.map * (point - &self.estimate)).norm_squared();
        let moved = (point - &self.nominal).norm_squared();
        Some(0.5 * squares + 0.5 * PRIOR * moved + weight * barrier)
    }

    fn derivatives(
        &self,
        point: &DVector<f64>,
        weight: f64,
    ) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let values = point.component_mul(&self.sizes);
        let mut slope = self.map.tr_mul(&(&self.map * (point - &self.estimate)));
        slope += (point - &self.nominal) * PRIOR;
        let mut curvature = self.curvature.clone();
        for link in 0..self.links {
            let inverse = pseudo_inertia(&values, link).try_inverse()?;
            let first = link * LINK_PARAMETERS;
            let parts: Vec<Matrix4<f64>> = (0..LINK_PARAMETERS)
                .map(|entry| inverse * direction(entry) * self.sizes[first + entry])
                .collect();
            for (row, part) in parts.iter().enumerate() {
                slope[first + row] -= weight * part.trace();
                for (column, other) in parts.iter().enumerate() {
                    curvature[(first + row, first + column)] += weight * (part * other).trace();
                }
            }
        }
        for place in &self.positive {
            slope[*place] -= weight / point[*place];
            curvature[(*place, *place)] += weight / point[*place].powi(2);
        }
        Some((slope, curvature))
    }
}

/// The standard parameters with the given base parameters that are nearest to `near`, in units of `sizes`.
fn with_base(
    parameters: &Parameters,
    sizes: &DVector<f64>,
    near: &DVector<f64>,
    base: &DVector<f64>,
) -> Option<DVector<f64>> {
    let weights = DMatrix::from_diagonal(&sizes.component_mul(sizes));
    let across = weights * parameters.regrouping.transpose();
    let gram = &parameters.regrouping * &across;
    let missing = base - &parameters.regrouping * near;
    Some(near + across * gram.cholesky()?.solve(&missing))
}

/// The unit of each standard parameter: for a link its mass m, the largest J of its moments of inertia, and √(m J)
/// for its first moments; for a drive the value itself.
fn sizes(values: &DVector<f64>, links: usize) -> DVector<f64> {
    let largest = |places: std::ops::Range<usize>| {
        places.map(|place| values[place].abs()).fold(0.0, f64::max)
    };
    let or_one = |size: f64| if size > 0.0 { size } else { 1.0 };
    let mut sizes = values.map(|value| or_one(value.abs()));
    for link in 0..links {
        let first = link * LINK_PARAMETERS;
        let mass = or_one(largest(first..first + 1));
        let moment = or_one(largest(first + 4..first + LINK_PARAMETERS));
        sizes[first] = mass;
        (1..4).for_each(|entry| sizes[first + entry] = (mass * moment).sqrt());
        (4..LINK_PARAMETERS).for_each(|entry| sizes[first + entry] = moment);
    }
    sizes
}

/// The derivative of the pseudo-inertia with respect to a parameter of the link, in the order m, h, I_xx, I_xy,
/// I_yy, I_xz, I_yz, I_zz.
fn direction(entry: usize) -> Matrix4<f64> {
    let mut found = Matrix4::zeros();
    match entry {
        0 => found[(3, 3)] = 1.0,
        1..=3 => {
            found[(entry - 1, 3)] = 1.0;
            found[(3, entry - 1)] = 1.0;
        }
        4 | 6 | 9 => {
            let own = [4, 6, 9].iter().position(|other| *other == entry).unwrap_or(0);
            (0..3).for_each(|axis| found[(axis, axis)] = if axis == own { -0.5 } else { 0.5 });
        }
        _ => {
            let (row, column) = [(0, 1), (0, 2), (1, 2)][match entry {
                5 => 0,
                7 => 1,
                _ => 2,
            }];
            found[(row, column)] = -1.0;
            found[(column, row)] = -1.0;
        }
    }
    found
}

fn pseudo_inertia(values: &DVector<f64>, link: usize) -> Matrix4<f64> {
    let first = link * LINK_PARAMETERS;
    (0..LINK_PARAMETERS).map(|entry| direction(entry) * values[first + entry]).sum()
}
