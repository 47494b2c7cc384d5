//! SQL functions for the functions of a robot that are derived.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use datafusion::arrow::array::ArrayRef;
use datafusion::arrow::datatypes::{DataType, Field, FieldRef};
use datafusion::common::internal_err;
use datafusion::error::Result;
use datafusion::logical_expr::{
    ColumnarValue, ReturnFieldArgs, ScalarFunctionArgs, ScalarUDFImpl, Signature, Volatility,
};
use robot_build::FunctionKind;
use robot_jit::Handle;

use super::literal::robot_of;
use super::output::{array_of, type_of};
use crate::columns::{BLOCK, Columns};
use crate::error::Error;
use crate::robots::{Model, Robots};

/// `NAME(robot, inputs …)`: the robot is a literal, and each input is a list, a struct or numbers. If any value is
/// null, the result is null.
#[derive(Debug)]
pub(crate) struct Dynamics {
    kind: FunctionKind,
    robots: Arc<Robots>,
    signature: Signature,
}

impl Dynamics {
    pub(crate) fn new(kind: FunctionKind, robots: Arc<Robots>) -> Dynamics {
        Dynamics { kind, robots, signature: Signature::variadic_any(Volatility::Immutable) }
    }
}

impl PartialEq for Dynamics {
    fn eq(&self, other: &Dynamics) -> bool {
        self.kind == other.kind && Arc::ptr_eq(&self.robots, &other.robots)
    }
}

impl Eq for Dynamics {}

impl Hash for Dynamics {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.kind.hash(state);
    }
}

impl ScalarUDFImpl for Dynamics {
    fn name(&self) -> &str {
        self.kind.name()
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType> {
        internal_err!("the type of {} depends on the robot", self.name())
    }

    fn return_field_from_args(&self, arguments: ReturnFieldArgs) -> Result<FieldRef> {
        let first = arguments.scalar_arguments.first().copied().flatten();
        let model = robot_of(self.name(), first, &self.robots)?;
        let compiled = model.compiled(self.kind)?;
        let handle = function(&compiled.executable, self.kind)?;
        Ok(Arc::new(Field::new(self.name(), type_of(handle.outputs()), true)))
    }

    fn invoke_with_args(&self, arguments: ScalarFunctionArgs) -> Result<ColumnarValue> {
        let call = Call::new(self.name(), arguments, &self.robots)?;
        let compiled = call.model.compiled(self.kind)?;
        let handle = function(&compiled.executable, self.kind)?;
        let columns = call.columns(handle.input_size())?;
        let array = computed(handle, &columns)?;
        Ok(ColumnarValue::Array(array))
    }
}

/// The single function of an executable.
pub(crate) fn function<'e>(
    executable: &'e robot_jit::Executable<'static>,
    kind: FunctionKind,
) -> Result<Handle<'e>, Error> {
    executable.function(kind.name()).map_err(|error| Error::Query(error.to_string()))
}

/// The arguments of a call: the robot and the others.
pub(super) struct Call {
    pub(super) model: Arc<Model>,
    arrays: Vec<ArrayRef>,
    rows: usize,
    name: String,
}

impl Call {
    pub(super) fn new(name: &str, arguments: ScalarFunctionArgs, robots: &Robots) -> Result<Call> {
        let rows = arguments.number_rows;
        let mut arguments = arguments.args.into_iter();
        let model = match arguments.next() {
            Some(ColumnarValue::Scalar(literal)) => robot_of(name, Some(&literal), robots)?,
            _ => robot_of(name, None, robots)?,
        };
        let arrays: Result<Vec<ArrayRef>> = arguments.map(|one| one.into_array(rows)).collect();
        Ok(Call { model, arrays: arrays?, rows, name: name.to_owned() })
    }

    /// The columns of the arguments, which must have this number of entries.
    pub(super) fn columns(&self, entries: usize) -> Result<Columns, Error> {
        let (robot, joints) = (&self.model.robot.name, self.model.joints());
        let wanted = format!("{} of {robot}, with {joints} joints,", self.name);
        Columns::new(&self.arrays, self.rows, &[entries], &wanted)
    }
}

/// Computes all rows, a block at a time.
fn computed(handle: Handle<'_>, columns: &Columns) -> Result<ArrayRef> {
    let rows = columns.rows();
    let outputs = handle.outputs();
    let sizes: Vec<usize> = outputs.iter().map(|output| output.len()).collect();
    let mut values: Vec<Vec<f64>> = sizes.iter().map(|size| vec![0.0; rows * size]).collect();
    each_block(handle, columns, |start, count, found| {
        let mut found = found.chunks_exact(BLOCK);
        for (size, values) in sizes.iter().zip(&mut values) {
            let values = &mut values[start * size..(start + count) * size];
            for (entry, column) in (0..*size).zip(&mut found) {
                let places = values[entry..].iter_mut().step_by(*size);
                places.zip(column).for_each(|(place, value)| *place = *value);
            }
        }
    })?;
    array_of(outputs, values, columns.valid(), rows)
}

/// Calls a function for all rows. `take` receives the first row of a block, its number of rows, and the columns of
/// all outputs, of [`BLOCK`] rows each.
pub(super) fn each_block(
    handle: Handle<'_>,
    columns: &Columns,
    mut take: impl FnMut(usize, usize, &[f64]),
) -> Result<()> {
    let mut room = vec![0.0; columns.entries() * BLOCK];
    let mut found = vec![0.0; handle.output_size() * BLOCK];
    for start in (0..columns.rows()).step_by(BLOCK) {
        let rows = BLOCK.min(columns.rows() - start);
        let inputs = columns.block(start, &mut room);
        call(handle, &inputs, &mut found, rows)?;
        take(start, rows, &found);
    }
    Ok(())
}

/// Calls a function for the first rows of columns of [`BLOCK`] rows each. Columns that are not inputs of the
/// function are not read.
pub(crate) fn compute(
    handle: Handle<'_>,
    given: &[f64],
    found: &mut [f64],
    rows: usize,
) -> Result<(), Error> {
    let inputs: Vec<&[f64]> =
        given.chunks_exact(BLOCK).take(handle.input_size()).map(|column| &column[..rows]).collect();
    call(handle, &inputs, found, rows)
}

/// Calls a function for rows of its inputs, one slice for each input, and writes the first rows of columns of
/// [`BLOCK`] rows each.
fn call(
    handle: Handle<'_>,
    inputs: &[&[f64]],
    found: &mut [f64],
    rows: usize,
) -> Result<(), Error> {
    let mut outputs: Vec<&mut [f64]> =
        found.chunks_exact_mut(BLOCK).map(|column| &mut column[..rows]).collect();
    handle.columns(inputs, &mut outputs).map_err(|error| Error::Query(error.to_string()))
}
