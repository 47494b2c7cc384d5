//! Preprocessor lines: macros for `inline`, `restrict` and blocks, and errors for unsuitable compiler options.

use super::helpers::Writer;
use super::{Dialect, Header, cuda};

/// Prints the macros of a dialect. Those of C also work in C++, which has no `restrict`.
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

/// Prints an error for compilers that reorder sums. They would remove the rounding to the nearest integer, and sines
/// would silently be wrong in every digit.
pub(super) fn refusal() -> Vec<String> {
    Writer::lines(
        "#if defined(__FAST_MATH__) || defined(_M_FP_FAST)
#error \"-ffast-math and /fp:fast make sines wrong: compile what includes this header without (-fno-fast-math, /fp:precise)\"
#endif",
    )
}
