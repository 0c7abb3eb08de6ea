//! Points that slide along beams: where they are, what they add to the equations of a step, and what their beams are like where
//! they end.

mod all;
mod blow;
mod connection;
mod kinked_axis;
mod route;
mod sliding;
mod track;

pub use all::Sliders;
pub use blow::{Bar, Blow};
pub use connection::Connection;
pub use kinked_axis::{KinkedAxis, MasterKink, TooFast};
pub use route::{Route, RouteLeg, Seam};
pub use sliding::{AtRest, InStep, Passing, Sliding};
pub use track::{Rail, SliderState, TrackEnd, TrackLimit};
