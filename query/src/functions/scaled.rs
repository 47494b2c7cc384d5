//! Columns in other units.

use std::sync::Arc;

use datafusion::arrow::array::{ArrayRef, Float64Array, ListArray};
use datafusion::arrow::buffer::{NullBuffer, OffsetBuffer};
use datafusion::arrow::datatypes::DataType;
use datafusion::error::Result;
use datafusion::logical_expr::{
    ColumnarValue, ScalarFunctionArgs, ScalarUDFImpl, Signature, Volatility,
};

use crate::columns::{BLOCK, Columns, doubles};
use crate::error::Error;

/// `scaled(factors, values …)`: a list of the entries of lists, structs or numbers, each multiplied by the factor
/// at its place in `factors`. If any value is null, the result is null.
#[derive(Debug, PartialEq, Eq, Hash)]
pub(super) struct Scaled {
    signature: Signature,
}

impl Scaled {
    pub(super) fn new() -> Scaled {
        Scaled { signature: Signature::variadic_any(Volatility::Immutable) }
    }
}

impl ScalarUDFImpl for Scaled {
    fn name(&self) -> &str {
        "scaled"
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType> {
        Ok(DataType::List(doubles()))
    }

    fn invoke_with_args(&self, arguments: ScalarFunctionArgs) -> Result<ColumnarValue> {
        let rows = arguments.number_rows;
        let arrays: Result<Vec<ArrayRef>> =
            arguments.args.into_iter().map(|one| one.into_array(rows)).collect();
        let arrays = arrays?;
        let (factors, values) = arrays.split_first().ok_or_else(|| {
            Error::Query("scaled needs a list of factors, then the values".to_owned())
        })?;
        let factors = Columns::of_all(std::slice::from_ref(factors), rows)?;
        let size = factors.entries();
        let wanted = format!("scaled with {size} factors");
        let values = Columns::new(values, rows, &[size], &wanted)?;
        let mut given = vec![0.0; size.max(values.entries()) * BLOCK];
        let mut times = vec![0.0; size * BLOCK];
        let mut found = vec![0.0; size * rows];
        for start in (0..rows).step_by(BLOCK) {
            let count = values.read(start, &mut given);
            factors.read(start, &mut times);
            for entry in 0..size {
                let places = found[start * size + entry..].iter_mut().step_by(size);
                let column = entry * BLOCK..entry * BLOCK + count;
                let products = given[column.clone()].iter().zip(&times[column]);
                places.zip(products).for_each(|(place, (value, factor))| *place = value * factor);
            }
        }
        let offsets = OffsetBuffer::from_lengths(std::iter::repeat_n(size, rows));
        let valid = NullBuffer::union(factors.valid(), values.valid());
        let found = Arc::new(Float64Array::new(found.into(), None));
        Ok(ColumnarValue::Array(Arc::new(ListArray::try_new(doubles(), offsets, found, valid)?)))
    }
}
