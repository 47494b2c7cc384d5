//! Very long bodies, cut into functions.

use proc_macro2::{Ident, Literal};
use quote::{format_ident, quote};
use syn::{Expr, ImplItem, Stmt, parse_quote};

use super::body::Body;
use super::number::Number;
use super::scope::Scope;
use super::syntax;
use crate::program::Source;

/// A function whose body can be cut.
pub(super) struct CutFunction<'f> {
    /// The number type.
    pub(super) number: &'f Number,
    /// The name of the function.
    pub(super) name: &'f Ident,
    /// Whether the function is a method of the model, and not its constructor.
    pub(super) is_method: bool,
    /// Whether the function is `const`.
    pub(super) is_const: bool,
    /// Returns the variable that a load reads, for loads that are variables.
    pub(super) source_name: &'f dyn Fn(Source) -> Option<Ident>,
}

/// Returns the statements of a body, and the functions of its parts if it is long.
pub(super) fn statements(
    scope: &mut Scope<'_>,
    body: &Body<'_>,
    cut: &CutFunction<'_>,
) -> (Vec<Stmt>, Vec<ImplItem>) {
    if !body.is_cut() {
        return (body.statements(), vec![]);
    }
    let ty = cut.number.ty();
    let (generics, clause) = (cut.number.generics(), cut.number.where_clause());
    let constness = cut.is_const.then(|| quote!(const));
    let receiver = cut.is_method.then(|| quote!(&self,));
    let live = scope.variables().name("live");
    let (mut calls, mut items) = (vec![], vec![]);
    for (index, part) in body.parts(cut.source_name).into_iter().enumerate() {
        let name = format_ident!("{}_part{}", cut.name, index + 1);
        let method = scope.methods.name(&name.to_string());
        let callee = if cut.is_method { quote!(self.#method) } else { quote!(Model::#method) };
        let taken = Literal::usize_unsuffixed(part.entering.len());
        let given = Literal::usize_unsuffixed(part.leaving.len());
        let pattern = |names: &[Ident]| syntax::array_pattern(names.iter().map(syntax::binding));
        let values =
            |names: &[Ident]| -> Expr { syntax::array(names.iter().map(syntax::variable)) };
        let arguments = values(&part.entering);
        let value = parse_quote!(#callee(&#arguments));
        calls.push(syntax::binding_statement(pattern(&part.leaving), value));
        let signature = parse_quote! {
            #[inline(never)]
            #constness fn #method #generics (#receiver #live: &[#ty; #taken]) -> [#ty; #given]
            #clause {}
        };
        let take = syntax::binding_statement(pattern(&part.entering), parse_quote!(*#live));
        let mut statements = vec![take];
        statements.extend(part.statements);
        items.push(syntax::with_body(signature, statements, values(&part.leaving)));
    }
    (calls, items)
}
