//! Sliders: their positions, contact equations, and masters. The equations of a contact are in `joints::sliding`.

mod all;
mod axial_impact;
mod connection;
mod kinked_axis;
mod master_curve;
mod missed_compliance;
mod sleeve;
mod slider_contact;
mod track_path;

pub use all::Sliders;
pub use axial_impact::{AxialImpact, ImpactBar};
pub use connection::Connection;
pub use kinked_axis::{KinkedAxis, MasterKink};
pub use master_curve::{
    END_TOLERANCE, MasterCurve, MasterEnd, MasterLimit, SliderEvent, SliderState,
};
pub use sleeve::{Sleeve, SleevedMaster};
pub use slider_contact::{AtRest, ContactChange, InStep, Passing, SliderContact};
pub use track_path::{Seam, TrackPath, TrackPathSegment};
