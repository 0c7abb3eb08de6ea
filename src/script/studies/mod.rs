//! Studies as scripts ask for them: from options to cases, and from results to tables, files and pictures.

pub mod cost;
pub mod desk;
pub mod parameters;
pub mod stability;
