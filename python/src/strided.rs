//! Arrays that another library owns, read and written by their strides. This module contains the `unsafe` code of
//! the package.

#![allow(unsafe_code)]

use std::array;

use numpy::{PyArray1, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::buffer::PyBuffer;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The number of states that are copied at once, entry by entry: their rows, and the parts of the columns, are then in
/// the cache while they are needed.
const TILE: usize = 8;

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

    /// Copies states from `first` on into columns of `length` numbers, one for each entry.
    pub(crate) fn read_block(
        self,
        first: usize,
        states: usize,
        columns: &mut [f64],
        length: usize,
    ) {
        self.check_block(first, states, columns.len(), length);
        let whole = states - states % TILE;
        for state in (0..whole).step_by(TILE) {
            for (entry, column) in columns.chunks_exact_mut(length).enumerate() {
                let place = self.place(first + state, entry);
                column[state..state + TILE].copy_from_slice(&array::from_fn::<f64, TILE, _>(
                    |index| {
                        let offset = index as isize * self.strides[0];
                        // SAFETY: as in `read`; the states of the block are inside of the shape.
                        unsafe { place.wrapping_byte_offset(offset).read_unaligned() }
                    },
                ));
            }
        }
        for state in whole..states {
            for (entry, column) in columns.chunks_exact_mut(length).enumerate() {
                column[state] = self.read(first + state, entry);
            }
        }
    }

    /// Copies columns back to states from `first` on.
    pub(crate) fn write_block(self, first: usize, states: usize, columns: &[f64], length: usize) {
        self.check_block(first, states, columns.len(), length);
        let whole = states - states % TILE;
        for state in (0..whole).step_by(TILE) {
            for (entry, column) in columns.chunks_exact(length).enumerate() {
                let place = self.place(first + state, entry);
                for (index, value) in column[state..state + TILE].iter().enumerate() {
                    let offset = index as isize * self.strides[0];
                    // SAFETY: as in `write`; the states of the block are inside of the shape.
                    unsafe { place.wrapping_byte_offset(offset).write_unaligned(*value) };
                }
            }
        }
        for state in whole..states {
            for (entry, column) in columns.chunks_exact(length).enumerate() {
                self.write(first + state, entry, column[state]);
            }
        }
    }

    fn check_block(self, first: usize, states: usize, numbers: usize, length: usize) {
        assert!(first + states <= self.shape[0] && states <= length);
        assert_eq!(numbers, self.shape[1] * length);
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
