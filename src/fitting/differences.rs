//! Derivatives by finite differences.

use nalgebra::{DMatrix, DVector};

use super::{Evaluate, Evaluation, SearchRange};

/// Default perturbation, as a fraction of the size of a parameter.
/// With this default, truncation and noise of runs contribute about equally to the error of central differences, 1e-8 each.
pub const RELATIVE_STEP: f64 = 1e-4;

enum Stencil {
    Central(f64),
    OneSided(f64),
}

impl Stencil {
    fn of(range: SearchRange, x: f64, relative: f64) -> Self {
        // The step is limited so that the far point of a one-sided difference, two steps away, lies between the bounds.
        let step = (relative * range.size(x)).min(0.25 * (range.high - range.low));
        match (x - step >= range.low, x + step <= range.high) {
            (true, true) => Self::Central(step),
            (false, _) => Self::OneSided(step),
            (true, false) => Self::OneSided(-step),
        }
    }

    fn places(&self) -> [f64; 2] {
        match self {
            Self::Central(step) => [*step, -step],
            Self::OneSided(step) => [*step, 2.0 * step],
        }
    }

    fn slope(&self, here: f64, [a, b]: [f64; 2]) -> f64 {
        match self {
            Self::Central(step) => (a - b) / (2.0 * step),
            Self::OneSided(step) => (4.0 * a - 3.0 * here - b) / (2.0 * step),
        }
    }
}

/// Derivatives of all values (rows) with respect to all parameters (columns), by finite differences that are accurate to second order.
/// All points, two per parameter, are requested in one call of `evaluate`, so that they can run in parallel.
/// `here` contains the values at the point `x`.
///
/// # Errors
/// Returns the error of `evaluate`. The inner `Err` is the reason why a run failed.
pub fn derivatives<E>(
    ranges: &[SearchRange],
    (x, here): (&[f64], &DVector<f64>),
    relative: f64,
    evaluate: &mut Evaluate<'_, E>,
) -> Result<Result<DMatrix<f64>, String>, E> {
    let stencils: Vec<Stencil> =
        ranges.iter().zip(x).map(|(range, x)| Stencil::of(*range, *x, relative)).collect();
    let moved = |(own, stencil): (usize, &Stencil)| {
        stencil.places().map(|far| {
            let mut point = x.to_vec();
            point[own] += far;
            point
        })
    };
    let points: Vec<Vec<f64>> = stencils.iter().enumerate().flat_map(moved).collect();
    let found: Result<Vec<Vec<f64>>, String> =
        evaluate(&points)?.into_iter().collect::<Result<_, _>>();
    let Ok(found) = found else { return Ok(found.map(|_| DMatrix::zeros(0, 0))) };
    if let Some(other) = found.iter().find(|values| values.len() != here.len()) {
        return Ok(Err(format!("it returned {} values and then {}", here.len(), other.len())));
    }
    Ok(Ok(DMatrix::from_fn(here.len(), x.len(), |row, own| {
        stencils[own].slope(here[row], [found[2 * own][row], found[2 * own + 1][row]])
    })))
}

pub fn only(found: Vec<Evaluation>) -> Evaluation {
    found.into_iter().next().unwrap_or_else(|| Err("nothing was found".into()))
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;
    use crate::elementary::exp;

    #[test]
    fn difference_derivatives_have_eight_digits_also_at_bounds() {
        let mut asked = 0;
        let mut evaluate = |points: &[Vec<f64>]| -> Result<Vec<Evaluation>, Infallible> {
            asked += points.len();
            Ok(points.iter().map(|x| Ok(vec![exp(x[0]), x[0] * x[1] * x[1]])).collect())
        };
        let ranges = [
            SearchRange { start: 1.0, low: 1.0, high: 2.0 },
            SearchRange { start: 3.0, low: 0.0, high: f64::INFINITY },
        ];
        let here = DVector::from_vec(vec![exp(1.0), 9.0]);
        let Ok(found) = derivatives(&ranges, (&[1.0, 3.0], &here), RELATIVE_STEP, &mut evaluate);
        let found = found.unwrap();
        let known = [[exp(1.0), 0.0], [9.0, 6.0]];
        for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let error = (found[(row, column)] - known[row][column]).abs();
            assert!(error < 4e-8 * known[row][column].max(1.0), "{row} {column}: {error}");
        }
        assert_eq!(asked, 4);
    }
}
