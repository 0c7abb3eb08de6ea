//! Configurations of a model, and the distance between two configurations.

use crate::elementary::atan2;
use crate::geometry::{Vec2, cross, larger};
use crate::system::System;

/// Configuration of a model: its control points and section normals.
#[derive(Debug, Clone, Default)]
pub struct Placement {
    points: Vec<Vec2>,
    normals: Vec<Vec2>,
}

/// Distance between two configurations of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distance {
    /// Largest distance between control points [length].
    pub length: f64,
    /// Largest angle between normals [rad].
    pub angle: f64,
}

impl Placement {
    /// Largest distances between this configuration and another configuration of the same model; NaN if a distance is NaN.
    pub fn distance(&self, other: &Self) -> Distance {
        let points = self.points.iter().zip(&other.points);
        let normals = self.normals.iter().zip(&other.normals);
        Distance {
            length: points.map(|(a, b)| (a - b).norm()).fold(0.0, larger),
            angle: normals.map(|(a, b)| atan2(cross(*a, *b), a.dot(b)).abs()).fold(0.0, larger),
        }
    }
}

impl System {
    pub(crate) fn write_placement(&self, placement: &mut Placement) {
        placement.points.clear();
        placement.normals.clear();
        for body in self.bodies().iter() {
            placement.points.extend(body.dynamics.control_points());
            body.dynamics.write_normals(&mut placement.normals);
        }
    }

    pub(crate) fn loads_may_jump(&self) -> bool {
        self.elements().may_jump_at(self.time())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn placement_angle_is_the_smaller_angle_between_normals() {
        let turned = |angle: f64| Placement {
            points: vec![Vec2::zeros(), Vec2::new(3.0, angle)],
            normals: vec![Vec2::x(), Vec2::new(angle.cos(), angle.sin())],
        };
        let Distance { length, angle } = turned(0.1).distance(&turned(6.2));
        assert!(
            (length - 6.1).abs() < 1e-12 && (angle - (std::f64::consts::TAU - 6.1)).abs() < 1e-12
        );
        assert!(turned(f64::NAN).distance(&turned(0.0)).length.is_nan());
    }
}
