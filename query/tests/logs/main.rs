//! Tests dynamics and identification over logs, from files to results.

#![allow(clippy::unwrap_used, clippy::panic)]

mod cluster;
mod commands;
mod conversion;
mod damaged;
mod derivatives;
mod dynamics;
mod friction;
mod identification;
mod pictures;
mod priors;
mod resumed;
mod support;
mod units;
mod written;
