//! Viewer for motions in a browser: a single HTML file that needs no network access.
//!
//! Bodies are stored as their control points or nodes, with 16 bits for each coordinate. The browser computes the curves from these points.
//! The curves are exact at every drawn point, and need less space than polylines.

mod data;
mod document;
mod packing;
mod thinning;

pub(crate) use data::{
    Arrow, BeamShape, BodyShape, ColourField, ParticleShape, PointCombination, SpringEnd,
    SpringShape, SymbolMark, TimeCurve, Trail, ViewerData,
};
pub use document::Viewer;
