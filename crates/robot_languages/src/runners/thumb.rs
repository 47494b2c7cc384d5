//! C in single precision on a Cortex-M4, compiled by arm-none-eabi-gcc and run by qemu.

use std::path::Path;

use robot_build::languages::Language;
use robot_codegen::Scalar;
use robot_codegen::backend::c::{self, Names};
use robot_codegen::backend::flat::{FlatOptions, Function, Tree};

use super::c::{C_CALLS, WARNINGS, program};
use super::{Found, Runner, read, results, write_package};
use crate::files;
use crate::work::Work;

/// The runner of the microcontroller.
pub(super) struct Thumb;

const COMPILER: &str = "arm-none-eabi-gcc";
const MACHINE: &str = "qemu-system-arm";

const TARGET: [&str; 5] =
    ["-std=c99", "-mthumb", "-mcpu=cortex-m4", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"];

/// Options with which loops over angles become straight-line code, which does not jump over its constants, and equal
/// functions are not merged.
const STRAIGHT: [&str; 10] = [
    "-O2",
    "-ffp-contract=off",
    "-fno-math-errno",
    "-fno-ipa-icf",
    "-mslow-flash-data",
    "-funroll-loops",
    "--param",
    "max-completely-peel-times=64",
    "--param",
    "max-completely-peeled-insns=10000",
];

/// Code that clears memory, enables the floating-point unit, and runs `main`.
const STARTUP: &str = "
extern unsigned stack_top, bss_begin, bss_end;
extern void initialise_monitor_handles(void);
extern void _exit(int status);
extern int main(void);

void reset(void)
{
    unsigned *word;
    *(volatile unsigned *)0xE000ED88 |= 0xFu << 20;
    for (word = &bss_begin; word < &bss_end; word++) {
        *word = 0;
    }
    initialise_monitor_handles();
    _exit(main());
}

void _init(void) {}
void _fini(void) {}

__attribute__((section(\".vectors\"), used)) static void *const vectors[] = {&stack_top, (void *)reset};
";

/// The memory of QEMU's machine mps2-an386: code at 0, data in 16 MB of PSRAM.
const MEMORY: &str = "
ENTRY(reset)
MEMORY { CODE : ORIGIN = 0, LENGTH = 4M  DATA : ORIGIN = 0x21000000, LENGTH = 16M }
SECTIONS {
  .text : { KEEP(*(.vectors)) *(.text*) *(.rodata*) } > CODE
  .ARM.exidx : { *(.ARM.exidx*) *(.ARM.extab*) } > CODE
  .data : { *(.data*) } > DATA
  .bss (NOLOAD) : { bss_begin = .; *(.bss*) *(COMMON) . = ALIGN(4); bss_end = .; } > DATA
  end = .;
  stack_top = 0x22000000;
}
";

impl Runner for Thumb {
    fn name(&self) -> &'static str {
        "thumb"
    }

    fn missing(&self) -> Option<String> {
        let tools = [COMPILER, MACHINE];
        let missing = tools.into_iter().find(|tool| !files::is_there(tool, &["--version"]));
        missing.map(|tool| format!("{tool} is not installed"))
    }

    fn has(&self, scalar: Scalar) -> bool {
        scalar == Scalar::F32
    }

    fn run(&self, work: &Work, folder: &Path) -> Result<Vec<Found>, String> {
        write_package(work, Language::C, folder)?;
        let options = FlatOptions { scalar: work.options.scalar, ..FlatOptions::default() };
        let tree = c::tree(&work.programs.module, &options);
        straight(&tree, folder)?;
        files::write(folder, "main.c", program(work, &tree, &C_CALLS).as_bytes())?;
        files::write(folder, "startup.c", STARTUP.as_bytes())?;
        files::write(folder, "memory.ld", MEMORY.as_bytes())?;
        let mut arguments = vec!["-O2", "-ffp-contract=off", "--specs=rdimon.specs"];
        arguments.extend(TARGET);
        arguments.extend(["-nostartfiles", "-T", "memory.ld", "main.c", "startup.c"]);
        arguments.extend(["-o", "main", "-lm"]);
        files::run(folder, COMPILER, &arguments)?;
        let semihosting = ["-semihosting-config", "enable=on,target=native"];
        let mut arguments = vec!["-M", "mps2-an386", "-display", "none", "-monitor", "none"];
        arguments.extend(["-serial", "none", "-kernel", "main"]);
        arguments.extend(semihosting);
        files::run(folder, MACHINE, &arguments)?;
        let has = |index: usize| c::has_batch(&tree.functions[index]);
        Ok(vec![
            Found {
                way: "single",
                results: results(work, &read(folder, "single.bin")?, |_| true)?,
            },
            Found { way: "batch", results: results(work, &read(folder, "batch.bin")?, has)? },
        ])
    }
}

/// Compiles each function that has a batch separately and checks that its machine code has no calls and no branches
/// except the return. Very long functions call their parts.
fn straight(tree: &Tree<'_>, folder: &Path) -> Result<(), String> {
    let names = Names::new(&tree.name);
    let mut text = format!("#include \"{}.h\"\n", tree.name);
    for function in tree.functions.iter().filter(|one| c::has_batch(one)) {
        text.push_str(&alone(tree, function, &names));
    }
    files::write(folder, "alone.c", text.as_bytes())?;
    let mut arguments: Vec<&str> = STRAIGHT.to_vec();
    arguments.extend(TARGET);
    arguments.extend(WARNINGS);
    arguments.extend(["-c", "alone.c"]);
    files::run(folder, COMPILER, &arguments)?;
    let listing = files::run(folder, "arm-none-eabi-objdump", &["-d", "alone.o"])?;
    let found = jumps(&listing);
    match found.as_slice() {
        [] => Ok(()),
        _ => Err(format!(
            "calls or branches in machine code of {}:\n{}",
            tree.name,
            found.join("\n")
        )),
    }
}

/// Prints a function with external linkage that calls a printed one.
fn alone(tree: &Tree<'_>, function: &Function<'_>, names: &Names) -> String {
    let mut parameters = vec![];
    let mut arguments = vec![];
    if tree.has_parameters() {
        parameters.push(format!("const {} *model", names.item("model")));
        arguments.push("model".to_owned());
    }
    let inputs = function.inputs.iter().map(|array| (array, "const "));
    for (array, constant) in inputs.chain(function.outputs.iter().map(|array| (array, ""))) {
        parameters.push(format!("{constant}float *{}", array.name));
        arguments.push(array.name.clone());
    }
    let (name, alone) =
        (names.item(&function.name), names.private(&format!("alone_{}", function.name)));
    let (parameters, arguments) = (parameters.join(", "), arguments.join(", "));
    format!(
        "void {alone}({parameters});\nvoid {alone}({parameters})\n{{\n    {name}({arguments});\n}}\n"
    )
}

/// The lines of an objdump listing whose instruction is a jump or a call, except returns by `bx lr`.
fn jumps(listing: &str) -> Vec<String> {
    let is_jump = |line: &&str| {
        let Some(instruction) = line.split('\t').nth(2) else { return false };
        let goes = instruction.trim_start().starts_with('b')
            && !instruction.trim_start().starts_with("bic")
            && !instruction.trim_start().starts_with("bf");
        let goes = goes || instruction.starts_with("cb") || instruction.starts_with("tb");
        let rest = line.split('\t').nth(3).unwrap_or_default();
        goes && !(instruction.trim() == "bx" && rest.starts_with("lr"))
    };
    listing.lines().filter(is_jump).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::jumps;

    #[test]
    fn calls_and_branches_are_found_but_no_returns() {
        let listing = "0000 <f>:\n   0:\tb410      \tpush\t{r4}\n   2:\tf7ff fffe \tbl\t0 <sqrtf>\n   6:\td1fb      \tbne.n\t0 <f>\n   \
                       8:\tf36f 0000 \tbfc\tr0, #0, #1\n   a:\t4770      \tbx\tlr\n   c:\tb108      \tcbz\tr0, 12 <f+0x12>\n";
        assert_eq!(jumps(listing).len(), 3);
    }
}
