//! The domains of the language, one file each. A new domain is a new file and a line in [`TABLES`].

mod along_pictures;
mod animations;
mod arrays;
mod chart_options;
mod checking;
mod convergence_studies;
mod cost_studies;
mod curve_pictures;
mod drag;
mod drives;
mod equilibria;
mod explaining;
mod exports;
pub mod geometry;
mod help;
mod histories;
mod integrators;
mod language;
mod loads;
mod math;
mod modes;
pub mod motion_pictures;
mod notes;
mod pictures;
mod precision_studies;
mod reading_options;
mod recording;
mod rest_pictures;
mod saving;
mod scenes;
mod schedules;
mod sections;
mod sensors;
mod simulations;
mod sliding;
mod springs;
mod stability_studies;
mod statistics;
mod step_sizes;
mod tables;
mod text;
mod time_travel;
mod vectors;
mod viewers;

use crate::script::rows::table::Table;
pub use language::language;

/// The domains of the language, in the order of the reference.
pub const TABLES: &[&Table] = &[
    &math::TABLE,
    &vectors::TABLE,
    &geometry::knots::TABLE,
    &geometry::curves::TABLE,
    &geometry::quadrature::TABLE,
    &arrays::TABLE,
    &text::TABLE,
    &checking::TABLE,
    &sections::TABLE,
    &schedules::TABLE,
    &integrators::TABLE,
    &step_sizes::TABLE,
    &scenes::TABLE,
    &loads::TABLE,
    &drives::TABLE,
    &springs::TABLE,
    &drag::TABLE,
    &equilibria::TABLE,
    &modes::TABLE,
    &simulations::TABLE,
    &notes::TABLE,
    &recording::TABLE,
    &sensors::TABLE,
    &time_travel::TABLE,
    &saving::TABLE,
    &sliding::TABLE,
    &histories::TABLE,
    &statistics::TABLE,
    &explaining::TABLE,
    &curve_pictures::TABLE,
    &pictures::TABLE,
    &along_pictures::TABLE,
    &rest_pictures::TABLE,
    &exports::TABLE,
    &viewers::TABLE,
    &animations::TABLE,
    &stability_studies::TABLE,
    &cost_studies::TABLE,
    &precision_studies::TABLE,
    &convergence_studies::TABLE,
    &reading_options::TABLE,
    &help::TABLE,
];

#[cfg(test)]
mod tests;
