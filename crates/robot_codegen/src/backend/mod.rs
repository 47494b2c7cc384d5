//! Printers of compiled modules.

pub mod rust;
