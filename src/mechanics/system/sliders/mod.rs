//! Points that slide along beams: where they are, what they add to the equations of a step, and what their beams are like where
//! they end.

mod all;
mod axial_impact;
mod connection;
mod kinked_axis;
mod master_curve;
mod slider_contact;
mod track_path;

pub use all::Sliders;
pub use axial_impact::{AxialImpact, ImpactBar};
pub use connection::Connection;
pub use kinked_axis::{KinkedAxis, MasterKink};
pub use master_curve::{MasterCurve, MasterEnd, MasterLimit, SliderState};
pub use slider_contact::{AtRest, InStep, Passing, SliderContact};
pub use track_path::{Seam, TrackPath, TrackPathSegment};
