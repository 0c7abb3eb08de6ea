//! Charts and pictures as text for a terminal: braille dots or plain ASCII, with or without colours.
//!
//! ```text
//! chart, picture → dots → sheet → style
//! heat_map → sheet
//! ```

mod character_grid;
mod chart;
mod dots;
mod environment;
mod heat_map;
mod picture;
mod style;

pub use picture::{ConfigurationPicture, PictureMark};
pub use style::{Colours, Glyphs, TerminalStyle};
