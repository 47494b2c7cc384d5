//! The helper functions that printed JavaScript calls.

use crate::backend::common::Scalar;
use crate::backend::flat::polynomials::{Arithmetic, Assignment, Circular, HyperbolicTangent};
use crate::backend::flat::{FlatOptions, Helpers};
use crate::trigonometry::Trigonometry;

struct Plain;

impl Arithmetic for Plain {
    fn number(&self, value: f64) -> String {
        format!("{value:?}")
    }
}

fn assignments(steps: Vec<Assignment>) -> String {
    let lines = steps.into_iter().map(|(name, value)| format!("    {name} = {value};\n"));
    lines.collect::<String>().trim_end().to_owned()
}

/// Prints the helpers that a module needs.
pub(super) fn helpers(needed: &Helpers, options: &FlatOptions) -> Vec<String> {
    let mut text = LENGTHS.to_owned();
    if needed.circular {
        text.push_str(
            "// Sine and cosine of the last angle.\nconst _sc = new Float64Array(2);\n\n",
        );
        match options.trigonometry {
            Trigonometry::Polynomial => text.push_str(&circular()),
            Trigonometry::Standard => text.push_str(STANDARD),
        }
        text.push_str(EACH);
    }
    let tanh = tanh();
    let optional = [
        (needed.mul_add, MUL_ADD),
        (needed.sign, SIGN),
        (needed.recip_positive, RECIP_POSITIVE),
        (needed.tanh, tanh.as_str()),
    ];
    text.extend(optional.into_iter().filter(|(needed, _)| *needed).map(|(_, text)| text));
    text.lines().map(str::to_owned).collect()
}

/// Prints the check that a model is one, by a field that parameters do not have.
pub(super) fn model(field: &str) -> Vec<String> {
    let text = format!(
        "// The parameters of a robot in place of its model would be read as a model without some of its numbers.
function _check_model(model) {{
    if (typeof model !== \"object\" || model === null || typeof model.{field} !== \"number\") {{
        throw new TypeError(\"the first argument is not a model; create_model(parameters) makes one\");
    }}
}}
"
    );
    text.split('\n').map(str::to_owned).collect()
}

/// A missing parameter would be read as `undefined`, and a misspelled one would have no effect.
pub(in crate::backend) const PARAMETERS: &str = "function _check_parameters(parameters, names) {
    if (typeof parameters !== \"object\" || parameters === null) {
        throw new TypeError(\"create_model takes the parameters: nominal(), or a copy with other values\");
    }
    for (const name of names) {
        if (typeof parameters[name] !== \"number\") {
            const what = parameters[name] === undefined ? \"given\" : \"a number\";
            throw new TypeError(`the parameter ${name} is not ${what}`);
        }
    }
    for (const name of Object.keys(parameters)) {
        if (!names.includes(name)) {
            throw new TypeError(`there is no parameter ${name}`);
        }
    }
}

";

/// Entries that are missing would be read as `undefined`, and those that do not fit into an output would be lost.
pub(in crate::backend) const LENGTHS: &str = "function _check_length(array, name, length) {
    if (array.length !== length) {
        throw new RangeError(`${name} has ${array.length} entries, not ${length}`);
    }
}

";

const STANDARD: &str = "function _sin_cos(angle) {
    _sc[0] = Math.sin(angle);
    _sc[1] = Math.cos(angle);
}

";

const EACH: &str = "function _sin(angle) {
    _sin_cos(angle);
    return _sc[0];
}

function _cos(angle) {
    _sin_cos(angle);
    return _sc[1];
}

";

const MUL_ADD: &str = "function _mul_add(a, b, c) {
    return a * b + c;
}

";

const SIGN: &str = "function _sign(x) {
    return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x === 0.0 ? 0.0 : x;
}

";

const RECIP_POSITIVE: &str = "// 1/x of a number above 0 and finite, NaN of others.
function _recip_positive(x) {
    return x > 0.0 && x < Infinity ? 1.0 / x : NaN;
}

";

fn circular() -> String {
    let numbers = Circular::new(Scalar::F64);
    let (turns, rest) =
        (assignments(numbers.turns(&Plain)), assignments(numbers.rest(&Plain, false)));
    let limit = format!("{:?}", numbers.limit);
    format!(
        "// By Cody and Waite, Software Manual for the Elementary Functions (1980), chapter 8: the angle less k
// right angles, and minimax polynomials.
function _sin_cos(angle) {{
    let shifted, k, r, z, s, c;
    const x = Math.abs(angle) < {limit} ? angle : NaN;
{turns}
    const turns = k | 0;
{rest}
    const [sine, cosine] = turns & 1 ? [c, s] : [s, c];
    _sc[0] = turns & 2 ? -sine : sine;
    _sc[1] = (turns + 1) & 2 ? -cosine : cosine;
}}

"
    )
}

fn tanh() -> String {
    let numbers = HyperbolicTangent::new(Scalar::F64);
    let (steps, limit) = (assignments(numbers.rest(&Plain)), format!("{:?}", numbers.saturated));
    format!(
        "function _tanh(x) {{
    let shifted, n, r, e;
    const twice = 2.0 * Math.abs(x);
    const y = twice > {limit} ? {limit} : twice;
{steps}
    const power = 2.0 ** n;
    const t = power * e + (power - 1.0);
    const result = t / (t + 2.0);
    return x < 0.0 || Object.is(x, -0.0) ? -result : result;
}}

"
    )
}
