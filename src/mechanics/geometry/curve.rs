//! Planar curves, for the axes of beams.

use serde::{Deserialize, Serialize};

use super::knots::check_inside;
use super::{CircularArc, GeometryError, KnotVector, Line, SplineCurve, Vec2, cross, local_cubic};
use crate::elementary::{atan2, hypot};

/// Largest distance of two positions that count as coincident, as a fraction of the length of the curve.
pub const ROUNDING_OF_PLACES: f64 = 1e-12;

/// Largest speed `|dx/dξ|` that counts as zero, as a fraction of the mean speed. A curve has no tangent where its speed is zero.
const STANDSTILL: f64 = 1e-12;

/// Returns true if an arc length lies on a curve of the given length, within rounding.
pub fn is_on_length(arc_length: f64, length: f64) -> bool {
    let tolerance = ROUNDING_OF_PLACES * length;
    (-tolerance..=length + tolerance).contains(&arc_length)
}

/// Planar curve `x(ξ)`. Points are lengths, and the parameter ξ is dimensionless.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Curve {
    /// Straight line.
    Line(Line),
    /// Circular arc.
    Arc(CircularArc),
    /// B-spline curve.
    Spline(SplineCurve),
}

impl Curve {
    /// Returns the straight line between two points [length], with the parameter ξ from 0 to 1.
    ///
    /// # Errors
    /// Fails if coordinates are not finite or the points coincide.
    pub fn line(from: Vec2, to: Vec2) -> Result<Self, GeometryError> {
        Line::new(from, to).map(Self::Line)
    }

    /// Returns the circular arc about `center` [length] with `radius` [length] between two angles from the first axis [rad].
    /// The arc is counter-clockwise if `to_angle` is larger than the first angle.
    ///
    /// # Errors
    /// Fails if numbers are not finite, the radius is not positive, the angles are equal, or the arc exceeds a full turn.
    pub fn arc(
        center: Vec2,
        radius: f64,
        from_angle: f64,
        to_angle: f64,
    ) -> Result<Self, GeometryError> {
        CircularArc::new(center, radius, from_angle, to_angle).map(Self::Arc)
    }

    /// Returns the B-spline curve of a knot vector with one control point [length] per basis function.
    ///
    /// # Errors
    /// Fails in the same cases as [`SplineCurve::new`].
    pub fn spline(knots: KnotVector, control_points: Vec<Vec2>) -> Result<Self, GeometryError> {
        SplineCurve::new(knots, control_points).map(Self::Spline)
    }

    /// Returns the C¹ cubic spline through `n + 1` points [length] by local cubic interpolation (The NURBS Book, section 9.3.4).
    /// The spline has `2n + 2` control points and double interior knots at the points. Its parameter ξ runs from 0 to 1.
    ///
    /// # Errors
    /// Fails if there are fewer than two points, coordinates are not finite, or consecutive points are closer than about 1e-12 of the curve length.
    pub fn through(points: &[Vec2]) -> Result<Self, GeometryError> {
        local_cubic::through(points).map(Self::Spline)
    }

    /// Interval of the parameter ξ [-], given by its start and end.
    pub fn domain(&self) -> (f64, f64) {
        match self {
            Self::Line(_) | Self::Arc(_) => (0.0, 1.0),
            Self::Spline(spline) => spline.knots().domain(),
        }
    }

    /// Point `x(ξ)` [length].
    ///
    /// # Errors
    /// Fails if `xi` is outside the domain or NaN.
    pub fn point(&self, xi: f64) -> Result<Vec2, GeometryError> {
        self.derivative(xi, 0)
    }

    /// Derivative `dᵏx/dξᵏ` of `order` k [length]; at knots, the limit from the right.
    ///
    /// # Errors
    /// Fails if `xi` is outside the domain or NaN.
    pub fn derivative(&self, xi: f64, order: usize) -> Result<Vec2, GeometryError> {
        match self {
            Self::Line(line) => line.derivative(xi, order),
            Self::Arc(arc) => arc.derivative(xi, order),
            Self::Spline(spline) => spline.derivative(xi, order),
        }
    }

    /// Angle of the tangent `dx/dξ` from the first axis [rad], in `[-π, π]`.
    ///
    /// # Errors
    /// Fails if `xi` is outside the domain or NaN, or if the derivative is zero at `xi`.
    pub fn tangent_angle(&self, xi: f64) -> Result<f64, GeometryError> {
        let velocity = self.velocity(xi)?;
        Ok(atan2(velocity.y, velocity.x))
    }

    /// Curvature `(x' × x'') / |x'|³` [1/length], positive if the curve turns counter-clockwise; at knots, the limit from the right.
    ///
    /// # Errors
    /// Fails if `xi` is outside the domain or NaN, or if the derivative is zero at `xi`.
    pub fn curvature(&self, xi: f64) -> Result<f64, GeometryError> {
        let velocity = self.velocity(xi)?;
        match self {
            Self::Line(_) => Ok(0.0),
            Self::Arc(arc) => Ok(arc.curvature()),
            Self::Spline(spline) => {
                let speed = velocity.norm();
                Ok(cross(velocity / speed, spline.derivative(xi, 2)?) / (speed * speed))
            }
        }
    }

    /// Length of the curve [length]. For splines, its error is about 1e-13 of the length of the control polygon.
    pub fn length(&self) -> f64 {
        match self {
            Self::Line(line) => line.length(),
            Self::Arc(arc) => arc.length(),
            Self::Spline(spline) => spline.length(),
        }
    }

    /// Arc length of the curve from its start to the parameter `xi` [length].
    ///
    /// # Errors
    /// Fails if `xi` is outside the domain or NaN.
    pub fn length_to(&self, xi: f64) -> Result<f64, GeometryError> {
        match self {
            Self::Line(_) | Self::Arc(_) => {
                check_inside(xi, 0.0, 1.0)?;
                Ok(xi * self.length())
            }
            Self::Spline(spline) => spline.length_to(xi),
        }
    }

    /// Parameter of the curve [-] at an arc length from its start [length].
    /// If the arc length exceeds the length of the curve only by rounding, the parameter of the end is returned.
    ///
    /// # Errors
    /// Fails if `arc_length` is outside `[0, length]` or NaN.
    pub fn parameter_at(&self, arc_length: f64) -> Result<f64, GeometryError> {
        let length = self.length();
        if !is_on_length(arc_length, length) {
            return Err(GeometryError::OutsideLength { arc_length, length });
        }
        let arc_length = arc_length.clamp(0.0, length);
        match self {
            Self::Line(_) | Self::Arc(_) => Ok(arc_length / length),
            Self::Spline(spline) => Ok(spline.parameter_at(arc_length)),
        }
    }

    fn velocity(&self, xi: f64) -> Result<Vec2, GeometryError> {
        let velocity = self.derivative(xi, 1)?;
        let (start, end) = self.domain();
        if hypot(velocity.x, velocity.y) * (end - start) > STANDSTILL * self.length() {
            Ok(velocity)
        } else {
            Err(GeometryError::NoTangent { xi })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::samples::spline_curves;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn curves() -> Vec<Curve> {
        let knots = KnotVector::new(2, vec![-1.0, -1.0, -1.0, 0.5, 2.0, 2.0, 2.0]).unwrap();
        let points = [[0.0, 0.0], [1.0, 0.5], [1.5, 2.0], [0.0, 3.0]].map(Vec2::from);
        vec![
            Curve::line(Vec2::new(0.0, 8.0), Vec2::new(6.0, 0.0)).unwrap(),
            Curve::arc(Vec2::new(1.0, 1.0), 2.0, 0.3, -2.0).unwrap(),
            Curve::spline(knots, points.to_vec()).unwrap(),
            Curve::through(&points).unwrap(),
        ]
    }

    #[test]
    fn curvature_is_the_rate_of_the_tangent_angle_by_arc_length() {
        for curve in curves() {
            let (start, end) = curve.domain();
            let (xi, h) = (start + 0.43 * (end - start), 1e-6);
            let turn = curve.tangent_angle(xi + h).unwrap() - curve.tangent_angle(xi - h).unwrap();
            let arc = curve.length_to(xi + h).unwrap() - curve.length_to(xi - h).unwrap();
            assert!((turn / arc - curve.curvature(xi).unwrap()).abs() < 1e-7);
        }
    }

    #[test]
    fn arc_length_and_parameter_invert_each_other() {
        for curve in curves() {
            let (start, end) = curve.domain();
            assert_eq!(
                (curve.parameter_at(0.0).unwrap(), curve.parameter_at(curve.length()).unwrap()),
                (start, end)
            );
            for s in [0.1, 0.37, 0.5, 0.9].map(|t| t * curve.length()) {
                assert!(
                    (curve.length_to(curve.parameter_at(s).unwrap()).unwrap() - s).abs()
                        < 1e-14 * curve.length()
                );
            }
        }
    }

    #[test]
    fn parameters_and_lengths_outside_the_curve_are_rejected() {
        for curve in curves() {
            for xi in [-1.1, 2.1, f64::NAN] {
                assert!(matches!(curve.point(xi), Err(GeometryError::OutsideDomain { .. })));
                assert!(matches!(curve.length_to(xi), Err(GeometryError::OutsideDomain { .. })));
                assert!(matches!(curve.curvature(xi), Err(GeometryError::OutsideDomain { .. })));
            }
            for s in [-1e-9, 1.001 * curve.length(), f64::NAN] {
                assert!(matches!(curve.parameter_at(s), Err(GeometryError::OutsideLength { .. })));
            }
        }
        let line = Curve::line(Vec2::zeros(), Vec2::new(2.0, 0.0)).unwrap();
        assert_eq!(line.point(1.5).unwrap_err().to_string(), "parameter 1.5 is outside [0, 1]");
        assert_eq!(
            line.parameter_at(3.0).unwrap_err().to_string(),
            "arc length 3 is outside the length of the curve, [0, 2]"
        );
    }

    #[test]
    fn tangents_have_the_direction_of_travel() {
        let clockwise = Curve::arc(Vec2::zeros(), 1.0, PI, 0.0).unwrap();
        assert!((clockwise.tangent_angle(0.0).unwrap() - FRAC_PI_2).abs() < 1e-15);
        assert!(clockwise.tangent_angle(0.5).unwrap().abs() < 1e-15);
        assert_eq!(clockwise.curvature(0.2).unwrap(), -1.0);
        let down = Curve::line(Vec2::new(0.0, 8.0), Vec2::zeros()).unwrap();
        assert_eq!(
            (down.tangent_angle(1.0).unwrap(), down.curvature(1.0).unwrap()),
            (-FRAC_PI_2, 0.0)
        );
    }

    #[test]
    fn curve_has_no_tangent_where_its_derivative_is_zero() {
        let knots = KnotVector::uniform(1, 2, 0).unwrap();
        let points = [[1.0, 1.0], [1.0, 1.0], [2.0, 0.0]].map(Vec2::from);
        let curve = Curve::spline(knots, points.to_vec()).unwrap();
        let refusal = curve.tangent_angle(0.0).unwrap_err().to_string();
        assert_eq!(
            refusal,
            "curve: no tangent at parameter 0, where its derivative is zero; \
             move coincident control points apart, or evaluate at another parameter"
        );
        assert!(curve.curvature(0.0).is_err());
        assert!((curve.tangent_angle(0.5).unwrap() + FRAC_PI_2 / 2.0).abs() < 1e-15);
    }

    proptest! {
        #[test]
        fn curve_derivatives_agree_with_finite_differences(spline in spline_curves(), t in 0.1..0.9f64) {
            let spans = spline.knots().spans();
            let span = spans[spans.len() / 2];
            let length = span.end - span.start;
            let (xi, h) = (span.start + t * length, 1e-6 * length);
            let curve = Curve::Spline(spline);
            for order in 0..4 {
                let low = curve.derivative(xi - h, order).unwrap();
                let high = curve.derivative(xi + h, order).unwrap();
                let slope = curve.derivative(xi, order + 1).unwrap();
                let size = (low.norm() + high.norm() + 1.0) / length + slope.norm();
                prop_assert!(((high - low) / (2.0 * h) - slope).norm() < 1e-5 * size);
            }
        }
    }
}
