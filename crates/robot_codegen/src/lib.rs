//! Straight-line programs from expressions, and the source code they become.
