//! A step of the time grid: taken whole or in halves, cut where sliders arrive, and recorded.

use super::landing::MOST_ARRIVALS;
use super::recording::StepTaken;
use super::{Monitor, Simulation, SimulationError};
use crate::integrators::{Interval, StepError};
use crate::model::TrackLimit;
use crate::newton::NewtonReport;

/// A step is divided by at most two to this power.
const MOST_HALVINGS: u32 = 12;

/// The finest parts of a step.
const PARTS: u64 = 1 << MOST_HALVINGS;

/// How much of an interval was covered.
#[derive(PartialEq, Eq)]
pub(super) enum Covered {
    All,
    UntilAnArrival,
}

/// A step that is halved where it fails and grows again after success, as far as it has got.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Halving {
    whole: Interval,
    /// Finest parts that are behind.
    covered: u64,
    halvings: u32,
    /// Failed tries since the last success.
    retries: usize,
}

impl Halving {
    /// Nothing of a step is covered yet.
    pub(super) fn new(whole: Interval) -> Self {
        Self { whole, covered: 0, halvings: 0, retries: 0 }
    }

    /// Where the whole step ends.
    pub(super) fn end(&self) -> f64 {
        self.whole.end
    }

    /// Start and end of the whole step, the finest parts covered, halvings and retries.
    pub(super) fn to_parts(self) -> ((f64, f64), u64, u32, usize) {
        ((self.whole.start, self.whole.end), self.covered, self.halvings, self.retries)
    }

    /// A step that has got to `now`, from its parts; none when they make no sense.
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

    fn is_done(&self) -> bool {
        self.covered == PARTS
    }

    /// Itself, unless nothing is left of it.
    fn rest(self) -> Option<Self> {
        (!self.is_done()).then_some(self)
    }

    /// What to try next.
    fn next(&self) -> Interval {
        Interval::between(self.time(self.covered), self.time(self.covered + self.width()))
    }

    fn succeed(&mut self) {
        let width = self.width();
        self.covered += width;
        self.retries = 0;
        if self.halvings > 0 && self.covered.is_multiple_of(2 * width) {
            self.halvings -= 1;
        }
    }

    /// Halves what is to be tried; false when it cannot be smaller.
    fn fail(&mut self) -> bool {
        self.retries += 1;
        let can_be_halved = self.halvings < MOST_HALVINGS;
        self.halvings += u32::from(can_be_halved);
        can_be_halved
    }
}

impl Simulation {
    /// Goes on to the end of a step, cutting the way where sliders arrive at ends of their masters.
    pub(super) fn cover_with_arrivals(
        &mut self,
        mut halving: Halving,
        monitor: &mut dyn Monitor,
    ) -> Result<(), SimulationError> {
        let end = halving.end();
        for _ in 0..MOST_ARRIVALS {
            let covered = self.cover(halving, monitor)?;
            let is_there = self.has_reached(end);
            if covered == Covered::All || is_there || self.has_ended() {
                return Ok(());
            }
            halving = Halving::new(Interval::between(self.time(), end));
        }
        Err(self.rattles())
    }

    /// The error of a slider that does not get away from an end.
    pub(super) fn rattles(&self) -> SimulationError {
        let arrival = self.arrivals.last().map_or_else(
            || format!("a slider is about to arrive after t = {}", self.time()),
            |last| self.describe(last),
        );
        SimulationError::Rattles { arrival, most: MOST_ARRIVALS }
    }

    /// Covers an interval by one step or, where that fails, by halves of it, growing again after success.
    pub(super) fn cover(
        &mut self,
        mut halving: Halving,
        monitor: &mut dyn Monitor,
    ) -> Result<Covered, SimulationError> {
        while !halving.is_done() {
            let interval = halving.next();
            let mut stepped = self.integrator.step(&mut self.model, interval);
            if let Err(StepError::Overshoot { overshoot, iterations, .. }) = stepped {
                self.count_try(iterations);
                match self.land(interval, overshoot) {
                    Ok(landing) => {
                        self.under_way = None;
                        if let Some((interval, report)) = landing.step {
                            self.count_step(interval, report, halving.retries);
                            self.keep_row();
                        }
                        let arrived = self.arrive(&landing);
                        // An arrival without a step is not remembered: going on from the step before leads here again.
                        if landing.step.is_some() {
                            self.remember();
                        }
                        arrived?;
                        return self.ask(monitor).map(|()| Covered::UntilAnArrival);
                    }
                    Err(source) => stepped = Err(source),
                }
            }
            match stepped {
                Ok(report) => {
                    self.count_step(interval, report, halving.retries);
                    if self.is_worth_a_row() {
                        self.keep_row();
                    }
                    halving.succeed();
                    self.under_way = halving.rest();
                    self.remember();
                }
                Err(source) if !source.may_be_cured_by_a_smaller_step() => {
                    return Err(SimulationError::Load { source });
                }
                Err(source) => {
                    self.counts.retries += 1;
                    self.counts.factorisations += source.factorisations();
                    let divisions = PARTS / halving.width();
                    if !halving.fail() {
                        return Err(self.no_step(halving.whole.duration(), divisions, source));
                    }
                    self.under_way = halving.rest();
                }
            }
            self.ask(monitor)?;
        }
        Ok(Covered::All)
    }

    /// Asks whether the run goes on.
    pub(super) fn ask(&self, monitor: &mut dyn Monitor) -> Result<(), SimulationError> {
        let time = self.time();
        if monitor.goes_on(time) { Ok(()) } else { Err(SimulationError::Interrupted { time }) }
    }

    /// The error of steps that failed in every size.
    fn no_step(&self, dt: f64, divisions: u64, source: StepError) -> SimulationError {
        let time = self.time();
        if let StepError::Overshoot { overshoot, .. } = &source {
            let limit = TrackLimit::of(overshoot.limit);
            let slider = self.scene.sliders[limit.slider].name.clone();
            return SimulationError::Landing { slider, end: limit.end.name(), time, dt, divisions };
        }
        SimulationError::Step { time, dt, divisions, source }
    }

    /// Counts a step that succeeded.
    pub(super) fn count_step(&mut self, interval: Interval, report: NewtonReport, retries: usize) {
        self.counts.steps += 1;
        self.counts.newton_iterations += report.iterations;
        self.counts.corrections += report.corrections;
        self.counts.newton_max = self.counts.newton_max.max(report.iterations);
        self.counts.factorisations += report.iterations;
        let (dt, newton_iterations) = (interval.duration(), report.iterations);
        self.last_step = StepTaken { dt, newton_iterations, retries };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_that_fails_is_halved_and_grows_again() {
        let mut halving = Halving::new(Interval::between(0.0, 1.0));
        assert!(halving.fail() && halving.fail());
        let mut ends = Vec::new();
        while let Some(rest) = halving.rest() {
            ends.push(rest.next().end);
            halving.succeed();
        }
        assert_eq!(ends, [0.25, 0.5, 1.0]);
    }

    #[test]
    fn parts_that_make_no_sense_are_no_step() {
        let mut halving = Halving::new(Interval::between(1.0, 2.0));
        halving.fail();
        halving.succeed();
        let parts = halving.to_parts();
        assert_eq!(Halving::from_parts(1.5, parts), Some(halving));
        assert_eq!(Halving::from_parts(1.25, parts), None);
        let ((start, end), covered, halvings, retries) = parts;
        assert_eq!(Halving::from_parts(1.5, ((start, end), covered, 70, retries)), None);
        assert_eq!(Halving::from_parts(1.5, ((start, f64::NAN), covered, halvings, 0)), None);
        assert_eq!(Halving::from_parts(2.0, ((start, end), PARTS, 0, 0)), None);
    }
}
