//! Circular arcs.

use serde::{Deserialize, Serialize};

use super::error::{finite, finite_point};
use super::knots::check_inside;
use super::{GeometryError, Vec2, perpendicular, unit};
use crate::elementary::power;
use std::f64::consts::TAU;

/// Relative amount by which the angle of an arc may exceed a full turn because of rounding.
const ROUNDING: f64 = 1e-12;

/// Arc of a circle about a centre between two angles, with a parameter from 0 to 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "(Vec2, f64, f64, f64)")]
pub struct CircularArc {
    center: Vec2,
    radius: f64,
    from_angle: f64,
    to_angle: f64,
}

impl TryFrom<(Vec2, f64, f64, f64)> for CircularArc {
    type Error = GeometryError;

    fn try_from((center, radius, from, to): (Vec2, f64, f64, f64)) -> Result<Self, GeometryError> {
        Self::new(center, radius, from, to)
    }
}

impl CircularArc {
    pub(super) fn new(
        center: Vec2,
        radius: f64,
        from_angle: f64,
        to_angle: f64,
    ) -> Result<Self, GeometryError> {
        finite_point("center of the arc", center)?;
        finite("radius of the arc", radius)?;
        finite("start angle of the arc", from_angle)?;
        finite("end angle of the arc", to_angle)?;
        if radius <= 0.0 {
            return Err(GeometryError::ArcRadius { radius });
        }
        let arc = Self { center, radius, from_angle, to_angle };
        if arc.sweep().abs() > TAU * (1.0 + ROUNDING) {
            return Err(GeometryError::ArcTurn { sweep: arc.sweep() });
        }
        if finite("length of the arc", arc.length())? == 0.0 {
            return Err(GeometryError::ZeroArc { angle: from_angle });
        }
        Ok(arc)
    }

    /// Angle from the start to the end of the arc [rad], positive counter-clockwise.
    pub(super) fn sweep(&self) -> f64 {
        self.to_angle - self.from_angle
    }

    pub(super) fn length(&self) -> f64 {
        self.radius * self.sweep().abs()
    }

    /// Curvature of the arc, which is the inverse radius [1/length], positive if the arc turns counter-clockwise.
    pub(super) fn curvature(&self) -> f64 {
        self.sweep().signum() / self.radius
    }

    pub(super) fn derivative(&self, xi: f64, order: usize) -> Result<Vec2, GeometryError> {
        check_inside(xi, 0.0, 1.0)?;
        let outward = unit((1.0 - xi) * self.from_angle + xi * self.to_angle);
        // Each derivative of the arc rotates the vector by +90° and multiplies it by the angle of the arc.
        let turned = match order % 4 {
            0 => outward,
            1 => perpendicular(outward),
            2 => -outward,
            _ => -perpendicular(outward),
        };
        let origin = if order == 0 { self.center } else { Vec2::zeros() };
        Ok(origin + self.radius * power(self.sweep(), order as f64) * turned)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn successive_arc_derivatives_are_rotated_by_right_angles() {
        let arc = CircularArc::new(Vec2::new(1.0, 2.0), 2.0, FRAC_PI_2, -FRAC_PI_2).unwrap();
        let near = |a: Vec2, b: Vec2| (a - b).norm() < 1e-14 * (1.0 + b.norm());
        assert!(near(arc.derivative(0.5, 0).unwrap(), Vec2::new(3.0, 2.0)));
        assert!(near(arc.derivative(0.5, 1).unwrap(), Vec2::new(0.0, -2.0 * PI)));
        assert!(near(arc.derivative(0.5, 2).unwrap(), Vec2::new(-2.0 * PI * PI, 0.0)));
        assert!(near(arc.derivative(0.5, 3).unwrap(), Vec2::new(0.0, 2.0 * PI.powi(3))));
        assert_eq!((arc.curvature(), arc.length()), (-0.5, 2.0 * PI));
    }

    #[test]
    fn invalid_arcs_are_rejected_with_a_reason() {
        let refusal = |radius, from, to| {
            CircularArc::new(Vec2::zeros(), radius, from, to).unwrap_err().to_string()
        };
        assert_eq!(refusal(0.0, 0.0, 1.0), "arc: radius is 0, but must be positive");
        assert_eq!(refusal(-1.0, 0.0, 1.0), "arc: radius is -1, but must be positive");
        assert_eq!(
            refusal(1.0, 0.5, 0.5),
            "arc: start and end angle are both 0.5, but must differ (add 2π for a full circle)"
        );
        assert_eq!(
            refusal(1.0, 0.0, 7.0),
            "arc: the angle between start and end is 7 rad, but at most 2π is allowed in either direction"
        );
        assert!(refusal(f64::NAN, 0.0, 1.0).starts_with("radius of the arc is NaN"));
        assert!(refusal(1.0, 0.0, f64::INFINITY).starts_with("end angle of the arc is inf"));
        assert!(refusal(1e308, 0.0, 6.0).starts_with("length of the arc is inf"));
        assert!(CircularArc::new(Vec2::zeros(), 1.0, 0.1, 0.1 - TAU).is_ok());
    }
}
