//! Domains of the language, one file each. A new domain needs a new file and a line in [`TABLES`].

mod animations;
mod arrays;
mod bodies;
mod buckling;
mod checking;
mod convergence_studies;
mod cost_studies;
mod derivatives;
mod drag;
mod drives;
mod equilibria;
mod error_estimates;
mod explaining;
mod exports;
mod fits;
pub(crate) mod geometry;
mod help;
mod histories;
mod inputs;
mod integrators;
mod language;
mod loads;
mod math;
mod measurements;
mod modes;
mod notes;
mod obstacles;
pub(crate) mod pictures;
mod precision_studies;
mod reading_options;
mod recording;
mod releases;
mod samples;
mod saving;
mod scenes;
mod schedules;
mod sections;
mod sensors;
mod simulations;
mod sleeves;
mod sliding;
mod spring_laws;
mod springs;
mod stability_studies;
mod statistics;
mod step_sizes;
mod sweep_pictures;
mod sweeps;
mod tables;
mod tapers;
mod text;
mod time_travel;
mod tracks;
mod vectors;
mod viewers;

use crate::script::bindings::table::BindingTable;
pub use language::language;

/// Domains of the language, in the order of the reference.
pub const TABLES: &[&BindingTable] = &[
    &math::TABLE,
    &vectors::TABLE,
    &geometry::knots::TABLE,
    &geometry::curves::TABLE,
    &geometry::quadrature::TABLE,
    &arrays::TABLE,
    &text::TABLE,
    &checking::TABLE,
    &inputs::TABLE,
    &sections::TABLE,
    &tapers::TABLE,
    &schedules::TABLE,
    &integrators::TABLE,
    &step_sizes::TABLE,
    &scenes::TABLE,
    &loads::TABLE,
    &bodies::TABLE,
    &drives::TABLE,
    &springs::TABLE,
    &drag::TABLE,
    &obstacles::TABLE,
    &equilibria::TABLE,
    &modes::TABLE,
    &buckling::TABLE,
    &simulations::TABLE,
    &derivatives::TABLE,
    &notes::TABLE,
    &error_estimates::TABLE,
    &recording::TABLE,
    &sensors::TABLE,
    &time_travel::TABLE,
    &saving::TABLE,
    &sliding::TABLE,
    &sleeves::TABLE,
    &tracks::TABLE,
    &releases::TABLE,
    &histories::TABLE,
    &statistics::TABLE,
    &explaining::TABLE,
    &pictures::curves::TABLE,
    &pictures::TABLE,
    &pictures::along::TABLE,
    &pictures::rest::TABLE,
    &exports::TABLE,
    &viewers::TABLE,
    &animations::TABLE,
    &stability_studies::TABLE,
    &cost_studies::TABLE,
    &precision_studies::TABLE,
    &convergence_studies::TABLE,
    &samples::TABLE,
    &sweeps::TABLE,
    &sweep_pictures::TABLE,
    &fits::TABLE,
    &measurements::TABLE,
    &reading_options::TABLE,
    &help::TABLE,
];

#[cfg(test)]
mod tests;
