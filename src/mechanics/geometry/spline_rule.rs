//! Gauss quadrature for the derivatives of splines.
//!
//! The number of quadrature points is the smallest number for which a spline derivative is determined by its values at these points.

use super::collocation::{CollocationRow, solve};
use super::{Basis, BasisValues, GaussRule, Span};

/// Quadrature points of each span in a sequence of smoothly joined spans, with their weights: `∫ f dξ ≈ Σ weight · f(point)`.
pub type RunRule = Vec<Vec<(f64, f64)>>;

/// Largest relative difference of two span lengths that count as equal.
const EQUAL: f64 = 1e-9;

/// Computes the patch rule of a run, a sequence of consecutive spans that are joined at least C¹ (docs/theory.md, section 4).
/// The number of points equals the number of linearly independent derivatives of basis functions. All derivatives are integrated exactly.
///
/// Usually, the quadrature points are the zeros of a spline that is orthogonal to all splines of one degree less.
/// On three or more equal spans of C² cubics, they are two Gauss points in the first and the last span, and the middles of the other spans.
/// The number of zeros follows from total positivity (de Boor, A Practical Guide to Splines, rev. ed. 2001, chapter XI).
/// Tests for every degree and continuity confirm that the quadrature weights are positive. There is no proof.
/// Returns `None` if rounding hides a zero, or if a weight is not positive. No such spans are known.
pub fn patch_rule(basis: &Basis, run: &[Span]) -> Option<RunRule> {
    if let [span] = run {
        return gauss_points(basis.degree(), span).map(|rule| vec![rule]);
    }
    let points = if is_equal_and_cubic(basis, run) {
        middles(run)?
    } else {
        zeros(basis, run, &orthogonal_spline(basis, run)?)?
    };
    let mut weights = derivative_weights(basis, run, &points)?.into_iter();
    let is_positive = weights.as_slice().iter().all(|weight| *weight > 0.0);
    let weigh = |points: Vec<f64>| points.into_iter().zip(&mut weights).collect();
    is_positive.then(|| points.into_iter().map(weigh).collect())
}

fn gauss_points(count: usize, span: &Span) -> Option<Vec<(f64, f64)>> {
    Some(GaussRule::new(count).ok()?.iter_on(span.start, span.end).collect())
}

fn is_equal_and_cubic(basis: &Basis, run: &[Span]) -> bool {
    let length = |span: &Span| span.end - span.start;
    let is_like_the_first =
        |span: &Span| (length(span) - length(&run[0])).abs() <= EQUAL * length(&run[0]);
    basis.degree() == 3
        && run.len() > 2
        && run.iter().all(is_like_the_first)
        && run.windows(2).all(|pair| pair[1].first == pair[0].first + 1)
}

fn middles(run: &[Span]) -> Option<Vec<Vec<f64>>> {
    let last = run.len() - 1;
    let of = |(at, span): (usize, &Span)| {
        let count = if at == 0 || at == last { 2 } else { 1 };
        Some(gauss_points(count, span)?.into_iter().map(|(xi, _)| xi).collect())
    };
    run.iter().enumerate().map(of).collect()
}

/// Values of the splines of one degree less, computed as sums of derivatives of the basis functions.
/// Each spline of one degree less is a positive multiple of a B-spline, and its integral is one.
pub fn lower_splines(values: &BasisValues) -> impl Iterator<Item = f64> + '_ {
    let partial = values.slopes().iter().scan(0.0, |sum, slope| {
        *sum -= slope;
        Some(*sum)
    });
    partial.take(values.slopes().len() - 1)
}

pub(super) fn lower_count(basis: &Basis, run: &[Span]) -> Option<usize> {
    Some(run.last()?.first + basis.degree() - run.first()?.first)
}

fn empty_rows(count: usize, room: usize) -> Vec<CollocationRow<f64>> {
    let row = || CollocationRow { first: 0, entries: Vec::with_capacity(room), right_side: 0.0 };
    std::iter::repeat_with(row).take(count).collect()
}

fn orthogonal_spline(basis: &Basis, run: &[Span]) -> Option<Vec<f64>> {
    let (degree, offset) = (basis.degree(), run.first()?.first);
    let unknowns = lower_count(basis, run)?;
    let mut rows = empty_rows(unknowns, 2 * degree + 1);
    // The integrands are products of splines of degree p and p - 1, so their degree is 2p - 1.
    let gauss = GaussRule::new(degree).ok()?;
    for span in run {
        let from = span.first - offset;
        let functions = from..=from + degree;
        for (xi, weight) in gauss.iter_on(span.start, span.end) {
            let values = basis.evaluate_in(span, xi);
            for (row, lower) in rows[from..].iter_mut().zip(lower_splines(&values)) {
                if row.entries.is_empty() {
                    row.first = from;
                }
                let missing = (functions.end().min(&(unknowns - 1)) + 1).saturating_sub(row.first);
                row.entries.resize(missing.max(row.entries.len()), 0.0);
                for (function, value) in functions.clone().zip(values.values()) {
                    let product = weight * lower * value;
                    match row.entries.get_mut(function - row.first) {
                        Some(entry) => *entry += product,
                        None => row.right_side -= product,
                    }
                }
            }
        }
    }
    let mut coefficients = solve(rows);
    coefficients.push(1.0);
    coefficients.iter().all(|coefficient| coefficient.is_finite()).then_some(coefficients)
}

/// Parameters in a span, from -1 to 1, between which zeros are searched.
fn places(degree: usize) -> Vec<f64> {
    let count = 8 * (degree + 1);
    let place = |at: usize| {
        let t = at as f64 / count as f64;
        2.0 * t * t * (3.0 - 2.0 * t) - 1.0
    };
    (0..count).map(place).collect()
}

fn zeros(basis: &Basis, run: &[Span], coefficients: &[f64]) -> Option<Vec<Vec<f64>>> {
    let (degree, offset) = (basis.degree(), run.first()?.first);
    let places = places(degree);
    let pieces: Vec<Polynomial> = run
        .iter()
        .map(|span| Polynomial::of(basis, span, &coefficients[span.first - offset..]))
        .collect();
    let mut found = Vec::with_capacity(run.len());
    for (at, (span, piece)) in run.iter().zip(&pieces).enumerate() {
        // At the end of a span, the value at the start of the next span is used, so that a zero at a knot is counted exactly once.
        let end = pieces.get(at + 1).map_or_else(|| piece.value(1.0), |next| next.value(-1.0));
        let starts = places.iter().map(|t| (*t, piece.value(*t)));
        let values: Vec<(f64, f64)> = starts.chain([(1.0, end)]).collect();
        let (middle, half) = (0.5 * (span.start + span.end), 0.5 * (span.end - span.start));
        let of_span = values.windows(2).filter_map(|ends| {
            let [(left, low), (right, high)] = [ends[0], ends[1]];
            let is_zero = low == 0.0 || (low < 0.0) != (high < 0.0) && high != 0.0;
            is_zero.then(|| middle + half * piece.zero_between(left, right, low))
        });
        found.push(of_span.collect::<Vec<f64>>());
    }
    (found.iter().map(Vec::len).sum::<usize>() == lower_count(basis, run)?).then_some(found)
}

/// Polynomial `Σ c_k t^k` of a span with the coefficients `c_k`, where `t` runs from -1 to 1.
struct Polynomial(Vec<f64>);

impl Polynomial {
    fn of(basis: &Basis, span: &Span, coefficients: &[f64]) -> Self {
        let (middle, half) = (0.5 * (span.start + span.end), 0.5 * (span.end - span.start));
        let values = basis.evaluate_in(span, middle);
        let mut scale = 1.0;
        let term = |order: usize| {
            if order > 0 {
                scale *= half / order as f64;
            }
            let functions = values.derivatives(order).iter().zip(coefficients);
            scale * functions.map(|(function, coefficient)| function * coefficient).sum::<f64>()
        };
        Self((0..=basis.degree()).map(term).collect())
    }

    fn value(&self, t: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, coefficient| sum * t + coefficient)
    }

    fn zero_between(&self, mut left: f64, mut right: f64, low: f64) -> f64 {
        if low == 0.0 {
            return left;
        }
        loop {
            let middle = 0.5 * (left + right);
            if middle <= left || middle >= right {
                return middle;
            }
            if (self.value(middle) < 0.0) == (low < 0.0) {
                left = middle;
            } else {
                right = middle;
            }
        }
    }
}

/// Weights for which the quadrature points of a run integrate the derivatives of all its basis functions exactly.
/// The result is `None` if the weights are not unique or not finite.
/// Reference: F. Auricchio et al., Comput. Methods Appl. Mech. Eng. 249–252 (2012) 15–27.
fn derivative_weights(basis: &Basis, run: &[Span], points: &[Vec<f64>]) -> Option<Vec<f64>> {
    let (first, last) = (run.first()?, run.last()?);
    let unknowns = lower_count(basis, run)?;
    let mut rows = empty_rows(unknowns, basis.degree() + 1);
    let mut number = 0;
    for (span, points) in run.iter().zip(points) {
        for xi in points {
            let values = basis.evaluate_in(span, *xi);
            let from = span.first - first.first;
            for (row, lower) in rows[from..].iter_mut().zip(lower_splines(&values)) {
                if row.entries.is_empty() {
                    row.first = number;
                }
                row.entries.push(lower);
            }
            number += 1;
        }
    }
    // The weights are unique if each point lies within the support of the spline with the same index (Schoenberg & Whitney 1953).
    let has_own = |(at, row): (usize, &CollocationRow<f64>)| {
        (row.first..row.first + row.entries.len()).contains(&at)
    };
    if number != unknowns || !rows.iter().enumerate().all(has_own) {
        return None;
    }
    // The integral of the derivative of a function is its value at the right end minus its value at the left end.
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
mod tests;
