//! Which section each quadrature point of a beam has: that of the beam, or one of its own.

mod between_points;
mod inertia;
mod of_points;
mod on_axis;

pub(super) use between_points::Blend;
use between_points::Blended;
pub(super) use inertia::Entry;
use inertia::Weighed;
pub(super) use of_points::{Own, Same, Sections};
pub(super) use on_axis::ProfileOnAxis;
