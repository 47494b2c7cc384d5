//! Arrays that another library owns, read and written by their strides. This module contains the `unsafe` code of
//! the package.

#![allow(unsafe_code)]

use numpy::{PyArray1, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::buffer::PyBuffer;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// A table of doubles, (states, entries), in memory that a buffer keeps while the table is used.
#[derive(Clone, Copy)]
pub(crate) struct Table {
    start: *mut u8,
    /// The bytes from one state to the next, and from one entry to the next.
    strides: [isize; 2],
    shape: [usize; 2],
}

// SAFETY: a table is only an address; threads write to disjoint states, and the buffer keeps the memory.
unsafe impl Send for Table {}
// SAFETY: as above.
unsafe impl Sync for Table {}

impl Table {
    /// The table of a buffer with two dimensions.
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

    /// The table of a single state: a one-dimensional array, which is only read, while Python's lock is held.
    pub(crate) fn state(array: &Bound<'_, PyArray1<f64>>) -> Table {
        // An array from another library can lack strides; its entries are then contiguous.
        let stride = array.strides().first().copied().unwrap_or(size_of::<f64>() as isize);
        Table { start: array.data().cast(), strides: [0, stride], shape: [1, array.len()] }
    }

    pub(crate) fn states(self) -> usize {
        self.shape[0]
    }

    pub(crate) fn entries(self) -> usize {
        self.shape[1]
    }

    /// The address of an entry, which must be inside of the shape.
    fn place(self, state: usize, entry: usize) -> *mut f64 {
        assert!(state < self.shape[0] && entry < self.shape[1]);
        let bytes = state as isize * self.strides[0] + entry as isize * self.strides[1];
        self.start.wrapping_offset(bytes).cast()
    }

    pub(crate) fn read(self, state: usize, entry: usize) -> f64 {
        // SAFETY: the owner of the array guarantees that all addresses inside of the shape can be read; they may be
        // unaligned.
        unsafe { self.place(state, entry).read_unaligned() }
    }

    pub(crate) fn write(self, state: usize, entry: usize, value: f64) {
        // SAFETY: as in `read`; only outputs are written, and `new` has checked that they can be.
        unsafe { self.place(state, entry).write_unaligned(value) }
    }
}
