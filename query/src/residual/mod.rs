//! Statistics of residuals.

mod figure;

use std::sync::Arc;

use datafusion::arrow::array::{Array, AsArray};
use datafusion::arrow::datatypes::Float64Type;
use datafusion::physical_plan::execute_stream;
use datafusion::prelude::DataFrame;
use futures::StreamExt;

use crate::error::Error;
use crate::log::Progress;
pub use figure::{Curve, Figure, Panel, figure};

/// The residuals of all joints over a log.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Residuals {
    /// The number of rows that are included.
    pub rows: u64,
    /// The number of rows that were omitted because a value is null, NaN or infinite.
    pub excluded: u64,
    /// Sum, sum of squares and largest absolute value for each joint.
    sums: Vec<[f64; 3]>,
}

/// The residual of a joint, N m or N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// The mean.
    pub mean: f64,
    /// The root mean square.
    pub rms: f64,
    /// The largest absolute value.
    pub largest: f64,
}

impl Residuals {
    /// The statistics of each joint.
    pub fn joints(&self) -> impl Iterator<Item = Statistics> + '_ {
        let rows = self.rows as f64;
        self.sums.iter().map(move |[sum, squares, largest]| Statistics {
            mean: sum / rows,
            rms: (squares / rows).sqrt(),
            largest: *largest,
        })
    }
}

/// Computes the residuals of a table whose only column contains them as lists; `rows` is the number of rows, if it
/// is known.
///
/// # Errors
///
/// Errors while the table is computed.
pub async fn statistics(table: DataFrame, rows: Option<u64>) -> Result<Residuals, Error> {
    let mut found = Residuals::default();
    let context = Arc::new(table.task_ctx());
    let plan = table.create_physical_plan().await?;
    let _progress = Progress::of(&plan, rows);
    let mut stream = execute_stream(plan, context)?;
    while let Some(batch) = stream.next().await {
        let batch = batch?;
        let other = || Error::Query("this is not a result of residual".to_owned());
        let lists = batch.column(0).as_fixed_size_list_opt().ok_or_else(other)?;
        let size = lists.value_length().unsigned_abs() as usize;
        found.sums.resize(size, [0.0; 3]);
        let values = lists.values().as_primitive_opt::<Float64Type>().ok_or_else(other)?.values();
        for (row, values) in values.chunks_exact(size.max(1)).enumerate() {
            if lists.is_null(row) || values.iter().any(|value| !value.is_finite()) {
                found.excluded += 1;
                continue;
            }
            found.rows += 1;
            for ([sum, squares, largest], value) in found.sums.iter_mut().zip(values) {
                *sum += value;
                *squares += value * value;
                *largest = largest.max(value.abs());
            }
        }
    }
    Ok(found)
}
