//! Terms of an elongation in an iterate: the lengths of the segments of a path, or the relative rotation of two sections.

use crate::beams::RotationIncrement;
use crate::elementary::atan;
use crate::geometry::Vec2;

/// Largest difference of two rotation increments for which the mean derivative replaces the difference quotient [rad].
/// The error of the mean derivative is of second order in the difference of the increments.
const SAME_TURN: f64 = 1e-5;

pub(in crate::system::elements) struct ElongationTerm {
    pub(in crate::system::elements) change: f64,
    pub(in crate::system::elements) secant: Vec2,
    pub(in crate::system::elements) slope: Vec2,
    inverse: f64,
}

impl ElongationTerm {
    pub(in crate::system::elements) fn new(
        start: Vec2,
        moved: Vec2,
        rotations: RotationIncrement,
    ) -> Self {
        let end = start + moved;
        let (before, after) = (start.norm(), end.norm());
        let direction =
            |d: Vec2, length: f64| if length > 0.0 { d / length } else { Vec2::zeros() };
        let both = before + after;
        let mean = direction(start + end, both);
        let slope = direction(end, after);
        // For forces at the end of a step, rotation increments are angles, and the force has the direction at the end of the step.
        let (secant, inverse) = match rotations {
            RotationIncrement::TangentScaled => (mean, both),
            RotationIncrement::Angle => (slope, after),
        };
        let inverse = if inverse > 0.0 { 1.0 / inverse } else { 0.0 };
        Self { change: mean.dot(&moved), secant, slope, inverse }
    }

    pub(in crate::system::elements) fn bend(&self, component: usize, by: usize) -> f64 {
        let one = if component == by { 1.0 } else { 0.0 };
        (one - self.secant[component] * self.slope[by]) * self.inverse
    }
}

pub(super) struct RelativeTurn {
    pub(super) ratio: f64,
    pub(super) derivatives: [f64; 2],
}

impl RelativeTurn {
    pub(super) fn new(a: f64, b: f64, rotations: RotationIncrement) -> Self {
        if rotations == RotationIncrement::Angle {
            return Self { ratio: 1.0, derivatives: [0.0; 2] };
        }
        let (difference, mean) = (b - a, 0.5 * (a + b));
        if difference.abs() < SAME_TURN {
            // The mean of dθ/dω between two rotation increments ω of the angle θ is approximated by the value at the middle.
            let (rate, slope) = rotations.rates(mean);
            return Self { ratio: rate, derivatives: [0.5 * slope; 2] };
        }
        // Identity up to a full turn: 2 atan x - 2 atan y = 2 atan((x - y)/(1 + x y)).
        let product = 1.0 + 0.25 * a * b;
        let turned = match product > 0.0 {
            true => 2.0 * atan(0.5 * difference / product),
            false => rotations.angle(b) - rotations.angle(a),
        };
        let ratio = turned / difference;
        let by_a = (ratio - rotations.rate(a)) / difference;
        let by_b = (rotations.rate(b) - ratio) / difference;
        Self { ratio, derivatives: [by_a, by_b] }
    }
}
