//! Checks derivatives that a function returns against finite differences.
//! Returned derivatives are wrong if they miss a dependence on a parameter, for example through rounding or a branch.

use super::SearchRange;

/// Largest perturbation of a parameter in the check, as a fraction of the size of the parameter.
const DISTANCE: f64 = 1e-4;

const OFF: f64 = 0.02;

/// Deviation that is attributed to rounding, as a fraction of the values.
const ROUNDING: f64 = 1e-7;

pub const REJECTED_DERIVATIVES: &str =
    "the derivatives of the runs differ from finite differences of their results";

pub fn test_points(ranges: &[SearchRange], x: &[f64]) -> [Vec<f64>; 2] {
    let moved = |sign: f64| {
        let parameters = x.iter().zip(ranges).enumerate();
        let moved = parameters.map(|(at, (x, range))| {
            // Each parameter changes by a different fraction of its size, so that errors of the derivatives cannot cancel.
            let part = 0.5 + 0.5 * (1.0 + at as f64).recip();
            range.clip(x + sign * part * DISTANCE * range.size(*x))
        });
        moved.collect()
    };
    [moved(-1.0), moved(1.0)]
}

/// Returns true if derivatives agree with the results at two test points on both sides of a point.
/// `values` contains the results at the two test points. `here` contains the results at the point between them.
/// `change` returns the difference between the two results with a given index that the derivatives predict.
pub fn matches_derivatives(
    values: [&[f64]; 2],
    here: &[f64],
    change: impl Fn(usize) -> f64,
) -> bool {
    let [low, high] = values;
    if low.len() != here.len() || high.len() != here.len() {
        return false;
    }
    let norm =
        |of: &dyn Fn(usize) -> f64| (0..here.len()).map(|at| of(at) * of(at)).sum::<f64>().sqrt();
    let difference = norm(&|at| high[at] - low[at]);
    let promised = norm(&change);
    let off = norm(&|at| high[at] - low[at] - change(at));
    let aside = norm(&|at| 0.5 * (low[at] + high[at]) - here[at]);
    let floor = ROUNDING * norm(&|at| here[at]);
    // Values that are not finite do not prove wrong derivatives, so the negated comparison is used, which is true for NaN.
    !(off > OFF * difference.max(promised) + floor || aside > difference.max(promised) + floor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn test_points_lie_on_both_sides_within_bounds() {
        let range = |start, low, high| SearchRange { start, low, high };
        let ranges = [range(1.0, 0.0, 10.0), range(0.0, 0.0, 1.0)];
        let [low, high] = test_points(&ranges, &[1.0, 0.0]);
        assert!(low[0] < 1.0 && high[0] > 1.0 && low[1] == 0.0 && high[1] > 0.0);
    }

    #[test]
    fn wrong_values_derivatives_and_branches_are_detected() {
        let square = |x: f64| [x * x, 3.0 * x];
        let (x, h) = (2.0, 1e-4);
        let check = |here: [f64; 2], slopes: [f64; 2]| {
            matches_derivatives([&square(x - h), &square(x + h)], &here, |at| 2.0 * h * slopes[at])
        };
        assert!(check(square(x), [4.0, 3.0]));
        assert!(!check(square(x), [0.0, 3.0]), "a derivative is missing");
        assert!(!check([8.0, 12.0], [4.0, 3.0]), "other values");
        assert!(!check(square(x), [8.0, 6.0]), "another branch");
    }
}
