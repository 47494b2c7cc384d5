//! Arrays of another owner, read and written by their strides: the `unsafe` of this package.

#![allow(unsafe_code)]

use numpy::{PyArray1, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::buffer::PyBuffer;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// A table of doubles, (states, entries), in memory that a buffer holds for as long as the view is used.
#[derive(Clone, Copy)]
pub(crate) struct Table {
    start: *mut u8,
    /// Bytes from a state to the next, and from an entry to the next.
    strides: [isize; 2],
    shape: [usize; 2],
}

// SAFETY: a table is a place; threads write disjoint states of it, and the buffer keeps the memory.
unsafe impl Send for Table {}
// SAFETY: as above.
unsafe impl Sync for Table {}

impl Table {
    /// The table of a buffer of two dimensions.
    pub(crate) fn new(buffer: &PyBuffer<f64>, writes: bool) -> PyResult<Table> {
        let (&[states, entries], &[by_state, by_entry]) = (buffer.shape(), buffer.strides()) else {
            return Err(PyValueError::new_err("an array must have two dimensions"));
        };
        if buffer.suboffsets().is_some() || (writes && buffer.readonly()) {
            return Err(PyValueError::new_err("an output must be an array that can be written"));
        }
        let start = buffer.buf_ptr().cast();
        Ok(Table { start, strides: [by_state, by_entry], shape: [states, entries] })
    }

    /// One state: an array of one dimension, which is only read, while Python's lock is held.
    pub(crate) fn state(array: &Bound<'_, PyArray1<f64>>) -> Table {
        // NumPy states no strides for arrays of a library that has none.
        let stride = array.strides().first().copied().unwrap_or(size_of::<f64>() as isize);
        Table { start: array.data().cast(), strides: [0, stride], shape: [1, array.len()] }
    }

    pub(crate) fn states(self) -> usize {
        self.shape[0]
    }

    pub(crate) fn entries(self) -> usize {
        self.shape[1]
    }

    /// The place of an entry, inside of the shape.
    fn place(self, state: usize, entry: usize) -> *mut f64 {
        assert!(state < self.shape[0] && entry < self.shape[1]);
        let bytes = state as isize * self.strides[0] + entry as isize * self.strides[1];
        self.start.wrapping_offset(bytes).cast()
    }

    pub(crate) fn read(self, state: usize, entry: usize) -> f64 {
        // SAFETY: the exporter says that all places inside of the shape can be read; they need not be aligned.
        unsafe { self.place(state, entry).read_unaligned() }
    }

    pub(crate) fn write(self, state: usize, entry: usize, value: f64) {
        // SAFETY: as in `read`; `new` has checked outputs, which alone are written.
        unsafe { self.place(state, entry).write_unaligned(value) }
    }
}
