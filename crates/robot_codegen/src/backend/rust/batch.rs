//! Functions over slices of states, computed in lanes.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use syn::{Expr, ImplItem, Pat, Stmt, parse_quote};

use super::doc;
use super::items::derived;
use super::outputs;
use super::scope::Scope;
use super::syntax;
use super::variables::Variables;
use crate::module::{Function, Output};

/// The method over slices, `lanes` states at a time; `None` for a function without inputs.
///
/// It has the only loop of generated code. The last states fill up a block with zeros, so that all
/// go one way; nothing is indexed, so that nothing can panic.
pub(super) fn method(
    scope: &mut Scope<'_>,
    function: &Function,
    plain: &Ident,
    generic: &Ident,
    lanes: usize,
) -> Option<ImplItem> {
    let mut variables = Variables::new(scope, function);
    let slices = Slices::new(&mut variables, function);
    let all = slices.inputs.iter().chain(&slices.outputs);
    let lengths: Vec<Expr> = all.map(|slice| parse_quote!(#slice.len())).collect();
    let shortest = lengths.into_iter().reduce(|a, b| parse_quote!(#a.min(#b)))?;
    let name = derived(&mut scope.methods, plain, "batch");
    let (runtime, scalar) = (scope.number.runtime(), scope.number.ty());
    let lanes = Literal::usize_unsuffixed(lanes.max(1));
    let (pattern, blocks) = slices.blocks(&lanes)?;
    let [count, result] = ["count", "result"].map(|text| variables.namer.name(text));
    let inputs = &slices.inputs;
    let stores = slices.stores(scope, function, runtime, &result, &count);
    let parameters = slices.parameters(function, &scalar);
    let docs = doc::attributes(&[
        format!(
            "`{plain}` of many states, {lanes} at a time: entry i of each slice belongs to state i."
        ),
        String::new(),
        "Computes, and returns, as many states as the shortest slice has.".to_owned(),
    ]);
    Some(parse_quote! {
        #(#docs)*
        pub fn #name(&self, #(#parameters),*) -> usize {
            for #pattern in #blocks {
                let #count = #shortest;
                let #result = self.#generic::<#runtime::Lanes<#scalar, #lanes>>(
                    #(&#runtime::lanes_from_states(&#runtime::padded_states(#inputs))),*
                );
                #(#stores)*
            }
            #shortest
        }
    })
}

/// The slices that the method takes.
struct Slices {
    inputs: Vec<Ident>,
    outputs: Vec<Ident>,
}

impl Slices {
    fn new(variables: &mut Variables, function: &Function) -> Slices {
        // The variables of the loops that store.
        for word in ["row", "to", "from"] {
            variables.namer.name(word);
        }
        let outputs = function.outputs.iter();
        Slices {
            outputs: outputs.map(|output| variables.namer.name(&output.name)).collect(),
            inputs: variables.inputs.clone(),
        }
    }

    fn parameters(&self, function: &Function, scalar: &syn::Type) -> Vec<TokenStream> {
        let inputs = self.inputs.iter().zip(&function.inputs).map(|(name, input)| {
            let state = syntax::array_type(scalar, input.symbols.len());
            quote!(#name: &[#state])
        });
        let outputs = self.outputs.iter().zip(&function.outputs).map(|(name, output)| {
            let state = syntax::shaped_type(scalar, &output.shape);
            quote!(#name: &mut [#state])
        });
        inputs.chain(outputs).collect()
    }

    /// `((q, qd), tau)` and `q.chunks(8).zip(qd.chunks(8)).zip(tau.chunks_mut(8))`
    fn blocks(&self, lanes: &Literal) -> Option<(Pat, Expr)> {
        let inputs = self.inputs.iter().map(|name| -> (Pat, Expr) {
            (parse_quote!(#name), parse_quote!(#name.chunks(#lanes)))
        });
        let outputs = self.outputs.iter().map(|name| -> (Pat, Expr) {
            (parse_quote!(#name), parse_quote!(#name.chunks_mut(#lanes)))
        });
        let zip = |(a, b): (Pat, Expr), (c, d): (Pat, Expr)| -> (Pat, Expr) {
            (parse_quote!((#a, #c)), parse_quote!(#b.zip(#d)))
        };
        if self.inputs.is_empty() {
            return None;
        }
        inputs.chain(outputs).reduce(zip)
    }

    /// From lanes to the states of the outputs.
    fn stores(
        &self,
        scope: &Scope<'_>,
        function: &Function,
        runtime: &syn::Path,
        result: &Ident,
        count: &Ident,
    ) -> Vec<Stmt> {
        let is_struct = scope.output_type(function).is_some();
        let fields = outputs::fields(function);
        let outputs = function.outputs.iter().zip(fields).zip(&self.outputs);
        let stores = outputs.flat_map(|((output, field), slice)| {
            let value =
                if is_struct { parse_quote!(#result.#field) } else { parse_quote!(#result) };
            store(output, slice, &value, runtime, count)
        });
        stores.collect()
    }
}

/// From the lanes of one output to its states; row by row for a matrix.
fn store(
    output: &Output,
    slice: &Ident,
    value: &Expr,
    runtime: &syn::Path,
    count: &Ident,
) -> Vec<Stmt> {
    match output.shape.as_slice() {
        [] => vec![parse_quote! {
            for (to, from) in #slice.iter_mut().zip(#value.to_array()).take(#count) {
                *to = from;
            }
        }],
        [rows, _] => {
            let rows = 0..*rows;
            let row = |row: usize| -> Stmt {
                let only = |name: TokenStream| {
                    let names = rows
                        .clone()
                        .map(|other| if other == row { name.clone() } else { quote!(_) });
                    quote!([#(#names),*])
                };
                let (from_row, to_row) = (only(quote!(row)), only(quote!(to)));
                parse_quote! {
                    {
                        let #from_row = &#value;
                        for (#to_row, from) in
                            #slice.iter_mut().zip(#runtime::states_from_lanes(row)).take(#count)
                        {
                            *to = from;
                        }
                    }
                }
            };
            rows.clone().map(row).collect()
        }
        _ => vec![parse_quote! {
            for (to, from) in #slice.iter_mut().zip(#runtime::states_from_lanes(&#value)).take(#count) {
                *to = from;
            }
        }],
    }
}
