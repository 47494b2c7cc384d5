//! The length, flow and stack use of ARM instructions in Thumb state, as described in the *Armv7-M Architecture
//! Reference Manual*, chapter A5.

use crate::listing::{Flow, Instruction};

/// The instructions of a function; `data` are the ranges that are not instructions.
pub(crate) fn instructions(bytes: &[u8], data: &[(usize, usize)]) -> Vec<Instruction> {
    let half = |place: usize| -> Option<u16> {
        Some(u16::from_le_bytes(bytes.get(place..place + 2)?.try_into().ok()?))
    };
    let mut instructions = vec![];
    let mut place = 0;
    // The number of following instructions that depend on a condition.
    let mut predicated = 0;
    while let Some(first) = half(place) {
        if let Some((_, end)) = data.iter().find(|(start, end)| (*start..*end).contains(&place)) {
            place = *end;
            continue;
        }
        let second = if first >> 11 >= 0b11101 { half(place + 2) } else { None };
        let (length, (flow, grows)) = match second {
            Some(second) => (4, wide(first, second, place)),
            None => (2, narrow(first, place)),
        };
        let depends = predicated > 0 && !matches!(flow, Flow::Next);
        let flow = if depends { Flow::Conditional } else { flow };
        predicated = match if_then(first) {
            Some(count) if length == 2 => count,
            _ => predicated.max(1) - 1,
        };
        // NOP does not count as an instruction.
        if first != 0xbf00 {
            instructions.push(Instruction { place, length, flow, grows });
        }
        place += length;
    }
    instructions
}

/// The number of instructions whose execution depends on the condition of an `IT` (A7.7.38).
fn if_then(first: u16) -> Option<u32> {
    let mask = first & 0xf;
    (first & 0xff00 == 0xbf00 && mask != 0).then(|| 4 - mask.trailing_zeros())
}

/// Instructions with 16 bits (A5.2).
fn narrow(first: u16, place: usize) -> (Flow, i64) {
    let from = place as i64 + 4;
    let is = |mask: u16, bits: u16| first & mask == bits;
    if is(0xf000, 0xd000) {
        return match first >> 8 & 0xf {
            14 => (Flow::Trap, 0), // UDF
            15 => (Flow::Next, 0), // SVC
            _ => (Flow::Conditional, 0),
        };
    }
    if is(0xf500, 0xb100) {
        return (Flow::Conditional, 0); // CBZ, CBNZ
    }
    if is(0xf800, 0xe000) {
        let offset = i64::from((first << 5).cast_signed() >> 4);
        return (Flow::Jump(from + offset), 0);
    }
    if is(0xff80, 0x4780) {
        return (Flow::IndirectCall(place), 0); // BLX
    }
    if is(0xff80, 0x4700) {
        // BX LR returns.
        return (if first >> 3 & 0xf == 14 { Flow::Return } else { Flow::Indirect(place) }, 0);
    }
    if is(0xfe00, 0xb400) {
        return (Flow::Next, 4 * i64::from((first & 0x1ff).count_ones())); // PUSH
    }
    if is(0xfe00, 0xbc00) {
        let flow = if first & 0x100 == 0 { Flow::Next } else { Flow::Return };
        return (flow, -4 * i64::from((first & 0x1ff).count_ones())); // POP
    }
    if is(0xff00, 0xb000) {
        let bytes = 4 * i64::from(first & 0x7f);
        return (Flow::Next, if first & 0x80 == 0 { -bytes } else { bytes }); // ADD, SUB of SP
    }
    (Flow::Next, 0)
}

/// Instructions with 32 bits (A5.3).
fn wide(first: u16, second: u16, place: usize) -> (Flow, i64) {
    let from = place as i64 + 4;
    if first >> 11 == 0b11110 && second & 0x8000 != 0 {
        return (branch(first, second, from), 0);
    }
    let registers = 4 * i64::from(second.count_ones());
    let words = 4 * i64::from(second & 0xff);
    let stack = match first {
        0xe92d => return (Flow::Next, registers), // STMDB SP!
        0xe8bd => {
            let flow = if second & 0x8000 == 0 { Flow::Next } else { Flow::Return };
            return (flow, -registers); // LDMIA SP!
        }
        0xe8d0..=0xe8df if second & 0xffe0 == 0xf000 => return (Flow::Indirect(place), 0), // TBB, TBH
        0xed2d | 0xed6d => words,                                                          // VPUSH
        0xecbd | 0xecfd => -words,                                                         // VPOP
        _ if second & 0x8f00 == 0x0d00 => match first & 0xfbff {
            0xf1ad => constant(first, second),     // SUB SP, SP, #constant
            0xf10d => -constant(first, second),    // ADD SP, SP, #constant
            0xf2ad => twelve_bits(first, second),  // SUBW SP, SP, #
            0xf20d => -twelve_bits(first, second), // ADDW SP, SP, #
            _ => 0,
        },
        // LDR PC jumps to the loaded address.
        _ if first & 0xff70 == 0xf850 && second >> 12 == 0xf => return (Flow::Indirect(place), 0),
        _ => 0,
    };
    (Flow::Next, stack)
}

/// Branches and calls with 32 bits (A5.3.4).
fn branch(first: u16, second: u16, from: i64) -> Flow {
    let far = from + far_offset(first, second);
    match (second & 0x4000 != 0, second & 0x1000 != 0) {
        (true, _) => Flow::Call(far),
        (false, true) => Flow::Jump(far),
        (false, false) if first >> 6 & 0xf < 14 => Flow::Conditional,
        (false, false) if first & 0xfff0 == 0xf7f0 && second & 0xf000 == 0xa000 => Flow::Trap, // UDF
        (false, false) => Flow::Next, // MSR, hints, barriers
    }
}

/// The 25-bit offset of B and BL (A7.7.12, A7.7.18).
fn far_offset(first: u16, second: u16) -> i64 {
    let (first, second) = (i64::from(first), i64::from(second));
    let sign = first >> 10 & 1;
    let i1 = !(second >> 13 ^ sign) & 1;
    let i2 = !(second >> 11 ^ sign) & 1;
    let low = (first & 0x3ff) << 12 | (second & 0x7ff) << 1;
    (sign << 24 | i1 << 23 | i2 << 22 | low) - (sign << 25)
}

fn twelve_bits(first: u16, second: u16) -> i64 {
    i64::from((first & 0x400) << 1 | second >> 4 & 0x700 | second & 0xff)
}

/// A modified immediate constant (A5.3.2).
fn constant(first: u16, second: u16) -> i64 {
    let bits = twelve_bits(first, second) as u32;
    let byte = bits & 0xff;
    match bits >> 8 {
        0 => i64::from(byte),
        1 => i64::from(byte << 16 | byte),
        2 => i64::from(byte << 24 | byte << 8),
        3 => i64::from(byte * 0x0101_0101),
        _ => i64::from((0x80 | byte & 0x7f).rotate_right(bits >> 7)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(halves: &[u16]) -> Vec<Instruction> {
        let bytes: Vec<u8> = halves.iter().flat_map(|half| half.to_le_bytes()).collect();
        instructions(&bytes, &[])
    }

    fn one(halves: &[u16]) -> (Flow, i64) {
        let found = read(halves);
        assert_eq!(found.len(), 1, "{halves:x?}");
        (found[0].flow, found[0].grows)
    }

    /// The encodings are those of an assembler.
    #[test]
    fn flow_and_stack_are_read() {
        assert_eq!(one(&[0xb5f0]), (Flow::Next, 20)); // push {r4-r7, lr}
        assert_eq!(one(&[0xbdf0]), (Flow::Return, -20));
        assert_eq!(one(&[0xe92d, 0x4ff0]), (Flow::Next, 36)); // push.w {r4-r11, lr}
        assert_eq!(one(&[0xed2d, 0x8b10]), (Flow::Next, 64)); // vpush {d8-d15}
        assert_eq!(one(&[0xecbd, 0x8b10]), (Flow::Next, -64));
        assert_eq!(one(&[0xb0a4]), (Flow::Next, 144)); // sub sp, #144
        assert_eq!(one(&[0xb024]), (Flow::Next, -144));
        assert_eq!(one(&[0xf5ad, 0x7d00]), (Flow::Next, 512)); // sub.w sp, sp, #512
        assert_eq!(one(&[0xf2ad, 0x4d04]), (Flow::Next, 1028)); // subw sp, sp, #1028
        assert_eq!(one(&[0x4770]), (Flow::Return, 0)); // bx lr
        assert_eq!(one(&[0x4798]), (Flow::IndirectCall(0), 0)); // blx r3
        assert_eq!(one(&[0xd1fe]), (Flow::Conditional, 0)); // bne .
        assert_eq!(one(&[0xb108]), (Flow::Conditional, 0)); // cbz
        assert_eq!(one(&[0xe7fe]), (Flow::Jump(0), 0)); // b .
        assert_eq!(one(&[0xf7ff, 0xfffe]), (Flow::Call(0), 0)); // bl .
        assert_eq!(one(&[0xf47f, 0xaffe]), (Flow::Conditional, 0)); // bne.w .
        assert_eq!(one(&[0xdefe]), (Flow::Trap, 0)); // udf
        assert_eq!(one(&[0xee20, 0x0a00]), (Flow::Next, 0)); // vmul.f32
    }

    #[test]
    fn a_jump_under_a_condition_is_conditional() {
        // it ne; bxne lr; bx lr
        let flows: Vec<Flow> = read(&[0xbf18, 0x4770, 0x4770]).iter().map(|i| i.flow).collect();
        assert_eq!(flows, [Flow::Next, Flow::Conditional, Flow::Return]);
    }

    #[test]
    fn data_are_not_instructions() {
        let bytes = [0x70, 0x47, 0, 0, 0xfe, 0xd1, 0xfe, 0xd1];
        assert_eq!(instructions(&bytes, &[(4, 8)]).len(), 2);
    }
}
