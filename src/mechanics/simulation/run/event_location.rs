//! Steps that end exactly where a slider reaches the end of its master, and what happens there.

use super::Simulation;
use crate::elementary::whole_power;
use crate::geometry::Vec2;
use crate::integrators::{Interval, Overshoot, StepError};
use crate::joints::EndAction;
use crate::newton::NewtonReport;
use crate::simulation::first_step::first_step;
use crate::simulation::{Arrival, ArrivalKind, SimulationError, StepSize};
use crate::system::{Arriving, MasterEnd, MasterLimit, SliderState};

/// Most tries to find the time of an arrival; few are needed, the rest is for bad luck.
const MOST_TRIES: usize = 60;

/// A slider that is about to reach an end and as near to it as this, as a part of its master, has reached it: a step over what
/// is left would make velocities out of the rounding of places.
const NEAR: f64 = 1e-10;

/// How often a step is halved to see whether a slider at an end leaves it for a while.
const PROBES: i32 = 12;

/// A slider that has struck the same end so often within as many steps leans on it.
const CHATTER: usize = 3;

/// The most arrivals of sliders within one step of the grid; more are an error.
pub(super) const MOST_ARRIVALS: usize = 10_000;

/// A step that was cut where a slider arrives at an end of its master.
pub(super) struct EventStep {
    /// The interval of the step and its work; none for a slider that is at the end already and led beyond it by every step.
    pub(super) step: Option<(Interval, NewtonReport)>,
    /// What comes of the step.
    event: Event,
}

/// What ends a step before its time, or keeps it from beginning.
enum Event {
    /// A slider reaches a limit.
    Reaches(MasterLimit),
    /// A slider would pass a limit by a jump: the step ends just before it.
    JustBefore,
    /// Sliders leave stops that would have to pull.
    Leaves,
}

/// What is known of an arrival before it is searched for.
enum ArrivalEstimate {
    /// It lies between two times.
    Between(TimeBracket),
    /// A step was taken that ends with it, or none is needed.
    Landed(EventStep),
}

/// Durations of steps that end before and after an arrival, with the distances beyond the limit there.
struct TimeBracket {
    before: (f64, f64),
    after: (f64, f64),
    /// The side that was replaced last.
    last: Option<BracketSide>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum BracketSide {
    Before,
    After,
}

impl TimeBracket {
    fn new(before: (f64, f64), after: (f64, f64)) -> Self {
        Self { before, after, last: None }
    }

    /// Puts a duration in the place of the one on its side.
    fn narrow(&mut self, duration: f64, distance: f64) {
        let side = if distance > 0.0 { BracketSide::After } else { BracketSide::Before };
        let is_again = self.last == Some(side);
        let (replaced, other) = match side {
            BracketSide::Before => (&mut self.before, &mut self.after),
            BracketSide::After => (&mut self.after, &mut self.before),
        };
        *replaced = (duration, distance);
        if is_again {
            other.1 *= 0.5;
        }
        self.last = Some(side);
    }

    /// Whether there is no duration between the two any more.
    fn is_closed(&self) -> bool {
        self.after.0 - self.before.0 <= 4.0 * f64::EPSILON * self.after.0
    }

    /// The next duration to try: false position, with the weight of an end halved that stays (Illinois; Dowell & Jarratt 1971).
    fn guess(&self) -> f64 {
        let ((t0, f0), (t1, f1)) = (self.before, self.after);
        let t = t1 - f1 * (t1 - t0) / (f1 - f0);
        // Rounding may put it on an end.
        if t > t0 && t < t1 { t } else { 0.5 * (t0 + t1) }
    }
}

impl Simulation {
    /// Takes a step that ends where the slider arrives that went too far in the whole interval.
    pub(super) fn land(
        &mut self,
        interval: Interval,
        overshoot: Overshoot,
    ) -> Result<EventStep, StepError> {
        let landing = self.search(interval, overshoot);
        self.model.aim_at(None);
        landing
    }

    fn search(&mut self, interval: Interval, first: Overshoot) -> Result<EventStep, StepError> {
        let (mut cut, mut overshoot) = (interval, first);
        let mut tries = 0..MOST_TRIES;
        // Once for each slider that turns out to arrive before the one aimed at.
        loop {
            let limit = MasterLimit::of(overshoot.limit);
            if let SliderState::Held(_) = self.model.slider_state(limit.slider) {
                return Ok(EventStep { step: None, event: Event::Leaves });
            }
            self.model.aim_at(Some(limit));
            let mut bracket = match self.prospect(cut, limit, overshoot.distance)? {
                ArrivalEstimate::Between(bracket) => bracket,
                ArrivalEstimate::Landed(landing) => return Ok(landing),
            };
            loop {
                if bracket.is_closed() {
                    self.model.aim_at(None);
                    let short = Interval::lasting(interval.start, bracket.before.0);
                    let report = self.stepper.integrator.step(&mut self.model, short)?;
                    return Ok(EventStep { step: Some((short, report)), event: Event::JustBefore });
                }
                if tries.next().is_none() {
                    return Err(StepError::Overshoot { interval, overshoot: first, iterations: 0 });
                }
                let duration = bracket.guess();
                cut = Interval::lasting(interval.start, duration);
                overshoot = match self.attempt(cut)? {
                    Ok(report) => {
                        let event = Event::Reaches(limit);
                        return Ok(EventStep { step: Some((cut, report)), event });
                    }
                    Err(overshoot) => overshoot,
                };
                if overshoot.limit != limit.number() {
                    break;
                }
                bracket.narrow(duration, overshoot.distance);
            }
        }
    }

    /// Looks for a step that ends before the arrival, given one that ends after it.
    fn prospect(
        &mut self,
        interval: Interval,
        limit: MasterLimit,
        distance: f64,
    ) -> Result<ArrivalEstimate, StepError> {
        let mut after = (interval.duration(), distance);
        let left = self.model.distance_to(limit);
        let at_once = EventStep { step: None, event: Event::Reaches(limit) };
        let is_near = self.model.leads_beyond(limit) && left <= NEAR;
        if is_near && (!self.model.is_at(limit) || self.strikes(limit)) {
            return Ok(ArrivalEstimate::Landed(at_once));
        }
        if !self.model.is_at(limit) {
            return Ok(ArrivalEstimate::Between(TimeBracket::new((0.0, -left), after)));
        }
        // Where the whole step hardly leaves the end, the slider rests there: halves of it would tell rounding from rounding.
        for halving in 1..=PROBES {
            if after.1 <= NEAR {
                break;
            }
            let duration = interval.duration() * whole_power(0.5, halving);
            let cut = Interval::lasting(interval.start, duration);
            match self.attempt(cut)? {
                Ok(report) => {
                    let event = Event::Reaches(limit);
                    return Ok(ArrivalEstimate::Landed(EventStep {
                        step: Some((cut, report)),
                        event,
                    }));
                }
                Err(overshoot) if overshoot.limit != limit.number() => {}
                Err(Overshoot { distance, .. }) if distance < 0.0 => {
                    return Ok(ArrivalEstimate::Between(TimeBracket::new(
                        (duration, distance),
                        after,
                    )));
                }
                Err(Overshoot { distance, .. }) => after = (duration, distance),
            }
        }
        Ok(ArrivalEstimate::Landed(at_once))
    }

    /// Tries a step; one that does not end where it is aimed at is counted, and not taken.
    fn attempt(&mut self, cut: Interval) -> Result<Result<NewtonReport, Overshoot>, StepError> {
        match self.stepper.integrator.step(&mut self.model, cut) {
            Ok(report) => Ok(Ok(report)),
            Err(StepError::Overshoot { overshoot, iterations, .. }) => {
                self.progress.count_try(iterations);
                Ok(Err(overshoot))
            }
            Err(other) => Err(other),
        }
    }

    /// Whether a slider that is at a limit and led beyond it does something there other than to rest: by what steps follow of its motion, it strikes.
    fn strikes(&mut self, limit: MasterLimit) -> bool {
        let dt = self.dt();
        !self.model.end_action(limit.slider).has_stop()
            || self.model.goes_on(limit)
            || self.model.approaches(limit, dt).unwrap_or(true)
    }

    /// Does what is to be done where sliders arrive, all that do at one time together: the run stops, or sliders bounce, rest or leave.
    pub(super) fn arrive(&mut self, landing: &EventStep) -> Result<(), SimulationError> {
        let limit = match landing.event {
            Event::Reaches(limit) => limit,
            Event::JustBefore => return Ok(()),
            Event::Leaves => return Ok(self.model.leave_stops()?),
        };
        let dt = self.dt();
        let mut arriving = Arriving::default();
        let mut arrivals = Vec::new();
        for limit in self.model.arriving_with(limit) {
            let strikes = self.model.leads_beyond(limit);
            let kind = match self.model.end_action(limit.slider) {
                _ if self.model.goes_on(limit) => {
                    // It only touched the seam, or its velocity has turned round just there.
                    if landing.step.is_some() && !strikes {
                        continue;
                    }
                    let (group, kind) = match self.stays_at_seam(limit, landing, dt) {
                        true => (&mut arriving.lean, ArrivalKind::Rested),
                        false => (&mut arriving.pass, ArrivalKind::Passed),
                    };
                    group.push(limit);
                    kind
                }
                EndAction::Stop => ArrivalKind::Stopped,
                EndAction::Release => {
                    self.model.release(limit.slider);
                    ArrivalKind::Released
                }
                // It only touched the stop, or its velocity has turned round just there.
                _ if landing.step.is_some() && !strikes => ArrivalKind::Bounced,
                _ if self.leans(limit, landing, dt)? => {
                    arriving.lean.push(limit);
                    ArrivalKind::Rested
                }
                _ if self.model.restitution(limit.slider) == 0.0 => {
                    arriving.stay.push(limit);
                    ArrivalKind::Rested
                }
                EndAction::Bounce | EndAction::Contact => {
                    arriving.strike.push(limit);
                    ArrivalKind::Bounced
                }
            };
            arrivals.push(self.arrival(limit, kind));
        }
        if !arriving.is_empty() {
            self.model.meet(&arriving, dt)?;
            for arrival in &mut arrivals {
                arrival.impulse = self.model.impulse_of(arrival.limit.slider);
            }
        }
        // What ends the run is told last.
        arrivals.sort_by_key(|arrival| arrival.kind == ArrivalKind::Stopped);
        self.progress.arrivals.extend(arrivals);
        Ok(())
    }

    /// Whether a slider at a limit comes to lean on its stop, and not to bounce: it strikes again and again within few steps, its blow is an elastic contact
    /// that the steps to come resolve, or every step leads it beyond although it does not approach.
    fn leans(
        &mut self,
        limit: MasterLimit,
        landing: &EventStep,
        dt: f64,
    ) -> Result<bool, SimulationError> {
        let is_contact = self.model.end_action(limit.slider) == EndAction::Contact;
        if self.chatters(limit, dt) || (is_contact && self.model.resolves_blow(limit, dt)?) {
            return Ok(true);
        }
        Ok(landing.step.is_none() && !self.model.approaches(limit, dt)?)
    }

    /// Whether a slider at a seam comes to lean on it, and not to pass: both sides lead it back at once, or it passes to and fro within few steps.
    fn stays_at_seam(&self, limit: MasterLimit, landing: &EventStep, dt: f64) -> bool {
        let is_led_back = landing.step.is_none() && self.model.came_to_seam_now(limit.slider);
        is_led_back || self.passes_to_and_fro(limit, dt)
    }

    /// The time in which so many blows, or ways to and fro, are none that steps of a length tell apart [time]. Of varying steps, which grow as far as flights last,
    /// those are taken in which a wave passes a span.
    fn unresolved(&self, dt: f64) -> f64 {
        CHATTER as f64
            * match self.settings.dt {
                StepSize::Fixed(_) => dt,
                StepSize::Adaptive(_) => dt.min(first_step(&self.scene, &self.model)),
            }
    }

    /// Whether a slider has passed the same seam to and fro so often within as many steps that nothing is resolved of what is between.
    fn passes_to_and_fro(&self, limit: MasterLimit, dt: f64) -> bool {
        let since = self.time() - self.unresolved(dt);
        let own = self.progress.arrivals.iter().rev();
        let own = own.filter(|arrival| arrival.limit.slider == limit.slider);
        let passed =
            own.take_while(|arrival| arrival.kind == ArrivalKind::Passed && arrival.time >= since);
        let place = |arrival: &Arrival| (arrival.limit.end, arrival.beam);
        let places: Vec<_> = passed.map(place).take(2 * CHATTER).collect();
        let here = (limit.end, Some(self.model.slider_beam(limit.slider)));
        let alternates = |pair: &[(MasterEnd, Option<usize>)]| pair[0] != here && pair[1] == here;
        let back = |pair: &[(MasterEnd, Option<usize>)]| pair[0] == places[0] && alternates(pair);
        places.len() == 2 * CHATTER && places.chunks_exact(2).all(back)
    }

    /// The arrival of a slider at a limit at the present moment.
    fn arrival(&self, limit: MasterLimit, kind: ArrivalKind) -> Arrival {
        let is_on_track = self.scene.sliders[limit.slider].track.is_some();
        let beam = is_on_track.then(|| self.model.slider_beam(limit.slider));
        Arrival { time: self.model.time(), limit, beam, kind, impulse: Vec2::zeros() }
    }

    /// Whether a slider has struck the same end so often within as many steps that nothing is resolved of its flights between.
    fn chatters(&self, limit: MasterLimit, dt: f64) -> bool {
        let own = self.progress.arrivals.iter().rev();
        let mut last = own.filter(|arrival| arrival.limit.slider == limit.slider).take(CHATTER);
        let since = self.time() - self.unresolved(dt);
        let again = |arrival: &Arrival| arrival.limit == limit && arrival.time >= since;
        last.by_ref().take_while(|arrival| again(arrival)).count() == CHATTER
    }

    /// Lets every slider arrive at the end of its master, for a pretended run: scripts may wait for that.
    pub(super) fn pretend_arrivals(&mut self) {
        let arrival = |slider: usize| {
            let limit = MasterLimit { slider, end: MasterEnd::End };
            let kind = match self.model.end_action(slider) {
                _ if self.scene.goes_round(slider) => ArrivalKind::Passed,
                EndAction::Stop => ArrivalKind::Stopped,
                EndAction::Bounce | EndAction::Contact => ArrivalKind::Bounced,
                EndAction::Release => ArrivalKind::Released,
            };
            self.arrival(limit, kind)
        };
        let mut arrivals: Vec<Arrival> = (0..self.scene.sliders.len()).map(arrival).collect();
        arrivals.sort_by_key(|arrival| arrival.kind == ArrivalKind::Stopped);
        self.progress.arrivals = arrivals;
    }

    /// The arrivals of sliders at the ends of their masters so far.
    pub fn arrivals(&self) -> &[Arrival] {
        &self.progress.arrivals
    }

    /// Whether a slider has ended the run.
    pub fn has_ended(&self) -> bool {
        self.progress.stopped().is_some()
    }

    /// The arrival that has ended the run, in words, if one has.
    pub fn ending(&self) -> Option<String> {
        self.progress.stopped().map(|stopped| self.describe(stopped))
    }

    /// An arrival of the simulation in words.
    pub(super) fn describe(&self, arrival: &Arrival) -> String {
        let beam = arrival.beam.map(|beam| self.scene.beams[beam].name.as_str());
        arrival.describe(&self.scene.sliders[arrival.limit.slider].name, beam)
    }

    /// What a slider of the simulation does at present, by its index.
    pub fn slider_state(&self, slider: usize) -> SliderState {
        self.model.slider_state(slider)
    }
}
