//! Presentation of values as text at the prompt, in charts, and in coloured pictures.

pub(crate) mod along;
pub(crate) mod arrays;
pub(crate) mod details;
pub(crate) mod grids;
pub mod highlight;
mod magnifier;
pub(crate) mod motion;
pub(crate) mod plots;
pub mod present;
pub(crate) mod quantities;
pub(crate) mod symbols;
mod travel;
pub mod viewer_data;
