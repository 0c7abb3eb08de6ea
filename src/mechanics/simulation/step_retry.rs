//! Step of the time grid that is halved after a failure.

use crate::integrators::Interval;

const MOST_HALVINGS: u32 = 12;

/// Number of parts of a step if all parts have the smallest size.
const PARTS: u64 = 1 << MOST_HALVINGS;

/// Step that may be partially completed. Its parts are halved after a failure and doubled after a success.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StepRetry {
    pub(super) whole: Interval,
    covered: u64,
    halvings: u32,
    pub(super) retries: usize,
}

impl StepRetry {
    pub(super) fn new(whole: Interval) -> Self {
        Self { whole, covered: 0, halvings: 0, retries: 0 }
    }

    pub(super) fn end(&self) -> f64 {
        self.whole.end
    }

    pub(super) fn to_parts(self) -> ((f64, f64), u64, u32, usize) {
        ((self.whole.start, self.whole.end), self.covered, self.halvings, self.retries)
    }

    /// Restores a partially completed step at time `now`; `None` if the components are inconsistent.
    pub(super) fn from_parts(
        now: f64,
        ((start, end), covered, halvings, retries): ((f64, f64), u64, u32, usize),
    ) -> Option<Self> {
        let whole = Interval::between(start, end);
        let new = Self { whole, covered, halvings, retries };
        let is_finite = start.is_finite() && end.is_finite() && start < end;
        let is_halved = halvings <= MOST_HALVINGS && covered < PARTS;
        let fits = is_finite && is_halved && covered.is_multiple_of(PARTS >> halvings);
        (fits && new.time(covered) == now && retries < usize::MAX / 2).then_some(new)
    }

    fn time(&self, part: u64) -> f64 {
        match part {
            PARTS => self.whole.end,
            part => self.whole.start + self.whole.duration() * (part as f64 / PARTS as f64),
        }
    }

    fn width(&self) -> u64 {
        PARTS >> self.halvings
    }

    pub(super) fn divisions(&self) -> u64 {
        1 << self.halvings
    }

    pub(super) fn is_done(&self) -> bool {
        self.covered == PARTS
    }

    pub(super) fn remaining(self) -> Option<Self> {
        (!self.is_done()).then_some(self)
    }

    pub(super) fn next(&self) -> Interval {
        Interval::between(self.time(self.covered), self.time(self.covered + self.width()))
    }

    pub(super) fn succeed(&mut self) {
        let width = self.width();
        self.covered += width;
        self.retries = 0;
        if self.halvings > 0 && self.covered.is_multiple_of(2 * width) {
            self.halvings -= 1;
        }
    }

    /// Halves the size of the next part. Returns false if the next part already has the smallest size.
    pub(super) fn fail(&mut self) -> bool {
        self.retries += 1;
        let can_be_halved = self.halvings < MOST_HALVINGS;
        self.halvings += u32::from(can_be_halved);
        can_be_halved
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failed_step_is_halved_and_then_doubled_again() {
        let mut halving = StepRetry::new(Interval::between(0.0, 1.0));
        assert!(halving.fail() && halving.fail());
        let mut ends = Vec::new();
        while let Some(rest) = halving.remaining() {
            ends.push(rest.next().end);
            halving.succeed();
        }
        assert_eq!(ends, [0.25, 0.5, 1.0]);
    }

    #[test]
    fn inconsistent_stored_retries_are_rejected() {
        let mut halving = StepRetry::new(Interval::between(1.0, 2.0));
        halving.fail();
        halving.succeed();
        let parts = halving.to_parts();
        assert_eq!(StepRetry::from_parts(1.5, parts), Some(halving));
        assert_eq!(StepRetry::from_parts(1.25, parts), None);
        let ((start, end), covered, halvings, retries) = parts;
        assert_eq!(StepRetry::from_parts(1.5, ((start, end), covered, 70, retries)), None);
        assert_eq!(StepRetry::from_parts(1.5, ((start, f64::NAN), covered, halvings, 0)), None);
        assert_eq!(StepRetry::from_parts(2.0, ((start, end), PARTS, 0, 0)), None);
    }
}
