//! Motions to look at in a browser: one HTML file with everything in it, which asks the network for nothing.
//!
//! ```text
//! film → thinning, packing → document → HTML with page/template.html, page/style.css and the programs of page/
//! ```
//!
//! The bodies are sent as their points, control points or nodes, in 16 bits, and drawn from them in the browser: a curve is exact at every
//! place at which it is drawn, and takes less room than its polyline.

mod data;
mod document;
mod packing;
mod thinning;

pub use data::{
    Arrow, BeamShape, BodyShape, ColourField, ParticleShape, PointCombination, SpringEnd,
    SpringShape, SymbolMark, TimeCurve, Trail, ViewerData,
};
pub use document::Viewer;
