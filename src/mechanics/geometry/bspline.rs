//! Values and derivatives of B-splines on one span.

use super::values::BasisValues;
use super::{KnotVector, Span};

/// Nonzero B-splines on `span` of `knots` at `xi`, with all derivatives. Outside the span, their polynomials are extended.
///
/// The functions and their derivatives follow from the splines of one degree less (The NURBS Book, equations 2.5 and 2.7).
pub(super) fn evaluate(knots: &KnotVector, span: &Span, xi: f64) -> BasisValues {
    let mut basis = BasisValues::zeros(span.first, knots.degree());
    fill((knots, knots.degree()), span, xi, basis.rows_mut());
    basis
}

#[inline(always)]
pub(super) fn fill<const WIDTH: usize>(
    (knots, degree): (&KnotVector, usize),
    span: &Span,
    xi: f64,
    rows: &mut [[f64; WIDTH]],
) {
    let most = rows.len() - 1;
    rows[0][0] = 1.0;
    let local = &knots.knots()[span.first + 1..=span.first + 2 * degree];
    for q in 1..=degree {
        let supports = local[degree - q..degree]
            .iter()
            .zip(&local[degree..])
            .map(|(&start, &end)| (start, end));
        for order in (1..=q.min(most)).rev() {
            rows[order] = differentiate(&rows[order - 1], q, supports.clone());
        }
        rows[0] = raise(&rows[0], xi, supports);
    }
}

#[inline(always)]
fn raise<const WIDTH: usize>(
    lower: &[f64; WIDTH],
    xi: f64,
    supports: impl Iterator<Item = (f64, f64)>,
) -> [f64; WIDTH] {
    let mut higher = [0.0; WIDTH];
    for (j, (value, (start, end))) in lower.iter().zip(supports).enumerate() {
        // Each quotient is computed before it is multiplied by `value`, because it is then exactly 0 or 1 at an end of the span.
        higher[j] += (end - xi) / (end - start) * value;
        higher[j + 1] += (xi - start) / (end - start) * value;
    }
    higher
}

#[inline(always)]
fn differentiate<const WIDTH: usize>(
    lower: &[f64; WIDTH],
    q: usize,
    supports: impl Iterator<Item = (f64, f64)>,
) -> [f64; WIDTH] {
    let mut higher = [0.0; WIDTH];
    for (j, (value, (start, end))) in lower.iter().zip(supports).enumerate() {
        let share = q as f64 * value / (end - start);
        higher[j] -= share;
        higher[j + 1] += share;
    }
    higher
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::MAX_DEGREE;

    #[test]
    fn single_span_has_the_bernstein_polynomials() {
        let knots = KnotVector::uniform(1, 3, 2).unwrap();
        let basis = evaluate(&knots, &knots.spans()[0], 0.25);
        assert_eq!(basis.values(), [27.0, 27.0, 9.0, 1.0].map(|n| n / 64.0));
        assert_eq!(basis.slopes(), [-27.0, 9.0, 15.0, 3.0].map(|n| n / 16.0));
        assert_eq!(basis.derivatives(2), [4.5, -7.5, 1.5, 1.5]);
        assert_eq!(basis.derivatives(3), [-6.0, 18.0, -18.0, 6.0]);
    }

    #[test]
    fn nurbs_book_example_is_reproduced() {
        // Examples 2.3 and 2.4 of The NURBS Book: degree 2, parameter ξ = 5/2.
        let all = vec![0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 5.0, 5.0, 5.0];
        let knots = KnotVector::new(2, all).unwrap();
        let basis = evaluate(&knots, &knots.spans()[2], 2.5);
        assert_eq!(basis.first, 2);
        assert_eq!(basis.values(), [1.0 / 8.0, 6.0 / 8.0, 1.0 / 8.0]);
        assert_eq!(basis.slopes(), [-0.5, 0.0, 0.5]);
        assert_eq!(basis.derivatives(2), [1.0, -2.0, 1.0]);
    }

    #[test]
    fn uniform_splines_of_every_degree_have_their_binomial_top_derivative() {
        for degree in 1..=MAX_DEGREE {
            let spans = 2 * degree + 1;
            let knots = KnotVector::uniform(spans, degree, degree - 1).unwrap();
            let basis = evaluate(&knots, &knots.spans()[degree], 0.5);
            let scale = (spans as f64).powi(degree as i32);
            let mut binomial = 1.0;
            for (j, top) in basis.derivatives(degree).iter().enumerate() {
                let sign = if (degree - j) % 2 == 0 { 1.0 } else { -1.0 };
                assert!(
                    (top / scale - sign * binomial).abs() < 1e-10 * binomial,
                    "degree {degree}, function {j}"
                );
                binomial *= (degree - j) as f64 / (j + 1) as f64;
            }
        }
    }

    #[test]
    fn only_one_function_is_nonzero_at_each_end() {
        let knots = KnotVector::new(2, vec![0.1, 0.1, 0.1, 0.3, 0.3, 0.7, 0.7, 0.7]).unwrap();
        let (first, last) = (knots.spans()[0], knots.spans()[1]);
        assert_eq!(evaluate(&knots, &first, 0.1).values(), [1.0, 0.0, 0.0]);
        assert_eq!(evaluate(&knots, &first, 0.3).values(), [0.0, 0.0, 1.0]);
        assert_eq!(evaluate(&knots, &last, 0.3).values(), [1.0, 0.0, 0.0]);
        assert_eq!(evaluate(&knots, &last, 0.7).values(), [0.0, 0.0, 1.0]);
    }
}
