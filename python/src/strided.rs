//! Arrays of another owner, read and written by their strides: the `unsafe` of this package.

#![allow(unsafe_code)]

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

    /// One state: an array of one dimension, if it is one.
    pub(crate) fn state(buffer: &PyBuffer<f64>) -> Option<Table> {
        let (&[entries], &[stride]) = (buffer.shape(), buffer.strides()) else { return None };
        let start = buffer.buf_ptr().cast();
        let is_plain = buffer.suboffsets().is_none();
        is_plain.then_some(Table { start, strides: [0, stride], shape: [1, entries] })
    }

    /// All entries of an output of any number of dimensions, row by row, as those of one state.
    pub(crate) fn flat(buffer: &PyBuffer<f64>) -> Option<Table> {
        let is_plain = buffer.is_c_contiguous() && !buffer.readonly();
        let start = buffer.buf_ptr().cast();
        let strides = [0, size_of::<f64>() as isize];
        is_plain.then_some(Table { start, strides, shape: [1, buffer.item_count()] })
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
        // SAFETY: as in `read`; `new` and `flat` have checked outputs, which alone are written.
        unsafe { self.place(state, entry).write_unaligned(value) }
    }
}
