//! Quadrature rules of splines: few points, and weights that leave no error where it matters.

use super::collocation::{Row, solve};
use super::{Basis, Span};

/// The weights with which points integrate the derivative of every function of a run of spans exactly.
///
/// The spans follow each other and are joined smoothly; `points` holds those of each span, from its start on, and all together
/// must be one fewer than the run has functions: the derivatives of splines are splines of one degree and one function less. None if
/// they are more or fewer, lie where no such weights exist, or a weight is not finite.
///
/// Sums of derivatives, `-Σ_(a ≤ b) N'_a`, are positive multiples of the B-splines of the next lower degree, whose collocation matrix is totally
/// positive. (Auricchio, Calabrò, Hughes, Reali & Sangalli, A simple algorithm for obtaining nearly optimal quadrature rules for NURBS-based
/// isogeometric analysis, Comput. Methods Appl. Mech. Eng. 249-252 (2012) 15-27, choose the weights likewise.)
pub fn derivative_weights(basis: &Basis, run: &[Span], points: &[Vec<f64>]) -> Option<Vec<f64>> {
    let (first, last) = (run.first()?, run.last()?);
    let degree = basis.degree();
    let unknowns = last.first + degree - first.first;
    if points.iter().map(Vec::len).sum::<usize>() != unknowns {
        return None;
    }
    let mut rows: Vec<Row<f64>> = (0..unknowns)
        .map(|_| Row { first: 0, entries: Vec::with_capacity(degree + 1), right_side: 0.0 })
        .collect();
    let mut number = 0;
    for (span, points) in run.iter().zip(points) {
        for xi in points {
            let values = basis.evaluate_in(span, *xi);
            let mut sum = 0.0;
            let from = span.first - first.first;
            for (row, slope) in rows[from..from + degree].iter_mut().zip(values.slopes()) {
                sum -= slope;
                if row.entries.is_empty() {
                    row.first = number;
                }
                row.entries.push(sum);
            }
            number += 1;
        }
    }
    // Every point must lie where its own spline is not zero (Schoenberg & Whitney 1953).
    let has_own =
        |(at, row): (usize, &Row<f64>)| (row.first..row.first + row.entries.len()).contains(&at);
    if !rows.iter().enumerate().all(has_own) {
        return None;
    }
    // ∫ N'_a dξ is the difference of N_a between both ends.
    let ends = [(first, first.start, 1.0), (last, last.end, -1.0)];
    for (span, xi, sign) in ends {
        let from = span.first - first.first;
        let values = basis.evaluate_in(span, xi);
        let mut sum = 0.0;
        let mut values = values.values().iter();
        for row in &mut rows[from..] {
            sum += values.next().copied().unwrap_or(0.0);
            row.right_side += sign * sum;
        }
    }
    let weights = solve(rows);
    weights.iter().all(|weight| weight.is_finite()).then_some(weights)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{GaussRule, KnotVector};

    fn graded(spans: usize, degree: usize, ratio: f64) -> Basis {
        let sizes: Vec<f64> = (0..spans).map(|i| ratio.powi(i as i32)).collect();
        let mut breaks = vec![0.0];
        for size in &sizes {
            breaks.push(breaks[breaks.len() - 1] + size);
        }
        let end = breaks[spans];
        let inner = &breaks[1..spans];
        let knots = [vec![0.0; degree + 1], inner.to_vec(), vec![end; degree + 1]].concat();
        Basis::BSpline(KnotVector::new(degree, knots).unwrap())
    }

    /// Gauss points, `(p + 1)/2` in the first and the last span and one in each other.
    fn points(basis: &Basis) -> Vec<Vec<f64>> {
        let spans = basis.spans();
        let last = spans.len() - 1;
        let count = |at: usize| if at == 0 || at == last { basis.degree().div_ceil(2) } else { 1 };
        let of = |(at, span): (usize, &Span)| {
            let rule = GaussRule::new(count(at)).unwrap();
            rule.iter_on(span.start, span.end).map(|(xi, _)| xi).collect()
        };
        spans.iter().enumerate().map(of).collect()
    }

    #[test]
    fn derivatives_of_all_functions_are_integrated_exactly() {
        for (degree, ratio) in [(3, 1.0), (3, 1.3), (3, 0.5), (5, 1.0), (5, 1.2)] {
            let basis = graded(9, degree, ratio);
            let (spans, points) = (basis.spans(), points(&basis));
            let weights = derivative_weights(&basis, &spans, &points).unwrap();
            let mut integrals = vec![0.0; basis.functions()];
            let mut weight = weights.iter();
            for (span, points) in spans.iter().zip(&points) {
                for xi in points {
                    let weight = weight.next().unwrap();
                    let values = basis.evaluate_in(span, *xi);
                    for (at, slope) in values.slopes().iter().enumerate() {
                        integrals[span.first + at] += weight * slope;
                    }
                }
            }
            let (start, end) = (integrals.remove(0), integrals.pop().unwrap());
            assert!((start + 1.0).abs() < 1e-13 && (end - 1.0).abs() < 1e-13, "{start} {end}");
            assert!(integrals.iter().all(|integral| integral.abs() < 1e-13), "{integrals:?}");
            let length: f64 = weights.iter().sum();
            let (from, to) = basis.domain();
            assert!((length / (to - from) - 1.0).abs() < 1e-13);
            assert!(weights.iter().all(|weight| *weight > 0.0), "{degree} {ratio}: {weights:?}");
        }
    }

    #[test]
    fn far_from_the_ends_of_equal_spans_the_weights_are_those_of_the_midpoint_rule() {
        let basis = graded(40, 3, 1.0);
        let weights = derivative_weights(&basis, &basis.spans(), &points(&basis)).unwrap();
        assert!((weights[20] - 1.0).abs() < 1e-12 && (weights[2] - 1.0).abs() > 1e-3);
    }

    #[test]
    fn too_many_points_have_no_such_weights() {
        let basis = graded(4, 3, 1.0);
        let points: Vec<Vec<f64>> = basis.spans().iter().map(|span| vec![span.start]).collect();
        assert_eq!(derivative_weights(&basis, &basis.spans(), &points), None);
        assert_eq!(derivative_weights(&basis, &[], &[]), None);
    }
}
