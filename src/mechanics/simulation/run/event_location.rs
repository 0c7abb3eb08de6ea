//! Location and execution of slider events in a step: arrivals at the ends of masters, landings, take-offs and friction transitions.

use super::Simulation;
use crate::elementary::whole_power;
use crate::geometry::Vec2;
use crate::integrators::{Interval, Overshoot, StepError};
use crate::joints::EndAction;
use crate::newton::NewtonReport;
use crate::simulation::first_step::shortest_wave_time;
use crate::simulation::{Arrival, ArrivalKind, SimulationError, StepSize};
use crate::system::{
    Arriving, ContactChange, END_TOLERANCE, MasterEnd, MasterLimit, SliderEvent, SliderState,
};

/// Largest number of attempts to find the time of a slider event. A few attempts are usual.
const MOST_TRIES: usize = 60;

/// Largest distance from an end at which an approaching slider counts as having reached the end, as a fraction of the length of the master.
/// A step over a very short distance would convert rounding errors of positions to velocities.
const NEAR: f64 = 1e-10;

/// Shortest duration from the start of a step to a friction transition or take-off, and from there to the end of the step, as a fraction of the step length.
/// In a step shorter than `SHORT`, rounding errors of positions would become contact forces.
const SHORT: f64 = 1e-4;

/// Largest error of the time of a friction transition or take-off, as a fraction of the step length.
const RESOLUTION: f64 = 1e-7;

/// Largest number of halvings in the search for a shorter step in which a slider at an end of its master moves away from the end.
const PROBES: i32 = 12;

/// If this number of impacts at the same end occurs within the same number of steps, the stop holds the slider.
const CHATTER: usize = 3;

/// Largest number of arrivals within one step of the regular time grid. More arrivals are an error.
pub(super) const MOST_ARRIVALS: usize = 10_000;

pub(super) struct EventStep {
    pub(super) step: Option<(Interval, NewtonReport)>,
    event: Event,
}

enum Event {
    Slider(SliderEvent),
    JustBefore,
    StopRelease,
}

impl Event {
    fn just_before(target: SliderEvent) -> Self {
        match target {
            SliderEvent::Limit(_) | SliderEvent::Landing(_) => Self::JustBefore,
            SliderEvent::SlipEnd(_) | SliderEvent::SlipStart(_) | SliderEvent::TakeOff(_) => {
                Self::Slider(target)
            }
        }
    }
}

enum ArrivalEstimate {
    Between(TimeBracket),
    Located(EventStep),
}

impl ArrivalEstimate {
    fn at_once(number: usize) -> Self {
        Self::Located(EventStep { step: None, event: Event::Slider(SliderEvent::of(number)) })
    }
}

struct TimeBracket {
    before: (f64, f64),
    after: (f64, f64),
    last: Option<BracketSide>,
    /// Lower limit of the duration of a trial step [time].
    shortest: f64,
    /// Upper limit of the duration of a trial step [time].
    longest: f64,
    /// Difference between the durations `before` and `after` at which the search ends [time].
    resolution: f64,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum BracketSide {
    Before,
    After,
}

impl TimeBracket {
    fn new(before: (f64, f64), after: (f64, f64)) -> Self {
        Self { before, after, last: None, shortest: 0.0, longest: after.0, resolution: 0.0 }
    }

    fn with_shortest(self, shortest: f64) -> Self {
        Self { shortest, ..self }
    }

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

    fn is_at_start(&self) -> bool {
        self.after.0 <= self.shortest
    }

    fn is_converged(&self) -> bool {
        let smallest = (4.0 * f64::EPSILON * self.after.0).max(self.resolution);
        self.after.0 - self.before.0 <= smallest || self.before.0 >= self.longest
    }

    fn next_duration(&self) -> f64 {
        self.estimate().clamp(self.shortest, self.longest)
    }

    fn estimate(&self) -> f64 {
        let ((t0, f0), (t1, f1)) = (self.before, self.after);
        let t = t1 - f1 * (t1 - t0) / (f1 - f0);
        if t > t0 && t < t1 { t } else { 0.5 * (t0 + t1) }
    }
}

fn bracket_sign_change(
    interval: Interval,
    Overshoot { event, distance }: Overshoot,
    start: f64,
    dt: f64,
) -> ArrivalEstimate {
    let whole = interval.duration();
    let shortest = (SHORT * dt).min(0.25 * whole);
    let bracket = TimeBracket {
        shortest,
        longest: whole - shortest,
        resolution: RESOLUTION * dt,
        ..TimeBracket::new((0.0, -start), (whole, distance))
    };
    match start <= 0.0 || distance <= 0.0 || bracket.estimate() < shortest {
        true => ArrivalEstimate::at_once(event),
        false => ArrivalEstimate::Between(bracket),
    }
}

impl Simulation {
    pub(super) fn locate_arrival(
        &mut self,
        interval: Interval,
        overshoot: Overshoot,
    ) -> Result<EventStep, StepError> {
        let located = self.search(interval, overshoot);
        self.model.set_target(None);
        located
    }

    fn search(&mut self, interval: Interval, first: Overshoot) -> Result<EventStep, StepError> {
        let (mut cut, mut overshoot) = (interval, first);
        let mut tries = 0..MOST_TRIES;
        loop {
            let target = SliderEvent::of(overshoot.event);
            self.model.set_target(Some(target));
            let bracket = match target {
                SliderEvent::Limit(limit) if self.is_held(limit) => {
                    return Ok(EventStep { step: None, event: Event::StopRelease });
                }
                SliderEvent::Limit(limit) => {
                    self.bracket_arrival(cut, limit, overshoot.distance)?
                }
                SliderEvent::SlipEnd(slider) => {
                    let speed = self.model.slip_speed(slider);
                    bracket_sign_change(cut, overshoot, speed, self.dt())
                }
                SliderEvent::TakeOff(slider) => {
                    let push = self.model.push(slider);
                    bracket_sign_change(cut, overshoot, push, self.dt())
                }
                SliderEvent::Landing(slider) => self.bracket_landing(cut, overshoot, slider)?,
                SliderEvent::SlipStart(slider) => {
                    let reserve = self.model.sticking_reserve(slider);
                    bracket_sign_change(cut, overshoot, reserve, self.dt())
                }
            };
            let mut bracket = match bracket {
                ArrivalEstimate::Between(bracket) => bracket,
                ArrivalEstimate::Located(event) => return Ok(event),
            };
            loop {
                if bracket.is_at_start() {
                    return Ok(EventStep { step: None, event: Event::Slider(target) });
                }
                if tries.next().is_none() {
                    return Err(StepError::Overshoot { interval, overshoot: first, iterations: 0 });
                }
                let (duration, event, aim) = match bracket.is_converged() {
                    true => (bracket.before.0, Event::just_before(target), None),
                    false => (bracket.next_duration(), Event::Slider(target), Some(target)),
                };
                self.model.set_target(aim);
                cut = Interval::lasting(interval.start, duration);
                overshoot = match self.attempt(cut)? {
                    Ok(report) => return Ok(EventStep { step: Some((cut, report)), event }),
                    Err(overshoot) => overshoot,
                };
                if overshoot.event != target.number() {
                    break;
                }
                bracket.narrow(duration, overshoot.distance);
            }
        }
    }

    fn bracket_arrival(
        &mut self,
        interval: Interval,
        limit: MasterLimit,
        distance: f64,
    ) -> Result<ArrivalEstimate, StepError> {
        let after = (interval.duration(), distance);
        let left = self.model.distance_to(limit);
        let number = SliderEvent::Limit(limit).number();
        let is_near = self.model.leads_beyond(limit) && left <= NEAR;
        if is_near && (!self.model.is_at(limit) || self.has_impact(limit)) {
            return Ok(ArrivalEstimate::at_once(number));
        }
        if !self.model.is_at(limit) {
            return Ok(ArrivalEstimate::Between(TimeBracket::new((0.0, -left), after)));
        }
        self.halve_until_before(interval, number, after)
    }

    fn halve_until_before(
        &mut self,
        interval: Interval,
        number: usize,
        mut after: (f64, f64),
    ) -> Result<ArrivalEstimate, StepError> {
        // The search ends if the slider passes the limit by at most `NEAR`, because shorter steps would only show rounding errors.
        for halving in 1..=PROBES {
            if after.1 <= NEAR {
                break;
            }
            let duration = interval.duration() * whole_power(0.5, halving);
            let cut = Interval::lasting(interval.start, duration);
            match self.attempt(cut)? {
                Ok(report) => {
                    let event = Event::Slider(SliderEvent::of(number));
                    return Ok(ArrivalEstimate::Located(EventStep {
                        step: Some((cut, report)),
                        event,
                    }));
                }
                Err(overshoot) if overshoot.event != number => {}
                Err(Overshoot { distance, .. }) if distance < 0.0 => {
                    return Ok(ArrivalEstimate::Between(TimeBracket::new(
                        (duration, distance),
                        after,
                    )));
                }
                Err(Overshoot { distance, .. }) => after = (duration, distance),
            }
        }
        Ok(ArrivalEstimate::at_once(number))
    }

    fn bracket_landing(
        &mut self,
        interval: Interval,
        Overshoot { event, distance }: Overshoot,
        slider: usize,
    ) -> Result<ArrivalEstimate, StepError> {
        let (after, left) = ((interval.duration(), distance), self.model.relative_gap(slider));
        if left <= NEAR && self.model.approaches_axis(slider) {
            return Ok(ArrivalEstimate::at_once(event));
        }
        if left <= END_TOLERANCE {
            return self.halve_until_before(interval, event, after);
        }
        let bracket = TimeBracket::new((0.0, -left), after).with_shortest(NEAR * self.dt());
        Ok(ArrivalEstimate::Between(bracket))
    }

    fn is_held(&self, limit: MasterLimit) -> bool {
        matches!(self.model.slider_state(limit.slider), SliderState::Held(_))
    }

    /// Attempts a step. A step that misses its target event is counted but not accepted.
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

    /// Returns true if the arrival of a slider at a limit may be an impact.
    /// At a stop, an impact requires a velocity beyond the limit. Only the part of the velocity that the time steps resolve is considered.
    fn has_impact(&mut self, limit: MasterLimit) -> bool {
        let dt = self.dt();
        !self.model.end_action(limit.slider).has_stop()
            || self.model.continues_beyond(limit)
            || self.model.approaches(limit, dt).unwrap_or(true)
    }

    pub(super) fn execute(&mut self, located: &EventStep) -> Result<(), SimulationError> {
        match located.event {
            Event::JustBefore => (),
            Event::StopRelease => {
                self.model.leave_tensile_stops()?;
                self.restart_kinks()?;
            }
            Event::Slider(SliderEvent::Limit(limit)) => self.execute_arrivals(limit, located)?,
            Event::Slider(SliderEvent::SlipEnd(slider)) => self.model.end_slip(slider)?,
            Event::Slider(SliderEvent::SlipStart(slider)) => self.model.start_slip(slider),
            Event::Slider(SliderEvent::Landing(slider)) => self.model.land(slider, self.dt())?,
            Event::Slider(SliderEvent::TakeOff(slider)) => self.model.take_off(slider),
        }
        self.record_contact_changes();
        Ok(())
    }

    pub(super) fn record_contact_changes(&mut self) {
        for slider in 0..self.scene.sliders.len() {
            let Some(change) = self.model.take_contact_change(slider) else { continue };
            let (kind, impulse) = match change {
                ContactChange::TakeOff => (ArrivalKind::TookOff, Vec2::zeros()),
                ContactChange::Passage => (ArrivalKind::Passed, Vec2::zeros()),
                ContactChange::Landing => (ArrivalKind::Landed, self.model.impulse_of(slider)),
                ContactChange::Bounce => (ArrivalKind::Bounced, self.model.impulse_of(slider)),
            };
            self.progress.arrivals.push(Arrival { impulse, ..self.arrival(slider, None, kind) });
        }
    }

    fn execute_arrivals(
        &mut self,
        limit: MasterLimit,
        located: &EventStep,
    ) -> Result<(), SimulationError> {
        let dt = self.dt();
        let mut arriving = Arriving::default();
        let mut arrivals = Vec::new();
        for limit in self.model.simultaneous_arrivals(limit) {
            let strikes = self.model.leads_beyond(limit);
            let kind = match self.model.end_action(limit.slider) {
                _ if self.model.continues_beyond(limit) => {
                    if located.step.is_some() && !strikes {
                        continue;
                    }
                    let (group, kind) = match self.is_held_at_seam(limit, located, dt) {
                        true => (&mut arriving.held, ArrivalKind::Held),
                        false => (&mut arriving.crossing, ArrivalKind::Passed),
                    };
                    group.push(limit);
                    kind
                }
                EndAction::Stop => ArrivalKind::Stopped,
                EndAction::Release => {
                    self.model.release_slider(limit.slider);
                    ArrivalKind::Released
                }
                _ if located.step.is_some() && !strikes && !self.model.approaches(limit, dt)? => {
                    ArrivalKind::Bounced
                }
                _ if self.stays_held(limit, located, dt)? => {
                    arriving.held.push(limit);
                    ArrivalKind::Held
                }
                _ if self.model.restitution(limit.slider) == 0.0 => {
                    arriving.plastic.push(limit);
                    ArrivalKind::Held
                }
                EndAction::Bounce | EndAction::Contact => {
                    arriving.strike.push(limit);
                    ArrivalKind::Bounced
                }
            };
            arrivals.push(self.arrival(limit.slider, Some(limit.end), kind));
        }
        if !arriving.is_empty() {
            self.model.solve_impact(&arriving, dt)?;
            for arrival in &mut arrivals {
                arrival.impulse = self.model.impulse_of(arrival.slider);
            }
            self.restart_kinks()?;
        }
        self.record_contact_changes();
        // The arrival that ends the run must be the last entry of the list of arrivals.
        arrivals.sort_by_key(|arrival| arrival.kind == ArrivalKind::Stopped);
        self.progress.arrivals.extend(arrivals);
        Ok(())
    }

    /// Initialises the kinks under sliders at ends of their masters. The present contact forces determine the jumps of the tangents.
    /// If the previous arrival at an end was less than a step ago, the kinks start without load,
    /// because contact forces between two arrivals within a step contain vibrations that the steps do not resolve.
    fn restart_kinks(&mut self) -> Result<(), SimulationError> {
        let last = self.progress.arrivals.iter().rev().find(|arrival| arrival.end.is_some());
        if last.is_some_and(|last| self.time() - last.time < self.dt() - self.slack()) {
            return Ok(());
        }
        Ok(self.model.restart_kinks_at_ends()?)
    }

    /// Returns true if a stop holds a slider at a limit instead of letting it bounce.
    /// The stop holds the slider after repeated impacts within few steps, and if the steps resolve the elastic contact with the stop.
    /// A slider that is at the limit when the step starts is held if its velocity does not point beyond the limit.
    fn stays_held(
        &mut self,
        limit: MasterLimit,
        located: &EventStep,
        dt: f64,
    ) -> Result<bool, SimulationError> {
        let is_contact = self.model.end_action(limit.slider) == EndAction::Contact;
        if self.chatters(limit, dt) || (is_contact && self.model.resolves_impact(limit, dt)?) {
            return Ok(true);
        }
        Ok(located.step.is_none() && !self.model.approaches(limit, dt)?)
    }

    /// Returns true if a slider is held at a seam instead of passing the seam.
    /// A slider is held if both sides of the seam immediately return it to the seam, or if the slider oscillates about the seam within few steps.
    fn is_held_at_seam(&self, limit: MasterLimit, located: &EventStep, dt: f64) -> bool {
        let is_led_back = located.step.is_none() && self.model.is_at_seam_event(limit.slider);
        is_led_back || self.oscillates_at_seam(limit, dt)
    }

    /// Period [time] in which repeated impacts or oscillations count as not resolved by steps of length `dt` [time].
    /// Variable steps become longer between impacts. The shortest time in which a wave passes a span therefore replaces a longer `dt`.
    fn unresolved(&self, dt: f64) -> f64 {
        CHATTER as f64
            * match self.settings.dt {
                StepSize::Fixed(_) => dt,
                StepSize::Adaptive(_) => {
                    shortest_wave_time(&self.scene).map_or(dt, |shortest| dt.min(shortest))
                }
            }
    }

    /// Returns true if a slider has passed a seam several times within as many steps, so that the steps do not resolve its motion.
    fn oscillates_at_seam(&self, limit: MasterLimit, dt: f64) -> bool {
        let since = self.time() - self.unresolved(dt);
        let own = self.progress.arrivals.iter().rev();
        let own = own.filter(|arrival| arrival.slider == limit.slider && arrival.end.is_some());
        let passed =
            own.take_while(|arrival| arrival.kind == ArrivalKind::Passed && arrival.time >= since);
        let place = |arrival: &Arrival| (arrival.end, arrival.beam);
        let places: Vec<_> = passed.map(place).take(2 * CHATTER).collect();
        let here = (Some(limit.end), Some(self.model.slider_beam(limit.slider)));
        let alternates =
            |pair: &[(Option<MasterEnd>, Option<usize>)]| pair[0] != here && pair[1] == here;
        let back =
            |pair: &[(Option<MasterEnd>, Option<usize>)]| pair[0] == places[0] && alternates(pair);
        places.len() == 2 * CHATTER && places.chunks_exact(2).all(back)
    }

    fn arrival(&self, slider: usize, end: Option<MasterEnd>, kind: ArrivalKind) -> Arrival {
        let is_on_track = self.scene.sliders[slider].track.is_some();
        let beam = is_on_track.then(|| self.model.slider_beam(slider));
        Arrival { time: self.model.time(), slider, end, beam, kind, impulse: Vec2::zeros() }
    }

    /// Returns true if a slider has struck an end several times within as many steps, so that the steps do not resolve its impacts.
    fn chatters(&self, limit: MasterLimit, dt: f64) -> bool {
        let own = self.progress.arrivals.iter().rev();
        let mut last = own.filter(|arrival| arrival.slider == limit.slider).take(CHATTER);
        let since = self.time() - self.unresolved(dt);
        let again = |arrival: &Arrival| arrival.end == Some(limit.end) && arrival.time >= since;
        last.by_ref().take_while(|arrival| again(arrival)).count() == CHATTER
    }

    pub(super) fn dry_run_arrivals(&mut self) {
        let arrival = |slider: usize| {
            let kind = match self.model.end_action(slider) {
                _ if self.scene.is_on_closed_track(slider) => ArrivalKind::Passed,
                EndAction::Stop => ArrivalKind::Stopped,
                EndAction::Bounce | EndAction::Contact => ArrivalKind::Bounced,
                EndAction::Release => ArrivalKind::Released,
            };
            self.arrival(slider, Some(MasterEnd::End), kind)
        };
        let mut arrivals: Vec<Arrival> = (0..self.scene.sliders.len()).map(arrival).collect();
        arrivals.sort_by_key(|arrival| arrival.kind == ArrivalKind::Stopped);
        self.progress.arrivals = arrivals;
    }

    /// Arrivals of sliders at the ends of their masters, take-offs and landings so far.
    pub fn arrivals(&self) -> &[Arrival] {
        &self.progress.arrivals
    }

    /// Returns true if the run has ended because a slider with [`EndAction::Stop`] arrived at an end of its master.
    pub fn has_ended(&self) -> bool {
        self.progress.stopped().is_some()
    }

    /// Description of the arrival that has ended the run; `None` if no arrival has ended the run.
    pub fn ending(&self) -> Option<String> {
        self.progress.stopped().map(|stopped| self.describe(stopped))
    }

    pub(super) fn describe(&self, arrival: &Arrival) -> String {
        let beam = arrival.beam.map(|beam| self.scene.beams[beam].name.as_str());
        arrival.describe(&self.scene.sliders[arrival.slider].name, beam)
    }

    /// Present state of a slider.
    pub fn slider_state(&self, slider: usize) -> SliderState {
        self.model.slider_state(slider)
    }
}
