//! Code in memory, and calls of this code. All `unsafe` code of this crate is here.
//!
//! Code reads and writes through the pointers that it gets as arguments and, if cranelift made it, below the stack
//! pointer. The range of its accesses follows from the function from which it was made; the numbers of inputs, outputs
//! and states are checked before each call. Pages are first writable and then executable, never both at the same time.
//! They are unmapped when their last owner is dropped.

#![allow(unsafe_code)]

use std::mem::{MaybeUninit, transmute};
use std::sync::Arc;

use memmap2::{Mmap, MmapMut};

use crate::emit::{Entry, LanesEntry, SingleEntry};
use crate::error::Error;

/// A line of working memory, aligned so that no stored register crosses a cache line.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Line([MaybeUninit<u64>; 8]);

const EMPTY: Line = Line([MaybeUninit::uninit(); 8]);
const NUMBERS_OF_LINE: usize = 8;

/// The number of lines of working memory that a call for one state has on the stack; more are allocated on the heap.
const LINES_ON_STACK: usize = 48;

/// Defines the function types of the code: with the System V ABI on x86-64 on every system, elsewhere with the C ABI.
macro_rules! types {
    ($abi:literal) => {
        type Single = unsafe extern $abi fn(*const f64, *mut f64, *const u64, *mut Line);
        type Lanes = unsafe extern $abi fn(
            *const *const f64,
            *const *mut f64,
            *const u64,
            *mut Line,
            usize,
            usize,
        );
    };
}

#[cfg(target_arch = "x86_64")]
types!("sysv64");
#[cfg(not(target_arch = "x86_64"))]
types!("C");

/// Code in executable memory, which is called as a function of type `F`.
#[derive(Debug)]
struct Code<F> {
    /// The start of the code, in `_pages`.
    run: F,
    entry: Entry,
    /// The pages of all functions, which are kept as long as one of the functions exists.
    _pages: Arc<Mmap>,
}

/// Code for one state at a time.
#[derive(Debug)]
pub(crate) struct SingleCode(Code<Single>);

/// Code for several states in lanes.
#[derive(Debug)]
pub(crate) struct LanesCode(Code<Lanes>);

/// The byte between pieces of code, which traps.
const TRAP: u8 = 0xcc;
const ALIGNMENT: usize = 64;

/// Copies the code of functions, for one state and for several, into executable memory.
///
/// # Errors
///
/// The machine does not have the registers, or the system returns an error.
pub(crate) fn place(
    functions: Vec<(SingleEntry, LanesEntry)>,
) -> Result<Vec<(SingleCode, LanesCode)>, Error> {
    let entries = || functions.iter().flat_map(|(single, lanes)| [&single.0, &lanes.0]);
    let size = |entry: &Entry| entry.code.len().next_multiple_of(ALIGNMENT);
    let mut pages = MmapMut::map_anon(entries().map(size).sum::<usize>().max(ALIGNMENT))?;
    pages.fill(TRAP);
    let mut start = 0;
    for entry in entries() {
        entry.registers.check()?;
        pages[start..start + entry.code.len()].copy_from_slice(&entry.code);
        start += size(entry);
    }
    let pages = Arc::new(pages.make_exec()?);
    #[cfg(target_arch = "aarch64")]
    renew_instructions(&pages)?;
    let mut next = 0;
    let mut start = |entry: &Entry| {
        let start = pages[next..].as_ptr();
        next += size(entry);
        start
    };
    let functions = functions.into_iter();
    let placed = functions.map(|(SingleEntry(single), LanesEntry(lanes))| {
        // SAFETY: these addresses contain code that `emit_single` and `emit_lanes` made with these signatures, in pages
        // that live as long as the pointers to them, and the machine has its registers.
        let (run_single, run_lanes) = unsafe {
            (
                transmute::<*const u8, Single>(start(&single)),
                transmute::<*const u8, Lanes>(start(&lanes)),
            )
        };
        let (single_pages, lanes_pages) = (pages.clone(), pages.clone());
        (
            SingleCode(Code { run: run_single, entry: single, _pages: single_pages }),
            LanesCode(Code { run: run_lanes, entry: lanes, _pages: lanes_pages }),
        )
    });
    Ok(placed.collect())
}

/// Makes all processors fetch the instructions of these pages again, which ARM processors do not do automatically.
#[cfg(target_arch = "aarch64")]
fn renew_instructions(pages: &Mmap) -> std::io::Result<()> {
    use wasmtime_internal_jit_icache_coherence::{clear_cache, pipeline_flush_mt};
    // SAFETY: the pages are mapped, and no code runs in them yet; the pipelines are flushed afterwards.
    unsafe { clear_cache(pages.as_ptr().cast(), pages.len()) }.map_err(std::io::Error::other)?;
    pipeline_flush_mt().map_err(std::io::Error::other)
}

impl SingleCode {
    /// The size of the code, in bytes.
    pub(crate) fn size(&self) -> usize {
        self.0.entry.code.len()
    }

    /// Computes one state. If a length is wrong, does nothing and returns false.
    #[inline]
    pub(crate) fn call(&self, inputs: &[f64], outputs: &mut [f64]) -> bool {
        let entry = &self.0.entry;
        if inputs.len() != entry.inputs || outputs.len() != entry.outputs {
            return false;
        }
        if entry.working <= LINES_ON_STACK * NUMBERS_OF_LINE {
            let mut working = [EMPTY; LINES_ON_STACK];
            self.enter(inputs, outputs, &mut working);
        } else {
            self.enter(inputs, outputs, &mut vec![EMPTY; entry.working.div_ceil(NUMBERS_OF_LINE)]);
        }
        true
    }

    #[inline]
    fn enter(&self, inputs: &[f64], outputs: &mut [f64], working: &mut [Line]) {
        // SAFETY: `call` checked the lengths, and `place` checked that the machine has the registers. The code reads
        // only entries of inputs below the lengths and writes only such entries of outputs. It reads constants of the
        // pool that was made with it. It has as much working memory as it uses, and writes it before it reads it.
        unsafe {
            (self.0.run)(
                inputs.as_ptr(),
                outputs.as_mut_ptr(),
                self.0.entry.pool.as_ptr(),
                working.as_mut_ptr(),
            );
        }
    }
}

impl LanesCode {
    /// The size of the code, in bytes.
    pub(crate) fn size(&self) -> usize {
        self.0.entry.code.len()
    }

    /// Computes the states below `states`, which must be a multiple of the lanes. If it is not, or if columns are
    /// missing or too short, does nothing and returns false.
    pub(crate) fn call(
        &self,
        inputs: &[&[f64]],
        outputs: &mut [&mut [f64]],
        states: usize,
    ) -> bool {
        let entry = &self.0.entry;
        let fits = inputs.len() == entry.inputs
            && outputs.len() == entry.outputs
            && inputs.iter().all(|column| column.len() >= states)
            && outputs.iter().all(|column| column.len() >= states)
            && states.is_multiple_of(entry.registers.lanes());
        if !fits || states == 0 {
            return fits;
        }
        let inputs: Vec<*const f64> = inputs.iter().map(|column| column.as_ptr()).collect();
        let outputs: Vec<*mut f64> = outputs.iter_mut().map(|column| column.as_mut_ptr()).collect();
        let mut working = vec![EMPTY; entry.working.div_ceil(NUMBERS_OF_LINE)];
        // SAFETY: each column has at least `states` numbers. The code accesses whole registers from 0 up to `states`,
        // which is a multiple of their length and not 0. Otherwise as in `SingleCode::enter`.
        unsafe {
            (self.0.run)(
                inputs.as_ptr(),
                outputs.as_ptr(),
                entry.pool.as_ptr(),
                working.as_mut_ptr(),
                0,
                states,
            );
        }
        true
    }
}
