//! Errors on the way from a robot file to code.

use std::fmt;
use std::path::{Path, PathBuf};

use robot_model::diagnostic::{Diagnostics, quote, visible};
use robot_model::functions::{ALL_FUNCTIONS, WrongName};
use robot_model::snap::InvalidSnap;

/// An error; its text states the place, the reason and the remedy.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// All errors in a robot file.
    #[error("{0}")]
    Robot(Box<Diagnostics>),
    /// A chosen function that the robot does not have.
    #[error("{robot} has no function `{function}`: {why}")]
    MissingFunction {
        /// The function.
        function: String,
        /// The robot.
        robot: String,
        /// The property that the robot does not have, and the remedy.
        why: &'static str,
    },
    /// A name that is not a function of the robot.
    #[error(transparent)]
    FunctionName(#[from] WrongName),
    /// An invalid bundle.
    #[error("the bundle `{}`: {reason}", quote(bundle))]
    Bundle {
        /// The name of the bundle.
        bundle: String,
        /// The reason.
        reason: String,
    },
    /// An empty list of functions.
    #[error(
        "the list of functions is empty; name some functions, or leave it out to use the \
        default"
    )]
    NoFunctions,
    /// The word for all functions in a list with names of functions.
    #[error(
        "`{ALL_FUNCTIONS}` stands alone: it selects every function except the Jacobians of single links; leave the others out, or name each \
         function instead"
    )]
    AllFunctionsAndOthers,
    /// An invalid snapping tolerance.
    #[error(transparent)]
    Snap(#[from] InvalidSnap),
    /// A number of states that is not a valid block size.
    #[error("a batch cannot have blocks of {states} states; choose 1 to {most}, for example 8")]
    Batch {
        /// The number.
        states: usize,
        /// The largest valid number.
        most: usize,
    },
    /// The option `parallel` without batches.
    #[error("`parallel` applies to batches: set their size with `batch`")]
    ParallelWithoutBatch,
    /// An option that only Rust supports, with another language.
    #[error("the option `{option}` applies to Rust and not to `{language}`; leave it out")]
    OfRust {
        /// The option.
        option: &'static str,
        /// The language.
        language: &'static str,
    },
    /// An error of the code generator.
    #[error("{name}: {error}")]
    Code {
        /// The robot file.
        name: String,
        /// The error.
        error: robot_codegen::Error,
    },
    /// A mass matrix that is singular in every configuration, so forward dynamics has no solution.
    #[error(
        "{name}: the mass matrix is singular in every configuration, so forward dynamics has no \
         solution: the joint torques do not determine the accelerations of {}; give mass or \
         inertia to the links that these joints move, or `armature` to their drives (R0611)",
        quoted(joints)
    )]
    Singular {
        /// The robot file.
        name: String,
        /// The joints whose accelerations are not determined.
        joints: Vec<String>,
    },
    /// Functions with too many expressions.
    #[error(
        "{name}: the functions need more than {limit} expressions; choose fewer functions, or \
         replace long expressions in the file with numbers"
    )]
    TooLarge {
        /// The robot file.
        name: String,
        /// The largest number of expressions.
        limit: usize,
    },
    /// A file that cannot be read or written.
    #[error("cannot {action} {}: {reason}", shown(path))]
    File {
        /// The action that failed.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// The system's message, and the remedy if there is one.
        reason: String,
    },
    /// An output that is an input.
    #[error(
        "{} is not written: it is the input {}, and an output never replaces an input; choose \
         another name",
        shown(path),
        shown(input)
    )]
    IsInput {
        /// The output.
        path: PathBuf,
        /// The input.
        input: PathBuf,
    },
    /// An output that would replace a file that this program did not write.
    #[error("{}{} is not replaced: it {reason}; {remedy}", shown(path), linked(path))]
    Foreign {
        /// The file.
        path: PathBuf,
        /// The reason why it is regarded as foreign.
        reason: &'static str,
        /// The remedy.
        remedy: &'static str,
    },
    /// A robot file, or its pinned plan, outside the package.
    #[error(
        "{} is outside the package {}; a build reads only files of the package: move the file \
         there, or allow it with the option `allow_outside`",
        shown(path),
        shown(package)
    )]
    Outside {
        /// The file, after following symbolic links.
        path: PathBuf,
        /// The folder of the package.
        package: PathBuf,
    },
    /// An environment variable of Cargo that is not set.
    #[error("the environment variable {variable} is not set: {remedy}")]
    NotUnderCargo {
        /// The variable.
        variable: &'static str,
        /// The remedy.
        remedy: &'static str,
    },
    /// A pinned plan that is stale or invalid.
    #[error("{}: {reason}; {remedy}", shown(path))]
    Pin {
        /// The file of the plan.
        path: PathBuf,
        /// The robot file.
        robot: String,
        /// The reason.
        reason: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// A plan for another robot.
    #[error("{name}: the plan does not match the links of this robot; search for a plan again")]
    Plan {
        /// The robot file.
        name: String,
    },
    /// A function that costs more than its limit.
    #[error("{name}: {over}; {}", over.remedy())]
    Budget {
        /// The robot file.
        name: String,
        /// The function and resource over its limit.
        over: crate::driver::budget::Over,
    },
    /// No robot file is given.
    #[error("no robot file is given; name at least one")]
    NoRobots,
    /// A folder without robot files.
    #[error(
        "{}: the folder contains no robot file with the ending `.toml`; name other files one by one",
        shown(folder)
    )]
    NoRobotsInFolder {
        /// The folder.
        folder: PathBuf,
    },
    /// A robot file that is given more than once.
    #[error("{path} is given twice; name it once")]
    SameFile {
        /// The file.
        path: String,
    },
    /// Two files whose modules would have the same name.
    #[error("{first} and {second} both define the module `{module}`; rename one of the robots")]
    SameModule {
        /// The module.
        module: String,
        /// The first file.
        first: String,
        /// The second.
        second: String,
    },
}

/// The names of joints in a message.
pub(crate) fn quoted(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// Prints the text of [`fmt::Display`], because this is shown if `main` returns the error.
impl fmt::Debug for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{self}")
    }
}

/// All errors; never empty.
///
/// Both `Display` and `Debug` print the text for people, so that a `build.rs` whose `main` returns it
/// shows the errors of the robot file.
#[derive(Clone, PartialEq, Eq)]
pub struct Errors(Vec<Error>);

impl Errors {
    /// Returns `Ok(value)` if there are no errors.
    pub(crate) fn check<T>(errors: Vec<Error>, value: T) -> Result<T, Errors> {
        if errors.is_empty() { Ok(value) } else { Err(Errors(errors)) }
    }

    /// Converts errors of code that was made from the file `name`.
    pub(crate) fn of_code(name: &str, errors: &robot_codegen::Errors) -> Errors {
        let errors = errors.as_slice().iter();
        Errors(
            errors
                .map(|error| Error::Code { name: name.to_owned(), error: error.clone() })
                .collect(),
        )
    }

    /// The errors in the order in which they were found.
    #[must_use]
    pub fn as_slice(&self) -> &[Error] {
        &self.0
    }

    pub(crate) fn extend(into: &mut Vec<Error>, errors: Errors) {
        into.extend(errors.0);
    }
}

impl From<Error> for Errors {
    fn from(error: Error) -> Errors {
        Errors(vec![error])
    }
}

impl From<Diagnostics> for Errors {
    fn from(diagnostics: Diagnostics) -> Errors {
        Errors::from(Error::Robot(Box::new(diagnostics)))
    }
}

impl fmt::Display for Errors {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, error) in self.0.iter().enumerate() {
            if index > 0 {
                formatter.write_str("\n")?;
            }
            write!(formatter, "{error}")?;
        }
        Ok(())
    }
}

/// Prints the text for people, starting on a new line.
impl fmt::Debug for Errors {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "\n{self}")
    }
}

impl std::error::Error for Errors {}

/// The apposition to the name of a symbolic link, whose target is the file that would be replaced; otherwise empty.
fn linked(path: &Path) -> String {
    let target = path.read_link().ok();
    target.map_or_else(String::new, |target| format!(", a symbolic link to {},", shown(&target)))
}

/// A path in messages; see [`visible`].
#[must_use]
pub fn shown(path: &Path) -> String {
    visible(&path.to_string_lossy())
}
