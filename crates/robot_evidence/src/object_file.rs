//! Object files: the bytes of each function and the symbols that they refer to.

use std::ops::Range;

use object::read::{Object as _, ObjectSection as _, ObjectSymbol as _};
use object::{Architecture, RelocationTarget, SectionIndex, SectionKind, SymbolIndex, SymbolKind};

use crate::error::Error;
use crate::probe::TABLE;

/// The bias of x86 relocations, which are relative to the end of an instruction.
const PC_BIAS: i64 = 4;

/// An instruction set that can be decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Machine {
    /// 64-bit x86.
    X86,
    /// 32-bit ARM in Thumb state.
    Thumb,
}

/// The functions of an object file.
pub(crate) struct Object {
    pub(crate) machine: Machine,
    pub(crate) functions: Vec<Code>,
    /// The functions whose addresses are in the table [`TABLE`], in order.
    pub(crate) table: Vec<usize>,
}

/// The code of one function.
pub(crate) struct Code {
    /// The names as in Rust: `probe::model::Model::inverse_dynamics`. The compiler can keep only one of several equal
    /// functions, which then has the names of all.
    pub(crate) names: Vec<String>,
    section: SectionIndex,
    /// The address in the section.
    address: u64,
    pub(crate) bytes: Vec<u8>,
    /// The offsets in `bytes` that the linker fills in, in ascending order, with the targets that they refer to.
    pub(crate) references: Vec<(usize, Referred)>,
    /// The ranges of `bytes` that are data, as (start, end), in ascending order.
    pub(crate) data: Vec<(usize, usize)>,
}

/// The target of a reference in a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Referred {
    /// A function of the object file, given by its index.
    Function(usize),
    /// A symbol of another object file.
    Outside(String),
    /// Data.
    Data,
}

impl Code {
    /// The target of the first address within these offsets that the linker fills in.
    pub(crate) fn reference_within(&self, places: Range<usize>) -> Option<Referred> {
        let mut references = self.references.iter().filter(|(place, _)| places.contains(place));
        references.next().map(|(_, referred)| referred.clone())
    }
}

impl Object {
    pub(crate) fn parse(bytes: &[u8]) -> Result<Object, Error> {
        let failed = |error: object::Error| Error::Object(error.to_string());
        if bytes.starts_with(b"\0asm") {
            return Err(Error::Architecture { architecture: "WebAssembly".to_owned() });
        }
        let file = object::File::parse(bytes).map_err(failed)?;
        let machine = match file.architecture() {
            Architecture::X86_64 => Machine::X86,
            Architecture::Arm => Machine::Thumb,
            other => return Err(Error::Architecture { architecture: format!("{other:?}") }),
        };
        let mut functions = functions(&file, machine).map_err(failed)?;
        let references: Vec<_> = functions
            .iter()
            .map(|code| {
                let place = (code.section, code.address, code.bytes.len() as u64);
                references(&file, &functions, place, PC_BIAS)
            })
            .collect::<object::Result<_>>()
            .map_err(failed)?;
        for (code, references) in functions.iter_mut().zip(references) {
            code.references = references;
        }
        let table = table(&file, &functions).map_err(failed)?;
        Ok(Object { machine, functions, table })
    }

    /// The function at an offset from the start of another one in the same section.
    pub(crate) fn at_offset(&self, from: &Code, offset: i64) -> Option<usize> {
        let address = from.address.checked_add_signed(offset)?;
        function_at(&self.functions, from.section, address)
    }
}

fn function_at(functions: &[Code], section: SectionIndex, address: u64) -> Option<usize> {
    functions.iter().position(|code| code.section == section && code.address == address)
}

fn functions(file: &object::File<'_>, machine: Machine) -> object::Result<Vec<Code>> {
    let mut functions: Vec<Code> = vec![];
    for symbol in file.symbols() {
        let Some(section) = symbol.section_index() else { continue };
        if symbol.kind() != SymbolKind::Text || symbol.name()?.starts_with('$') {
            continue;
        }
        // The lowest bit of the address of an ARM function indicates that it is in Thumb state.
        let mask = if machine == Machine::Thumb { !1 } else { !0 };
        let address = symbol.address() & mask;
        if let Some(known) = function_at(&functions, section, address) {
            functions[known].names.push(demangled(symbol.name()?));
            continue;
        }
        let section_data = file.section_by_index(section)?;
        let start = address - section_data.address();
        let end = match symbol.size() {
            0 => next_function(file, section, address, mask) - section_data.address(),
            size => start + size,
        };
        let data = section_data.data()?;
        let bytes = usize::try_from(start).ok().zip(usize::try_from(end).ok());
        let bytes = bytes.and_then(|(start, end)| data.get(start..end)).unwrap_or_default();
        functions.push(Code {
            names: vec![demangled(symbol.name()?)],
            section,
            address,
            bytes: bytes.to_vec(),
            references: vec![],
            data: data_ranges(file, section, (address, bytes.len())),
        });
    }
    Ok(functions)
}

/// The end of a function in formats without sizes of functions: the start of the next one.
fn next_function(file: &object::File<'_>, section: SectionIndex, address: u64, mask: u64) -> u64 {
    let symbols = file.symbols().filter(|symbol| {
        symbol.kind() == SymbolKind::Text && symbol.section_index() == Some(section)
    });
    let next = symbols.map(|symbol| symbol.address() & mask).filter(|other| *other > address).min();
    let end = || file.section_by_index(section).map(|section| section.address() + section.size());
    next.or_else(|| end().ok()).unwrap_or(address)
}

/// The ranges of a function that ARM's mapping symbols `$d` … `$t` mark as data.
fn data_ranges(
    file: &object::File<'_>,
    section: SectionIndex,
    (start, length): (u64, usize),
) -> Vec<(usize, usize)> {
    let mut marks: Vec<(usize, bool)> = file
        .symbols()
        .filter(|symbol| symbol.section_index() == Some(section))
        .filter_map(|symbol| {
            let name = symbol.name().ok()?;
            let is_data = name.starts_with("$d");
            let is_mark = is_data || name.starts_with("$t") || name.starts_with("$a");
            let place = usize::try_from(symbol.address().checked_sub(start)?).ok()?;
            (is_mark && place < length).then_some((place, is_data))
        })
        .collect();
    marks.sort_unstable();
    let ends = marks.iter().skip(1).map(|(place, _)| *place).chain([length]);
    let ranges = marks.iter().zip(ends).filter(|((_, is_data), _)| *is_data);
    ranges.map(|((start, _), end)| (*start, end)).collect()
}

/// The functions to which the table refers.
fn table(file: &object::File<'_>, functions: &[Code]) -> object::Result<Vec<usize>> {
    let is_table = |name: &str| name.trim_start_matches('_') == TABLE;
    let Some(symbol) = file.symbols().find(|symbol| symbol.name().is_ok_and(is_table)) else {
        return Ok(vec![]);
    };
    let Some(section) = symbol.section_index() else { return Ok(vec![]) };
    let size = match symbol.size() {
        0 => u64::MAX - symbol.address(),
        size => size,
    };
    let references = references(file, functions, (section, symbol.address(), size), 0)?;
    let listed = references.into_iter().filter_map(|(_, referred)| match referred {
        Referred::Function(function) => Some(function),
        _ => None,
    });
    Ok(listed.collect())
}

/// The references from relocations in a function or table, which is given by its section, address and size.
fn references(
    file: &object::File<'_>,
    functions: &[Code],
    (section, address, size): (SectionIndex, u64, u64),
    bias: i64,
) -> object::Result<Vec<(usize, Referred)>> {
    let section = file.section_by_index(section)?;
    let start = address - section.address();
    let mut references = vec![];
    for (offset, relocation) in section.relocations() {
        let Some(place) = offset.checked_sub(start).filter(|place| *place < size) else {
            continue;
        };
        let referred = match relocation.target() {
            RelocationTarget::Symbol(index) => {
                referred(file, functions, index, relocation.addend() + bias)?
            }
            _ => Referred::Data,
        };
        references.push((place as usize, referred));
    }
    references.sort_by_key(|(place, _)| *place);
    Ok(references)
}

/// The target of a reference to a symbol; `offset` is only used for the symbol of a section.
fn referred(
    file: &object::File<'_>,
    functions: &[Code],
    index: SymbolIndex,
    offset: i64,
) -> object::Result<Referred> {
    let symbol = file.symbol_by_index(index)?;
    let Some(section) = symbol.section_index() else {
        return Ok(Referred::Outside(demangled(symbol.name()?)));
    };
    if file.section_by_index(section)?.kind() != SectionKind::Text {
        return Ok(Referred::Data);
    }
    let offset = if symbol.kind() == SymbolKind::Section { offset } else { 0 };
    let places = [symbol.address() & !1, symbol.address()].into_iter();
    let mut places = places.filter_map(|address| address.checked_add_signed(offset));
    let found = places.find_map(|address| function_at(functions, section, address));
    Ok(match found {
        Some(function) => Referred::Function(function),
        None => Referred::Outside(symbol.name().map(demangled)?),
    })
}

/// The name of a symbol as in Rust, without the hash, and without the angle brackets around the type of a method.
fn demangled(symbol: &str) -> String {
    let plain = symbol.strip_prefix('_').filter(|rest| rest.starts_with("_ZN"));
    let name = format!("{:#}", rustc_demangle::demangle(plain.unwrap_or(symbol)));
    match name.strip_prefix('<').and_then(|rest| rest.split_once(">::")) {
        Some((ty, method)) if !ty.contains([' ', '<']) => format!("{ty}::{method}"),
        _ => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_manglings_give_one_name() {
        let name = "probe::model::Model::new";
        assert_eq!(demangled("_ZN5probe5model5Model3new17h3e917047a4c8e350E"), name);
        assert_eq!(demangled("__ZN5probe5model5Model3new17h3e917047a4c8e350E"), name);
        assert_eq!(demangled("_RNvMNtCs1234_5probe5modelNtB2_5Model3new"), name);
        assert_eq!(demangled("sincos"), "sincos");
    }

    #[test]
    fn what_is_not_an_object_file_is_an_error() {
        for bytes in [&b""[..], b"robot", &[0x7f, b'E', b'L', b'F', 2, 1, 1]] {
            assert!(matches!(Object::parse(bytes), Err(Error::Object(_))));
        }
        let wasm = Object::parse(b"\0asm\x01\0\0\0");
        assert!(
            matches!(wasm, Err(Error::Architecture { architecture }) if architecture == "WebAssembly")
        );
    }
}
