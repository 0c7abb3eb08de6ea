//! Quadratic eigenvalue problem of damped vibrations.
//!
//! The damping may have any strength. Decay rates may differ by a factor of 10¹⁴.
//! The eigenvalues of a single shifted problem ([`Resolvent`]) are accurate only for magnitudes near the shift.
//! The search therefore solves several shifted problems with increasing positive real shifts.

use nalgebra::{Complex, DMatrix};

use super::VibrationError;
use super::resolvent::Resolvent;
use crate::elementary::hypot;
use crate::geometry::larger;

/// Largest magnitude of an eigenvalue that is computed accurately, as a multiple of the shift.
const LARGEST_RATIO: f64 = 1e6;

/// Largest factor between two successive shifts.
const FARTHEST: f64 = 1e12;

/// Largest displacement of an unrestrained mode at a damper that counts as zero, as a fraction of the largest displacement of all modes.
const ROUNDING: f64 = 1e-13;

pub(super) type ComplexNumber = Complex<f64>;

pub(super) fn size(at: ComplexNumber) -> f64 {
    hypot(at.re, at.im)
}

pub(super) struct Quadratic {
    /// Squared frequencies of the undamped modes [1/time²].
    pub(super) squares: Vec<f64>,
    /// Matrix with a row for each mode and a column for each damped rate [1/time^½].
    /// The product of the matrix `dampers` and its transpose is the damping matrix.
    pub(super) dampers: DMatrix<f64>,
}

impl Quadratic {
    pub(super) fn new(squares: Vec<f64>, mut dampers: DMatrix<f64>) -> Self {
        for mut column in dampers.column_iter_mut() {
            let least = ROUNDING * column.amax();
            let free = column.iter_mut().zip(&squares).filter(|(_, square)| **square == 0.0);
            free.filter(|(rate, _)| rate.abs() <= least).for_each(|(rate, _)| *rate = 0.0);
        }
        if dampers.ncols() > dampers.nrows() {
            // The rounding error of the factorisation `Bᵀ = Q R` is small in comparison with every single row of `B`, even a small row.
            // Small rows of `B` must be accurate, because nearly undamped modes depend on the squares of these rows.
            dampers = dampers.transpose().qr().r().transpose();
        }
        Self { squares, dampers }
    }

    fn damping(&self, mode: usize) -> f64 {
        self.dampers.row(mode).norm_squared()
    }

    pub(super) fn is_loose(&self, mode: usize) -> bool {
        self.squares[mode] == 0.0 && self.damping(mode) == 0.0
    }

    /// The `count` eigenvalues of smallest magnitude [1/time]. The eigenvalue with positive imaginary part represents a conjugate pair.
    ///
    /// # Errors
    /// Fails if `count` is zero, there are fewer eigenvalues, or the search does not converge or is stopped.
    pub(super) fn slowest(
        &self,
        count: usize,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Vec<ComplexNumber>, VibrationError> {
        let modes = 0..self.squares.len();
        let free = modes.clone().filter(|mode| self.squares[*mode] == 0.0).count();
        let zeros = free + modes.filter(|mode| self.is_loose(*mode)).count();
        let all = 2 * self.squares.len() - zeros;
        let wanted = if count == 0 { usize::MAX } else { count.saturating_sub(zeros) };
        let (mut known, mut found, mut shift) = (0, 0, self.slowest_shift());
        let mut seen: Vec<(Resolvent, Vec<ComplexNumber>)> = Vec::new();
        while known < all && found < wanted {
            let resolvent = Resolvent::of(self, shift, goes_on)?;
            let numbers = resolvent.numbers()?;
            let reached = match shift >= self.fastest() {
                true => all,
                false => conjugate_pairs(
                    &numbers,
                    numbers.partition_point(|at| size(*at) <= LARGEST_RATIO),
                ),
            };
            if let Some(next) = numbers.get(reached) {
                shift *= size(*next).clamp(LARGEST_RATIO, FARTHEST);
            }
            let new = numbers[known.min(reached)..reached].iter();
            let new: Vec<ComplexNumber> = new.copied().filter(|at| at.im >= 0.0).collect();
            (known, found) = (known.max(reached), found + new.len());
            seen.push((resolvent, new));
        }
        let available = zeros + found;
        if count == 0 || count > available {
            return Err(VibrationError::Count { requested: count, available });
        }
        let moving = seen.iter().flat_map(|(resolvent, numbers)| {
            numbers.iter().map(|at| resolvent.corrected(*at) * resolvent.shift)
        });
        Ok(std::iter::repeat_n(ComplexNumber::new(0.0, 0.0), zeros)
            .chain(moving)
            .take(count)
            .collect())
    }

    /// First shift of the search [1/time]. It is at most slightly larger than the smallest nonzero magnitude of an eigenvalue.
    /// If some modes are unstable, the first shift is at least twice their largest growth rate without damping.
    fn slowest_shift(&self) -> f64 {
        let modes = || self.squares.iter().enumerate();
        let held = modes().filter(|(_, square)| **square != 0.0);
        let compliance: f64 =
            held.clone().map(|(mode, square)| self.damping(mode) / square.abs()).sum();
        let slowest = held.map(|(_, square)| square.abs().sqrt()).fold(f64::INFINITY, f64::min);
        let free =
            modes().filter(|(_, square)| **square == 0.0).map(|(mode, _)| self.damping(mode));
        let free = free.filter(|damping| *damping > 0.0).fold(f64::INFINITY, f64::min);
        let unstable = self.squares.iter().fold(0.0, |most, square| larger(most, -square));
        larger((1.0 / (compliance + 1.0 / slowest)).min(free), 2.0 * unstable.sqrt())
    }

    /// Upper bound of the magnitudes of eigenvalues [1/time].
    fn fastest(&self) -> f64 {
        let vibration = self.squares.iter().fold(0.0, |most, square| larger(most, square.abs()));
        2.0 * vibration.sqrt() + self.dampers.norm_squared()
    }
}

fn conjugate_pairs(numbers: &[ComplexNumber], first: usize) -> usize {
    let numbers = numbers[..first].iter();
    let above = numbers.clone().filter(|at| at.im > 0.0).count();
    first - usize::from(above != numbers.filter(|at| at.im < 0.0).count())
}
