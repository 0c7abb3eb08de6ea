//! Running a scene and remembering what happened.

mod archive;
mod back;
mod columns;
mod error;
mod explain;
mod history;
mod landing;
mod outline;
mod recording;
mod run;
mod snapshots;
mod stepping;
mod time_grid;
mod trajectory;
mod views;

pub use archive::ArchiveError;
pub use columns::{Column, ExtraColumn};
pub use error::SimulationError;
pub use history::{History, Invariant, Sample, Scales};
pub use landing::{Arrival, ArrivalKind};
pub use outline::{Configuration, Outline};
pub use recording::Recording;
pub use run::{Monitor, Settings, Simulation, Unwatched, WorkCounts};
pub use time_grid::TimeGrid;
pub use trajectory::Trajectory;
