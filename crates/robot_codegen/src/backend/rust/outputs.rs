//! Return types and values of functions.

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::{Expr, Item, Type, parse_quote};

use super::doc;
use super::namer::ident;
use super::names::output_names;
use super::number::Number;
use super::scope::Scope;
use super::syntax;
use crate::backend::common;
use crate::module::{Function, Output};

/// The type that holds several outputs; generic if the function has a generic form.
pub(super) fn type_item(scope: &Scope<'_>, function: &Function, generic: bool) -> Option<Item> {
    let name = scope.output_type(function)?;
    let title = common::markdown_line(&function.name);
    let docs = doc::attributes(&[format!("The outputs of {title}.")]);
    let stored = scope.number.ty();
    let (parameters, ty): (Option<TokenStream>, Type) =
        if generic { (Some(quote!(<T = #stored>)), parse_quote!(T)) } else { (None, stored) };
    let fields = function.outputs.iter().zip(fields(function)).map(|(output, name)| {
        let text = common::quantity(&output.doc, &output.name, &output.unit, &output.shape);
        let docs = doc::attributes(&[text]);
        let ty = syntax::shaped_type(&ty, &output.shape);
        quote!(#(#docs)* pub #name: #ty)
    });
    Some(parse_quote! {
        #(#docs)*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #name #parameters { #(#fields),* }
    })
}

/// The fields of the type that holds several outputs.
pub(super) fn fields(function: &Function) -> Vec<Ident> {
    output_names(function).iter().map(|name| ident(name)).collect()
}

/// For each output, the expression for its value in the variable `result`: the variable itself or a field.
pub(super) fn of_result(scope: &Scope<'_>, function: &Function) -> Vec<Expr> {
    match scope.output_type(function) {
        None => vec![parse_quote!(result)],
        Some(_) => fields(function).iter().map(|field| parse_quote!(result.#field)).collect(),
    }
}

/// The type that a function returns.
pub(super) fn returned(scope: &Scope<'_>, function: &Function, number: &Number) -> Type {
    match (scope.output_type(function), function.outputs.as_slice()) {
        (None, [output]) => syntax::shaped_type(&number.ty(), &output.shape),
        (Some(name), _) if number.is_generic() => parse_quote!(#name<T>),
        (name, _) => parse_quote!(#name),
    }
}

/// Combines the results of a program into the value that its function returns.
pub(super) fn value(scope: &Scope<'_>, function: &Function, results: Vec<Expr>) -> Expr {
    let mut results = results.into_iter();
    let mut values = function.outputs.iter().map(|output| shape(output, &mut results));
    match scope.output_type(function) {
        None => values.next().unwrap_or_else(|| syntax::tuple(vec![])),
        Some(name) => {
            let fields = fields(function).into_iter().zip(values);
            let fields = fields.map(|(name, value)| syntax::field_value(&name, &value));
            parse_quote!(#name { #(#fields),* })
        }
    }
}

/// Combines the next results into the shape of an output.
fn shape(output: &Output, results: &mut impl Iterator<Item = Expr>) -> Expr {
    let mut next = |count: usize| results.by_ref().take(count).collect::<Vec<_>>();
    match output.shape.as_slice() {
        [] => syntax::tuple(next(1)),
        [rows, columns] => syntax::array((0..*rows).map(|_| syntax::array(next(*columns)))),
        _ => syntax::array(next(output.len())),
    }
}
