//! How values look: at the prompt, in charts and pictures, in colours.

pub mod along;
pub mod details;
pub mod film;
pub mod highlight;
pub mod motion;
pub mod present;
pub mod quantities;
pub mod sight;
pub mod symbols;
