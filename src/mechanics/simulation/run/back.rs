//! Going back to states that were, and copies that go their own way.

use std::rc::Rc;

use super::Simulation;
use crate::simulation::clock::StepClock;
use crate::simulation::snapshots::Snapshot;
use crate::simulation::{SimulationError, WorkCounts};
use crate::system::SystemState;

impl Simulation {
    /// Keeps the state of the simulation after every step from here on, as long as all of them fit into `limit` bytes; then the oldest but
    /// the first are forgotten. Zero keeps none, and costs nothing. A smaller limit than before forgets at once.
    pub fn keep_snapshots(&mut self, limit: usize) {
        let mut snapshots = std::mem::take(&mut self.snapshots);
        snapshots.set_limit(limit, || self.snapshot(self.model.state()));
        self.snapshots = snapshots;
    }

    /// The memory that snapshots may take [bytes]; zero when none are kept.
    pub fn snapshot_limit(&self) -> usize {
        self.snapshots.limit()
    }

    /// The number of snapshots that are kept, and the memory that they take [bytes].
    pub fn snapshots_kept(&self) -> (usize, usize) {
        (self.snapshots.count(), self.snapshots.bytes())
    }

    /// Takes the simulation back so many steps, bit for bit. Halves of steps count as steps, as they do in the history; cuts of the time grid
    /// stay.
    ///
    /// # Errors
    /// When fewer steps were taken, or the state there is not kept.
    pub fn back(&mut self, steps: usize) -> Result<(), SimulationError> {
        let taken = self.progress.counts.steps;
        match taken.checked_sub(steps) {
            Some(rest) => self.go_back_to(rest),
            None => Err(SimulationError::FewerSteps { steps, taken }),
        }
    }

    /// Takes the simulation back to the end of the last step at or before a time, bit for bit; the present is such an end too.
    ///
    /// # Errors
    /// When the time is before the start or to come, or the state there is not kept.
    pub fn rewind(&mut self, time: f64) -> Result<(), SimulationError> {
        let (now, slack) = (self.time(), self.slack());
        let begun = self.history().samples().first().map_or(0.0, |row| row.measures.time);
        // Zero stands for the start, which may be later.
        let time = if time.abs() <= slack { begun } else { time };
        if time.is_nan() || time < begun - slack || time > now + slack {
            return Err(SimulationError::NotBehind { time, begun, now });
        }
        if time >= now - slack {
            return Ok(());
        }
        match self.steps_until(time + slack) {
            Some(steps) => self.go_back_to(steps),
            None => {
                let first = self.snapshots.first();
                let is_earlier = first.is_some_and(|first| time < first.time);
                let steps = if is_earlier { 0 } else { self.progress.counts.steps };
                Err(self.forgotten(format!("t = {time}"), steps))
            }
        }
    }

    /// How many steps ended at or before a time, as far as history or snapshots know.
    fn steps_until(&self, time: f64) -> Option<usize> {
        if self.has_all_rows() {
            let rows = self.record.history.samples();
            return rows.partition_point(|row| row.measures.time <= time).checked_sub(1);
        }
        Some(self.snapshots.last_until(time, self.progress.counts.steps)?.steps())
    }

    /// Goes back so many steps, for checking scripts: as [`back`](Self::back) does, or as near as a pretended run allows.
    pub fn pretend_back(&mut self, steps: usize) {
        self.pretend_back_to(self.progress.counts.steps.saturating_sub(steps));
    }

    /// Goes back to a time, for checking scripts: as [`rewind`](Self::rewind) does, or as near as a pretended run allows.
    pub fn pretend_rewind(&mut self, time: f64) {
        self.pretend_back_to(self.steps_until(time + self.slack()).unwrap_or(0));
    }

    fn pretend_back_to(&mut self, steps: usize) {
        let Some(first) = self.snapshots.first().map(Snapshot::steps) else { return };
        if self.go_back_to(steps.max(first)).is_err() {
            // The first is always kept.
            let _: Result<(), SimulationError> = self.go_back_to(first);
        }
    }

    fn go_back_to(&mut self, steps: usize) -> Result<(), SimulationError> {
        let back = self.progress.counts.steps - steps;
        if back == 0 {
            return Ok(());
        }
        let snapshots = std::mem::take(&mut self.snapshots);
        let found = snapshots.find(steps).map(|snapshot| self.stand_at(snapshot));
        self.snapshots = snapshots;
        let Some(stood) = found else {
            let target = match self.has_all_rows() {
                true => format!("t = {}", self.record.history.samples()[steps].measures.time),
                false => format!("where it was {back} steps ago"),
            };
            return Err(self.forgotten(target, steps));
        };
        stood?;
        self.snapshots.truncate(steps);
        self.show_present();
        Ok(())
    }

    /// Takes a state that the simulation has been in, or a copy of it has; rows of the history that came later are gone.
    ///
    /// # Errors
    /// When the scene cannot be built, which it could before.
    pub(super) fn stand_at(&mut self, snapshot: &Snapshot) -> Result<(), SimulationError> {
        self.leave_derivatives("going back");
        self.stand_released(&snapshot.let_go)?;
        self.model.restore(&snapshot.state);
        self.clock.grid.go_back(snapshot.passed);
        self.progress.last_step = snapshot.last_step;
        self.record.go_back(snapshot.rows);
        self.progress.arrivals.truncate(snapshot.arrivals);
        self.progress.counts = WorkCounts { wall: self.progress.counts.wall, ..snapshot.counts };
        self.clock.under_way = snapshot.under_way;
        self.clock.pace = snapshot.pace;
        Ok(())
    }

    /// The error of a state that is not kept: in words, and the fewest steps that may have led there.
    fn forgotten(&self, target: String, steps: usize) -> SimulationError {
        let now = self.progress.counts.steps;
        let kept = self.snapshots.first().zip(self.snapshots.unbroken_from(now));
        let time = |steps: usize| self.snapshots.find(steps).map_or(self.time(), |of| of.time);
        match kept {
            Some((first, _)) if steps < first.steps() => {
                SimulationError::BeforeFirst { target, first: first.time }
            }
            Some((first, from)) => SimulationError::Forgotten {
                target,
                steps: now - from,
                oldest: time(from),
                first: first.time,
                limit: self.snapshots.limit() as f64 / 1e6,
            },
            None => SimulationError::NoSnapshots { limit: self.snapshots.limit() as f64 / 1e6 },
        }
    }

    /// Keeps the present state of the simulation, if snapshots are kept.
    pub(super) fn remember(&mut self) {
        let Some(blank) = self.snapshots.blank() else { return };
        self.clock.grid.reach(self.time());
        let snapshot = self.snapshot(blank);
        self.snapshots.push(snapshot);
    }

    /// A snapshot of the present, written into a state that may have held another.
    pub(super) fn snapshot(&self, mut state: SystemState) -> Snapshot {
        self.model.write_state(&mut state);
        Snapshot {
            state,
            time: self.time(),
            rows: self.record.rows_kept,
            last_step: self.progress.last_step,
            arrivals: self.progress.arrivals.len(),
            let_go: Rc::clone(&self.progress.let_go),
            counts: self.progress.counts,
            passed: self.clock.grid.passed(),
            under_way: self.clock.under_way,
            pace: self.clock.pace,
        }
    }

    /// A copy of the simulation that has been through the same and goes its own way from here.
    ///
    /// # Errors
    /// When the scene cannot be built, which it could before.
    pub fn fork(&self) -> Result<Self, SimulationError> {
        let mut fork = self.fork_without_snapshots()?;
        fork.snapshots = self.snapshots.clone();
        Ok(fork)
    }

    /// A copy of the simulation that has been through the same and goes its own way from here, without states to go back to.
    ///
    /// # Errors
    /// When the scene cannot be built, which it could before.
    pub(super) fn fork_without_snapshots(&self) -> Result<Self, SimulationError> {
        let mut fork = Self::start(self.scene.clone(), self.settings)?;
        fork.stand_released(&self.progress.let_go)?;
        fork.model.restore(&self.model.state());
        fork.clock = StepClock { goal: f64::INFINITY, ..self.clock.clone() };
        fork.progress = self.progress.clone();
        fork.record = self.record.clone();
        Ok(fork)
    }
}
