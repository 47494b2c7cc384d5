//! Symbolic algebra: interned expressions, canonical polynomials, text and LaTeX.
