//! The sections of a module, and the layout of its memory.

use wasm_encoder::{
    CodeSection, ConstExpr, CustomSection, ExportKind, ExportSection, Function, FunctionSection,
    GlobalSection, GlobalType, MemorySection, MemoryType, Module, TypeSection, ValType,
};

use super::code::{Code, Kind};
use super::function::{batch, constructor, function};
use super::helpers::Functions;
use super::{CONSTRUCTOR, HEAP_BASE, MEMORY, Printer};
use crate::backend::common::Scalar;
use crate::backend::flat::{self, Helpers, Tree};

/// The address to which functions over columns copy the arrays of one state.
pub(super) const GATHERED: u32 = 16;
/// The size of a page of memory, in bytes.
const PAGE: u32 = 1 << 16;

/// The functions of a module under construction.
pub(super) struct Assembly {
    types: Vec<(Vec<ValType>, Vec<ValType>)>,
    functions: FunctionSection,
    code: CodeSection,
    /// The first address of the variables that the parts of a function share.
    shared: u32,
    /// The first free address.
    heap: u32,
}

impl Assembly {
    fn new(shared: u32) -> Assembly {
        let (functions, code) = (FunctionSection::new(), CodeSection::new());
        Assembly { types: vec![], functions, code, shared, heap: shared }
    }

    /// The first address of the variables that the parts of a function share.
    pub(super) fn shared(&self) -> u32 {
        self.shared
    }

    /// Reserves the memory below the address `end`: the heap starts there or later.
    pub(super) fn reserve(&mut self, end: u32) {
        self.heap = self.heap.max(end);
    }

    /// Adds a function; returns its index.
    pub(super) fn add(&mut self, code: Code) -> u32 {
        let Code { parameters, results, locals, mut bytes, .. } = code;
        let ty = (parameters, results);
        let known = self.types.iter().position(|known| *known == ty);
        let index = known.unwrap_or_else(|| {
            self.types.push(ty);
            self.types.len() - 1
        });
        self.functions.function(index as u32);
        wasm_encoder::InstructionSink::new(&mut bytes).end();
        let mut body = Function::new_with_locals_types(locals);
        body.raw(bytes);
        self.code.function(&body);
        self.code.len() - 1
    }
}

/// Writes the bytes of a module.
pub(super) fn bytes(printer: &Printer<'_>) -> Vec<u8> {
    let (tree, scalar) = (printer.tree, printer.options.scalar);
    let mut assembly = Assembly::new(GATHERED + gathered(tree, scalar));
    let mut exports = ExportSection::new();
    exports.export(MEMORY, ExportKind::Memory, 0).export(HEAP_BASE, ExportKind::Global, 0);
    let helpers = tree.helpers();
    let single = Kind { scalar, lanes: false };
    let lanes = Kind { scalar, lanes: true };
    let of_constructor = Helpers::of(&tree.constructor);
    let needed = if scalar == Scalar::F64 { helpers.and(of_constructor) } else { helpers };
    let of_single = Functions::new(&needed, single, &mut assembly);
    if tree.has_parameters() {
        let functions = match scalar {
            Scalar::F64 => of_single,
            Scalar::F32 => {
                let kind = Kind { scalar: Scalar::F64, lanes: false };
                Functions::new(&of_constructor, kind, &mut assembly)
            }
        };
        let index = constructor(tree, scalar, &functions, &mut assembly);
        exports.export(CONSTRUCTOR, ExportKind::Func, index);
    }
    let with_batch = printer.batch.then(|| Functions::new(&helpers, lanes, &mut assembly));
    for (one, batch_name) in tree.functions.iter().zip(&printer.batch_names) {
        let of_one = function(tree, one, single, &of_single, &mut assembly);
        exports.export(&one.name, ExportKind::Func, of_one);
        if let (Some(functions), Some(name)) = (&with_batch, batch_name) {
            let of_lanes = function(tree, one, lanes, functions, &mut assembly);
            let index = batch(tree, one, scalar, [of_one, of_lanes], &mut assembly);
            exports.export(name, ExportKind::Func, index);
        }
    }
    finished(printer, &assembly, &exports)
}

/// The size of the arrays of the function with the largest arrays, in bytes.
fn gathered(tree: &Tree<'_>, scalar: Scalar) -> u32 {
    let entries = |function: &flat::Function<'_>| -> usize {
        function.inputs.iter().chain(&function.outputs).map(|array| array.length).sum()
    };
    let most = tree.functions.iter().map(entries).max().unwrap_or_default();
    // Rounded up, so that vectors after the arrays are aligned to their size.
    (most * scalar.size()).next_multiple_of(16) as u32
}

fn finished(printer: &Printer<'_>, assembly: &Assembly, exports: &ExportSection) -> Vec<u8> {
    let heap = assembly.heap.next_multiple_of(16);
    let mut types = TypeSection::new();
    for (parameters, results) in &assembly.types {
        types.ty().function(parameters.iter().copied(), results.iter().copied());
    }
    let mut memories = MemorySection::new();
    memories.memory(MemoryType {
        minimum: u64::from(heap / PAGE + 1),
        maximum: None,
        memory64: false,
        shared: false,
        page_size_log2: None,
    });
    let mut globals = GlobalSection::new();
    let constant = GlobalType { val_type: ValType::I32, mutable: false, shared: false };
    globals.global(constant, &ConstExpr::i32_const(heap.cast_signed()));
    let mut module = Module::new();
    // The header is near the start, where files state their origin.
    for line in &printer.options.header {
        let data = line.as_bytes().into();
        module.section(&CustomSection { name: "generator".into(), data });
    }
    module.section(&types).section(&assembly.functions).section(&memories).section(&globals);
    module.section(exports).section(&assembly.code);
    module.finish()
}
