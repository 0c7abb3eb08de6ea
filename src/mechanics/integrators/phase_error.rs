//! Phase errors of linear vibrations, as functions of the phase per step.

use super::{FourthOrder, Method};
use crate::elementary::{atan, atan2, square, whole_power};

impl Method {
    /// Phase error of an undamped linear vibration in one step [rad], for the phase `ω Δt` of the exact solution [rad].
    ///
    /// For the energy–momentum and trapezoidal rules, the leading term of the phase error is `(ω Δt)³/12`.
    /// For fourth order, the leading term of the phase error is `|Σ sᵢ⁵| (ω Δt)⁵/80` with the fractions `sᵢ` of the substeps.
    /// For generalized-α, the leading term of the phase error is `(11/24 - 3ρ/(2 (1 + ρ)²)) (ω Δt)³` (docs/theory.md, section 13.3).
    pub fn phase_error(&self, angle: f64) -> f64 {
        let midpoint = |fraction: f64| 2.0 * atan(0.5 * fraction * angle);
        match *self {
            Self::EnergyMomentum | Self::Trapezoidal => angle - midpoint(1.0),
            Self::FourthOrder => {
                (FourthOrder::parts().map(midpoint).iter().sum::<f64>() - angle).abs()
            }
            Self::EnergyDecaying { chi } => {
                let growth = -0.125 * chi * square(angle);
                let turn = 0.5 * angle * (1.0 - square(0.25 * chi * angle)).max(0.0).sqrt();
                angle - atan2(turn, 1.0 + growth) - atan2(turn, 1.0 - growth)
            }
            Self::GeneralizedAlpha { rho_infinity } => {
                let leading = 11.0 / 24.0 - 1.5 * rho_infinity / square(1.0 + rho_infinity);
                (leading * whole_power(angle, 3)).min(angle)
            }
        }
    }

    /// Length of the first substep, as a fraction of the step.
    pub fn first_part(&self) -> f64 {
        match self {
            Self::FourthOrder => FourthOrder::parts()[0],
            _ => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Phase per step of generalized-α for the vibration `q̈ = -ω² q` with `ω Δt = angle` [rad].
    fn turn_of_generalized_alpha(rho: f64, angle: f64) -> f64 {
        let (inertia, forces) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let (gamma, beta) = (0.5 - inertia + forces, 0.25 * (1.0 - inertia + forces).powi(2));
        let [mut q, mut v, mut a] = [1.0, 0.0, -angle * angle];
        let (mut crossings, mut first, mut last) = (0, 0.0, 0.0);
        for step in 1..200_000 {
            let predicted = q + v + (0.5 - beta) * a;
            let balance = inertia * a + angle * angle * ((1.0 - forces) * predicted + forces * q);
            let next = -balance / (1.0 - inertia + angle * angle * (1.0 - forces) * beta);
            let moved = predicted + beta * next;
            v += (1.0 - gamma) * a + gamma * next;
            if q < 0.0 && moved >= 0.0 {
                last = f64::from(step) - moved / (moved - q);
                if crossings == 0 {
                    first = last;
                }
                crossings += 1;
                if crossings == 40 {
                    break;
                }
            }
            (q, a) = (moved, next);
        }
        TAU * f64::from(crossings - 1) / (last - first)
    }

    #[test]
    fn phase_errors_agree_with_recurrences_and_leading_terms() {
        for rho in [0.0, 0.5, 0.8, 1.0] {
            let method = Method::GeneralizedAlpha { rho_infinity: rho };
            let angle = 0.1;
            let exact = angle - turn_of_generalized_alpha(rho, angle);
            let found = method.phase_error(angle);
            assert!((found / exact - 1.0).abs() < 0.03, "ρ = {rho}: {found}, recurrence {exact}");
        }
        let leading = |method: Method, power: i32| method.phase_error(0.05) / 0.05_f64.powi(power);
        for method in [Method::EnergyMomentum, Method::Trapezoidal] {
            assert!((12.0 * leading(method, 3) - 1.0).abs() < 1e-3);
        }
        let chi = 0.8;
        let decaying = leading(Method::EnergyDecaying { chi }, 3);
        assert!((decaying / (1.0 / 12.0 + chi * chi / 32.0) - 1.0).abs() < 2e-3, "{decaying}");
        let fifth: f64 = FourthOrder::parts().iter().map(|part| part.powi(5)).sum();
        let fourth = Method::FourthOrder.phase_error(0.5) / 0.5_f64.powi(5);
        assert!((80.0 * fourth / fifth.abs() - 1.0).abs() < 0.05, "{fourth}");
    }

    #[test]
    fn energy_decaying_phase_error_agrees_with_its_amplification_matrix() {
        // The test applies the energy-decaying method to the start values q0 = 1, v0 = 0 and q0 = 0, v0 = 1 of the vibration.
        // One step satisfies q1 - q0 = v̄ and v1 - v0 = -ω² (q̄ + ½ χ (q1 - q0)) with the means q̄ and v̄.
        for [chi, angle] in [[0.1, 0.3], [1.0, 0.5], [0.5, 2.0_f64]] {
            let square = angle * angle;
            let weight = 0.25 * (1.0 + chi) * square;
            let denominator = 1.0 + weight;
            let trace = (2.0 - 0.5 * square) / denominator;
            let determinant = (1.0 - weight + 0.5 * square) / denominator;
            let exact = (0.5 * trace / determinant.sqrt()).acos();
            let found = angle - Method::EnergyDecaying { chi }.phase_error(angle);
            assert!((found - exact).abs() < 1e-12, "χ = {chi}: {found}, {exact}");
        }
    }
}
