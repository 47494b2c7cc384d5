//! The helper functions at the end of each file in MATLAB.

use crate::backend::common::Scalar;
use crate::backend::flat::polynomials::{Arithmetic, Assignment, Circular, HyperbolicTangent};
use crate::backend::flat::{FlatOptions, Helpers};
use crate::trigonometry::Trigonometry;

struct ByElement;

impl Arithmetic for ByElement {
    fn number(&self, value: f64) -> String {
        format!("{value:?}")
    }

    fn times(&self) -> &'static str {
        ".*"
    }
}

fn assignments(steps: Vec<Assignment>) -> String {
    let lines = steps.into_iter().map(|(name, value)| format!("{name} = {value};\n"));
    lines.collect::<String>().trim_end().to_owned()
}

/// Prints the helpers that a function needs.
pub(super) fn helpers(needed: &Helpers, options: &FlatOptions) -> Vec<String> {
    let mut text = String::new();
    if needed.circular {
        match options.trigonometry {
            Trigonometry::Polynomial => text.push_str(&circular()),
            Trigonometry::Standard => text.push_str(STANDARD),
        }
        text.push_str(EACH);
    }
    let tanh = tanh();
    let optional = [
        (needed.sqrt, SQRT),
        (needed.recip_positive, RECIP_POSITIVE),
        (needed.tanh, tanh.as_str()),
    ];
    text.extend(optional.into_iter().filter(|(needed, _)| *needed).map(|(_, text)| text));
    text.lines().map(str::to_owned).collect()
}

const STANDARD: &str = "function [s, c] = sin_cos_(angle)
s = sin(angle);
c = cos(angle);
end

";

const EACH: &str = "function s = sin_(angle)
[s, ~] = sin_cos_(angle);
end

function c = cos_(angle)
[~, c] = sin_cos_(angle);
end

";

const SQRT: &str = "function root = sqrt_(x)
% The real square root, NaN of numbers below 0.
x(x < 0) = NaN;
root = sqrt(x);
end

";

const RECIP_POSITIVE: &str = "function result = recip_positive_(x)
% 1/x of a number above 0 and finite, NaN of others.
x(~(x > 0 & x < Inf)) = NaN;
result = 1.0 ./ x;
end

";

fn circular() -> String {
    let numbers = Circular::new(Scalar::F64);
    let turns = assignments(numbers.turns(&ByElement));
    let rest = assignments(numbers.rest(&ByElement, false));
    let limit = format!("{:?}", numbers.limit);
    format!(
        "function [sine, cosine] = sin_cos_(angle)
% By Cody and Waite, Software Manual for the Elementary Functions (1980), chapter 8: the angle less k
% right angles, and minimax polynomials.
x = angle;
x(~(abs(angle) < {limit})) = NaN;
{turns}
turns = mod(k, 4);
{rest}
odd = mod(turns, 2) == 1;
sine = s;
sine(odd) = c(odd);
cosine = c;
cosine(odd) = s(odd);
half = turns >= 2;
sine(half) = -sine(half);
half = mod(turns + 1, 4) >= 2;
cosine(half) = -cosine(half);
end

"
    )
}

fn tanh() -> String {
    let numbers = HyperbolicTangent::new(Scalar::F64);
    let (steps, limit) =
        (assignments(numbers.rest(&ByElement)), format!("{:?}", numbers.saturated));
    format!(
        "function result = tanh_(x)
y = 2.0 .* abs(x);
y(y > {limit}) = {limit};
{steps}
power = pow2(n);
t = power .* e + (power - 1.0);
result = t ./ (t + 2.0);
below = x < 0 | (x == 0 & 1.0 ./ x < 0);
result(below) = -result(below);
end

"
    )
}
