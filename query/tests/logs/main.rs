//! Dynamics and identification over logs, from files to answers.

#![allow(clippy::unwrap_used, clippy::panic)]

mod conversion;
mod damaged;
mod dynamics;
mod identification;
mod support;
mod written;
