//! Damping laws: dissipative force as a function of the rate of an elongation.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::law_range::LawRange;
use super::spring_law::SpringLaw;
use crate::geometry::larger;

/// Largest force that is attributed to rounding, as a fraction of the largest force of the law.
/// The limit `ROUNDING` applies to forces at zero rate, and to forces that add energy.
const ROUNDING: f64 = 1e-12;

/// Damping force as a function of the rate `q̇` of an elongation. The force is zero at zero rate and never acts in the direction of the motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum DampingLaw {
    /// Linear law `c q̇` with the coefficient `c` ≥ 0 [force·time/length; for torsion force·length·time/rad].
    Linear(f64),
    /// Piecewise linear function of the rate, from a table or a sampled function.
    Curve(SpringLaw),
}

impl Default for DampingLaw {
    fn default() -> Self {
        Self::Linear(0.0)
    }
}

impl From<f64> for DampingLaw {
    fn from(constant: f64) -> Self {
        Self::Linear(constant)
    }
}

/// Rates at which a damping law adds energy or has a force at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NegativeDamping {
    /// Point of the law at which the force adds energy, or is not zero although the rate is zero.
    /// The variant contains the rate [length/time, rad/time] and the force [force, force·length] of this point.
    At { rate: f64, force: f64 },
    /// The law is extrapolated linearly beyond its first or last rate `end`. The extrapolated force adds energy at rates beyond `from`.
    Extrapolated { end: f64, from: f64 },
}

impl fmt::Display for NegativeDamping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::At { rate, force } => write!(
                f,
                "at the rate {rate} its damping force is {force} and adds energy; give a force with the sign of the rate, and 0 at rest"
            ),
            Self::Extrapolated { end, from } => write!(
                f,
                "its damping law is extrapolated linearly beyond its last rate {end}, where it decreases, and adds energy from the rate {from} on; end the table with two points of equal force, or give the function over a range of rates at whose ends it does not decrease"
            ),
        }
    }
}

impl DampingLaw {
    /// Samples a damping force over a range of rates that contains zero. Each side of zero is sampled separately.
    ///
    /// # Errors
    /// Fails if the sampled function fails.
    pub fn sampled<E>(
        (from, to): (f64, f64),
        mut force: impl FnMut(f64) -> Result<f64, E>,
    ) -> Result<Self, E> {
        let mut sides = Vec::new();
        for range in [(from, 0.0), (0.0, to)] {
            sides.push(SpringLaw::sampled(range, &mut force)?);
        }
        let (mut all, mut worst) = (Vec::new(), 0.0);
        for side in sides {
            if let SpringLaw::Sampled { points, error } = side {
                all.extend(points.into_iter().skip(usize::from(!all.is_empty())));
                worst = larger(worst, error);
            }
        }
        Ok(Self::Curve(SpringLaw::Sampled { points: all, error: worst }))
    }

    /// Points of the law as pairs of rate and force; empty for a linear law.
    pub fn corners(&self) -> &[(f64, f64)] {
        match self {
            Self::Curve(SpringLaw::Table { points } | SpringLaw::Sampled { points, .. }) => points,
            Self::Curve(SpringLaw::Linear { .. }) | Self::Linear(_) => &[],
        }
    }

    /// Monitor of rates outside the range of the law; `None` if the law is defined at all rates.
    pub fn watch(&self) -> Option<LawRange> {
        match self {
            Self::Linear(_) => None,
            Self::Curve(curve) => LawRange::of_rates(curve),
        }
    }

    /// Returns false for the linear law with a zero coefficient, and true for all other laws.
    pub fn is_active(&self) -> bool {
        *self != Self::Linear(0.0)
    }

    /// Range of rates in which the law adds energy or has a force at zero rate; `None` if it dissipates energy at every rate.
    pub(crate) fn active_range(&self) -> Option<NegativeDamping> {
        let corners = self.corners();
        let (Some(first), Some(last)) = (corners.first(), corners.last()) else { return None };
        let largest = corners.iter().map(|(_, force)| force.abs()).fold(0.0, larger);
        let feeds = |(rate, force): (f64, f64)| force * rate.signum() < -ROUNDING * largest;
        let at_rest = self.force(0.0);
        if at_rest.abs() > ROUNDING * largest {
            return Some(NegativeDamping::At { rate: 0.0, force: at_rest });
        }
        let mut moving = corners.iter().copied().filter(|(rate, _)| *rate != 0.0);
        if let Some((rate, force)) = moving.find(|at| feeds(*at)) {
            return Some(NegativeDamping::At { rate, force });
        }
        let reach = |end: f64| 1e6 * (end.abs() + (last.0 - first.0));
        let beyond = [(first, first.0 - reach(first.0)), (last, last.0 + reach(last.0))];
        let (end, rate) = beyond.into_iter().find(|(_, rate)| feeds((*rate, self.force(*rate))))?;
        let slope = (self.force(rate) - end.1) / (rate - end.0);
        Some(NegativeDamping::Extrapolated { end: end.0, from: end.0 - end.1 / slope })
    }

    pub(crate) fn with_corner_at_rest(&self) -> Self {
        let mut law = self.clone();
        if let Self::Curve(SpringLaw::Table { points } | SpringLaw::Sampled { points, .. }) =
            &mut law
        {
            match points.binary_search_by(|(rate, _)| rate.total_cmp(&0.0)) {
                Ok(at) => points[at].1 = 0.0,
                Err(at) if at > 0 && at < points.len() => points.insert(at, (0.0, 0.0)),
                Err(_) => (),
            }
        }
        law
    }

    /// Force at a rate [force, force·length].
    pub fn force(&self, rate: f64) -> f64 {
        match self {
            Self::Linear(constant) => constant * rate,
            Self::Curve(curve) => curve.force(rate),
        }
    }

    /// Derivative of the force with respect to the rate [force·time/length, force·length·time/rad].
    /// Slope at a corner of the law: the slope of the segment above the corner.
    pub fn slope(&self, rate: f64) -> f64 {
        match self {
            Self::Linear(constant) => *constant,
            Self::Curve(curve) => curve.slope(rate),
        }
    }

    pub(crate) fn linearised_target(
        &self,
        rate: f64,
        force: f64,
        impedance: Option<f64>,
    ) -> (f64, f64) {
        let at_rate = (self.force(rate), self.slope(rate));
        let (Some(impedance), corners) = (impedance, self.corners()) else { return at_rate };
        let above = |at: f64| self.force(at) - force + impedance * (at - rate);
        let Some(passed) = corners.iter().position(|(at, _)| above(*at) >= 0.0) else {
            return at_rate;
        };
        let Some(before) = passed.checked_sub(1) else { return at_rate };
        let inside = 0.5 * (corners[before].0 + corners[passed].0);
        let slope = self.slope(inside);
        (self.force(inside) + slope * (rate - inside), slope)
    }

    /// Damping coefficient for small vibrations: the mean of the slopes on both sides of zero rate [force·time/length, force·length·time/rad].
    pub(crate) fn slope_at_rest(&self) -> f64 {
        match self {
            Self::Linear(constant) => *constant,
            Self::Curve(curve) => 0.5 * (curve.slope(-f64::MIN_POSITIVE) + curve.slope(0.0)),
        }
    }

    /// Description of the law for messages, such as `damping 0.5`; `None` without damping.
    pub fn describe(&self) -> Option<String> {
        match self {
            Self::Linear(0.0) => None,
            Self::Linear(constant) => Some(format!("damping {constant}")),
            Self::Curve(curve) => Some(format!("damping: {} of the rate", curve.describe())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(points: &[(f64, f64)]) -> DampingLaw {
        DampingLaw::Curve(SpringLaw::Table { points: points.to_vec() })
    }

    #[test]
    fn damping_laws_that_add_energy_are_detected() {
        let resisting = [
            table(&[(-1.0, -3.0), (1.0, 3.0)]),
            table(&[(-1.0, 0.0), (0.0, 0.0), (1.0, 2.0)]),
            table(&[(0.0, 0.0), (1.0, 2.0), (2.0, 2.0)]),
            DampingLaw::Linear(2.0),
        ];
        for law in resisting {
            assert_eq!(law.active_range(), None, "{law:?}");
        }
        let at = |rate: f64, force: f64| Some(NegativeDamping::At { rate, force });
        assert_eq!(table(&[(-1.0, 1.0), (0.0, 0.0), (1.0, 1.0)]).active_range(), at(-1.0, 1.0));
        assert_eq!(table(&[(-1.0, -1.0), (1.0, 3.0)]).active_range(), at(0.0, 1.0));
        let falling = table(&[(-1.0, -1.0), (0.0, 0.0), (1.0, 1.0), (2.0, 0.5)]);
        assert_eq!(
            falling.active_range(),
            Some(NegativeDamping::Extrapolated { end: 2.0, from: 3.0 })
        );
    }

    #[test]
    fn table_law_gets_a_corner_at_zero_rate() {
        let law = table(&[(-0.3, -0.1), (0.7, 0.7 / 3.0)]).with_corner_at_rest();
        assert_eq!((law.force(0.0), law.corners().len()), (0.0, 3));
        assert!(law.force(1e-9) > 0.0 && law.force(-1e-9) < 0.0);
        let one_sided = table(&[(-1.0, 0.0), (0.0, 0.0), (1.0, 2.0)]).with_corner_at_rest();
        assert_eq!((one_sided.slope_at_rest(), one_sided.corners().len()), (1.0, 3));
    }

    #[test]
    fn sampled_damping_function_is_accurate_on_both_sides_of_rest() {
        let force = |rate: f64| if rate > 0.0 { 3.0 * rate * rate } else { 0.2 * rate };
        let law = DampingLaw::sampled((-1.0, 2.0), |rate| Ok::<f64, ()>(force(rate))).unwrap();
        assert_eq!(law.active_range(), None);
        for step in -100..200 {
            let rate = 0.01 * f64::from(step) + 0.003;
            assert!((law.force(rate) - force(rate)).abs() < 1e-5, "{rate}");
        }
    }
}
