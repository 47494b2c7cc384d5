//! The robot file of a command, and the options for its code.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use robot_build::languages::Language;
use robot_build::{
    BaseFrames, Bundle, Functions, Limbs, OptionSpec, Options, RobotFile, Source, Trigonometry,
    Value, robot_inputs,
};
use robot_document::Form;
use robot_dynamics::limbs::like_limbs;
use robot_dynamics::mechanism::{Snap, snapped};
use robot_model::description::Described;
use robot_model::robot::Robot;
use robot_model::snap;

use crate::Terminal;
use crate::failure::Failure;
use crate::function::{bundles, functions};
use crate::help::MODEL;
use crate::options::{CodeOptions, choice, help, value_name};
use crate::plan::pinned_or_searched;
use crate::reading::ReadingArguments;
use crate::suggested::FUNCTIONS;
use crate::{text, values};

/// The tolerance, in rad, within which printed constant angles become multiples of π/2, if neither an option nor the
/// file gives one. Files often have 1.5708 for π/2.
pub(crate) const PRINT_SNAP: f64 = 1e-5;

/// The robot file.
#[derive(Args)]
pub(crate) struct RobotArgument {
    /// The robot file
    file: PathBuf,
    #[arg(long, value_name = value_name("snap"), help_heading = MODEL, help = help("snap"), value_parser = snap, allow_hyphen_values = true)]
    snap: Option<f64>,
    #[arg(long, value_name = value_name("base_frames"), help_heading = MODEL, help = help("base_frames"), value_parser = base_frames())]
    base_frames: Option<BaseFrames>,
    #[command(flatten)]
    pub(crate) reading: ReadingArguments,
}

/// Parses a snapping tolerance.
fn snap(text: &str) -> Result<f64, String> {
    let angle = values::number(text).map_err(|wrong| {
        format!("{wrong}: a tolerance is an angle in radians between 0 and {}", snap::MAX)
    })?;
    snap::check(angle).map_err(|wrong| wrong.to_string())
}

/// The parser for the name of the frames of base parameters.
fn base_frames() -> impl TypedValueParser<Value = BaseFrames> {
    choice("base_frames").map(|name| BaseFrames::from_name(&name).unwrap_or_default())
}

impl RobotArgument {
    /// Reads the text of the file.
    pub(crate) fn source(&self) -> Result<Source, Failure> {
        Ok(RobotFile::read(&self.file)?.source)
    }

    /// Opens the file, which is read once for all uses in a command.
    pub(crate) fn open(&self) -> Result<OpenRobot<'_>, Failure> {
        Ok(OpenRobot { argument: self, file: RobotFile::read(&self.file)? })
    }

    /// Reads the robot; prints warnings.
    pub(crate) fn read(&self, terminal: &mut Terminal<'_>) -> Result<Described, Failure> {
        self.open()?.read(terminal)
    }

    /// Reads the robot as it is printed; prints warnings.
    pub(crate) fn printed(&self, terminal: &mut Terminal<'_>) -> Result<Robot, Failure> {
        Ok(self.printed_with_snaps(terminal)?.0)
    }

    /// Does the same, and also returns the angles that differ from those of the file.
    pub(crate) fn printed_with_snaps(
        &self,
        terminal: &mut Terminal<'_>,
    ) -> Result<(Robot, Vec<Snap>), Failure> {
        let robot = self.read(terminal)?.robot;
        self.snapped(&robot, terminal)
    }

    /// Returns a robot as it is printed: constant angles within the tolerance of a multiple of π/2 become that
    /// multiple. A note about this is printed if neither an option nor the file sets the tolerance.
    pub(crate) fn snapped(
        &self,
        robot: &Robot,
        terminal: &mut Terminal<'_>,
    ) -> Result<(Robot, Vec<Snap>), Failure> {
        let given = self.snap.or(robot.snap);
        let (shown, snaps) = snapped(robot, given.unwrap_or(PRINT_SNAP));
        if given.is_none() {
            terminal.errors.write_all(text::snapped_for_print(robot, &snaps).as_bytes())?;
        }
        Ok((shown, snaps))
    }

    /// Prints a note if frames of base parameters are given but the equations do not have base parameters.
    pub(crate) fn check_base_frames(
        &self,
        forms: &[Form],
        terminal: &mut Terminal<'_>,
    ) -> Result<(), Failure> {
        if self.base_frames.is_some() && !forms.contains(&Form::Regrouped) {
            let message = match forms {
                [] => "note: --base-frames has no effect here, only on base parameters",
                _ => "note: --base-frames has no effect in this form, only in the form regrouped",
            };
            writeln!(terminal.errors, "{message}")?;
        }
        Ok(())
    }

    /// Prints a note if frames of base parameters are given but none of the chosen functions has base parameters.
    pub(crate) fn check_base_frames_of(
        &self,
        functions: &Functions,
        bundles: &[Bundle],
        terminal: &mut Terminal<'_>,
    ) -> Result<(), Failure> {
        let chosen = match functions {
            Functions::All => return Ok(()),
            Functions::Usual => &[][..],
            Functions::Chosen(kinds) => kinds,
        };
        let mut all = chosen.iter().chain(bundles.iter().flat_map(|bundle| &bundle.functions));
        if all.any(|kind| kind.has_base_parameters()) {
            Ok(())
        } else {
            self.check_base_frames(&[], terminal)
        }
    }

    /// The snapping tolerance in rad, if one is given.
    pub(crate) fn snap(&self) -> Option<f64> {
        self.snap
    }

    /// The options of [`OpenRobot::options`].
    pub(crate) fn options(&self, terminal: &mut Terminal<'_>) -> Result<Options, Failure> {
        self.open()?.options(terminal)
    }

    /// The options of commands that generate code, for which a stale plan is an error, as in builds.
    fn code_options(&self) -> Result<Options, Failure> {
        Ok(RobotFile::read(&self.file)?.with_pin(&self.unpinned())?)
    }

    fn unpinned(&self) -> Options {
        Options {
            snap: self.snap,
            base_frames: self.base_frames,
            search: true,
            ..self.reading.options()
        }
    }

    /// The files that are read for the robot.
    pub(crate) fn inputs(&self) -> [PathBuf; 2] {
        robot_inputs(&self.file)
    }

    /// The path of the file.
    pub(crate) fn path(&self) -> &std::path::Path {
        &self.file
    }
}

/// A robot file that was read.
pub(crate) struct OpenRobot<'a> {
    argument: &'a RobotArgument,
    file: RobotFile,
}

impl OpenRobot<'_> {
    /// The text of the file.
    pub(crate) fn source(&self) -> &Source {
        &self.file.source
    }

    /// The argument that names the file.
    pub(crate) fn argument(&self) -> &RobotArgument {
        self.argument
    }

    /// Reads the robot; prints warnings.
    pub(crate) fn read(&self, terminal: &mut Terminal<'_>) -> Result<Described, Failure> {
        let mut described = self.argument.reading.read(self.source(), terminal)?;
        let robot = &mut described.robot;
        robot.base_frames = self.argument.base_frames.unwrap_or(robot.base_frames);
        Ok(described)
    }

    /// Applies the reader's checks to the robot with other values of parameters.
    pub(crate) fn check_values(
        &self,
        described: &Described,
        values: &[(&str, f64)],
        terminal: &mut Terminal<'_>,
    ) -> Result<(), Failure> {
        self.argument.reading.check_values(self.source(), described, values, terminal)
    }

    /// The default options of commands that compute, with the snapping tolerance and the pinned plan. If no plan is
    /// pinned, the plan with the fewest operations is searched for; so it is, after a warning, if the pinned plan
    /// cannot be used.
    pub(crate) fn options(&self, terminal: &mut Terminal<'_>) -> Result<Options, Failure> {
        pinned_or_searched(&self.file, self.argument.unpinned(), terminal)
    }
}

/// What code is made.
#[derive(Args)]
pub(crate) struct CodeArguments {
    #[arg(long = "function", help = help("functions"), value_name = value_name("functions"), value_delimiter = ',',
          value_parser = FUNCTIONS)]
    functions: Vec<String>,
    #[command(flatten)]
    bundles: BundleArguments,
    #[command(flatten)]
    target: CodeOptions,
}

/// The language of code.
#[derive(Args)]
pub(crate) struct LanguageArgument {
    /// Language of the code
    #[arg(long, value_name = "LANGUAGE", default_value = Language::default().name(), value_parser = language())]
    pub(crate) language: Language,
}

/// The parser for the name of a language.
fn language() -> impl TypedValueParser<Value = Language> {
    let word = |one: &Language| {
        let also = OTHER_NAMES.iter().filter(|(_, name)| *name == one.name()).map(|(also, _)| also);
        PossibleValue::new(one.name()).help(one.title()).aliases(also)
    };
    let words = PossibleValuesParser::new(Language::ALL.iter().map(word));
    words.map(|word| {
        let other = OTHER_NAMES.iter().find(|(also, _)| *also == word);
        Language::named(other.map_or(word.as_str(), |(_, name)| name)).unwrap_or_default()
    })
}

/// Other names of languages, as people may write them.
const OTHER_NAMES: [(&str, &str); 5] = [
    ("c++", "cpp"),
    ("octave", "matlab"),
    ("js", "javascript"),
    ("typescript", "javascript"),
    ("node", "javascript"),
];

/// Functions in one call.
#[derive(Args)]
pub(crate) struct BundleArguments {
    #[arg(long = "bundle", help = help("bundles"), value_name = value_name("bundles"), value_parser = bundle)]
    bundles: Vec<(String, Vec<String>)>,
}

/// Parses a bundle such as `dynamics=mass_matrix,bias`.
fn bundle(text: &str) -> Result<(String, Vec<String>), String> {
    let expected = "expected NAME=FUNCTION,…, such as dynamics=mass_matrix,bias";
    let (name, functions) = text.split_once('=').ok_or(expected)?;
    let functions = functions.split(',').map(|name| name.trim().to_owned());
    Ok((name.trim().to_owned(), functions.collect()))
}

impl BundleArguments {
    /// Makes the bundles, with the functions of a robot.
    pub(crate) fn bundles(&self, robot: &Robot) -> Result<Vec<Bundle>, Failure> {
        bundles(&self.bundles, robot)
    }
}

impl CodeArguments {
    /// The options for code; if all functions are chosen, reports those that the robot does not have.
    pub(crate) fn options(
        &self,
        file: &RobotArgument,
        described: &Described,
        language: Language,
        terminal: &mut Terminal<'_>,
    ) -> Result<Options, Failure> {
        let robot = &described.robot;
        let functions = match self.functions.as_slice() {
            [] => Functions::Usual,
            names => functions(names, robot)?,
        };
        let bundles = self.bundles.bundles(robot)?;
        let mut options = Options { functions, bundles, ..file.code_options()? };
        self.target.set(&mut options);
        let of_file = options.functions == Functions::Usual && options.bundles.is_empty();
        let (wanted, bundles) = match of_file {
            true => (&described.code.functions, &described.code.bundles),
            false => (&options.functions, &options.bundles),
        };
        if *wanted == Functions::All {
            text::lacking(robot, &options, terminal)?;
        }
        file.check_base_frames_of(wanted, bundles, terminal)?;
        self.check_effects(robot, &options, language, terminal)?;
        Ok(options)
    }

    /// Prints a note for each option without effect on code in this language.
    fn check_effects(
        &self,
        robot: &Robot,
        options: &Options,
        language: Language,
        terminal: &mut Terminal<'_>,
    ) -> Result<(), Failure> {
        let name = language.name();
        if options.fused && !language.has_multiply_add() {
            writeln!(
                terminal.errors,
                "note: --fused: `{name}` has no instruction that multiplies and adds, so products and sums stay separate"
            )?;
        }
        if !self.target.is_given("limbs") {
            return Ok(());
        }
        let standard = options.trigonometry == Trigonometry::Standard;
        let why = match language {
            Language::Rust if standard && options.limbs == Limbs::SideBySide => {
                "with --trigonometry standard; each limb has separate code"
            }
            Language::Rust if like_limbs(robot).is_none() => {
                "on this robot: it has parameters, or no limbs that are alike"
            }
            Language::Rust => return Ok(()),
            _ => "outside Rust; each limb has separate code",
        };
        writeln!(terminal.errors, "note: --limbs has no effect {why}")?;
        Ok(())
    }
}

/// The parser for the name of the source of sines and cosines.
pub(crate) fn trigonometry() -> impl TypedValueParser<Value = Trigonometry> {
    choice("trigonometry").map(|word| {
        let mut options = Options::default();
        let option = OptionSpec::named("trigonometry");
        let _ = option.and_then(|option| option.set(&mut options, Value::Word(&word)));
        options.trigonometry
    })
}
