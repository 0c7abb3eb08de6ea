//! The span of time of one step.

/// The interval of one step or of a part of it [time].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Where it begins.
    pub start: f64,
    /// Where it ends.
    pub end: f64,
    /// Known to more digits than the difference of two late times.
    duration: f64,
    ending: Ending,
}

/// What ends where an interval ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// Only a part of a step, which goes on from there: what happens at the end of a step waits.
    OfPart,
    /// The step.
    OfStep,
}

impl Interval {
    /// From one time to another.
    pub const fn between(start: f64, end: f64) -> Self {
        Self { start, end, duration: end - start, ending: Ending::OfStep }
    }

    /// From a time on; its end is rounded, its duration is not.
    pub fn lasting(start: f64, duration: f64) -> Self {
        Self { start, end: start + duration, duration, ending: Ending::OfStep }
    }

    /// The part of it between two shares of its duration, backwards in time if the second one is smaller.
    pub fn part(&self, from: f64, to: f64) -> Self {
        let duration = (to - from) * self.duration;
        let start = self.start + from * self.duration;
        if to == 1.0 {
            return Self { start, duration, ..*self };
        }
        Self { start, end: self.start + to * self.duration, duration, ending: Ending::OfPart }
    }

    /// Its length `Δt`, negative if it leads backwards in time [time].
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// What ends where it ends.
    pub fn ending(&self) -> Ending {
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
        assert_eq!(endings, [Ending::OfPart, Ending::OfPart, Ending::OfStep]);
    }
}
