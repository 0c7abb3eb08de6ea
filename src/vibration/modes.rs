//! Natural frequencies and shapes.

use std::f64::consts::TAU;

use nalgebra::DMatrix;

use super::VibrationError;
use super::pencil::Pencil;
use super::reduced::{Pairs, pairs};
use super::subspace::{Refusal, lowest_pairs, width};
use crate::beams::{Mesh, Place};
use crate::geometry::Vec2;
use crate::model::Model;

/// Up to so many unknowns all modes are found at once,
const SMALL: usize = 240;

/// and up to so many where more than an eighth of them is asked for.
const MEDIUM: usize = 2000;

/// Matrices of the size of the stiffness that are there at a time where all modes are found.
const DENSE_COPIES: usize = 6;

/// Sets of vectors that are there at a time where the lowest are.
const SUBSPACE_COPIES: usize = 5;

/// A squared frequency below so many times its rounding is zero.
const ROUNDING: f64 = 64.0;

/// A shift is so many times as large as what rounding hides of free movements.
const HIDDEN_SHIFT: f64 = 100.0;

/// A shift by so many times the rounding keeps a stiffness definite that rigid motions leave singular.
const FIRST_SHIFT: f64 = 1e4;

/// An unstable configuration needs a larger shift; after so many tries by a hundred there is none.
const MOST_SHIFTS: usize = 12;

/// A natural vibration.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// `ω²`: zero for a movement without resistance, and where rounding hides it; negative if the configuration is unstable
    /// [1/time²].
    pub square: f64,
    /// What rounding may hide of it [1/time²].
    pub rounding: f64,
    /// The movements of the unknowns, with `φᵀ M φ = 1`.
    pub shape: Vec<f64>,
}

impl Mode {
    /// `ω`; zero where nothing vibrates [rad/time].
    pub fn angular_frequency(&self) -> f64 {
        self.square.max(0.0).sqrt()
    }

    /// `ω/2π` [1/time].
    pub fn frequency(&self) -> f64 {
        self.angular_frequency() / TAU
    }

    /// `2π/ω`, infinite where nothing vibrates [time].
    pub fn period(&self) -> f64 {
        1.0 / self.frequency()
    }

    /// Whether the movement meets no resistance that rounding would not hide.
    pub fn is_free(&self) -> bool {
        self.square == 0.0
    }

    /// How fast a disturbance of an unstable configuration grows; zero if it is stable [1/time].
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
}

impl Modes {
    /// The modes of a model in its present configuration, taken as one at rest; `goes_on` is asked again and again where they are
    /// looked for in a large scene.
    ///
    /// # Errors
    /// When there are not so many, something slides or turns with the beam, or it is stopped.
    pub fn of(
        model: &mut Model,
        count: usize,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Self, VibrationError> {
        if let Some(slider) = model.slider_names().next() {
            return Err(VibrationError::Slider { slider: slider.to_owned() });
        }
        if let Some(load) = model.follower() {
            return Err(VibrationError::Follower { load: load.to_owned() });
        }
        let pencil = Pencil::of(model)?;
        if count == 0 || count > pencil.finite {
            return Err(VibrationError::Count { asked: count, available: pencil.finite });
        }
        let modes = lowest(&pencil, count, goes_on)?;
        let displacements = modes.iter().map(|mode| model.displacements(&mode.shape)).collect();
        Ok(Self {
            modes,
            meshes: model.meshes().to_vec(),
            points: model.control_points().map(<[Vec2]>::to_vec).collect(),
            displacements,
        })
    }

    /// About the memory that looking for so many modes of a model takes at most [bytes].
    pub fn memory(model: &Model, count: usize) -> u64 {
        let unknowns = model.rotations().len();
        let numbers = match Search::of(unknowns, count) {
            Search::All => DENSE_COPIES * unknowns * unknowns,
            Search::Lowest => SUBSPACE_COPIES * unknowns * width(unknowns, count),
        };
        (numbers * size_of::<f64>()) as u64
    }

    /// From the lowest on.
    pub fn all(&self) -> &[Mode] {
        &self.modes
    }

    /// Whether every small disturbance stays small, or at least grows by its start velocity only.
    pub fn is_stable(&self) -> bool {
        self.modes.iter().all(|mode| mode.square >= 0.0)
    }

    /// The meshes of the beams.
    pub fn meshes(&self) -> &[Mesh] {
        &self.meshes
    }

    /// The configuration itself: control points of all bodies [length].
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

    /// The configuration in a mode, its largest displacement of a control point as long as asked for [length].
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
    pub fn displacement(&self, mode: usize, place: &Place) -> Vec2 {
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

/// The number of movements that meet no resistance in the present configuration without loads; 0 where a scene is too
/// large to find that out at once.
pub fn loose_movements(model: &mut Model) -> usize {
    if model.rotations().len() > SMALL {
        return 0;
    }
    Pencil::of(model).map_or(0, |pencil| pencil.modes_below(FIRST_SHIFT * pencil.rounding))
}

fn lowest(
    pencil: &Pencil,
    count: usize,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<Vec<Mode>, VibrationError> {
    let more = (count + 4).min(pencil.finite);
    let mut shift = if pencil.rounding > 0.0 { FIRST_SHIFT * pencil.rounding } else { 1.0 };
    let mut tries = 0;
    let pairs = loop {
        match shifted_pairs(pencil, shift, more, goes_on) {
            Ok(pairs) => break pairs,
            Err(Refusal::Final(error)) => return Err(error),
            Err(Refusal::NotDefinite) if tries == MOST_SHIFTS => {
                return Err(VibrationError::Indefinite);
            }
            Err(Refusal::NotDefinite) => (shift, tries) = (100.0 * shift, tries + 1),
        }
    };
    let found = modes_of(pencil, &pairs, shift);
    let first = |modes: Vec<Mode>| modes.into_iter().take(count).collect();
    // A shift of the size of the lowest square keeps the digits of the others.
    let lowest = found.iter().map(|mode| mode.square).find(|square| *square != 0.0);
    let hidden = found.iter().filter(|mode| mode.is_free()).map(|mode| mode.rounding);
    let smallest = HIDDEN_SHIFT * hidden.fold(0.0, f64::max);
    let Some(fine) = lowest.filter(|square| *square > 0.0).map(|square| square.max(smallest))
    else {
        return Ok(first(found));
    };
    match shifted_pairs(pencil, fine, count, goes_on) {
        Ok(pairs) => Ok(first(modes_of(pencil, &pairs, fine))),
        Err(Refusal::Final(VibrationError::Interrupted)) => Err(VibrationError::Interrupted),
        Err(_) => Ok(first(found)),
    }
}

/// How modes are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Search {
    /// All at once, and the lowest are taken.
    All,
    /// The lowest alone.
    Lowest,
}

impl Search {
    fn of(unknowns: usize, count: usize) -> Self {
        let is_large = unknowns > MEDIUM || (unknowns > SMALL && 8 * count < unknowns);
        if is_large { Self::Lowest } else { Self::All }
    }
}

fn shifted_pairs(
    pencil: &Pencil,
    shift: f64,
    count: usize,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<Pairs, Refusal> {
    let size = pencil.size();
    if Search::of(size, count) == Search::Lowest {
        return lowest_pairs(pencil, shift, count, goes_on);
    }
    let (mut stiffness, mut inertia) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
    for (row, column, resistance, mass) in pencil.entries() {
        stiffness[(row, column)] = resistance + shift * mass;
        inertia[(row, column)] = mass;
    }
    pairs(stiffness, &inertia).ok_or(Refusal::NotDefinite)
}

/// `ω² = 1/μ - σ` of each pair, zero where rounding hides it.
fn modes_of(pencil: &Pencil, pairs: &Pairs, shift: f64) -> Vec<Mode> {
    let shapes = pairs.vectors.column_iter().zip(&pairs.values);
    // `φᵀ M φ = μ` for the vectors of the shifted problem; movements without inertia have none.
    let with_inertia = shapes.filter(|(_, value)| **value > 0.0);
    with_inertia
        .map(|(vector, value)| {
            let scale = 1.0 / value.sqrt();
            let shape: Vec<f64> = vector.iter().map(|entry| entry * scale).collect();
            let (square, rounding) = (1.0 / value - shift, ROUNDING * pencil.rounding_of(&shape));
            let square = if square.abs() <= rounding { 0.0 } else { square };
            Mode { square, rounding, shape }
        })
        .collect()
}
