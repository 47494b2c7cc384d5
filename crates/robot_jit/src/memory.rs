//! Code in memory, and the calls of it: the `unsafe` of this crate.
//!
//! Code reads and writes by the pointers that it is given, and below the stack pointer where cranelift made it. What it
//! may reach follows from the function that it was made from, and is checked before each call: the number of inputs, of
//! outputs, of states.
//! Pages are written first and executable after; they are never both, and are unmapped when the last owner goes.

#![allow(unsafe_code)]

use std::mem::{MaybeUninit, transmute};
use std::sync::Arc;

use memmap2::{Mmap, MmapMut};

use crate::emit::{Entry, LanesEntry, SingleEntry};
use crate::error::Error;

/// Working memory, aligned so that no register crosses a cache line.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Line([MaybeUninit<u64>; 8]);

const EMPTY: Line = Line([MaybeUninit::uninit(); 8]);
const NUMBERS_OF_LINE: usize = 8;

/// Lines of working memory that a call of one state has on the stack; more are allocated.
const LINES_ON_STACK: usize = 48;

/// The types of the code: on x86-64 by the ABI of System V on every system, elsewhere by that of C.
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
    /// The start of the code, in `pages`.
    run: F,
    entry: Entry,
    /// The pages of all functions, kept while one lives.
    _pages: Arc<Mmap>,
}

/// Code for one state at a time.
#[derive(Debug)]
pub(crate) struct SingleCode(Code<Single>);

/// Code for several states side by side.
#[derive(Debug)]
pub(crate) struct LanesCode(Code<Lanes>);

/// Between pieces of code: traps.
const TRAP: u8 = 0xcc;
const ALIGNMENT: usize = 64;

/// Puts code for one state and for several, of some functions, into executable memory.
///
/// # Errors
///
/// A machine that does not have the registers; what the system says.
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
        // SAFETY: at these addresses lies code that `emit_single` and `emit_lanes` made with these signatures, in pages
        // that live as long as the pointers to them; the machine has its registers.
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

/// Has all processors fetch the instructions of these pages anew, which an ARM does not do by itself.
#[cfg(target_arch = "aarch64")]
fn renew_instructions(pages: &Mmap) -> std::io::Result<()> {
    use wasmtime_internal_jit_icache_coherence::{clear_cache, pipeline_flush_mt};
    // SAFETY: the pages are mapped, and nothing runs in them yet; the pipelines are flushed after it.
    unsafe { clear_cache(pages.as_ptr().cast(), pages.len()) }.map_err(std::io::Error::other)?;
    pipeline_flush_mt().map_err(std::io::Error::other)
}

impl SingleCode {
    /// The bytes of the code.
    pub(crate) fn size(&self) -> usize {
        self.0.entry.code.len()
    }

    /// Computes one state; false, and nothing else, if a length is not the function's.
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
        // SAFETY: `call` checked the lengths, and `place` that the machine has the registers. The code reads entries of
        // inputs and writes entries of outputs below them, reads constants of the pool that was made with it, and has as
        // much working memory as it uses, which it writes before it reads.
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
    /// The bytes of the code.
    pub(crate) fn size(&self) -> usize {
        self.0.entry.code.len()
    }

    /// Computes the states from 0 to `states`, a multiple of the lanes; false, and nothing else, if it is not, or if
    /// columns are missing or shorter.
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
        // SAFETY: each column has at least `states` numbers, and the code touches those of whole registers from 0 below
        // `states`, which is a multiple of them and not 0; the rest as in `SingleCode::enter`.
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
