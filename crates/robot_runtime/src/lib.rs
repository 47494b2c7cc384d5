#![no_std]
//! What generated robot code calls at run time.
