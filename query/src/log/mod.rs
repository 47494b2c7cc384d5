//! Logs: tables in files that are checked before they are read.

mod check;
mod files;
mod place;
mod progress;
mod resume;
mod session;
mod stores;
mod torques;
mod variables;
mod write;

pub use check::{Finding, check};
pub use files::Log;
pub(crate) use files::reader;
pub(crate) use place::{Place, empty_folder};
pub use place::{check_vacant, write_new};
pub use progress::Progress;
pub use resume::{FileQuery, Resumed, resume};
pub(crate) use session::runtime;
pub use session::{Session, Settings};
pub(crate) use torques::unit;
pub use variables::Names;
pub(crate) use write::properties;
pub use write::{Answer, check_row_count, write};
