//! Damped vibration: `(λ² M + λ D + K) x = 0` of a small model, in all of its modes.
//!
//! With all shapes `φ` of the undamped model, `φᵀ M φ = 1`, this is `λ² + λ C + Ω² = 0` with `C = Φᵀ D Φ`: nothing is left out, and the squares `Ω²` are as exact as
//! modes are. The entries of `C` are powers, added up from rates of strain, so that small ones do not drown in large ones.
//!
//! The slowest vibrations are asked for, and strong damping of a fine mesh makes the fastest 10¹⁴ times as fast: where everything is held, the problem is turned
//! round, with `μ = 1/λ` and `x = Ω⁻¹ y`, to `μ² + μ Ω⁻¹CΩ⁻¹ + Ω⁻²`, whose largest numbers are the slowest vibrations. All `μ`, or `λ`, are those of a matrix of twice
//! the size (F. Tisseur & K. Meerbergen, SIAM Review 43 (2001) 235–286, sections 2.2 and 3.4), and each that is told is corrected by inverse iteration with the
//! Rayleigh quotient of the quadratic problem.

use nalgebra::{Complex, DMatrix, DVector, Schur};

use super::VibrationError;
use super::pencil::Pencil;
use super::search::{is_small, lowest};
use crate::elementary::hypot;
use crate::integrators::Mechanism;
use crate::model::{Model, UnknownKind};

/// Most sweeps of the search for all `λ`, for each of them; it takes a few.
const MOST_SWEEPS: usize = 40;

/// What couples `λ` is none below these parts of what is beside it: the next one is taken where the search does not end.
const DECOUPLED: [f64; 3] = [f64::EPSILON, 1e-14, 1e-12];

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
        let plain = Quadratic::new(squares, damping(model, &shapes));
        let round = plain.turned_round();
        let slow = round.as_ref().map(Quadratic::largest).transpose()?.unwrap_or_default();
        let (mut found, of_round) = (slow, round.as_ref());
        let known = found.len();
        let is_told = |at: &Number| at.im >= 0.0;
        if count == 0 || count > found.iter().filter(|at| is_told(at)).count() {
            let mut all = plain.all()?;
            all.sort_by(|a, b| size(*a).total_cmp(&size(*b)));
            found.extend(all.into_iter().skip(known));
        }
        let available = found.iter().filter(|at| is_told(at)).count();
        if count == 0 || count > available {
            return Err(VibrationError::Count { asked: count, available });
        }
        let told = found.into_iter().enumerate().filter(|(_, at)| is_told(at)).take(count);
        let told = told.map(|(number, at)| match of_round {
            Some(round) if number < known => Number::new(1.0, 0.0) / round.corrected(at),
            _ => plain.corrected(at),
        });
        Ok(told.map(|at| Self { decay_rate: -at.re, angular_frequency: at.im.abs() }).collect())
    }
}

/// Numbers of a problem that is turned round are as exact as they should be where they are larger than this part of the largest.
const EXACT: f64 = 1e-6;

/// `λ² + λ C + Ω²`, or the problem of `1/λ`.
struct Quadratic {
    /// The diagonal of what is without `λ`.
    squares: DVector<f64>,
    /// What is with it.
    damping: DMatrix<f64>,
    turned: Turned,
}

/// Which numbers a quadratic problem has.
#[derive(Clone, Copy, PartialEq)]
enum Turned {
    /// `λ` themselves.
    Not,
    /// `1/λ`.
    Round,
}

impl Quadratic {
    /// The problem with such squares `Ω²` and such damping `C`.
    fn new(squares: DVector<f64>, damping: DMatrix<f64>) -> Self {
        Self { squares, damping, turned: Turned::Not }
    }

    /// The problem of `1/λ`; none where something is free.
    fn turned_round(&self) -> Option<Self> {
        let Self { squares, damping, .. } = self;
        if squares.iter().any(|square| *square <= 0.0) {
            return None;
        }
        let by_speed = |row: usize, column: usize| {
            damping[(row, column)] / (squares[row].sqrt() * squares[column].sqrt())
        };
        let damping = DMatrix::from_fn(squares.len(), squares.len(), by_speed);
        let squares = squares.map(|square| 1.0 / square);
        Some(Self { squares, damping, turned: Turned::Round })
    }

    /// The largest numbers of the problem, those which are exact, the largest first.
    fn largest(&self) -> Result<Vec<Number>, VibrationError> {
        let mut found = self.all()?;
        found.sort_by(|a, b| size(*b).total_cmp(&size(*a)));
        let least = EXACT * found.first().map_or(0.0, |at| size(*at));
        let mut exact = found.iter().take_while(|at| size(**at) > least).count();
        // Of a pair both or none.
        let whole = found[..exact].iter().map(|at| at.im).sum::<f64>();
        if exact > 0 && whole != 0.0 && found[exact - 1].im != 0.0 {
            exact -= 1;
        }
        found.truncate(exact);
        Ok(found)
    }

    /// All numbers of the problem.
    fn all(&self) -> Result<Vec<Number>, VibrationError> {
        let Self { squares, damping, .. } = self;
        let count = squares.len();
        let mut first_order = DMatrix::zeros(2 * count, 2 * count);
        for (at, square) in squares.iter().enumerate() {
            let scale = if *square == 0.0 { 1.0 } else { square.abs().sqrt() };
            first_order[(at, count + at)] = scale;
            first_order[(count + at, at)] = -square / scale;
        }
        first_order.view_mut((count, count), (count, count)).copy_from(&-damping);
        // A matrix is found to be decoupled where what couples is small beside its diagonal: beside numbers of no interest, which are next to nothing where the
        // problem is turned round, it may never be. Then all are moved away from zero, by as much as the largest entry.
        let largest = first_order.amax();
        let search = |part: f64, moved: f64| {
            let mut matrix = first_order.clone();
            (0..2 * count).for_each(|at| matrix[(at, at)] -= moved);
            let schur = Schur::try_new(matrix, part, MOST_SWEEPS * count)?;
            Some(schur.complex_eigenvalues().iter().map(|at| at + moved).collect())
        };
        let moved = |part: f64| match self.turned {
            Turned::Not => search(part, 0.0),
            Turned::Round => search(part, 0.0).or_else(|| search(part, largest)),
        };
        let found: Option<Vec<Number>> = DECOUPLED.into_iter().find_map(moved);
        let found = found.ok_or(VibrationError::Damping)?;
        match found.iter().all(|at| at.re.is_finite() && at.im.is_finite()) {
            true => Ok(found),
            false => Err(VibrationError::Damping),
        }
    }

    /// A number of the problem, corrected.
    fn corrected(&self, start: Number) -> Number {
        let Self { squares, damping, .. } = self;
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
