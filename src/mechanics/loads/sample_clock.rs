//! Times at which digital controllers sample and change their commands.

use super::{LoadError, multiple};

/// Clock of a digital controller with the period `T`, which samples at the times `n T`, `n = 0, 1, …`.
/// The command of the sample at `n T` acts from `n T + delay` until the next command starts to act.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleClock {
    period: f64,
    delay: f64,
}

/// Largest difference of two times that count as equal, as a fraction of the period.
const SAME: f64 = 1e-9;

impl SampleClock {
    /// Creates a clock with a sampling period and a dead time [time].
    ///
    /// # Errors
    /// Fails if the period is not positive, the delay is negative, or one of them is not finite.
    pub fn new(period: f64, delay: f64) -> Result<Self, LoadError> {
        let wrong = |name, value, allowed| {
            Err(LoadError::Value { schedule: "controller", name, value, allowed })
        };
        if !(period.is_finite() && period > 0.0) {
            return wrong("the sampling period", period, "a positive finite number");
        }
        if !(delay.is_finite() && delay >= 0.0) {
            return wrong("the delay", delay, "zero or a positive finite number");
        }
        Ok(Self { period, delay })
    }

    /// Sampling period [time].
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Dead time between a sample and the action of its command [time].
    pub fn delay(&self) -> f64 {
        self.delay
    }

    /// Time of the sample with a given index [time].
    pub fn sample(&self, number: u64) -> f64 {
        multiple(self.period, number)
    }

    /// Index of the last sample at or before a time; `None` before the first sample.
    /// Two times count as equal if they differ by less than `slack` [time].
    fn last_by(&self, time: f64, slack: f64) -> Option<u64> {
        if time < -slack {
            return None;
        }
        let number = ((time + slack).max(0.0) / self.period) as u64;
        if number > 0 && self.sample(number) > time + slack {
            return Some(number - 1);
        }
        let next = number.saturating_add(1);
        Some(if self.sample(next) <= time + slack { next } else { number })
    }

    /// Index of the sample at a time; `None` without a sample at this time.
    /// Two times count as equal if they differ by less than `slack` [time].
    pub fn sample_at(&self, time: f64, slack: f64) -> Option<u64> {
        self.last_by(time, slack).filter(|number| time - self.sample(*number) <= slack)
    }

    /// Index of the sample whose command acts just after a time [time]; `None` before the first command starts to act.
    pub fn sample_active_after(&self, time: f64, slack: f64) -> Option<u64> {
        self.last_by(time - self.delay, slack)
    }

    pub(crate) fn is_active_at(&self, time: f64) -> bool {
        self.sample_at(time - self.delay, SAME * self.period).is_some()
    }

    /// Time of the next event of the clock after `now` [time]: a sample, or the start of a command.
    pub fn next(&self, now: f64, slack: f64) -> f64 {
        let after = |time: f64| {
            self.sample(self.last_by(time, slack).map_or(0, |last| last.saturating_add(1)))
        };
        after(now).min(after(now - self.delay) + self.delay)
    }
}

fn time_text(time: f64) -> String {
    if (1e-4..1e7).contains(&time) { time.to_string() } else { format!("{time:e}") }
}

impl std::fmt::Display for SampleClock {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "every {}", time_text(self.period))?;
        if self.delay > 0.0 {
            write!(f, ", with a delay of {}", time_text(self.delay))
        } else {
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clock_returns_sample_and_command_times_in_order() {
        let beat = SampleClock::new(0.1, 0.03).unwrap();
        let mut times = vec![0.0];
        while times[times.len() - 1] < 0.5 {
            times.push(beat.next(times[times.len() - 1], 1e-12));
        }
        let expected = [0.0, 0.03, 0.1, 0.13, 0.2, 0.23, 0.3, 0.33, 0.4, 0.43, 0.5];
        assert_eq!(times.len(), expected.len());
        assert!(times.iter().zip(expected).all(|(time, other)| (time - other).abs() < 1e-15));
        assert_eq!(beat.sample_at(0.3, 1e-12), Some(3));
        assert_eq!(beat.sample_at(0.1 * 3.0, 1e-12), Some(3));
        assert_eq!(beat.sample_at(0.33, 1e-12), None);
        assert_eq!(beat.sample_active_after(0.02, 1e-12), None);
        assert_eq!(beat.sample_active_after(0.03, 1e-12), Some(0));
        assert_eq!(beat.sample_active_after(0.32, 1e-12), Some(2));
        assert!(beat.is_active_at(0.43) && !beat.is_active_at(0.4));
    }

    #[test]
    fn sample_clock_accepts_a_delay_longer_than_its_period() {
        let beat = SampleClock::new(0.01, 0.025).unwrap();
        assert_eq!(beat.sample_active_after(0.055, 1e-12), Some(3));
        assert_eq!(beat.next(0.0, 1e-12), 0.01);
        assert!((beat.next(0.03, 1e-12) - 0.035).abs() < 1e-15);
        assert_eq!(beat.to_string(), "every 0.01, with a delay of 0.025");
        assert_eq!(
            SampleClock::new(1e300, 2e-6).unwrap().to_string(),
            "every 1e300, with a delay of 2e-6"
        );
    }

    #[test]
    fn invalid_periods_and_delays_are_rejected() {
        for (period, delay) in [(0.0, 0.0), (-1.0, 0.0), (f64::NAN, 0.0), (1.0, -0.1)] {
            assert!(SampleClock::new(period, delay).is_err());
        }
        let message = SampleClock::new(1.0, f64::INFINITY).unwrap_err().to_string();
        assert!(message.contains("the delay is inf, but must be zero or a positive"), "{message}");
    }
}
