//! Beam theory: planar Simo–Reissner beams on any basis, with a stress-free initial configuration.
//!
//! References: J. C. Simo & L. Vu-Quoc, ASME J. Appl. Mech. 53 (1986) 849–863; E. Reissner, ZAMP 23 (1972) 795–804.

mod axis_point;
mod block;
mod dashpots;
mod discrete;
mod dynamics;
mod error;
mod force_dashpot;
mod force_maxima;
mod force_point;
mod force_points;
mod inertia;
mod kink;
mod mesh;
mod moment_dashpot;
mod moment_point;
mod moment_points;
mod pair;
mod present_rates;
mod rigid_points;
mod rotation;
mod section;
mod section_forces;
mod section_variation;
mod sections;
mod simd;
mod span_loops;
mod span_partition;
mod span_points;
mod span_stiffness;
mod station;
mod taper_quadrature;

pub use dashpots::{Dashpots, RateCollocation, Relaxation};
pub(crate) use discrete::discretise;
pub use dynamics::{BlockSink, BodyDynamics, Collocation, ForceSummary, Movement};
pub use error::BeamError;
pub use kink::{MissedKink, StraightBeam, arc_lengths, unresolved_kink};
pub use mesh::{Mesh, PointCounts, Quadrature};
pub use rigid_points::RigidPoints;
pub use rotation::{Rotation, RotationIncrement};
pub use section::{Section, SectionShape, Solid};
pub use section_forces::{SectionForces, SectionPlace, SectionPoints};
pub use section_variation::SectionVariation;
pub use span_stiffness::{SpanStiffness, StrainKind};
pub use station::{BodyIndex, BodyPoint, Station};
pub use taper_quadrature::TaperQuadrature;
