//! Breaks of schedules: times of jumps and kinks.

use super::Schedule;
use crate::loads::SampleClock;

impl Schedule {
    /// Times of jumps and kinks of the schedule, at which steps should end.
    pub fn breaks(&self) -> Vec<f64> {
        match self {
            Self::Constant(_)
            | Self::Sine { .. }
            | Self::Sampled(_)
            | Self::DigitalController { .. } => Vec::new(),
            Self::Table(rows) => rows.iter().map(|(time, _)| *time).collect(),
            Self::SmoothPulse { duration } => vec![0.0, *duration],
            Self::Function { breaks, .. } => breaks.clone(),
            Self::Combined { parts, .. } => [parts.0.breaks(), parts.1.breaks()].concat(),
        }
    }

    /// Clock of a digital controller; `None` for other schedules.
    /// Steps should end at the samples of the clock and at the times when commands start to act.
    pub(crate) fn sample_clock(&self) -> Option<SampleClock> {
        if let Self::DigitalController { clock, .. } = self { Some(*clock) } else { None }
    }

    /// Returns true if a time is a declared break of the schedule.
    pub fn is_break(&self, time: f64) -> bool {
        match self {
            Self::Constant(_) | Self::Sine { .. } | Self::Sampled(_) => false,
            Self::DigitalController { clock, .. } => clock.is_active_at(time),
            Self::Table(rows) => rows.iter().any(|(bend, _)| *bend == time),
            Self::SmoothPulse { duration } => time == 0.0 || time == *duration,
            Self::Function { breaks, .. } => breaks.contains(&time),
            Self::Combined { parts, .. } => parts.0.is_break(time) || parts.1.is_break(time),
        }
    }

    pub(crate) fn may_jump_at(&self, time: f64) -> bool {
        match self {
            Self::Constant(_) | Self::Sine { .. } | Self::SmoothPulse { .. } | Self::Sampled(_) => {
                false
            }
            Self::DigitalController { clock, .. } => clock.is_active_at(time),
            Self::Table(rows) => rows.windows(2).any(|pair| pair[0].0 == time && pair[1].0 == time),
            Self::Function { breaks, .. } => breaks.contains(&time),
            Self::Combined { parts, .. } => parts.0.may_jump_at(time) || parts.1.may_jump_at(time),
        }
    }
}
