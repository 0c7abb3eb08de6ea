//! Knot vectors, bases, planar curves and quadrature. No mechanics, and nothing else of ours.

mod basis;
mod bspline;
mod error;
mod knots;
mod lagrange;
mod planar;
mod quadrature;
#[cfg(test)]
mod samples;
mod values;

pub use basis::Basis;
pub use error::GeometryError;
pub use knots::{KnotVector, MAX_DEGREE, MAX_SPANS, Span};
pub use lagrange::LagrangeBasis;
pub use planar::{Vec2, cross, perpendicular, unit};
pub use quadrature::GaussRule;
pub use values::BasisValues;
