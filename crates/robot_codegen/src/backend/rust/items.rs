//! The types of a module: constants, `Parameters`, `Model` and its constructor.

use proc_macro2::{Ident, Literal};
use quote::{format_ident, quote};
use robot_symbolic::Function;
use syn::{Expr, ImplItem, Item, Stmt, parse_quote};

use super::body::Body;
use super::doc;
use super::number::scalar_type;
use super::parts::{self, CutFunction};
use super::scope::Scope;
use super::syntax;
use crate::backend::common::{self, ConstantValue, Scalar};
use crate::counts::Counts;
use crate::program::{Operation, Program, Source};

/// Makes the caller's constants.
pub(super) fn constants(scope: &mut Scope<'_>) -> Vec<Item> {
    let items = scope.options.constants.iter().zip(&scope.constants);
    let items = items.map(|(item, name)| {
        let docs =
            doc::attributes(&common::paragraphs(std::slice::from_ref(&item.doc), &item.name));
        match &item.value {
            ConstantValue::Size(size) => {
                let size = Literal::usize_unsuffixed(*size);
                parse_quote!(#(#docs)* pub const #name: usize = #size;)
            }
            ConstantValue::Text(text) => parse_quote!(#(#docs)* pub const #name: &str = #text;),
            ConstantValue::Number(number) => {
                let number = syntax::float(*number);
                parse_quote!(#(#docs)* pub const #name: f64 = #number;)
            }
            ConstantValue::Texts(texts) => {
                let length = Literal::usize_unsuffixed(texts.len());
                parse_quote!(#(#docs)* pub const #name: [&str; #length] = [#(#texts),*];)
            }
            ConstantValue::Places(places) => {
                let length = Literal::usize_unsuffixed(places.len());
                let places = places.iter().map(|[row, column]| {
                    let [row, column] =
                        [row, column].map(|index| Literal::usize_unsuffixed(*index));
                    quote!((#row, #column))
                });
                parse_quote!(#(#docs)* pub const #name: [(usize, usize); #length] = [#(#places),*];)
            }
            ConstantValue::Numbers(numbers) => {
                let length = Literal::usize_unsuffixed(numbers.len());
                let numbers = numbers.iter().map(|number| syntax::float(*number));
                parse_quote!(#(#docs)* pub const #name: [f64; #length] = [#(#numbers),*];)
            }
        }
    });
    items.collect()
}

/// Makes `pub struct Parameters`, if the module has parameters.
pub(super) fn parameters(scope: &Scope<'_>) -> Vec<Item> {
    if !scope.has_parameters() {
        return vec![];
    }
    let specs = &scope.module.parameters;
    let fields = specs.iter().zip(&scope.parameters).map(|(spec, name)| {
        let docs = doc::attributes(&[common::parameter(spec)]);
        quote!(#(#docs)* pub #name: f64)
    });
    let title = common::markdown_line(&scope.module.name);
    let docs = doc::attributes(&[format!("The parameters of {title}.")]);
    let mut items = vec![parse_quote! {
        #(#docs)*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Parameters { #(#fields),* }
    }];
    let nominal: Option<Vec<f64>> = specs.iter().map(|spec| spec.nominal).collect();
    if let Some(values) = nominal {
        let names = &scope.parameters;
        let values = values.into_iter().map(syntax::float);
        items.push(parse_quote! {
            impl Parameters {
                /// The nominal values.
                pub const NOMINAL: Parameters = Parameters { #(#names: #values),* };
            }
        });
        items.push(parse_quote! {
            impl ::core::default::Default for Parameters {
                fn default() -> Self { Self::NOMINAL }
            }
        });
    }
    items
}

/// Makes `pub struct Model` and its constructor.
pub(super) fn model(scope: &mut Scope<'_>) -> Vec<Item> {
    let title = common::markdown_line(&scope.module.name);
    if !scope.has_parameters() {
        let docs = doc::attributes(&[format!(
            "The model {title}: its parameters are constants in \
            the code."
        )]);
        return vec![
            parse_quote!(#(#docs)* #[derive(Clone, Copy, Debug, Default, PartialEq)] pub struct Model;),
            parse_quote!(impl Model {
                /// The only model.
                pub const NOMINAL: Model = Model;
            }),
        ];
    }
    let docs = doc::attributes(&[format!(
        "The model {title}: everything that depends only on its parameters, computed once."
    )]);
    let (fields, ty) = (&scope.fields, scalar_type(scope.options.scalar));
    let (parameter, field) = match scope.has_own_fields() {
        true => (Some(quote!(<P = #ty>)), parse_quote!(P)),
        false => (None, ty),
    };
    let model = parse_quote! {
        #(#docs)*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Model #parameter { #(#fields: #field),* }
    };
    let mut items = vec![model, constructor(scope)];
    items.extend(scope.has_own_fields().then(|| over_lanes(scope)));
    items
}

/// Makes the constructor of a model whose parameters differ between lanes: each field has a value for each lane.
fn over_lanes(scope: &Scope<'_>) -> Item {
    let (fields, ty) = (&scope.fields, scalar_type(scope.options.scalar));
    let runtime = scope.number.runtime();
    let docs = doc::attributes(&[
        "The model whose lane i has `parameters[i]`, for the forms `…_generic` over as many lanes: each field is \
            that of [`Model::new`], lane by lane."
            .to_owned(),
    ]);
    parse_quote! {
        impl Model {
            #(#docs)*
            #[must_use]
            pub fn new_lanes<const N: usize>(
                parameters: &[Parameters; N],
            ) -> Model<#runtime::Lanes<#ty, N>> {
                let models = parameters.each_ref().map(Model::new);
                let lanes = |field: fn(&Model) -> #ty| {
                    #runtime::Lanes::from_array(models.each_ref().map(field))
                };
                Model { #(#fields: lanes(|model| model.#fields),)* }
            }
        }
    }
}

fn constructor(scope: &mut Scope<'_>) -> Item {
    let program = &scope.module.constructor;
    let mut namer = scope.variables();
    let parameters = namer.name("parameters");
    let specs = scope.module.parameters.iter();
    let locals = namer.names(specs.map(|spec| spec.name.as_str()));
    let source_name = |source: Source| match source {
        Source::Parameter(index) => locals.get(index as usize).cloned(),
        _ => None,
    };
    let load = |source: Source| {
        let name = source_name(source);
        name.as_ref().map_or_else(syntax::nothing, syntax::variable)
    };
    let number = scope.constructor_number.clone();
    let body = Body::new(program, &scope.options.limits, &number, &load, &mut namer);
    let (is_const, name) = (is_const(program), format_ident!("new"));
    let cut = CutFunction {
        number: &number,
        name: &name,
        is_method: false,
        is_const,
        source_name: &source_name,
    };
    let mut statements = vec![take_parameters(scope, program, &parameters, &locals)];
    let (calls, part_items) = parts::statements(scope, &body, &cut);
    statements.extend(calls);
    let values = body.results().into_iter().map(|value| stored(scope, value));
    let fields = scope.fields.iter().zip(values);
    let fields = fields.map(|(name, value)| syntax::field_value(name, &value));
    let value = parse_quote!(Model { #(#fields),* });
    let docs = doc::attributes(&constructor_doc(scope));
    let constness = is_const.then(|| quote!(const));
    let signature = parse_quote! {
        #(#docs)*
        #[must_use]
        pub #constness fn new(#parameters: &Parameters) -> Model {}
    };
    let mut items: Vec<ImplItem> = nominal_model(scope, is_const).into_iter().collect();
    items.push(syntax::with_body(signature, statements, value));
    items.extend(part_items);
    syntax::impl_model(items)
}

/// Converts the value of a field to the type in which it is stored. The node of the cast gets parentheses where its
/// operand needs them, because `as` has a high precedence.
fn stored(scope: &Scope<'_>, value: Expr) -> Expr {
    match scope.options.scalar {
        Scalar::F64 => value,
        Scalar::F32 => Expr::Cast(syn::ExprCast {
            attrs: vec![],
            expr: Box::new(value),
            as_token: syn::token::As::default(),
            ty: Box::new(scalar_type(scope.options.scalar)),
        }),
    }
}

/// Makes `let Parameters { g, l1, .. } = *parameters;` with the parameters that the program loads.
fn take_parameters(scope: &Scope<'_>, program: &Program, from: &Ident, locals: &[Ident]) -> Stmt {
    let loaded: Vec<usize> = program
        .sources()
        .into_iter()
        .filter_map(|source| match source {
            Source::Parameter(index) => Some(index as usize),
            _ => None,
        })
        .collect();
    let rest = (loaded.len() < locals.len()).then(|| quote!(..));
    let fields = loaded.iter().map(|index| {
        let (field, local) = (&scope.parameters[*index], &locals[*index]);
        if field == local { quote!(#field) } else { quote!(#field: #local) }
    });
    parse_quote!(let Parameters { #(#fields,)* #rest } = *#from;)
}

/// Whether a program can be a `const` function: arithmetic and reciprocals are `const`, the other functions of the
/// runtime are not.
pub(super) fn is_const(program: &Program) -> bool {
    let called = |operation: &Operation| match operation {
        Operation::Call(function, _) => *function != Function::RecipPositive,
        other => matches!(other, Operation::MulAdd(..)),
    };
    !program.operations().iter().any(called)
}

fn constructor_doc(scope: &Scope<'_>) -> Vec<String> {
    let counts = Counts::of(&scope.module.constructor);
    vec![
        "Computes everything that depends only on the parameters.".to_owned(),
        String::new(),
        format!("{}.", common::operations(&counts)),
    ]
}

/// Makes `Model::NOMINAL`, if the constructor is `const` and all nominal values are known.
fn nominal_model(scope: &Scope<'_>, is_const: bool) -> Option<ImplItem> {
    let mut specs = scope.module.parameters.iter();
    let known = specs.all(|spec| spec.nominal.is_some());
    (is_const && known).then(|| {
        parse_quote! {
            /// The model with the nominal parameters.
            pub const NOMINAL: Model = Model::new(&Parameters::NOMINAL);
        }
    })
}
