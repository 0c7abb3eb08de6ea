//! Laws of damping: a force over the rate of an elongation, which takes energy and never gives any.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::spring_law::SpringLaw;
use crate::geometry::larger;

/// A force at rest, or one that feeds the motion, is one of rounding if it is smaller than this part of the largest.
const ROUNDING: f64 = 1e-12;

/// A damping force over the rate `q̇` of an elongation: none at rest, and else against the motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum DampingLaw {
    /// `c q̇`, `c` at least zero [force·time/length; of torsion force·length·time/rad].
    Linear(f64),
    /// A polygon of forces over rates, a table or a function that was asked.
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

/// Where a law of damping drives what it should damp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NegativeDamping {
    /// At a rate of the law [length/time, rad/time], with a force [force, force·length].
    At {
        /// The rate.
        rate: f64,
        /// The force there.
        force: f64,
    },
    /// Beyond one of its ends, where it goes on straight and falls.
    Beyond {
        /// The rate at that end.
        end: f64,
        /// The rate from which on it drives.
        from: f64,
    },
}

impl fmt::Display for NegativeDamping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::At { rate, force } => write!(
                f,
                "at the rate {rate} its damping gives the force {force}, which drives what it should damp; give a force with the sign of the rate, 0 at \
                 rest"
            ),
            Self::Beyond { end, from } => write!(
                f,
                "beyond the rate {end}, with which its damping ends, that goes on straight and falls, so that from {from} on it drives what it should \
                 damp; let it end where it does not fall: a table with two points of one force, a function over such rates"
            ),
        }
    }
}

impl DampingLaw {
    /// Samples a damping force over the rates of a range that has zero inside of it, as [`RestoringLaw::sampled`] does on either side.
    ///
    /// # Errors
    /// Those of the function.
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

    /// The corners of the law, rate and force; none of a linear one.
    pub fn corners(&self) -> &[(f64, f64)] {
        match self {
            Self::Curve(SpringLaw::Table { points } | SpringLaw::Sampled { points, .. }) => points,
            Self::Curve(SpringLaw::Linear { .. }) | Self::Linear(_) => &[],
        }
    }

    /// Whether there is any damping.
    pub fn acts(&self) -> bool {
        *self != Self::Linear(0.0)
    }

    /// Where a polygon does not resist, or pushes at rest; none where it dissipates at every rate, also beyond its ends.
    pub fn feeds(&self) -> Option<NegativeDamping> {
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
        // So far beyond the ends that a line which falls has turned its sign.
        let reach = |end: f64| 1e6 * (end.abs() + (last.0 - first.0));
        let beyond = [(first, first.0 - reach(first.0)), (last, last.0 + reach(last.0))];
        let (end, rate) = beyond.into_iter().find(|(_, rate)| feeds((*rate, self.force(*rate))))?;
        let slope = (self.force(rate) - end.1) / (rate - end.0);
        Some(NegativeDamping::Beyond { end: end.0, from: end.0 - end.1 / slope })
    }

    /// The same law with a corner at rest, where its force is none to the last bit.
    pub fn with_rest(&self) -> Self {
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

    /// The force at a rate [force, force·length].
    pub fn force(&self, rate: f64) -> f64 {
        match self {
            Self::Linear(constant) => constant * rate,
            Self::Curve(curve) => curve.force(rate),
        }
    }

    /// The derivative of the force by the rate; at a corner that of the segment beyond it [force·time/length, force·length·time/rad].
    pub fn slope(&self, rate: f64) -> f64 {
        match self {
            Self::Linear(constant) => *constant,
            Self::Curve(curve) => curve.slope(rate),
        }
    }

    /// The force of a law at a rate, and its slope; where Newton's method is told of the impedance of what a force acts on, those of the straight piece of a
    /// polygon that the line of that impedance through rate and force meets, which may be another one than that at the rate: between two steep pieces it
    /// would go to and fro.
    pub fn aimed(&self, rate: f64, force: f64, impedance: Option<f64>) -> (f64, f64) {
        let at_rate = (self.force(rate), self.slope(rate));
        let (Some(impedance), corners) = (impedance, self.corners()) else { return at_rate };
        let above = |at: f64| self.force(at) - force + impedance * (at - rate);
        let Some(passed) = corners.iter().position(|(at, _)| above(*at) >= 0.0) else {
            return at_rate;
        };
        // A rate inside of the piece before that corner.
        let Some(before) = passed.checked_sub(1) else { return at_rate };
        let inside = 0.5 * (corners[before].0 + corners[passed].0);
        let slope = self.slope(inside);
        (self.force(inside) + slope * (rate - inside), slope)
    }

    /// What small vibration meets: the slope at rest, the mean of both sides of it where they differ [force·time/length, force·length·time/rad].
    pub fn slope_at_rest(&self) -> f64 {
        match self {
            Self::Linear(constant) => *constant,
            Self::Curve(curve) => 0.5 * (curve.slope(-f64::MIN_POSITIVE) + curve.slope(0.0)),
        }
    }

    /// The law in words; none where nothing is damped.
    pub fn describe(&self) -> Option<String> {
        match self {
            Self::Linear(0.0) => None,
            Self::Linear(constant) => Some(format!("damping {constant}")),
            Self::Curve(curve) => Some(format!("damping by {} over the rate", curve.describe())),
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
    fn what_resists_at_every_rate_is_told_from_what_pushes() {
        let resisting = [
            table(&[(-1.0, -3.0), (1.0, 3.0)]),
            table(&[(-1.0, 0.0), (0.0, 0.0), (1.0, 2.0)]),
            table(&[(0.0, 0.0), (1.0, 2.0), (2.0, 2.0)]),
            DampingLaw::Linear(2.0),
        ];
        for law in resisting {
            assert_eq!(law.feeds(), None, "{law:?}");
        }
        let at = |rate: f64, force: f64| Some(NegativeDamping::At { rate, force });
        assert_eq!(table(&[(-1.0, 1.0), (0.0, 0.0), (1.0, 1.0)]).feeds(), at(-1.0, 1.0));
        assert_eq!(table(&[(-1.0, -1.0), (1.0, 3.0)]).feeds(), at(0.0, 1.0));
        let falling = table(&[(-1.0, -1.0), (0.0, 0.0), (1.0, 1.0), (2.0, 0.5)]);
        assert_eq!(falling.feeds(), Some(NegativeDamping::Beyond { end: 2.0, from: 3.0 }));
    }

    #[test]
    fn a_polygon_gets_a_corner_at_rest() {
        let law = table(&[(-0.3, -0.1), (0.7, 0.7 / 3.0)]).with_rest();
        assert_eq!((law.force(0.0), law.corners().len()), (0.0, 3));
        assert!(law.force(1e-9) > 0.0 && law.force(-1e-9) < 0.0);
        let one_sided = table(&[(-1.0, 0.0), (0.0, 0.0), (1.0, 2.0)]).with_rest();
        assert_eq!((one_sided.slope_at_rest(), one_sided.corners().len()), (1.0, 3));
    }

    #[test]
    fn a_function_is_met_on_either_side_of_rest() {
        let force = |rate: f64| if rate > 0.0 { 3.0 * rate * rate } else { 0.2 * rate };
        let law = DampingLaw::sampled((-1.0, 2.0), |rate| Ok::<f64, ()>(force(rate))).unwrap();
        assert_eq!(law.feeds(), None);
        for step in -100..200 {
            let rate = 0.01 * f64::from(step) + 0.003;
            assert!((law.force(rate) - force(rate)).abs() < 1e-5, "{rate}");
        }
    }
}
