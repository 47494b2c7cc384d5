//! Estimates as SQL values: a struct of numbers and lists, the same for all robots.

use std::sync::Arc;

use datafusion::arrow::array::{
    Array, ArrayRef, AsArray, Float64Array, ListArray, StringArray, StructArray, UInt64Array,
};
use datafusion::arrow::buffer::OffsetBuffer;
use datafusion::arrow::datatypes::{DataType, Field, Fields, Float64Type, UInt64Type};
use datafusion::common::ScalarValue;
use datafusion::error::Result;

use super::estimate::{Estimate, Residual, Unidentifiable};
use crate::error::Error;

/// The fields of the struct.
fn fields() -> Fields {
    let numbers = || DataType::new_list(DataType::Float64, true);
    let texts = || DataType::new_list(DataType::Utf8, true);
    let fields = [
        ("robot", DataType::Utf8),
        ("rows", DataType::UInt64),
        ("excluded", DataType::UInt64),
        ("names", texts()),
        ("values", numbers()),
        ("deviations", numbers()),
        ("nominal", numbers()),
        ("covariance", numbers()),
        ("condition", DataType::Float64),
        ("rank", DataType::UInt64),
        ("scale", DataType::Float64),
        ("joints", texts()),
        ("residuals", numbers()),
        ("noise", numbers()),
        ("unidentifiable", texts()),
        ("together_with", texts()),
        ("fixed", texts()),
        ("triangle", numbers()),
    ];
    fields.into_iter().map(|(name, kind)| Field::new(name, kind, true)).collect()
}

/// The type of the result of `identify`.
pub(super) fn answer_type() -> DataType {
    DataType::Struct(fields())
}

/// The result if there are no rows: null.
pub(super) fn null_answer() -> Result<ScalarValue> {
    ScalarValue::try_from(&answer_type())
}

/// A list as the only row of a column.
fn row(values: ArrayRef) -> Result<ArrayRef> {
    let field = Arc::new(Field::new_list_field(values.data_type().clone(), true));
    let offsets = OffsetBuffer::from_lengths([values.len()]);
    Ok(Arc::new(ListArray::try_new(field, offsets, values, None)?))
}

fn numbers(values: impl IntoIterator<Item = Option<f64>>) -> Result<ArrayRef> {
    row(Arc::new(values.into_iter().collect::<Float64Array>()))
}

fn texts<T: AsRef<str>>(values: impl IntoIterator<Item = T>) -> Result<ArrayRef> {
    row(Arc::new(StringArray::from_iter_values(values)))
}

impl Estimate {
    /// The estimate as a struct.
    pub(super) fn scalar(&self) -> Result<ScalarValue> {
        let all = |values: &[f64]| numbers(values.iter().copied().map(Some));
        let count = |number: u64| -> ArrayRef { Arc::new(UInt64Array::from(vec![number])) };
        let number = |value: f64| -> ArrayRef { Arc::new(Float64Array::from(vec![value])) };
        let columns: Vec<ArrayRef> = vec![
            Arc::new(StringArray::from(vec![self.robot.clone()])),
            count(self.rows),
            count(self.excluded),
            texts(&self.names)?,
            all(&self.values)?,
            numbers(self.deviations.iter().copied())?,
            all(&self.nominal)?,
            all(&self.covariance)?,
            number(self.condition),
            count(self.rank as u64),
            number(self.scale),
            texts(self.joints.iter().map(|joint| &joint.name))?,
            numbers(self.joints.iter().map(|joint| Some(joint.rms)))?,
            numbers(self.joints.iter().map(|joint| joint.noise))?,
            texts(self.unidentifiable.iter().map(|one| &one.name))?,
            texts(self.unidentifiable.iter().map(|one| one.with.join(" ")))?,
            texts(&self.fixed)?,
            all(&self.triangle)?,
        ];
        Ok(ScalarValue::Struct(Arc::new(StructArray::try_new(fields(), columns, None)?)))
    }

    /// The estimate in a row of results; `None` if the row has none.
    ///
    /// # Errors
    ///
    /// An array that is not a result of `identify`.
    pub fn from_array(answers: &dyn Array, row: usize) -> Result<Option<Estimate>, Error> {
        let other = || Error::Query("this is not a result of identify".to_owned());
        let answers = answers.as_struct_opt().ok_or_else(other)?;
        if answers.fields() != &fields() || row >= answers.len() {
            return Err(other());
        }
        if answers.is_null(row) {
            return Ok(None);
        }
        let read = Answer { answers, row };
        let residuals = read.numbers("residuals").into_iter().flatten();
        let joints = read.texts("joints").into_iter().zip(residuals).zip(read.numbers("noise"));
        let acting = read.texts("together_with");
        let unidentifiable = read.texts("unidentifiable").into_iter().zip(acting);
        let all = |name| read.numbers(name).into_iter().flatten().collect();
        Ok(Some(Estimate {
            robot: read.text("robot"),
            names: read.texts("names"),
            values: all("values"),
            deviations: read.numbers("deviations"),
            nominal: all("nominal"),
            covariance: all("covariance"),
            condition: read.number("condition"),
            rank: read.count("rank") as usize,
            rows: read.count("rows"),
            excluded: read.count("excluded"),
            scale: read.number("scale"),
            joints: joints.map(|((name, rms), noise)| Residual { name, rms, noise }).collect(),
            unidentifiable: unidentifiable
                .map(|(name, with)| Unidentifiable {
                    name,
                    with: with.split_whitespace().map(str::to_owned).collect(),
                })
                .collect(),
            fixed: read.texts("fixed"),
            triangle: all("triangle"),
        }))
    }
}

/// A row of results, whose type has been checked.
struct Answer<'a> {
    answers: &'a StructArray,
    row: usize,
}

impl Answer<'_> {
    fn column(&self, name: &str) -> ArrayRef {
        let found = self.answers.column_by_name(name).cloned();
        found.unwrap_or_else(|| Arc::new(Float64Array::new_null(self.answers.len())))
    }

    fn text(&self, name: &str) -> String {
        self.column(name).as_string::<i32>().value(self.row).to_owned()
    }

    fn number(&self, name: &str) -> f64 {
        self.column(name).as_primitive::<Float64Type>().value(self.row)
    }

    fn count(&self, name: &str) -> u64 {
        self.column(name).as_primitive::<UInt64Type>().value(self.row)
    }

    fn numbers(&self, name: &str) -> Vec<Option<f64>> {
        let list = self.column(name).as_list::<i32>().value(self.row);
        list.as_primitive::<Float64Type>().iter().collect()
    }

    fn texts(&self, name: &str) -> Vec<String> {
        let list = self.column(name).as_list::<i32>().value(self.row);
        list.as_string::<i32>().iter().flatten().map(str::to_owned).collect()
    }
}
