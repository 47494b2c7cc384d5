//! The columns of a log as columns of doubles, one for each entry of a function's inputs.

use datafusion::arrow::array::{Array, ArrayRef, AsArray, StructArray};
use datafusion::arrow::buffer::{NullBuffer, ScalarBuffer};
use datafusion::arrow::compute::cast;
use datafusion::arrow::datatypes::{DataType, Field, Float32Type, Float64Type};
use std::sync::Arc;

use crate::error::Error;

/// The number of rows that are copied into columns at once; they stay in the cache of level 1.
pub(crate) const BLOCK: usize = 128;

/// The inputs of a function over a batch of rows. A list is as many columns as it has entries, a struct is the
/// columns of its fields, and a number is one column.
#[derive(Debug)]
pub(crate) struct Columns {
    parts: Vec<Part>,
    /// The rows without nulls.
    valid: Option<NullBuffer>,
    rows: usize,
    entries: usize,
}

/// Columns that are stored in one buffer.
#[derive(Debug)]
struct Part {
    values: Values,
    starts: Starts,
    entries: usize,
}

/// The numbers of a log, in double or single precision.
#[derive(Debug)]
enum Values {
    Double(ScalarBuffer<f64>),
    Single(ScalarBuffer<f32>),
}

/// The positions in the buffer at which the entries of each row begin.
#[derive(Debug)]
enum Starts {
    /// At equal distances, with this number of entries in each row.
    Every(usize),
    /// At these offsets.
    At(ScalarBuffer<i32>),
}

impl Columns {
    /// Makes the columns of arguments, whose total number of entries must be one of `entries`; `wanted` names the
    /// function in messages.
    ///
    /// # Errors
    ///
    /// Another number of entries; values that are not numbers.
    pub(crate) fn new(
        arguments: &[ArrayRef],
        rows: usize,
        entries: &[usize],
        wanted: &str,
    ) -> Result<Columns, Error> {
        let least = entries.first().copied().unwrap_or(0);
        let mut columns = Columns { parts: vec![], valid: None, rows, entries: least };
        for argument in arguments {
            columns.push(argument)?;
        }
        let found: usize = columns.parts.iter().map(|part| part.entries).sum();
        if entries.contains(&found) {
            return Ok(Columns { entries: found, ..columns });
        }
        // If all rows are null, the length of their lists is unknown.
        if rows == 0 || columns.valid.as_ref().is_some_and(|valid| valid.null_count() == rows) {
            return Ok(columns);
        }
        let entries: Vec<String> = entries.iter().map(usize::to_string).collect();
        let entries = entries.join(" or ");
        Err(Error::Columns(format!("{found} entries are given, but {wanted} needs {entries}")))
    }

    /// Makes the columns of arguments with any number of entries.
    ///
    /// # Errors
    ///
    /// Values that are not numbers.
    pub(crate) fn of_all(arguments: &[ArrayRef], rows: usize) -> Result<Columns, Error> {
        let mut columns = Columns { parts: vec![], valid: None, rows, entries: 0 };
        arguments.iter().try_for_each(|argument| columns.push(argument))?;
        columns.entries = columns.parts.iter().map(|part| part.entries).sum();
        Ok(columns)
    }

    /// The rows without nulls; `None` if no row has a null.
    pub(crate) fn valid(&self) -> Option<&NullBuffer> {
        self.valid.as_ref()
    }

    fn push(&mut self, argument: &ArrayRef) -> Result<(), Error> {
        match argument.data_type() {
            DataType::Struct(_) => self.push_fields(argument.as_struct()),
            DataType::FixedSizeList(_, size) => self.push_fixed(argument, *size),
            DataType::List(_) | DataType::LargeList(_) | DataType::ListView(_) => {
                self.push_list(argument)
            }
            other if other.is_numeric() || other.is_null() => {
                let numbers = converted(argument, &precision(other))?;
                self.restrict(numbers.nulls());
                let values = Values::of(&numbers);
                self.parts.push(Part { values, starts: Starts::Every(1), entries: 1 });
                Ok(())
            }
            other => Err(Error::Columns(format!(
                "a column of type {other} is neither a number nor a list or struct of numbers"
            ))),
        }
    }

    fn push_fields(&mut self, fields: &StructArray) -> Result<(), Error> {
        self.restrict(fields.nulls());
        fields.columns().iter().try_for_each(|field| self.push(field))
    }

    fn push_fixed(&mut self, argument: &ArrayRef, size: i32) -> Result<(), Error> {
        let lists = converted(argument, &DataType::FixedSizeList(item(argument), size))?;
        let lists = lists.as_fixed_size_list();
        let size = size.unsigned_abs() as usize;
        self.restrict(lists.nulls());
        let numbers = lists.values();
        if let Some(nulls) = numbers.nulls() {
            let whole = |row: usize| (0..size).all(|entry| nulls.is_valid(row * size + entry));
            self.restrict(Some(&(0..self.rows).map(whole).collect()));
        }
        let values = Values::of(numbers);
        self.parts.push(Part { values, starts: Starts::Every(size), entries: size });
        Ok(())
    }

    fn push_list(&mut self, argument: &ArrayRef) -> Result<(), Error> {
        let lists = converted(argument, &DataType::List(item(argument)))?;
        let lists = lists.as_list::<i32>();
        self.restrict(lists.nulls());
        let numbers = lists.values();
        let offsets = lists.offsets();
        if let Some(nulls) = numbers.nulls() {
            let whole = |row: &[i32]| (row[0]..row[1]).all(|place| nulls.is_valid(place as usize));
            self.restrict(Some(&offsets.windows(2).map(whole).collect()));
        }
        let mut lengths = offsets.windows(2).enumerate();
        let mut entries = None;
        let is_valid = |row| self.valid.as_ref().is_none_or(|valid| valid.is_valid(row));
        let other = lengths.find_map(|(row, ends)| {
            let length = (ends[1] - ends[0]).unsigned_abs() as usize;
            let differs = is_valid(row) && *entries.get_or_insert(length) != length;
            differs.then_some((row, length))
        });
        if let (Some((row, length)), Some(first)) = (other, entries) {
            return Err(Error::Columns(format!(
                "lists of one column have {first} entries and, at row {row} of a batch, {length}"
            )));
        }
        let starts = Starts::At(offsets.inner().clone());
        let values = Values::of(numbers);
        self.parts.push(Part { values, starts, entries: entries.unwrap_or(0) });
        Ok(())
    }

    /// Marks the rows that are null there as invalid here, too.
    fn restrict(&mut self, valid: Option<&NullBuffer>) {
        self.valid = NullBuffer::union(self.valid.as_ref(), valid);
    }

    /// Copies rows from `start` on into columns of [`BLOCK`] rows each, one column after the other, and returns the
    /// number of rows. The values of rows with nulls are arbitrary.
    pub(crate) fn read(&self, start: usize, columns: &mut [f64]) -> usize {
        let rows = BLOCK.min(self.rows - start);
        let mut columns = columns.chunks_exact_mut(BLOCK);
        for part in &self.parts {
            for (entry, column) in (0..part.entries).zip(&mut columns) {
                part.read(start, entry, &mut column[..rows]);
            }
        }
        rows
    }

    /// Returns the rows from `start` on, at most [`BLOCK`] of them, as a slice for each column. Columns of doubles
    /// are slices of the log itself; other columns are copied into `room`, which has [`BLOCK`] places for each
    /// column. The values of rows with nulls are arbitrary.
    pub(crate) fn block<'a>(&'a self, start: usize, room: &'a mut [f64]) -> Vec<&'a [f64]> {
        let rows = BLOCK.min(self.rows - start);
        let mut room = room.chunks_exact_mut(BLOCK);
        let mut slices: Vec<&[f64]> = Vec::with_capacity(self.entries);
        for part in &self.parts {
            if let (Values::Double(values), Starts::Every(1)) = (&part.values, &part.starts) {
                slices.push(&values[start..start + rows]);
                continue;
            }
            for (entry, column) in (0..part.entries).zip(&mut room) {
                part.read(start, entry, &mut column[..rows]);
                slices.push(&column[..rows]);
            }
        }
        slices
    }

    /// The number of columns.
    pub(crate) fn entries(&self) -> usize {
        self.entries
    }

    /// The number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.rows
    }
}

impl Part {
    /// Reads an entry of the rows from `start` on. A null row may have no entries: its value is 0.
    fn read(&self, start: usize, entry: usize, column: &mut [f64]) {
        match &self.values {
            Values::Double(values) => self.starts.read(values, start, entry, column),
            Values::Single(values) => self.starts.read(values, start, entry, column),
        }
    }
}

impl Starts {
    fn read<T: Copy + Into<f64>>(
        &self,
        values: &[T],
        start: usize,
        entry: usize,
        column: &mut [f64],
    ) {
        match self {
            Starts::Every(size) => {
                let values = values[start * size..].chunks_exact(*size);
                column.iter_mut().zip(values).for_each(|(value, row)| *value = row[entry].into());
            }
            Starts::At(starts) => {
                let starts = starts[start..].windows(2);
                for (value, ends) in column.iter_mut().zip(starts) {
                    let place = ends[0].unsigned_abs() as usize + entry;
                    let is_there = place < ends[1].unsigned_abs() as usize;
                    *value = if is_there { values[place].into() } else { 0.0 };
                }
            }
        }
    }
}

impl Values {
    /// The values of an array of either precision.
    fn of(numbers: &ArrayRef) -> Values {
        match numbers.as_primitive_opt::<Float32Type>() {
            Some(numbers) => Values::Single(numbers.values().clone()),
            None => Values::Double(numbers.as_primitive::<Float64Type>().values().clone()),
        }
    }
}

/// The precision in which numbers of a type are read.
fn precision(kind: &DataType) -> DataType {
    if *kind == DataType::Float32 { DataType::Float32 } else { DataType::Float64 }
}

/// The field of the entries of lists, in the precision in which they are read.
fn item(lists: &ArrayRef) -> Arc<Field> {
    let kind = match lists.data_type() {
        DataType::FixedSizeList(item, _)
        | DataType::List(item)
        | DataType::LargeList(item)
        | DataType::ListView(item) => precision(item.data_type()),
        _ => DataType::Float64,
    };
    Arc::new(Field::new_list_field(kind, true))
}

/// The field of the entries of lists of doubles.
pub(crate) fn doubles() -> Arc<Field> {
    Arc::new(Field::new_list_field(DataType::Float64, true))
}

fn converted(array: &ArrayRef, wanted: &DataType) -> Result<ArrayRef, Error> {
    if array.data_type() == wanted {
        return Ok(array.clone());
    }
    cast(array, wanted).map_err(|error| Error::Columns(error.to_string()))
}
