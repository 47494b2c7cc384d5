//! `generate`: the module of a robot as a file.

use std::path::Path;

use clap::Args;
use robot_build::check_runtime_path;
use robot_build::languages::{Contents, Language, SourceFile, sources_of};

use crate::Terminal;
use crate::delivery::OutputArguments;
use crate::derived::programs;
use crate::failure::Failure;
use crate::options::{help, value_name};
use crate::progress::watched;
use crate::robot::{CodeArguments, LanguageArgument, RobotArgument};

#[derive(Args)]
#[command(after_help = "Example:
  robot-symbolic generate robots/trttr1.toml -o src/trttr1.rs
  robot-symbolic generate robots/trttr1.toml -o src/trttr1.rs --check
  robot-symbolic generate robots/ur5.toml --function all --batch --fused
  robot-symbolic generate robots/ur5.toml --bundle dynamics=mass_matrix,bias

The file contains one module, named after the robot in lower case; it uses the crate robot_runtime. --check
writes nothing, and the exit code is 1 if the file is out of date.")]
pub(crate) struct Arguments {
    #[command(flatten)]
    robot: RobotArgument,
    #[command(flatten)]
    code: CodeArguments,
    #[arg(long, help = help("runtime"), value_name = value_name("runtime"), default_value = "::robot_runtime", value_parser = runtime)]
    runtime: String,
    #[command(flatten)]
    language: LanguageArgument,
    #[command(flatten)]
    output: OutputArguments,
}

/// Parses a path of the runtime.
fn runtime(text: &str) -> Result<String, String> {
    check_runtime_path(text).map(|()| text.to_owned()).map_err(|error| error.to_string())
}

impl Arguments {
    pub(crate) fn run(&self, terminal: &mut Terminal<'_>) -> Result<(), Failure> {
        let output = self.output.open(self.robot.inputs())?;
        let source = self.robot.source()?;
        let robot = self.robot.read(terminal)?;
        let mut options =
            self.code.options(&self.robot, &robot, self.language.language, terminal)?;
        options.runtime.clone_from(&self.runtime);
        let language = self.language.language;
        let programs = programs(&source, &options, terminal)?;
        let files =
            watched("generating", terminal, || sources_of(&programs, &source, &options, language))?;
        self.check_ending(&files)?;
        let text = text(files, language)?;
        output.deliver(&text, terminal)
    }

    /// Checks that the file's name does not end as that of code in another language.
    fn check_ending(&self, files: &[SourceFile]) -> Result<(), Failure> {
        let ending = |name: &Path| Some(name.extension()?.to_str()?.to_ascii_lowercase());
        let own = files.first().and_then(|file| ending(Path::new(&file.name)));
        let (Some(path), Some(own)) = (self.output.file(), own) else { return Ok(()) };
        let family = |ending: &str| FAMILIES.iter().position(|family| family.contains(&ending));
        let is_other = |given: &String| family(given).is_some_and(|of| family(&own) != Some(of));
        let given = ending(path).filter(is_other);
        match given {
            Some(given) => Err(Failure::Usage(vec![format!(
                "--output: a file in `{}` does not end in `.{given}`; choose the language with --language, or a name \
                 that ends in `.{own}`",
                self.language.language.name()
            )])),
            None => Ok(()),
        }
    }
}

/// The endings of the names of files in languages of one family, and those of robot files and plans.
const FAMILIES: [&[&str]; 8] = [
    &["rs"],
    &["c", "h", "cc", "cpp", "hpp", "cu", "cuh"],
    &["py"],
    &["m"],
    &["js", "mjs", "ts", "mts"],
    &["wgsl"],
    &["wasm"],
    &["toml", "urdf", "plan"],
];

/// The text of the module, if it is a single file in the language.
fn text(mut files: Vec<SourceFile>, language: Language) -> Result<String, Failure> {
    match files.pop() {
        Some(SourceFile { contents: Contents::Text(text), .. }) if files.is_empty() => Ok(text),
        _ => Err(Failure::input(format!(
            "a module in `{}` has several files; write them with `robot-symbolic crate`",
            language.name()
        ))),
    }
}
