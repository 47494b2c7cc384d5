//! The crate that is compiled: the code of a robot, the runtime, and a table of the public functions.

use robot_build::{File, Options, Programs, Source, Trigonometry, package};
use syn::{FnArg, ImplItem, Item, ItemFn, Signature, Type, Visibility};

use crate::error::Error;

/// The name of the compiled crate.
pub(crate) const CRATE: &str = "probe";
/// The file of the crate root.
pub(crate) const ROOT_FILE: &str = "src/probe.rs";

/// The symbol of the table with the addresses of all public functions.
pub(crate) const TABLE: &str = "ROBOT_FUNCTIONS";

/// A public function of generated code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Root {
    /// The path in the module, such as `Model::inverse_dynamics`.
    pub path: String,
    /// Whether it takes several states: slices, arrays of slices (columns), or arrays of arrays (a block).
    pub takes_states: bool,
}

/// A crate of generated code of which all public functions are compiled.
#[derive(Clone, Debug)]
pub struct Probe {
    /// The files.
    pub(crate) files: Vec<File>,
    /// Whether the code needs the standard library.
    pub(crate) needs_std: bool,
    /// The public functions that are not generic, in the order of the source.
    pub roots: Vec<Root>,
}

impl Probe {
    /// The crate that `robot-symbolic crate` writes, with another crate root.
    ///
    /// # Errors
    ///
    /// All errors in the robot file or the options.
    pub fn new(programs: &Programs, source: &Source, options: &Options) -> Result<Probe, Error> {
        // The parallel forms of batches call rayon, which the compiler alone does not have.
        let options = &Options { parallel: false, ..options.clone() };
        let files = package::package_of(programs, source, options)?;
        Probe::of_files(files, options.trigonometry == Trigonometry::Standard)
    }

    /// A crate with the modules `model` and `runtime`.
    pub(crate) fn of_files(mut files: Vec<File>, needs_std: bool) -> Result<Probe, Error> {
        let model = files.iter().find(|file| file.path == "src/model.rs");
        let roots =
            model.and_then(|file| file.contents.text()).map(roots).transpose()?.unwrap_or_default();
        files.push(File::text(ROOT_FILE, root_text(&roots)));
        Ok(Probe { files, needs_std, roots })
    }
}

/// The text of the crate root. Inline functions are compiled because their addresses are taken, and the table
/// identifies each function even if the compiler keeps only one of several equal ones.
fn root_text(roots: &[Root]) -> String {
    let addresses = roots.iter().map(|root| format!("    model::{} as *const (),\n", root.path));
    let (count, addresses) = (roots.len(), addresses.collect::<String>());
    format!(
        "#![no_std]\npub mod model;\npub mod runtime;\n\
         pub struct Table(pub [*const (); {count}]);\n\
         unsafe impl Sync for Table {{}}\n\
         #[unsafe(no_mangle)]\npub static {TABLE}: Table = Table([\n{addresses}]);\n"
    )
}

/// The public functions of a file that are not generic.
fn roots(text: &str) -> Result<Vec<Root>, Error> {
    let file = syn::parse_file(text)
        .map_err(|error| Error::Object(format!("the generated code is not valid Rust: {error}")))?;
    let mut roots = vec![];
    for item in file.items {
        match item {
            Item::Impl(item) if item.trait_.is_none() => {
                let Type::Path(ty) = &*item.self_ty else { continue };
                let Some(ty) = ty.path.get_ident() else { continue };
                for method in &item.items {
                    if let ImplItem::Fn(method) = method {
                        roots.extend(root(&method.vis, &method.sig, &format!("{ty}::")));
                    }
                }
            }
            Item::Fn(ItemFn { vis, sig, .. }) => roots.extend(root(&vis, &sig, "")),
            _ => {}
        }
    }
    Ok(roots)
}

fn root(visibility: &Visibility, signature: &Signature, prefix: &str) -> Option<Root> {
    let is_public = matches!(visibility, Visibility::Public(_));
    if !is_public || !signature.generics.params.is_empty() {
        return None;
    }
    let is_of_states = |argument: &FnArg| match argument {
        FnArg::Typed(argument) => holds_states(&argument.ty),
        FnArg::Receiver(_) => false,
    };
    Some(Root {
        path: format!("{prefix}{}", signature.ident),
        takes_states: signature.inputs.iter().any(is_of_states),
    })
}

/// Whether a type is a slice, an array of slices or an array of arrays, or a reference to one.
fn holds_states(ty: &Type) -> bool {
    match ty {
        Type::Reference(reference) => holds_states(&reference.elem),
        Type::Slice(_) => true,
        Type::Array(array) => matches!(&*array.elem, Type::Array(_)) || holds_states(&array.elem),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn public_functions_that_are_not_generic_are_roots() {
        let text = "impl Model { pub const fn new() -> Model { Model } fn hidden() {} \
             pub fn many(&self, q: &[[f64; 2]]) {} pub fn generic<T>(x: T) {} \
             pub fn columns(&self, q: [&[f64]; 2]) {} pub fn block(&self, q: &[[f64; 8]; 2]) {} }\n\
             impl Default for Model { fn default() -> Model { Model } }\n\
             pub fn free(q: &[f64; 2]) {}";
        let found = roots(text).unwrap();
        let found: Vec<_> = found.iter().map(|root| (&*root.path, root.takes_states)).collect();
        let expected = [
            ("Model::new", false),
            ("Model::many", true),
            ("Model::columns", true),
            ("Model::block", true),
            ("free", false),
        ];
        assert_eq!(found, expected);
        assert!(roots("fn {").is_err());
    }
}
