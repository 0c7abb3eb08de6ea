//! Storage of the sections at the quadrature points of a beam: one section for all points, or one section per point.

mod interpolated;
mod mass_integrals;
mod on_axis;
mod per_point;

use interpolated::Interpolated;
pub(super) use interpolated::Interpolation;
pub(super) use mass_integrals::MassIntegral;
use mass_integrals::SectionIntegral;
pub(super) use on_axis::SectionsOnAxis;
pub(super) use per_point::{PerPoint, Sections, Uniform};
