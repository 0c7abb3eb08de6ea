//! Change of the gap between a point and a moving curve in a step, and the directions of the contact force.
//!
//! ```text
//! xₖ: contact point, and cₖ(ξ): curve, at the start (k = 0) and at the end (k = 1) of the step
//! ξ₀, ξ₁: parameters of the nearest point of the curve at the start and at the end of the step
//! aₖ = xₖ - cₖ(ξ₀)      bₖ = xₖ - cₖ(ξ₁)      ℓ₀ = |a₀|      ℓ₁ = |b₁|
//! A₀ = |b₀|² - ℓ₀² ≥ 0     A₁ = |a₁|² - ℓ₁² ≥ 0     θ = A₀/(A₀ + A₁)
//! force on c(ξ₀):  -F θ (a₀ + a₁)/(ℓ₀ + ℓ₁)      force on c(ξ₁):  -F (1 - θ) (b₀ + b₁)/(ℓ₀ + ℓ₁)
//! ```
//!
//! The force on the point is opposite to the sum. The work of these forces is `F (ℓ₁ - ℓ₀)`, at any step size and for any change of the nearest point.
//! Each force acts along the line that connects the mean positions of its points, so both momenta are conserved.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Sub};

use super::shape::Foot;
use crate::beams::RotationIncrement;
use crate::geometry::{Vec2, larger};

/// Number of local coordinates: displacements of the point, of the feet `c(ξ₀)` and `c(ξ₁)`, and their derivative with respect to ξ at `ξ₁`.
pub(super) const LOCAL: usize = 8;

/// Smallest sum `A₀ + A₁` for a share `θ`, as a fraction of the squared distance. Below this value, both feet coincide and the share has no influence.
const SAME_FOOT: f64 = 1e-14;

/// Derivatives with respect to the local coordinates.
pub(super) type Slope = [f64; LOCAL];

/// Number with its derivatives.
#[derive(Debug, Clone, Copy)]
struct Dual {
    value: f64,
    slope: Slope,
}

impl Dual {
    const fn constant(value: f64) -> Self {
        Self { value, slope: [0.0; LOCAL] }
    }

    fn coordinate(value: f64, at: usize) -> Self {
        Self { value, slope: from_fn(|other| if other == at { 1.0 } else { 0.0 }) }
    }

    /// Value with the given factors of the derivatives of two numbers.
    fn join(value: f64, (a, by_a): (Self, f64), (b, by_b): (Self, f64)) -> Self {
        Self { value, slope: from_fn(|at| by_a * a.slope[at] + by_b * b.slope[at]) }
    }

    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        let by = if value > 0.0 { 0.5 / value } else { 0.0 };
        Self { value, slope: self.slope.map(|slope| by * slope) }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::join(self.value + other.value, (self, 1.0), (other, 1.0))
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::join(self.value - other.value, (self, 1.0), (other, -1.0))
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::join(self.value * other.value, (self, other.value), (other, self.value))
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self::join(value, (self, 1.0 / other.value), (other, -value / other.value))
    }
}

/// Vector with the derivatives of its components.
#[derive(Debug, Clone, Copy)]
struct DualVector([Dual; 2]);

impl DualVector {
    fn constant(vector: Vec2) -> Self {
        Self([Dual::constant(vector.x), Dual::constant(vector.y)])
    }

    fn coordinates(vector: Vec2, first: usize) -> Self {
        Self([Dual::coordinate(vector.x, first), Dual::coordinate(vector.y, first + 1)])
    }

    fn dot(self, other: Self) -> Dual {
        self.0[0] * other.0[0] + self.0[1] * other.0[1]
    }

    fn norm(self) -> Dual {
        self.dot(self).sqrt()
    }

    fn scaled(self, by: Dual) -> Self {
        Self(self.0.map(|component| component * by))
    }

    fn value(self) -> Vec2 {
        Vec2::new(self.0[0].value, self.0[1].value)
    }
}

impl Add for DualVector {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self([0, 1].map(|at| self.0[at] + other.0[at]))
    }
}

impl Sub for DualVector {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self([0, 1].map(|at| self.0[at] - other.0[at]))
    }
}

/// Point and curve at the start of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct GapStart {
    /// Vector from the nearest point of the curve to the point [length].
    pub(super) apart: Vec2,
    pub(super) foot: Foot,
}

/// Displacements in an iterate, and the curve near its point `c(ξ₁)`.
#[derive(Debug, Clone, Copy)]
pub(super) struct GapMovement {
    pub(super) foot: Foot,
    /// Displacements of the point and of the points `c(ξ₀)` and `c(ξ₁)` of the curve [length].
    pub(super) moved: [Vec2; 3],
    /// Vector from `c(ξ₀)` to `c(ξ₁)` at the start of the step [length].
    pub(super) slid: Vec2,
    /// Size of increments with the same rounding error as this vector [length].
    pub(super) increment: f64,
    /// Derivatives of the curve with respect to ξ at `c(ξ₁)`: the first at the start of the step, the first and the second at its end [length].
    pub(super) tangents: [Vec2; 3],
}

/// Change of the gap in an iterate, with the directions of the contact force and all derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct GapTrial {
    pub(super) change: f64,
    /// Largest increment in the sum for the change [length].
    pub(super) moved: f64,
    /// Derivative of the change.
    pub(super) slope: Slope,
    /// Forces on the point and on the points `c(ξ₀)` and `c(ξ₁)` of the curve, for a unit tension [-].
    pub(super) secant: [Vec2; 3],
    /// Derivatives of the components of these forces [1/length].
    pub(super) secant_slope: [Slope; 6],
    /// Derivative of the parameter `ξ₁` [1/length].
    pub(super) foot_slope: Slope,
}

impl GapTrial {
    pub(super) const NONE: Self = Self {
        change: 0.0,
        moved: 0.0,
        slope: [0.0; LOCAL],
        secant: [Vec2::new(0.0, 0.0); 3],
        secant_slope: [[0.0; LOCAL]; 6],
        foot_slope: [0.0; LOCAL],
    };

    /// Computes the change of the gap and the directions of the forces. For `TangentScaled`, the work of the forces equals the tension times the change of the gap.
    /// For `Angle`, the force has the direction of the gap at the end of the step.
    pub(super) fn new(
        start: &GapStart,
        movement: &GapMovement,
        rotations: RotationIncrement,
    ) -> Self {
        let [point, from, to] =
            [0, 1, 2].map(|at| DualVector::coordinates(movement.moved[at], 2 * at));
        let [tangent_before, tangent, _] = movement.tangents;
        let (a_start, b_start) = (start.apart, start.apart - movement.slid);
        let foot_slope = foot_slope(b_start + movement.moved[0] - movement.moved[2], movement);
        let foot = Dual { value: 0.0, slope: foot_slope };
        let slide = |tangent: Vec2| DualVector::constant(tangent).scaled(foot);
        let a = DualVector::constant(a_start);
        let b = DualVector::constant(b_start) - slide(tangent_before);
        let a_end = a + (point - from);
        let b_end = DualVector::constant(b_start) + (point - to) - slide(tangent);
        let slid = DualVector::constant(movement.slid) + slide(tangent_before);
        let slid_end = slid + (to - from) + slide(tangent - tangent_before);
        let (before, after) = (Dual::constant(a_start.norm()), b_end.norm());
        // Differences of squared distances without cancellation.
        let first = slid.dot(slid) - (a + a).dot(slid);
        let last = slid_end.dot(a_end + b_end);
        let both = before + after;
        let change = ((a + a_end).dot(point - from) - last) / both;
        let moved = movement.moved.iter().map(Vec2::norm).fold(movement.increment, larger);
        let (at_start, at_end) = match rotations {
            RotationIncrement::TangentScaled => {
                let sum = first + last;
                let share = match sum.value.abs() > SAME_FOOT * start.apart.norm_squared() {
                    true => first / sum,
                    false => Dual::constant(0.5),
                };
                let rest = Dual::constant(1.0) - share;
                ((a + a_end).scaled(share / both), (b + b_end).scaled(rest / both))
            }
            RotationIncrement::Angle => {
                let none = DualVector::constant(Vec2::zeros());
                (none, b_end.scaled(Dual::constant(1.0) / after))
            }
        };
        let none = DualVector::constant(Vec2::zeros());
        let forces = [at_start + at_end, none - at_start, none - at_end];
        Self {
            change: change.value,
            moved,
            slope: change.slope,
            secant: forces.map(DualVector::value),
            secant_slope: from_fn(|at| forces[at / 2].0[at % 2].slope),
            foot_slope,
        }
    }
}

/// Derivative of the parameter of the nearest point: `(δx - δc)·c' + (x - c)·δc' = (|c'|² - (x - c)·c'') δξ`.
fn foot_slope(apart: Vec2, movement: &GapMovement) -> Slope {
    let [_, tangent, bend] = movement.tangents;
    let curvature = tangent.norm_squared() - apart.dot(&bend);
    if !movement.foot.is_free || curvature <= 0.0 {
        return [0.0; LOCAL];
    }
    let [t, d] = [tangent / curvature, apart / curvature];
    [t.x, t.y, 0.0, 0.0, -t.x, -t.y, d.x, d.y]
}
