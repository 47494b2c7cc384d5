//! The arguments of `include_robot!`.

use proc_macro2::Span;
use robot_build::{
    ALL_FUNCTIONS, Bundle, FunctionKind, Functions, Kind, OPTIONS, OptionSpec, Options, Robot,
    Value, functions,
};
use robot_symbolic::nearest_word;
use syn::parse::{Parse, ParseStream};
use syn::{Expr, ExprLit, Ident, Lit, LitStr, Token, UnOp};

/// The arguments, such as `"path", key = value, …`.
pub(crate) struct Arguments {
    pub(crate) path: LitStr,
    /// The options except for the functions, which can only be checked when the robot is known; see
    /// [`Arguments::options_for`].
    pub(crate) options: Options,
    pub(crate) allow_outside: bool,
    functions: Option<Vec<LitStr>>,
    bundles: Vec<(Ident, Vec<LitStr>)>,
}

impl Parse for Arguments {
    fn parse(input: ParseStream<'_>) -> syn::Result<Arguments> {
        let path = input.parse().map_err(|error| {
            syn::Error::new(error.span(), "expected the path of a robot file as a string literal")
        })?;
        let mut arguments = Arguments {
            path,
            options: Options::default(),
            allow_outside: false,
            functions: None,
            bundles: vec![],
        };
        let mut errors: Option<syn::Error> = None;
        let mut seen: Vec<Ident> = vec![];
        while !input.is_empty() {
            input.parse::<Token![,]>()?;
            if input.is_empty() {
                break;
            }
            let key: Ident = input.parse()?;
            input.parse::<Token![=]>()?;
            let result = if key == "bundles" {
                arguments.set_bundles(input.parse()?)
            } else {
                arguments.set(&key, &input.parse()?)
            };
            let twice =
                || syn::Error::new(key.span(), format!("`{key}` is given twice; leave one out"));
            let result = if seen.contains(&key) { Err(twice()) } else { result };
            if let Err(error) = result {
                match &mut errors {
                    Some(errors) => errors.combine(error),
                    None => errors = Some(error),
                }
            }
            seen.push(key);
        }
        errors.map_or(Ok(arguments), Err)
    }
}

impl Arguments {
    fn set_bundles(&mut self, Bundles(bundles): Bundles) -> syn::Result<()> {
        for (name, value) in bundles {
            self.bundles.push((name, list(&value, None)?));
        }
        Ok(())
    }

    /// The options, including the functions of a robot.
    ///
    /// # Errors
    ///
    /// An error for each name that is not the name of a function, at its place.
    pub(crate) fn options_for(&self, robot: &Robot) -> syn::Result<Options> {
        let mut options = self.options.clone();
        if let Some(names) = &self.functions {
            let (all, names): (Vec<&LitStr>, Vec<&LitStr>) =
                names.iter().partition(|name| name.value() == ALL_FUNCTIONS);
            let functions = Functions::listed(!all.is_empty(), kinds(names, robot)?);
            options.functions = functions.ok_or_else(|| {
                let place = all.first().map_or_else(Span::call_site, |all| all.span());
                syn::Error::new(place, robot_build::Error::AllFunctionsAndOthers)
            })?;
        }
        for (name, functions) in &self.bundles {
            let functions = kinds(functions, robot)?;
            options.bundles.push(Bundle { name: name.to_string(), functions });
        }
        Ok(options)
    }

    fn set(&mut self, key: &Ident, value: &Expr) -> syn::Result<()> {
        let name = key.to_string();
        let Some(option) = OptionSpec::named(&name) else {
            let keys: Vec<&str> = OPTIONS.iter().map(|option| option.name).collect();
            let (near, keys) = (meant(&name, &keys), keys.join(", "));
            let message = format!("there is no option `{key}`{near}; the options are {keys}");
            return Err(syn::Error::new(key.span(), message));
        };
        if name == "allow_outside" {
            self.allow_outside = boolean(value)?;
        }
        let word;
        let given = match option.kind {
            Kind::Functions => {
                self.functions = Some(list(value, Some(ALL_FUNCTIONS))?);
                return Ok(());
            }
            // Bundles have a syntax of their own, which `Arguments::parse` reads.
            Kind::Bundles => return Ok(()),
            Kind::Flag => Value::Flag(boolean(value)?),
            Kind::Count { .. } => Value::Count(size(value)?),
            Kind::Angle => Value::Number(number(value)?),
            Kind::Choice(words) => {
                let words: Vec<(&str, &str)> =
                    words.iter().map(|(word, _)| (*word, *word)).collect();
                Value::Word(one_of(value, &words)?)
            }
            Kind::Path => {
                word = text(value)?.value();
                Value::Word(&word)
            }
        };
        let refused = || syn::Error::new_spanned(value, format!("invalid value for `{key}`"));
        option.set(&mut self.options, given).ok_or_else(refused)
    }
}

/// The bundles, such as `{ dynamics = ["mass_matrix", "bias"], … }`.
struct Bundles(Vec<(Ident, Expr)>);

impl Parse for Bundles {
    fn parse(input: ParseStream<'_>) -> syn::Result<Bundles> {
        let content;
        let braces = syn::braced!(content in input);
        if content.is_empty() {
            let message = "the list of bundles is empty; name at least one, or leave out `bundles`";
            return Err(syn::Error::new(braces.span.join(), message));
        }
        let bundle = |input: ParseStream<'_>| {
            let name = input.parse()?;
            input.parse::<Token![=]>()?;
            Ok((name, input.parse()?))
        };
        let bundles = content.parse_terminated(bundle, Token![,])?;
        Ok(Bundles(bundles.into_iter().collect()))
    }
}

/// The functions of a robot with the given names.
fn kinds<'n>(
    names: impl IntoIterator<Item = &'n LitStr>,
    robot: &Robot,
) -> syn::Result<Vec<FunctionKind>> {
    let (mut kinds, mut errors): (_, Option<syn::Error>) = (vec![], None);
    for name in names {
        match functions::named(robot, &name.value()) {
            Ok(kind) => kinds.push(kind),
            Err(wrong) => {
                let error = syn::Error::new(name.span(), wrong);
                match &mut errors {
                    Some(errors) => errors.combine(error),
                    None => errors = Some(error),
                }
            }
        }
    }
    errors.map_or(Ok(kinds), Err)
}

/// Reads a list of names of functions, or the word `more` if it is given; it must not be empty. Functions of single
/// frames are resolved when the robot is known.
fn list(value: &Expr, more: Option<&'static str>) -> syn::Result<Vec<LitStr>> {
    let Expr::Array(array) = value else {
        return Err(syn::Error::new_spanned(
            value,
            "expected a list of functions, such as [\"inverse_dynamics\"]",
        ));
    };
    if array.elems.is_empty() {
        let message = "the list of functions is empty; name at least one function";
        return Err(syn::Error::new_spanned(value, message));
    }
    let kinds = FunctionKind::ALL.iter().map(|kind| kind.name());
    let known: Vec<(&str, ())> = kinds.chain(more).map(|name| (name, ())).collect();
    let name = |element| {
        let name = text(element)?;
        if !functions::is_of_frame(&name.value()) {
            one_of(element, &known)?;
        }
        Ok(name.clone())
    };
    array.elems.iter().map(name).collect()
}

fn one_of<T: Copy>(value: &Expr, known: &[(&str, T)]) -> syn::Result<T> {
    let literal = text(value)?;
    let found = known.iter().find(|(name, _)| *name == literal.value());
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<String> = known.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        let words: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        let near = meant(&literal.value(), &words);
        let (given, names) = (literal.value(), names.join(", "));
        let message = format!("{given:?} is not allowed here{near}; use one of {names}");
        syn::Error::new(literal.span(), message)
    })
}

/// The hint `` (did you mean `functions`?)`` if one of the known words resembles the given one.
fn meant(word: &str, known: &[&str]) -> String {
    let near = nearest_word(word, known.iter().copied());
    near.map(|near| format!(" (did you mean `{near}`?)")).unwrap_or_default()
}

fn text(value: &Expr) -> syn::Result<&LitStr> {
    match literal(value) {
        Some(Lit::Str(literal)) => Ok(literal),
        _ => Err(syn::Error::new_spanned(value, "expected a string literal")),
    }
}

fn boolean(value: &Expr) -> syn::Result<bool> {
    match literal(value) {
        Some(Lit::Bool(literal)) => Ok(literal.value),
        _ => Err(syn::Error::new_spanned(value, "expected true or false")),
    }
}

fn size(value: &Expr) -> syn::Result<u64> {
    match literal(value) {
        Some(Lit::Int(literal)) => {
            without_type(literal.suffix(), value)?;
            literal.base10_parse()
        }
        _ => Err(syn::Error::new_spanned(value, "expected a whole number")),
    }
}

fn number(value: &Expr) -> syn::Result<f64> {
    let (sign, operand) = match value {
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => (-1.0, unary.expr.as_ref()),
        _ => (1.0, value),
    };
    let (digits, suffix) = match literal(operand) {
        Some(Lit::Float(literal)) => (literal.base10_parse::<f64>().ok(), literal.suffix()),
        Some(Lit::Int(literal)) => (literal.base10_parse::<f64>().ok(), literal.suffix()),
        _ => (None, ""),
    };
    without_type(suffix, value)?;
    digits
        .map(|digits| sign * digits)
        .ok_or_else(|| syn::Error::new_spanned(value, "expected a number"))
}

/// Refuses a type suffix on a number, as in `4u8`, because it would have no effect.
fn without_type(suffix: &str, value: &Expr) -> syn::Result<()> {
    if suffix.is_empty() {
        return Ok(());
    }
    Err(syn::Error::new_spanned(value, format!("write the number without the suffix `{suffix}`")))
}

fn literal(value: &Expr) -> Option<&Lit> {
    match value {
        Expr::Lit(ExprLit { lit, .. }) => Some(lit),
        _ => None,
    }
}
