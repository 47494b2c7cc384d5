//! Dynamics and identification over logs, from files to answers.

mod conversion;
mod damaged;
mod dynamics;
mod identification;
mod support;
mod written;
