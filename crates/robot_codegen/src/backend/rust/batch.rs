//! Functions over many states: over slices of states, over columns, and over blocks of a few states.
//!
//! All of them compute block by block ([`lanes`](super::lanes)); the loops over blocks and over the states of a block
//! are the only loops of generated code. The last block is filled up with zeros, so that all states take the
//! same path; nothing is indexed, so that nothing can panic.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use syn::{Expr, ImplItem, Type, parse_quote};

use super::doc;
use super::function::Methods;
use super::namer::derived;
use super::options::Parallel;
use super::syntax;
use super::variables::Variables;
use crate::backend::common::used_inputs;

/// The fewest blocks that one thread computes: a few microseconds of work.
const GRAIN: usize = 32;

/// The arguments and results of the methods over many states.
pub(super) struct Slices {
    pub(super) variables: Variables,
    /// For each input, its name, the number of its entries, and whether the function needs it.
    pub(super) inputs: Vec<(Ident, usize, bool)>,
    /// For each output, its name and its shape for one state.
    pub(super) outputs: Vec<(Ident, Vec<usize>)>,
    /// The number of states in a block.
    pub(super) count: usize,
    /// The number of states in a block, as a literal.
    pub(super) lanes: Literal,
}

impl Slices {
    pub(super) fn used(&self) -> impl Iterator<Item = &Ident> {
        self.inputs.iter().filter(|(_, _, used)| *used).map(|(name, ..)| name)
    }

    pub(super) fn output_names(&self) -> Vec<&Ident> {
        self.outputs.iter().map(|(name, _)| name).collect()
    }

    /// The names of inputs and outputs.
    fn names(&self) -> impl Iterator<Item = &Ident> {
        self.inputs.iter().map(|(name, ..)| name).chain(self.outputs.iter().map(|(name, _)| name))
    }

    /// Makes parameters such as `q: &[[f64; 6]]` and `tau: &mut [[f64; 6]]`.
    fn slices(&self, scalar: &Type) -> Vec<TokenStream> {
        let inputs = self.inputs.iter().map(|(name, length, _)| {
            let state = syntax::array_type(scalar, *length);
            quote!(#name: &[#state])
        });
        let outputs = self.outputs.iter().map(|(name, shape)| {
            let state = syntax::shaped_type(scalar, shape);
            quote!(#name: &mut [#state])
        });
        inputs.chain(outputs).collect()
    }

    /// Makes parameters such as `q: [&[f64]; 6]` and `mut tau: [&mut [f64]; 6]`.
    fn columns(&self, scalar: &Type) -> Vec<TokenStream> {
        let (read, written): (Type, Type) =
            (parse_quote!(&[#scalar]), parse_quote!(&mut [#scalar]));
        let inputs = self.inputs.iter().map(|(name, length, _)| {
            let columns = syntax::array_type(&read, *length);
            quote!(#name: #columns)
        });
        let outputs = self.outputs.iter().map(|(name, shape)| {
            let columns = syntax::shaped_type(&written, shape);
            quote!(mut #name: #columns)
        });
        inputs.chain(outputs).collect()
    }
}

/// The layout of the states of a block in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// State by state: `[[f64; 6]; 8]`.
    States,
    /// Coordinate by coordinate: `[[f64; 8]; 6]`; the lanes of each coordinate can be anywhere.
    Lanes,
}

/// The names of the methods over many states.
pub(super) struct BatchNames {
    batch: Ident,
    /// The method for a block of states in memory; the next one computes it in a kernel.
    states: Ident,
    states_with: Ident,
    columns: Ident,
    /// The method for a block in lanes in memory; the next two are for lanes in any place, and in a kernel.
    pub(super) block: Ident,
    lanes: Ident,
    lanes_with: Ident,
}

impl BatchNames {
    /// The methods of a block in this layout: the method that is called, and the method that the kernel calls.
    pub(super) fn of(&self, layout: Layout) -> (&Ident, &Ident) {
        match layout {
            Layout::States => (&self.states, &self.states_with),
            Layout::Lanes => (&self.lanes, &self.lanes_with),
        }
    }
}

impl Methods<'_, '_> {
    /// Prints the methods over slices, columns and blocks of `lanes` states; there are none for a function that needs
    /// no inputs.
    pub(super) fn batch(&mut self, lanes: usize) -> Vec<ImplItem> {
        let mut slices = self.slices(lanes);
        if slices.used().next().is_none() {
            return vec![];
        }
        let plain = self.names.plain.clone();
        let mut name = |suffix: &str| derived(&mut self.scope.methods, &plain, suffix);
        let names = BatchNames {
            batch: name("batch"),
            states: name("states"),
            states_with: name("states_with"),
            columns: name("columns"),
            block: name("block"),
            lanes: name("lanes"),
            lanes_with: name("lanes_with"),
        };
        let mut methods = vec![self.over_slices(&slices, &names)];
        if self.scope.options.parallel != Parallel::No {
            methods.push(self.over_threads(&slices, lanes, &names.batch));
        }
        methods.extend(self.of_block(&mut slices, &names, Layout::States));
        methods.push(self.over_columns(&slices, &names));
        methods.push(self.block(&slices, &names));
        methods.extend(self.of_block(&mut slices, &names, Layout::Lanes));
        methods
    }

    fn slices(&self, lanes: usize) -> Slices {
        let function = self.function;
        let mut variables = Variables::new(self.scope, function);
        // Reserve the names of the methods' own variables.
        for word in ["count", "whole", "start", "half", "lane", "lanes", "result", "circular"] {
            variables.namer.name(word);
        }
        let used = used_inputs(function, &function.core).into_iter();
        let used = used.zip(used_inputs(function, &function.angles)).map(|(a, b)| a || b);
        let names = variables.inputs.iter().cloned().zip(&function.inputs).zip(used);
        let inputs = names.map(|((name, input), used)| (name, input.symbols.len(), used)).collect();
        let outputs = function.outputs.iter();
        let outputs =
            outputs.map(|output| (variables.namer.name(&output.name), output.shape.clone()));
        let outputs = outputs.collect();
        let count = lanes.max(1);
        Slices { variables, inputs, outputs, count, lanes: Literal::usize_unsuffixed(count) }
    }

    /// Prints the method that cuts slices of states into blocks.
    fn over_slices(&self, slices: &Slices, names: &BatchNames) -> ImplItem {
        let (runtime, lanes) = (self.number.runtime(), &slices.lanes);
        let BatchNames { batch, states: method, .. } = names;
        let parameters = slices.slices(&self.number.ty());
        let lengths = slices.names().map(|name| parse_quote!(#name.len()));
        let count = least(lengths);
        let (used, outputs): (Vec<&Ident>, _) = (slices.used().collect(), slices.output_names());
        let used_rests = suffixed(&used, "rest", slices);
        let output_rests = suffixed(&outputs, "rest", slices);
        let results = suffixed(&outputs, "states", slices);
        let (pattern, result) = (zip_pattern(&used, &outputs), syntax::tuple_pattern(&results));
        let (first, others) = used.split_first().map_or((None, &[][..]), |(a, b)| (Some(a), b));
        let docs = doc::attributes(&[
            format!(
                "`{}` for many states, {lanes} at a time: entry i of each slice belongs to state i.",
                self.names.plain
            ),
            String::new(),
            "Computes as many states as the shortest slice has, and returns their number."
                .to_owned(),
        ]);
        parse_quote! {
            #(#docs)*
            pub fn #batch(&self, #(#parameters),*) -> usize {
                let count = #count;
                #(let #used = #used.get(..count).unwrap_or_default();)*
                #(let #outputs = #outputs.get_mut(..count).unwrap_or_default();)*
                #(let (#used, #used_rests) = #used.as_chunks::<#lanes>();)*
                #(let (#outputs, #output_rests) = #outputs.as_chunks_mut::<#lanes>();)*
                for #pattern in #first.iter() #(.zip(#others))* #(.zip(#outputs))* {
                    let #result = self.#method(#(#used),*);
                    #(*#outputs = #results;)*
                }
                if !count.is_multiple_of(#lanes) {
                    let #result = self.#method(#(&#runtime::padded_states(#used_rests)),*);
                    #(for (to, from) in #output_rests.iter_mut().zip(#results) {
                        *to = from;
                    })*
                }
                count
            }
        }
    }

    /// Prints the method that cuts columns into blocks, without copying them.
    fn over_columns(&self, slices: &Slices, names: &BatchNames) -> ImplItem {
        let (runtime, lanes) = (self.number.runtime(), &slices.lanes);
        let BatchNames { columns, lanes: method, .. } = names;
        let scalar = self.number.ty();
        let parameters = slices.columns(&scalar);
        let states = slices.outputs.iter().map(|(name, shape)| -> Expr {
            let state = syntax::shaped_type(&scalar, shape);
            parse_quote!(<#state as #runtime::State>::column_length(&#name))
        });
        let lengths = slices
            .inputs
            .iter()
            .map(|(name, ..)| -> Expr { parse_quote!(#runtime::column_length(&#name)) });
        let count = least(lengths.chain(states));
        let used: Vec<&Ident> = slices.used().collect();
        let outputs = slices.output_names();
        let pattern = suffixed(&outputs, "lanes", slices);
        let stores = |count: Expr| {
            let stores = slices.outputs.iter().zip(&pattern).map(|((name, shape), result)| {
                let state = syntax::shaped_type(&scalar, shape);
                quote!(<#state as #runtime::State>::to_columns(&#result, &mut #name, start, #count);)
            });
            stores.collect::<Vec<_>>()
        };
        let (block, rest) = (stores(parse_quote!(#lanes)), stores(parse_quote!(count - start)));
        let taken = syntax::tuple_pattern(&pattern);
        let docs = doc::attributes(&[
            format!(
                "`{}` for many states in columns, {lanes} at a time: entry i of each column belongs to state i.",
                self.names.plain
            ),
            String::new(),
            "Computes as many states as the shortest column has, and returns their number."
                .to_owned(),
        ]);
        parse_quote! {
            #(#docs)*
            #[inline]
            pub fn #columns(&self, #(#parameters),*) -> usize {
                let count = #count;
                let whole = count - count % #lanes;
                for start in (0..whole).step_by(#lanes) {
                    let #taken = self.#method(#(#runtime::chunks(&#used, start)),*);
                    #(#block)*
                }
                for start in (whole..count).step_by(#lanes) {
                    let #taken = self.#method(
                        #(#runtime::padded_chunks::<_, #lanes, _>(&#used, start).each_ref()),*
                    );
                    #(#rest)*
                }
                count
            }
        }
    }

    /// Prints the method that halves the slices, down to short ones, and computes the halves on several threads. Halves
    /// start at the starts of blocks, so that each state has the same result as on one thread.
    fn over_threads(&mut self, slices: &Slices, lanes: usize, batch: &Ident) -> ImplItem {
        let parallel = derived(&mut self.scope.methods, batch, "parallel");
        let parameters = slices.slices(&self.number.ty());
        let inputs: Vec<&Ident> = slices.inputs.iter().map(|(name, ..)| name).collect();
        let outputs = slices.output_names();
        let mut namer = slices.variables.namer.clone();
        let mut rests = |names: &[&Ident]| -> Vec<Ident> {
            names.iter().map(|name| derived(&mut namer, name, "rest")).collect()
        };
        let (input_rests, output_rests) = (rests(&inputs), rests(&outputs));
        let lengths = slices.names().map(|name| parse_quote!(#name.len()));
        let (count, block) = (least(lengths), &slices.lanes);
        let grain = Literal::usize_unsuffixed(GRAIN.saturating_mul(lanes.max(1)));
        let feature = self.scope.options.parallel == Parallel::WithFeature;
        let condition = feature.then(|| quote!(#[cfg(feature = "rayon")]));
        let docs = doc::attributes(&[
            format!(
                "[`Model::{batch}`] on the threads of rayon's pool, with the same results \
                bit for bit."
            ),
            String::new(),
            format!("Short slices, of up to {grain} states, are computed on the caller's thread."),
        ]);
        parse_quote! {
            #(#docs)*
            #condition
            pub fn #parallel(&self, #(#parameters),*) -> usize {
                let count = #count;
                if count <= #grain {
                    return self.#batch(#(#inputs,)* #(#outputs),*);
                }
                let half = (count / 2).next_multiple_of(#block);
                #(let #inputs = #inputs.get(..count).unwrap_or_default();)*
                #(let #outputs = #outputs.get_mut(..count).unwrap_or_default();)*
                #(let (#inputs, #input_rests) = #inputs.split_at_checked(half).unwrap_or_default();)*
                #(let (#outputs, #output_rests) =
                    #outputs.split_at_mut_checked(half).unwrap_or_default();)*
                ::rayon::join(
                    || self.#parallel(#(#inputs,)* #(#outputs),*),
                    || self.#parallel(#(#input_rests,)* #(#output_rests),*),
                );
                count
            }
        }
    }
}

/// Makes the smallest of several lengths: `q.len().min(tau.len())`.
fn least(lengths: impl Iterator<Item = Expr>) -> Option<Expr> {
    lengths.reduce(|a, b| parse_quote!(#a.min(#b)))
}

/// Makes a variable for each name, with a suffix.
fn suffixed(names: &[&Ident], suffix: &str, slices: &Slices) -> Vec<Ident> {
    let mut namer = slices.variables.namer.clone();
    names.iter().map(|name| derived(&mut namer, name, suffix)).collect()
}

/// Makes the pattern `((q, qd), tau)` for `q.iter().zip(qd).zip(tau)`.
fn zip_pattern(used: &[&Ident], outputs: &[&Ident]) -> syn::Pat {
    let names = used.iter().chain(outputs).map(|name| syntax::binding(name));
    names.reduce(|pattern, next| parse_quote!((#pattern, #next))).unwrap_or(parse_quote!(_))
}
