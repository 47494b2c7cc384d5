//! The builder that a `build.rs` calls.

mod output;
#[cfg(feature = "languages")]
mod package;

use std::path::{Path, PathBuf};

use robot_codegen::{Scalar, Trigonometry};
use robot_dynamics::economical::Plan;
use robot_model::functions::Bundle;
use robot_model::robot::BaseFrames;

use crate::driver::generate::{Generated, generate};
#[cfg(feature = "languages")]
use crate::driver::languages::Language;
use crate::driver::options::{Limbs, Options, functions_named, kinds_named};
use crate::driver::programs::read_with;
use crate::entry::cargo::{self, Directives};
use crate::entry::paths::{RobotFile, robot_files};
use crate::entry::pin::{pin_path, robot_inputs};
use crate::error::{Error, Errors};
use output::Module;

/// Generates the module of one robot file into `OUT_DIR`, with the options of [`Builder::new`].
///
/// # Errors
///
/// Everything that is wrong with the file.
pub fn compile(path: impl AsRef<Path>) -> Result<(), Errors> {
    Builder::new().compile(&[path])
}

/// Generates modules from robot files in a build script.
///
/// ```no_run
/// fn main() -> Result<(), robot_build::Errors> {
///     robot_build::Builder::new()
///         .functions(["inverse_dynamics", "link_wrenches"])
///         .snap(1e-8)
///         .compile(&["robots/left.toml", "robots/right.toml"])
/// }
/// ```
///
/// Each robot becomes a file `<module>.rs` with one module, named after the robot in lower case. If the
/// robot file has another name (`lift.toml` with the robot `lift_scara`), `OUT_DIR` has the same module in
/// `lift.rs` too, unless another robot or robot file is called so. Several robots have an index `robots.rs`
/// beside them, which includes them all. Paths are relative to the package.
///
/// Cargo runs the build script again if a robot file or the plan pinned beside it changes; with
/// that, it no longer watches the other files of the package, as it does if a build script prints no such line.
/// `robot-symbolic search` sets the robot file's time, so that a first plan is seen; after a plan came in
/// another way, such as a checkout, touch the robot file. [`Builder::compile_folder`] notices plans by itself.
#[derive(Clone, Debug, Default)]
#[must_use]
pub struct Builder {
    options: Options,
    functions: Option<Vec<String>>,
    bundles: Vec<(String, Vec<String>)>,
    out_dir: Option<PathBuf>,
    package_dir: Option<PathBuf>,
    allow_outside: bool,
    silent: bool,
    #[cfg(feature = "languages")]
    language: Language,
}

impl Builder {
    /// A builder that generates the usual functions of a robot, in `f64`, into `OUT_DIR`.
    pub fn new() -> Builder {
        Builder::default()
    }

    /// Sets the functions to generate, by name; `"all"` for all functions of the robot, `"jacobian_tool"` for the
    /// function of one frame or moving link.
    ///
    /// The default, without [`Builder::bundle`], is the functions that the robot file chooses with `[code]`; if it
    /// chooses none, those of [`DEFAULT_FUNCTIONS`](crate::DEFAULT_FUNCTIONS) that the robot has.
    pub fn functions(mut self, names: impl IntoIterator<Item = impl Into<String>>) -> Builder {
        self.functions = Some(names.into_iter().map(Into::into).collect());
        self
    }

    /// Adds a bundle: a function of that name that computes several functions, given by name, in one call, with their
    /// common work done once. Call this again for another bundle.
    ///
    /// If there are bundles and no [`Builder::functions`], only bundles are generated.
    pub fn bundle(
        mut self,
        name: impl Into<String>,
        functions: impl IntoIterator<Item = impl Into<String>>,
    ) -> Builder {
        let functions = functions.into_iter().map(Into::into).collect();
        self.bundles.push((name.into(), functions));
        self
    }

    /// Sets the number type of the functions; the default is `f64`.
    pub fn scalar(mut self, scalar: Scalar) -> Builder {
        self.options.scalar = scalar;
        self
    }

    /// Whether each function has a second form `…_generic` over any `Scalar` of the runtime: `f64`,
    /// `f32` and `Lanes` of either. If not called, there is none.
    pub fn generic(mut self, generic: bool) -> Builder {
        self.options.generic = generic;
        self
    }

    /// Gives each function a form `…_batch` over slices of states, computed in blocks of this many states, which LLVM
    /// vectorizes; [`DEFAULT_BATCH`](crate::DEFAULT_BATCH) is a good number. By default there is no such form.
    pub fn batch(mut self, states: usize) -> Builder {
        self.options.batch = Some(states);
        self
    }

    /// Whether each batch also has a form `…_batch_parallel`, on the threads of the crate `rayon`, on which the
    /// package must depend. The default is `false`.
    pub fn parallel(mut self, parallel: bool) -> Builder {
        self.options.parallel = parallel;
        self
    }

    /// Whether products and sums become multiply-adds, which round once on a target that has the instruction and are
    /// a product and a sum elsewhere. The default is `false`: the code then gives the same bits on every target.
    pub fn fused(mut self, fused: bool) -> Builder {
        self.options.fused = fused;
        self
    }

    /// Sets the source of sines and cosines; the default is the runtime's polynomials.
    pub fn trigonometry(mut self, trigonometry: Trigonometry) -> Builder {
        self.options.trigonometry = trigonometry;
        self
    }

    /// Sets how identical limbs are computed; the default is side by side.
    pub fn limbs(mut self, limbs: Limbs) -> Builder {
        self.options.limbs = limbs;
        self
    }

    /// Sets the tolerance of snapping: constant angles within `radians` of a multiple of π/2 become that multiple.
    /// The default is `snap` in the robot file, or 10⁻⁹.
    pub fn snap(mut self, radians: f64) -> Builder {
        self.options.snap = Some(radians);
        self
    }

    /// Sets the frames of the base parameters; the default is `base_frames` in the robot file, or the file's frames.
    pub fn base_frames(mut self, frames: BaseFrames) -> Builder {
        self.options.base_frames = Some(frames);
        self
    }

    /// Sets the path of the runtime in generated code; the default is `::robot_runtime`.
    pub fn runtime(mut self, path: impl Into<String>) -> Builder {
        self.options.runtime = path.into();
        self
    }

    /// Limits the operations of a call of each function: multiplications, additions and divisions. More is an error.
    pub fn max_operations(mut self, limit: u64) -> Builder {
        self.options.max_operations = Some(limit);
        self
    }

    /// Limits the stack of a call of each function, bytes, as [`budget`](crate::driver::budget) estimates it. More is
    /// an error.
    pub fn max_stack(mut self, limit: u64) -> Builder {
        self.options.max_stack = Some(limit);
        self
    }

    /// Sets the form of the economical recursion.
    ///
    /// The default is the plan that `robot-symbolic search` pinned beside the robot file, if there is one; a stale
    /// plan is an error.
    pub fn plan(mut self, plan: Plan) -> Builder {
        self.options.plan = Some(plan);
        self
    }

    /// Sets the language of the code; the default is Rust. In another language, each robot becomes a folder
    /// `<module>` in `OUT_DIR`: the package that `robot-symbolic crate --language` writes for the same plan. A build
    /// script goes on from there: the header `OUT_DIR/trttr1/trttr1.h` is for the crate `cc`. Options of Rust alone
    /// are errors in other languages.
    #[cfg(feature = "languages")]
    pub fn language(mut self, language: Language) -> Builder {
        self.language = language;
        self
    }

    /// Sets the folder for the code; the default is `OUT_DIR`. Use it to commit generated code.
    ///
    /// An existing file with the name of a module that was not generated is not replaced; it is an error.
    pub fn out_dir(mut self, folder: impl Into<PathBuf>) -> Builder {
        self.out_dir = Some(folder.into());
        self
    }

    /// Sets the folder to which paths are relative; the default is that of the package.
    pub fn package_dir(mut self, folder: impl Into<PathBuf>) -> Builder {
        self.package_dir = Some(folder.into());
        self
    }

    /// Whether physically impossible values are accepted, with a warning: negative masses, tensors with a negative
    /// principal moment or one that exceeds the sum of the others.
    pub fn allow_unphysical(mut self, allow: bool) -> Builder {
        self.options.allow_unphysical = allow;
        self
    }

    /// Whether moving links without mass are accepted, with a warning.
    pub fn allow_massless(mut self, allow: bool) -> Builder {
        self.options.allow_massless = allow;
        self
    }

    /// Whether robot files may lie outside the package.
    pub fn allow_outside(mut self, allow: bool) -> Builder {
        self.allow_outside = allow;
        self
    }

    /// Whether Cargo is informed, on standard output, of the files that were read and of warnings; the default is
    /// `true`.
    pub fn emit_directives(mut self, emit: bool) -> Builder {
        self.silent = !emit;
        self
    }

    /// Generates the modules of robot files.
    ///
    /// # Errors
    ///
    /// Everything that is wrong with any of the files or with the options. A `main` that returns it
    /// shows the robot files' own errors. Cargo gets each in a line (`cargo::error=`) and fails the
    /// build, whatever becomes of the result.
    pub fn compile(&self, paths: &[impl AsRef<Path>]) -> Result<(), Errors> {
        let paths: Vec<&Path> = paths.iter().map(AsRef::as_ref).collect();
        self.telling_cargo(|directives| self.run(&paths, directives))
    }

    /// Generates the modules of all robot files `*.toml` of a folder, in the order of their names.
    ///
    /// Cargo runs the build script again if a file is added or removed.
    ///
    /// # Errors
    ///
    /// The errors of [`Builder::compile`]; a folder that cannot be read or has no robot files.
    pub fn compile_folder(&self, folder: impl AsRef<Path>) -> Result<(), Errors> {
        self.telling_cargo(|directives| self.run_folder(folder.as_ref(), directives))
    }

    /// Does the work and gives Cargo the lines that it needs.
    fn telling_cargo(
        &self,
        work: impl FnOnce(&mut Directives) -> Result<(), Errors>,
    ) -> Result<(), Errors> {
        let mut directives = Directives::default();
        let result = work(&mut directives);
        if let Err(errors) = &result {
            directives.errors(errors);
        }
        if !self.silent {
            directives.print();
        }
        result
    }

    fn run_folder(&self, folder: &Path, directives: &mut Directives) -> Result<(), Errors> {
        directives.rerun_if_changed(folder)?;
        let files = robot_files(&self.package()?, folder)?;
        self.run(&files.iter().map(PathBuf::as_path).collect::<Vec<_>>(), directives)
    }

    fn package(&self) -> Result<PathBuf, Error> {
        self.package_dir.clone().map_or_else(cargo::package_dir, Ok)
    }

    fn run(&self, paths: &[&Path], directives: &mut Directives) -> Result<(), Errors> {
        if paths.is_empty() {
            return Err(Errors::from(Error::NoRobots));
        }
        let package = self.package()?;
        let out_dir = self.out_dir.clone().map_or_else(cargo::out_dir, |folder| {
            // A relative folder is the package's, as the robot files are.
            Ok(package.join(folder))
        })?;
        #[cfg(feature = "languages")]
        if self.language != Language::Rust {
            return self.packages(paths, &package, &out_dir, directives);
        }
        let (mut modules, mut errors) = (vec![], vec![]);
        for path in paths {
            match self.module(path, &package, directives) {
                Ok(generated) => {
                    modules.push(Module { path: path.display().to_string(), generated });
                }
                Err(found) => Errors::extend(&mut errors, found),
            }
        }
        let names = modules.iter().map(Module::names);
        let index = (modules.len() > 1).then_some(output::INDEX);
        output::check_names(names, index, &mut errors);
        Errors::check(errors, ())?;
        modules.iter().filter_map(Module::unportable).for_each(|text| directives.warning(&text));
        let inputs = paths.iter().flat_map(|path| robot_inputs(&package.join(path)));
        // A folder of the user's own choice gets no file that was not asked for.
        output::write(&modules, inputs, &out_dir, self.out_dir.is_none())
    }

    fn module(
        &self,
        path: &Path,
        package: &Path,
        directives: &mut Directives,
    ) -> Result<Generated, Errors> {
        let (file, options) = self.read(path, package, directives)?;
        let generated = generate(&file.source, &options)?;
        directives.warnings(&generated.warnings);
        Ok(generated)
    }

    /// A robot file, and the options with the plan that is pinned beside it. Cargo is told to watch both.
    fn read(
        &self,
        path: &Path,
        package: &Path,
        directives: &mut Directives,
    ) -> Result<(RobotFile, Options), Errors> {
        let file = RobotFile::in_package(path, package, self.allow_outside)?;
        directives.rerun_if_changed(path)?;
        // Cargo takes a path that is not there for changed, at every build. That a first plan is seen is up to
        // `robot-symbolic search`, which sets the robot file's time.
        let pin = pin_path(path);
        if package.join(&pin).is_file() {
            directives.rerun_if_changed(&pin)?;
        }
        let options = self.options_for(&file)?;
        let options = file.with_pin(&options)?;
        Ok((file, options))
    }

    /// The options, their functions those of the robot.
    fn options_for(&self, file: &RobotFile) -> Result<Options, Errors> {
        let mut options = self.options.clone();
        if self.functions.is_none() && self.bundles.is_empty() {
            return Ok(options);
        }
        let robot = read_with(&file.source, &options)?.robot;
        if let Some(names) = &self.functions {
            options.functions = functions_named(names, &robot)?;
        }
        for (name, functions) in &self.bundles {
            let functions = kinds_named(functions, &robot)?;
            options.bundles.push(Bundle { name: name.clone(), functions });
        }
        Ok(options)
    }
}

#[cfg(test)]
mod tests;
