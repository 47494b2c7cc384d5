//! Functions over slices of states.
//!
//! A block of states is one loop whose body is the whole function: LLVM's loop vectoriser turns it
//! into vectors of states, whatever the order of the statements, where its vectoriser of
//! straight-line code would find vectors or not by chance.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use syn::{Expr, ImplItem, Pat, Stmt, Type, parse_quote};

use super::doc;
use super::function::Methods;
use super::namer::derived;
use super::options::Parallel;
use super::outputs;
use super::syntax;
use super::variables::Variables;
use crate::backend::common::used_inputs;
use crate::trigonometry::Trigonometry;

/// As many blocks one thread computes at least: some microseconds of work.
const GRAIN: usize = 32;

/// The slices that the method takes.
struct Slices {
    variables: Variables,
    /// Names, types of one state and whether the function needs it.
    inputs: Vec<(Ident, Type, bool)>,
    /// Names, types and zeros of one state.
    outputs: Vec<(Ident, Type, Expr)>,
    /// The number of states in a block.
    lanes: Literal,
}

impl Slices {
    fn used(&self) -> impl Iterator<Item = &Ident> {
        self.inputs.iter().filter(|(_, _, used)| *used).map(|(name, ..)| name)
    }

    fn output_names(&self) -> impl Iterator<Item = &Ident> {
        self.outputs.iter().map(|(name, ..)| name)
    }

    /// `q.len().min(tau.len())`
    fn shortest(&self) -> Option<Expr> {
        let names = self.inputs.iter().map(|(name, ..)| name).chain(self.output_names());
        let lengths = names.map(|name| -> Expr { parse_quote!(#name.len()) });
        lengths.reduce(|a, b| parse_quote!(#a.min(#b)))
    }
}

impl Methods<'_, '_> {
    /// The method over slices, and the one that computes a block of `lanes` states; none for a
    /// function that needs no inputs.
    ///
    /// The loops of the two are the only ones of generated code. The last states are filled up to a
    /// block with zeros, so that all take the same path; nothing is indexed, so that nothing can panic.
    pub(super) fn batch(&mut self, lanes: usize) -> Vec<ImplItem> {
        let slices = self.slices(lanes);
        if slices.used().next().is_none() {
            return vec![];
        }
        let plain = self.names.plain.clone();
        let batch = derived(&mut self.scope.methods, &plain, "batch");
        let block = derived(&mut self.scope.methods, &plain, "block");
        let mut methods = vec![self.over_slices(&slices, &batch, &block)];
        if self.scope.options.parallel != Parallel::No {
            methods.push(self.over_threads(&slices, lanes, &batch));
        }
        methods.push(self.of_block(slices, &block));
        methods
    }

    fn slices(&self, lanes: usize) -> Slices {
        let function = self.function;
        let mut variables = Variables::new(self.scope, function);
        // The variables of the methods.
        for word in ["count", "half", "result", "circular", "to", "from"] {
            variables.namer.name(word);
        }
        let scalar = self.number.ty();
        let used = used_inputs(function, &function.core).into_iter();
        let used = used.zip(used_inputs(function, &function.angles)).map(|(a, b)| a || b);
        let names = variables.inputs.iter().cloned().zip(&function.inputs).zip(used);
        let inputs = names.map(|((name, input), used)| {
            (name, syntax::array_type(&scalar, input.symbols.len()), used)
        });
        let inputs = inputs.collect();
        let outputs = function.outputs.iter().map(|output| {
            let zero = output.shape.iter().rev().fold(syntax::float(0.0), |zero, length| {
                let length = Literal::usize_unsuffixed(*length);
                parse_quote!([#zero; #length])
            });
            let name = variables.namer.name(&output.name);
            (name, syntax::shaped_type(&scalar, &output.shape), zero)
        });
        let outputs = outputs.collect();
        Slices { variables, inputs, outputs, lanes: Literal::usize_unsuffixed(lanes.max(1)) }
    }

    /// Cuts the slices into blocks.
    fn over_slices(&self, slices: &Slices, batch: &Ident, block: &Ident) -> ImplItem {
        let (runtime, lanes) = (self.number.runtime(), &slices.lanes);
        let (inputs, input_types) = columns(slices.inputs.iter().map(|(name, ty, _)| (name, ty)));
        let (outputs, output_types) =
            columns(slices.outputs.iter().map(|(name, ty, _)| (name, ty)));
        let used: Vec<&Ident> = slices.used().collect();
        let count = slices.shortest();
        let mut namer = slices.variables.namer.clone();
        let mut with = |names: &[&Ident], suffix: &str| -> Vec<Ident> {
            names.iter().map(|name| derived(&mut namer, name, suffix)).collect()
        };
        let (used_rests, output_rests) = (with(&used, "rest"), with(&outputs, "rest"));
        let states = with(&outputs, "states");
        let zeros: Vec<&Expr> = slices.outputs.iter().map(|(_, _, zero)| zero).collect();
        let rest = output_rests.first();
        let (pattern, blocks) = zipped(used.iter().chain(&outputs).map(|name| plain_item(name)));
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
            pub fn #batch(
                &self,
                #(#inputs: &[#input_types],)*
                #(#outputs: &mut [#output_types],)*
            ) -> usize {
                let count = #count;
                #(let #used = #used.get(..count).unwrap_or_default();)*
                #(let #outputs = #outputs.get_mut(..count).unwrap_or_default();)*
                #(let (#used, #used_rests) = #runtime::blocks::<_, #lanes>(#used);)*
                #(let (#outputs, #output_rests) = #runtime::blocks_mut::<_, #lanes>(#outputs);)*
                for #pattern in #blocks {
                    self.#block(#(#used,)* #(#outputs),*);
                }
                if !#rest.is_empty() {
                    #(let mut #states = [#zeros; #lanes];)*
                    self.#block(
                        #(&#runtime::padded_states(#used_rests),)*
                        #(&mut #states),*
                    );
                    #(for (to, from) in #output_rests.iter_mut().zip(#states) {
                        *to = from;
                    })*
                }
                count
            }
        }
    }

    /// Halves the slices until little is left, for as many threads as there are. Halves begin where
    /// blocks do, so that each state is computed as it is by one thread.
    fn over_threads(&mut self, slices: &Slices, lanes: usize, batch: &Ident) -> ImplItem {
        let parallel = derived(&mut self.scope.methods, batch, "parallel");
        let (inputs, input_types) = columns(slices.inputs.iter().map(|(name, ty, _)| (name, ty)));
        let (outputs, output_types) =
            columns(slices.outputs.iter().map(|(name, ty, _)| (name, ty)));
        let mut namer = slices.variables.namer.clone();
        let mut rests = |names: &[&Ident]| -> Vec<Ident> {
            names.iter().map(|name| derived(&mut namer, name, "rest")).collect()
        };
        let (input_rests, output_rests) = (rests(&inputs), rests(&outputs));
        let (count, block) = (slices.shortest(), &slices.lanes);
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
            pub fn #parallel(
                &self,
                #(#inputs: &[#input_types],)*
                #(#outputs: &mut [#output_types],)*
            ) -> usize {
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

    /// A block: the function of each state.
    fn of_block(&mut self, mut slices: Slices, block: &Ident) -> ImplItem {
        let lanes = slices.lanes.clone();
        let inputs = slices.inputs.iter().filter(|(_, _, used)| *used);
        let parameters = inputs.map(|(name, ty, _)| quote!(#name: &[#ty; #lanes]));
        let parameters: Vec<TokenStream> = parameters.collect();
        let outputs = slices.outputs.iter();
        let outputs: Vec<TokenStream> =
            outputs.map(|(name, ty, _)| quote!(#name: &mut [#ty; #lanes])).collect();
        let statements = self.loops(&mut slices);
        parse_quote! {
            #[inline(never)]
            fn #block(&self, #(#parameters,)* #(#outputs),*) {
                #(#statements)*
            }
        }
    }

    /// The loop over the states of a block.
    fn loops(&mut self, slices: &mut Slices) -> Vec<Stmt> {
        let outputs: Vec<Ident> = slices.output_names().cloned().collect();
        let stores = self.stores(&outputs);
        let to_outputs: Vec<(Pat, Expr)> = outputs.iter().map(plain_item).collect();
        if self.function.angles.results().is_empty() {
            let items = slices.used().map(plain_item).chain(to_outputs);
            let (pattern, states) = zip(items);
            let (plain, all) = (&self.names.plain, &slices.variables.inputs);
            let inputs = slices.inputs.iter().zip(&self.function.inputs);
            let unused = inputs
                .filter(|((_, _, used), _)| !used)
                .map(|((name, ..), input)| (name, Literal::usize_unsuffixed(input.symbols.len())));
            let (unused, lengths) = columns(unused);
            return vec![parse_quote! {
                for #pattern in #states {
                    #(let #unused = &[0.0; #lengths];)*
                    let result = self.#plain(#(#all),*);
                    #(#stores)*
                }
            }];
        }
        match self.scope.options.trigonometry {
            Trigonometry::Polynomial => vec![self.one_loop(slices, to_outputs, &stores)],
            Trigonometry::Standard => self.two_loops(slices, to_outputs, &stores),
        }
    }

    /// The whole function in one loop.
    fn one_loop(
        &mut self,
        slices: &mut Slices,
        to_outputs: Vec<(Pat, Expr)>,
        stores: &[Stmt],
    ) -> Stmt {
        let (takes, angles) = self.angles_argument(&mut slices.variables);
        let (pattern, states) = zip(slices.used().map(plain_item).chain(to_outputs));
        let (sc, runtime) = (&self.names.sc, self.number.runtime());
        let (s, c) = (&slices.variables.sines, &slices.variables.cosines);
        let inputs = slices.variables.chosen(&used_inputs(self.function, &self.function.core));
        parse_quote! {
            for #pattern in #states {
                #(#takes)*
                let (#s, #c) = #runtime::sin_cos_each(#angles);
                let result = self.#sc(&#s, &#c, #(#inputs),*);
                #(#stores)*
            }
        }
    }

    /// Sines and cosines of the standard library in a loop of their own, for they are calls, and a
    /// loop with calls is not vectorised.
    fn two_loops(
        &mut self,
        slices: &mut Slices,
        to_outputs: Vec<(Pat, Expr)>,
        stores: &[Stmt],
    ) -> Vec<Stmt> {
        let function = self.function;
        let (takes, angles) = self.angles_argument(&mut slices.variables);
        let angle_inputs = slices.variables.chosen(&used_inputs(function, &function.angles));
        let count = Literal::usize_unsuffixed(function.angles.results().len());
        let (lanes, sin_cos) = (&slices.lanes, self.number.circular_array());
        let circular = (parse_quote!(circular), parse_quote!(&mut circular));
        let (angle_pattern, angle_states) =
            zip(angle_inputs.into_iter().map(plain_item).chain([circular]));
        let inputs = slices.variables.chosen(&used_inputs(function, &function.core));
        let items = inputs.iter().map(|name| plain_item(name)).chain(to_outputs);
        let (s, c) = (&slices.variables.sines, &slices.variables.cosines);
        let known = (parse_quote!((#s, #c)), parse_quote!(circular));
        let (pattern, states) = zip([known].into_iter().chain(items));
        let sc = &self.names.sc;
        vec![
            parse_quote!(let mut circular = [([0.0; #count], [0.0; #count]); #lanes];),
            parse_quote! {
                for #angle_pattern in #angle_states {
                    #(#takes)*
                    *circular = #sin_cos(#angles);
                }
            },
            parse_quote! {
                for #pattern in #states {
                    let result = self.#sc(#s, #c, #(#inputs),*);
                    #(#stores)*
                }
            },
        ]
    }

    /// `*tau = result;`
    fn stores(&self, outputs: &[Ident]) -> Vec<Stmt> {
        if self.scope.output_type(self.function).is_none() {
            return outputs.iter().map(|name| parse_quote!(*#name = result;)).collect();
        }
        let fields = outputs::fields(self.function);
        let stores = outputs.iter().zip(fields);
        stores.map(|(name, field)| parse_quote!(*#name = result.#field;)).collect()
    }
}

/// A variable that is iterated over, under its own name.
fn plain_item(name: &Ident) -> (Pat, Expr) {
    (syntax::binding(name), syntax::variable(name))
}

/// Pairs as two lists.
fn columns<A, B>(pairs: impl Iterator<Item = (A, B)>) -> (Vec<A>, Vec<B>) {
    pairs.unzip()
}

/// `((q, qd), tau)` and `q.iter().zip(qd).zip(tau)`
fn zip(mut items: impl Iterator<Item = (Pat, Expr)>) -> (Pat, Expr) {
    let (first, value) = items.next().unwrap_or_else(|| (parse_quote!(()), parse_quote!([(); 0])));
    zipped([(first, parse_quote!(#value.iter()))].into_iter().chain(items))
}

/// `((q, qd), tau)` and `q.zip(qd).zip(tau)`, if all are iterators.
fn zipped(items: impl Iterator<Item = (Pat, Expr)>) -> (Pat, Expr) {
    let all = items.reduce(|(pattern, zipped), (next, value)| {
        (parse_quote!((#pattern, #next)), parse_quote!(#zipped.zip(#value)))
    });
    all.unwrap_or_else(|| (parse_quote!(()), parse_quote!([(); 0].iter())))
}
