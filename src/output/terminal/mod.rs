//! Charts and pictures as text for a terminal, drawn with Braille dots or ASCII characters, with or without colours.

mod character_grid;
mod chart;
mod dots;
mod environment;
mod heat_map;
mod picture;
mod style;

pub use picture::{ConfigurationPicture, PictureMark};
pub use style::{Colours, Glyphs, TerminalStyle};
