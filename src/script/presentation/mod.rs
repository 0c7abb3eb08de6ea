//! Presentation of values: prompt, charts, pictures, and colours.

pub mod along;
pub mod arrays;
pub mod details;
pub mod grids;
pub mod highlight;
pub mod motion;
pub mod plots;
pub mod present;
pub mod quantities;
pub mod symbols;
pub mod viewer_data;
