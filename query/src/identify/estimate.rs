//! The estimate by least squares, from the triangles.

use nalgebra::{DMatrix, DVector};

use super::measurements::{Joint, Measurements};
use super::parameters::Parameters;
use super::prior::Placed;
use super::triangle::Triangle;
use crate::error::Error;
use crate::log::unit;

/// If the part of a column of length 1 that is orthogonal to the others is shorter than this, the column counts as
/// a combination of them. The triangle's rounding errors are about 10⁻¹⁴ of the columns.
const INDEPENDENT: f64 = 1e-11;

/// The coefficient in a combination above which a parameter is named.
const NAMED: f64 = 1e-6;

/// The maximum number of rounds in which noise and parameters are estimated in turn.
const MOST_ROUNDS: usize = 50;

/// The estimate of a robot's base parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// The name of the robot.
    pub robot: String,
    /// The names of the base parameters.
    pub names: Vec<String>,
    /// The estimates β; for parameters that are not identifiable, the values of the robot file.
    pub values: Vec<f64>,
    /// The standard deviations of the estimates; `None` for parameters that are not identifiable.
    pub deviations: Vec<Option<f64>>,
    /// The values of the robot file.
    pub nominal: Vec<f64>,
    /// The covariance of β, row by row; rows and columns of parameters that are not identifiable are 0.
    pub covariance: Vec<f64>,
    /// The ratio of the largest to the smallest singular value of the regressor over the identifiable parameters,
    /// with rows divided by their noise and columns scaled to length 1.
    pub condition: f64,
    /// The number of identifiable parameters.
    pub rank: usize,
    /// The number of rows of the log that were used.
    pub rows: u64,
    /// The number of rows that were omitted because a value is a NaN, an infinity or null.
    pub excluded: u64,
    /// √(χ²/degrees of freedom), the factor by which the deviations were multiplied; 1 if the noise has the given
    /// size.
    pub scale: f64,
    /// The joints, with the residuals of their torques.
    pub joints: Vec<Residual>,
    /// The parameters that are not identifiable.
    pub unidentifiable: Vec<Unidentifiable>,
    /// The names of the parameters that were fixed beforehand.
    pub fixed: Vec<String>,
    /// R of [Y τ], with rows divided by their noise, on and above the diagonal, row by row. It determines the
    /// estimates of all models that are linear in these columns. Priors are among the rows.
    pub triangle: Vec<f64>,
}

/// The residuals of the torques of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Residual {
    /// The name of the joint.
    pub name: String,
    /// The weighted root mean square, N m or N.
    pub rms: f64,
    /// The standard deviation of the noise by which the joint's rows were divided, N m or N; `None` if it was given
    /// with the rows.
    pub noise: Option<f64>,
}

/// A parameter that the log does not determine.
#[derive(Clone, Debug, PartialEq)]
pub struct Unidentifiable {
    /// Its name.
    pub name: String,
    /// The identifiable parameters with which it acts together; empty if it has no effect.
    pub with: Vec<String>,
}

impl Measurements {
    /// Estimates the parameters by weighted least squares. If noise was not given with the rows, that of each joint
    /// is estimated together with the parameters.
    ///
    /// # Errors
    ///
    /// Fewer rows than parameters; values that overflow; names in the prior that no parameter has; errors of
    /// [`Parameters::of`].
    pub(crate) fn estimate(&self) -> Result<Estimate, Error> {
        let parameters = Parameters::of(&self.model)?;
        self.check(&parameters)?;
        let prior = Placed::of(&self.prior, &parameters)?;
        let mut noise = vec![1.0; self.joints.len()];
        let mut solution = self.solve(&prior, &noise)?;
        for _ in 0..if self.weighted { 0 } else { MOST_ROUNDS } {
            let found = self.noise(&solution, &noise);
            let change = found.iter().zip(&noise).map(|(found, old)| (found / old - 1.0).abs());
            let change = change.fold(0.0, f64::max);
            noise = found;
            solution = self.solve(&prior, &noise)?;
            if change < 1e-13 {
                break;
            }
        }
        Ok(self.answer(&parameters, &prior, solution, &noise))
    }

    /// The condition number of the regressor with the noise of each joint; infinite if parameters are not
    /// identifiable.
    ///
    /// # Errors
    ///
    /// No parameter has an effect.
    pub(crate) fn condition(&self, noise: &[f64]) -> Result<f64, Error> {
        let solution = self.solve(&Placed::none(self.parameters()), noise)?;
        Ok(if solution.left.is_empty() { solution.condition } else { f64::INFINITY })
    }

    fn check(&self, parameters: &Parameters) -> Result<(), Error> {
        let count = parameters.names.len();
        if count != self.parameters() {
            let (found, derived) = (self.parameters(), count);
            return Err(Error::Identification(format!(
                "the regressor has {found} columns for {derived} base parameters; please report this"
            )));
        }
        if self.rows * (self.joints.len() as u64) <= count as u64 {
            return Err(Error::Identification(format!(
                "{} usable rows of {} joints do not determine {count} parameters ({} rows were left out, with a null, \
                 NaN or infinity)",
                self.rows,
                self.joints.len(),
                self.excluded
            )));
        }
        let mut entries = self.joints.iter().flat_map(|joint| joint.triangle.packed());
        if entries.any(|entry| !entry.is_finite()) {
            let reason = "values of the log are so large that their squares overflow; are their units right?";
            return Err(Error::Identification(reason.to_owned()));
        }
        Ok(())
    }

    /// The triangle of all joints over all parameters and the torque, with rows divided by their noise.
    fn stacked(&self, noise: &[f64]) -> Triangle {
        let mut all = Triangle::new(self.parameters() + 1);
        for (joint, noise) in self.joints.iter().zip(noise) {
            let size = joint.triangle.size();
            let mut places = vec![None; self.parameters() + 1];
            let torque = [self.parameters()];
            for (place, column) in joint.columns.iter().chain(&torque).enumerate() {
                places[*column] = Some(place);
            }
            all.fold_rows(size, |row, column| {
                places[column].map_or(0.0, |place| joint.triangle.get(row, place) / noise)
            });
        }
        all
    }

    /// The triangle of [`Measurements::stacked`], with priors as further rows.
    fn informed(&self, prior: &Placed, noise: &[f64]) -> Triangle {
        let mut all = self.stacked(noise);
        if prior.has_weights() {
            let count = self.parameters();
            let lengths = lengths(&all);
            let row = |weight: f64, row: usize, column: usize| match column {
                column if column == row => weight,
                column if column == count => weight * prior.expected[row],
                _ => 0.0,
            };
            all.fold_rows(count, |place, column| row(prior.ridge * lengths[place], place, column));
            all.fold_rows(count, |place, column| row(prior.weights[place], place, column));
        }
        all
    }

    fn solve(&self, prior: &Placed, noise: &[f64]) -> Result<Solution, Error> {
        let all = self.informed(prior, noise);
        let count = self.parameters();
        let nominal = &prior.expected;
        let is_free = |column: &usize| !prior.fixed.contains(column);
        let lengths = lengths(&all);
        let scales: Vec<f64> =
            lengths.iter().map(|length| if *length > 0.0 { 1.0 / length } else { 0.0 }).collect();
        let scaled = DMatrix::from_fn(count + 1, count, |row, column| {
            let is_there = row <= column && is_free(&column);
            if is_there { all.get(row, column) * scales[column] } else { 0.0 }
        });
        let (kept, left) = independent(scaled);
        if kept.is_empty() {
            let reason =
                "no parameter affects any torque in the log: all columns of the regressor are 0";
            return Err(Error::Identification(reason.to_owned()));
        }
        let rank = kept.len();
        let order: Vec<usize> = kept.iter().chain(&left).copied().collect();
        let scale = |place: usize| order.get(place).map_or(1.0, |column| scales[*column]);
        let mut sorted = Triangle::new(count + 1);
        sorted.fold_rows(count + 1, |row, place| {
            let column = order.get(place).copied().unwrap_or(count);
            if row > column { 0.0 } else { all.get(row, column) * scale(place) }
        });
        let entry =
            |row: usize, column: usize| if row > column { 0.0 } else { sorted.get(row, column) };
        let top = DMatrix::from_fn(rank, rank, entry);
        let right = DMatrix::from_fn(rank, left.len(), |row, place| entry(row, rank + place));
        // Parameters that are not identifiable keep the values of the robot file.
        let fixed = DVector::from_fn(left.len(), |place, _| {
            let scale = scales[left[place]];
            if scale > 0.0 { nominal[left[place]] / scale } else { 0.0 }
        });
        let torque = DVector::from_fn(rank, |row, _| sorted.get(row, count)) - &right * fixed;
        let failed = || Error::Identification("the triangle is singular".to_owned());
        let found = top.solve_upper_triangular(&torque).ok_or_else(failed)?;
        let inverse =
            top.solve_upper_triangular(&DMatrix::identity(rank, rank)).ok_or_else(failed)?;
        let together = top.solve_upper_triangular(&right).ok_or_else(failed)?;
        let singular = top.singular_values();
        let mut values = DVector::from_column_slice(nominal);
        let mut root = DMatrix::zeros(count, rank);
        for (place, column) in kept.iter().enumerate() {
            values[*column] = found[place] * scales[*column];
            root.row_mut(*column).copy_from(&(inverse.row(place) * scales[*column]));
        }
        let condition = singular.max() / singular.min();
        Ok(Solution { values, root, condition, kept, left, together, all })
    }

    /// The noise of the joints from the residuals of their torques, with the degrees of freedom that the parameters
    /// take away.
    fn noise(&self, solution: &Solution, noise: &[f64]) -> Vec<f64> {
        let rows = self.rows as f64;
        let torque = |joint: &Joint| {
            let last = joint.triangle.size() - 1;
            let squares = (0..=last).map(|row| joint.triangle.get(row, last).powi(2));
            (squares.sum::<f64>() / rows).sqrt()
        };
        let largest = self.joints.iter().map(torque).fold(0.0, f64::max);
        let least = if largest > 0.0 { 1e-12 * largest } else { 1.0 };
        let joints = self.joints.iter().zip(noise);
        let estimates = joints.map(|(joint, noise)| {
            let taken = joint.taken(&solution.root) / noise.powi(2);
            let degrees = (rows - taken).max(1.0);
            (joint.left(&solution.values) / degrees).sqrt().max(least)
        });
        estimates.collect()
    }

    fn answer(
        &self,
        parameters: &Parameters,
        prior: &Placed,
        solution: Solution,
        noise: &[f64],
    ) -> Estimate {
        let Solution { values, root, condition, kept, left, together, all } = solution;
        let joints = self.joints.iter().zip(noise);
        let squares: f64 = joints.map(|(joint, noise)| joint.left(&values) / noise.powi(2)).sum();
        let joints = self.joints.iter().zip(noise);
        // The number of identifiable parameters, reduced by the part that priors determine.
        let taken: f64 = joints.map(|(joint, noise)| joint.taken(&root) / noise.powi(2)).sum();
        let degrees = self.rows as f64 * self.joints.len() as f64 - taken;
        let scale = (squares / degrees).sqrt();
        let covariance = &root * root.transpose() * scale.powi(2);
        let deviation = |column: usize| covariance[(column, column)].sqrt();
        let is_kept = |column: &usize| kept.contains(column);
        let name = |column: usize| parameters.names[column].clone();
        let open = left.iter().enumerate().filter(|(_, column)| !prior.fixed.contains(column));
        let unidentifiable = open.map(|(place, column)| {
            let acting = together.column(place);
            let with = kept.iter().zip(acting.iter()).filter(|(_, share)| share.abs() > NAMED);
            Unidentifiable {
                name: name(*column),
                with: with.map(|(kept, _)| name(*kept)).collect(),
            }
        });
        let coordinates = &self.model.robot.coordinates;
        let residuals = self.joints.iter().zip(noise).zip(coordinates);
        let residuals = residuals.map(|((joint, noise), coordinate)| Residual {
            name: coordinate.joint.clone(),
            rms: (joint.left(&values) / joint.weight).sqrt(),
            noise: (!self.weighted).then_some(*noise),
        });
        Estimate {
            robot: self.model.robot.name.clone(),
            names: parameters.names.clone(),
            deviations: (0..values.len())
                .map(|column| is_kept(&column).then(|| deviation(column)))
                .collect(),
            values: values.as_slice().to_vec(),
            nominal: parameters.nominal.as_slice().to_vec(),
            covariance: covariance.as_slice().to_vec(),
            condition,
            rank: kept.len(),
            rows: self.rows,
            excluded: self.excluded,
            scale,
            joints: residuals.collect(),
            unidentifiable: unidentifiable.collect(),
            fixed: prior.fixed.iter().map(|column| name(*column)).collect(),
            triangle: all.packed().collect(),
        }
    }
}

impl Estimate {
    /// For each row of the triangle, the part of the torque that the base parameters explain, and the torque.
    pub(super) fn explained(&self, base: &[f64]) -> Vec<(f64, f64)> {
        let count = self.names.len();
        let mut packed = self.triangle.iter();
        let row = |row: usize| {
            let entries: Vec<f64> = packed.by_ref().take(count + 1 - row).copied().collect();
            let explained = entries.iter().zip(&base[row..]).map(|(r, value)| r * value).sum();
            (explained, entries.last().copied().unwrap_or(0.0))
        };
        (0..=count).map(row).collect()
    }

    /// The likely mistake in the units of the torques, from a comparison with the torques by the robot file along
    /// the log.
    #[must_use]
    pub fn unit(&self) -> Option<String> {
        let rows = self.explained(&self.nominal);
        let sum = |of: fn(f64, f64) -> f64| -> f64 { rows.iter().map(|(e, t)| of(*e, *t)).sum() };
        let (model, measured) = (sum(|explained, _| explained.powi(2)), sum(|_, tau| tau.powi(2)));
        let alike = sum(|explained, tau| explained * tau) / (model * measured).sqrt();
        unit(((measured / model).sqrt(), alike)).filter(|_| measured > 0.0)
    }
}

/// The lengths of the columns of a triangle except the last.
fn lengths(triangle: &Triangle) -> Vec<f64> {
    let square =
        |column: usize| -> f64 { (0..=column).map(|row| triangle.get(row, column).powi(2)).sum() };
    (0..triangle.size() - 1).map(|column| square(column).sqrt()).collect()
}

/// The solution of least squares with given noise.
struct Solution {
    values: DVector<f64>,
    /// A root of the covariance for the given noise, with a row for each parameter.
    root: DMatrix<f64>,
    condition: f64,
    /// The identifiable parameters, and the others.
    kept: Vec<usize>,
    left: Vec<usize>,
    /// Each of the others as a combination of the identifiable parameters, for columns of length 1.
    together: DMatrix<f64>,
    all: Triangle,
}

/// The columns that are independent of one another, and those that are combinations of them, both in order. All
/// columns have length 1 or are 0.
fn independent(columns: DMatrix<f64>) -> (Vec<usize>, Vec<usize>) {
    let count = columns.ncols();
    let pivoted = columns.col_piv_qr();
    let mut order = DMatrix::from_fn(1, count, |_, column| column);
    pivoted.p().permute_columns(&mut order);
    let diagonal = pivoted.r().diagonal();
    let rank = diagonal.iter().take_while(|entry| entry.abs() > INDEPENDENT).count();
    let mut kept: Vec<usize> = order.iter().take(rank).copied().collect();
    let mut left: Vec<usize> = order.iter().skip(rank).copied().collect();
    kept.sort_unstable();
    left.sort_unstable();
    (kept, left)
}

impl Joint {
    /// The sum of squares of the residuals of the joint's torques.
    fn left(&self, values: &DVector<f64>) -> f64 {
        let last = self.columns.len();
        let row = |row: usize| {
            let columns = self.columns.iter().enumerate().skip(row);
            let explained =
                columns.map(|(place, column)| self.triangle.get(row, place) * values[*column]);
            (self.triangle.get(row, last) - explained.sum::<f64>()).powi(2)
        };
        (0..=last).map(row).sum()
    }

    /// The trace of the joint's part of the projection on the columns: the degrees of freedom that the columns take
    /// from it.
    fn taken(&self, root: &DMatrix<f64>) -> f64 {
        let size = self.columns.len();
        let own = DMatrix::from_fn(size, root.ncols(), |place, column| {
            root[(self.columns[place], column)]
        });
        let triangle = DMatrix::from_fn(size, size, |row, column| {
            if row > column { 0.0 } else { self.triangle.get(row, column) }
        });
        (triangle * own).norm_squared()
    }
}
