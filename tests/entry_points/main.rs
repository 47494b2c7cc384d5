//! The three ways in, from outside: a crate with a build script, one with the macro, one that
//! depends on a generated crate. Each is a package of its own, built by Cargo with its default
//! profiles.

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
