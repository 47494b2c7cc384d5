//! The instructions of one function, in terms common to all processors.

use crate::object_file::{Code, Machine, Object, Referred};
use crate::{thumb, x86};

/// An instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Instruction {
    /// Its place in the function.
    pub(crate) place: usize,
    /// Its length in bytes.
    pub(crate) length: usize,
    /// Its successors.
    pub(crate) flow: Flow,
    /// By how many bytes the stack grows.
    pub(crate) grows: i64,
}

/// The successors of an instruction; targets are offsets from the start of the function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flow {
    /// The next one.
    Next,
    /// The next one, or another: it depends.
    Conditional,
    /// Another one.
    Jump(i64),
    /// One that a register or memory names: what the instruction at that place refers to.
    Indirect(usize),
    /// A function, then the next one.
    Call(i64),
    /// A function that a register or memory names in the same way, then the next one.
    IndirectCall(usize),
    /// Returns to the caller.
    Return,
    /// Nothing: the processor traps.
    Trap,
}

/// The measurements of a function.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Listing {
    pub(crate) instructions: usize,
    pub(crate) conditional_jumps: usize,
    /// Jumps and calls through registers or memory that no relocation names.
    pub(crate) indirect: usize,
    /// Traps if no panic is called: `unreachable`, overflow of the stack.
    pub(crate) traps: usize,
    /// Bytes of stack, the return address included.
    pub(crate) frame: u64,
    pub(crate) bytes: usize,
    /// The functions that it calls, or ends in, in the order of the code.
    pub(crate) calls: Vec<Referred>,
}

impl Listing {
    pub(crate) fn of(object: &Object, code: &Code) -> Listing {
        let (instructions, return_address) = match object.machine {
            Machine::X86 => (x86::instructions(&code.bytes), 8),
            Machine::Thumb => (thumb::instructions(&code.bytes, &code.data), 0),
        };
        let mut listing = Listing {
            instructions: instructions.len(),
            bytes: code.bytes.len(),
            ..Listing::default()
        };
        let (mut depth, mut deepest) = (0, 0);
        for instruction in &instructions {
            depth += instruction.grows;
            deepest = deepest.max(depth);
            listing.follow(object, code, &instructions, instruction);
            if matches!(instruction.flow, Flow::Return | Flow::Jump(_) | Flow::Indirect(_)) {
                // The next instructions are reached from before the frame was removed.
                depth = deepest;
            }
        }
        listing.frame = u64::try_from(deepest).unwrap_or(0) + return_address;
        listing
    }

    fn follow(
        &mut self,
        object: &Object,
        code: &Code,
        instructions: &[Instruction],
        instruction: &Instruction,
    ) {
        let naming = match instruction.flow {
            Flow::Indirect(place) | Flow::IndirectCall(place) => {
                instructions.iter().find(|other| other.place == place).unwrap_or(instruction)
            }
            _ => instruction,
        };
        let named = code.reference_within(naming.place..naming.place + naming.length);
        match instruction.flow {
            Flow::Next | Flow::Return => {}
            Flow::Conditional => self.conditional_jumps += 1,
            Flow::Trap => self.traps += 1,
            Flow::Jump(to) => {
                let stays = (0..code.bytes.len() as i64).contains(&to) && named.is_none();
                if !stays {
                    self.call(named.or_else(|| object.at_offset(code, to).map(Referred::Function)));
                }
            }
            Flow::Call(to) => {
                self.call(named.or_else(|| object.at_offset(code, to).map(Referred::Function)));
            }
            Flow::Indirect(_) | Flow::IndirectCall(_) => self.call(named),
        }
    }

    fn call(&mut self, referred: Option<Referred>) {
        match referred {
            Some(Referred::Data) | None => self.indirect += 1,
            Some(referred) => self.calls.push(referred),
        }
    }
}
