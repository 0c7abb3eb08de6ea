//! Pairs made sure: each is corrected with its section forces as unknowns, and what the last correction changes is its residual.

use super::VibrationError;
use super::elastic::{FourVectors, Shapes};
use super::lanczos::Pairs;
use super::pencil::Pencil;
use crate::linalg::{STRIP_WIDTH, SymmetricFactors, products, subtract_combination};

/// A residual that is small enough: the square is then known to all digits.
const SMALL: f64 = 1e-8;

/// Most corrections.
const MOST_CORRECTIONS: usize = 8;

/// A residual that falls by less does not fall any more.
const FALLING: f64 = 0.3;

/// Pairs whose `μ` differ by more are far apart.
const WIDE: f64 = 1e7;

/// A pair of frequency and shape that was made sure.
pub(super) struct RefinedPair {
    pub(super) square: f64,
    /// The part of `ω² + σ` by which it may be wrong at most, rounding of the pair itself set aside [-].
    pub(super) residual: f64,
    /// What rounding of the movements may add to the square `ω²` of the pair [1/time²].
    pub(super) rounding: f64,
    pub(super) shape: Vec<f64>,
}

/// Corrects the first `count` pairs of a search for modes.
///
/// With the pair `(x, n)` of movements and section forces, `ω²` of its energies and `r = ω² M x - Bᵀ (n + k m) - K_g x`, the correction is `δ = A⁻¹ r`,
/// which takes `x` to `(ω² + σ) A⁻¹ M x`. What other pairs have in it is left out of `δ` and counted in the residual: inverted
/// stiffness would let a trace of a low one outgrow a high one.
///
/// # Errors
/// When the refinement is stopped.
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

/// The residuals of the first `count` of all pairs that there are. Nothing is outside of all, and so nothing is left to be corrected.
///
/// # Errors
/// When the assessment is stopped.
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
        strips.iter().map(|strip| pencil.inertia_times(strip)).collect();
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
    /// `μ`
    values: &'a [f64],
}

impl OtherPairs<'_> {
    /// The squares of a strip as the values have them; zero where there is none.
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
        let squares = squares_of(&energies.whole, &kinetic);
        subtract_resisting(&mut imbalance, &squares, shapes);
        let of_others = self.without_others(&mut imbalance, &squares);
        let residuals = std::array::from_fn(|lane| {
            (of_others[lane] / (kinetic[lane] * (squares[lane] + self.shift))).sqrt()
        });
        shapes.scale(&scale_of(&kinetic));
        self.sure(shapes, &squares, &residuals)
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

    fn sure(
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
            subtract_resisting(&mut correction, &squares, shapes);
            let of_others = self.without_others(&mut correction, &squares);
            factors.solve(&mut correction);
            if self.is_wide() {
                self.clean(&mut correction);
            }
            let energies = pencil.elastic.correct(shapes, &correction);
            std::mem::swap(&mut old, &mut momenta);
            pencil.inertia.times(&shapes.movements, &mut momenta);
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
            squares = squares_of(&energies.whole, &kinetic);
            let scale = scale_of(&kinetic);
            shapes.scale(&scale);
            for row in &mut momenta {
                row.iter_mut().zip(&scale).for_each(|(entry, factor)| *entry *= factor);
            }
            // The first correction takes away what the movements were rounded by, and says nothing on the pair.
            let is_done = (0..STRIP_WIDTH).all(|lane| {
                residuals[lane].is_nan()
                    || residuals[lane] <= SMALL
                    || residuals[lane] > FALLING * before[lane]
            });
            if pass > 0 && is_done {
                break;
            }
        }
        self.sure(shapes, &squares, &residuals)
    }

    /// Takes what all pairs have in imbalances out of them; what that leaves of the residuals, to be compared with `ω² + σ`.
    ///
    /// In a pair that is below, an imbalance counts by its size alone: inverted stiffness would make much of what does no harm.
    fn without_others(&self, imbalance: &mut [FourVectors], squares: &FourVectors) -> FourVectors {
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

    /// Whether the highest pair is so far above the lowest that solving blurs the one by the rounding of the other.
    fn is_wide(&self) -> bool {
        let count = self.values.len().min(STRIP_WIDTH * self.strips.len());
        self.values[0] > WIDE * self.values[count - 1]
    }

    /// Takes all pairs out of movements.
    fn clean(&self, movements: &mut [FourVectors]) {
        for (strip, momenta) in self.strips.iter().zip(self.momenta) {
            let parts = products(momenta, movements);
            subtract_combination(strip, &parts, movements);
        }
    }
}

/// `r ← ω² r - Bᵀ (n + k m) - K_g x`
fn subtract_resisting(r: &mut [FourVectors], squares: &FourVectors, shapes: &Shapes) {
    for (r, resisting) in r.iter_mut().zip(&shapes.resisting) {
        for ((r, resisting), square) in r.iter_mut().zip(resisting).zip(squares) {
            *r = square * *r - resisting;
        }
    }
}

/// A lane of zeros stands for no pair.
fn squares_of(energies: &FourVectors, kinetic: &FourVectors) -> FourVectors {
    std::array::from_fn(
        |lane| if kinetic[lane] > 0.0 { energies[lane] / kinetic[lane] } else { 0.0 },
    )
}

/// What makes `xᵀ M x = 1`.
fn scale_of(kinetic: &FourVectors) -> FourVectors {
    kinetic.map(|kinetic| if kinetic > 0.0 { 1.0 / kinetic.sqrt() } else { 0.0 })
}
