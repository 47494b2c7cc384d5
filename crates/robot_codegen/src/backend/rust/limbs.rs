//! Functions that are computed limb by limb: a function of one limb over any scalar is called with one limb in each
//! lane.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;
use syn::{Expr, ImplItem, Stmt, Type, parse_quote};

use super::body::Body;
use super::function::Methods;
use super::namer::{Namer, derived};
use super::number::Number;
use super::outputs;
use super::syntax;
use super::variables::Variables;
use crate::backend::common::used_inputs;
use crate::limbs::{LimbCall, LimbResult, Limbs};
use crate::module::Function;
use crate::program::{Limits, Program, Source, Statements};

/// Whether no function of a limb is cut into parts.
fn are_whole(limbs: &Limbs, limits: &Limits) -> bool {
    let mut functions = limbs.calls.iter().map(|call| &call.function);
    functions.all(|function| Statements::new(&function.core, limits).parts.len() <= 1)
}

/// For each input of a function, whether the function reads any of its entries.
fn used_by(function: &Function) -> Vec<bool> {
    let programs = [&function.angles, &function.core].map(|program| used_inputs(function, program));
    programs[0].iter().zip(&programs[1]).map(|(a, b)| *a || *b).collect()
}

/// For each input of a function, whether any limb reads an entry of it.
pub(super) fn used_by_limbs(function: &Function, limbs: &Limbs) -> Vec<bool> {
    let mut used = vec![false; function.inputs.len()];
    for call in &limbs.calls {
        for (used, by_limb) in used.iter_mut().zip(used_by(&call.function)) {
            *used |= by_limb;
        }
    }
    used
}

/// Prints the statements that compute the sines and cosines of a limb's angles.
fn sines(
    function: &Function,
    number: &Number,
    variables: &Variables,
    angles: Vec<Expr>,
) -> Vec<Stmt> {
    if number.is_generic() {
        // Each angle has a call of its own, because a call of a function value is not inlined into a kernel.
        let sin_cos = number.method("sin_cos");
        let pairs = variables.sines_and_cosines(&function.core).into_iter().zip(angles);
        let taken = pairs.map(|(pair, angle)| parse_quote!(let #pair = #sin_cos(#angle);));
        return taken.collect();
    }
    let (s, c) = (&variables.sines, &variables.cosines);
    let (circular, angles) = (number.circular_array(), syntax::array(angles));
    let mut statements = vec![parse_quote!(let (#s, #c) = &#circular(&#angles);)];
    statements.extend(variables.take_angles(&function.core));
    statements
}

impl Methods<'_, '_> {
    /// The limbs, if the function is computed limb by limb; that requires the runtime's sines and a kernel.
    pub(super) fn limbs(&self) -> Option<&Limbs> {
        let limbs = self.function.limbs.as_ref()?;
        let taken = self.dispatched && !self.has_calls();
        (taken && are_whole(limbs, &self.scope.options.limits)).then_some(limbs)
    }

    /// Prints the method that computes the function limb by limb, and the methods of single limbs.
    pub(super) fn of_limbs(&mut self, limbs: &Limbs, name: &Ident) -> Vec<ImplItem> {
        let function = self.function;
        let variables = Variables::new(self.scope, function);
        let used = used_by_limbs(function, limbs);
        let runtime = self.number.runtime();
        let mut statements = vec![];
        let mut namer = variables.namer.clone();
        let mut items = vec![];
        let mut results: Vec<Vec<Vec<Ident>>> = vec![];
        for (index, call) in limbs.calls.iter().enumerate() {
            for (lane, entries) in call.inputs.iter().enumerate() {
                if !call.inputs[..lane].contains(entries) {
                    let used = used_by(&call.function);
                    statements.extend(variables.take_lane(function, &used, entries, runtime));
                }
            }
            let of_limb = derived(&mut self.scope.methods, &self.names.plain, "limb");
            let (calls, found) = self.limb_call(limbs, index, &of_limb, &variables, &mut namer);
            statements.extend(calls);
            results.push(found);
            items.push(self.of_one(call, &of_limb));
        }
        let values = limbs.results.iter().map(|result| match result {
            Some(place) => syntax::variable(&results[place.call][place.result][place.lane]),
            None => syntax::float(0.0),
        });
        let value = outputs::value(self.scope, function, values.collect());
        let parameters = self.input_parameters(&variables, &used);
        let returned = outputs::returned(self.scope, function, self.number);
        let signature = parse_quote! {
            #[inline(always)]
            fn #name<A: #runtime::Arithmetic>(#(#parameters),*) -> #returned {}
        };
        items.insert(0, syntax::with_body(signature, statements, value));
        items
    }

    /// Returns the statements that call a limb's function, and the names of its results in each lane.
    fn limb_call(
        &self,
        limbs: &Limbs,
        index: usize,
        method: &Ident,
        variables: &Variables,
        namer: &mut Namer,
    ) -> (Vec<Stmt>, Vec<Vec<Ident>>) {
        let call = &limbs.calls[index];
        let lanes = call.lanes();
        let used = used_by(&call.function);
        let array = |numbers: Vec<Expr>| -> Expr {
            let numbers = syntax::array(numbers);
            if lanes == 1 { parse_quote!(#numbers) } else { parse_quote!(lanes(#numbers)) }
        };
        let entry = |index: usize| -> Expr {
            let numbers = call.inputs.iter().map(|of_lane| {
                let name = variables.name(Source::Input(of_lane[index] as u32));
                name.as_ref().map_or_else(syntax::nothing, syntax::variable)
            });
            let mut numbers: Vec<Expr> = numbers.collect();
            if lanes == 1 { numbers.remove(0) } else { array(numbers) }
        };
        let mut arguments: Vec<Expr> = vec![];
        if !call.fields.is_empty() {
            let scalar = self.scope.options.scalar;
            let fields = call.fields.iter().map(|numbers| {
                array(numbers.iter().map(|number| syntax::constant(scalar, *number)).collect())
            });
            arguments.push(syntax::array(fields));
        }
        let mut first = 0;
        for (input, used) in call.function.inputs.iter().zip(&used) {
            let entries = first..first + input.symbols.len();
            first = entries.end;
            if *used {
                arguments.push(syntax::array(entries.map(entry)));
            }
        }
        let count = call.function.core.results().len();
        let name = |namer: &mut Namer| namer.name("r");
        let of_limb: Vec<Ident> = (0..count).map(|_| name(namer)).collect();
        let pattern = syntax::array_pattern(of_limb.iter().map(syntax::binding));
        let mut statements: Vec<Stmt> = vec![];
        if lanes == 1 {
            let arithmetic = self.arithmetic_argument();
            statements
                .push(parse_quote!(let #pattern = Model::#method #arithmetic(#(&#arguments),*);));
            return (statements, of_limb.into_iter().map(|name| vec![name]).collect());
        }
        let (runtime, ty) = (self.number.runtime(), self.number.ty());
        let (width, once) = (Literal::usize_unsuffixed(lanes), self.number.has_arithmetic());
        statements.push(parse_quote! {
            let lanes = #runtime::LanesOn::<A, #ty, #width, #once>::from_array;
        });
        statements.push(parse_quote!(let #pattern = Model::#method(#(&#arguments),*);));
        let mut results = vec![];
        for (result, of_lanes) in of_limb.iter().enumerate() {
            let names: Vec<Ident> = (0..lanes).map(|_| name(namer)).collect();
            // Lanes that repeat a limb have no results.
            let wanted = names.iter().enumerate().map(|(lane, name)| {
                let place = LimbResult { call: index, lane, result };
                syntax::optional_binding(limbs.results.contains(&Some(place)).then_some(name))
            });
            let pattern = syntax::array_pattern(wanted);
            statements.push(parse_quote!(let #pattern = #of_lanes.to_array();));
            results.push(names);
        }
        (statements, results)
    }

    /// Prints the function of one limb, over any scalar, or over plain numbers if there is only one lane.
    fn of_one(&self, call: &LimbCall, name: &Ident) -> ImplItem {
        let function = &call.function;
        let number = match call.lanes() {
            1 => self.number.clone(),
            _ => self.number.generic(false).without_arithmetic(),
        };
        let mut variables = Variables::new(self.scope, function);
        let fields = variables.namer.name("k");
        let numbered = (1..=call.fields.len()).map(|index| format!("k{index}"));
        let names: Vec<Ident> = numbered.map(|name| variables.namer.name(&name)).collect();
        let mut statements: Vec<Stmt> = vec![];
        let ty = number.ty();
        let mut parameters: Vec<TokenStream> = vec![];
        if !names.is_empty() {
            let array = syntax::array_type(&ty, names.len());
            parameters.push(quote!(#fields: &#array));
            let pattern = syntax::array_pattern(names.iter().map(syntax::binding));
            statements.push(parse_quote!(let #pattern = *#fields;));
        }
        for ((input, array), used) in
            function.inputs.iter().zip(&variables.inputs).zip(used_by(function))
        {
            let ty = syntax::array_type(&ty, input.symbols.len());
            parameters.extend(used.then(|| quote!(#array: &#ty)));
        }
        let mut namer = variables.namer.clone();
        let mut print = |program: &Program| {
            let load = |source: Source| match source {
                Source::Field(index) => syntax::variable(&names[index as usize]),
                _ => {
                    let name = variables.name(source);
                    name.as_ref().map_or_else(syntax::nothing, syntax::variable)
                }
            };
            let limits = &self.scope.options.limits;
            let body = Body::new(program, limits, &number, &load, &mut namer);
            (body.statements(), body.results())
        };
        statements.extend(variables.take_entries(function, &function.angles));
        let (of_angles, angles) = print(&function.angles);
        statements.extend(of_angles);
        statements.extend(sines(function, &number, &variables, angles));
        statements.extend(variables.take_entries(function, &function.core));
        let (of_core, results) = print(&function.core);
        statements.extend(of_core);
        let returned: Type = syntax::array_type(&ty, results.len());
        let generics = match call.lanes() {
            1 => self.arithmetic_parameter(),
            _ => Some(number.generics()).map(|generics| quote!(#generics)),
        };
        let signature = parse_quote! {
            #[inline(always)]
            fn #name #generics (#(#parameters),*) -> #returned {}
        };
        syntax::with_body(signature, statements, syntax::array(results))
    }
}
