//! Damped vibration: `(λ² M + λ D + K) x = 0` of a small model, in all of its modes.
//!
//! With all shapes `φ` of the undamped model, `φᵀ M φ = 1`, this is `λ² + λ C + Ω² = 0` with `C = Φᵀ D Φ`: nothing is left out, and the squares `Ω²` are as exact as
//! modes are. The entries of `C` are powers, added up from rates of strain, so that small ones do not drown in large ones. All `λ` are those of a matrix of twice the
//! size (F. Tisseur & K. Meerbergen, SIAM Review 43 (2001) 235–286, section 3.4), and each that is told is corrected by inverse iteration
//! with the Rayleigh quotient of the quadratic problem, which keeps the largest numbers from blurring the smallest.

use nalgebra::{Complex, DMatrix, DVector, Schur};

use super::VibrationError;
use super::pencil::Pencil;
use super::search::{is_small, lowest};
use crate::elementary::hypot;
use crate::integrators::Mechanism;
use crate::model::{Model, UnknownKind};

/// Most sweeps of the search for all `λ`, for each of them.
const MOST_SWEEPS: usize = 200;

/// Corrections of each `λ` that is told.
const CORRECTIONS: usize = 4;

/// A correction that moves `λ` by a larger part of it has gone to another one, and is not taken.
const FAR: f64 = 1e-4;

/// So far beside `λ`, as a part of it, inverse iteration stands, where nothing is singular.
const BESIDE: f64 = 1e-8;

type Number = Complex<f64>;

/// A damped natural vibration `exp(-δ t)`, with a frequency unless it only creeps back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DampedMode {
    /// How fast the vibration decays, `δ = -Re λ`; negative where it grows [1/time].
    pub decay_rate: f64,
    /// With which angular frequency it swings, `|Im λ|`; zero where it is overdamped [rad/time].
    pub angular_frequency: f64,
}

impl DampedMode {
    /// The damping ratio `δ/|λ|`: one where nothing swings, zero where nothing moves [-].
    pub fn damping_ratio(&self) -> f64 {
        match hypot(self.decay_rate, self.angular_frequency) {
            0.0 => 0.0,
            size => self.decay_rate / size,
        }
    }

    /// The damped vibrations of a model about its present configuration, taken as one at rest, those of the smallest `|λ|` first: one for each pair of conjugate `λ`, one
    /// for each that is real.
    ///
    /// # Errors
    /// When the model is large, something in it has no inertia, there are not so many, or what [`Modes::of`](super::Modes::of) says of undamped modes.
    pub fn of(
        model: &Model,
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
            mode.shape = pencil.order.in_own_order(shape, unknowns);
        }
        let squares = DVector::from_iterator(modes.len(), modes.iter().map(|mode| mode.square));
        let shapes: Vec<Vec<f64>> = modes.into_iter().map(|mode| mode.shape).collect();
        let damping = damping(model, &shapes);
        let mut found = all(&squares, &damping).ok_or(VibrationError::Uncounted)?;
        found.retain(|at| at.im >= 0.0);
        found.sort_by(|a, b| size(*a).total_cmp(&size(*b)));
        if count == 0 || count > found.len() {
            return Err(VibrationError::Count { asked: count, available: found.len() });
        }
        found.truncate(count);
        let corrected = found.into_iter().map(|at| corrected(at, &squares, &damping));
        Ok(corrected
            .map(|at| Self { decay_rate: -at.re, angular_frequency: at.im.abs() })
            .collect())
    }
}

fn size(at: Number) -> f64 {
    hypot(at.re, at.im)
}

/// `C = Φᵀ D Φ`: its diagonal are powers, and beside it the powers of sums of shapes that dissipate equally.
fn damping(model: &Model, shapes: &[Vec<f64>]) -> DMatrix<f64> {
    let own: Vec<f64> = shapes.iter().map(|shape| model.dissipation(shape)).collect();
    let mut damping = DMatrix::from_diagonal(&DVector::from_column_slice(&own));
    let mut room = vec![0.0; shapes.first().map_or(0, Vec::len)];
    for (row, one) in shapes.iter().enumerate().filter(|(at, _)| own[*at] > 0.0) {
        for (column, other) in shapes.iter().enumerate().skip(row + 1) {
            if own[column] <= 0.0 {
                continue;
            }
            let scales = [1.0 / own[row].sqrt(), 1.0 / own[column].sqrt()];
            let mut power = |sign: f64| {
                let pairs =
                    one.iter().zip(other).map(|(a, b)| scales[0] * a + sign * scales[1] * b);
                room.iter_mut().zip(pairs).for_each(|(sum, value)| *sum = value);
                model.dissipation(&room)
            };
            let share = (0.25 * (power(1.0) - power(-1.0))).clamp(-1.0, 1.0);
            let entry = share / (scales[0] * scales[1]);
            (damping[(row, column)], damping[(column, row)]) = (entry, entry);
        }
    }
    damping
}

/// All `λ` of `λ² + λ C + Ω²`; none where they are not found.
fn all(squares: &DVector<f64>, damping: &DMatrix<f64>) -> Option<Vec<Number>> {
    let count = squares.len();
    let mut first_order = DMatrix::zeros(2 * count, 2 * count);
    for (at, square) in squares.iter().enumerate() {
        let scale = if *square == 0.0 { 1.0 } else { square.abs().sqrt() };
        first_order[(at, count + at)] = scale;
        first_order[(count + at, at)] = -square / scale;
    }
    first_order.view_mut((count, count), (count, count)).copy_from(&-damping);
    let schur = Schur::try_new(first_order, f64::EPSILON, MOST_SWEEPS * count)?;
    let found: Vec<Number> = schur.complex_eigenvalues().iter().copied().collect();
    found.iter().all(|at| at.re.is_finite() && at.im.is_finite()).then_some(found)
}

/// A `λ`, corrected.
fn corrected(start: Number, squares: &DVector<f64>, damping: &DMatrix<f64>) -> Number {
    let complex = |value: f64| Number::new(value, 0.0);
    let count = squares.len();
    let mut at = start;
    let mut shape = DVector::from_fn(count, |row, _| complex(1.0 + 0.1 * (row % 7) as f64));
    for _ in 0..CORRECTIONS {
        let beside = at * (1.0 + BESIDE);
        let mut matrix = damping.map(|entry| beside * entry);
        for (row, square) in squares.iter().enumerate() {
            matrix[(row, row)] += beside * beside + square;
        }
        let Some(next) = matrix.lu().solve(&shape) else { return at };
        let largest = next.iter().map(|value| size(*value)).fold(0.0, f64::max);
        if !(largest.is_finite() && largest > 0.0) {
            return at;
        }
        shape = next / complex(largest);
        let resisted = damping.map(complex) * &shape;
        let sum =
            |of: &dyn Fn(usize) -> Number| (0..count).map(of).fold(complex(0.0), |a, b| a + b);
        let inertia = sum(&|row| shape[row] * shape[row]);
        let damped = sum(&|row| shape[row] * resisted[row]);
        let stiffness = sum(&|row| shape[row] * shape[row] * squares[row]);
        let root = root(damped * damped - inertia * stiffness * 4.0);
        let nearest = [root, -root].map(|root| (root - damped) / (inertia * 2.0));
        let nearest = match size(nearest[0] - at) < size(nearest[1] - at) {
            true => nearest[0],
            false => nearest[1],
        };
        // Where two meet, the quotient of their shape has no value.
        let moved = size(nearest - start);
        if moved.is_nan() || moved > FAR * size(start) {
            return start;
        }
        at = nearest;
    }
    at
}

/// A square root.
fn root(of: Number) -> Number {
    let size = size(of);
    if size == 0.0 {
        return of;
    }
    let larger = (0.5 * (size + of.re.abs())).sqrt();
    let smaller = 0.5 * of.im.abs() / larger;
    let sign = if of.im < 0.0 { -1.0 } else { 1.0 };
    match of.re >= 0.0 {
        true => Number::new(larger, sign * smaller),
        false => Number::new(smaller, sign * larger),
    }
}
