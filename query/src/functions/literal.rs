//! The argument that names the robot, which is a literal text.

use std::sync::Arc;

use datafusion::common::ScalarValue;

use crate::error::Error;
use crate::robots::{Model, Robots};

/// The text of a value; `None` if the value is not a text.
pub(crate) fn text_of(value: &ScalarValue) -> Option<&str> {
    match value {
        ScalarValue::Utf8(text) | ScalarValue::LargeUtf8(text) | ScalarValue::Utf8View(text) => {
            text.as_deref()
        }
        _ => None,
    }
}

/// The robot that the first argument names.
///
/// # Errors
///
/// A first argument that is not a literal text; a robot that cannot be read.
pub(crate) fn robot_of(
    function: &str,
    argument: Option<&ScalarValue>,
    robots: &Robots,
) -> Result<Arc<Model>, Error> {
    let text = argument.and_then(text_of).ok_or_else(|| {
        Error::Query(format!(
            "the first argument of {function} is the robot: a literal text with its name, its path or the text of \
             its file, as in {function}('ur5', …)"
        ))
    })?;
    robots.model(text)
}
