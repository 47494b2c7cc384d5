//! Methods that set several parameters together.

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::{Item, Stmt, Type, parse_quote};

use super::doc;
use super::namer::Namer;
use super::scope::Scope;
use super::syntax;
use crate::backend::common::{self, Setter, SetterArgument};

/// A setter's argument, with names for its entries.
struct Argument<'a> {
    spec: &'a SetterArgument,
    name: Ident,
    entries: Vec<Ident>,
}

impl Argument<'_> {
    fn parameter(&self) -> TokenStream {
        let name = &self.name;
        let ty: Type = match self.entries.len() {
            1 => parse_quote!(f64),
            length => syntax::array_type(&parse_quote!(f64), length),
        };
        quote!(#name: #ty)
    }

    /// Makes `let [x, y, z] = center_of_mass;` for an array.
    fn take(&self) -> Option<Stmt> {
        let (name, entries) = (&self.name, &self.entries);
        (entries.len() > 1).then(|| parse_quote!(let [#(#entries),*] = #name;))
    }
}

/// Prints the setters of `Parameters`, and functions of `Model` that apply them to the nominal parameters.
pub(super) fn items(scope: &Scope<'_>, is_const: bool) -> Vec<Item> {
    let options = scope.options;
    let constness = is_const.then(|| quote!(const));
    let mut items = vec![];
    for (setter, name) in options.setters.iter().zip(&scope.setters) {
        let arguments = arguments(scope, setter);
        let parameters: Vec<TokenStream> = arguments.iter().map(Argument::parameter).collect();
        items.push(on_parameters(scope, setter, name, &arguments));
        if scope.module.parameters.iter().all(|parameter| parameter.nominal.is_some()) {
            let names = arguments.iter().map(|argument| &argument.name);
            let line = format!("The model at the nominal parameters after [`Parameters::{name}`].");
            items.push(parse_quote! {
                impl Model {
                    #[doc = #line]
                    #[must_use]
                    pub #constness fn #name(#(#parameters),*) -> Model {
                        Model::new(&Parameters::NOMINAL.#name(#(#names),*))
                    }
                }
            });
        }
    }
    items
}

fn arguments<'a>(scope: &Scope<'_>, setter: &'a Setter) -> Vec<Argument<'a>> {
    let mut namer = Namer::with(&["self"]);
    let arguments = setter.arguments.iter();
    let named: Vec<_> = arguments.map(|spec| (spec, namer.name(&spec.name))).collect();
    let argument = |(spec, name): (&'a SetterArgument, Ident)| {
        let known = spec.parameters.iter().filter(|name| field(scope, name).is_some());
        let entries = match spec.parameters.len() {
            1 => vec![name.clone()],
            _ => known.map(|parameter| namer.name(parameter)).collect(),
        };
        Argument { spec, name, entries }
    };
    named.into_iter().map(argument).collect()
}

/// Returns the field of a parameter.
fn field<'s>(scope: &'s Scope<'_>, name: &str) -> Option<&'s Ident> {
    let index = scope.module.parameters.iter().position(|parameter| parameter.name == name)?;
    scope.parameters.get(index)
}

fn on_parameters(
    scope: &Scope<'_>,
    setter: &Setter,
    name: &Ident,
    arguments: &[Argument<'_>],
) -> Item {
    let mut lines = common::paragraphs(&setter.doc, &setter.name);
    lines.push(String::new());
    for argument in arguments {
        let SetterArgument { name, doc, unit, .. } = argument.spec;
        let meaning = common::quantity(doc, name, unit, &[]);
        lines.push(format!("- `{}`: {meaning}", argument.name));
    }
    let docs = doc::attributes(&lines);
    let parameters = arguments.iter().map(Argument::parameter);
    let takes = arguments.iter().filter_map(Argument::take);
    let set: Vec<TokenStream> = arguments
        .iter()
        .flat_map(|argument| argument.spec.parameters.iter().zip(&argument.entries))
        .filter_map(|(parameter, entry)| {
            let field = field(scope, parameter)?;
            Some(quote!(#field: #entry))
        })
        .collect();
    let rest = (set.len() < scope.parameters.len()).then(|| quote!(..*self));
    parse_quote! {
        impl Parameters {
            #(#docs)*
            #[must_use]
            pub const fn #name(&self, #(#parameters),*) -> Parameters {
                #(#takes)*
                Parameters { #(#set,)* #rest }
            }
        }
    }
}
