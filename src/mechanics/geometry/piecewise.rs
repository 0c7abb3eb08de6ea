//! Piecewise polynomials on the spans of a basis.

use super::{GaussRule, Span, larger};
use nalgebra::{DMatrix, DVector};

/// Piecewise polynomial function of the parameter ξ of a basis. It has the same degree on all spans.
#[derive(Debug, Clone)]
pub struct PiecewisePolynomial {
    spans: Vec<(f64, f64)>,
    coefficients: Vec<f64>,
    count: usize,
    rule: Vec<(f64, f64)>,
}

/// Function along a path between two parameters, with its divided difference.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FunctionOnPath {
    /// Value of the function at the start of the path.
    pub start: f64,
    /// Value of the function at the end of the path.
    pub end: f64,
    /// Derivative of the function at the end of the path, as limit from inside the path.
    pub slope: f64,
    /// Divided difference: mean derivative of the function over the path, accurate to rounding for paths of any length.
    pub difference: f64,
    /// Derivative of the divided difference with respect to the end of the path, for a fixed start.
    pub change: f64,
}

/// Coefficients, on each span, of the polynomials that interpolate `N` functions at the Gauss points of the span.
fn interpolated<const N: usize>(
    spans: &[Span],
    points: usize,
    mut functions: impl FnMut(usize, &Span, f64) -> [f64; N],
) -> Vec<[Vec<f64>; N]> {
    let places: Vec<f64> = GaussRule::legendre(points).iter_on(-1.0, 1.0).map(|(t, _)| t).collect();
    let power = |row: usize, k: usize| std::iter::repeat_n(places[row], k).product();
    let powers = DMatrix::from_fn(points, points, power).lu();
    let on_span = |(at, span): (usize, &Span)| {
        let half = 0.5 * (span.end - span.start);
        let samples = places.iter().map(|t| functions(at, span, span.start + half * (1.0 + t)));
        let samples: Vec<[f64; N]> = samples.collect();
        std::array::from_fn(|entry| {
            let values = samples.iter().map(|sample| sample[entry]);
            let values = DVector::from_iterator(points, values);
            powers.solve(&values).unwrap_or(values).iter().copied().collect()
        })
    };
    spans.iter().enumerate().map(on_span).collect()
}

impl PiecewisePolynomial {
    /// Creates a function from a row of coefficients for each span.
    /// On a span, the function is `Σ c_k t^k` with the coefficients `c_k`, where `t` runs from -1 to 1.
    pub fn new(spans: &[Span], rows: &[Vec<f64>]) -> Self {
        let count = rows.first().map_or(1, Vec::len);
        let place = |span: &Span| (0.5 * (span.start + span.end), 0.5 * (span.end - span.start));
        Self {
            spans: spans.iter().map(place).collect(),
            coefficients: rows.concat(),
            count,
            rule: GaussRule::legendre((count / 2).max(1)).iter_on(0.0, 1.0).collect(),
        }
    }

    /// Creates the polynomials that interpolate `N` functions at the Gauss points of consecutive spans.
    /// The arguments of the functions are the index of the span, the span and the parameter.
    pub fn interpolation<const N: usize>(
        spans: &[Span],
        points: usize,
        functions: impl FnMut(usize, &Span, f64) -> [f64; N],
    ) -> [Self; N] {
        let rows = interpolated(spans, points, functions);
        std::array::from_fn(|entry| {
            let rows: Vec<Vec<f64>> = rows.iter().map(|row| row[entry].clone()).collect();
            Self::new(spans, &rows)
        })
    }

    /// Creates the integral of a function over consecutive spans, starting at the first span.
    pub fn integral(spans: &[Span], points: usize, function: impl Fn(&Span, f64) -> f64) -> Self {
        let slopes = interpolated(spans, points, |_, span, xi| {
            [0.5 * (span.end - span.start) * function(span, xi)]
        });
        let mut before = 0.0;
        let rows = slopes.into_iter().map(|[slopes]| {
            let primitive = slopes.iter().enumerate().map(|(k, c)| c / (k + 1) as f64);
            let mut row: Vec<f64> = std::iter::once(0.0).chain(primitive).collect();
            let at = |t: f64| row.iter().rev().fold(0.0, |sum, c| sum * t + c);
            let (start, end) = (at(-1.0), at(1.0));
            row[0] = before - start;
            before += end - start;
            row
        });
        let rows: Vec<Vec<f64>> = rows.collect();
        Self::new(spans, &rows)
    }

    pub(super) fn rule(&self) -> &[(f64, f64)] {
        &self.rule
    }

    pub(crate) fn largest_in_middle(&self) -> f64 {
        let middles = self.spans.iter().enumerate();
        middles.map(|(span, (middle, _))| self.in_span(span, *middle)[0]).fold(0.0, larger)
    }

    #[inline]
    pub(super) fn between(&self, span: usize, from: f64, to: f64) -> FunctionOnPath {
        let (middle, half) = self.spans[span];
        let [t0, t1] = [from, to].map(|xi| (xi - middle) / half);
        let own = &self.coefficients[span * self.count..][..self.count];
        let mut on = FunctionOnPath::default();
        for c in own.iter().rev() {
            on.change = on.change * t0 + on.slope;
            on.difference = on.difference * t0 + on.end;
            on.slope = on.slope * t1 + on.end;
            on.end = on.end * t1 + c;
            on.start = on.start * t0 + c;
        }
        let inverse = 1.0 / half;
        on.slope *= inverse;
        on.difference *= inverse;
        on.change *= inverse * inverse;
        on
    }

    #[inline]
    pub(crate) fn in_span(&self, span: usize, xi: f64) -> [f64; 3] {
        let (middle, half) = self.spans[span];
        let t = (xi - middle) / half;
        let own = &self.coefficients[span * self.count..][..self.count];
        let [value, slope, half_bend] = own
            .iter()
            .rev()
            .fold([0.0; 3], |[f, df, ddf], c| [f * t + c, df * t + f, ddf * t + df]);
        [value, slope / half, 2.0 * half_bend / (half * half)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_within_a_span_are_exact_for_any_length() {
        let span = Span { first: 0, start: 1.0, end: 3.0 };
        let function = PiecewisePolynomial::new(&[span], &[vec![8.0, 12.0, 6.0, 1.0]]);
        for (a, b) in [(1.5, 2.5), (2.5, 1.5), (2.0, 2.0), (2.0, 2.0 + 1e-13), (3.0, 3.5)] {
            let on = function.between(0, a, b);
            let found = [on.start, on.end, on.slope, on.difference, on.change];
            let exact = [a * a * a, b * b * b, 3.0 * b * b, a * a + a * b + b * b, a + 2.0 * b];
            for (found, exact) in found.iter().zip(exact) {
                assert!((found - exact).abs() < 1e-14 * exact, "{a} {b}: {found} {exact}");
            }
        }
    }

    #[test]
    fn piecewise_values_come_from_the_polynomial_of_the_span() {
        let span = |start, end| Span { first: 0, start, end };
        let rows = [vec![1.0, 2.0, 3.0], vec![0.5, 0.0, -1.0]];
        let function = PiecewisePolynomial::new(&[span(0.0, 2.0), span(2.0, 2.5)], &rows);
        assert_eq!(function.in_span(0, 1.5), [2.75, 5.0, 6.0]);
        assert_eq!(function.in_span(1, 2.5), [-0.5, -8.0, -32.0]);
    }
}
