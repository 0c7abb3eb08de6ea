//! Open knot vectors: where the polynomial pieces of a spline meet, and how smoothly.

use serde::{Deserialize, Serialize};

use super::GeometryError;
use super::error::finite;

/// The largest polynomial degree of a basis.
pub const MAX_DEGREE: usize = 10;

/// The largest number of spans (elements) of a basis.
pub const MAX_SPANS: usize = 400_000;

/// Spans shorter than this fraction of the domain are taken for a slip of rounding and refused.
const SHORTEST_SPAN: f64 = 1e-12;

/// An open knot vector of some degree `p`: knots `ξ_0 ≤ … ≤ ξ_m` on an interval `[a, b]`, the end
/// knots repeated exactly `p + 1` times, interior knots at most `p` times (so splines are at least
/// continuous). Knots are dimensionless. The NURBS Book, section 2.2.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "(usize, Vec<f64>)")]
pub struct KnotVector {
    degree: usize,
    knots: Vec<f64>,
}

/// A non-empty knot interval, or a Lagrange element: the functions of a basis are one polynomial each on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// The index of the first basis function that is not zero on the span; the others are the next `degree`.
    pub first: usize,
    /// The parameter at which the span starts [-].
    pub start: f64,
    /// The parameter at which the span ends [-].
    pub end: f64,
}

/// From degree and knots, as stored.
impl TryFrom<(usize, Vec<f64>)> for KnotVector {
    type Error = GeometryError;

    fn try_from((degree, knots): (usize, Vec<f64>)) -> Result<Self, GeometryError> {
        Self::new(degree, knots)
    }
}

impl KnotVector {
    /// The knot vector of `degree` 1 to [`MAX_DEGREE`] with the given `knots`.
    ///
    /// # Errors
    /// A degree not on offer; knots that are too few, not finite, decreasing or all equal; end knots
    /// not repeated `degree + 1` times, interior ones more than `degree` times; a span shorter than
    /// 1e-12 of the domain; more than [`MAX_SPANS`] spans.
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

    /// `spans` equal spans on `[0, 1]` with `continuity` continuous derivatives at the interior knots,
    /// whose multiplicity is `degree - continuity`.
    ///
    /// # Errors
    /// `spans` outside 1 to [`MAX_SPANS`], `degree` outside 1 to [`MAX_DEGREE`], `continuity` not below
    /// `degree`.
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

    /// The polynomial degree `p` of the splines of the knot vector.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All knots of the vector [-], repeated ones as often as they count.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The number of basis functions of the knot vector: the number of knots less `p + 1`.
    pub fn functions(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// First and last knot of the vector, `(a, b)` [-].
    pub fn domain(&self) -> (f64, f64) {
        (self.knots[0], self.knots[self.knots.len() - 1])
    }

    /// The non-empty spans of the knot vector, in order.
    pub fn spans(&self) -> Vec<Span> {
        self.knots[self.degree..=self.functions()]
            .windows(2)
            .enumerate()
            .filter(|(_, ends)| ends[0] < ends[1])
            .map(|(first, ends)| Span { first, start: ends[0], end: ends[1] })
            .collect()
    }

    /// The distinct knots of the vector [-] in order, ends included.
    pub fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.knots.clone();
        breaks.dedup();
        breaks
    }

    /// How often `xi` occurs among the knots of the vector.
    pub fn multiplicity(&self, xi: f64) -> usize {
        self.knots.partition_point(|&knot| knot <= xi)
            - self.knots.partition_point(|&knot| knot < xi)
    }

    /// The index `i` with `ξ_i ≤ xi < ξ_{i+1}`, for the right end that of the last non-empty span
    /// (The NURBS Book, algorithm A2.1). The functions `i - p` to `i` are non-zero there.
    ///
    /// # Errors
    /// `xi` outside the domain, or not a number.
    pub fn span_at(&self, xi: f64) -> Result<usize, GeometryError> {
        let (start, end) = self.domain();
        check_inside(xi, start, end)?;
        let behind = self.knots.partition_point(|&knot| knot <= xi);
        Ok((behind - 1).min(self.functions() - 1))
    }

    /// The same knot vector with `xi` repeated `times` more.
    ///
    /// # Errors
    /// `xi` not strictly inside the domain, closer than 1e-12 of it to another knot, or repeated more
    /// than `degree` times in the end.
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

    /// The Greville abscissae `(ξ_{i+1} + … + ξ_{i+p}) / p`, one per basis function and strictly
    /// increasing: control points placed on a line at these parameters draw it with uniform speed.
    pub fn greville(&self) -> Vec<f64> {
        self.knots[1..self.knots.len() - 1]
            .windows(self.degree)
            .map(|knots| {
                let (low, high) = (knots[0], knots[knots.len() - 1]);
                // The mean of equal numbers may round to another one; ends must be hit exactly.
                if low == high {
                    low
                } else {
                    (knots.iter().sum::<f64>() / self.degree as f64).clamp(low, high)
                }
            })
            .collect()
    }

    /// Whether an affine map of the parameter makes `other` out of this knot vector, up to rounding.
    pub(super) fn is_affine_to(&self, other: &Self) -> bool {
        self.degree == other.degree
            && self.knots.len() == other.knots.len()
            && self
                .normalised()
                .zip(other.normalised())
                .all(|(own, others)| (own - others).abs() <= SHORTEST_SPAN)
    }

    /// The knots mapped to `[0, 1]`.
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

/// Refuses a `degree` outside 1 to `largest`.
pub(super) fn check_degree(degree: usize, largest: usize) -> Result<(), GeometryError> {
    if (1..=largest).contains(&degree) {
        Ok(())
    } else {
        Err(GeometryError::Degree { degree, largest })
    }
}

/// Refuses a number of `spans` outside 1 to [`MAX_SPANS`].
pub(super) fn check_spans(spans: usize) -> Result<(), GeometryError> {
    if (1..=MAX_SPANS).contains(&spans) {
        Ok(())
    } else {
        Err(GeometryError::Spans { spans, largest: MAX_SPANS })
    }
}

/// Refuses a domain of infinite length and spans that are nothing but rounding; `breaks` increase.
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

/// Refuses a parameter `xi` outside `[start, end]`, and NaN.
pub(super) fn check_inside(xi: f64, start: f64, end: f64) -> Result<(), GeometryError> {
    if (start..=end).contains(&xi) {
        Ok(())
    } else {
        Err(GeometryError::OutsideDomain { xi, start, end })
    }
}

#[cfg(test)]
mod tests;
