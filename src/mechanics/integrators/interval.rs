//! The span of time of one step.

/// The interval of one step or of a part of it [time].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The time at which the interval begins [time].
    pub start: f64,
    /// The time at which the interval ends [time].
    pub end: f64,
    /// Known to more digits than the difference of two late times.
    duration: f64,
    ending: IntervalEnd,
}

/// What ends at the end of an interval: a whole step, or a part of one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IntervalEnd {
    /// The interval ends only a part of a step, which goes on from there: what happens at the end of a step waits.
    OfPart,
    /// The interval ends a step.
    OfStep,
}

impl Interval {
    /// The interval from one time to another [time].
    pub const fn between(start: f64, end: f64) -> Self {
        Self { start, end, duration: end - start, ending: IntervalEnd::OfStep }
    }

    /// The interval of a duration from a time on [time]; its end is rounded, its duration is not.
    pub fn lasting(start: f64, duration: f64) -> Self {
        Self { start, end: start + duration, duration, ending: IntervalEnd::OfStep }
    }

    /// The part of the interval between two shares of its duration [-], backwards in time if the second one is smaller.
    pub fn part(&self, from: f64, to: f64) -> Self {
        let duration = (to - from) * self.duration;
        let start = self.start + from * self.duration;
        if to == 1.0 {
            return Self { start, duration, ..*self };
        }
        Self { start, end: self.start + to * self.duration, duration, ending: IntervalEnd::OfPart }
    }

    /// The duration `Δt` of the interval, negative if it leads backwards in time [time].
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Whether the interval ends a step or a part of one.
    pub fn ending(&self) -> IntervalEnd {
        self.ending
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_end_where_the_next_ones_begin_and_the_last_where_the_whole_ends() {
        let whole = Interval::between(0.3, 0.4);
        let parts = [(0.0, 0.8), (0.8, 0.3), (0.3, 1.0)].map(|(from, to)| whole.part(from, to));
        assert_eq!((parts[0].start, parts[2].end), (0.3, 0.4));
        assert_eq!((parts[0].end, parts[1].end), (parts[1].start, parts[2].start));
        assert!(parts[1].duration() < 0.0);
        let endings = parts.map(|part| part.ending());
        assert_eq!(endings, [IntervalEnd::OfPart, IntervalEnd::OfPart, IntervalEnd::OfStep]);
    }
}
