//! Check that prescribed motions given by script functions are continuous.
//!
//! At the start, the ratio of the changes up to two small times distinguishes jumps, infinite rates and smooth functions.
//! Within a step, the interval with the largest difference is bisected. For a jump, the remaining difference is constant.

use super::{LimitSide, LoadError, Schedule};
use crate::elementary::{rounded_to, whole_power};

/// Smallest significant difference of two values, as a multiple of the rounding error of the values.
const ROUNDINGS: f64 = 1e3;

/// Exponents `i` of two sampling times `8⁻ⁱ` just after the start [time]. The second sampling time is an eighth of the first.
const CLOSE: [i32; 2] = [12, 13];

/// Limit for a jump of a function `f` at the start: `f` jumps if `|f(t₂) − f(0)| / |f(t₁) − f(0)|` exceeds this value.
/// The sampling times are `t₁ = 8⁻¹²` and `t₂ = 8⁻¹³`. The ratio is 1 for a jump, 0.35 for `√t`, and 0.125 for smooth functions.
const LEFT_OF_A_JUMP_AT_START: f64 = 0.7;
const LEFT_OF_A_POWER_AT_START: f64 = 0.16;

/// Number of successive bisections of the interval with the largest difference. There are two series of bisections.
/// After each series, the difference of the values at the ends of the interval is compared.
const HALVINGS: usize = 15;

/// Limit for a jump within a step: ratio of the difference after the second series of bisections to the difference after the first series.
/// A larger ratio indicates a jump. The ratio is 1 for a jump, at most 6e-3 for `√t`, and 3e-5 for smooth functions.
const LEFT_OF_A_JUMP: f64 = 0.5;

const JUMP_RATIO: f64 = 1.05;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Jump {
    pub(super) time: f64,
    pub(super) before: f64,
    pub(super) after: f64,
    /// True for a jump, false for an infinite rate.
    pub(super) is_jump: bool,
}

impl Jump {
    pub(super) fn refused(self) -> LoadError {
        let Self { time, before, after, is_jump: is_whole } = self;
        let [time, before, after] = [time, before, after].map(|number| rounded_to(6, number));
        match is_whole {
            true => LoadError::Jump { time, before, after },
            false => LoadError::InfiniteRate { time },
        }
    }
}

/// Jump or infinite rate of a schedule just after t = 0; `None` if it is smooth, has no script function, or a decision is impossible.
pub(super) fn jump_at_start(schedule: &Schedule) -> Result<Option<Jump>, LoadError> {
    if !may_jump(schedule) {
        return Ok(None);
    }
    let before = schedule.value(0.0, LimitSide::After)?;
    let [farther, nearer] =
        CLOSE.map(|power| schedule.value(whole_power(0.125, power), LimitSide::After));
    let (farther, after) = (farther?, nearer?);
    let [far, near] = [farther, after].map(|value| (value - before).abs());
    let noise = ROUNDINGS * f64::EPSILON * (before.abs() + after.abs());
    let is_whole = near > LEFT_OF_A_JUMP_AT_START * far;
    let is_steep = near > noise.max(f64::MIN_POSITIVE) && near > LEFT_OF_A_POWER_AT_START * far;
    Ok(is_steep.then_some(Jump { time: 0.0, before, after, is_jump: is_whole }))
}

pub(super) fn jump_between(
    schedule: &Schedule,
    times: &[f64],
    values: &[f64],
) -> Result<Option<Jump>, LoadError> {
    if !may_jump(schedule) {
        return Ok(None);
    }
    let ways = || values.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let (all, size) =
        (ways().sum::<f64>(), values.iter().fold(0.0_f64, |size, value| size.max(value.abs())));
    let noise = ROUNDINGS * f64::EPSILON * size;
    let Some((at, largest)) = ways().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else {
        return Ok(None);
    };
    if largest <= noise || largest <= JUMP_RATIO * (all - largest) {
        return Ok(None);
    }
    let mut ends = [(times[at], values[at]), (times[at + 1], values[at + 1])];
    halve(schedule, &mut ends)?;
    let first = (ends[1].1 - ends[0].1).abs();
    halve(schedule, &mut ends)?;
    let [(_, before), (time, after)] = ends;
    let left = (after - before).abs();
    let jumps = left > noise && left > LEFT_OF_A_JUMP * first;
    Ok(jumps.then_some(Jump { time, before, after, is_jump: true }))
}

fn halve(schedule: &Schedule, ends: &mut [(f64, f64); 2]) -> Result<(), LoadError> {
    for _ in 0..HALVINGS {
        let [(t0, v0), (t1, v1)] = *ends;
        let middle = 0.5 * (t0 + t1);
        let value = schedule.value(middle, LimitSide::After)?;
        let half = usize::from((value - v0).abs() >= (v1 - value).abs());
        ends[half] = (middle, value);
    }
    Ok(())
}

fn may_jump(schedule: &Schedule) -> bool {
    schedule.functions() > 0 && !schedule.is_sampled()
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use super::*;

    fn of(function: impl Fn(f64) -> f64 + 'static) -> Schedule {
        Schedule::Function { function: Rc::new(move |t: f64| Ok(function(t))), breaks: Vec::new() }
    }

    fn at_start(function: impl Fn(f64) -> f64 + 'static) -> Option<bool> {
        jump_at_start(&of(function)).unwrap().map(|jump| jump.is_jump)
    }

    fn in_step(function: impl Fn(f64) -> f64 + 'static, from: f64, to: f64) -> Option<Jump> {
        let schedule = of(function);
        let times = [0.0, 0.1464, 0.5, 0.8536, 1.0].map(|part| from + part * (to - from));
        let values = times.map(|time| schedule.value(time, LimitSide::After).unwrap());
        jump_between(&schedule, &times, &values).unwrap()
    }

    #[test]
    fn jumps_at_the_start_are_distinguished_from_fast_functions() {
        assert_eq!(at_start(|t| if t > 0.0 { 0.1 } else { 0.0 }), Some(true));
        assert_eq!(at_start(|t| 1e-3 * t.sqrt()), Some(false));
        let fine: [fn(f64) -> f64; 6] = [
            |t| 1e4 * t,
            |t| (1e6 * t).sin(),
            |t| 0.01 * (1.0 - (40.0 * t).cos()),
            |t| t * t,
            |t| 3.0 + t - 3.0,
            |t| if t > 1e-3 { 1.0 } else { 0.0 },
        ];
        assert!(fine.into_iter().all(|function| at_start(function).is_none()));
    }

    #[test]
    fn jumps_are_located_anywhere_in_a_step() {
        for place in [0.100_001, 0.103, 0.1444, 0.15, 0.1999] {
            let step = move |t: f64| t + if t > place { 0.5 } else { 0.0 };
            for (from, to) in [(0.1, 0.2), (0.2, 0.1)] {
                let found = in_step(step, from, to).unwrap();
                assert!((found.time - place).abs() < 1e-8 && found.is_jump, "{place}: {found:?}");
                assert!(((found.after - found.before).abs() - 0.5).abs() < 1e-8);
            }
        }
        let fine: [fn(f64) -> f64; 6] = [
            |t| (t - 0.19).max(0.0).sqrt(),
            |t| (t - 0.19).max(0.0),
            |t| (30.0 * t).sin(),
            |t| 1e9 + t,
            |t| (t - 0.1).powi(4),
            |t| 1e-3 * (1.0 + (1e5 * (t - 0.15)).tanh()),
        ];
        assert!(fine.into_iter().all(|function| in_step(function, 0.1, 0.2).is_none()));
    }
}
