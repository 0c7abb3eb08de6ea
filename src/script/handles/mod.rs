//! Handles of scenes and their parts, equilibria, simulations and histories for scripts. Clones of a handle refer to the same object.

pub mod beam;
pub mod captured_variables;
pub mod equilibrium;
pub mod events;
pub mod function_of_time;
pub mod history;
pub mod joint;
pub mod notes;
pub mod report;
pub mod rigid_body;
pub mod scene;
pub mod section;
pub mod simulation;
pub mod station;
pub mod step_size;
pub mod track;
