//! Outputs of functions as arrays: a number, a list, or a list of the rows of a matrix. Several outputs are a
//! struct.

use std::sync::Arc;

use datafusion::arrow::array::{ArrayRef, FixedSizeListArray, Float64Array, StructArray};
use datafusion::arrow::buffer::NullBuffer;
use datafusion::arrow::datatypes::{DataType, Field, FieldRef, Fields};
use datafusion::error::Result;
use robot_codegen::Output;

/// The type of a function's result.
pub(super) fn type_of(outputs: &[Output]) -> DataType {
    match outputs {
        [output] => shaped(&output.shape),
        outputs => DataType::Struct(fields(outputs)),
    }
}

/// The result from the entries of all outputs, row by row for each output; null in rows that are not valid.
pub(super) fn array_of(
    outputs: &[Output],
    values: Vec<Vec<f64>>,
    valid: Option<&NullBuffer>,
    rows: usize,
) -> Result<ArrayRef> {
    let arrays = outputs.iter().zip(values);
    let arrays: Result<Vec<ArrayRef>> =
        arrays.map(|(output, values)| array(&output.shape, values, valid, rows)).collect();
    let mut arrays = arrays?;
    if outputs.len() == 1
        && let Some(array) = arrays.pop()
    {
        return Ok(array);
    }
    let structs = StructArray::try_new_with_length(fields(outputs), arrays, valid.cloned(), rows)?;
    Ok(Arc::new(structs))
}

fn fields(outputs: &[Output]) -> Fields {
    outputs.iter().map(|output| Field::new(&output.name, shaped(&output.shape), true)).collect()
}

fn shaped(shape: &[usize]) -> DataType {
    shape.iter().rev().fold(DataType::Float64, |inner, size| {
        DataType::FixedSizeList(item(inner), i32::try_from(*size).unwrap_or(i32::MAX))
    })
}

fn item(inner: DataType) -> FieldRef {
    Arc::new(Field::new_list_field(inner, true))
}

fn array(
    shape: &[usize],
    values: Vec<f64>,
    valid: Option<&NullBuffer>,
    rows: usize,
) -> Result<ArrayRef> {
    if shape.is_empty() {
        return Ok(Arc::new(Float64Array::new(values.into(), valid.cloned())));
    }
    let mut array: ArrayRef = Arc::new(Float64Array::new(values.into(), None));
    for (place, size) in shape.iter().enumerate().rev() {
        let length: usize = rows * shape[..place].iter().product::<usize>();
        let nulls = valid.filter(|_| place == 0).cloned();
        let size = i32::try_from(*size).unwrap_or(i32::MAX);
        let field = item(array.data_type().clone());
        let list = FixedSizeListArray::try_new_with_length(field, size, array, nulls, length)?;
        array = Arc::new(list);
    }
    Ok(array)
}
