//! The parts that printers of all languages share: names, inputs, constants, documentation, and the items that a
//! caller adds to a module.

mod inputs;
mod items;
mod namer;
mod paragraph;
mod scalar;
mod text;

pub use self::inputs::{angle_names, input_entry, symbols, used_inputs};
pub use self::items::{ConstantItem, ConstantValue, Setter, SetterArgument};
pub(in crate::backend) use self::namer::unreserved;
pub use self::namer::{Namer, Reserved, field_names, identifier, type_name};
pub use self::paragraph::{comment_lines, wrapped};
pub use self::scalar::{Scalar, check_range};
pub use self::text::{
    add_results, comment_line, function, markdown, markdown_line, operations, paragraphs,
    parameter, quantity,
};
