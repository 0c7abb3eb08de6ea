//! Change of the gap between a point and a moving curve in a step, and the directions of the contact force.
//!
//! ```text
//! contact point xₖ and curve cₖ(ξ) at the start (k = 0) and at the end (k = 1) of the step
//! parameters ξ₀ and ξ₁ of the nearest point of the curve at the start and at the end of the step
//! vectors between point and curve: aₖ = xₖ - cₖ(ξ₀) and bₖ = xₖ - cₖ(ξ₁); distances: ℓ₀ = |a₀| and ℓ₁ = |b₁|
//! share θ of the force at c(ξ₀): θ = A₀/(A₀ + A₁) with A₀ = |b₀|² - ℓ₀² ≥ 0 and A₁ = |a₁|² - ℓ₁² ≥ 0
//! force on c(ξ₀): -F θ (a₀ + a₁)/(ℓ₀ + ℓ₁); force on c(ξ₁): -F (1 - θ) (b₀ + b₁)/(ℓ₀ + ℓ₁)
//! ```
//!
//! The force on the point is minus the sum of the forces on the curve. The work of all forces is `F (ℓ₁ - ℓ₀)`, at any step size.
//! Each force acts along the line that connects the mean positions of its points, so that momentum and angular momentum are conserved.

use std::array::from_fn;

use super::shape::Foot;
use crate::beams::RotationIncrement;
use crate::geometry::{Dual, DualVector, Vec2, larger};

/// Number of local coordinates: two components of each of four vectors.
/// The first three local vectors are the displacements of the contact point and of the feet `c(ξ₀)` and `c(ξ₁)`.
/// The fourth local vector is the derivative with respect to ξ, at `ξ₁`, of the displacement of the curve.
pub(super) const LOCAL: usize = 8;

/// Smallest sum `A₀ + A₁` for which the share `θ` is computed, as a fraction of the squared distance.
/// If the sum `A₀ + A₁` is smaller, both feet coincide within rounding, and the share `θ` has no influence.
const SAME_FOOT: f64 = 1e-14;

pub(super) type Slope = [f64; LOCAL];

#[derive(Debug, Clone, Copy)]
pub(super) struct GapStart {
    /// Vector from the nearest point of the curve to the contact point [length].
    pub(super) apart: Vec2,
    pub(super) foot: Foot,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct GapMovement {
    pub(super) foot: Foot,
    /// Displacements of the contact point and of the points `c(ξ₀)` and `c(ξ₁)` of the curve [length].
    pub(super) moved: [Vec2; 3],
    /// Vector from `c(ξ₀)` to `c(ξ₁)` at the start of the step [length].
    pub(super) slid: Vec2,
    /// Largest increment from which the vector `slid` is computed [length]. The rounding error of `slid` is proportional to it.
    pub(super) increment: f64,
    /// Derivatives of the curve with respect to ξ at `c(ξ₁)` [length].
    /// The order of the derivatives is: first derivative at the start of the step, first and second derivative at the end of the step.
    pub(super) tangents: [Vec2; 3],
}

impl GapMovement {
    pub(super) fn none(foot: Foot) -> Self {
        let [moved, tangents] = [[Vec2::zeros(); 3]; 2];
        Self { foot, moved, slid: Vec2::zeros(), increment: 0.0, tangents }
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct GapTrial {
    pub(super) change: f64,
    /// Largest of the increments from which the change of the gap is computed [length]. It determines the rounding error of the change.
    pub(super) moved: f64,
    pub(super) slope: Slope,
    /// Forces on the contact point and on the points `c(ξ₀)` and `c(ξ₁)` of the curve, for a unit tension [-].
    pub(super) secant: [Vec2; 3],
    /// Derivatives of the components of the unit forces `secant` with respect to the local coordinates [1/length].
    pub(super) secant_slope: [Slope; 6],
    /// Derivative of the parameter `ξ₁` with respect to the local coordinates [1/length].
    pub(super) foot_slope: Slope,
    /// Total moment on both bodies of a unit friction force, which is perpendicular to the gap [length].
    pub(super) arm: f64,
    /// Derivative of the friction moment `arm` with respect to the local coordinates [-].
    pub(super) arm_slope: Slope,
}

impl GapTrial {
    pub(super) const NONE: Self = Self {
        change: 0.0,
        moved: 0.0,
        slope: [0.0; LOCAL],
        secant: [Vec2::new(0.0, 0.0); 3],
        secant_slope: [[0.0; LOCAL]; 6],
        foot_slope: [0.0; LOCAL],
        arm: 0.0,
        arm_slope: [0.0; LOCAL],
    };

    /// Zero change of the gap in a configuration. `apart` is the vector from the nearest point of the curve to the contact point [length].
    pub(super) fn at_rest(apart: Vec2) -> Self {
        let arm = apart.norm();
        let normal = if arm > 0.0 { apart / arm } else { Vec2::zeros() };
        Self { secant: [normal, -normal, Vec2::zeros()], arm, ..Self::NONE }
    }

    /// Evaluates the change of the gap and the directions of the contact forces in an iterate.
    /// With the rotation increments `TangentScaled`, the work of the contact forces is exactly the normal force times the change of the gap.
    /// With the rotation increments `Angle`, the contact force has the direction of the gap at the end of the step.
    pub(super) fn new(
        start: &GapStart,
        movement: &GapMovement,
        rotations: RotationIncrement,
    ) -> Self {
        let [point, from, to] =
            [0, 1, 2].map(|at| DualVector::<LOCAL>::variable(movement.moved[at], 2 * at));
        let [tangent_before, tangent, _] = movement.tangents;
        let (a_start, b_start) = (start.apart, start.apart - movement.slid);
        let foot_slope = foot_slope(b_start + movement.moved[0] - movement.moved[2], movement);
        let foot = Dual { value: 0.0, slopes: foot_slope };
        let slide = |tangent: Vec2| DualVector::constant(tangent) * foot;
        let a = DualVector::constant(a_start);
        let b = DualVector::constant(b_start) - slide(tangent_before);
        let a_end = a + (point - from);
        let b_end = DualVector::constant(b_start) + (point - to) - slide(tangent);
        let slid = DualVector::constant(movement.slid) + slide(tangent_before);
        let slid_end = slid + (to - from) + slide(tangent - tangent_before);
        let (before, after) = (Dual::constant(a_start.norm()), b_end.norm());
        // Differences of squared distances are computed without cancellation.
        let first = slid.dot(&slid) - (a + a).dot(&slid);
        let last = slid_end.dot(&(a_end + b_end));
        let both = before + after;
        let change = ((a + a_end).dot(&(point - from)) - last) / both;
        let moved = movement.moved.iter().map(Vec2::norm).fold(movement.increment, larger);
        let (at_start, at_end) = match rotations {
            RotationIncrement::TangentScaled => {
                let sum = first + last;
                let share = match sum.value.abs() > SAME_FOOT * start.apart.norm_squared() {
                    true => first / sum,
                    false => Dual::constant(0.5),
                };
                let rest = Dual::constant(1.0) - share;
                ((a + a_end) * (share / both), (b + b_end) * (rest / both))
            }
            RotationIncrement::Angle => {
                let none = DualVector::constant(Vec2::zeros());
                (none, b_end * (Dual::constant(1.0) / after))
            }
        };
        let arm = ((a + a_end).dot(&at_start) + (b + b_end).dot(&at_end)) * 0.5;
        let none = DualVector::constant(Vec2::zeros());
        let forces = [at_start + at_end, none - at_start, none - at_end];
        Self {
            change: change.value,
            moved,
            slope: change.slopes,
            secant: forces.map(|force| force.value()),
            secant_slope: from_fn(|at| {
                let DualVector { x, y } = forces[at / 2];
                if at % 2 == 0 { x.slopes } else { y.slopes }
            }),
            foot_slope,
            arm: arm.value,
            arm_slope: arm.slopes,
        }
    }
}

/// Derivative of the parameter `ξ` of the nearest point `c(ξ)` of the curve to the contact point `x`, with respect to the local coordinates.
/// It follows from the linearised condition of a perpendicular: `(δx - δc)·c' + (x - c)·δc' = (|c'|² - (x - c)·c'') δξ`.
fn foot_slope(apart: Vec2, movement: &GapMovement) -> Slope {
    let [_, tangent, bend] = movement.tangents;
    let curvature = tangent.norm_squared() - apart.dot(&bend);
    if !movement.foot.is_free || curvature <= 0.0 {
        return [0.0; LOCAL];
    }
    let [t, d] = [tangent / curvature, apart / curvature];
    [t.x, t.y, 0.0, 0.0, -t.x, -t.y, d.x, d.y]
}
