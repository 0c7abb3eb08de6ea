//! Knot vectors, bases, planar curves and quadrature. No mechanics, and nothing else of ours.

mod planar;

pub use planar::{Vec2, cross, perpendicular, unit};
