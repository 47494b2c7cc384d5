//! What the preprocessor defines: macros for `inline`, `restrict` and blocks, and what it refuses.

use super::helpers::Writer;
use super::{Dialect, Header, cuda};

/// The macros of a dialect: C's work in C++ too, which has no `restrict`.
pub(super) fn macros(header: &Header<'_>) -> Vec<String> {
    let name = |name: &str| header.names.private_upper(name);
    let [inline, part, restrict] = ["inline", "part", "restrict"].map(name);
    let text = match header.dialect {
        Dialect::C => format!(
            "#if defined(__GNUC__)
#define {inline} static inline __attribute__((always_inline, unused))
#define {part} static __attribute__((noinline, unused))
#define {restrict} __restrict__
#else
#define {inline} static inline
#define {part} static
#define {restrict}
#endif
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif
"
        ),
        Dialect::Cuda => cuda::macros([&inline, &part, &restrict], &name("kernel")),
    };
    Writer::lines(&text)
}

/// A compiler that reorders sums would remove the rounding to the nearest integer: sines would be wrong in every digit,
/// without a message.
pub(super) fn refusal() -> Vec<String> {
    Writer::lines(
        "#if defined(__FAST_MATH__) || defined(_M_FP_FAST)
#error \"-ffast-math and /fp:fast make sines wrong: compile what includes this header without (-fno-fast-math, /fp:precise)\"
#endif",
    )
}
