//! The claim about generated code: it is flat and cannot panic, and its only calls are those of sines and cosines.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::Module;
use crate::compile::Profile;
use crate::error::Error;
use crate::listing::Listing;
use crate::object_file::{Object, Referred};
use crate::probe::{CRATE, Root};

/// The names of sines and cosines in the platforms' libraries.
const CIRCULAR: [&str; 10] = [
    "sin",
    "cos",
    "sincos",
    "sinf",
    "cosf",
    "sincosf",
    "__sincos_stret",
    "__sincosf_stret",
    "_sincos",
    "_sincosf",
];

/// The evidence about a function in compiled form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// The name, such as `Model::inverse_dynamics`.
    pub name: String,
    /// Whether it takes several states (slices, columns or a block) and may therefore loop over them.
    pub takes_states: bool,
    /// The measurements.
    pub measurements: Measurements,
    /// The called functions that are not part of the claim, by name, with the number of calls.
    pub calls: Vec<(String, usize)>,
    /// The violations of the claim.
    pub violations: Vec<Violation>,
}

/// The measurements of a function together with all examined functions that it calls, each counted once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Measurements {
    /// The number of functions: this one and the examined ones that it calls.
    pub functions: usize,
    /// The number of instructions, without padding.
    pub instructions: usize,
    /// The number of conditional jumps, without those that choose between copies of a kernel.
    pub conditional_jumps: usize,
    /// The number of conditional jumps that choose between copies of a kernel for different processors.
    pub choices: usize,
    /// The number of called functions that panic.
    pub panics: usize,
    /// The stack of the function alone in bytes, including the return address.
    pub frame: u64,
    /// The stack of the deepest chain of calls within the object file, in bytes. The stack of `sin`, `cos` and other
    /// library functions is not included.
    pub stack: u64,
    /// The size of the code, in bytes.
    pub bytes: usize,
}

/// A violation of the claim.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Violation {
    /// The function has conditional jumps.
    Jumps {
        /// The number of jumps.
        count: usize,
        /// The function that contains them.
        place: String,
    },
    /// The function has jumps or calls to addresses in registers or memory.
    Indirect {
        /// The number of such jumps and calls.
        count: usize,
        /// The function that contains them.
        place: String,
    },
    /// The function has instructions that trap.
    Traps {
        /// The number of these instructions.
        count: usize,
        /// The function that contains them.
        place: String,
    },
    /// A function that panics is called.
    Panic {
        /// The function that panics.
        symbol: String,
        /// The function that calls it.
        place: String,
    },
    /// A function is called whose code is not examined.
    Call {
        /// The called function.
        symbol: String,
        /// The function that calls it.
        place: String,
    },
    /// The function calls itself, directly or through others, so its stack is unbounded.
    Recursion,
    /// The function takes more stack than the budget in the robot file or the options allows.
    Stack {
        /// The stack that it takes, in bytes.
        bytes: u64,
        /// The budget, in bytes.
        limit: u64,
    },
}

impl fmt::Display for Violation {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Violation::Jumps { count, place } => {
                write!(formatter, "{count} conditional jumps in {place}")
            }
            Violation::Indirect { count, place } => {
                write!(formatter, "{count} indirect jumps or calls in {place}")
            }
            Violation::Traps { count, place } => {
                write!(formatter, "{count} instructions that trap in {place}")
            }
            Violation::Panic { symbol, place } => {
                write!(formatter, "{place} can panic: it calls {symbol}")
            }
            Violation::Call { symbol, place } => write!(formatter, "{place} calls {symbol}"),
            Violation::Stack { bytes, limit } => {
                write!(formatter, "it takes {bytes} bytes of stack; its budget is {limit}")
            }
            Violation::Recursion => {
                formatter.write_str("it calls itself, so its stack is unbounded")
            }
        }
    }
}

/// Collects the evidence about all functions of an object file.
pub(crate) fn module(object: &Object, roots: &[Root], profile: Profile) -> Result<Module, Error> {
    let listings: Vec<Listing> =
        object.functions.iter().map(|code| Listing::of(object, code)).collect();
    let reader = Reader { object, listings, profile };
    let mut functions = vec![];
    let mut reached = BTreeSet::new();
    if object.table.len() != roots.len() {
        let (found, expected) = (object.table.len(), roots.len());
        return Err(Error::Object(format!("it contains {found} functions, not {expected}")));
    }
    for (root, place) in roots.iter().zip(&object.table) {
        let (evidence, trigonometry) = reader.evidence(*place, &root.path, root.takes_states);
        functions.push(evidence);
        reached.extend(trigonometry);
    }
    let trigonometry = reached.into_iter().map(|place| {
        let evidence = reader.evidence(place, reader.name(place), true).0;
        Evidence { violations: vec![], takes_states: false, ..evidence }
    });
    Ok(Module { profile, functions, trigonometry: trigonometry.collect() })
}

struct Reader<'o> {
    object: &'o Object,
    listings: Vec<Listing>,
    profile: Profile,
}

/// The kind of a function outside the object file.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Outside {
    Circular,
    /// Fills memory with zeros. This is called for large results that are mostly 0.
    Zeros,
    Memory,
    Panic,
    Other,
}

impl Outside {
    fn of(symbol: &str) -> Outside {
        let panics = ["panic", "unwrap_failed", "expect_failed", "_fail", "Unwind", "abort"];
        let plain = symbol.trim_start_matches("__aeabi_").trim_start_matches('_');
        if CIRCULAR.contains(&symbol) {
            Outside::Circular
        } else if ["memset", "memclr"].iter().any(|name| plain.starts_with(name)) {
            Outside::Zeros
        } else if ["memcpy", "memmove"].iter().any(|name| plain.starts_with(name)) {
            Outside::Memory
        } else if panics.iter().any(|part| symbol.contains(part)) {
            Outside::Panic
        } else {
            Outside::Other
        }
    }
}

/// Whether these are functions that copy and fill memory, at least one.
fn only_memory(loaded: &[Referred]) -> bool {
    let is_memory = |referred: &Referred| match referred {
        Referred::Outside(symbol) => {
            matches!(Outside::of(symbol), Outside::Memory | Outside::Zeros)
        }
        _ => false,
    };
    !loaded.is_empty() && loaded.iter().all(is_memory)
}

/// The largest number of conditional jumps in a function that choose between copies of a kernel.
const CHOICES: usize = 2;

impl Reader<'_> {
    /// The name of a function, without the crate.
    fn name(&self, place: usize) -> &str {
        let names = &self.object.functions[place].names;
        let name = names.first().map_or("", String::as_str);
        let name =
            name.strip_prefix(CRATE).and_then(|name| name.strip_prefix("::")).unwrap_or(name);
        name.strip_prefix("model::").unwrap_or(name)
    }

    /// Whether a function is one of the runtime's functions for sines and cosines.
    fn is_trigonometry(&self, place: usize) -> bool {
        let name = self.name(place);
        name.contains("runtime::")
            && ["sin_cos", "::trig::", "::std_trig::"].iter().any(|part| name.contains(part))
    }

    /// Whether a function is one of the runtime's functions that detect the processor.
    fn detects_processor(&self, place: usize) -> bool {
        self.name(place).contains("runtime::processor::x86::detect")
    }

    /// The number of a function's conditional jumps that choose between copies of a kernel for different processors.
    fn choices(&self, place: usize) -> usize {
        let choose = self
            .called(place)
            .any(|callee| self.name(callee).contains("runtime::processor::x86::"));
        if choose { self.listings[place].conditional_jumps.min(CHOICES) } else { 0 }
    }

    /// The evidence about a function, and the functions for sines and cosines that it reaches.
    fn evidence(&self, root: usize, name: &str, takes_states: bool) -> (Evidence, Vec<usize>) {
        let walk = self.walk(root);
        let mut measurements = Measurements {
            functions: walk.functions.len(),
            frame: self.listings[root].frame,
            stack: walk.stack,
            ..Measurements::default()
        };
        let (mut calls, mut violations) = (BTreeMap::<String, usize>::new(), BTreeSet::new());
        if walk.recurs {
            violations.insert(Violation::Recursion);
        }
        for place in &walk.functions {
            let listing = &self.listings[*place];
            measurements.instructions += listing.instructions;
            let choices = self.choices(*place);
            measurements.conditional_jumps += listing.conditional_jumps - choices;
            measurements.choices += choices;
            measurements.bytes += listing.bytes;
            self.add_violations(*place, takes_states, &mut violations);
            for called in &listing.calls {
                let symbol = match called {
                    Referred::Outside(symbol) => symbol,
                    Referred::Function(place)
                        if !walk.functions.contains(place) && !self.detects_processor(*place) =>
                    {
                        self.name(*place)
                    }
                    _ => continue,
                };
                *calls.entry(symbol.to_owned()).or_default() += 1;
            }
        }
        measurements.panics =
            calls.keys().filter(|symbol| Outside::of(symbol) == Outside::Panic).count();
        let nothing_is_claimed = takes_states && self.profile == Profile::Dev;
        let evidence = Evidence {
            name: name.to_owned(),
            takes_states,
            measurements,
            calls: calls.into_iter().collect(),
            violations: if nothing_is_claimed { vec![] } else { violations.into_iter().collect() },
        };
        (evidence, walk.trigonometry)
    }

    /// Adds the violations in one function.
    fn add_violations(
        &self,
        place: usize,
        takes_states: bool,
        violations: &mut BTreeSet<Violation>,
    ) {
        let (listing, here) = (&self.listings[place], self.name(place).to_owned());
        let jumps = if takes_states { 0 } else { listing.conditional_jumps - self.choices(place) };
        if jumps > 0 {
            violations.insert(Violation::Jumps { count: jumps, place: here.clone() });
        }
        // In loops it is not known which load a register is from, but all that is loaded is.
        let calls_memory_alone = takes_states && only_memory(&listing.loaded);
        if listing.indirect > 0 && !calls_memory_alone {
            violations.insert(Violation::Indirect { count: listing.indirect, place: here.clone() });
        }
        if listing.traps > 0 {
            violations.insert(Violation::Traps { count: listing.traps, place: here.clone() });
        }
        for called in &listing.calls {
            let Referred::Outside(symbol) = called else { continue };
            let (symbol, place) = (symbol.clone(), here.clone());
            match Outside::of(&symbol) {
                Outside::Circular | Outside::Zeros => {}
                Outside::Memory if takes_states || self.profile == Profile::Dev => {}
                Outside::Panic => _ = violations.insert(Violation::Panic { symbol, place }),
                Outside::Memory | Outside::Other => {
                    _ = violations.insert(Violation::Call { symbol, place });
                }
            }
        }
    }

    /// The functions of the object file that a function calls.
    fn called(&self, place: usize) -> impl Iterator<Item = usize> {
        self.listings[place].calls.iter().filter_map(|called| match called {
            Referred::Function(place) => Some(*place),
            _ => None,
        })
    }

    /// All functions that a function reaches, in the order in which they are found. In dev, the functions for sines and
    /// cosines are only examined on their own.
    fn walk(&self, root: usize) -> Walk {
        let (stack, recurs) = self.stack(root);
        let enters = self.profile == Profile::Release || self.is_trigonometry(root);
        let mut walk = Walk { functions: vec![root], trigonometry: vec![], stack, recurs };
        let mut next = 0;
        while let Some(place) = walk.functions.get(next) {
            next += 1;
            for callee in self.called(*place).collect::<Vec<_>>() {
                if self.detects_processor(callee) {
                    continue;
                }
                let is_trigonometry = self.is_trigonometry(callee);
                if is_trigonometry && !walk.trigonometry.contains(&callee) {
                    walk.trigonometry.push(callee);
                }
                if (enters || !is_trigonometry) && !walk.functions.contains(&callee) {
                    walk.functions.push(callee);
                }
            }
        }
        walk
    }

    /// The stack of the deepest chain of calls, in bytes, and whether a function calls itself.
    fn stack(&self, root: usize) -> (u64, bool) {
        // Each function is visited twice: when it is entered, and when the stacks of all functions that it calls are
        // known.
        let mut pending = vec![(root, false)];
        let (mut stacks, mut open) = (BTreeMap::<usize, u64>::new(), BTreeSet::new());
        let mut recurs = false;
        while let Some((place, is_done)) = pending.pop() {
            if is_done {
                open.remove(&place);
                let deepest = self.called(place).filter_map(|callee| stacks.get(&callee)).max();
                stacks.insert(place, self.listings[place].frame + deepest.unwrap_or(&0));
            } else if !stacks.contains_key(&place) && open.insert(place) {
                pending.push((place, true));
                for callee in self.called(place) {
                    recurs |= open.contains(&callee);
                    pending.push((callee, false));
                }
            }
        }
        (stacks.get(&root).copied().unwrap_or_default(), recurs)
    }
}

/// The functions that a function reaches.
struct Walk {
    /// The examined functions, starting with the function itself.
    functions: Vec<usize>,
    /// The runtime's functions for sines and cosines.
    trigonometry: Vec<usize>,
    stack: u64,
    recurs: bool,
}

#[cfg(test)]
mod tests {
    use robot_build::File;

    use super::*;
    use crate::{Compiler, Probe};

    /// A module that violates the claim in every way, with some functions that satisfy it.
    const BROKEN: &str = r#"
        pub struct Model { k: [f64; 4] }
        unsafe extern "C" { safe fn measure() -> f64; }
        impl Model {
            pub fn flat(&self, q: &[f64; 2]) -> f64 { let [a, b] = *q; let [k, ..] = self.k; a * k + b }
            pub fn through(&self, q: &[f64; 2]) -> f64 { helper(self.flat(q)) }
            pub fn bounds(&self, index: usize) -> f64 { self.k[index] }
            pub fn jumps(&self, q: &[f64; 2]) -> f64 {
                let mut x = q[0]; while x < q[1] { x = x * x + 1.0; } x
            }
            pub fn calls(&self) -> f64 { measure() }
            pub fn recurs(&self, n: u32) -> u64 {
                if n < 2 { 1 } else { self.recurs(n - 1) ^ self.recurs(n - 2) }
            }
            pub fn by_value(&self, f: fn(f64) -> f64) -> f64 { 1.0 + f(2.0) }
            pub fn many(&self, q: &[f64]) -> f64 { let mut x = 0.0; for q in q { x += q; } x }
            pub fn each(&self, q: &[f64], f: fn(f64) -> f64) -> f64 { q.iter().map(|q| f(*q)).sum() }
        }
        #[inline(never)] fn helper(x: f64) -> f64 { x + 1.0 }
    "#;

    fn broken(profile: Profile) -> Module {
        let file = |path: &str, text: &str| File::text(path, text.to_owned());
        let files =
            vec![file("src/model.rs", BROKEN), file("src/runtime/mod.rs", "//! No runtime.")];
        let probe = Probe::of_files(files, false).unwrap();
        let object = Compiler::default().compile(&probe, profile).unwrap();
        Module::read(&object, &probe.roots, profile).unwrap()
    }

    #[test]
    fn each_violation_is_named() {
        for profile in [Profile::Dev, Profile::Release] {
            let module = broken(profile);
            let of = |name: &str| -> &Evidence {
                module
                    .functions
                    .iter()
                    .find(|found| found.name == format!("Model::{name}"))
                    .unwrap()
            };
            let has = |name: &str, is: fn(&Violation) -> bool| {
                let found = &of(name).violations;
                assert!(found.iter().any(is), "{name}, {}: {found:?}", profile.name());
            };
            assert_eq!(of("flat").violations, []);
            assert_eq!((of("through").violations.len(), of("flat").measurements.panics), (0, 0));
            has(
                "bounds",
                |found| matches!(found, Violation::Panic { symbol, .. } if symbol.contains("bounds")),
            );
            has("jumps", |found| matches!(found, Violation::Jumps { .. }));
            has(
                "calls",
                |found| matches!(found, Violation::Call { symbol, .. } if symbol == "measure"),
            );
            has("recurs", |found| *found == Violation::Recursion);
            has("by_value", |found| matches!(found, Violation::Indirect { count: 1, .. }));
            assert_eq!(of("many").violations, []);
            assert!(of("many").measurements.conditional_jumps > 0);
            assert_eq!(of("bounds").measurements.panics, 1);
            if profile == Profile::Release {
                has("each", |found| matches!(found, Violation::Indirect { .. }));
            }
        }
    }

    #[test]
    fn callees_are_counted_once_and_stacks_add_up() {
        let module = broken(Profile::Dev);
        let [flat, through] = ["Model::flat", "Model::through"].map(|name| {
            module.functions.iter().find(|found| found.name == name).unwrap().measurements
        });
        assert_eq!((flat.functions, through.functions), (1, 3));
        assert!(through.instructions > flat.instructions && through.bytes > flat.bytes);
        assert!(through.stack >= through.frame + flat.stack);
    }
}
