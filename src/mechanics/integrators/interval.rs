//! Time interval of a step.

/// Interval of a step or of a substep [time].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Start time of the interval [time].
    pub start: f64,
    /// End time of the interval [time].
    pub end: f64,
    /// Duration of the interval, stored because the difference of two large times is less accurate [time].
    duration: f64,
    ending: IntervalEnd,
}

/// Role of an interval: a whole step, or a substep of a composed method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IntervalEnd {
    /// Substep of a composed method. Sliders at stops are released only at the end of a whole step.
    Substep,
    /// Whole step of an integrator.
    Step,
}

impl Interval {
    /// Interval between two times [time].
    pub const fn between(start: f64, end: f64) -> Self {
        Self { start, end, duration: end - start, ending: IntervalEnd::Step }
    }

    /// Interval with an exact start and an exact duration [time]. Only its end time is rounded.
    pub fn lasting(start: f64, duration: f64) -> Self {
        Self { start, end: start + duration, duration, ending: IntervalEnd::Step }
    }

    /// Part of the interval between two fractions of its duration [-].
    /// The part runs backwards in time if the second fraction is smaller than the first.
    pub fn part(&self, from: f64, to: f64) -> Self {
        let duration = (to - from) * self.duration;
        let start = self.start + from * self.duration;
        if to == 1.0 {
            return Self { start, duration, ..*self };
        }
        Self { start, end: self.start + to * self.duration, duration, ending: IntervalEnd::Substep }
    }

    /// Duration `Δt` of the interval [time], negative for backward intervals.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Role of the interval: a whole step, or a substep.
    pub fn ending(&self) -> IntervalEnd {
        self.ending
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interval_parts_share_their_ends_exactly() {
        let whole = Interval::between(0.3, 0.4);
        let parts = [(0.0, 0.8), (0.8, 0.3), (0.3, 1.0)].map(|(from, to)| whole.part(from, to));
        assert_eq!((parts[0].start, parts[2].end), (0.3, 0.4));
        assert_eq!((parts[0].end, parts[1].end), (parts[1].start, parts[2].start));
        assert!(parts[1].duration() < 0.0);
        let endings = parts.map(|part| part.ending());
        assert_eq!(endings, [IntervalEnd::Substep, IntervalEnd::Substep, IntervalEnd::Step]);
    }
}
