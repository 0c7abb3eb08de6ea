//! Slip of a contact point along an obstacle.

use super::point::GapTrial;
use crate::beams::Movement;
use crate::geometry::{Vec2, larger, perpendicular};
use crate::system::elements::contact::SlipTrial;

/// Slip of the surface of a body along the obstacle, for the displacement and the rotation of its contact point.
/// `radius` is the distance of the surface of the body from the contact point. `gap.secant` is the direction of the normal force.
pub(super) fn slip_trial(gap: &GapTrial, radius: f64, [x, y, rotation]: Movement) -> SlipTrial<3> {
    let movement = Vec2::new(x, y);
    let (normal, by) = (gap.secant, gap.secant_slope);
    let tangent = perpendicular(normal);
    let arm = radius * normal.norm_squared();
    let arm_slope = (by[0] * normal.x + by[1] * normal.y) * (2.0 * radius);
    let slope = tangent + by[0] * movement.y - by[1] * movement.x - arm_slope * rotation;
    let direction_slope = [-by[1], by[0], -arm_slope].map(|by| [by.x, by.y, 0.0]);
    SlipTrial {
        slip: tangent.dot(&movement) - arm * rotation,
        slope: [slope.x, slope.y, -arm],
        direction: [tangent.x, tangent.y, -arm],
        direction_slope,
        moved: larger(movement.norm(), (arm * rotation).abs()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::definition::ObstacleShape;
    use super::*;
    use crate::beams::RotationIncrement;

    #[test]
    fn slip_direction_and_slopes_agree_with_finite_differences() {
        let (centre, radius, step) = (Vec2::zeros(), 0.3, 1e-6);
        let shape = ObstacleShape::Disc { centre, radius };
        let start = Vec2::new(0.5, -0.2);
        let trial = |moved: Movement| {
            let rotations = RotationIncrement::TangentScaled;
            let gap = GapTrial::new(shape, start, Vec2::new(moved[0], moved[1]), rotations);
            slip_trial(&gap, 0.25, moved)
        };
        let moved = [0.1, 0.17, -0.4];
        let met = trial(moved);
        let work: f64 = (0..3).map(|at| met.direction[at] * moved[at]).sum();
        assert!((work - met.slip).abs() < 1e-15);
        for column in 0..3 {
            let at = |by: f64| {
                let mut moved = moved;
                moved[column] += by;
                trial(moved)
            };
            let (after, before) = (at(step), at(-step));
            let slope = (after.slip - before.slip) / (2.0 * step);
            assert!((slope - met.slope[column]).abs() < 1e-9, "{column}");
            for row in 0..3 {
                let slope = (after.direction[row] - before.direction[row]) / (2.0 * step);
                let expected = met.direction_slope[row][column];
                assert!((slope - expected).abs() < 1e-9, "{row} {column}");
            }
        }
    }
}
