//! Basis functions along a way between two parameters, for a point that slides along a beam.

use std::sync::Arc;

use super::piecewise::FunctionOnPath;
use super::values::FunctionRow;
use super::{Basis, GaussRule, MAX_DEGREE, PiecewisePolynomial, Span};

/// The basis functions `B_i` along a way from the parameter ξ₀ to ξ₁, as a point needs them that
/// slides along `Σ B_i(ξ) x_i` during a time step: above all the quotients
/// `(B_i(ξ₁) - B_i(ξ₀)) / (ξ₁ - ξ₀)`, which are accurate for ways of any length, zero included, and
/// across breaks of any smoothness.
///
/// The window of the functions `first, first + 1, …` contains those that are non-zero anywhere on
/// the spans of the way; every accessor returns one number for each of them. Parameters are
/// dimensionless, and so is all that is returned.
///
/// A way that starts at a break starts in the span ahead, and one that ends at a break ends in the
/// span it came through. A way of length zero at a break lies in the right span. Outside the
/// domain the polynomials of the end spans are continued.
#[derive(Debug, Clone)]
pub struct ContactPath {
    /// Shared with its copies, of which there is one for each point on the same beam.
    line: Arc<PathSupport>,
    way: PathInterval,
    /// The functions at the start of the way, in the span of its departure: one way after another starts there.
    departing: Option<(f64, usize, FunctionRow)>,
    first: usize,
    length: usize,
    /// The numbers of the window, a row of them for each [`PathQuantity`], side by side; behind them room for those of the longest way, in copies too.
    numbers: Vec<f64>,
}

/// What is known of each function along a way, in the order of the rows.
#[derive(Debug, Clone, Copy)]
enum PathQuantity {
    Start,
    End,
    Mean,
    Slope,
    Difference,
    Change,
}

/// The number of rows.
const QUANTITIES: usize = PathQuantity::Change as usize + 1;

/// Along what ways lead.
#[derive(Debug)]
struct PathSupport {
    basis: Basis,
    spans: Vec<Span>,
    /// For each span, the number of breaks up to its start at which slopes jump.
    kinks: Vec<usize>,
    /// Points and weights on `[0, 1]`, exact for polynomials of one degree less than the basis.
    rule: Vec<(f64, f64)>,
}

/// Where a way starts and ends, and the indices of the spans in which it does.
#[derive(Debug, Clone, Copy)]
struct PathInterval {
    from: f64,
    to: f64,
    departure: usize,
    arrival: usize,
}

/// The part of a way within one span.
struct PathPiece {
    enter: f64,
    leave: f64,
    /// The fraction of the way that lies before the piece.
    before: f64,
    /// The fraction of the way that is the piece.
    share: f64,
}

impl ContactPath {
    /// A way of length zero at the start of the domain of `basis`. All the room that longer ways
    /// need is taken here; [`go`](Self::go) allocates nothing.
    pub fn new(basis: Basis) -> Self {
        let room = QUANTITIES * basis.functions();
        let (start, _) = basis.domain();
        let spans = basis.spans();
        let kinks = kinks(&spans, basis.degree());
        let rule = GaussRule::legendre(basis.degree().div_ceil(2)).iter_on(0.0, 1.0).collect();
        let mut passage = Self {
            line: Arc::new(PathSupport { basis, spans, kinks, rule }),
            way: PathInterval { from: start, to: start, departure: 0, arrival: 0 },
            departing: None,
            first: 0,
            length: 0,
            numbers: vec![0.0; room],
        };
        passage.go(start, start);
        passage
    }

    /// Replaces the way by the one from ξ₀ = `from`, in the domain, to ξ₁ = `to`, which may lie
    /// outside.
    ///
    /// If either is not finite, all numbers are NaN, and the window is that of the span of `from`.
    pub fn go(&mut self, from: f64, to: f64) {
        let is_there = self.length > 0 && (self.way.from, self.way.to) == (from, to);
        if is_there {
            return;
        }
        let finite = from.is_finite() && to.is_finite();
        let way = self.way(from, if finite { to } else { from });
        self.way = PathInterval { from, to, ..way };
        let (low, high) = way.lowest_and_highest();
        self.first = self.line.spans[low].first;
        self.length = self.line.spans[high].first + self.line.basis.degree() + 1 - self.first;
        if finite {
            self.fill(0.0);
            // The compiler knows how many functions the usual degrees have.
            match self.line.basis.degree() {
                1 => self.add_values::<2>(way),
                2 => self.add_values::<3>(way),
                3 => self.add_values::<4>(way),
                _ => self.add_values::<{ MAX_DEGREE + 1 }>(way),
            }
        } else {
            self.fill(f64::NAN);
        }
    }

    /// The basis along which the way leads.
    pub fn basis(&self) -> &Basis {
        &self.line.basis
    }

    /// The index of the first basis function of the window of the way.
    pub fn first(&self) -> usize {
        self.first
    }

    /// The values `B_i(ξ₀)` at the start of the way, one for each function of its window. They sum to one.
    pub fn start(&self) -> &[f64] {
        self.row(PathQuantity::Start)
    }

    /// The values `B_i(ξ₁)` at the end of the way, one for each function of its window. They sum to one.
    pub fn end(&self) -> &[f64] {
        self.row(PathQuantity::End)
    }

    /// The means `½ (B_i(ξ₀) + B_i(ξ₁))` of start and end of the way, one for each function of its window. They sum to one.
    pub fn mean(&self) -> &[f64] {
        self.row(PathQuantity::Mean)
    }

    /// The derivatives `B_i'(ξ₁)` at the end of the way, on its side, one for each function of its window. They sum to zero.
    pub fn slope(&self) -> &[f64] {
        self.row(PathQuantity::Slope)
    }

    /// The divided differences `D_i = (B_i(ξ₁) - B_i(ξ₀)) / (ξ₁ - ξ₀)`, the means of `B_i'` over the way, to rounding;
    /// `B_i'(ξ₀)` for a way of length zero. One for each function of the window; they sum to zero.
    pub fn difference(&self) -> &[f64] {
        self.row(PathQuantity::Difference)
    }

    /// The derivatives of the divided differences by the end of the way, `∂D_i/∂ξ₁ = (B_i'(ξ₁) - D_i) / (ξ₁ - ξ₀)` for fixed ξ₀;
    /// `½ B_i''(ξ₀)` for a way of length zero. One for each function of the window; they sum to zero.
    ///
    /// To rounding, unless the way crosses a break at which the `B_i'` jump: then the rounding of
    /// `D_i` is divided by the length of the way.
    pub fn change(&self) -> &[f64] {
        self.row(PathQuantity::Change)
    }

    /// A function that is a polynomial on each span of the basis, along the way; NaN where an end of the way is not finite.
    ///
    /// Its slope may jump where those of the basis do, and only there.
    pub fn along(&self, function: &PiecewisePolynomial) -> FunctionOnPath {
        let way = self.way;
        let [start, ..] = function.in_span(way.departure, way.from);
        let [end, slope, _] = function.in_span(way.arrival, way.to);
        let (mut difference, mut change) = (0.0, 0.0);
        let (low, high) = way.lowest_and_highest();
        for (index, span) in (low..).zip(&self.line.spans[low..=high]) {
            let piece = way.piece(index, span);
            for &(t, weight) in function.rule() {
                let xi = piece.enter + t * (piece.leave - piece.enter);
                let [_, by_xi, bend] = function.in_span(index, xi);
                difference += weight * piece.share * by_xi;
                change += weight * piece.share * (piece.before + t * piece.share) * bend;
            }
        }
        if self.line.kinks[way.departure] != self.line.kinks[way.arrival] {
            change = (slope - difference) / (way.to - way.from);
        }
        FunctionOnPath { start, end, slope, difference, change }
    }

    /// A function that is a polynomial on each span of the basis, at the end of the way: its value, its first and its second derivative by ξ.
    pub fn at_end(&self, function: &PiecewisePolynomial) -> [f64; 3] {
        function.in_span(self.way.arrival, self.way.to)
    }

    /// How many spans of the basis lie between two parameters, parts of spans as parts: for a small way, its length over the width of
    /// its span.
    pub fn spans_between(&self, from: f64, to: f64) -> f64 {
        let (from, to) = if from <= to { (from, to) } else { (to, from) };
        let PathInterval { departure, arrival, .. } = self.way(from, to);
        let part = |span: &Span| {
            (to.min(span.end) - from.max(span.start)).max(0.0) / (span.end - span.start)
        };
        self.line.spans[departure..=arrival].iter().map(part).sum()
    }

    /// The way with its spans found.
    fn way(&self, from: f64, to: f64) -> PathInterval {
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

    /// The numbers of one kind, one for each function of the window.
    #[inline]
    fn row(&self, quantity: PathQuantity) -> &[f64] {
        &self.numbers[quantity as usize * self.length..][..self.length]
    }

    /// Sets every number of the window.
    fn fill(&mut self, value: f64) {
        self.numbers[..QUANTITIES * self.length].fill(value);
    }

    /// What the functions are on the way, added to zeros.
    fn add_values<const WIDTH: usize>(&mut self, way: PathInterval) {
        self.add_ends::<WIDTH>(way);
        self.add_quotients::<WIDTH>(way);
    }

    /// What the functions are at the ends, added to zeros.
    fn add_ends<const WIDTH: usize>(&mut self, way: PathInterval) {
        let PathSupport { basis, spans, .. } = &*self.line;
        let [start, end, mean, slope, ..] = rows(&mut self.numbers, self.length);
        let departure = &spans[way.departure];
        let values = match &self.departing {
            Some((from, span, values)) if (*from, *span) == (way.from, way.departure) => values,
            _ => {
                let own = basis.evaluate_low::<WIDTH>(departure, way.from);
                let mut values = FunctionRow::default();
                values[..=basis.degree()].copy_from_slice(own.values());
                &self.departing.insert((way.from, way.departure, values)).2
            }
        };
        add(start, departure.first - self.first, 1.0, &values[..=basis.degree()]);
        let values = basis.evaluate_low::<WIDTH>(&spans[way.arrival], way.to);
        add(end, values.first - self.first, 1.0, values.values());
        add(slope, values.first - self.first, 1.0, values.slopes());
        add(mean, 0, 0.5, start);
        add(mean, 0, 0.5, end);
    }

    /// The integrals over the way, added to zeros: `D = ∫ B'(ξ₀ + s Δξ) ds` over `0 < s < 1` and its
    /// derivative `∫ s B''(ξ₀ + s Δξ) ds`, unless `B'` jumps on the way.
    fn add_quotients<const WIDTH: usize>(&mut self, way: PathInterval) {
        let PathSupport { basis, spans, kinks, rule } = &*self.line;
        let [.., slope, difference, change] = rows(&mut self.numbers, self.length);
        let smooth = kinks[way.departure] == kinks[way.arrival];
        let (low, high) = way.lowest_and_highest();
        for (index, span) in spans[low..=high].iter().enumerate() {
            let piece = way.piece(low + index, span);
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
            let length = way.to - way.from;
            add(change, 0, 1.0 / length, slope);
            add(change, 0, -1.0 / length, difference);
        }
    }
}

impl PathInterval {
    /// The indices of the leftmost and of the rightmost span.
    fn lowest_and_highest(self) -> (usize, usize) {
        (self.departure.min(self.arrival), self.departure.max(self.arrival))
    }

    /// The part within `span`, one of those of the way, with its `index`.
    fn piece(self, index: usize, span: &Span) -> PathPiece {
        if self.departure == self.arrival {
            // Apart from the rest, which divides by the length of the way: it may be zero.
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

/// For each span, the number of breaks up to its start at which slopes of the functions jump:
/// those across which no more than one function lives on both sides.
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

/// The rows of numbers of a window of so many functions, in the order of [`PathQuantity`].
fn rows(numbers: &mut [f64], length: usize) -> [&mut [f64]; QUANTITIES] {
    let mut rows = numbers.chunks_exact_mut(length);
    std::array::from_fn(|_| rows.next().unwrap_or_default())
}

/// Adds `factor · values` to the entries of `row` behind the first `skip`.
#[inline]
fn add(row: &mut [f64], skip: usize, factor: f64, values: &[f64]) {
    row[skip..].iter_mut().zip(values).for_each(|(entry, value)| *entry += factor * value);
}

#[cfg(test)]
mod tests;
