//! Where schedules jump or bend.

use super::Schedule;
use crate::loads::SampleClock;

impl Schedule {
    /// The times at which the schedule jumps or bends; steps should end there.
    pub fn breaks(&self) -> Vec<f64> {
        match self {
            Self::Constant(_) | Self::Sine { .. } | Self::Sampled(_) | Self::Clocked { .. } => {
                Vec::new()
            }
            Self::Table(rows) => rows.iter().map(|(time, _)| *time).collect(),
            Self::SmoothPulse { duration } => vec![0.0, *duration],
            Self::Function { breaks, .. } => breaks.clone(),
            Self::Combined { parts, .. } => [parts.0.breaks(), parts.1.breaks()].concat(),
        }
    }

    /// The beat of a digital controller among the parts of the schedule, if there is one; steps should end where it is asked and where it acts. Controllers are
    /// never combined with other schedules.
    pub fn beat(&self) -> Option<SampleClock> {
        if let Self::Clocked { beat, .. } = self { Some(*beat) } else { None }
    }

    /// Whether a time is one of those at which the schedule jumps or bends.
    pub fn may_bend_at(&self, time: f64) -> bool {
        match self {
            Self::Constant(_) | Self::Sine { .. } | Self::Sampled(_) => false,
            Self::Clocked { beat, .. } => beat.acts_at(time),
            Self::Table(rows) => rows.iter().any(|(bend, _)| *bend == time),
            Self::SmoothPulse { duration } => time == 0.0 || time == *duration,
            Self::Function { breaks, .. } => breaks.contains(&time),
            Self::Combined { parts, .. } => parts.0.may_bend_at(time) || parts.1.may_bend_at(time),
        }
    }

    /// Whether the schedule may have different values just before and just after a time.
    pub fn may_jump_at(&self, time: f64) -> bool {
        match self {
            Self::Constant(_) | Self::Sine { .. } | Self::SmoothPulse { .. } | Self::Sampled(_) => {
                false
            }
            Self::Clocked { beat, .. } => beat.acts_at(time),
            Self::Table(rows) => rows.windows(2).any(|pair| pair[0].0 == time && pair[1].0 == time),
            Self::Function { breaks, .. } => breaks.contains(&time),
            Self::Combined { parts, .. } => parts.0.may_jump_at(time) || parts.1.may_jump_at(time),
        }
    }
}
