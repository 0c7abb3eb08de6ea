//! Contact law: tension in a gap as a function of the gap, from a potential.
//!
//! `docs/theory.md`, section 9.7, states the potentials.
//! The potential of a disc is infinite at its centre, so its energy bounds the penetration.
//! Tensions have the sign of spring forces: contact forces are negative.

use crate::elementary::ln;
use crate::system::elements::mixed_force::ForceTarget;

/// Smallest distance from the centre of a disc at which the contact law is evaluated, as a fraction of the radius.
const LEAST_DISTANCE: f64 = 1e-6;

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactLaw {
    HalfPlane { stiffness: f64 },
    Disc { stiffness: f64, radius: f64 },
}

impl ContactLaw {
    pub fn stiffness(&self) -> f64 {
        match self {
            Self::HalfPlane { stiffness } | Self::Disc { stiffness, .. } => *stiffness,
        }
    }

    pub fn energy(&self, gap: f64) -> f64 {
        match *self {
            _ if gap >= 0.0 => 0.0,
            Self::HalfPlane { stiffness } => 0.5 * stiffness * gap * gap,
            Self::Disc { stiffness, radius } => {
                0.5 * stiffness * radius * gap * gap / distance(radius, gap)
            }
        }
    }

    pub fn at(&self, gap: f64) -> ForceTarget {
        match *self {
            _ if gap >= 0.0 => ForceTarget::default(),
            Self::HalfPlane { stiffness } => ForceTarget { force: stiffness * gap, stiffness },
            Self::Disc { stiffness, radius } => {
                let ratio = radius / distance(radius, gap);
                let force = 0.5 * stiffness * gap * (1.0 + ratio) * ratio;
                ForceTarget { force, stiffness: stiffness * ratio * ratio * ratio }
            }
        }
    }

    /// Mean tension while the gap changes from `gap` by `change`. The work of the mean tension equals the change of the potential.
    /// The stiffness is the derivative of the mean tension with respect to the change of the gap.
    pub fn mean(&self, gap: f64, change: f64) -> ForceTarget {
        let end = gap + change;
        match (gap < 0.0, end < 0.0) {
            (false, false) => ForceTarget::default(),
            (true, true) => self.mean_inside(gap, end),
            (true, false) => {
                let force = -self.energy(gap) / change;
                ForceTarget { force, stiffness: -force / change }
            }
            (false, true) => {
                let force = self.energy(end) / change;
                ForceTarget { force, stiffness: (self.at(end).force - force) / change }
            }
        }
    }

    fn mean_inside(&self, gap: f64, end: f64) -> ForceTarget {
        match *self {
            Self::HalfPlane { stiffness } => {
                ForceTarget { force: 0.5 * stiffness * (gap + end), stiffness: 0.5 * stiffness }
            }
            Self::Disc { stiffness, radius } => {
                // R²/(ℓ₀ℓ₁) - 1 = -(R (g₀ + g₁) + g₀g₁)/(ℓ₀ℓ₁) has no cancellation for small gaps.
                let growth = radius * (gap + end) + gap * end;
                let (before, after) = (distance(radius, gap), distance(radius, end));
                let force = 0.5 * stiffness * radius * growth / (before * after);
                let ratio = radius / before * (radius / after);
                ForceTarget { force, stiffness: 0.5 * stiffness * radius / after * ratio }
            }
        }
    }
}

fn distance(radius: f64, gap: f64) -> f64 {
    (radius + gap).max(LEAST_DISTANCE * radius)
}

/// Smallest coefficient of restitution. Smaller coefficients need a damping that steps cannot resolve.
pub const LEAST_RESTITUTION: f64 = 0.05;

/// Factor `x` of the contact damping for a coefficient of restitution `e`: `(1 + e) x = ln((1 + x)/(1 - e x))`; zero for `e = 1`.
///
/// A linear contact with the force `F (1 - x ġ/v)`, where `ġ` is the rate of the gap, rebounds with `e` times its approach speed `v`.
/// This holds for any mass and stiffness.
pub fn damping_factor(restitution: f64) -> f64 {
    if restitution >= 1.0 {
        return 0.0;
    }
    let excess = |x: f64| ln((1.0 + x) / (1.0 - restitution * x)) - (1.0 + restitution) * x;
    // The function `excess` is negative between its trivial root 0 and the root `x`, and infinite at 1/e.
    let (mut low, mut high) = (0.0, 1.0 / restitution);
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if excess(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAWS: [ContactLaw; 2] = [
        ContactLaw::HalfPlane { stiffness: 40.0 },
        ContactLaw::Disc { stiffness: 40.0, radius: 0.5 },
    ];

    const PATHS: [(f64, f64); 6] =
        [(-0.1, -0.2), (-0.2, 0.15), (0.1, -0.3), (-0.05, 0.4), (0.0, -0.1), (0.2, 0.3)];

    #[test]
    fn work_of_the_mean_contact_force_equals_the_energy_change() {
        for law in LAWS {
            for (gap, change) in PATHS {
                let (work, end) = (law.mean(gap, change).force * change, gap + change);
                let gained = law.energy(end) - law.energy(gap);
                assert!((work - gained).abs() < 1e-14, "{law:?} {gap} {change}");
            }
        }
    }

    #[test]
    fn contact_force_and_stiffness_are_derivatives() {
        let h = 1e-6;
        for law in LAWS {
            for (gap, change) in PATHS {
                let slope =
                    |of: &dyn Fn(f64) -> f64, at: f64| (of(at + h) - of(at - h)) / (2.0 * h);
                let by_energy = slope(&|gap| law.energy(gap), gap - 0.01);
                assert!((by_energy - law.at(gap - 0.01).force).abs() < 1e-7, "{law:?} {gap}");
                let by_force = slope(&|gap| law.at(gap).force, gap - 0.01);
                assert!((by_force - law.at(gap - 0.01).stiffness).abs() < 1e-6, "{law:?} {gap}");
                let by_change = slope(&|change| law.mean(gap, change).force, change);
                let stiffness = law.mean(gap, change).stiffness;
                assert!((by_change - stiffness).abs() < 1e-6, "{law:?} {gap} {change}");
            }
        }
    }

    /// The expected values of the first three cases are from an independent solution of the equation with 50 digits.
    #[test]
    fn the_damping_factor_solves_its_equation() {
        for (restitution, factor) in
            [(0.2, 4.919_166_715_8), (0.5, 1.432_750_533_3), (0.8, 0.373_146_203_4), (1.0, 0.0)]
        {
            assert!((damping_factor(restitution) - factor).abs() < 1e-10, "{restitution}");
        }
    }
}
