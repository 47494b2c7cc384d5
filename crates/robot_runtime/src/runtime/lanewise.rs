//! Operations that act lane by lane, on lanes in an array or in registers.

use super::scalar::Scalar;

/// An operation on `A` numbers with `R` results, which is the same for each lane.
pub trait Lanewise<const A: usize, const R: usize> {
    /// The operation.
    fn of<V: Scalar>(arguments: [V; A]) -> [V; R];
}

macro_rules! operations {
    ($($name:ident: |$($argument:ident),+| [$($result:expr),+];)*) => {$(
        pub(super) struct $name;

        impl Lanewise<{ [$(stringify!($argument)),+].len() }, 1> for $name {
            #[inline(always)]
            fn of<V: Scalar>([$($argument),+]: [V; [$(stringify!($argument)),+].len()]) -> [V; 1] {
                [$($result),+]
            }
        }
    )*};
}

operations! {
    Sum: |a, b| [a + b];
    Difference: |a, b| [a - b];
    Product: |a, b| [a * b];
    Quotient: |a, b| [a / b];
    Negative: |a| [-a];
    MultiplyAdd: |a, b, c| [V::mul_add(a, b, c)];
    SquareRoot: |a| [V::sqrt(a)];
    Magnitude: |a| [V::abs(a)];
    Sign: |a| [V::signum0(a)];
    ReciprocalOfPositive: |a| [V::recip_positive(a)];
}

/// Sine and cosine.
pub(super) struct SineCosine;

impl Lanewise<1, 2> for SineCosine {
    #[inline(always)]
    fn of<V: Scalar>([angle]: [V; 1]) -> [V; 2] {
        let (sine, cosine) = V::sin_cos(angle);
        [sine, cosine]
    }
}

/// Applies the operation to each lane separately.
#[inline(always)]
pub(super) fn one_by_one<T, O, const A: usize, const R: usize, const N: usize>(
    arguments: [&[T; N]; A],
) -> [[T; N]; R]
where
    T: Scalar,
    O: Lanewise<A, R>,
{
    let mut results = [[T::ZERO; N]; R];
    for lane in 0..N {
        let numbers = arguments.map(|array| array.get(lane).copied().unwrap_or(T::ZERO));
        for (array, number) in results.iter_mut().zip(O::of(numbers)) {
            if let Some(to) = array.get_mut(lane) {
                *to = number;
            }
        }
    }
    results
}
