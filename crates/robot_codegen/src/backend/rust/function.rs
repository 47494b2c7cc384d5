//! The methods of a function of the module.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use syn::{Expr, ImplItem, Item, Stmt, parse_quote};

use super::body::Body;
use super::doc;
use super::kernel::{self, Choice};
use super::limbs::used_by_limbs;
use super::namer::{Namer, derived, identifier};
use super::number::Number;
use super::outputs;
use super::parts::{self, CutFunction};
use super::scope::Scope;
use super::syntax;
use super::variables::Variables;
use crate::backend::common::{self, used_inputs};
use crate::module::Function;
use crate::program::{Operation, Program, Source};
use crate::trigonometry::Trigonometry;

/// The most operations of a function that is offered for inlining into other crates.
const INLINE_LIMIT: usize = 5000;

/// The names of a function's methods.
pub(super) struct Names {
    pub(super) plain: Ident,
    pub(super) sc: Ident,
    /// The form of the plain method that kernels call; `sc_with` is that of the method that takes sines and cosines.
    pub(super) with: Ident,
    sc_with: Ident,
    angles: Ident,
    /// The method that computes the function limb by limb.
    limbs: Ident,
}

impl Names {
    fn new(namer: &mut Namer, plain: &Ident) -> Names {
        Names {
            plain: plain.clone(),
            sc: derived(namer, plain, "sc"),
            with: derived(namer, plain, "with"),
            sc_with: derived(namer, plain, "sc_with"),
            angles: derived(namer, plain, "angles"),
            limbs: derived(namer, plain, "limbs"),
        }
    }
}

/// Prints all items of one function.
pub(super) fn items(scope: &mut Scope<'_>, function: &Function, plain: &Ident) -> Vec<Item> {
    let mut items = vec![];
    items.extend(outputs::type_item(scope, function, scope.options.generic));
    let number = scope.number.clone();
    let dispatched = kernel::is_dispatched(function, &scope.options.limits);
    let fused = dispatched && kernel::is_fused(function);
    let chosen = if fused { number.with_arithmetic() } else { number.clone() };
    let mut printer = Methods::new(scope, function, &chosen, plain, dispatched);
    let mut methods = printer.all();
    if let Some(lanes) = printer.scope.options.batch {
        methods.extend(printer.batch(lanes));
    }
    let mut of_any_fields = None;
    if scope.options.generic {
        let generic = derived(&mut scope.methods, plain, "generic");
        let number = number.generic(scope.has_own_fields());
        let forms = Methods::new(scope, function, &number, &generic, false).all();
        if scope.has_own_fields() {
            of_any_fields = Some(syntax::impl_model_of_any_fields(forms));
        } else {
            methods.extend(forms);
        }
    }
    items.push(syntax::impl_model(methods));
    items.extend(of_any_fields);
    if !scope.has_parameters() {
        items.push(free_function(scope, function, plain));
    }
    items
}

/// Prints the methods of a function in one number type.
pub(super) struct Methods<'s, 'a> {
    pub(super) scope: &'s mut Scope<'a>,
    pub(super) function: &'s Function,
    pub(super) number: &'s Number,
    pub(super) names: Names,
    /// Whether the function is compiled for several processors.
    pub(super) dispatched: bool,
}

/// The statements of a program, its results, and the functions of its parts.
struct Printed {
    statements: Vec<Stmt>,
    results: Vec<Expr>,
    parts: Vec<ImplItem>,
}

impl<'s, 'a> Methods<'s, 'a> {
    fn new(
        scope: &'s mut Scope<'a>,
        function: &'s Function,
        number: &'s Number,
        plain: &Ident,
        dispatched: bool,
    ) -> Methods<'s, 'a> {
        let names = Names::new(&mut scope.methods, plain);
        Methods { scope, function, number, names, dispatched }
    }

    fn all(&mut self) -> Vec<ImplItem> {
        if self.function.angles.results().is_empty() {
            return self.arithmetic();
        }
        let mut methods = self.whole();
        if !self.has_plain_angles() {
            methods.extend(self.angles());
        }
        methods.extend(self.arithmetic_of_angles());
        methods
    }

    /// Whether sines and cosines are calls of the standard library, which stay outside of kernels.
    pub(super) fn has_calls(&self) -> bool {
        self.scope.options.trigonometry == Trigonometry::Standard
    }

    /// Chooses how the arithmetic is called after sines and cosines of the standard library. LLVM cannot keep values in
    /// registers across these calls. If multiply-adds are compiled in, and the arithmetic needs inputs other than sines
    /// and cosines, it is 3 to 7 % slower if it is inlined (`docs/performance.md`).
    fn choice_after_calls(&self) -> Choice {
        let function = self.function;
        let more = used_inputs(function, &function.core).contains(&true);
        if more { Choice::Apart } else { Choice::Call }
    }

    /// The method of the arithmetic that kernels and loops call, with its type argument.
    pub(super) fn arithmetic_method(&self) -> TokenStream {
        let Names { plain, sc, with, sc_with, .. } = &self.names;
        let without_angles = self.function.angles.results().is_empty();
        let argument = self.arithmetic_argument();
        match (self.dispatched, without_angles) {
            (false, true) => quote!(#plain),
            (false, false) => quote!(#sc),
            (true, true) => quote!(#with #argument),
            (true, false) if self.has_calls() || argument.is_some() => quote!(#sc_with #argument),
            (true, false) => quote!(#sc),
        }
    }

    /// Whether every angle is an entry of an input.
    fn has_plain_angles(&self) -> bool {
        let operations = self.function.angles.operations();
        operations.iter().all(|operation| matches!(operation, Operation::Load(Source::Input(_))))
    }

    /// Prints the method that takes the inputs and computes the angles, their sines and cosines, and the arithmetic.
    fn whole(&mut self) -> Vec<ImplItem> {
        let function = self.function;
        let mut variables = Variables::new(self.scope, function);
        let in_core = used_inputs(function, &function.core);
        let in_angles = used_inputs(function, &function.angles);
        let mut used: Vec<bool> = in_core.iter().zip(&in_angles).map(|(a, b)| *a || *b).collect();
        let limbs = self.limbs().cloned();
        let in_limbs = limbs.as_ref().map(|limbs| used_by_limbs(function, limbs));
        for (used, in_limbs) in used.iter_mut().zip(in_limbs.into_iter().flatten()) {
            *used |= in_limbs;
        }
        let (takes, angles) = self.angles_argument(&mut variables);
        let circular = self.number.circular_array();
        let (s, c) = (&variables.sines, &variables.cosines);
        let arguments = variables.chosen(&in_core);
        let mut statements = takes;
        statements.push(parse_quote!(let (#s, #c) = #circular(#angles);));
        let (plain, docs) = (self.names.plain.clone(), self.doc());
        let all = self.input_parameters(&variables, &vec![true; used.len()]);
        let ignored = variables.ignore(&used);
        if !self.dispatched || self.has_calls() {
            let sc = &self.names.sc;
            let value = parse_quote!(self.#sc(&#s, &#c, #(#arguments),*));
            let statements = ignored.into_iter().chain(statements).collect();
            return vec![self.method(&plain, &docs, &all, statements, value)];
        }
        let method = self.arithmetic_method();
        let value = parse_quote!(self.#method(&#s, &#c, #(#arguments),*));
        let (with, handed) = (self.names.with.clone(), self.handed(&variables, &used, &[]));
        let returned = outputs::returned(self.scope, function, self.number);
        let (kernel, call) = self.kernel(Choice::Call, &variables, &handed, &with, &returned);
        let parameters = self.input_parameters(&variables, &used);
        let kernel = ignored.into_iter().chain(kernel).collect();
        let public = self.method(&plain, &docs, &all, kernel, call);
        let Some(limbs) = limbs else {
            return vec![public, self.private(&with, &parameters, statements, value)];
        };
        let name = self.names.limbs.clone();
        let arguments = variables.chosen(&used_by_limbs(function, &limbs));
        let flat = syntax::block(statements, value);
        let value = parse_quote! {
            if A::SIDE_BY_SIDE { Model::#name::<A>(#(#arguments),*) } else #flat
        };
        let runtime = self.number.runtime();
        let signature = parse_quote! {
            #[inline(always)]
            fn #with<A: #runtime::Arithmetic>(&self, #(#parameters),*) -> #returned {}
        };
        let with = syntax::with_body(signature, vec![], value);
        [public, with].into_iter().chain(self.of_limbs(&limbs, &name)).collect()
    }

    /// Returns `&[q1, q2]` and the statements before it, or a call of the method that computes the angles.
    pub(super) fn angles_argument(&mut self, variables: &mut Variables) -> (Vec<Stmt>, Expr) {
        let function = self.function;
        if self.has_plain_angles() {
            let takes = variables.take_entries(function, &function.angles);
            let name = self.names.plain.clone();
            let array = syntax::array(self.print_angles(variables, &name).results);
            return (takes, parse_quote!(&#array));
        }
        let used = used_inputs(function, &function.angles);
        let (method, arguments) = (&self.names.angles, variables.chosen(&used));
        (vec![], parse_quote!(&self.#method(#(#arguments),*)))
    }

    /// Prints the method that computes the angles, if some are not entries of inputs.
    fn angles(&mut self) -> Vec<ImplItem> {
        let (function, name) = (self.function, self.names.angles.clone());
        let mut variables = Variables::new(self.scope, function);
        let used = used_inputs(function, &function.angles);
        let mut statements = variables.take_entries(function, &function.angles);
        let printed = self.print_angles(&mut variables, &name);
        statements.extend(printed.statements);
        let text = format!("The angles whose sines and cosines `{}` uses, in rad.", self.names.sc);
        let docs = doc::attributes(&[text]);
        let parameters = self.input_parameters(&variables, &used);
        let returned = syntax::array_type(&self.number.ty(), printed.results.len());
        let (generics, clause) = (self.number.generics(), self.number.where_clause());
        let inline = self.inline();
        let signature = parse_quote! {
            #(#docs)*
            #inline
            #[must_use]
            pub fn #name #generics (&self, #(#parameters),*) -> #returned #clause {}
        };
        let method = syntax::with_body(signature, statements, syntax::array(printed.results));
        [method].into_iter().chain(printed.parts).collect()
    }

    /// Prints the arithmetic of a function without angles.
    fn arithmetic(&mut self) -> Vec<ImplItem> {
        let function = self.function;
        let variables = Variables::new(self.scope, function);
        let used = used_inputs(function, &function.core);
        let parameters = self.input_parameters(&variables, &vec![true; used.len()]);
        let (name, docs) = (self.names.plain.clone(), self.doc());
        let statements = variables.ignore(&used);
        if !self.dispatched {
            return self.core(variables, &name, &docs, &parameters, statements);
        }
        let handed = self.handed(&variables, &used, &[]);
        let with = self.names.with.clone();
        let chosen = self.input_parameters(&variables, &used);
        let returned = outputs::returned(self.scope, function, self.number);
        let (kernel, call) = self.kernel(Choice::Call, &variables, &handed, &with, &returned);
        let kernel = statements.into_iter().chain(kernel).collect();
        let public = self.method(&name, &docs, &parameters, kernel, call);
        [public].into_iter().chain(self.core(variables, &with, &[], &chosen, vec![])).collect()
    }

    /// Prints the method of the arithmetic that takes sines and cosines.
    fn arithmetic_of_angles(&mut self) -> Vec<ImplItem> {
        let function = self.function;
        let variables = Variables::new(self.scope, function);
        let used = used_inputs(function, &function.core);
        let parameters = self.sc_parameters(&variables, &used);
        let (name, docs) = (self.names.sc.clone(), self.sc_doc());
        let statements = variables.take_angles(&function.core).to_vec();
        let with = self.names.sc_with.clone();
        let returned = outputs::returned(self.scope, function, self.number);
        let public = if self.dispatched && self.has_calls() {
            let first = [&variables.sines, &variables.cosines];
            let handed = self.handed(&variables, &used, &first);
            let choice = self.choice_after_calls();
            let (kernel, call) = self.kernel(choice, &variables, &handed, &with, &returned);
            self.method(&name, &docs, &parameters, kernel, call)
        } else if self.number.has_arithmetic() {
            let (runtime, arguments) = (self.number.runtime(), variables.chosen(&used));
            let (s, c) = (&variables.sines, &variables.cosines);
            let call = parse_quote!(self.#with::<#runtime::Compiled>(#s, #c, #(#arguments),*));
            self.method(&name, &docs, &parameters, vec![], call)
        } else {
            return self.core(variables, &name, &docs, &parameters, statements);
        };
        let core = self.core(variables, &with, &[], &parameters, statements);
        [public].into_iter().chain(core).collect()
    }

    /// The parameters: sines, cosines, and the inputs that are used in addition.
    fn sc_parameters(&self, variables: &Variables, used: &[bool]) -> Vec<TokenStream> {
        let array = syntax::array_type(&self.number.ty(), self.function.angles.results().len());
        let (s, c) = (&variables.sines, &variables.cosines);
        let inputs = self.input_parameters(variables, used);
        [quote!(#s: &#array), quote!(#c: &#array)].into_iter().chain(inputs).collect()
    }

    fn core(
        &mut self,
        mut variables: Variables,
        name: &Ident,
        docs: &[String],
        parameters: &[TokenStream],
        mut statements: Vec<Stmt>,
    ) -> Vec<ImplItem> {
        let function = self.function;
        statements.extend(variables.take_entries(function, &function.core));
        let printed = self.print(&function.core, &mut variables, name);
        statements.extend(printed.statements);
        let value = outputs::value(self.scope, function, printed.results);
        let method = if docs.is_empty() {
            self.private(name, parameters, statements, value)
        } else {
            self.method(name, docs, parameters, statements, value)
        };
        [method].into_iter().chain(printed.parts).collect()
    }

    fn print(&mut self, program: &Program, variables: &mut Variables, name: &Ident) -> Printed {
        let number = self.number.clone();
        self.print_with(&number, program, variables, name)
    }

    /// Prints the angles. They are sums and use the arithmetic of the compilation target.
    fn print_angles(&mut self, variables: &mut Variables, name: &Ident) -> Printed {
        let number = self.number.without_arithmetic();
        let function = self.function;
        self.print_with(&number, &function.angles, variables, name)
    }

    fn print_with(
        &mut self,
        number: &Number,
        program: &Program,
        variables: &mut Variables,
        name: &Ident,
    ) -> Printed {
        let mut namer = std::mem::take(&mut variables.namer);
        let fields = self.scope.fields.clone();
        let source_name = |source: Source| variables.name(source);
        let load = |source: Source| match source {
            Source::Field(index) => number.field(&fields[index as usize]),
            _ => source_name(source).as_ref().map_or_else(syntax::nothing, syntax::variable),
        };
        let limits = &self.scope.options.limits;
        let body = Body::new(program, limits, number, &load, &mut namer);
        let cut = CutFunction {
            number,
            name,
            is_method: true,
            is_const: false,
            source_name: &source_name,
        };
        let results = body.results();
        let (statements, parts) = parts::statements(self.scope, &body, &cut);
        Printed { statements, results, parts }
    }

    fn method(
        &self,
        name: &Ident,
        docs: &[String],
        parameters: &[TokenStream],
        statements: Vec<Stmt>,
        value: Expr,
    ) -> ImplItem {
        let docs = doc::attributes(docs);
        let (generics, clause) = (self.number.generics(), self.number.where_clause());
        let inline = self.inline();
        let returned = outputs::returned(self.scope, self.function, self.number);
        let signature = parse_quote! {
            #(#docs)*
            #inline
            #[must_use]
            pub fn #name #generics (&self, #(#parameters),*) -> #returned #clause {}
        };
        syntax::with_body(signature, statements, value)
    }

    /// Makes a method that kernels call and that is inlined into each.
    fn private(
        &self,
        name: &Ident,
        parameters: &[TokenStream],
        statements: Vec<Stmt>,
        value: Expr,
    ) -> ImplItem {
        let generics = self.arithmetic_parameter();
        let returned = outputs::returned(self.scope, self.function, self.number);
        let signature = parse_quote! {
            #[inline(always)]
            fn #name #generics (&self, #(#parameters),*) -> #returned {}
        };
        syntax::with_body(signature, statements, value)
    }

    /// Returns the attribute for inlining, if the function is short. If there is a loop over states, the function has
    /// to be inlined into it, so that the loop can be vectorized.
    fn inline(&self) -> Option<TokenStream> {
        let short = self.function.core.operations().len() <= INLINE_LIMIT;
        short
            .then(|| if self.is_in_loops() { quote!(#[inline(always)]) } else { quote!(#[inline]) })
    }

    fn is_in_loops(&self) -> bool {
        self.scope.options.batch.is_some() && !self.number.is_generic()
    }

    pub(super) fn input_parameters(
        &self,
        variables: &Variables,
        include: &[bool],
    ) -> Vec<TokenStream> {
        let ty = self.number.ty();
        let inputs = variables.inputs.iter().zip(&self.function.inputs).zip(include);
        let included = inputs.filter(|(_, include)| **include);
        let parameters = included.map(|((name, input), _)| {
            let array = syntax::array_type(&ty, input.symbols.len());
            quote!(#name: &#array)
        });
        parameters.collect()
    }

    fn doc(&self) -> Vec<String> {
        let function = self.function;
        let names: Vec<String> =
            function.inputs.iter().map(|input| identifier(&input.name)).collect();
        let counts = self.scope.module.counts(function);
        common::function(function, names.iter().map(String::as_str), &counts.call)
    }

    fn sc_doc(&mut self) -> Vec<String> {
        let angles = self.angle_texts().join(", ");
        let name = &self.names.plain;
        vec![
            format!("`{name}`, given the sines `s` and cosines `c` of its angles."),
            String::new(),
            format!("The angles: {angles}."),
        ]
    }

    /// The angles as code if each is a single expression; otherwise a reference to the method of the angles.
    fn angle_texts(&mut self) -> Vec<String> {
        let function = self.function;
        let mut variables = Variables::new(self.scope, function);
        let name = self.names.angles.clone();
        let printed = self.print_angles(&mut variables, &name);
        if printed.statements.is_empty() {
            let texts =
                printed.results.iter().map(|angle| format!("`{}`", angle.to_token_stream()));
            texts.collect()
        } else {
            vec![format!("those of `{name}`")]
        }
    }
}

/// Makes a free function that calls the method, for modules without parameters.
fn free_function(scope: &Scope<'_>, function: &Function, name: &Ident) -> Item {
    let ty = scope.number.ty();
    let inputs = Variables::new(scope, function).inputs;
    let lengths = function.inputs.iter().map(|input| input.symbols.len());
    let types = lengths.map(|length| syntax::array_type(&ty, length));
    let returned = outputs::returned(scope, function, &scope.number);
    let docs = doc::attributes(&[format!("[`Model::{name}`] of the only model.")]);
    parse_quote! {
        #(#docs)*
        #[inline]
        #[must_use]
        pub fn #name(#(#inputs: &#types),*) -> #returned {
            Model.#name(#(#inputs),*)
        }
    }
}
