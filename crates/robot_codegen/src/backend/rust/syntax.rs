//! Nodes of Rust's syntax tree.
//!
//! Expressions are built as nodes, never as tokens: parentheses are printed around nodes where
//! precedence requires them, but would be lost if tokens were pasted.

use proc_macro2::{Ident, Literal, Span};
use syn::punctuated::Punctuated;
use syn::{Expr, ImplItem, ImplItemFn, Item, Pat, Stmt, Type, parse_quote, token};

use crate::backend::common::Scalar;

pub(super) fn binary(left: Expr, op: syn::BinOp, right: Expr) -> Expr {
    Expr::Binary(syn::ExprBinary {
        attrs: vec![],
        left: Box::new(left),
        op,
        right: Box::new(right),
    })
}

pub(super) fn negative(operand: Expr) -> Expr {
    Expr::Unary(syn::ExprUnary {
        attrs: vec![],
        op: syn::UnOp::Neg(token::Minus::default()),
        expr: Box::new(operand),
    })
}

/// `name: value` in a struct expression; `name` if the value is the variable of that name.
pub(super) fn field_value(name: &Ident, value: &Expr) -> syn::FieldValue {
    match value {
        Expr::Path(path) if path.path.is_ident(name) => parse_quote!(#name),
        _ => parse_quote!(#name: #value),
    }
}

pub(super) fn variable(name: &Ident) -> Expr {
    Expr::Path(syn::ExprPath { attrs: vec![], qself: None, path: name.clone().into() })
}

pub(super) fn call(function: Expr, arguments: impl IntoIterator<Item = Expr>) -> Expr {
    Expr::Call(syn::ExprCall {
        attrs: vec![],
        func: Box::new(function),
        paren_token: token::Paren::default(),
        args: arguments.into_iter().collect(),
    })
}

pub(super) fn array(elements: impl IntoIterator<Item = Expr>) -> Expr {
    Expr::Array(syn::ExprArray {
        attrs: vec![],
        bracket_token: token::Bracket::default(),
        elems: elements.into_iter().collect(),
    })
}

/// A tuple, or the element itself if there is only one.
pub(super) fn tuple(elements: Vec<Expr>) -> Expr {
    match <[Expr; 1]>::try_from(elements) {
        Ok([element]) => element,
        Err(elements) => Expr::Tuple(syn::ExprTuple {
            attrs: vec![],
            paren_token: token::Paren::default(),
            elems: elements.into_iter().collect(),
        }),
    }
}

/// `{ statements value }`
pub(super) fn block(statements: Vec<Stmt>, value: Expr) -> Expr {
    let mut stmts = statements;
    stmts.push(Stmt::Expr(value, None));
    Expr::Block(syn::ExprBlock {
        attrs: vec![],
        label: None,
        block: syn::Block { brace_token: token::Brace::default(), stmts },
    })
}

pub(super) fn binding(name: &Ident) -> Pat {
    Pat::Ident(syn::PatIdent {
        attrs: vec![],
        by_ref: None,
        mutability: None,
        ident: name.clone(),
        subpat: None,
    })
}

/// A name, or `_` if there is none.
pub(super) fn optional_binding(name: Option<&Ident>) -> Pat {
    name.map_or_else(
        || {
            Pat::Wild(syn::PatWild {
                attrs: vec![],
                underscore_token: token::Underscore::default(),
            })
        },
        binding,
    )
}

pub(super) fn array_pattern(elements: impl IntoIterator<Item = Pat>) -> Pat {
    Pat::Slice(syn::PatSlice {
        attrs: vec![],
        bracket_token: token::Bracket::default(),
        elems: elements.into_iter().collect(),
    })
}

/// A tuple of names, or the name itself if there is only one.
pub(super) fn tuple_pattern(names: &[Ident]) -> Pat {
    match names {
        [name] => binding(name),
        _ => Pat::Tuple(syn::PatTuple {
            attrs: vec![],
            paren_token: token::Paren::default(),
            elems: names.iter().map(binding).collect::<Punctuated<_, _>>(),
        }),
    }
}

/// `let pattern = value;`
pub(super) fn binding_statement(pat: Pat, value: Expr) -> Stmt {
    Stmt::Local(syn::Local {
        attrs: vec![],
        let_token: token::Let::default(),
        modifiers: syn::LocalModifiers::default(),
        pat,
        init: Some(syn::LocalInit {
            eq_token: token::Eq::default(),
            expr: Box::new(value),
            diverge: None,
        }),
        semi_token: token::Semi::default(),
    })
}

/// `[ty; length]`
pub(super) fn array_type(ty: &Type, length: usize) -> Type {
    let length = Literal::usize_unsuffixed(length);
    parse_quote!([#ty; #length])
}

/// `f64`, `[f64; n]` or `[[f64; columns]; rows]`
pub(super) fn shaped_type(ty: &Type, shape: &[usize]) -> Type {
    let lengths = shape.iter().rev();
    lengths.fold(ty.clone(), |ty, length| array_type(&ty, *length))
}

/// `impl Model { items }`
pub(super) fn impl_model(items: Vec<ImplItem>) -> Item {
    let mut block: syn::ItemImpl = parse_quote!(impl Model {});
    block.items = items;
    Item::Impl(block)
}

/// Methods of a model with fields of any type `P`.
pub(super) fn impl_model_of_any_fields(items: Vec<ImplItem>) -> Item {
    let mut block: syn::ItemImpl = parse_quote!(
        impl<P: ::core::marker::Copy> Model<P> {}
    );
    block.items = items;
    Item::Impl(block)
}

/// A function whose body has these statements, followed by the value. `signature` has an empty body, so that the
/// nodes of a long body are not converted to tokens and parsed again.
pub(super) fn with_body(mut signature: ImplItemFn, statements: Vec<Stmt>, value: Expr) -> ImplItem {
    signature.block.stmts = statements;
    signature.block.stmts.push(Stmt::Expr(value, None));
    ImplItem::Fn(signature)
}

/// A literal that reads back as the same `f64`, in the fewest digits.
pub(super) fn float(value: f64) -> Expr {
    constant(Scalar::F64, value)
}

/// A placeholder for a load without a variable, which does not occur in programs of checked modules.
pub(super) fn nothing() -> Expr {
    parse_quote!(f64::NAN)
}

/// A literal that reads back as the same number of the type, in the fewest digits.
pub(super) fn constant(scalar: Scalar, value: f64) -> Expr {
    let digits = scalar.digits(value);
    let literal = Expr::Lit(syn::ExprLit {
        attrs: vec![],
        lit: syn::Lit::Float(syn::LitFloat::new(&digits, Span::call_site())),
    });
    if value < 0.0 { negative(literal) } else { literal }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quote::ToTokens;

    #[test]
    fn literals_read_back_as_the_same_number() {
        let values =
            [0.0, 1.0, 0.1, 1e300, 5e-324, f64::MAX, 1e15, 1e16, 1e-5, 123_456_789.125, 2.5e-7];
        for value in values.into_iter().flat_map(|value| [value, -value]) {
            let text = float(value).to_token_stream().to_string().replace(' ', "");
            assert_eq!(text.parse::<f64>().unwrap(), value, "{text}");
            assert!(text.len() < 26, "{text}");
        }
    }
}
