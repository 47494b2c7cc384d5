//! The options of generated code, each declared once. The macro, the command line, the builder's tests and the
//! table in the book take names, values and texts from here.

use robot_codegen::{Scalar, Trigonometry};
use robot_model::robot::BaseFrames;

use super::{DEFAULT_BATCH, Limbs, Options};

/// An option of generated code.
#[derive(Clone, Copy, Debug)]
pub struct OptionSpec {
    /// The name of the builder's setter and of the macro's key; the flag of the command line has `-` for `_`.
    pub name: &'static str,
    /// The subject of the option, for tables.
    pub title: &'static str,
    /// The effect of the option, as in the help of the command line.
    pub help: &'static str,
    /// The purpose of the option.
    pub group: Group,
    /// The values of the option.
    pub kind: Kind,
    /// An example of a value, in the syntax of the macro.
    pub example: &'static str,
    /// The commands that have the option.
    pub commands: Commands,
    /// The name of the value in the help of the command line; empty for flags, and if the name of the option suffices.
    pub value_name: &'static str,
    /// The option without which this one has no effect, if there is one.
    pub requires: Option<&'static str>,
    /// The key of a robot file that sets the option for every entry point.
    pub in_file: Option<&'static str>,
    set: fn(&mut Options, Value<'_>) -> Option<()>,
}

/// The purpose of an option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Reading the robot file.
    Read,
    /// Choosing what is derived.
    Derive,
    /// Optimizing programs.
    Optimize,
    /// Printing programs for a target.
    Print,
    /// Limiting operations and stack.
    Limit,
}

/// The commands that have an option. Only flags, counts and choices of [`Commands::Code`] become arguments from the
/// table alone; others have an argument of their own in the command, which takes its texts from here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Commands {
    /// The commands that read a robot.
    Robot,
    /// The commands that generate code.
    Code,
    /// The command that makes a module for a crate of the user.
    Module,
    /// None, because the robot file sets it or it has no meaning in commands.
    None,
}

/// The values of an option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Yes or no.
    Flag,
    /// A whole number. `default` is its value if the flag on the command line has none.
    Count {
        /// The value of the flag without a number, if that is allowed; see [`Kind::Count`].
        default: Option<usize>,
    },
    /// An angle in rad.
    Angle,
    /// One of several words, each with its meaning unless the word is clear. The first is the default.
    Choice(&'static [(&'static str, &'static str)]),
    /// A Rust path.
    Path,
    /// Names of functions.
    Functions,
    /// Names, each with names of functions.
    Bundles,
}

/// A value of an option.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<'v> {
    /// A value of [`Kind::Flag`].
    Flag(bool),
    /// A value of [`Kind::Count`].
    Count(u64),
    /// A value of [`Kind::Angle`].
    Number(f64),
    /// A value of [`Kind::Choice`] or [`Kind::Path`].
    Word(&'v str),
}

impl Value<'_> {
    fn flag(self) -> Option<bool> {
        if let Value::Flag(flag) = self { Some(flag) } else { None }
    }

    fn count(self) -> Option<u64> {
        if let Value::Count(count) = self { Some(count) } else { None }
    }

    fn size(self) -> Option<usize> {
        // A number that does not fit is larger than any limit of sizes.
        self.count().map(|count| usize::try_from(count).unwrap_or(usize::MAX))
    }

    fn number(self) -> Option<f64> {
        if let Value::Number(number) = self { Some(number) } else { None }
    }

    fn word(&self) -> Option<&str> {
        if let Value::Word(word) = self { Some(word) } else { None }
    }
}

impl OptionSpec {
    /// Finds the option with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static OptionSpec> {
        OPTIONS.iter().find(|option| option.name == name)
    }

    /// Reads a value in the syntax of the macro and of tables; `None` for functions and bundles, and if the text is
    /// not a value of the option.
    #[must_use]
    pub fn value<'v>(&self, text: &'v str) -> Option<Value<'v>> {
        let quoted = || text.strip_prefix('"')?.strip_suffix('"');
        match self.kind {
            Kind::Flag => text.parse().ok().map(Value::Flag),
            Kind::Count { .. } => text.parse().ok().map(Value::Count),
            Kind::Angle => text.parse().ok().map(Value::Number),
            Kind::Choice(words) => {
                let is_known = |word: &&str| words.iter().any(|(known, _)| known == word);
                quoted().filter(is_known).map(Value::Word)
            }
            Kind::Path => quoted().map(Value::Word),
            Kind::Functions | Kind::Bundles => None,
        }
    }

    /// The flag of the command line. The flag of a list is in the singular, because it can be given several times.
    #[must_use]
    pub fn flag(&self) -> String {
        let name = match self.kind {
            Kind::Functions | Kind::Bundles => self.name.trim_end_matches('s'),
            _ => self.name,
        };
        format!("--{}", name.replace('_', "-"))
    }

    /// Sets the option in `options`; `None` if the value has the wrong kind. Functions and bundles, whose names
    /// depend on the robot, and options that concern only files change nothing.
    pub fn set(&self, options: &mut Options, value: Value<'_>) -> Option<()> {
        (self.set)(options, value)
    }
}

/// The common properties of options.
const PLAIN: OptionSpec = OptionSpec {
    name: "",
    title: "",
    help: "",
    group: Group::Print,
    kind: Kind::Flag,
    example: "true",
    commands: Commands::Code,
    value_name: "",
    requires: None,
    in_file: None,
    set: |_, _| Some(()),
};

/// All options, in the order of messages and tables.
pub const OPTIONS: &[OptionSpec] = &[
    OptionSpec {
        name: "functions",
        title: "functions to generate; `all` for every function of the robot",
        help: "Functions to generate, separated by commas; `all` for every function of the \
            robot, `jacobian_NAME` and `jacobian_dot_qd_NAME` for one frame or moving \
            link [default: those of the robot file's [code], else the forms of inverse dynamics \
            and `link_wrenches`]",
        group: Group::Derive,
        kind: Kind::Functions,
        value_name: "NAME",
        example: "[\"mass_matrix\"]",
        in_file: Some("[code] functions"),
        ..PLAIN
    },
    OptionSpec {
        name: "bundles",
        title: "several functions in one call",
        help: "A function that computes several functions in one call and shares their work; can \
            be repeated",
        group: Group::Derive,
        kind: Kind::Bundles,
        value_name: "NAME=FUNCTION,…",
        example: "{ dynamics = [\"mass_matrix\", \"bias\"] }",
        in_file: Some("[code] bundles"),
        ..PLAIN
    },
    OptionSpec {
        name: "snap",
        title: "angles near multiples of π/2",
        help: "Snap constant angles within RAD of a multiple of π/2 to that multiple [default: the robot file's `snap`, \
               else 1e-9 for code and 1e-5 in print]",
        group: Group::Derive,
        kind: Kind::Angle,
        value_name: "RAD",
        example: "1e-6",
        commands: Commands::Robot,
        in_file: Some("[robot] snap"),
        set: |options, value| value.number().map(|angle| options.snap = Some(angle)),
        ..PLAIN
    },
    OptionSpec {
        name: "base_frames",
        title: "[frames of the base parameters](base-parameters.md#in-other-frames)",
        help: "Frames of the base parameters and their regressor: the file's, or \
            Denavit-Hartenberg frames, in which the regressor needs fewer operations [default: \
            the robot file's `base_frames`, else file]",
        group: Group::Derive,
        kind: Kind::Choice(&[("file", ""), ("denavit_hartenberg", "")]),
        value_name: "FRAMES",
        example: "\"denavit_hartenberg\"",
        commands: Commands::Robot,
        in_file: Some("[robot] base_frames"),
        set: |options, value| {
            options.base_frames = Some(BaseFrames::from_name(value.word()?)?);
            Some(())
        },
        ..PLAIN
    },
    OptionSpec {
        name: "scalar",
        title: "`f32` instead of `f64`",
        help: "Number type of the functions",
        kind: Kind::Choice(&[("f64", ""), ("f32", "")]),
        example: "\"f32\"",
        set: |options, value| {
            options.scalar = match value.word()? {
                "f64" => Scalar::F64,
                "f32" => Scalar::F32,
                _ => return None,
            };
            Some(())
        },
        ..PLAIN
    },
    OptionSpec {
        name: "generic",
        title: "forms over any scalar",
        help: "Add a generic form `…_generic` to each function, for any scalar of the runtime: \
            f64, f32 and lanes",
        set: |options, value| value.flag().map(|flag| options.generic = flag),
        ..PLAIN
    },
    OptionSpec {
        name: "batch",
        title: "forms over slices of states",
        help: "Add a batch form `…_batch` to each function, for slices of states, computed in \
            blocks of this many states",
        kind: Kind::Count { default: Some(DEFAULT_BATCH) },
        value_name: "STATES",
        example: "16",
        set: |options, value| value.size().map(|states| options.batch = Some(states)),
        ..PLAIN
    },
    OptionSpec {
        name: "parallel",
        title: "batches over threads",
        help: "Add a parallel form `…_batch_parallel` to each batch, on the threads of the crate \
            rayon; needs batches",
        requires: Some("batch"),
        set: |options, value| value.flag().map(|flag| options.parallel = flag),
        ..PLAIN
    },
    OptionSpec {
        name: "fused",
        title: "multiply-adds",
        help: "Use instructions that multiply and add with a single rounding, if the target \
            supports them",
        group: Group::Optimize,
        set: |options, value| value.flag().map(|flag| options.fused = flag),
        ..PLAIN
    },
    OptionSpec {
        name: "trigonometry",
        title: "source of sine and cosine",
        help: "Source of sines and cosines",
        kind: Kind::Choice(&[
            (
                "polynomial",
                "The runtime's branch-free polynomials, for angles below 2³⁰ rad (2¹⁷ in f32); \
                 NaN for larger angles",
            ),
            (
                "standard",
                "The standard library, for angles of any size; the generated code then \
                requires it",
            ),
        ]),
        example: "\"standard\"",
        set: |options, value| {
            options.trigonometry = match value.word()? {
                "polynomial" => Trigonometry::Polynomial,
                "standard" => Trigonometry::Standard,
                _ => return None,
            };
            Some(())
        },
        ..PLAIN
    },
    OptionSpec {
        name: "limbs",
        title: "[limbs that are alike](generated-code.md#limbs-that-are-alike)",
        help: "Code for legs, fingers or arms on a fixed base that differ only in numbers",
        group: Group::Optimize,
        kind: Kind::Choice(&[
            ("side_by_side", "In the lanes of one call, if functions use the runtime's sines"),
            ("apart", "Separate code for each"),
        ]),
        example: "\"apart\"",
        set: |options, value| {
            options.limbs = match value.word()? {
                "side_by_side" => Limbs::SideBySide,
                "apart" => Limbs::Apart,
                _ => return None,
            };
            Some(())
        },
        ..PLAIN
    },
    OptionSpec {
        name: "max_operations",
        title: "maximum number of operations of a function",
        help: "Maximum number of operations of a function call",
        group: Group::Limit,
        kind: Kind::Count { default: None },
        example: "300",
        commands: Commands::None,
        in_file: Some("[[budget]] max_operations"),
        set: |options, value| value.count().map(|limit| options.max_operations = Some(limit)),
        ..PLAIN
    },
    OptionSpec {
        name: "max_stack",
        title: "maximum bytes of stack of a function",
        help: "Maximum number of bytes of stack of a function call",
        group: Group::Limit,
        kind: Kind::Count { default: None },
        example: "2048",
        commands: Commands::None,
        in_file: Some("[[budget]] max_stack"),
        set: |options, value| value.count().map(|limit| options.max_stack = Some(limit)),
        ..PLAIN
    },
    OptionSpec {
        name: "runtime",
        title: "path of the runtime",
        help: "Path of the runtime in the generated code",
        kind: Kind::Path,
        value_name: "PATH",
        example: "\"::robot_runtime\"",
        commands: Commands::Module,
        set: |options, value| value.word().map(|path| options.runtime = path.to_owned()),
        ..PLAIN
    },
    OptionSpec {
        name: "allow_outside",
        title: "robot files outside the package",
        help: "Accept a robot file outside the package",
        group: Group::Read,
        commands: Commands::None,
        set: |_, value| value.flag().map(drop),
        ..PLAIN
    },
    OptionSpec {
        name: "allow_unphysical",
        title: "physically impossible inertias",
        help: "Accept physically impossible inertias, and such masses in a robot file, with a \
            warning",
        group: Group::Read,
        commands: Commands::Robot,
        set: |options, value| value.flag().map(|allow| options.allow_unphysical = allow),
        ..PLAIN
    },
    OptionSpec {
        name: "allow_massless",
        title: "massless moving links",
        help: "Accept massless moving links, with a warning",
        group: Group::Read,
        commands: Commands::Robot,
        set: |options, value| value.flag().map(|allow| options.allow_massless = allow),
        ..PLAIN
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_are_words_of_the_command_line() {
        for (name, flag) in [
            ("functions", "--function"),
            ("bundles", "--bundle"),
            ("allow_massless", "--allow-massless"),
            ("base_frames", "--base-frames"),
            ("snap", "--snap"),
        ] {
            assert_eq!(OptionSpec::named(name).map(OptionSpec::flag).as_deref(), Some(flag));
        }
    }

    #[test]
    fn each_example_changes_one_thing() {
        // These depend on the robot, concern only files, or have the value that is set anyway.
        const SAME: [&str; 4] = ["functions", "bundles", "allow_outside", "runtime"];
        for option in OPTIONS {
            assert_eq!(OptionSpec::named(option.name).unwrap().title, option.title);
            let mut options = Options::default();
            match option.value(option.example) {
                Some(value) => {
                    assert_eq!(option.set(&mut options, value), Some(()), "{}", option.name);
                }
                None => assert!(matches!(option.kind, Kind::Functions | Kind::Bundles)),
            }
            let is_flag = option.kind == Kind::Flag;
            assert!(!is_flag || option.value_name.is_empty(), "{}", option.name);
            if let Kind::Count { .. } = option.kind
                && option.commands == Commands::Code
            {
                assert!(!option.value_name.is_empty(), "{}", option.name);
            }
            let required = option.requires.map(OptionSpec::named);
            assert!(required.is_none_or(|found| found.is_some()), "{}", option.name);
            let is_same = options == Options::default();
            assert_eq!(is_same, SAME.contains(&option.name), "{}", option.name);
        }
    }

    #[test]
    fn values_of_another_kind_are_refused() {
        for option in OPTIONS {
            let mut options = Options::default();
            let wrong = match option.kind {
                Kind::Flag => Value::Count(1),
                _ => Value::Flag(true),
            };
            let is_list = matches!(option.kind, Kind::Functions | Kind::Bundles);
            assert_eq!(option.set(&mut options, wrong).is_some(), is_list, "{}", option.name);
            if let Kind::Choice(_) = option.kind {
                assert_eq!(option.value("\"x\""), None);
                assert_eq!(option.set(&mut options, Value::Word("x")), None);
            }
            assert_eq!(options, Options::default());
        }
    }
}
