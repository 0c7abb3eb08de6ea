//! Projection of functions onto the space of derivatives of splines.

use super::spline_rule::{lower_count, lower_splines};
use super::{Basis, BasisValues, GaussRule, GeometryError, Span};

/// Function space spanned by the derivatives of the basis functions of a run, with the matrix of their scalar products.
/// A run is a sequence of smoothly joined spans.
///
/// For smooth functions, the projection error decreases as the span length to the power of the degree, up to the ends of the run.
#[derive(Debug, Clone)]
pub struct LowerSplines {
    basis: Basis,
    run: Vec<Span>,
    count: usize,
    factors: Vec<Vec<f64>>,
}

#[derive(Debug, Clone)]
pub struct Reproduction<'a> {
    splines: &'a LowerSplines,
    kernel: Vec<f64>,
    integral: Vec<f64>,
    projected: Vec<f64>,
}

impl LowerSplines {
    /// Creates the function space for consecutive spans that are joined at least C¹.
    pub fn of(basis: &Basis, run: &[Span]) -> Result<Self, GeometryError> {
        let count = lower_count(basis, run).unwrap_or(0);
        let mut splines =
            Self { basis: basis.clone(), run: run.to_vec(), count, factors: Vec::new() };
        let mut gram = vec![vec![0.0; basis.degree()]; count];
        splines.integrate(|from, weight, lower, _| {
            for (t, row) in gram[from..].iter_mut().take(lower.len()).enumerate() {
                for (entry, other) in row.iter_mut().zip(&lower[t..]) {
                    *entry += weight * lower[t] * other;
                }
            }
        })?;
        splines.factors = factorised(gram);
        Ok(splines)
    }

    fn integrate(
        &self,
        mut add: impl FnMut(usize, f64, &[f64], &BasisValues),
    ) -> Result<(), GeometryError> {
        let gauss = GaussRule::new(self.basis.degree())?;
        for span in &self.run {
            for (xi, weight) in gauss.iter_on(span.start, span.end) {
                let values = self.basis.evaluate_in(span, xi);
                let lower: Vec<f64> = lower_splines(&values).collect();
                add(self.first(span), weight, &lower, &values);
            }
        }
        Ok(())
    }

    fn first(&self, span: &Span) -> usize {
        span.first - self.run[0].first
    }

    fn solve(&self, mut values: Vec<f64>) -> Vec<f64> {
        for t in 0..values.len() {
            let (known, rest) = values.split_at_mut(t + 1);
            let factors = &self.factors[t][1..];
            rest.iter_mut().zip(factors).for_each(|(value, factor)| *value -= factor * known[t]);
        }
        for t in (0..values.len()).rev() {
            let (rest, known) = values.split_at_mut(t + 1);
            let row = &self.factors[t];
            let beyond: f64 =
                row[1..].iter().zip(&*known).map(|(factor, value)| factor * value).sum();
            rest[t] = rest[t] / row[0] - beyond;
        }
        values
    }

    /// Reproducing kernel of this function space at the parameter `xi` on the span `span`.
    pub fn at(&self, span: &Span, xi: f64) -> Result<Reproduction<'_>, GeometryError> {
        let mut here = vec![0.0; self.count];
        let values = self.basis.evaluate_in(span, xi);
        for (value, lower) in here[self.first(span)..].iter_mut().zip(lower_splines(&values)) {
            *value = lower;
        }
        let kernel = self.solve(here);
        let steps = kernel.iter().scan(0.0, |sum, step| {
            *sum += step;
            Some(*sum)
        });
        let integral: Vec<f64> = std::iter::once(0.0).chain(steps).collect();
        let mut products = vec![0.0; self.count];
        self.integrate(|from, weight, lower, values| {
            let v: f64 = values.values().iter().zip(&integral[from..]).map(|(n, y)| n * y).sum();
            let products = products[from..].iter_mut().zip(lower);
            products.for_each(|(product, lower)| *product += weight * v * lower);
        })?;
        let projected = self.solve(products);
        Ok(Reproduction { splines: self, kernel, integral, projected })
    }
}

impl Reproduction<'_> {
    pub(crate) fn kernel(&self, span: &Span, xi: f64) -> f64 {
        self.combine(&self.kernel, span, &self.splines.basis.evaluate_in(span, xi))
    }

    pub(crate) fn projection_error(&self, span: &Span, xi: f64) -> f64 {
        let values = self.splines.basis.evaluate_in(span, xi);
        let functions = values.values().iter().zip(&self.integral[self.splines.first(span)..]);
        let v: f64 = functions.map(|(n, y)| n * y).sum();
        self.combine(&self.projected, span, &values) - v
    }

    fn combine(&self, coefficients: &[f64], span: &Span, values: &BasisValues) -> f64 {
        let coefficients = &coefficients[self.splines.first(span)..];
        lower_splines(values).zip(coefficients).map(|(lower, c)| lower * c).sum()
    }
}

fn factorised(mut rows: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    for t in 0..rows.len() {
        let (done, rest) = rows.split_at_mut(t + 1);
        let row = &mut done[t];
        let pivot = row[0];
        for (k, below) in rest.iter_mut().enumerate().take(row.len() - 1) {
            let factor = row[k + 1] / pivot;
            for (entry, above) in below.iter_mut().zip(&row[k + 1..]) {
                *entry -= factor * above;
            }
        }
        row[1..].iter_mut().for_each(|entry| *entry /= pivot);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::KnotVector;

    fn runs() -> Vec<(Basis, Vec<Span>)> {
        [(1, 3, 2), (7, 3, 2), (5, 3, 1), (6, 2, 1), (5, 4, 3), (4, 5, 2), (9, 10, 9)]
            .map(|(spans, degree, continuity)| {
                let knots = KnotVector::uniform(spans, degree, continuity).unwrap();
                let basis = Basis::BSpline(knots);
                let spans = basis.spans();
                (basis, spans)
            })
            .to_vec()
    }

    fn integral(basis: &Basis, run: &[Span], f: impl Fn(&Span, f64) -> f64) -> f64 {
        let gauss = GaussRule::new(basis.degree() + 2).unwrap();
        let of_span = |span: &Span| -> f64 {
            gauss.iter_on(span.start, span.end).map(|(xi, weight)| weight * f(span, xi)).sum()
        };
        run.iter().map(of_span).sum()
    }

    #[test]
    fn lower_splines_reproduce_derivatives_with_a_consistent_kernel() {
        for (basis, run) in runs() {
            let splines = LowerSplines::of(&basis, &run).unwrap();
            let coefficients: Vec<f64> =
                (0..basis.functions()).map(|a| ((a * a + 3) % 7) as f64).collect();
            let slope = |span: &Span, xi: f64| -> f64 {
                let values = basis.evaluate_in(span, xi);
                values.slopes().iter().zip(&coefficients[span.first..]).map(|(n, c)| n * c).sum()
            };
            for span in [&run[0], &run[run.len() / 2], &run[run.len() - 1]] {
                for xi in [span.start, 0.3 * span.start + 0.7 * span.end, span.end] {
                    let place = splines.at(span, xi).unwrap();
                    let found =
                        integral(&basis, &run, |on, at| place.kernel(on, at) * slope(on, at));
                    let expected = slope(span, xi);
                    assert!((found - expected).abs() < 1e-9 * (1.0 + expected.abs()));
                    let missed = integral(&basis, &run, |on, at| {
                        place.projection_error(on, at) * slope(on, at)
                    });
                    assert!(missed.abs() < 1e-10, "{missed:e}");
                    let ends = [place.integral[0], place.integral[basis.functions() - 1]];
                    assert!((ends[1] - ends[0] - 1.0).abs() < 1e-10);
                }
            }
        }
    }
}
