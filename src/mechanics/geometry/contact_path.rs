//! Basis functions along a path between two parameters, for a point that slides along a beam.

use std::sync::Arc;

use super::piecewise::FunctionOnPath;
use super::values::{FunctionRow, LOW_ORDERS, LowDerivatives};
use super::{Basis, GaussRule, MAX_DEGREE, PiecewisePolynomial, Span};

/// Basis functions along a path between two parameters of a beam, for a point that slides along the beam in a time step.
/// The divided differences of the basis functions are accurate for paths of any length, including zero, and across breaks.
///
/// Every accessor returns one dimensionless value for each basis function that is nonzero somewhere on the path.
/// If an end of the path is a break, the span inside the path is used. A path of zero length uses the span on the right.
/// Outside the domain, the polynomials of the first and the last span are extended.
#[derive(Debug, Clone)]
pub struct ContactPath {
    line: Arc<PathSupport>,
    interval: PathInterval,
    departing: Option<(f64, usize, FunctionRow)>,
    first: usize,
    length: usize,
    numbers: Vec<f64>,
}

/// Quantity that is computed for each basis function along a path, in the order of the table rows.
#[derive(Debug, Clone, Copy)]
enum PathQuantity {
    Start,
    End,
    Mean,
    Slope,
    Difference,
    Change,
}

const QUANTITIES: usize = PathQuantity::Change as usize + 1;

#[derive(Debug)]
struct PathSupport {
    basis: Basis,
    spans: Vec<Span>,
    kinks: Vec<usize>,
    rule: Vec<(f64, f64)>,
}

#[derive(Debug, Clone, Copy)]
struct PathInterval {
    from: f64,
    to: f64,
    departure: usize,
    arrival: usize,
}

struct PathPiece {
    enter: f64,
    leave: f64,
    before: f64,
    share: f64,
}

impl ContactPath {
    /// Creates a path of zero length at the start of the domain of `basis`.
    pub fn new(basis: Basis) -> Self {
        let room = QUANTITIES * basis.functions();
        let (start, _) = basis.domain();
        let spans = basis.spans();
        let kinks = kinks(&spans, basis.degree());
        let rule = GaussRule::legendre(basis.degree().div_ceil(2)).iter_on(0.0, 1.0).collect();
        let mut passage = Self {
            line: Arc::new(PathSupport { basis, spans, kinks, rule }),
            interval: PathInterval { from: start, to: start, departure: 0, arrival: 0 },
            departing: None,
            first: 0,
            length: 0,
            numbers: vec![0.0; room],
        };
        passage.set_interval(start, start);
        passage
    }

    /// Replaces the path by the path from `from` to `to`. The start must lie in the domain; the end may lie outside.
    /// If a parameter is not finite, all values are NaN, and the basis functions are those of the span that contains `from`.
    pub fn set_interval(&mut self, from: f64, to: f64) {
        let is_there = self.length > 0 && (self.interval.from, self.interval.to) == (from, to);
        if is_there {
            return;
        }
        let finite = from.is_finite() && to.is_finite();
        let interval = self.interval(from, if finite { to } else { from });
        self.interval = PathInterval { from, to, ..interval };
        let (low, high) = interval.lowest_and_highest();
        self.first = self.line.spans[low].first;
        self.length = self.line.spans[high].first + self.line.basis.degree() + 1 - self.first;
        if finite {
            match self.line.basis.degree() {
                1 => self.set_values::<2>(interval),
                2 => self.set_values::<3>(interval),
                3 => self.set_values::<4>(interval),
                _ => self.set_values::<{ MAX_DEGREE + 1 }>(interval),
            }
        } else {
            self.fill(f64::NAN);
        }
    }

    /// Basis of the path.
    pub fn basis(&self) -> &Basis {
        &self.line.basis
    }

    /// First basis function that is nonzero on the spans of the path.
    pub fn first(&self) -> usize {
        self.first
    }

    /// Values of the basis functions at the start of the path. The values sum to one.
    pub fn start(&self) -> &[f64] {
        self.row(PathQuantity::Start)
    }

    /// Values of the basis functions at the end of the path. The values sum to one.
    pub fn end(&self) -> &[f64] {
        self.row(PathQuantity::End)
    }

    /// Means of the values of the basis functions at the start and the end of the path. The means sum to one.
    pub fn mean(&self) -> &[f64] {
        self.row(PathQuantity::Mean)
    }

    /// Derivatives of the basis functions at the end of the path, as limits from inside the path. The derivatives sum to zero.
    pub fn slope(&self) -> &[f64] {
        self.row(PathQuantity::Slope)
    }

    /// Divided differences of the basis functions: their mean derivatives over the path, accurate to rounding. The differences sum to zero.
    pub fn difference(&self) -> &[f64] {
        self.row(PathQuantity::Difference)
    }

    /// Derivatives of the divided differences with respect to the end of the path, for a fixed start. The derivatives sum to zero.
    /// For a path of zero length, the derivatives of the divided differences are half the second derivatives of the basis functions.
    /// The derivatives of the divided differences are accurate to rounding unless a first derivative of the basis jumps on the path.
    pub fn change(&self) -> &[f64] {
        self.row(PathQuantity::Change)
    }

    /// Evaluates a piecewise polynomial along the path. The result is NaN if an end of the path is not finite.
    ///
    /// The derivative of the polynomial may jump only where first derivatives of the basis jump.
    pub fn along(&self, function: &PiecewisePolynomial) -> FunctionOnPath {
        let interval = self.interval;
        if interval.departure == interval.arrival {
            return function.between(interval.departure, interval.from, interval.to);
        }
        let [start, ..] = function.in_span(interval.departure, interval.from);
        let [end, slope, _] = function.in_span(interval.arrival, interval.to);
        let (mut difference, mut change) = (0.0, 0.0);
        let (low, high) = interval.lowest_and_highest();
        for (index, span) in (low..).zip(&self.line.spans[low..=high]) {
            let piece = interval.piece(index, span);
            for &(t, weight) in function.rule() {
                let xi = piece.enter + t * (piece.leave - piece.enter);
                let [_, by_xi, bend] = function.in_span(index, xi);
                difference += weight * piece.share * by_xi;
                change += weight * piece.share * (piece.before + t * piece.share) * bend;
            }
        }
        if self.line.kinks[interval.departure] != self.line.kinks[interval.arrival] {
            change = (slope - difference) / (interval.to - interval.from);
        }
        FunctionOnPath { start, end, slope, difference, change }
    }

    /// Value and first and second derivative of a piecewise polynomial with respect to ξ, at the end of the path.
    pub fn at_end(&self, function: &PiecewisePolynomial) -> [f64; 3] {
        function.in_span(self.interval.arrival, self.interval.to)
    }

    pub(crate) fn spans_between(&self, from: f64, to: f64) -> f64 {
        let (from, to) = if from <= to { (from, to) } else { (to, from) };
        let PathInterval { departure, arrival, .. } = self.interval(from, to);
        let part = |span: &Span| {
            (to.min(span.end) - from.max(span.start)).max(0.0) / (span.end - span.start)
        };
        self.line.spans[departure..=arrival].iter().map(part).sum()
    }

    fn interval(&self, from: f64, to: f64) -> PathInterval {
        let spans = &self.line.spans;
        let last = spans.len() - 1;
        let (departure, arrival) = if to < from {
            let departure = spans.partition_point(|span| span.end < from).min(last);
            let arrival = spans.partition_point(|span| span.end <= to);
            (departure, arrival.min(departure))
        } else {
            let departure = spans.partition_point(|span| span.start <= from).max(1) - 1;
            let arrival = spans.partition_point(|span| span.start < to).max(1) - 1;
            (departure, arrival.max(departure))
        };
        PathInterval { from, to, departure, arrival }
    }

    #[inline]
    fn row(&self, quantity: PathQuantity) -> &[f64] {
        &self.numbers[quantity as usize * self.length..][..self.length]
    }

    fn fill(&mut self, value: f64) {
        self.numbers[..QUANTITIES * self.length].fill(value);
    }

    fn set_values<const WIDTH: usize>(&mut self, interval: PathInterval) {
        let PathSupport { basis, spans, .. } = &*self.line;
        let departure = &spans[interval.departure];
        let is_known = |(from, span, _): &(f64, usize, FunctionRow)| {
            (*from, *span) == (interval.from, interval.departure)
        };
        if !self.departing.as_ref().is_some_and(is_known) {
            let own = basis.evaluate_low::<WIDTH>(departure, interval.from);
            let mut values = FunctionRow::default();
            values[..=basis.degree()].copy_from_slice(own.values());
            self.departing = Some((interval.from, interval.departure, values));
        }
        let end = basis.evaluate_low::<WIDTH>(&spans[interval.arrival], interval.to);
        let (first, degree) = (departure.first, basis.degree());
        if interval.departure == interval.arrival && degree <= LOW_ORDERS {
            self.set_in_span(interval, &end);
        } else {
            self.fill(0.0);
            self.add_ends(first, &end);
            self.add_quotients::<WIDTH>(interval);
        }
    }

    fn set_in_span<const WIDTH: usize>(
        &mut self,
        interval: PathInterval,
        at_end: &LowDerivatives<WIDTH>,
    ) {
        let Some((.., at_start)) = &self.departing else { return };
        let [start, end, mean, slope, difference, change] = rows(&mut self.numbers, self.length);
        let h = interval.to - interval.from;
        for at in 0..at_end.values().len() {
            let [value, first, second, third] = at_end.of_function(at);
            let third = h * (1.0 / 6.0) * third;
            (start[at], end[at]) = (at_start[at], value);
            mean[at] = 0.5 * at_start[at] + 0.5 * value;
            slope[at] = first;
            difference[at] = first - h * (0.5 * second - third);
            change[at] = 0.5 * second - third;
        }
    }

    fn add_ends<const WIDTH: usize>(&mut self, first: usize, at_end: &LowDerivatives<WIDTH>) {
        let Some((.., at_start)) = &self.departing else { return };
        let [start, end, mean, slope, ..] = rows(&mut self.numbers, self.length);
        let at_start = &at_start[..at_end.values().len()];
        add(start, first - self.first, 1.0, at_start);
        add(end, at_end.first - self.first, 1.0, at_end.values());
        add(slope, at_end.first - self.first, 1.0, at_end.slopes());
        add(mean, 0, 0.5, start);
        add(mean, 0, 0.5, end);
    }

    fn add_quotients<const WIDTH: usize>(&mut self, interval: PathInterval) {
        let PathSupport { basis, spans, kinks, rule } = &*self.line;
        let [.., slope, difference, change] = rows(&mut self.numbers, self.length);
        let smooth = kinks[interval.departure] == kinks[interval.arrival];
        let (low, high) = interval.lowest_and_highest();
        for (index, span) in spans[low..=high].iter().enumerate() {
            let piece = interval.piece(low + index, span);
            let skip = span.first - self.first;
            for &(t, weight) in rule {
                let xi = piece.enter + t * (piece.leave - piece.enter);
                let values = basis.evaluate_low::<WIDTH>(span, xi);
                let weight = weight * piece.share;
                add(difference, skip, weight, values.slopes());
                if smooth {
                    let moment = weight * (piece.before + t * piece.share);
                    add(change, skip, moment, values.bends());
                }
            }
        }
        if !smooth {
            let length = interval.to - interval.from;
            add(change, 0, 1.0 / length, slope);
            add(change, 0, -1.0 / length, difference);
        }
    }
}

impl PathInterval {
    fn lowest_and_highest(self) -> (usize, usize) {
        (self.departure.min(self.arrival), self.departure.max(self.arrival))
    }

    fn piece(self, index: usize, span: &Span) -> PathPiece {
        if self.departure == self.arrival {
            // A path within one span is treated separately, because the general case divides by the length of the path, which may be zero.
            return PathPiece { enter: self.from, leave: self.to, before: 0.0, share: 1.0 };
        }
        let (behind, ahead) = if self.departure < self.arrival {
            (span.start, span.end)
        } else {
            (span.end, span.start)
        };
        let enter = if index == self.departure { self.from } else { behind };
        let leave = if index == self.arrival { self.to } else { ahead };
        let length = self.to - self.from;
        PathPiece {
            enter,
            leave,
            before: (enter - self.from) / length,
            share: (leave - enter) / length,
        }
    }
}

fn kinks(spans: &[Span], degree: usize) -> Vec<usize> {
    let jumps = spans.windows(2).map(|pair| usize::from(pair[1].first - pair[0].first >= degree));
    std::iter::once(0)
        .chain(jumps)
        .scan(0, |count, jump| {
            *count += jump;
            Some(*count)
        })
        .collect()
}

fn rows(numbers: &mut [f64], length: usize) -> [&mut [f64]; QUANTITIES] {
    let mut rows = numbers.chunks_exact_mut(length);
    std::array::from_fn(|_| rows.next().unwrap_or_default())
}

#[inline]
fn add(row: &mut [f64], skip: usize, factor: f64, values: &[f64]) {
    row[skip..].iter_mut().zip(values).for_each(|(entry, value)| *entry += factor * value);
}

#[cfg(test)]
mod tests;
