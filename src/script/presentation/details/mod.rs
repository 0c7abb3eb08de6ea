//! Summaries of values for display, as labels and values.

mod entries;
mod geometry;
mod methods;
mod scenes;
mod simulations;

pub use geometry::{of_curve, of_knots, of_mesh, of_vector};
pub use methods::{of_failure, of_integrator, of_rule, of_schedule, of_step_control};
pub use scenes::{
    guide_of, of_beam, of_rigid_body, of_scene, of_section, of_slider, of_station, of_track,
};
pub use simulations::{of_history, of_simulation};
