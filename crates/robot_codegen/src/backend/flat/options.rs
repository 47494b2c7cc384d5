//! The options that printers of flat functions share.

use crate::backend::common::{ConstantItem, Scalar, Setter};
use crate::trigonometry::Trigonometry;

/// The options that printers of flat functions share.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlatOptions {
    /// Lines of the comment at the top of each text.
    pub header: Vec<String>,
    /// The source of sines and cosines.
    pub trigonometry: Trigonometry,
    /// The number type of the functions.
    pub scalar: Scalar,
    /// Further constants of the module.
    pub constants: Vec<ConstantItem>,
    /// Functions that set several parameters together.
    pub setters: Vec<Setter>,
}

impl FlatOptions {
    /// Returns the names that functions of the module must not have: those in `used`, which the printer uses itself,
    /// and those of the constants.
    pub(in crate::backend) fn taken(&self, used: &[&str]) -> Vec<String> {
        let constants = self.constants.iter().map(ConstantItem::printed_name);
        used.iter().map(|name| (*name).to_owned()).chain(constants).collect()
    }
}
