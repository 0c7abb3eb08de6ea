//! Running a scene and remembering what happened.

mod adaptive;
mod archive;
mod back;
mod columns;
mod controller;
mod cores;
mod doubling;
mod error;
mod explain;
mod first_step;
mod history;
mod landing;
mod notes;
mod outline;
mod recording;
mod revisit;
mod run;
mod snapshots;
mod step_size;
mod stepping;
mod time_grid;
mod trajectory;
mod views;

pub use archive::ArchiveError;
pub use columns::{Column, ExtraColumn};
pub use cores::cores;
pub use error::SimulationError;
pub use history::{History, Invariant, Sample, Scales};
pub use landing::{Arrival, ArrivalKind};
pub use notes::Note;
pub use outline::{Configuration, Outline};
pub use recording::Recording;
pub use run::{Monitor, Settings, Simulation, Unwatched, WorkCounts};
pub use step_size::{StepControl, StepSize, StepSizeError};
pub use time_grid::TimeGrid;
pub use trajectory::Trajectory;
