//! Tests of the three entry points from outside: a crate with a build script, one with the macro, and one that depends
//! on a generated crate. Each is a separate package that Cargo builds with its default profiles.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

mod book;
mod build_script;
mod bundles;
mod forms;
mod generated_crate;
mod include_macro;
mod kinds;
mod limbs;
mod package;
mod payload;
mod reference;
mod single;
mod singular;
