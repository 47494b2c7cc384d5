//! The helper functions that printed Python calls.

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
    let lines = steps.into_iter().map(|(name, value)| format!("    {name} = {value}\n"));
    lines.collect::<String>().trim_end().to_owned()
}

/// Prints the imports, and the helpers that a module needs.
pub(super) fn helpers(needed: &Helpers, options: &FlatOptions) -> Vec<String> {
    let mut text = r#"
import math as _math
from dataclasses import dataclass as _dataclass
from dataclasses import replace as _replace

try:
    import numpy as _numpy
except ImportError:
    _numpy = None


def _is_array(value):
    return _numpy is not None and isinstance(value, _numpy.ndarray)


def _check_length(array, name, length):
    if len(array) != length:
        raise ValueError(f"{name} has {len(array)} entries, not {length}")


def _float(value):
    # Other types, such as float32 and int16, would round or overflow within the sums.
    return value.astype(float, copy=False) if _is_array(value) else float(value)


def _floats(array, name, length):
    _check_length(array, name, length)
    return _float(array) if _is_array(array) else [_float(value) for value in array]


def _shaped(values, shape, inputs):
    # The states of the inputs count for values that do not depend on them, too.
    sizes = [value.shape for value in values if _is_array(value)]
    for one in inputs:
        if _is_array(one):
            sizes.append(one.shape[1:])
        else:
            sizes.extend(entry.shape for entry in one if _is_array(entry))
    if sizes:
        size = _numpy.broadcast_shapes(*sizes)
        values = _numpy.stack([_numpy.broadcast_to(value, size) for value in values])
        return values.reshape(shape + size)
    if len(shape) == 2:
        return [values[row * shape[1] : (row + 1) * shape[1]] for row in range(shape[0])]
    return values if shape else values[0]
"#
    .to_owned();
    if needed.circular {
        text.push_str(&match options.trigonometry {
            Trigonometry::Polynomial => circular(),
            Trigonometry::Standard => STANDARD.to_owned(),
        });
    }
    let tanh = tanh();
    let optional = [
        (needed.mul_add, MUL_ADD),
        (needed.sqrt, SQRT),
        (needed.sign, SIGN),
        (needed.recip_positive, RECIP_POSITIVE),
        (needed.division, DIVIDE),
        (needed.tanh, tanh.as_str()),
    ];
    text.extend(optional.into_iter().filter(|(needed, _)| *needed).map(|(_, text)| text));
    text.lines().map(str::to_owned).collect()
}

const STANDARD: &str = "

def _sin_cos(angle):
    if _is_array(angle):
        return _numpy.sin(angle), _numpy.cos(angle)
    if not abs(angle) < _math.inf:
        return _math.nan, _math.nan
    return _math.sin(angle), _math.cos(angle)
";

const MUL_ADD: &str = "

def _mul_add(a, b, c):
    return a * b + c
";

const SQRT: &str = "

def _sqrt(x):
    if _is_array(x):
        with _numpy.errstate(invalid=\"ignore\"):
            return _numpy.sqrt(x)
    return _math.sqrt(x) if x >= 0.0 else _math.nan
";

const SIGN: &str = "

def _sign(x):
    if _is_array(x):
        return _numpy.sign(x) + 0.0
    return x if x != x else float(int(x > 0.0) - int(x < 0.0))
";

/// Parameters in place of a model would be read as a model without some of its numbers.
pub(super) const MODEL: &str = "

def _check_model(model):
    if not isinstance(model, Model):
        raise TypeError(\"the first argument is not a model; Model(parameters) makes one\")
";

const DIVIDE: &str = "

def _divide(a, b):
    # Division by 0 gives infinity or NaN, as in other languages, also for numbers.
    if _is_array(a) or _is_array(b):
        with _numpy.errstate(divide=\"ignore\", invalid=\"ignore\"):
            return a / b
    return a / b if b != 0.0 else a * _math.copysign(_math.inf, b)
";

const RECIP_POSITIVE: &str = "

def _recip_positive(x):
    # 1/x of a number above 0 and finite, NaN of others.
    if _is_array(x):
        good = (x > 0.0) & (x < _math.inf)
        return _numpy.where(good, 1.0 / _numpy.where(good, x, 1.0), _math.nan)
    return 1.0 / x if 0.0 < x < _math.inf else _math.nan
";

fn circular() -> String {
    let numbers = Circular::new(Scalar::F64);
    let (turns, rest) =
        (assignments(numbers.turns(&Plain)), assignments(numbers.rest(&Plain, false)));
    let limit = format!("{:?}", numbers.limit);
    format!(
        "

def _sin_cos(angle):
    # By Cody and Waite, Software Manual for the Elementary Functions (1980), chapter 8: the angle less k
    # right angles, and minimax polynomials.
    if not _is_array(angle):
        angle = float(angle)
        return _turned(angle, angle if abs(angle) < {limit} else _math.nan)
    return _turned_arrays(angle, _numpy.where(abs(angle) < {limit}, angle, _math.nan))


def _reduced(angle, x):
{turns}
    turns = k
{rest}
    return turns, s, c


def _turned(angle, x):
    if x != x:
        return x, x
    k, s, c = _reduced(angle, x)
    turns = int(k) & 3
    if turns & 1:
        s, c = c, s
    return -s if turns & 2 else s, -c if (turns + 1) & 2 else c


def _turned_arrays(angle, x):
    with _numpy.errstate(invalid=\"ignore\", over=\"ignore\"):
        k, s, c = _reduced(angle, x)
    turns = _numpy.where(x == x, k, 0.0).astype(_numpy.int64) & 3
    odd = (turns & 1) == 1
    s, c = _numpy.where(odd, c, s), _numpy.where(odd, s, c)
    return _numpy.where(turns & 2, -s, s), _numpy.where((turns + 1) & 2, -c, c)
"
    )
}

fn tanh() -> String {
    let numbers = HyperbolicTangent::new(Scalar::F64);
    let (steps, limit) = (assignments(numbers.rest(&Plain)), format!("{:?}", numbers.saturated));
    format!(
        "

def _tanh(x):
    if _is_array(x):
        y = 2.0 * abs(x)
        n, e = _expm1(_numpy.where(y > {limit}, {limit}, y))
        power = _numpy.ldexp(1.0, _numpy.where(x == x, n, 0.0).astype(_numpy.int64))
        t = power * e + (power - 1.0)
        return _numpy.copysign(t / (t + 2.0), x)
    if x != x:
        return x
    n, e = _expm1(min(2.0 * abs(x), {limit}))
    power = _math.ldexp(1.0, int(n))
    t = power * e + (power - 1.0)
    return _math.copysign(t / (t + 2.0), x)


def _expm1(y):
{steps}
    return n, e
"
    )
}
