//! Content of a stored simulation.

use std::borrow::Cow;
use std::rc::Rc;

use serde::{Deserialize, Serialize};

use super::Simulation;
use crate::newton::Tolerance;
use crate::simulation::archive::{ArchiveError, unwrap, wrap};
use crate::simulation::controller::StepSizeState;
use crate::simulation::progress::StepTaken;
use crate::simulation::step_retry::StepRetry;
use crate::simulation::{Arrival, Recording, ReleaseEvent, Sample, SimulationSettings, WorkCounts};
use crate::system::{Scene, SystemState, check_name};

/// Largest plausible value of a counter or grid index.
const MOST_COUNTED: u64 = 1 << 52;

/// Largest number of Newton iterations that is accepted in settings.
const MOST_ITERATIONS: usize = 10_000;

#[derive(Serialize, Deserialize)]
struct Content<'a> {
    name: Cow<'a, str>,
    scene: Cow<'a, Scene>,
    settings: SimulationSettings,
    state: SystemState,
    recording: Recording,
    samples: Cow<'a, [Sample]>,
    permanent_rows: usize,
    extra: Cow<'a, [f64]>,
    every: usize,
    times: Cow<'a, [f64]>,
    numbers: Cow<'a, [f64]>,
    arrivals: Cow<'a, [Arrival]>,
    releases: Cow<'a, [ReleaseEvent]>,
    counts: WorkCounts,
    cuts: Cow<'a, [f64]>,
    retry: Option<((f64, f64), u64, u32, usize)>,
    step_size: Option<StepSizeState>,
}

fn refused(reason: &str) -> ArchiveError {
    ArchiveError::Content { reason: reason.to_owned() }
}

impl Simulation {
    /// Serialises the simulation and its name for [`from_bytes`](Self::from_bytes). Snapshots are not included.
    ///
    /// # Errors
    /// Fails if a schedule is a script function, or if a sensor cannot be created from its name.
    /// Also fails if the caller still has to trigger a release.
    pub fn to_bytes(&self, name: &str) -> Result<Vec<u8>, ArchiveError> {
        let mut schedules = self.scene.schedules();
        if let Some((load, schedule)) = schedules.find(|(_, schedule)| !schedule.can_be_stored()) {
            let load = self.scene.source_of_schedule(load);
            return Err(ArchiveError::Function { load, function: schedule.describe() });
        }
        if let Some(sensor) = self.scene.sensors.iter().find(|sensor| !sensor.can_be_stored()) {
            return Err(ArchiveError::Sensor { column: sensor.name.clone() });
        }
        let waiting = (0..self.scene.releases.len()).find(|at| self.waits_for_release(*at));
        if let Some(release) = waiting {
            let name = self.scene.releasable_name(self.scene.releases[release].object);
            return Err(ArchiveError::Release { name });
        }
        let content = Content {
            name: name.into(),
            scene: Cow::Borrowed(&self.scene),
            settings: self.settings,
            state: self.model.state(),
            recording: self.record.recording,
            samples: self.record.history.samples().into(),
            permanent_rows: self.record.permanent_rows,
            extra: self.record.history.extra_values().into(),
            every: self.record.trajectory.every(),
            times: self.record.trajectory.times().into(),
            numbers: self.record.trajectory.numbers().into(),
            arrivals: self.progress.arrivals.as_slice().into(),
            releases: self.releases().into(),
            counts: self.progress.counts,
            cuts: self.clock.grid.cuts().into(),
            retry: self.clock.retry.map(StepRetry::to_parts),
            step_size: self.clock.step_size,
        };
        let bytes = postcard::to_stdvec(&content).map_err(|error| refused(&error.to_string()))?;
        Ok(wrap(&bytes))
    }

    /// Restores a simulation and its name from the result of [`to_bytes`](Self::to_bytes).
    ///
    /// # Errors
    /// Fails if the file is truncated or damaged, has another format version or a different type, or has invalid content.
    pub fn from_bytes(file: &[u8]) -> Result<(String, Self), ArchiveError> {
        let bytes = unwrap(file)?;
        let read = postcard::take_from_bytes::<Content>(bytes);
        let (content, rest) = read.map_err(|error| refused(&error.to_string()))?;
        if !rest.is_empty() {
            return Err(refused("there are bytes after its end"));
        }
        content.check()?;
        content.into_simulation()
    }
}

impl Content<'_> {
    fn check(&self) -> Result<(), ArchiveError> {
        check_name("simulation", &self.name).map_err(|error| refused(&error.to_string()))?;
        let Tolerance { force, strain, constraint, polish, iterations } = self.settings.tolerance;
        let are_tolerances = [force, strain, constraint, polish].iter().all(|x| *x >= 0.0);
        if !are_tolerances || iterations > MOST_ITERATIONS {
            return Err(refused("the tolerances of its solver are out of range"));
        }
        let counts = &self.counts;
        let numbers = [
            counts.steps,
            counts.newton_iterations,
            counts.corrections,
            counts.newton_max,
            counts.factorisations,
            counts.retries,
            counts.rejected,
            counts.arrival_tries,
        ];
        let is_counted = numbers.iter().all(|number| (*number as u64) < MOST_COUNTED);
        let rows = self.samples.len();
        let has_rows = self.permanent_rows >= 1
            && (self.permanent_rows..=self.permanent_rows + 1).contains(&rows);
        if !is_counted || !has_rows || rows > counts.steps + 1 {
            return Err(refused("the number of steps does not match the number of history rows"));
        }
        let times = || self.samples.iter().map(|row| row.measures.time);
        let is_ordered = times().all(f64::is_finite) && times().is_sorted();
        if !is_ordered || times().next().is_some_and(|first| first < 0.0) {
            return Err(refused("the times of its history are out of order"));
        }
        let is_arrival = |arrival: &Arrival| {
            let is_known = arrival.beam.is_none_or(|beam| beam < self.scene.beams.len());
            let numbers = [arrival.time, arrival.impulse.x, arrival.impulse.y];
            is_known
                && arrival.slider < self.scene.sliders.len()
                && numbers.iter().all(|number| number.is_finite())
        };
        if !self.arrivals.iter().all(is_arrival) {
            return Err(refused("an arrival refers to a slider that does not exist"));
        }
        let is_release = |(at, gone): (usize, &ReleaseEvent)| {
            let earlier = &self.releases[..at];
            gone.release < self.scene.releases.len()
                && gone.time.is_finite()
                && earlier.iter().all(|other| other.release != gone.release)
        };
        if !self.releases.iter().enumerate().all(is_release) {
            return Err(refused("a release refers to an object that does not exist"));
        }
        Ok(())
    }

    fn into_simulation(self) -> Result<(String, Simulation), ArchiveError> {
        let mut simulation = Simulation::start(self.scene.into_owned(), self.settings)?;
        simulation.restore_releases(&Rc::from(&*self.releases))?;
        let restored = simulation.model.restore_checked(&self.state);
        restored.map_err(|error| refused(&error.to_string()))?;
        let now = simulation.time();
        let last = self.samples.last().map(|row| row.measures.time);
        if last != Some(now) || now / simulation.clock.grid.dt() >= MOST_COUNTED as f64 {
            return Err(refused("its time differs from that of the last history row"));
        }
        let rows = self.samples.len();
        simulation.progress.last_step = self.samples.last().map(StepTaken::of).unwrap_or_default();
        let (samples, extra) = (self.samples.into_owned(), self.extra.into_owned());
        let history = simulation.record.history.with_rows(samples, extra);
        simulation.record.history =
            history.ok_or_else(|| refused("history rows are incomplete"))?;
        let (times, numbers) = (self.times.into_owned(), self.numbers.into_owned());
        let kept =
            simulation.record.trajectory.with_configurations(rows, self.every, times, numbers);
        simulation.record.trajectory =
            kept.ok_or_else(|| refused("its trajectory is incomplete"))?;
        simulation.clock.retry = match self.retry {
            None => None,
            Some(parts) => {
                let halving = StepRetry::from_parts(now, parts);
                Some(
                    halving
                        .ok_or_else(|| refused("the data of the step in progress are invalid"))?,
                )
            }
        };
        let bounds = simulation.adaptive.as_ref().map(|adaptive| adaptive.controller);
        if self.step_size.is_some() != bounds.is_some()
            || bounds.zip(self.step_size).is_some_and(|(bounds, state)| !bounds.allows(&state))
        {
            return Err(refused("the size of its next step is invalid"));
        }
        simulation.clock.step_size = self.step_size;
        simulation.clock.grid.lay(&self.cuts, now);
        simulation.progress.arrivals = self.arrivals.into_owned();
        simulation.progress.counts = self.counts;
        (simulation.record.recording, simulation.record.permanent_rows) =
            (self.recording, self.permanent_rows);
        Ok((self.name.into_owned(), simulation))
    }
}
