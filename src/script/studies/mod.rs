//! Studies as scripts ask for them: from options to cases, and from results to tables, files and pictures.

pub mod convergence;
pub mod desk;
pub mod labels;
pub mod plan;
pub mod precision;
pub mod reference;
