//! Drag laws: force as a function of the velocity relative to the medium, with derivatives.

use serde::{Deserialize, Serialize};

use crate::geometry::{Vec2, perpendicular};

/// Force `c s + k |s| s` on a point, or force per length on a line, as a function of the speed `s`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SpeedLaw {
    /// Coefficient `c` of the linear part [force·time/length; for a line force·time/length²].
    pub linear: f64,
    /// Coefficient `k` of the quadratic part [force·time²/length²; for a line force·time²/length³].
    pub quadratic: f64,
}

impl SpeedLaw {
    fn force(&self, speed: f64) -> f64 {
        (self.linear + self.quadratic * speed.abs()) * speed
    }

    /// Dissipated power at a force, computed from the force alone, so that rounding cannot make the power negative.
    fn power(&self, force: f64) -> f64 {
        let force = force.abs();
        if force == 0.0 {
            return 0.0;
        }
        let root = (self.linear * self.linear + 4.0 * self.quadratic * force).sqrt();
        force * (2.0 * force / (self.linear + root))
    }

    fn slope(&self, speed: f64) -> f64 {
        self.linear + 2.0 * self.quadratic * speed.abs()
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DragLaw {
    Point(SpeedLaw),
    Line { normal: SpeedLaw, tangent: SpeedLaw },
}

/// Force of a body on the medium, with the derivatives of the force. The components are perpendicular to a line and along it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DragResponse {
    /// Components of the force across and along the line [force, or force/length].
    pub force: Vec2,
    pub by_velocity: [Vec2; 2],
    pub by_angle: Vec2,
}

pub fn in_space(t: Vec2, components: Vec2) -> Vec2 {
    perpendicular(t) * components.x + t * components.y
}

impl DragLaw {
    /// Force on the medium at a velocity of the body relative to the medium, for a line with unit tangent `t`.
    /// For a point, `t` only defines the directions of the components.
    pub fn force(&self, velocity: Vec2, t: Vec2) -> DragResponse {
        let n = perpendicular(t);
        let (across, along) = (n.dot(&velocity), t.dot(&velocity));
        match self {
            Self::Point(law) => {
                let speed = velocity.norm();
                let factor = law.linear + law.quadratic * speed;
                let bend = if speed > 0.0 { velocity * (law.quadratic / speed) } else { velocity };
                DragResponse {
                    force: Vec2::new(across, along) * factor,
                    by_velocity: [n * factor + bend * across, t * factor + bend * along],
                    by_angle: Vec2::new(-along, across) * factor,
                }
            }
            Self::Line { normal, tangent } => {
                let (slope_n, slope_t) = (normal.slope(across), tangent.slope(along));
                DragResponse {
                    force: Vec2::new(normal.force(across), tangent.force(along)),
                    by_velocity: [n * slope_n, t * slope_t],
                    by_angle: Vec2::new(-slope_n * along, slope_t * across),
                }
            }
        }
    }

    /// Power dissipated by the given components of the drag force [power, or power/length].
    pub fn power(&self, force: Vec2) -> f64 {
        match self {
            Self::Point(law) => law.power(force.norm()),
            Self::Line { normal, tangent } => normal.power(force.x) + tangent.power(force.y),
        }
    }

    pub fn scale(&self, speed: f64) -> Vec2 {
        let of = |law: &SpeedLaw| law.slope(speed) * speed;
        match self {
            Self::Point(law) => Vec2::repeat(of(law)),
            Self::Line { normal, tangent } => Vec2::new(of(normal), of(tangent)),
        }
    }

    pub fn linear(&self) -> Vec2 {
        match self {
            Self::Point(law) => Vec2::repeat(law.linear),
            Self::Line { normal, tangent } => Vec2::new(normal.linear, tangent.linear),
        }
    }

    pub fn describe(&self) -> String {
        let law = |law: &SpeedLaw| match (law.linear, law.quadratic) {
            (linear, 0.0) => format!("{linear} v"),
            (0.0, quadratic) => format!("{quadratic} |v| v"),
            (linear, quadratic) => format!("{linear} v + {quadratic} |v| v"),
        };
        match self {
            Self::Point(along) => law(along),
            Self::Line { normal, tangent } => {
                format!("{} across, {} along", law(normal), law(tangent))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::unit;

    #[test]
    fn drag_derivatives_are_exact_and_drag_dissipates() {
        let (normal, tangent) =
            (SpeedLaw { linear: 0.3, quadratic: 2.0 }, SpeedLaw { linear: 0.1, quadratic: 0.4 });
        for law in [DragLaw::Point(normal), DragLaw::Line { normal, tangent }] {
            for (angle, velocity) in [(0.3, Vec2::new(1.0, -2.0)), (2.5, Vec2::new(-0.4, 0.2))] {
                let (h, t) = (1e-6, unit(angle));
                let found = law.force(velocity, t);
                let power = in_space(t, found.force).dot(&velocity);
                assert!(power > 0.0 && (law.power(found.force) - power).abs() < 1e-14 * power);
                let force = |v: Vec2, angle: f64| {
                    let t = unit(angle);
                    in_space(t, law.force(v, t).force)
                };
                for axis in [Vec2::x(), Vec2::y()] {
                    let by = found.by_velocity.map(|by| by.dot(&axis));
                    let (more, less) = (velocity + axis * h, velocity - axis * h);
                    let expected = (force(more, angle) - force(less, angle)) / (2.0 * h);
                    let by = in_space(t, Vec2::new(by[0], by[1]));
                    assert!((by - expected).norm() < 1e-8, "{law:?}: {by} {expected}");
                }
                let turned = force(velocity, angle + h) - force(velocity, angle - h);
                let by = found.by_angle + Vec2::new(found.force.y, -found.force.x);
                assert!((in_space(t, by) - turned / (2.0 * h)).norm() < 1e-8, "{law:?}");
            }
        }
    }

    #[test]
    fn drag_is_zero_at_zero_velocity() {
        let law = DragLaw::Point(SpeedLaw { linear: 0.3, quadratic: 2.0 });
        let found = law.force(Vec2::zeros(), Vec2::x());
        assert_eq!((found.force, found.by_velocity[0].x), (Vec2::zeros(), 0.0));
        assert_eq!(found.by_velocity[1].x, 0.3);
    }
}
