//! Points that slide along beams: where they are, what they add to the equations of a step, and what their beams are like where
//! they end.

mod all;
mod blow;
mod connection;
mod kinked_axis;
mod rail;
mod route;
mod sliding;

pub use all::Sliders;
pub use blow::{Bar, Blow};
pub use connection::Connection;
pub use kinked_axis::{KinkedAxis, MasterKink};
pub use rail::{MasterEnd, MasterLimit, Rail, SliderState};
pub use route::{Route, RouteLeg, Seam};
pub use sliding::{AtRest, InStep, Passing, Sliding};
