//! The flow and stack use of x86-64 instructions.

use std::collections::BTreeMap;

use iced_x86::{
    Decoder, DecoderOptions, FlowControl, Instruction as Decoded, InstructionInfoFactory, Mnemonic,
    OpAccess, OpKind, Register,
};

use crate::listing::{Flow, Instruction};

/// The registers that a call can change, by the conventions of any of the platforms.
const VOLATILE: [Register; 9] = [
    Register::RAX,
    Register::RCX,
    Register::RDX,
    Register::RSI,
    Register::RDI,
    Register::R8,
    Register::R9,
    Register::R10,
    Register::R11,
];

/// The instructions of a function.
pub(crate) fn instructions(bytes: &[u8]) -> Vec<Instruction> {
    let decoder = Decoder::with_ip(64, bytes, 0, DecoderOptions::NONE);
    let mut addresses = Addresses { loads: BTreeMap::new(), info: InstructionInfoFactory::new() };
    let mut instructions: Vec<Instruction> = vec![];
    for decoded in decoder {
        // Padding between functions and before loops does not count.
        if matches!(decoded.mnemonic(), Mnemonic::Nop | Mnemonic::Int3) {
            continue;
        }
        instructions.push(Instruction {
            place: decoded.ip() as usize,
            length: decoded.len(),
            flow: flow(&decoded, &addresses),
            grows: grows(&decoded),
        });
        addresses.follow(&decoded);
    }
    instructions
}

/// The offsets of the instructions that loaded registers from fixed addresses: the address of a function that is called
/// several times is kept in a register.
struct Addresses {
    loads: BTreeMap<Register, usize>,
    info: InstructionInfoFactory,
}

impl Addresses {
    fn follow(&mut self, decoded: &Decoded) {
        for used in self.info.info(decoded).used_registers() {
            let writes =
                !matches!(used.access(), OpAccess::None | OpAccess::Read | OpAccess::CondRead);
            if writes {
                self.loads.remove(&used.register().full_register());
            }
        }
        match decoded.flow_control() {
            FlowControl::Call | FlowControl::IndirectCall => {
                self.loads.retain(|register, _| !VOLATILE.contains(register));
            }
            // The contents of registers are only known on a path without jumps.
            FlowControl::Next => {}
            _ => self.loads.clear(),
        }
        let is_load = decoded.mnemonic() == Mnemonic::Mov
            && decoded.op0_kind() == OpKind::Register
            && decoded.memory_base() == Register::RIP;
        if is_load {
            self.loads.insert(decoded.op0_register(), decoded.ip() as usize);
        }
    }

    /// The offset of the instruction that determines the target of an indirect jump or call.
    fn source(&self, decoded: &Decoded) -> usize {
        let loaded = match decoded.op0_kind() {
            OpKind::Register => self.loads.get(&decoded.op0_register()),
            _ => None,
        };
        loaded.copied().unwrap_or(decoded.ip() as usize)
    }
}

fn flow(decoded: &Decoded, addresses: &Addresses) -> Flow {
    let target = decoded.near_branch_target().cast_signed();
    match decoded.flow_control() {
        FlowControl::Next | FlowControl::Interrupt => Flow::Next,
        FlowControl::ConditionalBranch | FlowControl::XbeginXabortXend => Flow::Conditional,
        FlowControl::UnconditionalBranch => Flow::Jump(target),
        FlowControl::IndirectBranch => Flow::Indirect(addresses.source(decoded)),
        FlowControl::Call => Flow::Call(target),
        FlowControl::IndirectCall => Flow::IndirectCall(addresses.source(decoded)),
        FlowControl::Return => Flow::Return,
        FlowControl::Exception => Flow::Trap,
    }
}

/// The size of the pages in which a loop allocates a large frame.
const PAGE: i64 = 4096;

/// The number of bytes by which the stack grows.
fn grows(decoded: &Decoded) -> i64 {
    let of_stack = decoded.op0_register() == Register::RSP;
    let immediate = decoded.try_immediate(1).ok().map(u64::cast_signed);
    match (decoded.mnemonic(), immediate) {
        (Mnemonic::Sub, Some(bytes)) if of_stack => bytes,
        (Mnemonic::Add, Some(bytes)) if of_stack => -bytes,
        // `lea r11, [rsp - size]` gives the end of that loop; the step of the loop itself is counted separately.
        (Mnemonic::Lea, _)
            if decoded.op0_register() == Register::R11
                && decoded.memory_base() == Register::RSP
                && decoded.memory_index() == Register::None =>
        {
            -decoded.memory_displacement64().cast_signed() - PAGE
        }
        _ if decoded.flow_control() == FlowControl::Next => {
            i64::from(-decoded.stack_pointer_increment())
        }
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flow_and_stack_are_read() {
        let bytes = [
            0x55, // push rbp
            0x48, 0x83, 0xec, 0x20, // sub rsp, 32
            0xf2, 0x0f, 0x59, 0xc1, // mulsd xmm0, xmm1
            0x75, 0x02, // jne
            0xe8, 0, 0, 0, 0, // call
            0xff, 0x15, 0, 0, 0, 0, // call [rip]
            0xff, 0xe0, // jmp rax
            0x48, 0x83, 0xc4, 0x20, // add rsp, 32
            0x5d, // pop rbp
            0xc3, // ret
            0x0f, 0x0b, // ud2
            0x90, // nop
        ];
        let found = instructions(&bytes);
        let flows: Vec<Flow> = found.iter().map(|found| found.flow).collect();
        use Flow::*;
        assert_eq!(
            flows,
            [
                Next,
                Next,
                Next,
                Conditional,
                Call(16),
                IndirectCall(16),
                Indirect(22),
                Next,
                Next,
                Return,
                Trap
            ]
        );
        let grows: Vec<i64> = found.iter().map(|found| found.grows).collect();
        assert_eq!(grows, [8, 32, 0, 0, 0, 0, 0, -32, -8, 0, 0]);
    }

    #[test]
    fn a_call_through_a_register_is_known_by_its_load() {
        let load = [0x4c, 0x8b, 0x35, 0, 0, 0, 0]; // mov r14, [rip]
        let call = [0x41, 0xff, 0xd6]; // call r14
        let change = [0x49, 0xff, 0xc6]; // inc r14
        let calls = |parts: &[&[u8]]| -> Vec<Flow> {
            let found = instructions(&parts.concat());
            found.iter().map(|found| found.flow).filter(|flow| *flow != Flow::Next).collect()
        };
        let twice = calls(&[&load, &call, &call]);
        assert_eq!(twice, [Flow::IndirectCall(0), Flow::IndirectCall(0)]);
        assert_eq!(calls(&[&load, &change, &call]), [Flow::IndirectCall(10)]);
    }

    #[test]
    fn a_frame_of_many_pages_is_read() {
        // lea r11, [rsp - 0x10000]
        let found = instructions(&[0x4c, 0x8d, 0x9c, 0x24, 0x00, 0x00, 0xff, 0xff]);
        assert_eq!(found[0].grows, 0x10000 - PAGE);
    }
}
