//! The printer of Rust code.
//!
//! [`generate`] returns a syntax tree, which prints as text ([`RustModule::to_text`]) or as tokens.
//! The code uses only `core` and the runtime, allocates nothing, cannot panic and has no
//! conditionals: arrays are split by patterns, every named value is a `let`, and only the
//! runtime's scalar functions are called.

mod batch;
mod body;
mod doc;
mod function;
mod items;
mod kernel;
mod keywords;
mod lanes;
mod limbs;
mod matrices;
mod namer;
mod names;
mod number;
mod options;
mod outputs;
mod parts;
mod scope;
mod setters;
pub mod stack;
mod syntax;
mod variables;

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Item, parse_quote};

pub use self::namer::identifier;
pub use self::names::{Names, names, output_names};
pub use self::options::{Parallel, RustOptions, Wrapping};
use self::scope::Scope;
pub use self::scope::check_runtime_path;
use super::common;
use super::{Language, SourceFile, Target};
use crate::error::Errors;
use crate::module::Module;
use crate::program::Limits;

/// Rust, as a language of printed code.
///
/// rustc overflows its stack on a few thousand `let`s in one block, but compiles expressions of a few operations and
/// functions of 8,000 statements well.
pub const LANGUAGE: Language = Language {
    name: "Rust",
    extension: "rs",
    reserved: &[keywords::RESERVED],
    modules: keywords::MODULES,
    limits: Limits { expression: 6, block: 256, function: 8000, part: 1024 },
};

impl Target for RustOptions {
    fn language(&self) -> &'static Language {
        &LANGUAGE
    }

    /// Prints one file, for any [`Wrapping`].
    fn files(&self, module: &Module) -> Result<Vec<SourceFile>, Errors> {
        let text = generate(module, self)?.to_text();
        let name = format!("{}.{}", LANGUAGE.module_name(&module.name), LANGUAGE.extension);
        Ok(vec![SourceFile::text(name, text)])
    }
}

/// The lints that generated code does not satisfy, most of them because its names come from robot files and because
/// straight-line arithmetic is long and has constants with many digits.
const ALLOWED_LINTS: [&str; 17] = [
    // Users of a module do not use all of its functions.
    "dead_code",
    "non_snake_case",
    "non_camel_case_types",
    // The text can be included in a private module.
    "unreachable_pub",
    "clippy::approx_constant",
    "clippy::doc_markdown",
    "clippy::excessive_precision",
    "clippy::large_types_passed_by_value",
    "clippy::many_single_char_names",
    // A macro's code is on one line.
    "clippy::possible_missing_comma",
    "clippy::similar_names",
    "clippy::suboptimal_flops",
    "clippy::too_many_arguments",
    "clippy::too_many_lines",
    "clippy::type_complexity",
    "clippy::unreadable_literal",
    "clippy::unused_self",
];

/// The lints that a file of [`Wrapping::Items`] should allow.
#[must_use]
pub fn allowed_lints() -> &'static [&'static str] {
    &ALLOWED_LINTS
}

/// The Rust code of a module.
#[derive(Clone)]
pub struct RustModule {
    header: Vec<String>,
    file: syn::File,
}

impl RustModule {
    /// The text, with the header as a comment.
    #[must_use]
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        for line in &self.header {
            text.push_str(format!("// {}", common::comment_line(line)).trim_end());
            text.push('\n');
        }
        if !text.is_empty() {
            text.push('\n');
        }
        text.push_str(&prettyplease::unparse(&self.file));
        text
    }

    /// The tokens, for macros. They contain documentation, but no other comments.
    #[must_use]
    pub fn to_tokens(&self) -> TokenStream {
        self.file.to_token_stream()
    }
}

/// Prints a module as Rust.
///
/// # Errors
///
/// The runtime path is not a path, or constants are outside the range of the scalar type `f32`.
pub fn generate(module: &Module, options: &RustOptions) -> Result<RustModule, Errors> {
    let mut scope = Scope::new(module, options)?;
    let mut items = items::constants(&mut scope);
    items.extend(items::parameters(&scope));
    items.extend(items::model(&mut scope));
    if scope.has_parameters() {
        let is_const = items::is_const(&module.constructor);
        items.extend(setters::items(&scope, is_const));
    }
    for (function, name) in module.functions.iter().zip(scope.functions.clone()) {
        items.extend(function::items(&mut scope, function, &name));
    }
    Ok(RustModule {
        header: options.header.clone(),
        file: syn::File {
            shebang: None,
            frontmatter: None,
            attrs: vec![],
            items: wrap(module, options, items),
        },
    })
}

fn wrap(module: &Module, options: &RustOptions, items: Vec<Item>) -> Vec<Item> {
    match options.wrapping {
        Wrapping::Items => items,
        Wrapping::Module => {
            let name = namer::Namer::default().name(&module.name);
            let mut docs = common::paragraphs(&module.doc, &module.name);
            docs.push(format!("- {}", options.trigonometry.range_of_angles()));
            let docs = doc::attributes(&docs);
            let lints = ALLOWED_LINTS.iter();
            let lints = lints.filter_map(|lint| syn::parse_str::<syn::Path>(lint).ok());
            let mut wrapped: syn::ItemMod = parse_quote! {
                #(#docs)*
                #[allow(#(#lints),*)]
                pub mod #name {}
            };
            if let Some((_, content)) = &mut wrapped.content {
                *content = items;
            }
            vec![Item::Mod(wrapped)]
        }
    }
}
