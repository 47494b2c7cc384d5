//! The driver from robot file to source code, and the builder for build scripts.
