//! Schedules: factors of loads as functions of time.

mod breaks;
mod means;

pub use means::StepMean;

use serde::{Deserialize, Serialize};

use std::any::Any;
use std::cell::Cell;
use std::f64::consts::PI;
use std::rc::Rc;

use super::stored_schedule::StoredTerm;
use super::{FunctionError, LoadError, SampleClock};
use crate::elementary::{sin, whole_power};

/// Function of time that the caller provides, for example a closure of a script. Callers can find their own type by a downcast.
pub trait TimeFunction: Any {
    /// Value of the function at a time.
    ///
    /// # Errors
    /// Fails if the function has no value at this time.
    fn value(&self, time: f64) -> Result<f64, FunctionError>;
}

impl<F: Fn(f64) -> Result<f64, FunctionError> + 'static> TimeFunction for F {
    fn value(&self, time: f64) -> Result<f64, FunctionError> {
        self(time)
    }
}

/// Side from which the limit of a schedule is taken at a time, because schedules may jump.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LimitSide {
    /// Limit from earlier times.
    Before,
    /// Limit from later times.
    After,
}

/// Factor [-] of a load as a function of time.
#[derive(Clone, Deserialize)]
#[serde(try_from = "Vec<StoredTerm>")]
pub enum Schedule {
    /// Constant factor [-].
    Constant(f64),
    /// Linear interpolation between (time, factor) points. The factor is constant before the first point and after the last point.
    /// A time that occurs twice in the table is a jump of the factor.
    Table(Vec<(f64, f64)>),
    /// Factor `amplitude · sin(rate · t + phase)` at the time `t`.
    Sine {
        /// Amplitude of the sine [-].
        amplitude: f64,
        /// Angular frequency of the sine [rad/time].
        rate: f64,
        /// Phase of the sine at time zero [rad].
        phase: f64,
    },
    /// Pulse `16/5 sin⁶(π t/duration)` for 0 < t < duration, otherwise 0. Its mean is one, and five derivatives are continuous.
    SmoothPulse {
        /// Duration of the pulse [time].
        duration: f64,
    },
    /// Function of time with declared breaks.
    Function {
        /// Script function that gives the factor at a time.
        function: Rc<dyn TimeFunction>,
        /// Times of jumps and kinks of the function [time].
        breaks: Vec<f64>,
    },
    /// Command of a controller that is sampled at the start of every step, constant within the step.
    Sampled(Rc<Cell<f64>>),
    /// Command of a digital controller, constant until the next command.
    /// The caller sets the command of the controller when the command starts to act.
    DigitalController {
        /// Cell with the present command of the controller.
        value: Rc<Cell<f64>>,
        /// Clock of the controller.
        clock: SampleClock,
    },
    /// Sum or product of two schedules.
    Combined {
        /// Operation on the two schedules.
        operation: Operation,
        /// The two schedules.
        parts: Rc<(Schedule, Schedule)>,
        /// Number of elementary schedules in both operands together.
        size: usize,
    },
}

/// Operation on two schedules.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Operation {
    /// Sum `a + b`.
    Sum,
    /// Product `a · b`.
    Product,
}

pub(super) const MOST_PARTS: usize = 1000;

impl std::fmt::Debug for Schedule {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.describe())
    }
}

/// Number of evaluations of a script function for a [mean](Schedule::mean).
pub const VALUES_OF_A_MEAN: usize = GAUSS.len() + 2;

/// Points and weights of the Gauss rule with three points on [-1, 1].
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

fn check(
    schedule: &'static str,
    name: &'static str,
    value: f64,
    allowed: &'static str,
    fine: bool,
) -> Result<(), LoadError> {
    if fine { Ok(()) } else { Err(LoadError::Value { schedule, name, value, allowed }) }
}

fn check_finite(schedule: &'static str, name: &'static str, value: f64) -> Result<(), LoadError> {
    check(schedule, name, value, "a finite number", value.is_finite())
}

fn check_positive(schedule: &'static str, name: &'static str, value: f64) -> Result<(), LoadError> {
    check(schedule, name, value, "a positive finite number", value.is_finite() && value > 0.0)
}

fn check_times(schedule: &'static str, from: f64, to: f64) -> Result<(), LoadError> {
    check_finite(schedule, "the first time", from)?;
    let (allowed, fine) = ("a finite time later than the first one", to.is_finite() && to > from);
    check(schedule, "the last time", to, allowed, fine)
}

impl Schedule {
    /// Returns a constant schedule [-].
    ///
    /// # Errors
    /// Fails if the factor is not finite.
    pub fn constant(factor: f64) -> Result<Self, LoadError> {
        check_finite("constant", "the factor", factor)?;
        Ok(Self::Constant(factor))
    }

    /// Returns a schedule that is 1 until `time`, and 0 afterwards.
    ///
    /// # Errors
    /// Fails if the time is not positive and finite.
    pub fn hold_for(time: f64) -> Result<Self, LoadError> {
        check_positive("hold_for", "the time", time)?;
        Ok(Self::Table(vec![(time, 1.0), (time, 0.0)]))
    }

    /// Returns a schedule that is 0 before `from`, 1 after `to`, and linear in between.
    ///
    /// # Errors
    /// Fails if the times are not finite, or if `to` is not later than `from`.
    pub fn ramp(from: f64, to: f64) -> Result<Self, LoadError> {
        check_times("ramp", from, to)?;
        Ok(Self::Table(vec![(from, 0.0), (to, 1.0)]))
    }

    /// Returns a schedule that is 1 between two times, and 0 at other times.
    ///
    /// # Errors
    /// Fails if the times are not finite, or if `to` is not later than `from`.
    pub fn pulse(from: f64, to: f64) -> Result<Self, LoadError> {
        check_times("pulse", from, to)?;
        Ok(Self::Table(vec![(from, 0.0), (from, 1.0), (to, 1.0), (to, 0.0)]))
    }

    /// Returns a smooth pulse with mean one: `16/5 sin⁶(π t/duration)` up to the time `duration` [time], then 0.
    ///
    /// # Errors
    /// Fails if the duration is not positive and finite.
    pub fn smooth_pulse(duration: f64) -> Result<Self, LoadError> {
        check_positive("smooth_pulse", "the duration", duration)?;
        Ok(Self::SmoothPulse { duration })
    }

    /// Returns the schedule `amplitude · sin(rate · t + phase)` with amplitude [-], rate [rad/time] and phase [rad].
    ///
    /// # Errors
    /// Fails if the amplitude, the rate or the phase is not finite.
    pub fn sine(amplitude: f64, rate: f64, phase: f64) -> Result<Self, LoadError> {
        check_finite("sine", "the amplitude", amplitude)?;
        check_finite("sine", "the rate", rate)?;
        check_finite("sine", "the phase", phase)?;
        Ok(Self::Sine { amplitude, rate, phase })
    }

    /// Returns the linear interpolation of (time, factor) points.
    ///
    /// # Errors
    /// Fails if there are fewer than two rows, a number is not finite, or times decrease.
    pub fn table(rows: Vec<(f64, f64)>) -> Result<Self, LoadError> {
        if rows.len() < 2 {
            return Err(LoadError::ShortTable { rows: rows.len() });
        }
        for &(time, factor) in &rows {
            check_finite("table", "a time", time)?;
            check_finite("table", "a factor", factor)?;
        }
        match rows.windows(2).position(|pair| pair[1].0 < pair[0].0) {
            Some(row) => Err(LoadError::DecreasingTimes {
                row: row + 1,
                time: rows[row + 1].0,
                before: rows[row].0,
            }),
            None => Ok(Self::Table(rows)),
        }
    }

    /// Returns the sum or product of two schedules.
    ///
    /// # Errors
    /// Fails if the result would have too many elementary schedules.
    pub fn combined(operation: Operation, a: Self, b: Self) -> Result<Self, LoadError> {
        let size = a.size().saturating_add(b.size());
        if size > MOST_PARTS {
            return Err(LoadError::TooManyParts { parts: size, most: MOST_PARTS });
        }
        Ok(Self::Combined { operation, parts: Rc::new((a, b)), size })
    }

    /// Number of script functions and controllers in the schedule. The method [`value`](Self::value) evaluates each of them once.
    pub fn functions(&self) -> usize {
        match self {
            Self::Function { .. } | Self::Sampled(_) | Self::DigitalController { .. } => 1,
            Self::Combined { parts, .. } => parts.0.functions() + parts.1.functions(),
            _ => 0,
        }
    }

    /// Calls `visit` with each function of time in the schedule.
    pub fn visit_functions<'a>(&'a self, visit: &mut impl FnMut(&'a dyn TimeFunction)) {
        match self {
            Self::Function { function, .. } => visit(&**function),
            Self::Combined { parts, .. } => {
                parts.0.visit_functions(visit);
                parts.1.visit_functions(visit);
            }
            _ => (),
        }
    }

    /// Returns true if the schedule contains the command of a controller.
    pub fn is_sampled(&self) -> bool {
        match self {
            Self::Sampled(_) | Self::DigitalController { .. } => true,
            Self::Combined { parts, .. } => parts.0.is_sampled() || parts.1.is_sampled(),
            _ => false,
        }
    }

    pub(crate) fn is_sampled_every_step(&self) -> bool {
        match self {
            Self::Sampled(_) => true,
            Self::Combined { parts, .. } => {
                parts.0.is_sampled_every_step() || parts.1.is_sampled_every_step()
            }
            _ => false,
        }
    }

    fn size(&self) -> usize {
        if let Self::Combined { size, .. } = self { *size } else { 1 }
    }

    /// Factor [-] at a time; at a jump, the limit from the given side.
    ///
    /// # Errors
    /// Fails if a script function fails or the value is not finite.
    pub fn value(&self, time: f64, side: LimitSide) -> Result<f64, LoadError> {
        let value = match self {
            Self::Constant(factor) => *factor,
            Self::Table(rows) => table_value(rows, time, side),
            Self::Sine { amplitude, rate, phase } => amplitude * sin(rate * time + phase),
            Self::SmoothPulse { duration } => {
                if time <= 0.0 || time >= *duration {
                    0.0
                } else {
                    3.2 * whole_power(sin(PI * time / duration), 6)
                }
            }
            Self::Function { function, breaks } => {
                let from_before = side == LimitSide::Before && breaks.contains(&time);
                let time = if from_before { time.next_down() } else { time };
                function.value(time).map_err(LoadError::Function)?
            }
            Self::Sampled(value) | Self::DigitalController { value, .. } => value.get(),
            Self::Combined { operation, parts, .. } => {
                let (a, b) = (parts.0.value(time, side)?, parts.1.value(time, side)?);
                match operation {
                    Operation::Sum => a + b,
                    Operation::Product => a * b,
                }
            }
        };
        if value.is_finite() { Ok(value) } else { Err(LoadError::NotFinite { time, value }) }
    }

    /// Description of the schedule in the syntax of the scripting language.
    pub fn describe(&self) -> String {
        match self {
            Self::Constant(factor) => format!("constant({factor})"),
            Self::Table(rows) => match rows.as_slice() {
                [(time, 1.0), (same, 0.0)] if time == same => format!("hold_for({time})"),
                [(from, 0.0), (to, 1.0)] => format!("ramp({from}, {to})"),
                [(from, 0.0), (on, 1.0), (off, 1.0), (to, 0.0)] if from == on && off == to => {
                    format!("pulse({from}, {to})")
                }
                _ => format!("table of {} rows", rows.len()),
            },
            Self::Sine { amplitude, rate, phase } => format!("sine({amplitude}, {rate}, {phase})"),
            Self::SmoothPulse { duration } => format!("smooth_pulse({duration})"),
            Self::Function { .. } => "schedule(|t| …)".to_owned(),
            Self::Sampled(_) => "controller |t, q| …".to_owned(),
            Self::DigitalController { clock, .. } => format!("controller |t, q| …, {clock}"),
            Self::Combined { size, .. } if *size > 8 => format!("combination of {size} schedules"),
            Self::Combined { operation, parts, .. } => match operation {
                Operation::Sum => format!("({} + {})", parts.0.describe(), parts.1.describe()),
                Operation::Product => format!("{} * {}", parts.0.describe(), parts.1.describe()),
            },
        }
    }
}

fn table_value(rows: &[(f64, f64)], time: f64, side: LimitSide) -> f64 {
    let passed = match side {
        LimitSide::Before => rows.partition_point(|row| row.0 < time),
        LimitSide::After => rows.partition_point(|row| row.0 <= time),
    };
    let (before, after) = (passed.checked_sub(1).and_then(|at| rows.get(at)), rows.get(passed));
    match (before, after) {
        (Some(&(t0, f0)), Some(&(t1, f1))) => f0 + (f1 - f0) * (time - t0) / (t1 - t0),
        (Some(&(_, factor)), None) | (None, Some(&(_, factor))) => factor,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn held_load_has_left_and_right_limits_at_its_end() {
        let hold = Schedule::hold_for(2.5).unwrap();
        assert_eq!(hold.value(2.5, LimitSide::Before), Ok(1.0));
        assert_eq!(hold.value(2.5, LimitSide::After), Ok(0.0));
        assert_eq!(hold.value(-1.0, LimitSide::After), Ok(1.0));
        assert_eq!(hold.mean(2.4, 2.5).unwrap().mean, 1.0);
        assert_eq!(hold.breaks(), [2.5, 2.5]);
    }

    #[test]
    fn schedule_pieces_have_exact_values_and_means() {
        let ramp = Schedule::ramp(1.0, 3.0).unwrap();
        assert_eq!(ramp.value(2.0, LimitSide::After), Ok(0.5));
        assert!((ramp.mean(1.0, 3.0).unwrap().mean - 0.5).abs() < 1e-15);
        let pulse = Schedule::pulse(1.0, 2.0).unwrap();
        let values = [0.5, 1.5, 2.5].map(|time| pulse.value(time, LimitSide::After).unwrap());
        assert_eq!(values, [0.0, 1.0, 0.0]);
        let twice = Schedule::combined(Operation::Product, Schedule::Constant(2.0), pulse).unwrap();
        assert_eq!(twice.value(1.0, LimitSide::After), Ok(2.0));
        let mean = (0..100).map(|i| {
            let pulse = Schedule::smooth_pulse(2.0).unwrap();
            pulse.mean(0.02 * f64::from(i), 0.02 * f64::from(i + 1)).unwrap().mean
        });
        assert!((mean.sum::<f64>() / 100.0 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn schedule_jumps_are_distinguished_from_kinks() {
        let hold = Schedule::hold_for(2.0).unwrap();
        assert!(hold.may_jump_at(2.0) && !hold.may_jump_at(1.0));
        let ramp = Schedule::ramp(1.0, 2.0).unwrap();
        assert!(!ramp.may_jump_at(1.0) && !ramp.may_jump_at(2.0));
        let sum = Schedule::combined(Operation::Sum, ramp, hold).unwrap();
        assert!(sum.may_jump_at(2.0) && !sum.may_jump_at(1.0));
        let function =
            Schedule::Function { function: Rc::new(Ok::<f64, FunctionError>), breaks: vec![0.5] };
        assert!(function.may_jump_at(0.5) && !function.may_jump_at(0.6));
    }

    #[test]
    fn invalid_schedules_are_rejected_with_the_allowed_values() {
        assert!(Schedule::hold_for(-1.0).unwrap_err().to_string().contains("positive"));
        assert!(Schedule::ramp(2.0, 1.0).unwrap_err().to_string().contains("later"));
        assert!(Schedule::constant(f64::NAN).is_err());
        assert!(Schedule::table(vec![(0.0, 1.0)]).unwrap_err().to_string().contains("at least 2"));
        assert!(
            Schedule::table(vec![(1.0, 1.0), (0.0, 1.0)])
                .unwrap_err()
                .to_string()
                .contains("decrease")
        );
        let broken =
            Schedule::Function { function: Rc::new(|_: f64| Ok(f64::INFINITY)), breaks: vec![] };
        assert!(broken.mean(0.0, 1.0).unwrap_err().to_string().contains("finite"));
    }
}
