//! Prescribed motion as a function of time, with its increments and rates in a step.

use serde::{Deserialize, Serialize};

use super::continuity::{jump_at_start, jump_between};
use super::{LimitSide, LoadError, Schedule, StepMean, VALUES_OF_A_MEAN};
use crate::geometry::larger;

/// Prescribed motion. Either the displacement or the rate is given as a function of time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum PrescribedMotion {
    /// Displacement from the initial position as a function of time [length, rad].
    Position(Schedule),
    /// Time derivative (rate) of the displacement as a function of time [length/time, rad/time].
    Rate(Schedule),
}

/// Values of a prescribed motion in a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionInStep {
    /// Increment in the step [length, rad].
    pub increment: f64,
    /// Rate just after the start of the step [length/time, rad/time].
    pub first_rate: f64,
    /// Rounding error of the rate just after the start of the step [length/time, rad/time].
    pub rounding: f64,
    /// Rate just before the end of the step [length/time, rad/time].
    pub rate: f64,
    /// Derivatives of the rate at the start and at the end of the step, as limits from inside the step [length/time², rad/time²].
    pub accelerations: [f64; 2],
    /// Mean of a prescribed rate over the step [length/time, rad/time]; zero for a prescribed displacement.
    pub mean: StepMean,
}

/// Rate and acceleration at the start of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionAtStart {
    /// Rate just after the start of the motion [length/time, rad/time].
    pub rate: f64,
    /// Derivative of the rate just after the start of the motion [length/time², rad/time²].
    pub acceleration: f64,
}

/// Jump of a prescribed position at a break of its schedule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DeclaredJump {
    /// Time of the jump [time].
    pub time: f64,
    /// Position before the jump [length, rad].
    pub before: f64,
    /// Position after the jump [length, rad].
    pub after: f64,
}

/// The number `cos(π/4)`. The ends of a step, its middle and `±INNER` are the extrema of the Chebyshev polynomial of degree four.
const INNER: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Times within a step at which a displacement is evaluated, scaled to [-1, 1].
const NODES: [f64; 5] = [-1.0, -INNER, 0.0, INNER, 1.0];

/// Weights of the values for the first derivative of the interpolation polynomial at the end of [-1, 1].
/// Reference: Trefethen, Spectral Methods in MATLAB, 2000, chapter 6.
const RATE_AT_END: [f64; 5] = [0.5, 2.0 / (-1.0 - INNER), 2.0, 2.0 / (INNER - 1.0), 5.5];

/// Weights of the values for the second derivative of the interpolation polynomial at the end of [-1, 1].
const BENT_AT_END: [f64; 5] = [5.0, 12.0 * INNER - 20.0, 18.0, -12.0 * INNER - 20.0, 17.0];

/// Largest jump of the rate at a declared break for which the rate counts as continuous, as a fraction of the rate.
const SMOOTH: f64 = 1e-6;

/// Largest jump of a prescribed position at a declared break that counts as zero, as a fraction of the position plus a reference length or angle [-].
const LARGEST_JUMP: f64 = 1e-9;

/// Bound of the rounding error of a rate, as a multiple of the rounding error of the values from which the rate is computed.
const ROUNDINGS: f64 = 1e3;

/// Ratio of consecutive time spans in the computation of initial derivatives. The first time span is one unit of time.
const SHRINKS: f64 = 0.125;

/// Number of time spans in the computation of initial derivatives.
const SPANS: usize = 14;

impl PrescribedMotion {
    /// Function of time that defines the motion.
    pub fn schedule(&self) -> &Schedule {
        match self {
            Self::Position(schedule) | Self::Rate(schedule) => schedule,
        }
    }

    pub(crate) fn calls_in_step(&self) -> usize {
        let schedule = self.schedule();
        match self {
            Self::Position(_) => NODES.len() * schedule.functions(),
            Self::Rate(_) => (3 + VALUES_OF_A_MEAN) * schedule.functions(),
        }
    }

    /// Evaluates the motion between two times. `duration` is the difference of the times, which may be negative [time].
    ///
    /// A prescribed rate is integrated by [`Schedule::mean`].
    /// The rate of a prescribed displacement is computed from five values in the step and at its ends, by a polynomial of degree four.
    ///
    /// # Errors
    /// Fails if the script function fails, a value is not finite, or a displacement jumps.
    pub fn over(&self, start: f64, end: f64, duration: f64) -> Result<MotionInStep, LoadError> {
        match self {
            Self::Position(schedule) => {
                let values = values_in(schedule, start, end)?;
                if let Some(jump) = jump_between(schedule, &nodes(start, end), &values)? {
                    return Err(jump.refused());
                }
                let scale = 2.0 / duration;
                let backwards = reversed(values);
                Ok(MotionInStep {
                    increment: values[4] - values[0],
                    first_rate: -scale * sum(&RATE_AT_END, &backwards),
                    rounding: ROUNDINGS * scale.abs() * f64::EPSILON * size_of(&values),
                    rate: scale * sum(&RATE_AT_END, &values),
                    accelerations: [backwards, values]
                        .map(|values| scale * scale * sum(&BENT_AT_END, &values)),
                    mean: StepMean::default(),
                })
            }
            Self::Rate(schedule) => {
                let (first, last) = (
                    schedule.value(start, LimitSide::After)?,
                    schedule.value(end, LimitSide::Before)?,
                );
                let middle = schedule.value(0.5 * (start + end), LimitSide::After)?;
                let accelerations = [
                    (4.0 * middle - 3.0 * first - last) / duration,
                    (first + 3.0 * last - 4.0 * middle) / duration,
                ];
                let mean = schedule.mean(start, end)?;
                let moved = duration * mean.mean;
                let jump = jump_between(
                    schedule,
                    &[start, 0.5 * (start + end), end],
                    &[first, middle, last],
                )?;
                // If the rate jumps within the step, the displacement has a kink. The rate at the end of the step then replaces the rate at its start.
                let first_rate = jump.map_or(first, |_| last);
                let rounding = ROUNDINGS * f64::EPSILON * size_of(&[first, middle, last]);
                Ok(MotionInStep {
                    increment: moved,
                    first_rate,
                    rounding,
                    rate: last,
                    accelerations,
                    mean,
                })
            }
        }
    }

    /// Jump of the rate at the start of a step [length/time, rad/time]; `None` if the rate is continuous.
    /// The jump is computed only at declared breaks and for controllers. `before` is the rate at the end of the last step.
    pub(crate) fn jump_of_rate(
        &self,
        start: f64,
        end: f64,
        before: f64,
    ) -> Result<Option<f64>, LoadError> {
        let schedule = self.schedule();
        if !schedule.is_sampled() && !schedule.is_break(start) {
            return Ok(None);
        }
        let (after, rounding) = match self {
            Self::Position(_) => {
                let step = self.over(start, end, end - start)?;
                (step.first_rate, step.rounding)
            }
            Self::Rate(schedule) => (schedule.value(start, LimitSide::After)?, 0.0),
        };
        let negligible = SMOOTH * larger(before.abs(), after.abs()) + rounding;
        Ok(Some(after - before).filter(|jump| jump.abs() > negligible))
    }

    /// Rejects a displacement that jumps or has an infinite rate just after the start, and a prescribed rate that jumps there.
    ///
    /// # Errors
    /// Fails for a rejected motion, if the script function fails, or if a value is not finite.
    pub(crate) fn check_start(&self) -> Result<(), LoadError> {
        match jump_at_start(self.schedule())? {
            Some(jump) if matches!(self, Self::Position(_)) || jump.is_jump => Err(jump.refused()),
            _ => Ok(()),
        }
    }

    /// First jump of a prescribed position at the breaks that its schedule declares; `None` without a jump and for a prescribed rate.
    /// Jumps of at most 1e-9 times the sum of the position and the reference value `size` [length, rad] count as zero.
    ///
    /// # Errors
    /// Fails if the schedule has no finite value at a break.
    pub(crate) fn declared_jump(&self, size: f64) -> Result<Option<DeclaredJump>, LoadError> {
        let Self::Position(schedule) = self else { return Ok(None) };
        for time in schedule.breaks().into_iter().filter(|time| *time >= 0.0) {
            let before = schedule.value(time, LimitSide::Before)?;
            let after = schedule.value(time, LimitSide::After)?;
            if (after - before).abs() > LARGEST_JUMP * (size + before.abs()) {
                return Ok(Some(DeclaredJump { time, before, after }));
            }
        }
        Ok(None)
    }

    /// Initial rate and acceleration of a motion that starts at a time.
    ///
    /// A prescribed rate is read from its schedule. All other derivatives are computed over several decreasing time spans, because the time scale of the function is unknown.
    /// All time spans are evaluated. The result for each derivative is its value over the shorter of the two consecutive spans whose values differ least.
    ///
    /// # Errors
    /// Fails if a prescribed rate has no finite value at the start, or if a displacement has no finite values in any of the time spans.
    pub fn beginning(&self, time: f64) -> Result<MotionAtStart, LoadError> {
        let spans = (0..SPANS).scan(1.0, |span, _| Some(std::mem::replace(span, *span * SHRINKS)));
        match self {
            Self::Position(schedule) => {
                let mut found = MotionAtStart::default();
                let (mut least, mut last) = ([f64::INFINITY; 2], None::<[f64; 2]>);
                let mut failed = None;
                for span in spans {
                    let values = match values_in(schedule, time, time + span) {
                        Ok(values) => reversed(values),
                        Err(error) => {
                            failed = Some(error);
                            continue;
                        }
                    };
                    let scale = 2.0 / span;
                    let now = [
                        -scale * sum(&RATE_AT_END, &values),
                        scale * scale * sum(&BENT_AT_END, &values),
                    ];
                    let Some(before) = last.replace(now) else { continue };
                    let both = [&mut found.rate, &mut found.acceleration];
                    for (at, number) in both.into_iter().enumerate() {
                        let miss: f64 = now[at] - before[at];
                        // If several time spans agree equally well, the shortest span is used.
                        if miss.abs() <= least[at] {
                            (least[at], *number) = (miss.abs(), now[at]);
                        }
                    }
                }
                match failed {
                    Some(error) if last.is_none() => Err(error),
                    _ => Ok(found),
                }
            }
            Self::Rate(schedule) => {
                let rate = schedule.value(time, LimitSide::After)?;
                let mut found = MotionAtStart { rate, acceleration: 0.0 };
                let (mut least, mut before) = (f64::INFINITY, None::<f64>);
                for span in spans {
                    let Ok(MotionInStep { accelerations: [now, _], .. }) =
                        self.over(time, time + span, span)
                    else {
                        continue;
                    };
                    let Some(before) = before.replace(now) else { continue };
                    let miss: f64 = now - before;
                    if miss.abs() <= least {
                        (least, found.acceleration) = (miss.abs(), now);
                    }
                }
                Ok(found)
            }
        }
    }
}

fn size_of(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size, value| size.max(value.abs()))
}

fn nodes(start: f64, end: f64) -> [f64; 5] {
    let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
    NODES.map(|node| middle + half * node)
}

fn values_in(schedule: &Schedule, start: f64, end: f64) -> Result<[f64; 5], LoadError> {
    let mut values = [0.0; 5];
    for (at, (value, time)) in values.iter_mut().zip(nodes(start, end)).enumerate() {
        *value = match at {
            0 => schedule.value(start, LimitSide::After)?,
            4 => schedule.value(end, LimitSide::Before)?,
            _ => schedule.value(time, LimitSide::After)?,
        };
    }
    Ok(values)
}

fn reversed(mut values: [f64; 5]) -> [f64; 5] {
    values.reverse();
    values
}

fn sum(weights: &[f64; 5], values: &[f64; 5]) -> f64 {
    weights.iter().zip(values).map(|(weight, value)| weight * (value - values[4])).sum()
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use super::*;

    fn of(function: fn(f64) -> f64) -> Schedule {
        Schedule::Function { function: Rc::new(move |t: f64| Ok(function(t))), breaks: Vec::new() }
    }

    #[test]
    fn prescribed_quartic_has_exact_rates_and_accelerations() {
        let place =
            PrescribedMotion::Position(of(|t| t + 2.0 * t * t - t.powi(3) + 0.5 * t.powi(4)));
        let (rate, bent) = (
            |t: f64| 1.0 + 4.0 * t - 3.0 * t * t + 2.0 * t.powi(3),
            |t: f64| 4.0 - 6.0 * t + 6.0 * t * t,
        );
        for (start, end) in [(0.0, 0.5), (1.0, 1.3), (1.3, 1.0)] {
            let piece = place.over(start, end, end - start).unwrap();
            assert!((piece.rate - rate(end)).abs() < 1e-12, "{piece:?}");
            assert!((piece.accelerations[0] - bent(start)).abs() < 1e-11, "{piece:?}");
            assert!((piece.accelerations[1] - bent(end)).abs() < 1e-11, "{piece:?}");
            let given =
                PrescribedMotion::Rate(of(|t| 1.0 + 4.0 * t - 3.0 * t * t + 2.0 * t.powi(3)));
            let same = given.over(start, end, end - start).unwrap();
            assert!((same.increment - piece.increment).abs() < 1e-14, "{same:?}");
        }
    }

    #[test]
    fn initial_rate_and_acceleration_are_accurate_at_any_time_scale() {
        for scale in [1e-6, 1e-3, 1.0, 1e3] {
            let function = move |t: f64| Ok((3.0 * t / scale).sin() + (t / scale).powi(2));
            let place = PrescribedMotion::Position(Schedule::Function {
                function: Rc::new(function),
                breaks: vec![],
            });
            let MotionAtStart { rate, acceleration } = place.beginning(0.0).unwrap();
            assert!((rate * scale - 3.0).abs() < 1e-9, "{scale}: {rate}");
            assert!((acceleration * scale * scale - 2.0).abs() < 1e-4, "{scale}: {acceleration}");
        }
        let soon = PrescribedMotion::Position(of(|t| {
            if t < 1e-3 { (t * 4e3).sin() } else { (4.0_f64).sin() }
        }));
        assert!((soon.beginning(0.0).unwrap().rate - 4e3).abs() < 1e-5);
        assert_eq!(soon.beginning(2.0).unwrap(), MotionAtStart::default());
        let square = PrescribedMotion::Position(of(|t| t * t));
        assert!((square.beginning(1.5).unwrap().rate - 3.0).abs() < 1e-9);
        assert!(PrescribedMotion::Position(of(|_| f64::NAN)).beginning(0.0).is_err());
    }
}
