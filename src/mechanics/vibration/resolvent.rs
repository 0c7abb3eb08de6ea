//! Eigenvalues of the quadratic eigenvalue problem of damped vibrations near a given shift (docs/theory.md, section 15).
//!
//! For a positive shift, the inverse of the shifted problem is bounded for damping of any strength (Lumer & Phillips 1961).
//! One-sided Jacobi rotations decompose the damping matrix into dashpots along orthogonal directions.
//! An infinitely strong dashpot permits no motion along its direction.
//! Each reported eigenvalue is corrected by inverse iteration with the Rayleigh quotient of the quadratic problem.
//! The forces of strong dashpots are unknowns of the iteration (Tisseur & Meerbergen 2001, sections 2 and 3.4).

use nalgebra::{DMatrix, DVector, Schur};

use super::VibrationError;
use super::dense::rotate;
use super::quadratic::{ComplexNumber, Quadratic, size};
use crate::elementary::square;

/// Largest number of QR iterations per eigenvalue in the Schur decomposition. A few iterations are usual.
const MOST_SWEEPS: usize = 40;

/// Largest subdiagonal entries that the Schur decomposition treats as zero, relative to the diagonal entries.
/// If the decomposition does not converge with the first limit of the list, the next limit is used.
const DECOUPLED: [f64; 3] = [f64::EPSILON, 1e-14, 1e-12];

const CORRECTIONS: usize = 4;

/// Largest relative change of an eigenvalue by an accepted correction, including the effect of rounding.
const FAR: f64 = 1e-4;

/// Largest relative change of an eigenvalue by an accepted correction, without the effect of rounding.
/// A correction that changes an eigenvalue by more than `NEAR` shows that the shapes of several close eigenvalues are mixed.
const NEAR: f64 = 1e-10;
const ROUNDING_CHANGE: f64 = 1e-12;

/// Distance between the shift of the inverse iteration and the eigenvalue, as a fraction of the eigenvalue.
/// At the distance `BESIDE`, the matrix of the inverse iteration is not singular.
const BESIDE: f64 = 1e-8;

/// Largest damping that is an entry of the matrix. The forces of stronger dashpots are unknowns.
/// Larger damping entries in the matrix would reduce the accuracy of weakly damped modes.
const STRONG: f64 = 1e4;

pub(super) struct Resolvent {
    /// Shift `σ` [1/time].
    pub(super) shift: f64,
    scales: Vec<(f64, f64, f64)>,
    places: Vec<usize>,
    velocities: Vec<usize>,
    directions: DMatrix<f64>,
    damping: Vec<f64>,
}

impl Resolvent {
    /// Creates the problem for a shift whose square exceeds `-ω²` of all unstable modes with squared frequency `ω²`.
    pub(super) fn of(
        problem: &Quadratic,
        shift: f64,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Self, VibrationError> {
        let modes = 0..problem.squares.len();
        let scale = |square: &f64| {
            let inverse = 1.0 / (shift * shift + square).sqrt();
            (square.abs().sqrt() * inverse, shift * inverse, square.signum())
        };
        let scales: Vec<_> = problem.squares.iter().map(scale).collect();
        let mut directions = problem.dampers.clone();
        for (mut row, (_, time, _)) in directions.row_iter_mut().zip(&scales) {
            row *= time / shift.sqrt();
        }
        let damping = rotate(&mut directions, goes_on)?;
        let acting: Vec<usize> = (0..damping.len()).filter(|at| damping[*at] > 0.0).collect();
        let mut directions = directions.select_columns(&acting);
        let damping: Vec<f64> = acting.iter().map(|at| damping[*at]).collect();
        for (mut column, square) in directions.column_iter_mut().zip(&damping) {
            column /= square.sqrt();
        }
        let places = modes.clone().filter(|mode| problem.squares[*mode] != 0.0).collect();
        let velocities = modes.filter(|mode| !problem.is_loose(*mode)).collect();
        Ok(Self { shift, scales, places, velocities, directions, damping })
    }

    /// All eigenvalues as multiples of the shift, in increasing order of magnitude. The eigenvalues near the shift are accurate.
    pub(super) fn numbers(&self) -> Result<Vec<ComplexNumber>, VibrationError> {
        let matrix = self.matrix();
        let count = matrix.nrows();
        if count == 0 {
            return Ok(Vec::new());
        }
        let search = |part: f64, moved: f64| {
            let mut matrix = matrix.clone();
            (0..count).for_each(|at| matrix[(at, at)] -= moved);
            let schur = Schur::try_new(matrix, part, MOST_SWEEPS * count)?;
            Some(schur.complex_eigenvalues().iter().map(|at| at + moved).collect())
        };
        let either = |part: f64| search(part, 0.0).or_else(|| search(part, 1.0));
        let found: Option<Vec<ComplexNumber>> = DECOUPLED.into_iter().find_map(either);
        let found = found.ok_or(VibrationError::Damping)?;
        if found.iter().any(|at| !(at.re.is_finite() && at.im.is_finite())) {
            return Err(VibrationError::Damping);
        }
        let one = ComplexNumber::new(1.0, 0.0);
        let number = |at: ComplexNumber| match size(at) {
            0.0 => ComplexNumber::new(f64::INFINITY, 0.0),
            _ => one + one / at,
        };
        let mut found: Vec<ComplexNumber> = found.into_iter().map(number).collect();
        found.sort_by(|a, b| size(*a).total_cmp(&size(*b)));
        Ok(found)
    }

    fn matrix(&self) -> DMatrix<f64> {
        let Self { scales, places, velocities, .. } = self;
        let held = self.weighted(|square| square / (1.0 + square));
        let rows = places.iter().map(|mode| (true, *mode));
        let rows: Vec<_> = rows.chain(velocities.iter().map(|mode| (false, *mode))).collect();
        DMatrix::from_fn(rows.len(), rows.len(), |row, column| {
            let ((of_place, at), (by_place, by)) = (rows[row], rows[column]);
            let ((w, t, _), (by_w, by_t, sign)) = (scales[at], scales[by]);
            let own = if at == by { 1.0 } else { 0.0 };
            let free = own - held[(at, by)];
            match (of_place, by_place) {
                (true, true) => -(own * t * t + w * held[(at, by)] * by_w * sign),
                (true, false) => -w * free * by_t,
                (false, true) => t * free * by_w * sign,
                (false, false) => -t * free * by_t,
            }
        })
    }

    fn weighted(&self, of: impl Fn(f64) -> f64) -> DMatrix<f64> {
        let mut weighted = self.directions.clone();
        for (mut column, square) in weighted.column_iter_mut().zip(&self.damping) {
            column *= of(*square);
        }
        weighted * self.directions.transpose()
    }

    pub(super) fn corrected(&self, start: ComplexNumber) -> ComplexNumber {
        let complex = |value: f64| ComplexNumber::new(value, 0.0);
        let modes = self.scales.len();
        let weak = self.weighted(|square| if square > STRONG { 0.0 } else { square });
        let strong: Vec<usize> =
            (0..self.damping.len()).filter(|at| self.damping[*at] > STRONG).collect();
        let mut at = start;
        let rounding = ROUNDING_CHANGE * square(size(start - complex(1.0))) / size(start);
        let trusted = (NEAR + rounding).min(FAR) * size(start);
        let unknowns = modes + strong.len();
        let mut shape = DVector::from_fn(unknowns, |row, _| {
            complex(if row < modes { 1.0 + 0.1 * (row % 7) as f64 } else { 0.0 })
        });
        for _ in 0..CORRECTIONS {
            let beside = at * (1.0 + BESIDE);
            let mut matrix = DMatrix::from_element(unknowns, unknowns, complex(0.0));
            matrix.view_mut((0, 0), (modes, modes)).copy_from(&weak.map(|entry| beside * entry));
            for (row, (w, t, sign)) in self.scales.iter().enumerate() {
                matrix[(row, row)] += beside * beside * (t * t) + sign * w * w;
            }
            for (force, damper) in (modes..).zip(&strong) {
                for row in 0..modes {
                    let along = complex(self.directions[(row, *damper)]);
                    (matrix[(row, force)], matrix[(force, row)]) = (along, along);
                }
                matrix[(force, force)] = -complex(1.0) / (beside * self.damping[*damper]);
            }
            let Some(next) = matrix.lu().solve(&shape) else { return at };
            let moving = next.rows(0, modes);
            let largest = moving.iter().map(|value| size(*value)).fold(0.0, f64::max);
            if !(largest.is_finite() && largest > 0.0) {
                return at;
            }
            let next = next / complex(largest);
            let (mut inertia, mut stiffness) = (complex(0.0), complex(0.0));
            for (value, (w, t, sign)) in next.iter().zip(&self.scales) {
                inertia += value * value * (t * t);
                stiffness += value * value * (sign * w * w);
            }
            let moving = next.rows(0, modes).into_owned();
            let resisted = weak.map(complex) * &moving;
            let mut damped =
                moving.iter().zip(resisted.iter()).map(|(a, b)| a * b).sum::<ComplexNumber>();
            for (force, damper) in (modes..).zip(&strong) {
                // The rate of a strong dashpot is computed from its force to avoid cancellation.
                let rate = next[force] / (beside * self.damping[*damper]);
                damped += rate * rate * self.damping[*damper];
            }
            let root = root(damped * damped - inertia * stiffness * 4.0);
            let [sum, difference] = [damped + root, damped - root];
            let sum = if size(sum) > size(difference) { sum } else { difference };
            let nearest = [-sum / (inertia * 2.0), -stiffness * 2.0 / sum];
            let nearest = match size(nearest[0] - at) < size(nearest[1] - at) {
                true => nearest[0],
                false => nearest[1],
            };
            let moved = size(nearest - start);
            if moved.is_nan() || moved > trusted {
                return start;
            }
            at = nearest;
            shape = next;
            shape.rows_mut(modes, strong.len()).fill(complex(0.0));
        }
        at
    }
}

fn root(of: ComplexNumber) -> ComplexNumber {
    let size = size(of);
    if size == 0.0 {
        return of;
    }
    let larger = (0.5 * (size + of.re.abs())).sqrt();
    let smaller = 0.5 * of.im.abs() / larger;
    let sign = if of.im < 0.0 { -1.0 } else { 1.0 };
    match of.re >= 0.0 {
        true => ComplexNumber::new(larger, sign * smaller),
        false => ComplexNumber::new(smaller, sign * larger),
    }
}
