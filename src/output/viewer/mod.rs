//! Motions to look at in a browser: one HTML file with everything in it, which asks the network for nothing.
//!
//! ```text
//! film → thinning, packing → document → HTML with page/template.html, page/style.css and the programs of page/
//! ```
//!
//! The bodies are sent as their points, control points or nodes, in 16 bits, and drawn from them in the browser: a curve is exact at every
//! place at which it is drawn, and takes less room than its polyline.

mod document;
mod film;
mod packing;
mod thinning;

pub use document::Viewer;
pub use film::{
    Anchor, Arrow, Beam, Body, Column, Field, Film, Particle, Place, Sign, Spring, Trail,
};
