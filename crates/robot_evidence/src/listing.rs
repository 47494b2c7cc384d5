//! The instructions of one function, in terms that are common to all processors.

use crate::object_file::{Code, Machine, Object, Referred};
use crate::{thumb, x86};

/// An instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Instruction {
    /// The offset from the start of the function, in bytes.
    pub(crate) place: usize,
    /// The length, in bytes.
    pub(crate) length: usize,
    /// What is executed next.
    pub(crate) flow: Flow,
    /// The number of bytes by which the stack grows.
    pub(crate) grows: i64,
}

/// What is executed after an instruction; targets are offsets from the start of the function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flow {
    /// The next instruction.
    Next,
    /// The next instruction or another one, depending on a condition.
    Conditional,
    /// Another instruction.
    Jump(i64),
    /// An instruction at an address in a register or memory; the instruction at the given offset refers to this
    /// address.
    Indirect(usize),
    /// A function, then the next instruction.
    Call(i64),
    /// A function at an address in a register or memory, given in the same way, then the next instruction.
    IndirectCall(usize),
    /// Returns to the caller.
    Return,
    /// Nothing, because the processor traps.
    Trap,
}

/// The measurements of a function.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Listing {
    pub(crate) instructions: usize,
    pub(crate) conditional_jumps: usize,
    /// The number of jumps and calls through registers or memory without a relocation that names the target.
    pub(crate) indirect: usize,
    /// The functions whose addresses it loads: those that it can call through registers.
    pub(crate) loaded: Vec<Referred>,
    /// The number of traps. Without a call of a panic, they are for `unreachable` or a stack overflow.
    pub(crate) traps: usize,
    /// The stack in bytes, including the return address.
    pub(crate) frame: u64,
    pub(crate) bytes: usize,
    /// The functions that it calls or jumps to at its end, in the order of the code.
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
                // The following instructions are reached from places where the frame still exists.
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
            Flow::Next => {
                self.loaded.extend(named.filter(|named| !matches!(named, Referred::Data)));
            }
            Flow::Return => {}
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
