//! Columns of a history: standard columns, and columns of the sensors of the scene.

use super::Sample;

/// Standard column of every history.
#[derive(Debug, Clone, Copy)]
pub struct Column {
    /// Name of the column of the history.
    pub name: &'static str,
    /// Dimension of the values of the column.
    pub dimension: &'static str,
    /// True if the values describe the motion of the scene. False for the time, and for values that describe the computation of the motion.
    pub is_of_motion: bool,
    /// Function that reads the value of the column from a row.
    pub value: fn(&Sample) -> f64,
}

/// Column of a history that depends on the scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExtraColumn {
    /// Name of the column: object and quantity, such as `slider1.force`.
    pub name: String,
    /// Dimension of the values of the column.
    pub dimension: &'static str,
}

pub(super) const FIXED: &[Column] = &[
    of_run("t", "time", |row| row.measures.time),
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
    of_run("gap", "length", |row| row.measures.gap),
    of_run("dt", "time", |row| row.dt),
    of_run("newton_iterations", "-", |row| row.newton_iterations as f64),
    of_run("retries", "-", |row| row.retries as f64),
];

const fn fixed(name: &'static str, dimension: &'static str, value: fn(&Sample) -> f64) -> Column {
    Column { name, dimension, is_of_motion: true, value }
}

const fn of_run(name: &'static str, dimension: &'static str, value: fn(&Sample) -> f64) -> Column {
    Column { is_of_motion: false, ..fixed(name, dimension, value) }
}
