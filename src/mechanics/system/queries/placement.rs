//! Where everything is, to be compared with where it is by another way.

use crate::elementary::atan2;
use crate::geometry::{Vec2, cross, larger};
use crate::system::System;

/// The placement of a model: where its control points are, and the normals of its sections.
#[derive(Debug, Clone, Default)]
pub struct Placement {
    points: Vec<Vec2>,
    normals: Vec<Vec2>,
}

/// The distance between two placements of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distance {
    /// The largest distance between control points [length].
    pub length: f64,
    /// The largest angle between normals [rad].
    pub angle: f64,
}

impl Placement {
    /// The largest distances from another placement of the same model; NaN when there is one.
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
    /// Writes where everything in the model is over what a placement holds.
    pub fn write_placement(&self, placement: &mut Placement) {
        placement.points.clear();
        placement.normals.clear();
        for body in self.bodies().iter() {
            placement.points.extend(body.dynamics.control_points());
            body.dynamics.write_normals(&mut placement.normals);
        }
    }

    /// Whether the loads may have other values just after the present time than just before it.
    pub fn loads_may_jump(&self) -> bool {
        self.elements().may_jump_at(self.time())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_between_normals_the_shorter_way() {
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
