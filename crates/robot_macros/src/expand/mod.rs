//! The expansion of `include_robot!`.

use std::path::{Path, PathBuf};

use proc_macro2::{Span, TokenStream};
use quote::{ToTokens, quote};
use robot_build::{Errors, Problem, RobotFile, generate, pin_path, read_with};

use crate::arguments::Arguments;

/// Returns the module or the compile errors.
pub(crate) fn include_robot(input: TokenStream) -> TokenStream {
    let expanded = syn::parse2(input).and_then(|arguments: Arguments| {
        let package = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
        let package = package.ok_or_else(|| {
            let message = "CARGO_MANIFEST_DIR is not set: build with Cargo";
            syn::Error::new(arguments.path.span(), message)
        })?;
        expand(&arguments, &package)
    });
    expanded.unwrap_or_else(|error| error.to_compile_error())
}

fn expand(arguments: &Arguments, package: &Path) -> syn::Result<TokenStream> {
    let span = arguments.path.span();
    let path = PathBuf::from(arguments.path.value());
    let mut file = RobotFile::in_package(&path, package, arguments.allow_outside)
        .map_err(|errors| failed(span, &errors))?;
    if let Some(shown) = std::env::current_dir().ok().and_then(|folder| shown(&file.path, &folder))
    {
        file.source.name = shown;
    }
    let absolute = file.path.to_str().ok_or_else(|| {
        let message = format!("{}: the path of the file is not UTF-8; rename it", path.display());
        syn::Error::new(span, message)
    })?;
    // Makes the compiler track the file, even if it contains errors.
    let mut watch = quote!(
        const _: &[u8] = ::core::include_bytes!(#absolute);
    );
    // A plan that does not exist cannot be tracked; `robot-symbolic search` therefore updates the time of the robot
    // file.
    let pin = pin_path(&file.path);
    if let Some(pin) = pin.to_str().filter(|_| pin.is_file()) {
        watch.extend(quote!(
            const _: &[u8] = ::core::include_bytes!(#pin);
        ));
    }
    let module: TokenStream = match read_with(&file.source, &arguments.options) {
        Ok(described) => match arguments.options_for(&described.robot) {
            Ok(options) => {
                let options = file.with_pin(&options);
                match options.and_then(|options| generate(&file.source, &options)) {
                    Ok(generated) => generated.code.parse()?,
                    Err(errors) => failed(span, &errors).to_compile_error(),
                }
            }
            Err(error) => error.to_compile_error(),
        },
        Err(errors) => failed(span, &errors).to_compile_error(),
    };
    let mut tokens = module;
    watch.to_tokens(&mut tokens);
    Ok(tokens)
}

/// The path in the form in which the compiler shows paths: relative to the folder in which it runs, which for a member
/// of a workspace is the folder of the workspace. `None` if the file is elsewhere.
fn shown(file: &Path, folder: &Path) -> Option<String> {
    let path = file.strip_prefix(folder.canonicalize().ok()?).ok()?;
    path.to_str().map(str::to_owned)
}

/// Returns one error for each problem. The first line contains the problem and its place, because lists of problems and
/// `--message-format short` show only this line.
fn failed(span: Span, errors: &Errors) -> syn::Error {
    let problems = errors.problems().into_iter();
    let each = problems.map(|Problem { headline, details }| {
        let message = format!("{headline}\n{details}");
        syn::Error::new(span, message.trim_end())
    });
    let joined = each.reduce(|mut all, one| {
        all.combine(one);
        all
    });
    joined.unwrap_or_else(|| syn::Error::new(span, errors))
}

#[cfg(test)]
mod tests;
