//! Directions: vectors of any length scaled to length 1.

use robot_symbolic::{Expr, Number, Rational};

use crate::vector::Vector;

/// The unit vector in the direction of a vector; exact for multiples of a coordinate axis. `round` is applied to the
/// norm and to the result.
pub(super) fn unit_vector<'g>(
    vector: Vector<'g>,
    round: impl Fn(Expr<'g>) -> Expr<'g>,
) -> Vector<'g> {
    let vector = shortened(vector);
    let along: Vec<usize> = (0..3).filter(|i| !vector.0[*i].is_zero()).collect();
    match (along.as_slice(), along.first().and_then(|i| vector.0[*i].as_number())) {
        (&[i], Some(number)) => {
            let graph = vector.0[i].graph();
            let mut unit = Vector::zero(graph);
            unit.0[i] = graph.integer(if number.is_negative() { -1 } else { 1 });
            unit
        }
        _ => {
            let norm = round(vector.norm());
            vector.map(|component| round(component / norm))
        }
    }
}

/// Shortens a vector of rational numbers to the shortest vector of integers in its direction, so that its length in the
/// file has no effect. If these integers exceed a machine word, the vector is scaled so that its largest component is
/// ±1, which prevents squares from overflowing. Other vectors are returned unchanged.
fn shortened(vector: Vector<'_>) -> Vector<'_> {
    let numbers = vector.0.map(Expr::as_number);
    let [Some(Number::Rational(x)), Some(Number::Rational(y)), Some(Number::Rational(z))] = numbers
    else {
        return vector;
    };
    let components = [x, y, z];
    let largest = components.iter().map(Rational::abs).max();
    let Some(scale) = largest.and_then(|largest| largest.recip()) else {
        return vector;
    };
    let components = components.map(|component| &component * &scale);
    let components = integers(&components).unwrap_or(components);
    let graph = vector.0[0].graph();
    Vector(components.map(|component| graph.number(component)))
}

/// The components multiplied by the least common multiple of their denominators, for a largest component of ±1; `None`
/// if they exceed a machine word.
fn integers(components: &[Rational; 3]) -> Option<[Rational; 3]> {
    let mut multiple: i64 = 1;
    for component in components {
        let (_, denominator) = component.to_small()?;
        let own = Rational::new(denominator, multiple)?.to_small()?.0;
        multiple = multiple.checked_mul(own)?;
    }
    let multiple = Rational::integer(multiple);
    Some(components.each_ref().map(|component| component * &multiple))
}

#[cfg(test)]
mod tests {
    use robot_symbolic::{Graph, print};

    use super::*;

    fn unit(components: [&str; 3]) -> [String; 3] {
        let graph = Graph::new();
        let vector = Vector(components.map(|text| graph.parse(text).unwrap()));
        unit_vector(vector, |expr| expr).0.map(|component| print::to_text(component).unwrap())
    }

    #[test]
    fn the_length_leaves_no_trace() {
        let expected = unit(["1", "0", "1"]);
        assert_eq!(expected, ["1/sqrt(2)", "0", "1/sqrt(2)"]);
        for length in ["1e155", "1e-160", "1e-300", "5e-324", "1.7e308", "0.3", "7"] {
            assert_eq!(unit([length, "0", length]), expected, "{length}");
        }
        assert_eq!(unit(["5e-324", "0", "0"]), ["1", "0", "0"]);
        assert_eq!(unit(["0", "-1e308", "0"]), ["0", "-1", "0"]);
        assert_eq!(unit(["0.06", "0", "-0.08"]), ["0.6", "0", "-0.8"]);
        assert_eq!(unit(["1/6", "1/4", "-1/3"]), ["2/sqrt(29)", "3/sqrt(29)", "-4/sqrt(29)"]);
    }

    #[test]
    fn squares_of_long_figures_stay_in_range() {
        let graph = Graph::new();
        let digits = "3".repeat(320);
        let vector = [format!("1.{digits}"), digits.clone(), format!("{digits}0")];
        let vector = Vector(vector.map(|text| graph.parse(&text).unwrap()));
        let unit = unit_vector(vector, |expr| expr).0.map(|one| one.evaluate(|_| f64::NAN));
        let expected = [0.0, 0.1 / 1.01_f64.sqrt(), 1.0 / 1.01_f64.sqrt()];
        for (found, expected) in unit.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15, "{unit:?}");
        }
    }
}
