//! Functions that run over tables of states.

use numpy::{PyArray1, PyArrayMethods};
use pyo3::buffer::PyBuffer;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use robot_codegen::{Errors, Module, Trigonometry};
use robot_jit::{Executable, Handle};

use crate::strided::Table;
use crate::wrong;

/// The number of states that are copied into columns at once; they stay in the cache of level 1.
const BLOCK: usize = 64;

/// A function as machine code, or interpreted if there is no machine code for the processor.
#[pyclass(frozen)]
pub(crate) struct Engine {
    executable: Executable<'static>,
    /// The name of the function.
    name: String,
}

impl Engine {
    /// Makes the first function of a module, with the given parameters.
    pub(crate) fn new(module: &Module, given: &[(String, f64)]) -> Result<Engine, String> {
        let given: Vec<(&str, f64)> =
            given.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let function = module.functions.first().ok_or("the robot has no function")?;
        let name = function.name.clone();
        let executable = Executable::owned(module.clone(), &given, Trigonometry::default())
            .map_err(|errors| errors.to_string())?;
        Ok(Engine { executable, name })
    }

    fn handle(&self) -> PyResult<Handle<'_>> {
        self.executable.function(&self.name).map_err(wrong)
    }
}

#[pymethods]
impl Engine {
    /// Whether the function is machine code.
    #[getter]
    fn is_native(&self) -> PyResult<bool> {
        Ok(self.handle()?.is_native())
    }

    /// Computes one state from a tuple of one-dimensional arrays of doubles, one for each input; returns the
    /// output, or a tuple of all outputs. Returns None if the arguments have another form: Python then checks them
    /// in detail.
    fn state<'py>(
        &self,
        py: Python<'py>,
        given: &Bound<'py, PyTuple>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let handle = self.handle()?;
        if given.len() != handle.inputs().len() {
            return Ok(None);
        }
        let mut entries = Vec::with_capacity(handle.input_size());
        for (array, input) in given.iter_borrowed().zip(handle.inputs()) {
            let Ok(array) = array.cast::<PyArray1<f64>>() else { return Ok(None) };
            let table = Table::state(&array);
            if table.entries() != input.symbols.len() {
                return Ok(None);
            }
            entries.extend((0..table.entries()).map(|entry| table.read(0, entry)));
        }
        let mut found = vec![0.0; handle.output_size()];
        handle.entries(&entries, &mut found).map_err(wrong)?;
        let mut rest = found.as_slice();
        let mut made = Vec::with_capacity(handle.outputs().len());
        for output in handle.outputs() {
            let (values, after) = rest.split_at(output.len());
            made.push(array_of(py, values, &output.shape)?);
            rest = after;
        }
        let single = if made.len() == 1 { made.pop() } else { None };
        Ok(Some(match single {
            Some(output) => output,
            None => PyTuple::new(py, made)?.into_any(),
        }))
    }

    /// Computes all states, from tables (states, entries) of the inputs into tables of the outputs, in their order.
    fn call(
        &self,
        py: Python<'_>,
        inputs: Vec<PyBuffer<f64>>,
        outputs: Vec<PyBuffer<f64>>,
        threads: usize,
    ) -> PyResult<()> {
        let handle = self.handle()?;
        let tables = |buffers: &[PyBuffer<f64>], writes: bool| -> PyResult<Vec<Table>> {
            buffers.iter().map(|buffer| Table::new(buffer, writes)).collect()
        };
        let (inputs, outputs) = (tables(&inputs, false)?, tables(&outputs, true)?);
        let states = outputs.first().map_or(0, |table| table.states());
        if inputs.iter().chain(&outputs).any(|table| table.states() != states) {
            return Err(wrong("the arrays differ in their numbers of states"));
        }
        let entries = |tables: &[Table]| tables.iter().map(|table| table.entries()).sum::<usize>();
        let (given, found) = (entries(&inputs), entries(&outputs));
        let (wanted, made) = (handle.input_size(), handle.output_size());
        if (given, found) != (wanted, made) {
            return Err(wrong(format!("{given} and {found} entries, not {wanted} and {made}")));
        }
        let task = Task { handle, inputs: &inputs, outputs: &outputs, sizes: [wanted, made] };
        match states {
            0 => Ok(()),
            1 => task.single().map_err(wrong),
            _ => py.detach(|| task.all(states, threads)).map_err(wrong),
        }
    }
}

/// Returns an array of that shape, or a NumPy number if the shape is empty.
fn array_of<'py>(py: Python<'py>, values: &[f64], shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    let flat = PyArray1::from_slice(py, values);
    match *shape {
        [] => flat.as_any().get_item(0),
        [_] => Ok(flat.into_any()),
        _ => Ok(flat.reshape(shape.to_vec())?.into_any()),
    }
}

/// A call over tables.
struct Task<'t> {
    handle: Handle<'t>,
    inputs: &'t [Table],
    outputs: &'t [Table],
    sizes: [usize; 2],
}

impl Task<'_> {
    /// Computes one state.
    fn single(&self) -> Result<(), Errors> {
        let read = |table: &Table| {
            let table = *table;
            (0..table.entries()).map(move |entry| table.read(0, entry))
        };
        let given: Vec<f64> = self.inputs.iter().flat_map(read).collect();
        let mut found = vec![0.0; self.sizes[1]];
        self.handle.entries(&given, &mut found)?;
        let mut values = found.into_iter();
        for table in self.outputs {
            (0..table.entries())
                .zip(&mut values)
                .for_each(|(entry, value)| table.write(0, entry, value));
        }
        Ok(())
    }

    /// Computes that many states in up to that many threads, but never in more threads than there are blocks.
    fn all(&self, states: usize, threads: usize) -> Result<(), Errors> {
        let blocks = states.div_ceil(BLOCK);
        let length = blocks.div_ceil(threads.clamp(1, blocks)) * BLOCK;
        if length >= states {
            return self.range(0, states);
        }
        std::thread::scope(|scope| {
            let starts = (0..states).step_by(length);
            let run = |start: usize| self.range(start, states.min(start + length));
            let parts: Vec<_> = starts.map(|start| scope.spawn(move || run(start))).collect();
            let ended = parts
                .into_iter()
                .map(|part| part.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
            ended.collect::<Result<Vec<()>, Errors>>().map(|_| ())
        })
    }

    /// Computes the states from `start` to `end`, a block at a time.
    fn range(&self, start: usize, end: usize) -> Result<(), Errors> {
        let [mut given, mut found] = self.sizes.map(|size| vec![0.0; size * BLOCK]);
        for first in (start..end).step_by(BLOCK) {
            let states = BLOCK.min(end - first);
            let mut rest = given.as_mut_slice();
            for table in self.inputs {
                let (columns, after) = rest.split_at_mut(table.entries() * BLOCK);
                table.read_block(first, states, columns, BLOCK);
                rest = after;
            }
            let inputs: Vec<&[f64]> =
                given.chunks_exact(BLOCK).map(|column| &column[..states]).collect();
            let mut outputs: Vec<&mut [f64]> =
                found.chunks_exact_mut(BLOCK).map(|column| &mut column[..states]).collect();
            self.handle.columns(&inputs, &mut outputs)?;
            let mut rest = found.as_slice();
            for table in self.outputs {
                let (columns, after) = rest.split_at(table.entries() * BLOCK);
                table.write_block(first, states, columns, BLOCK);
                rest = after;
            }
        }
        Ok(())
    }
}
