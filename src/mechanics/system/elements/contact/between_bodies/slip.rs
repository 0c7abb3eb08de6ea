//! Slip of a contact point along the axis of another body, and the directions of the friction force.
//!
//! ```text
//! slip Δs = Σₖ J nₖ·(Δx - Δc(ξₖ)) - A (ρ Δω + ρ' Δω')    with A = Σₖ nₖ·dₖ
//! c(ξₖ)    point of the axis of the other body
//! nₖ       force of this point on the contact point for a unit normal force
//! J        rotation by 90°
//! dₖ       mean vector from c(ξₖ) to the contact point
//! Δx, Δc   increments of the contact point and of the points of the axis
//! Δω, Δω'  rotation increments of the body of the contact point and of the other body
//! ρ, ρ'    fractions of the friction moment that act on these two bodies
//! ```
//!
//! The friction force acts along `J nₖ`, and the moments `A ρ` and `A ρ'` of a unit friction force act on the two bodies.
//! Since `ρ + ρ' = 1`, the slip is zero if both bodies rotate together like one rigid body.
//! The sum of the moments of friction is zero, so that the angular momentum is conserved.

use super::gap::{GapMovement, GapTrial, LOCAL};
use crate::geometry::{Vec2, larger, perpendicular};
use crate::system::elements::contact::SlipTrial;

/// Number of local coordinates with friction: those of the gap, and the rotations of both bodies.
pub(super) const WITH_ROTATIONS: usize = LOCAL + 2;

#[derive(Debug, Clone, Copy)]
pub(super) struct Rotations {
    /// Rotation increments of the body of the contact point and of the other body in the step [rad].
    pub(super) turned: [f64; 2],
    /// Fractions of the moment of friction that act on the two bodies [-]. The sum of the fractions is one.
    pub(super) shares: [f64; 2],
}

pub(super) fn slip_trial(
    gap: &GapTrial,
    movement: &GapMovement,
    rotations: Rotations,
) -> SlipTrial<WITH_ROTATIONS> {
    let GapTrial { secant, secant_slope, foot_slope, arm, arm_slope, .. } = gap;
    let Rotations { turned, shares } = rotations;
    let rolled = shares[0] * turned[0] + shares[1] * turned[1];
    let (mut slip, mut moved) = (-arm * rolled, (arm * rolled).abs());
    let (mut slope, mut direction) = ([0.0; WITH_ROTATIONS], [0.0; WITH_ROTATIONS]);
    let mut direction_slope = [[0.0; WITH_ROTATIONS]; WITH_ROTATIONS];
    for (vector, (secant, by)) in secant.iter().zip(&movement.moved).enumerate() {
        let tangent = perpendicular(*secant);
        let (x, y) = (2 * vector, 2 * vector + 1);
        (direction[x], direction[y]) = (tangent.x, tangent.y);
        slip += tangent.dot(by);
        moved = larger(moved, by.norm());
        for column in 0..LOCAL {
            (direction_slope[x][column], direction_slope[y][column]) =
                (-secant_slope[y][column], secant_slope[x][column]);
            slope[column] += by.y * secant_slope[x][column] - by.x * secant_slope[y][column];
        }
    }
    let [before, after, _] = movement.tangents;
    let last = Vec2::new(direction[4], direction[5]);
    let by_foot = last.dot(&(after - before));
    for column in 0..LOCAL {
        slope[column] +=
            direction[column] + by_foot * foot_slope[column] - arm_slope[column] * rolled;
        // The foot `ξ₁` moves along the curve, which changes the weights of the control points.
        direction_slope[6][column] = last.x * foot_slope[column];
        direction_slope[7][column] = last.y * foot_slope[column];
        for (row, share) in shares.iter().enumerate() {
            direction_slope[LOCAL + row][column] = -share * arm_slope[column];
        }
    }
    for (row, share) in shares.iter().enumerate() {
        direction[LOCAL + row] = -share * arm;
        slope[LOCAL + row] = -share * arm;
    }
    SlipTrial { slip, slope, direction, direction_slope, moved }
}
