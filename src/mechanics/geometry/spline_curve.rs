//! Curves made of B-splines.

use serde::{Deserialize, Serialize};

use super::arc_length::{integrate, invert};
use super::error::{finite, finite_point};
use super::{BasisValues, GeometryError, KnotVector, Span, Vec2, bspline};

/// Accuracy of arc lengths, as a fraction of the length of the control polygon.
const LENGTH_ACCURACY: f64 = 1e-14;

/// B-spline curve `x(ξ) = Σ_i N_i(ξ) P_i` (The NURBS Book, section 3.2), with its arc length at the knots.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "(KnotVector, Vec<Vec2>)")]
pub struct SplineCurve {
    knots: KnotVector,
    control_points: Vec<Vec2>,
    #[serde(skip)]
    spans: Vec<Span>,
    /// Arc lengths at the starts of the spans, followed by the arc length at the end of the curve.
    #[serde(skip)]
    lengths: Vec<f64>,
    #[serde(skip)]
    tolerance: f64,
}

impl TryFrom<(KnotVector, Vec<Vec2>)> for SplineCurve {
    type Error = GeometryError;

    fn try_from((knots, points): (KnotVector, Vec<Vec2>)) -> Result<Self, GeometryError> {
        Self::new(knots, points)
    }
}

impl SplineCurve {
    /// Creates the curve from `control_points` [length], one per basis function of `knots`.
    ///
    /// # Errors
    /// Fails if the numbers of control points and basis functions differ, coordinates are not finite, or all control points coincide.
    pub fn new(knots: KnotVector, control_points: Vec<Vec2>) -> Result<Self, GeometryError> {
        let (points, functions) = (control_points.len(), knots.functions());
        if points != functions {
            return Err(GeometryError::ControlPointCount { points, functions });
        }
        for (index, &point) in control_points.iter().enumerate() {
            finite_point(format!("control point {index}"), point)?;
        }
        let polygon: f64 = control_points.windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum();
        if finite("length of the control polygon", polygon)? == 0.0 {
            return Err(GeometryError::ZeroLengthSpline { point: control_points[0] });
        }
        let spans = knots.spans();
        let tolerance = LENGTH_ACCURACY * polygon;
        let mut curve = Self { knots, control_points, spans, lengths: vec![0.0], tolerance };
        let mut length = 0.0;
        for span in curve.spans.clone() {
            length += integrate(&|xi| curve.speed(&span, xi), span.start, span.end, tolerance);
            curve.lengths.push(length);
        }
        Ok(curve)
    }

    /// Knot vector.
    pub fn knots(&self) -> &KnotVector {
        &self.knots
    }

    /// Control points [length], one per basis function.
    pub fn control_points(&self) -> &[Vec2] {
        &self.control_points
    }

    /// Returns the same curve with the knot `xi` inserted `times` times (Boehm 1980; The NURBS Book, section 5.2, equation 5.15).
    ///
    /// # Errors
    /// Fails in the same cases as [`KnotVector::insert`].
    pub fn insert(&self, xi: f64, times: usize) -> Result<Self, GeometryError> {
        let finer = self.knots.insert(xi, times)?;
        let mut control_points = self.control_points.clone();
        let mut knots = self.knots.clone();
        for _ in 0..times {
            control_points = insert_once(&knots, &control_points, xi)?;
            knots = knots.insert(xi, 1)?;
        }
        Self::new(finer, control_points)
    }

    pub(super) fn derivative(&self, xi: f64, order: usize) -> Result<Vec2, GeometryError> {
        let span = self.span(self.knots.span_at(xi)?);
        Ok(self.basis_in(&span, xi).combine(order, &self.control_points))
    }

    pub(super) fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    pub(super) fn length_to(&self, xi: f64) -> Result<f64, GeometryError> {
        let span = self.span(self.knots.span_at(xi)?);
        let number = self.spans.partition_point(|other| other.first < span.first);
        if xi == span.end {
            return Ok(self.lengths[number + 1]);
        }
        let within = integrate(&|xi| self.speed(&span, xi), span.start, xi, self.tolerance);
        Ok((self.lengths[number] + within).min(self.lengths[number + 1]))
    }

    /// Parameter of the curve [-] at `arc_length` [length], which must be in `[0, length]`.
    pub(super) fn parameter_at(&self, arc_length: f64) -> f64 {
        let behind = self.lengths.partition_point(|&length| length <= arc_length);
        if behind == self.lengths.len() {
            return self.knots.domain().1;
        }
        let (span, before) = (self.spans[behind - 1], self.lengths[behind - 1]);
        if arc_length == before {
            return span.start;
        }
        invert(
            &|xi| self.speed(&span, xi),
            span.start,
            span.end,
            arc_length - before,
            self.tolerance,
        )
    }

    fn span(&self, index: usize) -> Span {
        let knots = self.knots.knots();
        Span { first: index - self.knots.degree(), start: knots[index], end: knots[index + 1] }
    }

    fn basis_in(&self, span: &Span, xi: f64) -> BasisValues {
        bspline::evaluate(&self.knots, span, xi)
    }

    fn speed(&self, span: &Span, xi: f64) -> f64 {
        self.basis_in(span, xi).combine(1, &self.control_points).norm()
    }
}

fn insert_once(knots: &KnotVector, points: &[Vec2], xi: f64) -> Result<Vec<Vec2>, GeometryError> {
    let (span, degree, multiplicity) = (knots.span_at(xi)?, knots.degree(), knots.multiplicity(xi));
    let divide = |i: usize| {
        let (start, end) = (knots.knots()[i], knots.knots()[i + degree]);
        let t = (xi - start) / (end - start);
        (1.0 - t) * points[i - 1] + t * points[i]
    };
    let moved = (span - degree + 1)..=(span - multiplicity);
    let before = points[..*moved.start()].iter().copied();
    let after = points[*moved.end()..].iter().copied();
    Ok(before.chain(moved.map(divide)).chain(after).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::samples::spline_curves;
    use proptest::prelude::*;

    #[test]
    fn invalid_control_points_are_rejected() {
        let refusal = |points: &[Vec2]| {
            let knots = KnotVector::uniform(1, 2, 0).unwrap();
            SplineCurve::new(knots, points.to_vec()).unwrap_err().to_string()
        };
        let point = Vec2::new(1.0, 0.0);
        assert_eq!(
            refusal(&[point; 4]),
            "control points: 4 given; the knot vector has 3 basis functions and needs one each"
        );
        assert_eq!(
            refusal(&[point; 3]),
            "spline: all control points are (1, 0); at least one must differ"
        );
        assert_eq!(
            refusal(&[point, Vec2::new(0.0, f64::NAN), point]),
            "control point 1 is NaN, but must be a finite number"
        );
    }

    #[test]
    fn spline_parabola_has_the_exact_length() {
        let knots = KnotVector::uniform(1, 2, 0).unwrap();
        let points = vec![Vec2::new(0.0, 0.0), Vec2::new(0.5, 0.0), Vec2::new(1.0, 1.0)];
        let curve = SplineCurve::new(knots, points).unwrap();
        let exact = 0.5 * 5f64.sqrt() + 0.25 * 2f64.asinh();
        assert!((curve.length() - exact).abs() < 1e-14);
        assert_eq!(curve.parameter_at(curve.length()), 1.0);
        assert_eq!(curve.parameter_at(0.0), 0.0);
    }

    proptest! {
        #[test]
        fn knot_insertion_leaves_the_curve_unchanged(curve in spline_curves(), t in 0.01..0.99f64, at_knot: bool) {
            let (start, end) = curve.knots.domain();
            let breaks = curve.knots.breaks();
            let between = (1.0 - t) * start + t * end;
            let xi = if at_knot && breaks.len() > 2 { breaks[1] } else { between };
            let room = curve.knots.degree() - curve.knots.multiplicity(xi);
            for times in 0..=room {
                let finer = curve.insert(xi, times).unwrap();
                prop_assert_eq!(finer.control_points.len(), curve.control_points.len() + times);
                for s in 0..=20 {
                    let at = (start + (end - start) * f64::from(s) / 20.0).clamp(start, end);
                    let (old, new) = (curve.derivative(at, 0).unwrap(), finer.derivative(at, 0).unwrap());
                    prop_assert!((old - new).norm() < 1e-13);
                }
                prop_assert!((finer.length() - curve.length()).abs() < 1e-12 * curve.length());
            }
            prop_assert!(curve.insert(xi, room + 1).is_err());
        }

        #[test]
        fn parameter_and_length_invert_each_other(curve in spline_curves(), t in 0.0..=1.0f64) {
            let arc_length = t * curve.length();
            let xi = curve.parameter_at(arc_length);
            prop_assert!((curve.length_to(xi).unwrap() - arc_length).abs() < 1e-13 * curve.length());
            for (span, lengths) in curve.spans.iter().zip(curve.lengths.windows(2)) {
                prop_assert_eq!(curve.length_to(span.start).unwrap(), lengths[0]);
                prop_assert_eq!(curve.length_to(span.end).unwrap(), lengths[1]);
            }
        }
    }
}
