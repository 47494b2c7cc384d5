//! The builder for build scripts.

mod earlier;
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
/// All errors in the file.
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
/// robot file has another name (`lift.toml` with the robot `lift_scara`), `OUT_DIR` also has the same module in
/// `lift.rs`, unless another robot or robot file has this name, or it is `robots`. If there are several robots, the
/// file `robots.rs` includes them all. Paths are relative to the package.
///
/// Cargo runs the build script again if a robot file or its pinned plan changes. It then no longer watches the other
/// files of the package, as it would if the build script named no files to watch. `robot-symbolic search` updates the
/// modification time of the robot file, so that Cargo notices a first plan; if a plan is added in another way, such as
/// by a checkout, touch the robot file. [`Builder::compile_folder`] notices new plans by itself.
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
    /// Makes a builder that generates the usual functions of a robot, in `f64`, into `OUT_DIR`.
    pub fn new() -> Builder {
        Builder::default()
    }

    /// Sets the functions to generate, by name; `"all"` means all functions of the robot, and a name such as
    /// `"jacobian_tool"` the function of one frame or moving link.
    ///
    /// Without [`Builder::bundle`], the default is the functions that the robot file chooses with `[code]` or, if it
    /// chooses none, those of [`DEFAULT_FUNCTIONS`](crate::DEFAULT_FUNCTIONS) that the robot has.
    pub fn functions(mut self, names: impl IntoIterator<Item = impl Into<String>>) -> Builder {
        self.functions = Some(names.into_iter().map(Into::into).collect());
        self
    }

    /// Adds a bundle: a function with this name that computes several functions, given by name, in one call and shares
    /// their common work. Call this again for another bundle.
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

    /// Sets whether each function has a second form `…_generic` over any `Scalar` of the runtime: `f64`,
    /// `f32` and `Lanes` of either. The default is `false`.
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

    /// Sets whether each batch also has a form `…_batch_parallel`, on the threads of the crate `rayon`, on which the
    /// package must depend. The default is `false`.
    pub fn parallel(mut self, parallel: bool) -> Builder {
        self.options.parallel = parallel;
        self
    }

    /// Sets whether products and sums become multiply-adds, which round once on targets that have the instruction and
    /// are a product and a sum elsewhere. The default is `false`, so that the code gives the same bits on every target.
    pub fn fused(mut self, fused: bool) -> Builder {
        self.options.fused = fused;
        self
    }

    /// Sets the source of sines and cosines; the default is the runtime's polynomials.
    pub fn trigonometry(mut self, trigonometry: Trigonometry) -> Builder {
        self.options.trigonometry = trigonometry;
        self
    }

    /// Sets how limbs that are alike are computed; the default is side by side.
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

    /// Limits the operations of a call of each function: multiplications, additions and divisions. More are an error.
    pub fn max_operations(mut self, limit: u64) -> Builder {
        self.options.max_operations = Some(limit);
        self
    }

    /// Limits the stack of a call of each function in bytes, as [`budget`](crate::driver::budget) estimates it. More is
    /// an error.
    pub fn max_stack(mut self, limit: u64) -> Builder {
        self.options.max_stack = Some(limit);
        self
    }

    /// Sets the form of the economical recursion.
    ///
    /// The default is the plan that `robot-symbolic search` pinned next to the robot file, if there is one; a stale
    /// plan is an error.
    pub fn plan(mut self, plan: Plan) -> Builder {
        self.options.plan = Some(plan);
        self
    }

    /// Sets the language of the code; the default is Rust. In another language, each robot becomes a folder
    /// `<module>` in `OUT_DIR`: the package that `robot-symbolic crate --language` writes for the same plan. The build
    /// script can then process it, for example the header `OUT_DIR/trttr1/trttr1.h` with the crate `cc`. Options that
    /// only Rust supports are errors in other languages.
    #[cfg(feature = "languages")]
    pub fn language(mut self, language: Language) -> Builder {
        self.language = language;
        self
    }

    /// Sets the folder for the code; the default is `OUT_DIR`. Use it to commit generated code.
    ///
    /// An existing file with the name of a module that was not generated is not replaced; it is an error. Files of
    /// earlier builds stay as they are, also if their robot has another name now; in `OUT_DIR` they no longer compile.
    pub fn out_dir(mut self, folder: impl Into<PathBuf>) -> Builder {
        self.out_dir = Some(folder.into());
        self
    }

    /// Sets the folder to which paths are relative; the default is the folder of the package.
    pub fn package_dir(mut self, folder: impl Into<PathBuf>) -> Builder {
        self.package_dir = Some(folder.into());
        self
    }

    /// Sets whether physically impossible values are accepted, with a warning: negative masses, and inertia tensors
    /// with a principal moment that is negative or exceeds the sum of the others. In URDF, an excess of at most 10 % is
    /// always only a warning.
    pub fn allow_unphysical(mut self, allow: bool) -> Builder {
        self.options.allow_unphysical = allow;
        self
    }

    /// Sets whether moving links without mass are accepted, with a warning.
    pub fn allow_massless(mut self, allow: bool) -> Builder {
        self.options.allow_massless = allow;
        self
    }

    /// Sets whether robot files may be outside the package.
    pub fn allow_outside(mut self, allow: bool) -> Builder {
        self.allow_outside = allow;
        self
    }

    /// Sets whether lines for Cargo about warnings and the files that were read are printed on standard output; the
    /// default is `true`.
    pub fn emit_directives(mut self, emit: bool) -> Builder {
        self.silent = !emit;
        self
    }

    /// Generates the modules of robot files.
    ///
    /// # Errors
    ///
    /// All errors in any of the files or in the options. If `main` returns them, they are shown as the errors of the
    /// robot files. Each is also printed as a line for Cargo (`cargo::error=`), which makes the build fail even if the
    /// result is ignored.
    pub fn compile(&self, paths: &[impl AsRef<Path>]) -> Result<(), Errors> {
        let paths: Vec<&Path> = paths.iter().map(AsRef::as_ref).collect();
        self.with_directives(|directives| self.run(&paths, directives))
    }

    /// Generates the modules of all robot files `*.toml` of a folder, in the order of their names.
    ///
    /// Cargo runs the build script again if a file is added or removed.
    ///
    /// # Errors
    ///
    /// The errors of [`Builder::compile`], and a folder that cannot be read or has no robot files.
    pub fn compile_folder(&self, folder: impl AsRef<Path>) -> Result<(), Errors> {
        self.with_directives(|directives| self.run_folder(folder.as_ref(), directives))
    }

    /// Does the work and prints the lines for Cargo.
    fn with_directives(
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
        if files.is_empty() {
            return Err(Errors::from(Error::NoRobotsInFolder { folder: folder.to_owned() }));
        }
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
            // A relative folder is relative to the package, as robot files are.
            Ok(package.join(folder))
        })?;
        #[cfg(feature = "languages")]
        if self.language != Language::Rust {
            let written = self.packages(paths, &package, &out_dir, directives)?;
            return self.disable_earlier(&out_dir, written);
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
        // In a folder that the user chose, only the requested files are written.
        let written = output::write(&modules, inputs, &out_dir, self.out_dir.is_none())?;
        self.disable_earlier(&out_dir, written)
    }

    /// Disables the files of earlier builds. A folder that the user chose can contain other files.
    fn disable_earlier(&self, folder: &Path, written: Vec<PathBuf>) -> Result<(), Errors> {
        match self.out_dir {
            None => earlier::disable_earlier(folder, written),
            Some(_) => Ok(()),
        }
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

    /// Reads a robot file; returns it with the options, which include its pinned plan. Cargo will watch both files.
    fn read(
        &self,
        path: &Path,
        package: &Path,
        directives: &mut Directives,
    ) -> Result<(RobotFile, Options), Errors> {
        let file = RobotFile::in_package(path, package, self.allow_outside)?;
        directives.rerun_if_changed(path)?;
        // Cargo regards a missing path as changed in every build, so it is not watched. It notices a first plan because
        // `robot-symbolic search` updates the modification time of the robot file.
        let (beside, read) = (pin_path(path), pin_path(&file.path));
        if read.is_file() {
            // If the path of the file is a symbolic link, its plan is elsewhere.
            let is_beside = package.join(&beside).canonicalize().ok() == read.canonicalize().ok();
            directives.rerun_if_changed(if is_beside { &beside } else { &read })?;
        }
        let options = self.options_for(&file)?;
        let options = file.with_pin(&options)?;
        Ok((file, options))
    }

    /// Returns the options with the functions of the robot that have the chosen names.
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
