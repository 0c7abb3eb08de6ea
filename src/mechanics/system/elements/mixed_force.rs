//! Force of an element as an independent unknown.
//! The iterations of a step reduce the difference between the force and the target force. The law of the element defines the target force.

use crate::geometry::larger;

#[derive(Debug, Clone, Copy, Default)]
pub struct MixedForce {
    pub force: f64,
    pub last: f64,
    pub mismatch: f64,
    pub stiffness: f64,
    target_slope: f64,
    search: IterationState,
}

#[derive(Debug, Clone, Copy, Default)]
struct IterationState {
    linearised: u32,
    at: (f64, f64),
}

/// Accuracy of forces for laws with corners [-]. The difference between a force and its target is divided by the larger of two values:
/// the force, and this factor times stiffness times elongation.
pub const CORNER_TOLERANCE: f64 = 2e-4;

/// Number of linearisations after which the stiffness of all other objects, as seen by this element, is estimated from the last iterates.
/// Smooth laws usually converge earlier.
const PLAIN_LINEARISATIONS: u32 = 4;

#[derive(Debug, Clone, Copy, Default)]
pub struct ForceTarget {
    pub force: f64,
    pub stiffness: f64,
}

impl MixedForce {
    pub fn compare(&mut self, target: ForceTarget, extent: f64) -> f64 {
        self.mismatch = target.force - self.force;
        self.target_slope = target.stiffness;
        let size =
            larger(target.stiffness.abs() * extent, larger(target.force.abs(), self.force.abs()));
        if self.mismatch == 0.0 { 0.0 } else { self.mismatch.abs() / size }
    }

    /// Change of the elongation that would make the target force equal to the present force, to first order.
    /// The elongation change is infinite if the slope of the law is not positive.
    pub fn missing_change(&self) -> f64 {
        match self.mismatch == 0.0 {
            true => 0.0,
            false if self.target_slope > 0.0 => -self.mismatch / self.target_slope,
            false => f64::INFINITY,
        }
    }

    pub fn begin_step(&mut self) {
        self.force = self.last;
        self.search = IterationState::default();
    }

    pub fn impedance(&mut self, rate: f64) -> Option<f64> {
        let IterationState { linearised, at: (rate_before, force_before) } = self.search;
        self.search = IterationState { linearised: linearised + 1, at: (rate, self.force) };
        let impedance = (force_before - self.force) / (rate - rate_before);
        (linearised >= PLAIN_LINEARISATIONS && impedance > 0.0 && impedance.is_finite())
            .then_some(impedance)
    }

    pub fn linearise(&mut self, target: ForceTarget) {
        self.mismatch = target.force - self.force;
        self.stiffness = target.stiffness;
    }

    pub fn correct(&mut self, change: f64) {
        self.force += self.mismatch + self.stiffness * change;
    }
}

/// Largest number of bisections in the search for the intersection of a force law with a falling line. The result is accurate to rounding.
const MOST_TRIES: usize = 120;

impl ForceTarget {
    /// Tangent of an increasing law at its intersection with a line of negative slope: the slope of the tangent, and its force at `change`.
    /// The line of negative slope represents the response of all other objects of the scene: its slope is minus their impedance.
    /// Without the intersection, Newton's method would alternate between the segments at a corner of a stiff law.
    pub fn intersection(
        change: f64,
        force: f64,
        impedance: f64,
        law: impl Fn(f64) -> Self,
    ) -> Self {
        let (at, met) = Self::intersect(change, force, impedance, law);
        Self { force: met.force + met.stiffness * (change - at), stiffness: met.stiffness }
    }

    pub fn intersection_point(
        change: f64,
        force: f64,
        impedance: f64,
        law: impl Fn(f64) -> Self,
    ) -> f64 {
        Self::intersect(change, force, impedance, law).0
    }

    fn intersect(
        change: f64,
        force: f64,
        impedance: f64,
        law: impl Fn(f64) -> Self,
    ) -> (f64, Self) {
        let above = |at: f64, of: Self| of.force - force + impedance * (at - change);
        let (mut at, mut met) = (change, law(change));
        let reach = change - above(change, met) / impedance;
        let (mut low, mut high) = (change.min(reach), change.max(reach));
        for _ in 0..MOST_TRIES {
            let off = above(at, met);
            if off > 0.0 {
                high = at
            } else {
                low = at
            }
            let next = at - off / (met.stiffness + impedance);
            let next = if low < next && next < high { next } else { 0.5 * (low + high) };
            if off == 0.0 || next <= low || next >= high {
                break;
            }
            (at, met) = (next, law(next));
        }
        (at, met)
    }
}
