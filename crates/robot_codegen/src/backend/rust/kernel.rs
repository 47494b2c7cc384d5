//! Methods that are compiled for several processors and choose their code for the current one when they are called.

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::{Expr, Stmt, parse_quote};

use super::function::Methods;
use super::syntax;
use super::variables::Variables;
use crate::module::Function;
use crate::program::{Limits, Operation, Statements};

/// The fewest operations of a function that is compiled for several processors; a shorter one would not become faster.
const LEAST_OPERATIONS: usize = 16;

/// Whether a function is compiled for several processors. Tiny functions are not, nor are functions that are cut into
/// parts, whose speed is limited by fetching their instructions.
pub(super) fn is_dispatched(function: &Function, limits: &Limits) -> bool {
    let operations = function.core.operations().len() + function.angles.operations().len();
    operations >= LEAST_OPERATIONS && Statements::new(&function.core, limits).parts.len() <= 1
}

/// Whether a function has multiply-adds, which round once if the processor has the instruction.
pub(super) fn is_fused(function: &Function) -> bool {
    let mut operations = function.core.operations().iter();
    operations.any(|operation| matches!(operation, Operation::MulAdd(..)))
}

/// The way in which a method calls its kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    /// Inlined if there is nothing to choose.
    Call,
    /// Never inlined if multiply-adds are compiled in; used after calls of the standard library's sine and cosine.
    Apart,
    /// Never inlined, with the widest vectors; used for a block of states.
    Block,
}

/// The arguments that a method passes to its kernel.
pub(super) struct Handed<'h> {
    /// The names of the arguments.
    pub(super) names: Vec<&'h Ident>,
    /// Their types, with the lifetime `'a` in references.
    pub(super) types: Vec<TokenStream>,
}

impl Methods<'_, '_> {
    /// Makes the statements and the value of a method that runs `method` as a kernel.
    pub(super) fn kernel(
        &self,
        choice: Choice,
        variables: &Variables,
        handed: &Handed<'_>,
        method: &Ident,
        returned: &syn::Type,
    ) -> (Vec<Stmt>, Expr) {
        let runtime = self.number.runtime();
        let Handed { names, types } = handed;
        let model = variables.namer.clone().name("model");
        let dispatch = match choice {
            Choice::Call => quote!(dispatch),
            Choice::Apart => quote!(dispatch_apart),
            Choice::Block => quote!(dispatch_block),
        };
        let by_limbs = *method == self.names.with && self.limbs().is_some();
        let arithmetic = if by_limbs { Some(quote!(::<A>)) } else { self.arithmetic_argument() };
        let statements = vec![
            parse_quote! {
                #[derive(Clone, Copy)]
                struct Kernel<'a>(&'a Model, #(#types),*);
            },
            parse_quote! {
                impl #runtime::Kernel for Kernel<'_> {
                    type Output = #returned;
                    #[inline(always)]
                    fn run<A: #runtime::Arithmetic>(self) -> #returned {
                        let Kernel(#model, #(#names),*) = self;
                        #model.#method #arithmetic(#(#names),*)
                    }
                }
            },
        ];
        (statements, parse_quote!(#runtime::#dispatch(Kernel(self, #(#names),*))))
    }

    /// The type argument `::<A>` in a kernel whose multiply-adds depend on the processor.
    pub(super) fn arithmetic_argument(&self) -> Option<TokenStream> {
        self.number.has_arithmetic().then(|| quote!(::<A>))
    }

    /// The parameter `<A: Arithmetic>` of a method that such a kernel calls.
    pub(super) fn arithmetic_parameter(&self) -> Option<TokenStream> {
        let runtime = self.number.runtime();
        self.number.has_arithmetic().then(|| quote!(<A: #runtime::Arithmetic>))
    }

    /// The chosen inputs, passed by reference.
    pub(super) fn handed<'v>(
        &self,
        variables: &'v Variables,
        include: &[bool],
        first: &[&'v Ident],
    ) -> Handed<'v> {
        let ty = self.number.ty();
        let angles = syntax::array_type(&ty, self.function.angles.results().len());
        let lengths = self.function.inputs.iter().zip(include).filter(|(_, include)| **include);
        let arrays = lengths.map(|(input, _)| syntax::array_type(&ty, input.symbols.len()));
        let arrays = first.iter().map(|_| angles.clone()).chain(arrays);
        let mut names = first.to_vec();
        names.extend(variables.chosen(include));
        Handed { names, types: arrays.map(|array| quote!(&'a #array)).collect() }
    }
}
