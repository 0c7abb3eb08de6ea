//! Search for the lowest modes: choice of a shift, computation of pairs of eigenvalue and shape, and a count of eigenvalues as a check.

use super::VibrationError;
use super::dense::all_pairs;
use super::elastic::FourVectors;
use super::lanczos::{Lanczos, Pairs, SymmetricOperator};
use super::modes::Mode;
use super::pencil::Pencil;
use super::refinement::{RefinedPair, assess, refine};
use crate::linalg::{STRIP_WIDTH, SymmetricFactors, VectorStrip};

/// Largest number of unknowns for which all modes are computed together.
const SMALL: usize = 240;

/// Largest number of unknowns for which all modes are computed together if the number of requested modes is at least a quarter of the unknowns.
const MEDIUM: usize = 2000;

/// Peak memory for the computation of all modes, as a multiple of the memory of a dense stiffness matrix.
const DENSE_COPIES: usize = 5;

/// Largest number of times that the shift is multiplied by a hundred, for unstable configurations.
const MOST_SHIFTS: usize = 14;

/// Largest residual of an accepted pair of eigenvalue and shape.
pub(super) const LARGEST_RESIDUAL: f64 = 1e-6;

/// Largest relative difference of two squared frequencies plus shift that count as equal in the check for missing modes.
const EQUAL: f64 = 1e-6;

/// Largest squared frequency that counts as zero, as a multiple of its rounding error.
const ROUNDING: f64 = 64.0;

/// Largest squared frequency that counts as zero, as a fraction of the shift. Rounding gives smaller values for rigid motions.
const HIDDEN: f64 = 1e-14;

/// Largest ratio of the shift to the lowest nonzero squared frequency that makes a second search with a smaller shift unnecessary.
const LARGEST_SHIFT: f64 = 1e4;

/// Smallest ratio of the shift to the lowest nonzero squared frequency that makes a second search with a larger shift unnecessary.
/// The limit `SMALLEST_SHIFT` applies only if some squared frequencies are zero.
const SMALLEST_SHIFT: f64 = 1e-6;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ModeSearch {
    All,
    Lowest,
}

impl ModeSearch {
    pub(super) fn of(unknowns: usize, count: usize) -> Self {
        let is_large = unknowns > MEDIUM || (unknowns > SMALL && 4 * count < unknowns);
        if is_large { Self::Lowest } else { Self::All }
    }
}

pub(super) fn is_small(unknowns: usize) -> bool {
    unknowns <= SMALL
}

pub(super) fn numbers(unknowns: usize, count: usize) -> usize {
    match ModeSearch::of(unknowns, count) {
        ModeSearch::All => DENSE_COPIES * unknowns * unknowns,
        ModeSearch::Lowest => unknowns * (2 * Lanczos::width(count) + 3 * count + 16 * STRIP_WIDTH),
    }
}

pub(super) fn lowest(
    pencil: &Pencil,
    count: usize,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<Vec<Mode>, VibrationError> {
    let (shift, factors) = definite(pencil, pencil.scale)?;
    let found = with_shift(pencil, shift, &factors, count, goes_on)?;
    let better = better_shift(&found, shift);
    let found = match better.and_then(|better| Some((better, pencil.factors(better)?))) {
        None => found,
        Some((shift, factors)) => match with_shift(pencil, shift, &factors, count, goes_on) {
            Err(VibrationError::Interrupted) => return Err(VibrationError::Interrupted),
            // If the search with the better shift fails, the modes from the first shift are returned. Their residuals show their accuracy.
            Err(_) => found,
            Ok(finer) => finer,
        },
    };
    accept(found)
}

fn definite(pencil: &Pencil, mut shift: f64) -> Result<(f64, SymmetricFactors), VibrationError> {
    for _ in 0..=MOST_SHIFTS {
        if let Some(factors) = pencil.factors(shift) {
            return Ok((shift, factors));
        }
        shift *= 100.0;
    }
    Err(VibrationError::Indefinite)
}

fn with_shift(
    pencil: &Pencil,
    shift: f64,
    factors: &SymmetricFactors,
    count: usize,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<Vec<Mode>, VibrationError> {
    let sure = match ModeSearch::of(pencil.size(), count) {
        ModeSearch::All => {
            let pairs = all_pairs(pencil, factors, goes_on)?;
            let available = pairs.values.len();
            if available < count {
                return Err(VibrationError::Count { requested: count, available });
            }
            assess(pencil, shift, &pairs, count, goes_on)?
        }
        ModeSearch::Lowest => {
            let operator = ShiftedInverse { pencil, factors };
            let pairs = counted_pairs(pencil, shift, &operator, count, goes_on)?;
            refine(pencil, factors, shift, &pairs, count, goes_on)?
        }
    };
    let mut modes: Vec<Mode> = sure.into_iter().map(|pair| mode_of(pair, shift)).collect();
    modes.sort_by(|a, b| a.square.total_cmp(&b.square));
    Ok(modes)
}

struct ShiftedInverse<'a> {
    pencil: &'a Pencil,
    factors: &'a SymmetricFactors,
}

impl SymmetricOperator for ShiftedInverse<'_> {
    fn size(&self) -> usize {
        self.pencil.size()
    }

    fn zeros(&self) -> Vec<FourVectors> {
        self.pencil.zeros()
    }

    fn metric_times(&self, x: &VectorStrip, product: &mut VectorStrip) {
        self.pencil.right_hand_matrix.times(x, product);
    }

    fn images(&self, momenta: &mut VectorStrip) {
        self.factors.solve(momenta);
    }
}

pub(super) fn counted_pairs(
    pencil: &Pencil,
    shift: f64,
    operator: &dyn SymmetricOperator,
    count: usize,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<Pairs, VibrationError> {
    let mut search = Lanczos::new(operator);
    let mut wanted = count;
    loop {
        let pairs = search.find_pairs(wanted, goes_on)?;
        // The search may have missed pairs with the same eigenvalue as the last requested pair.
        // The search must have found all pairs with smaller frequencies than the last requested pair.
        let below = 1.0 / pairs.values[count - 1] * (1.0 - EQUAL) - shift;
        let found = pairs.values.iter().filter(|value| 1.0 / *value - shift < below).count();
        match pencil.eigenvalues_below(below) {
            None => return Err(VibrationError::Uncounted),
            Some(there) if there <= found => return Ok(pairs),
            Some(there) => wanted = there.max(count),
        }
        search.continue_with_random(pairs);
    }
}

fn mode_of(pair: RefinedPair, shift: f64) -> Mode {
    let RefinedPair { square, residual, rounding, shape } = pair;
    let hidden = (residual * residual + HIDDEN) * (square.abs() + shift);
    let rounding = ROUNDING * rounding + hidden;
    let square = if square.abs() <= rounding { 0.0 } else { square };
    Mode { square, rounding, residual, shape }
}

fn better_shift(modes: &[Mode], shift: f64) -> Option<f64> {
    let lowest = modes.iter().map(|mode| mode.square).find(|square| *square != 0.0)?;
    let is_large = shift > LARGEST_SHIFT * lowest.abs();
    let is_small = shift < SMALLEST_SHIFT * lowest && modes[0].is_free();
    match lowest {
        lowest if is_large && lowest > 0.0 => Some(lowest),
        lowest if is_large => Some(-4.0 * lowest),
        lowest if is_small => Some(0.01 * lowest),
        _ => None,
    }
}

fn accept(modes: Vec<Mode>) -> Result<Vec<Mode>, VibrationError> {
    let bad = |mode: &Mode| !(mode.residual <= LARGEST_RESIDUAL && mode.square.is_finite());
    match modes.iter().position(bad) {
        None => Ok(modes),
        Some(at) => Err(VibrationError::BelowRounding { modes: at, residual: modes[at].residual }),
    }
}
