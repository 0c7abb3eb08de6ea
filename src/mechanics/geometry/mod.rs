//! Knot vectors, bases, planar curves and quadrature. This module uses no other module.

mod arc;
mod arc_length;
mod basis;
mod bspline;
mod collocation;
mod contact_path;
mod curve;
mod error;
mod extremes;
mod fit;
mod knots;
mod lagrange;
mod line;
mod local_cubic;
mod nearest;
mod piecewise;
mod planar;
mod positive_band;
mod quadrature;
mod reproduction;
#[cfg(test)]
mod samples;
mod spline_curve;
mod spline_rule;
mod values;

pub use arc::CircularArc;
pub use basis::Basis;
pub use contact_path::ContactPath;
pub use curve::{Curve, ROUNDING_OF_PLACES, is_on_length};
pub use error::GeometryError;
pub use extremes::{larger, smaller};
pub(crate) use fit::corresponding;
pub use fit::interpolate;
pub use knots::{KnotVector, MAX_DEGREE, MAX_SPANS, Span};
pub use lagrange::LagrangeBasis;
pub use line::Line;
pub use nearest::nearest;
pub use piecewise::{FunctionOnPath, PiecewisePolynomial};
pub use planar::{Vec2, cross, perpendicular, unit};
pub(crate) use positive_band::{PositiveBand, PositiveFactors};
pub use quadrature::GaussRule;
pub(crate) use reproduction::{LowerSplines, Reproduction};
pub use spline_curve::SplineCurve;
pub(crate) use spline_rule::{RunRule, lower_splines, patch_rule};
pub use values::BasisValues;
