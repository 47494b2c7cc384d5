//! `include_robot!`: a robot file becomes a module at compile time.

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
/// The path is relative to the package's `Cargo.toml`. The module has the robot's name in lower
/// case and is the same that `robot_build` generates in a build script. The crate `robot_runtime`
/// must be a dependency. A change of the file builds again; each thing that is wrong with it is a compile
/// error, the place in the file and the reason on its first line.
///
/// A plan that `robot-symbolic search` pinned beside the file is taken and watched too. The search sets the
/// file's time, so that the first plan is seen; after a plan came in another way, such as a checkout, touch the
/// file.
///
/// Options follow the path:
///
/// ```ignore
/// include_robot!(
///     "robots/trttr1.toml",
///     functions = ["inverse_dynamics", "jacobian_tool"], // ["all"] for all; the file's without this
///     bundles = { dynamics = ["mass_matrix", "bias"] }, // several functions in one call
///     snap = 1e-8,                  // rad; constant angles this near to π/2 · n become that
///     base_frames = "denavit_hartenberg", // of the base parameters; "file" without this
///     scalar = "f32",               // "f64" without this
///     generic = true,               // forms `…_generic` over any scalar of the runtime, lanes too
///     batch = 8,                    // forms `…_batch` over slices of states, in blocks of so many
///     parallel = true,              // forms `…_batch_parallel` over the threads of the crate rayon
///     fused = true,                 // multiply-adds where the target has the instruction
///     trigonometry = "standard",    // "polynomial" without this
///     max_operations = 300,         // of a call of each function; more is an error
///     max_stack = 2048,             // bytes, estimated; more is an error
///     runtime = "::robot_runtime",
///     allow_outside = true,         // the file may lie outside of the package
///     allow_unphysical = true,      // masses and inertias that no body has are warnings
///     allow_massless = true,        // moving links without mass are warnings
/// );
/// ```
///
/// The whole code passes through the editor's analysis: for robots of many joints a build script
/// suits better.
#[proc_macro]
pub fn include_robot(input: TokenStream) -> TokenStream {
    expand::include_robot(input.into()).into()
}
