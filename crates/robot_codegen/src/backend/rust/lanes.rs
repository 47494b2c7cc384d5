//! A block of states: one loop whose body is the whole function.
//!
//! LLVM's loop vectorizer turns it into vectors of states, for any order of the statements. Its vectorizer for
//! straight-line code would find vectors only by chance.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use syn::{Expr, ImplItem, Stmt, Type, parse_quote};

use super::batch::{BatchNames, Layout, Slices};
use super::doc;
use super::function::Methods;
use super::kernel::{Choice, Handed};
use super::outputs;
use super::syntax;
use crate::backend::common::{Scalar, used_inputs};
use crate::trigonometry::Trigonometry;

impl Methods<'_, '_> {
    /// Prints the methods that compute a block.
    pub(super) fn of_block(
        &mut self,
        slices: &mut Slices,
        names: &BatchNames,
        layout: Layout,
    ) -> Vec<ImplItem> {
        let returned = self.block_type(slices, layout);
        let (parameters, types) = self.block_parameters(slices, layout);
        let uses_lanes = layout == Layout::States && self.uses_lanes(slices);
        let loops =
            if uses_lanes { self.by_lanes(slices, names) } else { self.loops(slices, layout) };
        let outputs = slices.output_names().into_iter().map(syntax::variable).collect();
        let value = syntax::tuple(outputs);
        let (method, with) = names.of(layout);
        if !self.dispatched {
            let signature = parse_quote! {
                #[inline(never)]
                fn #method(&self, #(#parameters),*) -> #returned {}
            };
            return vec![syntax::with_body(signature, loops, value)];
        }
        let handed = Handed { names: slices.used().collect(), types };
        let (kernel, call) =
            self.kernel(Choice::Block, &slices.variables, &handed, with, &returned);
        let signature = parse_quote! {
            #[inline(always)]
            fn #method(&self, #(#parameters),*) -> #returned {}
        };
        let chooses = syntax::with_body(signature, kernel, call);
        let generics = self.arithmetic_parameter();
        let signature = parse_quote! {
            #[inline(always)]
            fn #with #generics (&self, #(#parameters),*) -> #returned {}
        };
        vec![chooses, syntax::with_body(signature, loops, value)]
    }

    /// Prints the method for one block in memory.
    pub(super) fn block(&self, slices: &Slices, names: &BatchNames) -> ImplItem {
        let lanes = self.lane_array(slices);
        let parameters = slices.inputs.iter().map(|(name, length, _)| {
            let block = syntax::array_type(&lanes, *length);
            quote!(#name: &#block)
        });
        let unused = slices.inputs.iter().filter(|(_, _, used)| !used).map(|(name, ..)| name);
        let (used, returned) = (slices.used(), self.block_type(slices, Layout::Lanes));
        let method = names.of(Layout::Lanes).0;
        let count = &slices.lanes;
        let mut text = vec![format!(
            "`{}` for {count} states side by side: entry i of each array of {count} belongs to state i.",
            self.names.plain
        )];
        let outputs = slices.output_names();
        if outputs.len() > 1 {
            let listed: Vec<String> = outputs.iter().map(|name| format!("`{name}`")).collect();
            text.extend([String::new(), format!("Returns {}.", listed.join(", "))]);
        }
        let docs = doc::attributes(&text);
        let block = &names.block;
        parse_quote! {
            #(#docs)*
            #[inline]
            #[must_use]
            pub fn #block(&self, #(#parameters),*) -> #returned {
                #(let [..] = *#unused;)*
                self.#method(#(#used.each_ref()),*)
            }
        }
    }

    /// The type of one number in each lane: `[f64; 8]`.
    fn lane_array(&self, slices: &Slices) -> Type {
        let (scalar, lanes) = (self.number.ty(), &slices.lanes);
        parse_quote!([#scalar; #lanes])
    }

    /// The type of the outputs for all states of a block.
    fn block_type(&self, slices: &Slices, layout: Layout) -> Type {
        let (scalar, array, lanes) = (self.number.ty(), self.lane_array(slices), &slices.lanes);
        let shapes = slices.outputs.iter().map(|(_, shape)| shape);
        let types: Vec<Type> = match layout {
            Layout::Lanes => shapes.map(|shape| syntax::shaped_type(&array, shape)).collect(),
            Layout::States => {
                let states = shapes.map(|shape| syntax::shaped_type(&scalar, shape));
                states.map(|state| parse_quote!([#state; #lanes])).collect()
            }
        };
        match types.as_slice() {
            [one] => one.clone(),
            _ => parse_quote!((#(#types),*)),
        }
    }

    /// Returns parameters such as `q: [&[f64; 8]; 6]`, and their types with a lifetime.
    fn block_parameters(
        &self,
        slices: &Slices,
        layout: Layout,
    ) -> (Vec<TokenStream>, Vec<TokenStream>) {
        let (scalar, array, lanes) = (self.number.ty(), self.lane_array(slices), &slices.lanes);
        let used = slices.inputs.iter().filter(|(_, _, used)| *used);
        let parameters = used.map(|(name, length, _)| {
            let length = Literal::usize_unsuffixed(*length);
            match layout {
                Layout::Lanes => (quote!(#name: [&#array; #length]), quote!([&'a #array; #length])),
                Layout::States => (
                    quote!(#name: &[[#scalar; #length]; #lanes]),
                    quote!(&'a [[#scalar; #length]; #lanes]),
                ),
            }
        });
        parameters.unzip()
    }

    /// Whether the states of a block are converted to lanes before it is computed. LLVM does not vectorize a loop over
    /// sixteen states in memory, and such code takes four times as long.
    fn uses_lanes(&self, slices: &Slices) -> bool {
        self.scope.options.scalar == Scalar::F32 && slices.count >= 16 && self.dispatched
    }

    /// Prints the conversion of the states to lanes, the computation, and the conversion of the results back to states.
    fn by_lanes(&self, slices: &Slices, names: &BatchNames) -> Vec<Stmt> {
        let (runtime, scalar, lanes) = (self.number.runtime(), self.number.ty(), &slices.lanes);
        let used: Vec<&Ident> = slices.used().collect();
        let outputs = slices.output_names();
        let results =
            syntax::tuple_pattern(&outputs.iter().map(|name| (*name).clone()).collect::<Vec<_>>());
        let (with, argument) = (names.of(Layout::Lanes).1, self.arithmetic_argument());
        let mut statements: Vec<Stmt> = used
            .iter()
            .map(|name| parse_quote!(let #name = #runtime::side_by_side(#name);))
            .collect();
        statements.push(parse_quote! {
            let #results = self.#with #argument (#(#used.each_ref()),*);
        });
        statements.extend(slices.outputs.iter().map(|(name, shape)| -> Stmt {
            let state = syntax::shaped_type(&scalar, shape);
            parse_quote! {
                let #name: [#state; #lanes] = ::core::array::from_fn(|lane| {
                    #runtime::State::of_lane(&#name, lane)
                });
            }
        }));
        statements
    }

    /// Prints the loop over the states of a block.
    fn loops(&mut self, slices: &mut Slices, layout: Layout) -> Vec<Stmt> {
        let lanes = slices.lanes.clone();
        let array = |zero: Expr, length: &Literal| -> Expr { parse_quote!([#zero; #length]) };
        let stored = match self.stores_entries(layout) {
            true => self.has_entries(),
            false => vec![true; slices.outputs.len()],
        };
        let zeros = slices.outputs.iter().zip(stored).map(|((name, shape), is_stored)| -> Stmt {
            let shape = shape.iter().rev().map(|length| Literal::usize_unsuffixed(*length));
            let lengths: Vec<Literal> = match layout {
                Layout::Lanes => [lanes.clone()].into_iter().chain(shape).collect(),
                Layout::States => shape.chain([lanes.clone()]).collect(),
            };
            let zeros = lengths.iter().fold(syntax::float(0.0), array);
            match is_stored {
                true => parse_quote!(let mut #name = #zeros;),
                false => parse_quote!(let #name = #zeros;),
            }
        });
        let mut statements: Vec<Stmt> = zeros.collect();
        statements.extend(self.copied(slices, layout));
        let stores = self.stores(slices, layout);
        let is_angular = !self.function.angles.results().is_empty();
        statements.extend(match self.scope.options.trigonometry {
            _ if !is_angular => self.loops_without_angles(slices, layout, &stores),
            Trigonometry::Polynomial => self.one_loop_each(slices, layout, &stores),
            Trigonometry::Standard => self.two_loops(slices, layout, &stores),
        });
        statements
    }

    /// Makes `let q = &lane(q, lane);` for each name.
    fn states(&self, names: &[&Ident], layout: Layout) -> Vec<Stmt> {
        let runtime = self.number.runtime();
        let state = |name: &&Ident| match layout {
            Layout::Lanes => parse_quote!(let #name = &#runtime::lane(#name, lane);),
            Layout::States => parse_quote!(let #name = &#runtime::state(#name, lane);),
        };
        names.iter().map(state).collect()
    }

    fn loops_without_angles(
        &mut self,
        slices: &Slices,
        layout: Layout,
        stores: &[Vec<Stmt>],
    ) -> Vec<Stmt> {
        let used: Vec<&Ident> = slices.used().collect();
        let states = self.states(&used, layout);
        let (lanes, method) = (&slices.lanes, self.arithmetic_method());
        // A method that is not called from a kernel takes all inputs.
        let all = slices.inputs.iter().filter(|(_, _, used)| *used || !self.dispatched);
        let arguments = all.map(|(name, ..)| name);
        let unused = slices.inputs.iter().filter(|(_, _, used)| !used && !self.dispatched);
        let unused = unused.map(|(name, length, _)| -> Stmt {
            let length = Literal::usize_unsuffixed(*length);
            parse_quote!(let #name = &[0.0; #length];)
        });
        let mut computes = states;
        computes.extend(unused);
        computes.push(parse_quote!(let result = self.#method(#(#arguments),*);));
        loop_each(lanes, &computes, stores)
    }

    /// Prints the whole function in one loop for each group of stores; a loop does not compute what it does not store.
    fn one_loop_each(
        &mut self,
        slices: &mut Slices,
        layout: Layout,
        stores: &[Vec<Stmt>],
    ) -> Vec<Stmt> {
        let (takes, angles) = self.angles_argument(&mut slices.variables);
        let used: Vec<&Ident> = slices.used().collect();
        let states = self.states(&used, layout);
        let (method, circular) = (self.arithmetic_method(), self.number.circular_each());
        let (s, c) = (&slices.variables.sines, &slices.variables.cosines);
        let inputs = slices.variables.chosen(&used_inputs(self.function, &self.function.core));
        let mut computes = states;
        computes.extend(takes);
        computes.push(parse_quote!(let (#s, #c) = #circular(#angles);));
        computes.push(parse_quote!(let result = self.#method(&#s, &#c, #(#inputs),*);));
        loop_each(&slices.lanes, &computes, stores)
    }

    /// Prints two loops. Sines and cosines of the standard library have a loop of their own, because they are calls,
    /// and a loop with calls is not vectorized.
    fn two_loops(
        &mut self,
        slices: &mut Slices,
        layout: Layout,
        stores: &[Vec<Stmt>],
    ) -> Vec<Stmt> {
        let function = self.function;
        let (takes, angles) = self.angles_argument(&mut slices.variables);
        let angle_inputs = slices.variables.chosen(&used_inputs(function, &function.angles));
        let angle_states = self.states(&angle_inputs, layout);
        let inputs = slices.variables.chosen(&used_inputs(function, &function.core));
        let states = self.states(&inputs, layout);
        let count = Literal::usize_unsuffixed(function.angles.results().len());
        let (lanes, sin_cos) = (&slices.lanes, self.number.circular_array());
        let (s, c) = (&slices.variables.sines, &slices.variables.cosines);
        let method = self.arithmetic_method();
        let mut statements: Vec<Stmt> = vec![
            parse_quote!(let mut circular = [([0.0; #count], [0.0; #count]); #lanes];),
            parse_quote! {
                for (lane, circular) in circular.iter_mut().enumerate() {
                    #(#angle_states)*
                    #(#takes)*
                    *circular = #sin_cos(#angles);
                }
            },
        ];
        statements.extend(stores.iter().map(|stores| -> Stmt {
            parse_quote! {
                for (lane, (#s, #c)) in circular.iter().enumerate() {
                    #(#states)*
                    let result = self.#method(#s, #c, #(#inputs),*);
                    #(#stores)*
                }
            }
        }));
        statements
    }

    /// Whether entries are stored one by one, except those that are always 0.
    fn stores_entries(&self, layout: Layout) -> bool {
        layout == Layout::Lanes && self.has_matrices()
    }

    /// Makes the statements that store the results, `State::set_lane(result, &mut tau, lane);`, in a group for each
    /// loop.
    fn stores(&self, slices: &Slices, layout: Layout) -> Vec<Vec<Stmt>> {
        if self.stores_entries(layout) {
            return self.entries(slices);
        }
        let runtime = self.number.runtime();
        let set: Expr = match layout {
            Layout::Lanes => parse_quote!(#runtime::State::set_lane),
            Layout::States => parse_quote!(#runtime::set_state),
        };
        let outputs = slices.output_names().into_iter();
        let stores = outputs.zip(outputs::of_result(self.scope, self.function));
        let store = |(name, value): (&Ident, Expr)| -> Stmt {
            parse_quote!(#set(#value, &mut #name, lane);)
        };
        vec![stores.map(store).collect()]
    }
}

/// Prints a loop over the states of a block for each group of stores: the statements that compute `result`, then the
/// stores.
fn loop_each(lanes: &Literal, computes: &[Stmt], stores: &[Vec<Stmt>]) -> Vec<Stmt> {
    let over_lanes =
        |stores: &Vec<Stmt>| parse_quote!(for lane in 0..#lanes { #(#computes)* #(#stores)* });
    stores.iter().map(over_lanes).collect()
}
