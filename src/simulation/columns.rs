//! The columns of a history: those that every history has, and those that a scene adds.

use super::Sample;
use crate::joints::Slider;
use crate::model::{Model, Scene};

/// A column that the history of every run has.
#[derive(Debug, Clone, Copy)]
pub struct Column {
    /// The name of the column.
    pub name: &'static str,
    /// The dimension of the column's values, in words.
    pub dimension: &'static str,
    /// The value of the column in a row of the history.
    pub value: fn(&Sample) -> f64,
}

/// A column that a history has because of its scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExtraColumn {
    /// The name of the column: a thing of the scene and a quantity of it, such as `slider1.force`.
    pub name: String,
    /// The dimension of the column's values, in words.
    pub dimension: &'static str,
}

/// The columns that every history has, in their order.
pub(super) const FIXED: &[Column] = &[
    fixed("t", "time", |row| row.measures.time),
    fixed("kinetic", "energy", |row| row.measures.energy.kinetic),
    fixed("strain", "energy", |row| row.measures.energy.strain),
    fixed("potential", "energy", |row| row.measures.energy.potential),
    fixed("energy", "energy", |row| row.measures.energy.total()),
    fixed("work", "energy", |row| row.measures.work),
    fixed("momentum_x", "mass·length/time", |row| row.measures.momentum.x),
    fixed("momentum_y", "mass·length/time", |row| row.measures.momentum.y),
    fixed("impulse_x", "mass·length/time", |row| row.measures.impulse.x),
    fixed("impulse_y", "mass·length/time", |row| row.measures.impulse.y),
    fixed("angular_momentum", "mass·length²/time", |row| row.measures.angular_momentum),
    fixed("angular_impulse", "mass·length²/time", |row| row.measures.angular_impulse),
    fixed("gap", "length", |row| row.measures.gap),
    fixed("dt", "time", |row| row.dt),
    fixed("newton_iterations", "-", |row| row.newton_iterations as f64),
    fixed("retries", "-", |row| row.retries as f64),
];

const fn fixed(name: &'static str, dimension: &'static str, value: fn(&Sample) -> f64) -> Column {
    Column { name, dimension, value }
}

/// The columns that each slider of a scene adds: what is measured, and its dimension.
const OF_SLIDER: [(&str, &str); 5] = [
    ("position", "-"),
    ("speed", "length/time"),
    ("force", "force"),
    ("force_x", "force"),
    ("force_y", "force"),
];

/// The columns that a scene adds to those that every history has.
pub(super) fn extra_columns(scene: &Scene) -> Vec<ExtraColumn> {
    let of_slider = |slider: &Slider| {
        let name = slider.name.clone();
        OF_SLIDER.map(move |(quantity, dimension)| ExtraColumn {
            name: format!("{name}.{quantity}"),
            dimension,
        })
    };
    scene.sliders.iter().flat_map(of_slider).collect()
}

/// The values of the columns that a scene adds, at the present state of the model, in the same order.
pub(super) fn extra_values(model: &Model) -> impl Iterator<Item = f64> {
    (0..model.slider_names().count()).flat_map(|slider| {
        let force = model.contact_force(slider);
        let (position, speed) = (model.slider_position(slider), model.slider_speed(slider));
        [position, speed, force.norm(), force.x, force.y]
    })
}
