//! Functions on arrays of angles, in a form that LLVM vectorizes.

use super::super::scalar::Scalar;

/// Whether the target has vector registers of floating-point numbers.
const VECTORS: bool = cfg!(any(
    target_feature = "sse2",
    target_feature = "neon",
    target_feature = "simd128",
    target_feature = "v",
    target_feature = "altivec",
));

/// Applies `function` to each angle, one after the other.
#[inline(always)]
pub(crate) fn one_by_one<T: Scalar, const N: usize>(
    angles: &[T; N],
    function: impl Fn(T) -> (T, T),
) -> ([T; N], [T; N]) {
    let (mut sines, mut cosines) = ([T::ZERO; N], [T::ZERO; N]);
    for ((angle, sine), cosine) in angles.iter().zip(&mut sines).zip(&mut cosines) {
        (*sine, *cosine) = function(*angle);
    }
    (sines, cosines)
}

/// Applies `function` to each angle, without a loop for the first 16.
#[inline(always)]
pub(crate) fn unrolled<T: Scalar, const N: usize>(
    angles: &[T; N],
    function: impl Fn(T) -> (T, T),
) -> ([T; N], [T; N]) {
    let (mut sines, mut cosines) = ([T::ZERO; N], [T::ZERO; N]);
    macro_rules! at {
        ($($index:literal)*) => {$(
            let element = (angles.get($index), sines.get_mut($index), cosines.get_mut($index));
            if let (Some(angle), Some(sine), Some(cosine)) = element {
                (*sine, *cosine) = function(*angle);
            }
        )*};
    }
    at!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15);
    if N > 16 {
        let results = sines.iter_mut().zip(&mut cosines);
        for (angle, (sine, cosine)) in angles.iter().zip(results).skip(16) {
            (*sine, *cosine) = function(*angle);
        }
    }
    (sines, cosines)
}

/// Applies `function` to each angle, in blocks of `BLOCK` angles if the target has vectors.
///
/// `BLOCK` must be so large that a loop over it is not unrolled before the vectorizer. Up to `BLOCK`
/// angles are filled up with zeros and computed inline. More angles, and angles on a target without
/// vectors, are computed by calls of one function, so that the code neither loops nor repeats
/// itself; the last block ends with the last angle and overlaps the block before it.
#[inline(always)]
pub(crate) fn in_blocks<const BLOCK: usize, T: Scalar, const N: usize>(
    angles: &[T; N],
    function: impl Fn(T) -> (T, T),
) -> ([T; N], [T; N]) {
    if const { N < 2 } {
        return one_by_one(angles, function);
    }
    if const { !VECTORS } {
        return one_by_one(angles, |angle| out_of_line(angle, &function));
    }
    let (mut sines, mut cosines) = ([T::ZERO; N], [T::ZERO; N]);
    if const { N <= BLOCK } {
        let mut padded = [T::ZERO; BLOCK];
        copy(angles, &mut padded);
        let block = one_by_one(&padded, function);
        copy(&block.0, &mut sines);
        copy(&block.1, &mut cosines);
        return (sines, cosines);
    }
    let results = sines.as_chunks_mut::<BLOCK>().0.iter_mut().zip(cosines.as_chunks_mut().0);
    for (angles, (sines, cosines)) in angles.as_chunks().0.iter().zip(results) {
        block_out_of_line(angles, sines, cosines, &function);
    }
    let last = (angles.last_chunk::<BLOCK>(), sines.last_chunk_mut(), cosines.last_chunk_mut());
    if let (true, (Some(angles), Some(sines), Some(cosines))) = (N / BLOCK * BLOCK < N, last) {
        block_out_of_line(angles, sines, cosines, &function);
    }
    (sines, cosines)
}

#[inline(never)]
fn out_of_line<T: Scalar>(angle: T, function: impl Fn(T) -> (T, T)) -> (T, T) {
    function(angle)
}

#[inline(never)]
fn block_out_of_line<T: Scalar, const BLOCK: usize>(
    angles: &[T; BLOCK],
    sines: &mut [T; BLOCK],
    cosines: &mut [T; BLOCK],
    function: impl Fn(T) -> (T, T),
) {
    (*sines, *cosines) = one_by_one(angles, function);
}

/// Copies the elements that both slices have; unlike `copy_from_slice` it cannot panic.
#[inline(always)]
pub(crate) fn copy<T: Copy>(from: &[T], to: &mut [T]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}
