//! The options of generation.

mod declared;

pub use declared::{Commands, Group, Kind, OPTIONS, OptionSpec, Value};

use robot_codegen::backend::rust::RustOptions;
use robot_codegen::{Cost, Fused, Scalar, Trigonometry};
use robot_dynamics::economical::Plan;
use robot_dynamics::mechanism::MechanismOptions;
use robot_model::description::{self, Code, MAX_BUNDLES, check_bundle_name};
use robot_model::functions;
use robot_model::functions::{ALL_FUNCTIONS, Bundle, Effects, FunctionKind, Functions};
use robot_model::robot::{BaseFrames, Robot};
use robot_model::snap;

use crate::driver::singular::unsolvable;
use crate::error::{Error, Errors};

/// The functions that are generated if none are chosen, as far as the robot has them.
pub const DEFAULT_FUNCTIONS: [FunctionKind; 5] = [
    FunctionKind::InverseDynamics(Effects::NONE),
    FunctionKind::InverseDynamics(Effects::WRENCH),
    FunctionKind::InverseDynamics(Effects::FRICTION),
    FunctionKind::InverseDynamics(Effects::BOTH),
    FunctionKind::LinkWrenches,
];

/// The states that a block of a batch holds if no other number is given: two or four vector
/// registers of `f64` on most processors.
pub const DEFAULT_BATCH: usize = 8;

/// The most states that a block of a batch holds: its arrays lie on the stack.
const MAX_BATCH: usize = 64;

/// How limbs of a robot that are alike, the legs of a walking machine or the fingers of a hand, are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Limbs {
    /// In the lanes of one call.
    #[default]
    SideBySide,
    /// Each by code of its own.
    Apart,
}

/// The options of generation.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The functions, each by itself. [`Functions::Usual`] without bundles means what the robot file
    /// chooses with `[code]`, and if that chooses nothing, [`DEFAULT_FUNCTIONS`].
    pub functions: Functions,
    /// Functions in one call that compute common expressions once; if [`Options::functions`] are the usual
    /// ones, there are bundles alone.
    pub bundles: Vec<Bundle>,
    /// The number type of the functions.
    pub scalar: Scalar,
    /// Whether each function has a second form `…_generic` over any `Scalar` of the runtime: `f64`,
    /// `f32` and lanes of either.
    pub generic: bool,
    /// The number of states in a block of the forms `…_batch` over slices of states; `None` for no
    /// such forms.
    pub batch: Option<usize>,
    /// Whether each batch has a form `…_batch_parallel` too, over the threads of the crate `rayon`: a
    /// dependency of the crate around the code, an optional one of a whole generated crate.
    pub parallel: bool,
    /// Whether products and sums become multiply-adds, which round once on a target that has the
    /// instruction (the runtime's `FUSED`) and are a product and a sum elsewhere. Without this the
    /// code gives the same bits on every target.
    pub fused: bool,
    /// The source of sines and cosines.
    pub trigonometry: Trigonometry,
    /// Whether limbs of a robot that are alike are computed in the lanes of one call.
    pub limbs: Limbs,
    /// Constant angles within this many radians of a multiple of π/2 become that multiple; `None`
    /// for what the robot file says, which is 10⁻⁹ if it says nothing.
    pub snap: Option<f64>,
    /// Over which parameters of links the base parameters are; `None` for what the robot file says,
    /// which is the file's frames if it says nothing.
    pub base_frames: Option<BaseFrames>,
    /// Whether values that no body can have are accepted, with a warning.
    pub allow_unphysical: bool,
    /// Whether moving links without mass are taken, with a warning.
    pub allow_massless: bool,
    /// The path of the runtime crate or module in generated code.
    pub runtime: String,
    /// The form of the economical recursion; `None` for one that suits most arms, or is searched.
    pub plan: Option<Plan>,
    /// The most operations that a call of any of the functions may take; those of the robot file's
    /// budgets hold beside it.
    pub max_operations: Option<u64>,
    /// The most bytes of stack that a call of any of the functions may take, as
    /// [`budget`](crate::driver::budget) estimates it.
    pub max_stack: Option<u64>,
    /// Whether to search the cheapest form if none is given: a second or so for an arm of seven
    /// joints in an optimized build, and tens of seconds in a build script, which is not.
    pub search: bool,
}

/// The usual functions at one state, `f64`, plain operations, the runtime's sine and cosine,
/// angles snapped within 10⁻⁹ rad.
impl Default for Options {
    fn default() -> Options {
        let rust = RustOptions::default();
        Options {
            functions: Functions::Usual,
            bundles: vec![],
            scalar: rust.scalar,
            generic: rust.generic,
            batch: rust.batch,
            parallel: false,
            fused: false,
            trigonometry: rust.trigonometry,
            limbs: Limbs::default(),
            snap: None,
            base_frames: None,
            allow_unphysical: false,
            allow_massless: false,
            runtime: rust.runtime,
            plan: None,
            max_operations: None,
            max_stack: None,
            search: false,
        }
    }
}

impl Options {
    /// With the functions that a robot file chooses, if these options choose none.
    pub(crate) fn or_of_file(&self, code: &Code) -> Options {
        if self.functions != Functions::Usual || !self.bundles.is_empty() {
            return self.clone();
        }
        let Code { functions, bundles } = code.clone();
        Options { functions, bundles, ..self.clone() }
    }

    /// The functions to generate for a robot, and the bundles.
    ///
    /// # Errors
    ///
    /// Each chosen function that the robot lacks, with the reason.
    pub(crate) fn functions_of(
        &self,
        robot: &Robot,
    ) -> Result<(Vec<FunctionKind>, Vec<Bundle>), Errors> {
        let has = |kind: &FunctionKind| kind.missing_in(robot).is_none();
        let functions = match &self.functions {
            Functions::Usual if !self.bundles.is_empty() => vec![],
            Functions::Usual => DEFAULT_FUNCTIONS.into_iter().filter(has).collect(),
            Functions::All => {
                let mut all = FunctionKind::of_robot(robot);
                let lacking = unsolvable(robot, self).map_or(vec![], |lacking| lacking.functions);
                all.retain(|kind| !lacking.contains(kind));
                all
            }
            Functions::Chosen(chosen) => once(chosen, robot),
        };
        let of_bundle = |bundle: &Bundle| {
            let Bundle { name, functions } = bundle;
            Bundle { name: name.clone(), functions: once(functions, robot) }
        };
        let bundles: Vec<Bundle> = self.bundles.iter().map(of_bundle).collect();
        let named = functions.iter().chain(bundles.iter().flat_map(|bundle| &bundle.functions));
        let mut named: Vec<FunctionKind> = once(named, robot);
        named.retain(|kind| !has(kind));
        let missing = named.into_iter().filter_map(|kind| {
            let why = kind.missing_in(robot)?;
            let function = kind.full_name(robot);
            Some(Error::MissingFunction { function, robot: robot.name.clone(), why })
        });
        Errors::check(missing.collect(), (functions, bundles))
    }

    /// Errors in bundles that do not depend on the robot.
    fn wrong_bundles(&self) -> Vec<Error> {
        let mut errors = vec![];
        for (index, bundle) in self.bundles.iter().enumerate() {
            let mut report = |reason: String| {
                errors.push(Error::Bundle { bundle: bundle.name.clone(), reason });
            };
            if let Err(reason) = check_bundle_name(&bundle.name) {
                report(format!("the name is not allowed: {reason}"));
            }
            if self.bundles.iter().take(index).any(|earlier| earlier.is_alike(bundle)) {
                report(
                    "the name is that of another bundle, or differs from it only in case or \
                     underscores"
                        .to_owned(),
                );
            }
            if bundle.functions.is_empty() {
                report("it has no functions; name some".to_owned());
            }
        }
        if let Some(last) = self.bundles.get(MAX_BUNDLES) {
            let reason = format!(
                "at most {MAX_BUNDLES} bundles are allowed; combine more \
                functions in one bundle"
            );
            errors.push(Error::Bundle { bundle: last.name.clone(), reason });
        }
        errors
    }

    /// Errors in the options that do not depend on the robot.
    pub(crate) fn check(&self) -> Result<(), Errors> {
        let mut errors = self.wrong_bundles();
        let snap = self.snap.map(snap::check);
        errors.extend(snap.and_then(Result::err).map(Error::Snap));
        if let Some(states) = self.batch.filter(|states| !(1..=MAX_BATCH).contains(states)) {
            errors.push(Error::Batch { states, most: MAX_BATCH });
        }
        if self.parallel && self.batch.is_none() {
            errors.push(Error::ParallelWithoutBatch);
        }
        Errors::check(errors, ())
    }

    /// The options of reading a robot file.
    #[must_use]
    pub fn reading(&self) -> description::Options {
        description::Options {
            allow_massless: self.allow_massless,
            allow_unphysical: self.allow_unphysical,
            ..description::Options::default()
        }
    }

    /// The options of making programs of expressions.
    pub(crate) fn codegen(&self) -> robot_codegen::Options {
        let options = robot_codegen::Options::default();
        if self.fused {
            robot_codegen::Options {
                fused: Fused::WhereTarget,
                cost: Cost::Instructions,
                ..options
            }
        } else {
            options
        }
    }

    /// The options of making expressions of the robot.
    pub(crate) fn mechanism(&self, robot: &Robot) -> MechanismOptions {
        MechanismOptions::ROUNDED.with_snap(self.snap, robot)
    }
}

/// The functions in their order, each once; that of a frame is left out if all frames' are there.
fn once<'f>(
    functions: impl IntoIterator<Item = &'f FunctionKind>,
    robot: &Robot,
) -> Vec<FunctionKind> {
    let mut found: Vec<FunctionKind> = vec![];
    for kind in functions {
        if !found.contains(kind) {
            found.push(*kind);
        }
    }
    let parts: Vec<FunctionKind> = found.iter().flat_map(|kind| kind.parts(robot)).collect();
    found.retain(|kind| !parts.contains(kind));
    found
}

/// The functions of a robot of those names; [`ALL_FUNCTIONS`] among them means all.
///
/// # Errors
///
/// Each name that is not a function's, and an empty list.
pub fn functions_named(names: &[String], robot: &Robot) -> Result<Functions, Errors> {
    if names.is_empty() {
        return Err(Errors::from(Error::NoFunctions));
    }
    let (all, names): (Vec<_>, Vec<_>) =
        names.iter().cloned().partition(|name| name == ALL_FUNCTIONS);
    let kinds = kinds_named(&names, robot)?;
    Ok(if all.is_empty() { Functions::Chosen(kinds) } else { Functions::All })
}

/// The functions of a robot of those names.
///
/// # Errors
///
/// Each name that is not a function's.
pub fn kinds_named(names: &[String], robot: &Robot) -> Result<Vec<FunctionKind>, Errors> {
    let (mut kinds, mut errors) = (vec![], vec![]);
    for name in names {
        match functions::named(robot, name) {
            Ok(kind) => kinds.push(kind),
            Err(error) => errors.push(Error::FunctionName(error)),
        }
    }
    Errors::check(errors, kinds)
}
