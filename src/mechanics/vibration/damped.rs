//! Damped vibrations of a small model, computed in the basis of all its undamped modes (docs/theory.md, section 15).

use nalgebra::{Complex, DMatrix};

use super::VibrationError;
use super::pencil::Pencil;
use super::quadratic::Quadratic;
use super::search::{is_small, lowest};
use crate::elementary::hypot;
use crate::geometry::larger;
use crate::integrators::Mechanism;
use crate::system::{System, UnknownKind};

/// Largest decay rate or frequency that counts as zero, as a fraction of the largest undamped frequency.
const NOTHING: f64 = 1e-40;

/// Damped natural vibration, which decays as `exp(-δ t)` with time `t`. An overdamped vibration has no frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DampedMode {
    /// Decay rate `δ = -Re λ` of the vibration `exp(λ t)` [1/time]; negative if the vibration grows.
    pub decay_rate: f64,
    /// Angular frequency `|Im λ|` of the vibration `exp(λ t)` [rad/time]; zero for an overdamped vibration.
    pub angular_frequency: f64,
}

impl DampedMode {
    /// Damping ratio `δ/|λ|` of the vibration `exp(λ t)` with decay rate `δ` [-]; negative if the vibration grows.
    /// The damping ratio is one for an overdamped vibration, and zero for `λ = 0`.
    pub fn damping_ratio(&self) -> f64 {
        match hypot(self.decay_rate, self.angular_frequency) {
            0.0 => 0.0,
            size => self.decay_rate / size,
        }
    }

    /// Damped vibrations about the present configuration, which is treated as an equilibrium.
    /// The vibrations are in increasing order of `|λ|`. Each conjugate pair of eigenvalues `λ` gives one vibration.
    ///
    /// # Errors
    /// Fails if the model is too large or has sliders, a degree of freedom has no inertia, there are too few vibrations, or they are not found.
    /// Also fails in the same cases as [`Modes::of`](super::Modes::of), because undamped modes are computed first.
    pub fn of(
        model: &System,
        count: usize,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Vec<Self>, VibrationError> {
        if let Some(load) = model.follower() {
            return Err(VibrationError::Follower { load: load.to_owned() });
        }
        let unknowns = model.unknowns();
        if !is_small(unknowns) {
            return Err(VibrationError::LargeDamped { unknowns });
        }
        let pencil = Pencil::of(model)?;
        let is_force = |kind: &&UnknownKind| **kind == UnknownKind::Force;
        let forces = model.unknown_kinds().iter().filter(is_force).count();
        if model.slider_names().next().is_some() || pencil.finite + 2 * forces != unknowns {
            return Err(VibrationError::LightDamped);
        }
        let mut modes = lowest(&pencil, pencil.finite, goes_on)?;
        for mode in &mut modes {
            let shape = std::mem::take(&mut mode.shape);
            mode.shape = pencil.order.to_step_order(shape, unknowns);
        }
        let squares: Vec<f64> = modes.iter().map(|mode| mode.square).collect();
        let least = NOTHING * squares.iter().copied().fold(0.0, larger).sqrt();
        let shapes: Vec<Vec<f64>> = modes.into_iter().map(|mode| mode.shape).collect();
        let eigenvalues =
            Quadratic::new(squares, dampers(model, &shapes)).slowest(count, goes_on)?;
        Ok(eigenvalues.into_iter().map(|at| Self::of_number(at, least)).collect())
    }

    /// Vibration `exp(λ t)`. Real and imaginary parts of `λ` up to `least` count as zero [1/time].
    fn of_number(at: Complex<f64>, least: f64) -> Self {
        let without_rounding = |number: f64| if number.abs() > least { number } else { 0.0 };
        Self {
            decay_rate: without_rounding(-at.re),
            angular_frequency: without_rounding(at.im.abs()),
        }
    }
}

fn dampers(model: &System, shapes: &[Vec<f64>]) -> DMatrix<f64> {
    let mut entries = Vec::new();
    for shape in shapes {
        model.each_damped_rate(shape, &mut |damping, rate| entries.push(damping.sqrt() * rate));
    }
    let columns = entries.len().checked_div(shapes.len()).unwrap_or(0);
    DMatrix::from_row_slice(shapes.len(), columns, &entries)
}
