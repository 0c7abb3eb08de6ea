//! Which section each quadrature point of a beam has: that of the beam, or one of its own.

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
