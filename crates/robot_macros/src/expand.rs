//! The expansion of `include_robot!`.

use std::path::{Path, PathBuf};

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use robot_build::{RobotFile, generate, pin_path, read_with};

use crate::arguments::Arguments;

/// The module, or the errors.
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
    // The text starts on a line of its own, so that the excerpts of the file stay aligned.
    let failed = |error: &dyn std::fmt::Display| syn::Error::new(span, format!("\n{error}"));
    let path = PathBuf::from(arguments.path.value());
    let file = RobotFile::in_package(&path, package, arguments.allow_outside)
        .map_err(|errors| failed(&errors))?;
    let absolute = file.path.to_str().ok_or_else(|| failed(&"the file's path is not UTF-8"))?;
    // Makes the compiler watch the file, also where there is something wrong with it.
    let mut watch = quote!(
        const _: &[u8] = ::core::include_bytes!(#absolute);
    );
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
                    Err(errors) => failed(&errors).to_compile_error(),
                }
            }
            Err(error) => error.to_compile_error(),
        },
        Err(errors) => failed(&errors).to_compile_error(),
    };
    let mut tokens = module;
    watch.to_tokens(&mut tokens);
    Ok(tokens)
}

#[cfg(test)]
mod tests;
