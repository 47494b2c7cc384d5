//! `derivative` as a window function of SQL.

use std::sync::Arc;

use datafusion::arrow::array::{
    ArrayRef, FixedSizeListArray, Float64Array, ListArray, new_null_array,
};
use datafusion::arrow::buffer::{NullBuffer, OffsetBuffer};
use datafusion::arrow::datatypes::{DataType, Field, FieldRef};
use datafusion::common::ScalarValue;
use datafusion::error::Result;
use datafusion::logical_expr::function::{PartitionEvaluatorArgs, WindowUDFFieldArgs};
use datafusion::logical_expr::{PartitionEvaluator, Signature, Volatility, WindowUDFImpl};
use datafusion::physical_expr::PhysicalExpr;
use datafusion::physical_expr::expressions::Literal;

use super::cubic::{LEAST, Samples, derivatives};
use crate::columns::{BLOCK, Columns, doubles};
use crate::error::Error;

/// The number of samples of a window if the query does not set it.
const WINDOW: usize = 21;

/// `derivative(x, t, order [, window]) OVER (PARTITION BY episode ORDER BY t)`: the first or second time derivative
/// of a number or of a list, by cubics over `window` samples around each one. It is null if x or t is null, or if
/// an episode has fewer than four samples.
#[derive(Debug, PartialEq, Eq, Hash)]
pub(super) struct Derivative {
    signature: Signature,
}

impl Derivative {
    pub(super) fn new() -> Derivative {
        Derivative { signature: Signature::variadic_any(Volatility::Immutable) }
    }
}

impl WindowUDFImpl for Derivative {
    fn name(&self) -> &str {
        "derivative"
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn partition_evaluator(
        &self,
        arguments: PartitionEvaluatorArgs,
    ) -> Result<Box<dyn PartitionEvaluator>> {
        let [_, _, order, more @ ..] = arguments.input_exprs() else {
            return Err(usage().into());
        };
        let order = whole(order).filter(|order| (1..=2).contains(order)).ok_or_else(usage)?;
        let window = match more {
            [] => Some(WINDOW),
            [window] => whole(window).filter(|window| *window > LEAST),
            _ => None,
        };
        let window = window.ok_or_else(usage)?;
        let kind = arguments.input_fields().first().map(|field| field.data_type().clone());
        let kind = kind.map(|kind| type_of(&kind)).transpose()?.ok_or_else(usage)?;
        Ok(Box::new(Evaluator { order, window, kind }))
    }

    fn field(&self, arguments: WindowUDFFieldArgs) -> Result<FieldRef> {
        let first = arguments.get_input_field(0).ok_or_else(usage)?;
        Ok(Arc::new(Field::new(arguments.name(), type_of(first.data_type())?, true)))
    }
}

fn usage() -> Error {
    Error::Query(
        "derivative takes a number or a list, the time, the order (1 or 2) and optionally the number of samples in \
         a window (5 or more), as in derivative(q, t, 1, 21) OVER (PARTITION BY episode ORDER BY t)"
            .to_owned(),
    )
}

/// A literal number.
fn whole(argument: &Arc<dyn PhysicalExpr>) -> Option<usize> {
    match argument.downcast_ref::<Literal>()?.value().cast_to(&DataType::UInt64).ok()? {
        ScalarValue::UInt64(number) => number.and_then(|number| usize::try_from(number).ok()),
        _ => None,
    }
}

/// The type of the derivatives of values of a type.
fn type_of(values: &DataType) -> Result<DataType> {
    match values {
        DataType::FixedSizeList(_, size) => Ok(DataType::FixedSizeList(doubles(), *size)),
        DataType::List(_) | DataType::LargeList(_) | DataType::ListView(_) => {
            Ok(DataType::List(doubles()))
        }
        kind if kind.is_numeric() => Ok(DataType::Float64),
        _ => Err(usage().into()),
    }
}

/// Computes the derivatives of an episode.
#[derive(Debug)]
struct Evaluator {
    order: usize,
    window: usize,
    kind: DataType,
}

impl PartitionEvaluator for Evaluator {
    fn evaluate_all(&mut self, values: &[ArrayRef], rows: usize) -> Result<ArrayRef> {
        let arguments = values.get(..2).ok_or_else(usage)?;
        let columns = Columns::of_all(arguments, rows)?;
        let samples = samples(&columns)?;
        if samples.times.len() < LEAST {
            return Ok(new_null_array(&self.kind, rows));
        }
        let found = derivatives(&samples, self.window);
        let joints = &found[self.order - 1];
        let entries = joints.len();
        let mut values = vec![0.0; rows * entries];
        let valid = |row: usize| columns.valid().is_none_or(|valid| valid.is_valid(row));
        for (place, row) in (0..rows).filter(|row| valid(*row)).enumerate() {
            let own = values.iter_mut().skip(row * entries).take(entries);
            own.zip(joints).for_each(|(value, joint)| *value = joint[place]);
        }
        self.array(values, entries, columns.valid().cloned())
    }
}

impl Evaluator {
    fn array(
        &self,
        values: Vec<f64>,
        entries: usize,
        valid: Option<NullBuffer>,
    ) -> Result<ArrayRef> {
        let rows = values.len() / entries.max(1);
        let array = |valid| Arc::new(Float64Array::new(values.into(), valid));
        Ok(match &self.kind {
            DataType::FixedSizeList(field, size) => {
                Arc::new(FixedSizeListArray::try_new(field.clone(), *size, array(None), valid)?)
            }
            DataType::List(field) => {
                let offsets = OffsetBuffer::from_repeated_length(entries, rows);
                Arc::new(ListArray::try_new(field.clone(), offsets, array(None), valid)?)
            }
            _ => array(valid),
        })
    }
}

/// The samples of the rows without nulls; the last column contains the times.
fn samples(columns: &Columns) -> Result<Samples, Error> {
    let joints = columns.entries().saturating_sub(1);
    let mut samples = Samples { times: vec![], positions: vec![vec![]; joints] };
    let mut block = vec![0.0; columns.entries() * BLOCK];
    for start in (0..columns.rows()).step_by(BLOCK) {
        let rows = columns.read(start, &mut block);
        let valid = |row: &usize| columns.valid().is_none_or(|valid| valid.is_valid(start + row));
        for row in (0..rows).filter(valid) {
            let time = block[joints * BLOCK + row];
            if let Some(last) = samples
                .times
                .last()
                .filter(|last| time.partial_cmp(last) != Some(std::cmp::Ordering::Greater))
            {
                return Err(Error::Query(format!(
                    "derivative: time {time} comes after time {last}, and times must increase; write OVER (PARTITION BY the \
                     episode ORDER BY the time), and remove rows with repeated times"
                )));
            }
            samples.times.push(time);
            for (joint, column) in samples.positions.iter_mut().enumerate() {
                column.push(block[joint * BLOCK + row]);
            }
        }
    }
    Ok(samples)
}
