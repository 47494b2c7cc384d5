//! The number type of generated code, and the runtime's functions for it.

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::{Expr, Type, parse_quote};

use super::syntax;
use crate::backend::common::Scalar;
use crate::trigonometry::Trigonometry;

/// The number type with which a function computes.
#[derive(Clone)]
pub(super) struct Number {
    kind: Kind,
    runtime: syn::Path,
    trigonometry: Trigonometry,
    /// Whether multiply-adds and polynomials are methods of the type parameter `A`.
    arithmetic: bool,
    /// Whether the model's fields have a type of their own, the type parameter `P`.
    own_fields: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Scalar(Scalar),
    /// The type parameter `T`.
    Generic,
}

impl Number {
    pub(super) fn scalar(
        scalar: Scalar,
        runtime: &syn::Path,
        trigonometry: Trigonometry,
    ) -> Number {
        Number {
            kind: Kind::Scalar(scalar),
            runtime: runtime.clone(),
            trigonometry,
            arithmetic: false,
            own_fields: false,
        }
    }

    /// This number with the multiply-adds and polynomials of the type parameter `A`.
    pub(super) fn with_arithmetic(&self) -> Number {
        Number { arithmetic: true, ..self.clone() }
    }

    /// This number with the arithmetic of the compilation target.
    pub(super) fn without_arithmetic(&self) -> Number {
        Number { arithmetic: false, ..self.clone() }
    }

    pub(super) fn has_arithmetic(&self) -> bool {
        self.arithmetic
    }

    /// Any scalar of the runtime in place of this number; `own_fields` must be set if the model has fields.
    pub(super) fn generic(&self, own_fields: bool) -> Number {
        Number { kind: Kind::Generic, own_fields, ..self.clone() }
    }

    pub(super) fn is_generic(&self) -> bool {
        self.kind == Kind::Generic
    }

    pub(super) fn runtime(&self) -> &syn::Path {
        &self.runtime
    }

    /// The Rust type.
    pub(super) fn ty(&self) -> Type {
        match self.kind {
            Kind::Scalar(scalar) => scalar_type(scalar),
            Kind::Generic => parse_quote!(T),
        }
    }

    /// The generic parameters of a function that computes with this number.
    pub(super) fn generics(&self) -> syn::Generics {
        let runtime = &self.runtime;
        match self.kind {
            Kind::Scalar(_) => syn::Generics::default(),
            Kind::Generic => parse_quote!(<T: #runtime::Scalar>),
        }
    }

    /// The bounds on the types, in addition to `T` being a scalar.
    pub(super) fn where_clause(&self) -> Option<syn::WhereClause> {
        let runtime = &self.runtime;
        let fields = self.own_fields.then(|| quote!(P: #runtime::Field<T>));
        let standard = self.is_generic() && self.trigonometry == Trigonometry::Standard;
        let sines = standard.then(|| quote!(#runtime::StdTrig: #runtime::Trig<T>));
        let bounds: Vec<TokenStream> = fields.into_iter().chain(sines).collect();
        (!bounds.is_empty()).then(|| parse_quote!(where #(#bounds),*))
    }

    pub(super) fn constant(&self, value: f64) -> Expr {
        match self.kind {
            Kind::Scalar(scalar) => syntax::constant(scalar, value),
            Kind::Generic => {
                let value = syntax::float(value);
                parse_quote!(T::from_f64(#value))
            }
        }
    }

    /// A field of the model as an operand.
    pub(super) fn field(&self, field: &Ident) -> Expr {
        let runtime = &self.runtime;
        match self.kind {
            Kind::Scalar(_) => parse_quote!(self.#field),
            Kind::Generic => parse_quote!(#runtime::Field::<T>::broadcast(self.#field)),
        }
    }

    /// A method of the runtime's scalars, by its path: method syntax would prefer the methods that
    /// `f64` itself has with the standard library.
    pub(super) fn method(&self, name: &str) -> Expr {
        let runtime = &self.runtime;
        let name = Ident::new(name, proc_macro2::Span::call_site());
        parse_quote!(#runtime::Scalar::#name)
    }

    /// The multiply-add.
    pub(super) fn mul_add(&self) -> Expr {
        if self.arithmetic { parse_quote!(A::mul_add) } else { self.method("mul_add") }
    }

    /// The function for the reciprocal of a positive number. For floats it is a `const` function, so that constructors
    /// can call it.
    pub(super) fn recip_positive(&self) -> Expr {
        let runtime = &self.runtime;
        match self.kind {
            Kind::Scalar(Scalar::F64) => parse_quote!(#runtime::recip_positive_f64),
            Kind::Scalar(Scalar::F32) => parse_quote!(#runtime::recip_positive_f32),
            Kind::Generic => self.method("recip_positive"),
        }
    }

    /// The function for one angle with this name, such as `sin_cos`, of the chosen trigonometry.
    pub(super) fn circular(&self, name: &str) -> Expr {
        let (runtime, ty) = (&self.runtime, self.ty());
        let name = Ident::new(name, proc_macro2::Span::call_site());
        match self.trigonometry {
            Trigonometry::Standard => {
                parse_quote!(<#runtime::StdTrig as #runtime::Trig<#ty>>::#name)
            }
            Trigonometry::Polynomial => {
                parse_quote!(<#runtime::PolyTrig as #runtime::Trig<#ty>>::#name)
            }
        }
    }

    /// The function from an array of angles to the arrays of their sines and cosines.
    pub(super) fn circular_array(&self) -> Expr {
        let runtime = &self.runtime;
        match self.trigonometry {
            Trigonometry::Standard => parse_quote!(#runtime::std_sin_cos_array),
            Trigonometry::Polynomial if self.arithmetic => parse_quote!(A::sin_cos_array),
            Trigonometry::Polynomial => parse_quote!(#runtime::sin_cos_array),
        }
    }

    /// The same function by polynomials, for the body of a loop over states.
    pub(super) fn circular_each(&self) -> Expr {
        let runtime = &self.runtime;
        if self.arithmetic {
            parse_quote!(A::sin_cos_each)
        } else {
            parse_quote!(#runtime::sin_cos_each)
        }
    }
}

/// The Rust type of a scalar.
pub(super) fn scalar_type(scalar: Scalar) -> Type {
    match scalar {
        Scalar::F64 => parse_quote!(f64),
        Scalar::F32 => parse_quote!(f32),
    }
}

#[cfg(test)]
mod tests {
    use quote::ToTokens;

    use super::*;

    fn literal(scalar: Scalar, value: f64) -> String {
        let runtime: syn::Path = parse_quote!(::robot_runtime);
        let number = Number::scalar(scalar, &runtime, Trigonometry::Standard);
        number.constant(value).to_token_stream().to_string().replace(' ', "")
    }

    /// Checks to the last bit, because other tests of generated code have tolerances for rounding.
    #[test]
    fn constants_are_the_nearest_numbers_of_the_type() {
        let values = [0.1, 1.0 / 3.0, 9.81, 16_777_217.0, 1e-30, 3.0e38, 2.5e-7];
        for value in values.into_iter().flat_map(|value| [value, -value]) {
            let (double, single) = (literal(Scalar::F64, value), literal(Scalar::F32, value));
            assert_eq!(double.parse::<f64>().unwrap(), value, "{double}");
            assert_eq!(single.parse::<f32>().unwrap(), value as f32, "{single}");
            assert!(single.len() <= double.len(), "{single} {double}");
        }
    }
}
