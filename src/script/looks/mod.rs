//! How values look: at the prompt, in charts and pictures, in colours.

pub mod details;
pub mod film;
pub mod highlight;
pub mod present;
pub mod sight;
