//! Verification of pairs of eigenvalue and shape: an estimate of their errors, or a correction with section forces as additional unknowns.

use super::VibrationError;
use super::elastic::{FourVectors, Shapes};
use super::lanczos::Pairs;
use super::pencil::Pencil;
use crate::linalg::{STRIP_WIDTH, SymmetricFactors, products, subtract_combination};

/// Residual at which no further correction is made, because the squared frequency is then accurate to all digits.
const SMALL: f64 = 1e-8;

const MOST_CORRECTIONS: usize = 8;

/// Largest ratio of two successive residuals that allows further corrections. With a larger ratio, corrections no longer help.
const FALLING: f64 = 0.3;

/// Largest ratio of the largest to the smallest eigenvalue for which components of all pairs are removed only from the residual forces.
/// With a larger ratio, these components are also removed from the corrections.
const WIDE: f64 = 1e7;

pub(super) struct RefinedPair {
    pub(super) square: f64,
    /// Square root of the energy of the next correction, divided by that of the shape [-].
    /// The residual bounds the relative error of `ω² + σ`, which is about the square of the residual if no other eigenvalue is near.
    pub(super) residual: f64,
    /// Rounding error of the squared frequency `ω²` due to the rounding of displacements [1/time²].
    pub(super) rounding: f64,
    pub(super) shape: Vec<f64>,
}

/// Corrects the first `count` pairs of a search, with section forces as additional unknowns.
/// Components of all pairs are removed from the residual forces of each correction, because the inverted stiffness would amplify them.
pub(super) fn refine(
    pencil: &Pencil,
    factors: &SymmetricFactors,
    shift: f64,
    pairs: &Pairs,
    count: usize,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<Vec<RefinedPair>, VibrationError> {
    let strips = &pairs.strips[..count.div_ceil(STRIP_WIDTH)];
    each_strip(pencil, shift, strips, &pairs.values, count, goes_on, |all, at, room| {
        all.refine(factors, at, room)
    })
}

pub(super) fn assess(
    pencil: &Pencil,
    shift: f64,
    pairs: &Pairs,
    count: usize,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<Vec<RefinedPair>, VibrationError> {
    each_strip(pencil, shift, &pairs.strips, &pairs.values, count, goes_on, |all, at, room| {
        all.assess(at, room)
    })
}

fn each_strip(
    pencil: &Pencil,
    shift: f64,
    strips: &[Vec<FourVectors>],
    values: &[f64],
    count: usize,
    goes_on: &mut dyn FnMut() -> bool,
    make_sure: impl Fn(&OtherPairs<'_>, usize, &mut Shapes) -> [RefinedPair; STRIP_WIDTH],
) -> Result<Vec<RefinedPair>, VibrationError> {
    let momenta: Vec<Vec<FourVectors>> =
        strips.iter().map(|strip| pencil.right_hand_times(strip)).collect();
    let all = OtherPairs { pencil, shift, strips, momenta: &momenta, values };
    let mut room = pencil.elastic.room(pencil.length());
    let mut sure = Vec::with_capacity(count + STRIP_WIDTH);
    for at in 0..count.div_ceil(STRIP_WIDTH) {
        if !goes_on() {
            return Err(VibrationError::Interrupted);
        }
        sure.extend(make_sure(&all, at, &mut room));
    }
    sure.truncate(count);
    Ok(sure)
}

struct OtherPairs<'a> {
    pencil: &'a Pencil,
    shift: f64,
    strips: &'a [Vec<FourVectors>],
    momenta: &'a [Vec<FourVectors>],
    values: &'a [f64],
}

impl OtherPairs<'_> {
    /// Squared frequencies of the four vectors of the strip with index `at`, computed from the eigenvalues; zero for unused vectors.
    fn squares(&self, at: usize) -> FourVectors {
        std::array::from_fn(|lane| {
            let value = self.values.get(STRIP_WIDTH * at + lane).copied();
            value.map_or(0.0, |value| 1.0 / value - self.shift)
        })
    }

    fn assess(&self, at: usize, shapes: &mut Shapes) -> [RefinedPair; STRIP_WIDTH] {
        let energies = self.pencil.elastic.begin(&self.strips[at], shapes);
        let mut imbalance = self.momenta[at].clone();
        let kinetic = self.kinetic(shapes, &imbalance);
        let squares = squares_of(&energies.double_energy, &kinetic);
        subtract_restoring(&mut imbalance, &squares, shapes);
        let of_others = self.remove_other_pairs(&mut imbalance, &squares);
        let residuals = std::array::from_fn(|lane| {
            (of_others[lane] / (kinetic[lane] * (squares[lane] + self.shift))).sqrt()
        });
        shapes.scale(&scale_of(&kinetic));
        self.is_certain(shapes, &squares, &residuals)
    }

    fn kinetic(&self, shapes: &Shapes, momenta: &[FourVectors]) -> FourVectors {
        let mut kinetic = [0.0; STRIP_WIDTH];
        for (x, m) in shapes.movements.iter().zip(momenta) {
            for ((kinetic, x), m) in kinetic.iter_mut().zip(x).zip(m) {
                *kinetic += x * m;
            }
        }
        kinetic
    }

    fn is_certain(
        &self,
        shapes: &Shapes,
        squares: &FourVectors,
        residuals: &FourVectors,
    ) -> [RefinedPair; STRIP_WIDTH] {
        let rounding = self.pencil.elastic.rounding_of(&shapes.movements);
        std::array::from_fn(|lane| RefinedPair {
            square: squares[lane],
            residual: residuals[lane],
            rounding: rounding[lane],
            shape: shapes.movements[..self.pencil.size()].iter().map(|x| x[lane]).collect(),
        })
    }

    fn refine(
        &self,
        factors: &SymmetricFactors,
        at: usize,
        shapes: &mut Shapes,
    ) -> [RefinedPair; STRIP_WIDTH] {
        let Self { pencil, shift, .. } = *self;
        pencil.elastic.begin(&self.strips[at], shapes);
        let mut momenta = self.momenta[at].clone();
        let mut squares = self.squares(at);
        let mut residuals = [f64::INFINITY; STRIP_WIDTH];
        let (mut correction, mut old) = (momenta.clone(), momenta.clone());
        for pass in 0..MOST_CORRECTIONS {
            correction.copy_from_slice(&momenta);
            subtract_restoring(&mut correction, &squares, shapes);
            let of_others = self.remove_other_pairs(&mut correction, &squares);
            factors.solve(&mut correction);
            if self.is_wide() {
                self.clean(&mut correction);
            }
            let energies = pencil.elastic.correct(shapes, &correction);
            std::mem::swap(&mut old, &mut momenta);
            pencil.right_hand_matrix.times(&shapes.movements, &mut momenta);
            let kinetic = self.kinetic(shapes, &momenta);
            let mut changed = [0.0; STRIP_WIDTH];
            for ((m, old), by) in momenta.iter().zip(&old).zip(&correction) {
                for lane in 0..STRIP_WIDTH {
                    changed[lane] += by[lane] * (m[lane] - old[lane]);
                }
            }
            let before = residuals;
            for lane in 0..STRIP_WIDTH {
                let change = energies.correction[lane] + shift * changed[lane] + of_others[lane];
                residuals[lane] = (change.abs() / (squares[lane] + shift)).sqrt();
            }
            squares = squares_of(&energies.double_energy, &kinetic);
            let scale = scale_of(&kinetic);
            shapes.scale(&scale);
            for row in &mut momenta {
                row.iter_mut().zip(&scale).for_each(|(entry, factor)| *entry *= factor);
            }
            // At least two corrections are made, because the first residual contains the rounding errors of the displacements.
            let is_done = (0..STRIP_WIDTH).all(|lane| {
                residuals[lane].is_nan()
                    || residuals[lane] <= SMALL
                    || residuals[lane] > FALLING * before[lane]
            });
            if pass > 0 && is_done {
                break;
            }
        }
        self.is_certain(shapes, &squares, &residuals)
    }

    fn remove_other_pairs(
        &self,
        imbalance: &mut [FourVectors],
        squares: &FourVectors,
    ) -> FourVectors {
        let mut left = [0.0; STRIP_WIDTH];
        for (at, (strip, momenta)) in self.strips.iter().zip(self.momenta).enumerate() {
            let parts = products(strip, imbalance);
            subtract_combination(momenta, &parts, imbalance);
            for (row, value) in parts.iter().zip(self.values.iter().skip(STRIP_WIDTH * at)) {
                for ((left, part), square) in left.iter_mut().zip(row).zip(squares) {
                    *left += value.min(1.0 / (square + self.shift)) * part * part;
                }
            }
        }
        left
    }

    fn is_wide(&self) -> bool {
        let count = self.values.len().min(STRIP_WIDTH * self.strips.len());
        self.values[0] > WIDE * self.values[count - 1]
    }

    fn clean(&self, movements: &mut [FourVectors]) {
        for (strip, momenta) in self.strips.iter().zip(self.momenta) {
            let parts = products(momenta, movements);
            subtract_combination(strip, &parts, movements);
        }
    }
}

/// Replaces `M φ` in `r` by the residual force `ω² M φ - K φ` of each shape `φ`.
fn subtract_restoring(r: &mut [FourVectors], squares: &FourVectors, shapes: &Shapes) {
    for (r, resisting) in r.iter_mut().zip(&shapes.internal_forces) {
        for ((r, resisting), square) in r.iter_mut().zip(resisting).zip(squares) {
            *r = square * *r - resisting;
        }
    }
}

fn squares_of(energies: &FourVectors, kinetic: &FourVectors) -> FourVectors {
    std::array::from_fn(
        |lane| if kinetic[lane] > 0.0 { energies[lane] / kinetic[lane] } else { 0.0 },
    )
}

fn scale_of(kinetic: &FourVectors) -> FourVectors {
    kinetic.map(|kinetic| if kinetic > 0.0 { 1.0 / kinetic.sqrt() } else { 0.0 })
}
