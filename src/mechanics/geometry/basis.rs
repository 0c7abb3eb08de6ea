//! Bases of functions on an interval: B-splines and Lagrange elements.

use serde::{Deserialize, Serialize};

use super::knots::check_inside;
use super::values::LowDerivatives;
use super::{
    BasisValues, GeometryError, KnotVector, LagrangeBasis, MAX_DEGREE, Span, Vec2, bspline,
};

/// Largest distance between a break and a knot that count as equal, as a fraction of the domain.
const SAME_BREAK: f64 = 1e-10;

/// Basis functions `N_i(ξ)` whose sum is one. Each function is nonzero on a few spans only.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Basis {
    /// B-splines of a knot vector.
    BSpline(KnotVector),
    /// Lagrange polynomials on elements.
    Lagrange(LagrangeBasis),
}

impl Basis {
    /// Polynomial degree.
    pub fn degree(&self) -> usize {
        match self {
            Self::BSpline(knots) => knots.degree(),
            Self::Lagrange(lagrange) => lagrange.degree(),
        }
    }

    /// Number of functions.
    pub fn functions(&self) -> usize {
        match self {
            Self::BSpline(knots) => knots.functions(),
            Self::Lagrange(lagrange) => lagrange.functions(),
        }
    }

    /// Interval of the parameter ξ [-], given by its start and end.
    pub fn domain(&self) -> (f64, f64) {
        match self {
            Self::BSpline(knots) => knots.domain(),
            Self::Lagrange(lagrange) => lagrange.domain(),
        }
    }

    /// Intervals between the breaks, in order. The basis functions are polynomials on each interval.
    pub fn spans(&self) -> Vec<Span> {
        match self {
            Self::BSpline(knots) => knots.spans(),
            Self::Lagrange(lagrange) => lagrange.spans(),
        }
    }

    /// Parameters at which spans begin or end, in order, including the ends of the domain [-].
    pub fn breaks(&self) -> Vec<f64> {
        match self {
            Self::BSpline(knots) => knots.breaks(),
            Self::Lagrange(lagrange) => lagrange.breaks().to_vec(),
        }
    }

    /// Span that contains the parameter `xi` [-]; at a break, the span on the right.
    ///
    /// # Errors
    /// Fails if `xi` is outside the domain or NaN.
    pub fn span_at(&self, xi: f64) -> Result<Span, GeometryError> {
        match self {
            Self::BSpline(knots) => {
                let i = knots.span_at(xi)?;
                Ok(Span {
                    first: i - knots.degree(),
                    start: knots.knots()[i],
                    end: knots.knots()[i + 1],
                })
            }
            Self::Lagrange(lagrange) => lagrange.span_at(xi),
        }
    }

    /// Nonzero basis functions at `xi` and their derivatives; at interior breaks, the limits from the right.
    ///
    /// # Errors
    /// Fails if `xi` is outside the domain or NaN.
    pub fn evaluate(&self, xi: f64) -> Result<BasisValues, GeometryError> {
        Ok(self.evaluate_in(&self.span_at(xi)?, xi))
    }

    /// Basis functions of a span of this basis at any `xi`. Outside the span, their polynomials are extended.
    ///
    /// # Panics
    /// May panic if the given span does not belong to this basis.
    pub(crate) fn evaluate_in(&self, span: &Span, xi: f64) -> BasisValues {
        match self {
            Self::BSpline(knots) => bspline::evaluate(knots, span, xi),
            Self::Lagrange(lagrange) => lagrange.evaluate_in(span, xi),
        }
    }

    pub(crate) fn curve_in(&self, span: &Span, xi: f64, points: &[Vec2]) -> [Vec2; 3] {
        match self.degree() {
            3 => self.evaluate_low::<4>(span, xi).combine(points),
            _ => self.evaluate_low::<{ MAX_DEGREE + 1 }>(span, xi).combine(points),
        }
    }

    #[inline]
    pub(super) fn evaluate_low<const WIDTH: usize>(
        &self,
        span: &Span,
        xi: f64,
    ) -> LowDerivatives<WIDTH> {
        let degree = if WIDTH > MAX_DEGREE { self.degree() } else { WIDTH - 1 };
        let mut low = LowDerivatives::zeros(span.first, degree);
        match self {
            Self::BSpline(knots) => bspline::fill((knots, degree), span, xi, low.rows_mut()),
            Self::Lagrange(lagrange) => lagrange.fill(span, xi, low.rows_mut()),
        }
        low
    }

    /// Smallest number of continuous derivatives at any interior break; the degree for a single polynomial.
    pub fn continuity(&self) -> usize {
        let breaks = self.breaks();
        match self {
            Self::Lagrange(_) if breaks.len() > 2 => 0,
            Self::Lagrange(lagrange) => lagrange.degree(),
            Self::BSpline(knots) => {
                let interior = &breaks[1..breaks.len() - 1];
                knots.degree()
                    - interior.iter().map(|&knot| knots.multiplicity(knot)).max().unwrap_or(0)
            }
        }
    }

    /// Interpolation parameter of each function: the Greville abscissae of splines, or the nodes of Lagrange elements.
    pub(crate) fn abscissae(&self) -> Vec<f64> {
        match self {
            Self::BSpline(knots) => knots.greville(),
            Self::Lagrange(lagrange) => lagrange.nodes(),
        }
    }

    /// Returns a basis of the same type with about `ratio` times as many spans.
    /// Breaks of reduced continuity are kept, with at least one span between two such breaks.
    ///
    /// # Errors
    /// Fails if the resulting basis has too many or too short spans.
    pub fn with_span_ratio(&self, ratio: f64) -> Result<Self, GeometryError> {
        let breaks = self.breaks();
        let knots = match self {
            Self::Lagrange(lagrange) => {
                let breaks = respaced(&breaks, ratio);
                return Ok(Self::Lagrange(LagrangeBasis::new(lagrange.degree(), breaks)?));
            }
            Self::BSpline(knots) => knots,
        };
        let interior = &breaks[1..breaks.len() - 1];
        let usual = interior.iter().map(|knot| knots.multiplicity(*knot)).min().unwrap_or(1);
        let is_kept = |knot: f64| knots.multiplicity(knot) > usual;
        let mut scaled = vec![breaks[0]; knots.degree() + 1];
        let mut first = 0;
        for last in 1..breaks.len() {
            if !is_kept(breaks[last]) && last + 1 < breaks.len() {
                continue;
            }
            let piece = respaced(&breaks[first..=last], ratio);
            let inside = piece[1..piece.len() - 1].iter();
            scaled.extend(inside.flat_map(|knot| std::iter::repeat_n(*knot, usual)));
            scaled.extend(std::iter::repeat_n(breaks[last], knots.multiplicity(breaks[last])));
            first = last;
        }
        Ok(Self::BSpline(KnotVector::new(knots.degree(), scaled)?))
    }

    /// Returns the basis with continuity C⁰ at `xi`.
    /// If a knot is closer to `xi` than 1e-10 of the domain, this knot is used instead of `xi`.
    /// The basis is not changed at the ends of the domain, or where it is already C⁰.
    ///
    /// # Errors
    /// Fails if `xi` is outside the domain or NaN, or if the basis would have too many spans.
    pub(crate) fn with_break(&self, xi: f64) -> Result<Self, GeometryError> {
        let (start, end) = self.domain();
        check_inside(xi, start, end)?;
        let breaks = self.breaks();
        let tolerance = SAME_BREAK * (end - start);
        let behind = breaks.partition_point(|&value| value < xi - tolerance);
        let existing = breaks.get(behind).copied().filter(|value| *value <= xi + tolerance);
        match (self, existing) {
            (_, Some(knot)) if knot == start || knot == end => Ok(self.clone()),
            (Self::Lagrange(_), Some(_)) => Ok(self.clone()),
            (Self::Lagrange(lagrange), None) => Ok(Self::Lagrange(lagrange.split(xi)?)),
            (Self::BSpline(knots), _) => {
                let knot = existing.unwrap_or(xi);
                Ok(Self::BSpline(knots.insert(knot, knots.degree() - knots.multiplicity(knot))?))
            }
        }
    }
}

fn respaced(breaks: &[f64], ratio: f64) -> Vec<f64> {
    let old = (breaks.len() - 1) as f64;
    let new = (old * ratio).ceil().max(1.0);
    let place = |index: usize| {
        let from = index as f64 * old / new;
        let below = (from as usize).min(breaks.len() - 2);
        let share = from - below as f64;
        breaks[below] * (1.0 - share) + breaks[below + 1] * share
    };
    (0..=new as usize).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::samples::bases;
    use proptest::prelude::*;

    fn spline(spans: usize, degree: usize, continuity: usize) -> Basis {
        Basis::BSpline(KnotVector::uniform(spans, degree, continuity).unwrap())
    }

    fn lagrange(elements: usize, degree: usize) -> Basis {
        Basis::Lagrange(LagrangeBasis::uniform(elements, degree).unwrap())
    }

    #[test]
    fn continuity_is_that_of_the_least_smooth_break() {
        assert_eq!(spline(4, 3, 1).continuity(), 1);
        assert_eq!(spline(1, 3, 1).continuity(), 3);
        assert_eq!(spline(4, 3, 2).with_break(0.3).unwrap().continuity(), 0);
        assert_eq!(lagrange(2, 3).continuity(), 0);
        assert_eq!(lagrange(1, 3).continuity(), 3);
    }

    #[test]
    fn values_at_breaks_are_right_limits_unless_a_span_is_given() {
        let basis = spline(2, 2, 0);
        assert_eq!(basis.evaluate(0.5).unwrap().slopes(), [-4.0, 4.0, 0.0]);
        let left = basis.evaluate_in(&basis.spans()[0], 0.5);
        assert_eq!((left.first, left.slopes()), (0, &[0.0, -4.0, 4.0][..]));
        assert!(basis.evaluate(1.0 + 1e-15).is_err());
    }

    #[test]
    fn break_near_a_knot_uses_that_knot() {
        let smooth = spline(2, 3, 2);
        let Basis::BSpline(knots) = smooth.with_break(0.5 + 1e-11).unwrap() else {
            panic!("not a spline")
        };
        assert_eq!((knots.multiplicity(0.5), knots.functions()), (3, 7));
        let broken = Basis::BSpline(knots);
        assert_eq!(broken.with_break(0.5 - 1e-11).unwrap(), broken);
        for end in [0.0, 1e-11, 1.0 - 1e-11, 1.0] {
            assert_eq!(smooth.with_break(end).unwrap(), smooth);
            assert_eq!(lagrange(2, 2).with_break(end).unwrap(), lagrange(2, 2));
        }
        assert_eq!(lagrange(2, 2).with_break(0.5 + 1e-11).unwrap(), lagrange(2, 2));
        assert_eq!(lagrange(2, 2).with_break(0.3).unwrap().breaks(), [0.0, 0.3, 0.5, 1.0]);
        assert!(smooth.with_break(f64::NAN).is_err());
        assert!(smooth.with_break(1.1).is_err());
    }

    fn inside(basis: &Basis, t: f64) -> (Span, f64) {
        let spans = basis.spans();
        let place = t * spans.len() as f64;
        let span = spans[place as usize];
        (span, span.start + (0.1 + 0.8 * place.fract()) * (span.end - span.start))
    }

    proptest! {
        #[test]
        fn basis_values_sum_to_one_and_derivatives_to_zero(basis in bases(), t in 0.0..1.0f64) {
            let (start, end) = basis.domain();
            let places = basis.breaks().into_iter().chain([(1.0 - t) * start + t * end]);
            for xi in places {
                let at = basis.evaluate(xi.clamp(start, end)).unwrap();
                prop_assert!((at.values().iter().sum::<f64>() - 1.0).abs() < 1e-14);
                for order in 1..=basis.degree() {
                    let row = at.derivatives(order);
                    let size: f64 = row.iter().map(|n| n.abs()).sum();
                    prop_assert!(row.iter().sum::<f64>().abs() <= 1e-13 * size);
                }
            }
        }

        #[test]
        fn basis_derivatives_agree_with_finite_differences(basis in bases(), t in 0.0..1.0f64) {
            let (span, xi) = inside(&basis, t);
            let h = 1e-6 * (span.end - span.start);
            let (left, at, right) =
                (basis.evaluate_in(&span, xi - h), basis.evaluate(xi).unwrap(), basis.evaluate_in(&span, xi + h));
            for order in 0..basis.degree() {
                let (low, high) = (left.derivatives(order), right.derivatives(order));
                let slopes = at.derivatives(order + 1);
                let size = low.iter().chain(high).fold(0.0, |a: f64, b| a.max(b.abs())) / (span.end - span.start);
                for ((low, high), slope) in low.iter().zip(high).zip(slopes) {
                    prop_assert!(((high - low) / (2.0 * h) - slope).abs() <= 1e-6 * size.max(slope.abs()));
                }
            }
        }

        #[test]
        fn spline_smoothness_matches_the_knot_multiplicity(basis in bases()) {
            let Basis::BSpline(knots) = &basis else { return Ok(()) };
            for pair in basis.spans().windows(2) {
                let xi = pair[0].end;
                let (left, right) = (basis.evaluate_in(&pair[0], xi), basis.evaluate_in(&pair[1], xi));
                let multiplicity = knots.multiplicity(xi);
                for order in 0..=knots.degree() - multiplicity {
                    let (low, high) = (left.derivatives(order), right.derivatives(order));
                    let size = low.iter().chain(high).fold(0.0, |a: f64, b| a.max(b.abs()));
                    for (a, b) in low[multiplicity..].iter().zip(high) {
                        prop_assert!((a - b).abs() <= 1e-10 * size);
                    }
                }
            }
        }

        #[test]
        fn a_break_makes_a_kink_and_keeps_the_other_breaks(basis in bases(), t in 0.01..0.99f64) {
            let (start, end) = basis.domain();
            let broken = basis.with_break((1.0 - t) * start + t * end).unwrap();
            prop_assert_eq!(broken.continuity(), 0);
            let breaks = broken.breaks();
            prop_assert!(basis.breaks().iter().all(|old| breaks.contains(old)));
            prop_assert!(breaks.len() <= basis.breaks().len() + 1);
        }
    }

    #[test]
    fn changing_the_number_of_spans_keeps_grading_and_kinks() {
        let breaks = |basis: &Basis, ratio: f64| basis.with_span_ratio(ratio).unwrap().breaks();
        let uniform = spline(8, 3, 2);
        assert_eq!(uniform.with_span_ratio(0.5).unwrap(), spline(4, 3, 2));
        assert_eq!(uniform.with_span_ratio(2.0).unwrap(), spline(16, 3, 2));
        assert_eq!(spline(7, 3, 1).with_span_ratio(0.5).unwrap().spans().len(), 4);
        assert_eq!(spline(4, 2, 0).with_span_ratio(0.5).unwrap(), spline(2, 2, 0));
        assert_eq!(spline(1, 3, 2).with_span_ratio(0.5).unwrap(), spline(1, 3, 2));
        let kinked = uniform.with_break(0.25).unwrap().with_span_ratio(0.5).unwrap();
        assert_eq!((kinked.breaks(), kinked.continuity()), (vec![0.0, 0.25, 0.5, 0.75, 1.0], 0));
        let graded = KnotVector::new(1, vec![0.0, 0.0, 0.1, 0.3, 0.6, 1.0, 1.0]).unwrap();
        assert_eq!(breaks(&Basis::BSpline(graded), 0.5), [0.0, 0.3, 1.0]);
        let lagrange = Basis::Lagrange(LagrangeBasis::uniform(4, 2).unwrap());
        assert_eq!(breaks(&lagrange, 0.25), [0.0, 1.0]);
    }
}
