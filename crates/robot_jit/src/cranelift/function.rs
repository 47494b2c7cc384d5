//! A function of cranelift: its arguments, and the loop over states.

use cranelift_codegen::control::ControlPlane;
use cranelift_codegen::cursor::{Cursor, FuncCursor};
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::types::I64;
use cranelift_codegen::ir::{AbiParam, Function, InstBuilder, Signature, Value};
use cranelift_codegen::isa::{CallConv, OwnedTargetIsa};
use cranelift_codegen::settings::Configurable;
use cranelift_codegen::{Context, isa, settings};

use super::body::{self, Pointers};
use crate::emit::{Addressing, Fault};
use crate::list::List;

/// Converts an error of cranelift.
fn said(error: impl std::fmt::Display) -> Fault {
    Fault::Encoding(error.to_string())
}

/// Makes code for one state, or with a loop over several states, `lanes` at a time; also returns the size of its stack
/// in bytes.
pub(crate) fn encode(
    list: &List,
    lanes: usize,
    addressing: Addressing,
) -> Result<(Vec<u8>, u32), Fault> {
    let isa = processor()?;
    let mut signature = Signature::new(calling_convention(&isa));
    let arguments = match addressing {
        Addressing::Row => 4,
        Addressing::Columns => 6,
    };
    signature.params = vec![AbiParam::new(I64); arguments];
    let mut context = Context::new();
    context.func = Function::with_name_signature(Default::default(), signature);
    write(list, lanes, addressing, &mut context.func).map_err(Fault::Encoding)?;
    let compiled = context.compile(&*isa, &mut ControlPlane::default());
    let compiled = compiled.map_err(|error| said(error.inner))?;
    let stack = compiled.buffer.frame_layout().map_or(0, |frame| frame.frame_to_fp_offset);
    if !compiled.buffer.relocs().is_empty() {
        return Err(said("it refers to other code"));
    }
    Ok((compiled.code_buffer().to_vec(), stack))
}

/// Describes the current processor to cranelift.
fn processor() -> Result<OwnedTargetIsa, Fault> {
    let is_arm = cfg!(target_arch = "aarch64");
    // Extensions that every x86-64 with AVX2 and FMA has.
    let extensions: &[&str] = if is_arm {
        &[]
    } else {
        &["has_sse3", "has_ssse3", "has_sse41", "has_sse42", "has_avx", "has_avx2", "has_fma"]
    };
    let architecture = if is_arm { "aarch64" } else { "x86_64" };
    let mut builder = isa::lookup_by_name(architecture).map_err(said)?;
    for extension in extensions {
        builder.enable(extension).map_err(said)?;
    }
    let mut flags = settings::builder();
    let flag = if cfg!(debug_assertions) { "true" } else { "false" };
    flags.set("enable_verifier", flag).map_err(said)?;
    builder.finish(settings::Flags::new(flags)).map_err(said)
}

/// The calling convention of the function types in `memory.rs`.
fn calling_convention(isa: &OwnedTargetIsa) -> CallConv {
    if cfg!(target_arch = "x86_64") { CallConv::SystemV } else { isa.default_call_conv() }
}

fn write(
    list: &List,
    lanes: usize,
    addressing: Addressing,
    function: &mut Function,
) -> Result<(), String> {
    let mut cursor = FuncCursor::new(function);
    let start = cursor.func.dfg.make_block();
    let arguments: Vec<Value> = (0..cursor.func.signature.params.len())
        .map(|_| cursor.func.dfg.append_block_param(start, I64))
        .collect();
    cursor.insert_block(start);
    let pointers = |state: Option<Value>| Pointers {
        inputs: arguments[0],
        outputs: arguments[1],
        pool: arguments[2],
        state,
    };
    match addressing {
        Addressing::Row => body::write(list, &mut cursor, lanes, pointers(None))?,
        Addressing::Columns => {
            let [next, end] = [(); 2].map(|()| cursor.func.dfg.make_block());
            let state = cursor.func.dfg.append_block_param(next, I64);
            cursor.ins().jump(next, &[arguments[4].into()]);
            cursor.insert_block(next);
            let bytes = cursor.ins().ishl_imm_u(state, 3);
            body::write(list, &mut cursor, lanes, pointers(Some(bytes)))?;
            let state = cursor.ins().iadd_imm_u(state, lanes as i64);
            let goes_on = cursor.ins().icmp(IntCC::UnsignedLessThan, state, arguments[5]);
            cursor.ins().brif(goes_on, next, &[state.into()], end, &[]);
            cursor.insert_block(end);
        }
    }
    cursor.ins().return_(&[]);
    Ok(())
}
