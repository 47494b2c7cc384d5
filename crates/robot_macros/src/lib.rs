//! `include_robot!` generates a module from a robot file at compile time.

mod arguments;
mod expand;

use proc_macro::TokenStream;

/// Generates the module of a robot file in place of the macro call.
///
/// ```ignore
/// robot_macros::include_robot!("robots/trttr1.toml");
///
/// let model = trttr1::Model::NOMINAL;
/// ```
///
/// The path is relative to the package's `Cargo.toml`. The module is named like the robot, in lower case, and is the
/// same as the one that `robot_build` generates in a build script. The crate `robot_runtime` must be a dependency. A
/// change of the robot file causes a new build; each problem in it is a compile error, whose first line contains the
/// place in the file and the reason.
///
/// If a plan is pinned beside the robot file by `robot-symbolic search`, it is used and tracked as well. The search
/// updates the time of the robot file, so that a new plan is noticed. If the plan was created in another way, for
/// example by a checkout, touch the robot file.
///
/// Options follow the path:
///
/// ```ignore
/// include_robot!(
///     "robots/trttr1.toml",
///     functions = ["inverse_dynamics", "jacobian_6"], // ["all"] for all; default: those of the robot
///                                   // file, or else the forms of inverse dynamics and `link_wrenches`
///     bundles = { dynamics = ["mass_matrix", "bias"] }, // several functions in one call
///     snap = 1e-8,                  // rad; tolerance within which constant angles become multiples of π/2
///     base_frames = "denavit_hartenberg", // of the base parameters; default: "file"
///     scalar = "f32",               // default: "f64"
///     generic = true,               // functions `…_generic` over any scalar of the runtime, including lanes
///     batch = 8,                    // functions `…_batch` over slices of states, in blocks of this size
///     parallel = true,              // functions `…_batch_parallel` over the threads of the crate rayon
///     fused = true,                 // multiply-add instructions if the target has them
///     limbs = "apart",              // separate code for limbs that are alike; default: "side_by_side"
///     trigonometry = "standard",    // default: "polynomial"
///     max_operations = 300,         // maximum for a call of each function; more is an error
///     max_stack = 2048,             // maximum estimated stack, bytes; more is an error
///     runtime = "::robot_runtime",
///     allow_outside = true,         // the file may be outside the package
///     allow_unphysical = true,      // impossible inertias, and in TOML impossible masses, are accepted
///     allow_massless = true,        // moving links without mass are accepted
/// );
/// ```
///
/// The macro shows errors but no warnings; a build script and `robot-symbolic check` show both.
///
/// An editor analyzes all of the generated code. For robots with many joints, a build script is therefore more
/// suitable.
#[proc_macro]
pub fn include_robot(input: TokenStream) -> TokenStream {
    expand::include_robot(input.into()).into()
}
