//! State shared by the calls of a run: settings, limits, files, journals, and the context that contains them.

pub mod context;
pub(crate) mod files;
pub mod files_read;
pub mod inputs;
pub(crate) mod journals;
pub mod limits;
pub(crate) mod parts;
pub mod settings;
pub(crate) mod watchdog;
