//! Natural frequencies and shapes.

use std::f64::consts::TAU;

use super::VibrationError;
use super::pencil::Pencil;
use super::search::{is_small, lowest, numbers};
use crate::beams::{BodyPoint, Mesh};
use crate::geometry::Vec2;
use crate::integrators::Mechanism;
use crate::system::System;

/// A movement whose square is below this part of that of the slowest bending meets no resistance.
const LOOSE: f64 = 1e-10;

/// A natural mode of small vibration: frequency and shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// The square `ω²` of the angular frequency: zero for a movement without resistance, and where rounding hides it; negative if the
    /// configuration is unstable [1/time²].
    pub square: f64,
    /// How much of the square `ω²` rounding may hide [1/time²].
    pub rounding: f64,
    /// How far the shape and its section forces are from balance, in the energy of `ω² + σ`, `σ` being about the square of the slowest
    /// bending: the next correction would change so much. `ω² + σ` is not wrong by more than this part of itself, and by its square only,
    /// over the relative distance of the next mode [-].
    pub residual: f64,
    /// The movements of the unknowns in the mode, with `φᵀ M φ = 1` [length, rad over the square root of a mass].
    pub shape: Vec<f64>,
}

impl Mode {
    /// The angular frequency `ω` of the mode; zero where nothing vibrates [rad/time].
    pub fn angular_frequency(&self) -> f64 {
        self.square.max(0.0).sqrt()
    }

    /// The frequency `ω/2π` of the mode [1/time].
    pub fn frequency(&self) -> f64 {
        self.angular_frequency() / TAU
    }

    /// The period `2π/ω` of the mode, infinite where nothing vibrates [time].
    pub fn period(&self) -> f64 {
        1.0 / self.frequency()
    }

    /// Whether the movement of the mode meets no resistance that rounding would not hide.
    pub fn is_free(&self) -> bool {
        self.square == 0.0
    }

    /// How fast the mode grows as a disturbance of an unstable configuration; zero if it is stable [1/time].
    pub fn growth_rate(&self) -> f64 {
        (-self.square).max(0.0).sqrt()
    }
}

/// The lowest modes of a configuration.
#[derive(Debug, Clone)]
pub struct Modes {
    modes: Vec<Mode>,
    meshes: Vec<Mesh>,
    /// The configuration: control points of all bodies, and shapes as displacements of these.
    points: Vec<Vec<Vec2>>,
    displacements: Vec<Vec<Vec<Vec2>>>,
    /// `½ φᵀ D φ` of each mode [1/time].
    decay_rates: Vec<f64>,
}

impl Modes {
    /// The modes of a model in its present configuration, taken as one at rest; `goes_on` is asked again and again where they are
    /// looked for in a large scene.
    ///
    /// # Errors
    /// When there are not so many, a load turns with the beam, or it is stopped.
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
            return Err(VibrationError::Count { asked: count, available: pencil.finite });
        }
        let mut modes = lowest(&pencil, count, goes_on)?;
        for mode in &mut modes {
            let shape = std::mem::take(&mut mode.shape);
            mode.shape = pencil.order.in_own_order(shape, model.unknowns());
        }
        let displacements = modes.iter().map(|mode| model.displacements(&mode.shape)).collect();
        let decay_rates = modes.iter().map(|mode| 0.5 * model.dissipation(&mode.shape)).collect();
        Ok(Self {
            modes,
            meshes: model.meshes().to_vec(),
            points: model.control_points().map(<[Vec2]>::to_vec).collect(),
            displacements,
            decay_rates,
        })
    }

    /// About the memory that looking for so many modes of a model takes at most [bytes].
    pub fn memory(model: &System, count: usize) -> u64 {
        let unknowns = model.unknown_kinds().len();
        // There are no more than that: a larger number is refused by the search.
        let numbers = numbers(unknowns, count.min(unknowns));
        (numbers * size_of::<f64>() + Pencil::memory(model)) as u64
    }

    /// The modes, from the lowest on.
    pub fn all(&self) -> &[Mode] {
        &self.modes
    }

    /// How fast each mode decays by damping, `½ φᵀ D φ`: exact where damping does not couple modes, as that of a material with one relaxation time for all
    /// strains,
    /// else to first order in the damping [1/time].
    pub fn decay_rates(&self) -> &[f64] {
        &self.decay_rates
    }

    /// The damping ratio of each mode, its decay rate over its angular frequency; zero where nothing vibrates [-].
    pub fn damping_ratios(&self) -> impl Iterator<Item = f64> {
        self.modes.iter().zip(&self.decay_rates).map(|(mode, decay)| match mode.square > 0.0 {
            true => decay / mode.angular_frequency(),
            false => 0.0,
        })
    }

    /// Whether every small disturbance stays small, or at least grows by its start velocity only.
    pub fn is_stable(&self) -> bool {
        self.modes.iter().all(|mode| mode.square >= 0.0)
    }

    /// The meshes of the beams whose modes these are.
    pub fn meshes(&self) -> &[Mesh] {
        &self.meshes
    }

    /// The configuration that the modes are about: control points of all bodies [length].
    pub fn points(&self) -> &[Vec<Vec2>] {
        &self.points
    }

    /// The larger side of the box around the configuration [length].
    pub fn size(&self) -> f64 {
        let points = || self.points.iter().flatten();
        let side = |along: fn(&Vec2) -> f64| {
            let least = points().map(along).fold(f64::INFINITY, f64::min);
            points().map(along).fold(f64::NEG_INFINITY, f64::max) - least
        };
        side(|at| at.x).max(side(|at| at.y))
    }

    /// The configuration displaced by a mode, the largest displacement of a control point being `amplitude` [length].
    pub fn displaced(&self, mode: usize, amplitude: f64) -> Vec<Vec<Vec2>> {
        let largest = self.largest(mode);
        if largest == 0.0 {
            return self.points.clone();
        }
        let scale = amplitude / largest;
        let moved = |(points, by): (&Vec<Vec2>, &Vec<Vec2>)| {
            points.iter().zip(by).map(|(point, by)| point + by * scale).collect()
        };
        self.points.iter().zip(&self.displacements[mode]).map(moved).collect()
    }

    /// The displacement of a place in a mode, relative to the largest of a control point [-].
    pub fn displacement(&self, mode: usize, place: &BodyPoint) -> Vec2 {
        match self.largest(mode) {
            0.0 => Vec2::zeros(),
            largest => place.interpolate(&self.displacements[mode][place.body]) / largest,
        }
    }

    fn largest(&self, mode: usize) -> f64 {
        let points = self.displacements[mode].iter().flatten();
        points.map(|by| by.norm()).fold(0.0, f64::max)
    }
}

/// The number of movements that meet no resistance in the present configuration without loads; 0 where a scene in which nothing slides
/// is too large to find that out at once.
pub fn loose_movements(model: &System) -> usize {
    if !is_small(model.unknowns()) && model.slider_names().next().is_none() {
        return 0;
    }
    let count = |pencil: Pencil| pencil.modes_below(LOOSE * pencil.scale).unwrap_or(0);
    Pencil::of(model).map_or(0, count)
}
