//! Viewer for motions in a browser: a single HTML file that needs no network access.
//!
//! Bodies are stored as control points or nodes, from which the browser computes the exact curves. This needs less space than polylines.

mod data;
mod document;
mod packing;
mod thinning;

pub(crate) use data::{
    Arrow, BeamShape, BodyShape, ColourField, ParticleShape, PointCombination, SpringEnd,
    SpringShape, SymbolMark, TimeCurve, Trail, ViewerData,
};
pub use document::Viewer;
