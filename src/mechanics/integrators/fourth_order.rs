//! Fourth-order composition of energy–momentum steps.

use super::{EnergyMomentum, Integrator, Interval, Mechanism, Stage, StepError};
use crate::newton::{NewtonReport, Tolerance};

/// Lengths of the first three of seven substeps, as fractions of the step. The last three have the same lengths in reverse order.
///
/// With the substep lengths `SHARES`, slow loads do not excite vibrations with a phase of 2π or 4π per step (docs/theory.md, section 8.3).
const SHARES: [f64; 3] =
    [0.161_052_153_814_088_86, 0.193_890_122_365_726_64, 0.426_192_546_250_769_94];

/// End times of the substeps, as fractions of the step. The fourth substep runs backwards in time.
const ENDS: [f64; 7] = {
    let [a, b, c] = SHARES;
    [a, a + b, a + b + c, 1.0 - (a + b + c), 1.0 - (a + b), 1.0 - a, 1.0]
};

/// Fourth-order method. A step consists of seven energy–momentum substeps, of which the fourth runs backwards in time.
/// Each substep, and therefore the whole step, conserves energy, linear and angular momentum to rounding.
/// The leading errors of the substeps cancel, because the cubes of the substep lengths sum to zero (docs/theory.md, section 8.3).
///
/// Reference for composition methods: R. I. McLachlan, SIAM J. Sci. Comput. 16 (1995) 151–168.
#[derive(Debug, Clone)]
pub struct FourthOrder {
    substep: EnergyMomentum,
}

impl FourthOrder {
    /// Stages at which the method evaluates forces, one stage per substep.
    pub const STAGES: &[Stage] = &[Stage::Midpoint; ENDS.len()];

    /// Lengths of the longest forward substep (positive) and of the backward substep (negative), as fractions of a step.
    pub const LONGEST: [f64; 2] = [SHARES[2], ENDS[3] - ENDS[2]];

    pub(super) fn parts() -> [f64; ENDS.len()] {
        std::array::from_fn(|part| {
            ENDS[part] - part.checked_sub(1).map_or(0.0, |before| ENDS[before])
        })
    }

    /// Creates the method, and allocates memory for a mechanism.
    pub fn new(mechanism: &mut dyn Mechanism, tolerance: Tolerance) -> Self {
        mechanism.checkpoint().save_state();
        Self { substep: EnergyMomentum::new(mechanism, tolerance) }
    }
}

impl Integrator for FourthOrder {
    /// The reported number of iterations is the sum over all substeps.
    fn step(
        &mut self,
        mechanism: &mut dyn Mechanism,
        interval: Interval,
    ) -> Result<NewtonReport, StepError> {
        in_parts(mechanism, interval, |mechanism, part| self.substep.step(mechanism, part))
    }
}

pub(super) fn in_parts(
    mechanism: &mut dyn Mechanism,
    interval: Interval,
    mut step: impl FnMut(&mut dyn Mechanism, Interval) -> Result<NewtonReport, StepError>,
) -> Result<NewtonReport, StepError> {
    mechanism.checkpoint().save_state();
    let mut whole = NewtonReport::default();
    let mut behind = 0.0;
    for end in ENDS {
        match step(mechanism, interval.part(behind, end)) {
            Ok(report) => whole = whole.then(report),
            Err(error) => {
                mechanism.checkpoint().restore_state();
                return Err(error.for_whole_step(interval, whole.iterations));
            }
        }
        behind = end;
    }
    Ok(whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// End times of the substeps in the method of M. Suzuki (1990), as fractions of the step.
    const SUZUKI: [f64; 5] = [
        0.414_490_771_794_375_7,
        0.828_981_543_588_751_4,
        0.171_018_456_411_248_6,
        0.585_509_228_205_624_3,
        1.0,
    ];

    fn parts(ends: &[f64]) -> Vec<f64> {
        let starts = std::iter::once(&0.0).chain(ends);
        starts.zip(ends).map(|(start, end)| end - start).collect()
    }

    fn turn(parts: &[f64], frequency: f64) -> f64 {
        parts.iter().map(|part| 2.0 * (0.5 * part * frequency).atan()).sum()
    }

    fn passage(parts: &[f64], angle: f64) -> Option<f64> {
        let (mut low, mut high) = (1.0, 1e4);
        if turn(parts, high) < angle {
            return None;
        }
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if turn(parts, middle) < angle { low = middle } else { high = middle }
        }
        Some(low)
    }

    fn amplitude(parts: &[f64], frequency: f64, load: f64) -> f64 {
        let (mut place, mut rate, mut largest) = (0.0_f64, load, 0.0_f64);
        for step in 0..3000 {
            let mut begun = f64::from(step);
            for part in parts {
                let ended = begun + part;
                let mean = ((load * begun).cos() - (load * ended).cos()) / (load * part);
                let stiffness = (0.5 * part * frequency).powi(2);
                let moved = (part * rate + 2.0 * stiffness * (mean - place)) / (1.0 + stiffness);
                (place, rate, begun) = (place + moved, 2.0 * moved / part - rate, ended);
            }
            largest = largest.max(place.hypot(rate / frequency));
        }
        largest
    }

    #[test]
    fn cubes_of_substeps_cancel_and_substeps_stay_within_the_step() {
        for ends in [&ENDS[..], &SUZUKI] {
            let cubes: f64 = parts(ends).iter().map(|part| part.powi(3)).sum();
            assert!(cubes.abs() < 1e-15, "{cubes:e}");
            assert!(ends.iter().all(|end| (0.0..=1.0).contains(end)));
        }
    }

    #[test]
    fn slow_loads_do_not_excite_aliased_vibrations() {
        let largest = |ends: &[f64], load: f64| {
            let parts = parts(ends);
            let angles = [1.0, 2.0].map(|turns| turns * TAU);
            let aliases = angles.iter().flat_map(|angle| [angle - load, angle + load]);
            aliases
                .filter_map(|angle| passage(&parts, angle))
                .map(|frequency| amplitude(&parts, frequency, load))
                .fold(0.0, f64::max)
        };
        for load in [0.1, 0.2, 0.3] {
            let (ours, suzuki) = (largest(&ENDS, load), largest(&SUZUKI, load));
            println!(
                "load turning by {load} in a step: {ours:.3}; Suzuki's five parts {suzuki:.3}"
            );
            assert!(ours < 1.1, "{load}: {ours}");
        }
        assert!(largest(&SUZUKI, 0.3) > 5.0, "the test finds resonances where they are");
    }
}
