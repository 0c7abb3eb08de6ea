//! A motion that is given as a function of time: how far it leads in a step, and with which rates.

use serde::{Deserialize, Serialize};

use super::continuity::{jump_at_start, jump_between};
use super::{LimitSide, LoadError, Schedule};
use crate::geometry::larger;

/// A motion that is given: by its place or by its rate.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub enum PrescribedMotion {
    /// The displacement from the start, as a function of time [length, rad].
    Place(Schedule),
    /// The rate, as a function of time [length/time, rad/time].
    Rate(Schedule),
}

/// What a motion does in a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionInStep {
    /// How far it leads in the step [length, rad].
    pub moved: f64,
    /// The rate of the motion at the start of the step, from inside the step [length/time, rad/time].
    pub first_rate: f64,
    /// What rounding makes of that [length/time, rad/time].
    pub rounding: f64,
    /// The rate of the motion at the end of the step, from inside the step [length/time, rad/time].
    pub rate: f64,
    /// The derivative of the rate at the start and at the end, from inside the step [length/time², rad/time²].
    pub accelerations: [f64; 2],
}

/// How a motion begins.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionAtStart {
    /// The rate of the motion just after the start [length/time, rad/time].
    pub rate: f64,
    /// The derivative of that [length/time², rad/time²].
    pub acceleration: f64,
}

/// `cos(π/4)`: with the ends and the middle of a step these are the extremes of the Chebyshev polynomial of degree four.
const INNER: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The places of a step at which a place is asked for, from its start on, on [-1, 1].
const NODES: [f64; 5] = [-1.0, -INNER, 0.0, INNER, 1.0];

/// The derivative, at the end of [-1, 1], of the polynomial through values at these places (Trefethen, Spectral Methods in MATLAB, 2000, chapter 6).
const RATE_AT_END: [f64; 5] = [0.5, 2.0 / (-1.0 - INNER), 2.0, 2.0 / (INNER - 1.0), 5.5];

/// Its second derivative there.
const BENT_AT_END: [f64; 5] = [5.0, 12.0 * INNER - 20.0, 18.0, -12.0 * INNER - 20.0, 17.0];

/// Rates that miss each other by less than this part of them, at a time at which a function may bend, are those of a smooth motion.
const SMOOTH: f64 = 1e-6;

/// How many roundings of its values a rate is off by at most, in parts of a step.
const ROUNDINGS: f64 = 1e3;

/// The beginning of a motion is looked for in spans of time from one unit of time on, each of which is this part of the one before.
const SHRINKS: f64 = 0.125;

/// In how many spans of time the beginning of a motion is looked for.
const SPANS: usize = 14;

impl PrescribedMotion {
    /// The function of time that the motion is given by.
    pub fn schedule(&self) -> &Schedule {
        match self {
            Self::Place(schedule) | Self::Rate(schedule) => schedule,
        }
    }

    /// What the motion does from one time to another that is `duration` later, or earlier where that is negative [time].
    ///
    /// A rate is integrated by three Gauss points, exact for polynomials of degree five. The rate of a place is that of the polynomial of
    /// degree four through five of its values in the step, so that no kink at its ends is seen through.
    ///
    /// # Errors
    /// When the function fails, a value is not finite, or a place jumps or has an infinite rate.
    pub fn over(&self, start: f64, end: f64, duration: f64) -> Result<MotionInStep, LoadError> {
        match self {
            Self::Place(schedule) => {
                let values = values_in(schedule, start, end)?;
                if let Some(jump) = jump_between(schedule, &nodes(start, end), &values)? {
                    return Err(jump.refused());
                }
                let scale = 2.0 / duration;
                let backwards = reversed(values);
                Ok(MotionInStep {
                    moved: values[4] - values[0],
                    first_rate: -scale * sum(&RATE_AT_END, &backwards),
                    rounding: ROUNDINGS * scale.abs() * f64::EPSILON * size_of(&values),
                    rate: scale * sum(&RATE_AT_END, &values),
                    accelerations: [backwards, values]
                        .map(|values| scale * scale * sum(&BENT_AT_END, &values)),
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
                let moved = duration * schedule.mean(start, end)?;
                let jump = jump_between(
                    schedule,
                    &[start, 0.5 * (start + end), end],
                    &[first, middle, last],
                )?;
                // A rate that jumps is a motion that bends: it would have begun as it ends.
                let first_rate = jump.map_or(first, |_| last);
                let rounding = ROUNDINGS * f64::EPSILON * size_of(&[first, middle, last]);
                Ok(MotionInStep { moved, first_rate, rounding, rate: last, accelerations })
            }
        }
    }

    /// By how much the rate jumps at the start of a step, where it was `before` in the last one [length/time, rad/time]: at times at which the function
    /// is said to bend, and wherever a controller speaks; none where it goes on.
    ///
    /// # Errors
    /// When the function fails, or a value is not finite.
    pub fn jump_of_rate(
        &self,
        start: f64,
        end: f64,
        before: f64,
    ) -> Result<Option<f64>, LoadError> {
        let schedule = self.schedule();
        if !schedule.is_sampled() && !schedule.may_bend_at(start) {
            return Ok(None);
        }
        let (after, rounding) = match self {
            Self::Place(_) => {
                let step = self.over(start, end, end - start)?;
                (step.first_rate, step.rounding)
            }
            Self::Rate(schedule) => (schedule.value(start, LimitSide::After)?, 0.0),
        };
        let negligible = SMOOTH * larger(before.abs(), after.abs()) + rounding;
        Ok(Some(after - before).filter(|jump| jump.abs() > negligible))
    }

    /// Refuses a motion whose place, or whose rate where that is given, jumps just after the start.
    ///
    /// # Errors
    /// Then; also when the function fails or a value is not finite.
    pub fn check_start(&self) -> Result<(), LoadError> {
        match jump_at_start(self.schedule())? {
            Some(jump) if matches!(self, Self::Place(_)) || jump.is_whole => Err(jump.refused()),
            _ => Ok(()),
        }
    }

    /// How the motion begins for who comes to it at a time.
    ///
    /// The derivatives of a place are looked for in ever shorter spans of time, and taken where two spans that follow each other agree best: the
    /// time scale of a function is its own affair.
    ///
    /// # Errors
    /// When the function fails or a value is not finite just after the start.
    pub fn beginning(&self, time: f64) -> Result<MotionAtStart, LoadError> {
        let spans = (0..SPANS).scan(1.0, |span, _| Some(std::mem::replace(span, *span * SHRINKS)));
        match self {
            Self::Place(schedule) => {
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
                        // Of spans that agree as well the shortest counts.
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

/// The times of a step at which a place is asked for.
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

/// A weighted sum of differences from the last value, which cancels less than that of the values.
fn sum(weights: &[f64; 5], values: &[f64; 5]) -> f64 {
    weights.iter().zip(values).map(|(weight, value)| weight * (value - values[4])).sum()
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use super::*;

    fn of(function: fn(f64) -> f64) -> Schedule {
        Schedule::Function { function: Rc::new(move |t| Ok(function(t))), breaks: Vec::new() }
    }

    #[test]
    fn a_polynomial_of_degree_four_has_its_rates_and_accelerations() {
        let place = PrescribedMotion::Place(of(|t| t + 2.0 * t * t - t.powi(3) + 0.5 * t.powi(4)));
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
            assert!((same.moved - piece.moved).abs() < 1e-14, "{same:?}");
        }
    }

    #[test]
    fn a_motion_begins_as_its_function_does_whatever_its_time_scale() {
        for scale in [1e-6, 1e-3, 1.0, 1e3] {
            let function = move |t: f64| Ok((3.0 * t / scale).sin() + (t / scale).powi(2));
            let place = PrescribedMotion::Place(Schedule::Function {
                function: Rc::new(function),
                breaks: vec![],
            });
            let MotionAtStart { rate, acceleration } = place.beginning(0.0).unwrap();
            assert!((rate * scale - 3.0).abs() < 1e-9, "{scale}: {rate}");
            assert!((acceleration * scale * scale - 2.0).abs() < 1e-4, "{scale}: {acceleration}");
        }
        let soon =
            PrescribedMotion::Place(of(
                |t| if t < 1e-3 { (t * 4e3).sin() } else { (4.0_f64).sin() },
            ));
        assert!((soon.beginning(0.0).unwrap().rate - 4e3).abs() < 1e-5);
        // Who comes to it later finds what it does from there on.
        assert_eq!(soon.beginning(2.0).unwrap(), MotionAtStart::default());
        let square = PrescribedMotion::Place(of(|t| t * t));
        assert!((square.beginning(1.5).unwrap().rate - 3.0).abs() < 1e-9);
        assert!(PrescribedMotion::Place(of(|_| f64::NAN)).beginning(0.0).is_err());
    }
}
