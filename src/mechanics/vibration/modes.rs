//! Natural frequencies and mode shapes.

use std::f64::consts::TAU;

use super::pencil::Pencil;
use super::search::{is_small, lowest, numbers};
use super::{ModeShapes, VibrationError};
use crate::integrators::Mechanism;
use crate::system::System;

/// Largest squared frequency of a mode that counts as unrestrained, as a fraction of the squared frequency of the lowest bending mode.
const UNRESTRAINED: f64 = 1e-10;

/// Natural mode of small vibration.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Squared angular frequency `ω²` of the mode [1/time²]; zero for an unrestrained motion, or if it is below its rounding error.
    /// A negative squared frequency means that the configuration is unstable.
    pub square: f64,
    /// Rounding error of the squared frequency `ω²` [1/time²].
    pub rounding: f64,
    /// Residual of the mode [-], a measure of its accuracy.
    /// The residual is the square root of a ratio: the energy of a correction of the shape and its section forces, divided by the energy of the shape.
    /// The residual bounds the relative error of `ω² + σ`. The shift `σ` of the search is usually an estimate of `ω²` of the lowest bending mode.
    pub residual: f64,
    /// Mode shape: values of the unknowns, normalised with respect to the inertia [length, rad over the square root of a mass].
    pub shape: Vec<f64>,
}

impl Mode {
    /// Angular frequency `ω` of the mode [rad/time]; zero if the mode does not vibrate.
    pub fn angular_frequency(&self) -> f64 {
        self.square.max(0.0).sqrt()
    }

    /// Frequency `ω/2π` of the mode with angular frequency `ω` [1/time].
    pub fn frequency(&self) -> f64 {
        self.angular_frequency() / TAU
    }

    /// Period `2π/ω` of the mode with angular frequency `ω` [time]; infinite if the mode does not vibrate.
    pub fn period(&self) -> f64 {
        1.0 / self.frequency()
    }

    /// Returns true if the mode is an unrestrained motion within rounding.
    pub fn is_free(&self) -> bool {
        self.square == 0.0
    }

    /// Growth rate of a disturbance if the configuration is unstable in this mode [1/time]; zero otherwise.
    pub fn growth_rate(&self) -> f64 {
        (-self.square).max(0.0).sqrt()
    }
}

/// Lowest modes of a configuration.
#[derive(Debug, Clone)]
pub struct Modes {
    modes: Vec<Mode>,
    shapes: ModeShapes,
    decay_rates: Vec<f64>,
}

impl Modes {
    /// Computes the modes of a model in its present configuration, which is treated as an equilibrium.
    /// The callback `goes_on` is called repeatedly. If the callback returns false, the search stops.
    ///
    /// # Errors
    /// Fails if `count` is zero, there are too few modes, a load is a follower load, or the search is stopped.
    /// Also fails if the stiffness is not finite, or if the search does not find all modes with the required accuracy.
    pub fn of(
        model: &System,
        count: usize,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Self, VibrationError> {
        if let Some(load) = model.follower() {
            return Err(VibrationError::Follower { load: load.to_owned() });
        }
        let pencil = Pencil::of(model)?;
        if count == 0 || count > pencil.finite {
            return Err(VibrationError::Count { requested: count, available: pencil.finite });
        }
        let mut modes = lowest(&pencil, count, goes_on)?;
        for mode in &mut modes {
            let shape = std::mem::take(&mut mode.shape);
            mode.shape = pencil.order.to_step_order(shape, model.unknowns());
        }
        let shapes = ModeShapes::of(model, modes.iter().map(|mode| &*mode.shape));
        let decay_rates = modes.iter().map(|mode| 0.5 * model.dissipation(&mode.shape)).collect();
        Ok(Self { modes, shapes, decay_rates })
    }

    /// Approximate peak memory of the search for `count` modes [bytes].
    pub fn memory(model: &System, count: usize) -> u64 {
        let unknowns = model.unknown_kinds().len();
        // A search for more modes than unknowns is rejected, so its memory need not be estimated.
        let numbers = numbers(unknowns, count.min(unknowns));
        (numbers * size_of::<f64>() + Pencil::memory(model)) as u64
    }

    /// Modes in increasing order of their squared frequencies.
    pub fn all(&self) -> &[Mode] {
        &self.modes
    }

    /// Decay rates of all modes [1/time].
    /// The decay rates are exact if no mode is overdamped and damping does not couple modes.
    /// Damping does not couple modes, for example, for a material with one relaxation time for all strains.
    /// If damping couples modes, the decay rates are accurate to first order in the damping.
    pub fn decay_rates(&self) -> &[f64] {
        &self.decay_rates
    }

    /// Damping ratio of each mode [-]: decay rate divided by angular frequency; zero if the mode does not vibrate.
    pub fn damping_ratios(&self) -> impl Iterator<Item = f64> {
        self.modes.iter().zip(&self.decay_rates).map(|(mode, decay)| match mode.square > 0.0 {
            true => decay / mode.angular_frequency(),
            false => 0.0,
        })
    }

    /// Returns true if no small disturbance of the configuration grows exponentially.
    pub fn is_stable(&self) -> bool {
        self.modes.iter().all(|mode| mode.square >= 0.0)
    }

    /// Shapes of the modes, for pictures and displacements of points.
    pub fn shapes(&self) -> &ModeShapes {
        &self.shapes
    }
}

/// Number of degrees of freedom that are unrestrained or unstable in the present configuration without loads.
/// The result is 0 for scenes without sliders that are too large for the computation, and if the count is unreliable.
pub fn loose_movements(model: &System) -> usize {
    if !is_small(model.unknowns()) && model.slider_names().next().is_none() {
        return 0;
    }
    let count = |pencil: Pencil| pencil.eigenvalues_below(UNRESTRAINED * pencil.scale).unwrap_or(0);
    Pencil::of(model).map_or(0, count)
}
