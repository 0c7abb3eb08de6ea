//! Open knot vectors. A knot vector defines the breaks of a spline and the continuity of the spline at the breaks.

use serde::{Deserialize, Serialize};

use super::GeometryError;
use super::error::finite;

/// Largest polynomial degree of a basis.
pub const MAX_DEGREE: usize = 10;

/// Largest number of spans (elements) of a basis.
pub const MAX_SPANS: usize = 400_000;

/// Largest span length that is attributed to rounding, as a fraction of the domain. A knot vector with such a span is rejected.
const SHORTEST_SPAN: f64 = 1e-12;

/// Open knot vector of degree `p`: knots `ξ_0 ≤ … ≤ ξ_m` on an interval `[a, b]`.
/// End knots are repeated exactly `p + 1` times, interior knots at most `p` times, so that splines are at least continuous.
/// Knots are dimensionless. See The NURBS Book, section 2.2.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "(usize, Vec<f64>)")]
pub struct KnotVector {
    degree: usize,
    knots: Vec<f64>,
}

/// Knot interval of nonzero length, or Lagrange element. Each basis function is a single polynomial on a span.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// First basis function that is nonzero on the span. The next `degree` functions are also nonzero.
    pub first: usize,
    /// Start of the span [-].
    pub start: f64,
    /// End of the span [-].
    pub end: f64,
}

impl TryFrom<(usize, Vec<f64>)> for KnotVector {
    type Error = GeometryError;

    fn try_from((degree, knots): (usize, Vec<f64>)) -> Result<Self, GeometryError> {
        Self::new(degree, knots)
    }
}

impl KnotVector {
    /// Creates the knot vector of `degree` 1 to [`MAX_DEGREE`] with the given `knots`.
    ///
    /// # Errors
    /// Fails for a degree out of range, too few knots, and knots that are not finite, decreasing or all equal.
    /// Fails if end knots are not repeated `degree + 1` times, or interior knots are repeated more than `degree` times.
    /// Fails for spans shorter than 1e-12 of the domain, or more than [`MAX_SPANS`] spans.
    pub fn new(degree: usize, knots: Vec<f64>) -> Result<Self, GeometryError> {
        check_degree(degree, MAX_DEGREE)?;
        if knots.len() < 2 * (degree + 1) {
            return Err(GeometryError::TooFewKnots { count: knots.len(), degree });
        }
        for (index, &knot) in knots.iter().enumerate() {
            finite(format!("knot {index}"), knot)?;
        }
        let vector = Self { degree, knots };
        vector.check_order()?;
        vector.check_multiplicities()?;
        Ok(vector)
    }

    /// Creates a knot vector with `spans` equal spans on `[0, 1]`.
    /// Splines have `continuity` continuous derivatives at interior knots.
    ///
    /// # Errors
    /// Fails for `spans` outside 1 to [`MAX_SPANS`], `degree` outside 1 to [`MAX_DEGREE`], or `continuity` not below `degree`.
    pub fn uniform(spans: usize, degree: usize, continuity: usize) -> Result<Self, GeometryError> {
        check_degree(degree, MAX_DEGREE)?;
        check_spans(spans)?;
        if continuity >= degree {
            return Err(GeometryError::Continuity { continuity, degree });
        }
        let interior = (1..spans).map(|i| i as f64 / spans as f64);
        let ends = |knot| std::iter::repeat_n(knot, degree + 1);
        let knots = ends(0.0)
            .chain(interior.flat_map(|knot| std::iter::repeat_n(knot, degree - continuity)))
            .chain(ends(1.0))
            .collect();
        Ok(Self { degree, knots })
    }

    /// Polynomial degree `p`.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Knots [-], with repetitions.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Number of basis functions: the number of knots minus `p + 1`.
    pub fn functions(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// First and last knot, `(a, b)` [-].
    pub fn domain(&self) -> (f64, f64) {
        (self.knots[0], self.knots[self.knots.len() - 1])
    }

    /// Nonempty spans, in order.
    pub fn spans(&self) -> Vec<Span> {
        self.knots[self.degree..=self.functions()]
            .windows(2)
            .enumerate()
            .filter(|(_, ends)| ends[0] < ends[1])
            .map(|(first, ends)| Span { first, start: ends[0], end: ends[1] })
            .collect()
    }

    /// Distinct knots [-] in increasing order, including the first and the last knot.
    pub fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.knots.clone();
        breaks.dedup();
        breaks
    }

    /// Multiplicity of `xi` among the knots.
    pub fn multiplicity(&self, xi: f64) -> usize {
        self.knots.partition_point(|&knot| knot <= xi)
            - self.knots.partition_point(|&knot| knot < xi)
    }

    /// Index `i` with `ξ_i ≤ xi < ξ_{i+1}`; at the right end, the index of the last nonempty span (The NURBS Book, algorithm A2.1).
    /// The basis functions `i - p` to `i` are nonzero at `xi`, where `i` is the index of the span and `p` the degree.
    ///
    /// # Errors
    /// Fails if `xi` is outside the domain or NaN.
    pub fn span_at(&self, xi: f64) -> Result<usize, GeometryError> {
        let (start, end) = self.domain();
        check_inside(xi, start, end)?;
        let behind = self.knots.partition_point(|&knot| knot <= xi);
        Ok((behind - 1).min(self.functions() - 1))
    }

    /// Returns the knot vector with `xi` inserted `times` times.
    ///
    /// # Errors
    /// Fails if `xi` is not strictly inside the domain, too close to another knot (1e-12 of the domain), or repeated more often than the degree.
    /// Also fails if there would be more than [`MAX_SPANS`] spans.
    pub fn insert(&self, xi: f64, times: usize) -> Result<Self, GeometryError> {
        let (start, end) = self.domain();
        if !(start < xi && xi < end) {
            return Err(GeometryError::InsertOutside { xi, start, end });
        }
        let multiplicity = self.multiplicity(xi).saturating_add(times);
        if multiplicity > self.degree {
            return Err(GeometryError::InteriorMultiplicity {
                knot: xi,
                multiplicity,
                degree: self.degree,
            });
        }
        let behind = self.knots.partition_point(|&knot| knot <= xi);
        let mut knots = self.knots.clone();
        knots.splice(behind..behind, std::iter::repeat_n(xi, times));
        Self::new(self.degree, knots)
    }

    /// Greville abscissae `(ξ_{i+1} + … + ξ_{i+p}) / p`, one per basis function, strictly increasing.
    /// If the control points of a curve lie on a line at the Greville abscissae, the curve has uniform speed.
    pub fn greville(&self) -> Vec<f64> {
        self.knots[1..self.knots.len() - 1]
            .windows(self.degree)
            .map(|knots| {
                let (low, high) = (knots[0], knots[knots.len() - 1]);
                // The mean of equal numbers may have a rounding error, but the end abscissae must be exact.
                if low == high {
                    low
                } else {
                    (knots.iter().sum::<f64>() / self.degree as f64).clamp(low, high)
                }
            })
            .collect()
    }

    pub(super) fn is_affine_to(&self, other: &Self) -> bool {
        self.degree == other.degree
            && self.knots.len() == other.knots.len()
            && self
                .normalised()
                .zip(other.normalised())
                .all(|(own, others)| (own - others).abs() <= SHORTEST_SPAN)
    }

    fn normalised(&self) -> impl Iterator<Item = f64> {
        let (start, end) = self.domain();
        self.knots.iter().map(move |knot| (knot - start) / (end - start))
    }

    fn check_order(&self) -> Result<(), GeometryError> {
        let (start, end) = self.domain();
        for (index, pair) in self.knots.windows(2).enumerate() {
            if pair[1] < pair[0] {
                return Err(GeometryError::DecreasingKnots {
                    index: index + 1,
                    value: pair[1],
                    previous: pair[0],
                });
            }
        }
        if start == end {
            return Err(GeometryError::EmptyDomain { knot: start });
        }
        let breaks = self.breaks();
        check_spans(breaks.len() - 1)?;
        check_span_lengths("knots", &breaks)
    }

    fn check_multiplicities(&self) -> Result<(), GeometryError> {
        let degree = self.degree;
        let (start, end) = self.domain();
        for (name, knot) in [("first", start), ("last", end)] {
            let multiplicity = self.multiplicity(knot);
            if multiplicity != degree + 1 {
                return Err(GeometryError::EndMultiplicity {
                    end: name,
                    knot,
                    multiplicity,
                    degree,
                });
            }
        }
        let interior = &self.knots[degree + 1..self.functions()];
        match interior.chunk_by(|a, b| a == b).find(|equal| equal.len() > degree) {
            None => Ok(()),
            Some(equal) => Err(GeometryError::InteriorMultiplicity {
                knot: equal[0],
                multiplicity: equal.len(),
                degree,
            }),
        }
    }
}

pub(super) fn check_degree(degree: usize, largest: usize) -> Result<(), GeometryError> {
    if (1..=largest).contains(&degree) {
        Ok(())
    } else {
        Err(GeometryError::Degree { degree, largest })
    }
}

pub(super) fn check_spans(spans: usize) -> Result<(), GeometryError> {
    if (1..=MAX_SPANS).contains(&spans) {
        Ok(())
    } else {
        Err(GeometryError::Spans { spans, largest: MAX_SPANS })
    }
}

pub(super) fn check_span_lengths(
    object: &'static str,
    breaks: &[f64],
) -> Result<(), GeometryError> {
    let length = finite(
        format!("length of the domain of the {object}"),
        breaks[breaks.len() - 1] - breaks[0],
    )?;
    match breaks.windows(2).find(|ends| ends[1] - ends[0] < SHORTEST_SPAN * length) {
        None => Ok(()),
        Some(ends) => Err(GeometryError::ShortSpan { object, start: ends[0], end: ends[1] }),
    }
}

pub(super) fn check_inside(xi: f64, start: f64, end: f64) -> Result<(), GeometryError> {
    if (start..=end).contains(&xi) {
        Ok(())
    } else {
        Err(GeometryError::OutsideDomain { xi, start, end })
    }
}

#[cfg(test)]
mod tests;
