//! State shared by the calls of a run: settings, limits, files, journals, and the context that holds them.

pub mod context;
pub mod files;
pub mod journals;
pub mod limits;
pub mod parts;
pub mod settings;
pub mod watchdog;
