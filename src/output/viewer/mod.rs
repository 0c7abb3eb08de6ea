//! Viewer for motions in a browser. It is a single HTML file that needs no network access.
//!
//! ```text
//! data → thinning, packing → document → HTML with page/template.html, page/style.css and the programs of page/
//! ```
//!
//! Bodies are stored as their control points or nodes, with 16 bits for each coordinate. The browser computes the curves from them.
//! The curves are exact at every point that is drawn, and need less space than polylines.

mod data;
mod document;
mod packing;
mod thinning;

pub(crate) use data::{
    Arrow, BeamShape, BodyShape, ColourField, ParticleShape, PointCombination, SpringEnd,
    SpringShape, SymbolMark, TimeCurve, Trail, ViewerData,
};
pub use document::Viewer;
