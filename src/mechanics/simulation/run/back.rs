//! Return to earlier states, and copies of simulations.

use std::rc::Rc;

use super::Simulation;
use crate::simulation::clock::StepClock;
use crate::simulation::snapshots::Snapshot;
use crate::simulation::{SimulationError, WorkCounts};
use crate::system::SystemState;

impl Simulation {
    /// Enables a snapshot after every step, within a memory limit [bytes].
    /// Above the memory limit, the oldest snapshots are discarded, except the first one. A limit of zero disables snapshots.
    pub fn enable_snapshots(&mut self, limit: usize) {
        let mut snapshots = std::mem::take(&mut self.snapshots);
        snapshots.set_limit(limit, || self.snapshot(self.model.state()));
        self.snapshots = snapshots;
    }

    /// Memory limit of snapshots [bytes]; zero if snapshots are disabled.
    pub fn snapshot_limit(&self) -> usize {
        self.snapshots.limit()
    }

    /// Number of snapshots, and the memory that they use [bytes].
    pub fn stored_snapshots(&self) -> (usize, usize) {
        (self.snapshots.count(), self.snapshots.bytes())
    }

    /// Returns to the state `steps` steps earlier, bit for bit. With error control, two half steps count as one step.
    /// Additional end times of steps, which the caller has requested, are not removed.
    ///
    /// # Errors
    /// Fails if fewer steps have been taken, or if the earlier state is not stored.
    pub fn back(&mut self, steps: usize) -> Result<(), SimulationError> {
        let taken = self.progress.counts.steps;
        match taken.checked_sub(steps) {
            Some(rest) => self.restore_step(rest),
            None => Err(SimulationError::TooFewSteps { steps, steps_taken: taken }),
        }
    }

    /// Returns to the end of the last step at or before a time, bit for bit. This state may be the present state.
    ///
    /// # Errors
    /// Fails if the time is outside the run, or if the state at this time is not stored.
    pub fn rewind(&mut self, time: f64) -> Result<(), SimulationError> {
        let (now, slack) = (self.time(), self.slack());
        let begun = self.history().samples().first().map_or(0.0, |row| row.measures.time);
        // A time of zero means the start of the run, even if the run started at a later time.
        let time = if time.abs() <= slack { begun } else { time };
        if time.is_nan() || time < begun - slack || time > now + slack {
            return Err(SimulationError::OutsideRun { time, start: begun, now });
        }
        if time >= now - slack {
            return Ok(());
        }
        match self.steps_until(time + slack) {
            Some(steps) => self.restore_step(steps),
            None => {
                let first = self.snapshots.first();
                let is_earlier = first.is_some_and(|first| time < first.time);
                let steps = if is_earlier { 0 } else { self.progress.counts.steps };
                Err(self.missing_snapshot_error(format!("t = {time}"), steps))
            }
        }
    }

    fn steps_until(&self, time: f64) -> Option<usize> {
        if self.has_all_rows() {
            let rows = self.record.history.samples();
            return rows.partition_point(|row| row.measures.time <= time).checked_sub(1);
        }
        Some(self.snapshots.last_until(time, self.progress.counts.steps)?.steps())
    }

    /// Returns to the state a number of steps earlier, in a dry run.
    pub fn dry_run_back(&mut self, steps: usize) {
        self.dry_run_back_to(self.progress.counts.steps.saturating_sub(steps));
    }

    /// Returns to the state at a time, in a dry run.
    pub fn dry_run_rewind(&mut self, time: f64) {
        self.dry_run_back_to(self.steps_until(time + self.slack()).unwrap_or(0));
    }

    fn dry_run_back_to(&mut self, steps: usize) {
        let Some(first) = self.snapshots.first().map(Snapshot::steps) else { return };
        if self.restore_step(steps.max(first)).is_err() {
            // The restoration of the first snapshot cannot fail, because the first snapshot is always kept.
            let _: Result<(), SimulationError> = self.restore_step(first);
        }
    }

    fn restore_step(&mut self, steps: usize) -> Result<(), SimulationError> {
        let back = self.progress.counts.steps - steps;
        if back == 0 {
            return Ok(());
        }
        let snapshots = std::mem::take(&mut self.snapshots);
        let found = snapshots.find(steps).map(|snapshot| self.restore_snapshot(snapshot));
        self.snapshots = snapshots;
        let Some(stood) = found else {
            let target = match self.has_all_rows() {
                true => format!(
                    "t = {}",
                    crate::system::rounded(self.record.history.samples()[steps].measures.time)
                ),
                false => format!("the state {back} steps ago"),
            };
            return Err(self.missing_snapshot_error(target, steps));
        };
        stood?;
        self.snapshots.truncate(steps);
        self.show_present();
        Ok(())
    }

    pub(super) fn restore_snapshot(&mut self, snapshot: &Snapshot) -> Result<(), SimulationError> {
        self.end_derivatives("going back");
        self.restore_releases(&snapshot.releases)?;
        self.model.restore(&snapshot.state);
        self.clock.grid.restore(snapshot.passed);
        self.progress.last_step = snapshot.last_step;
        self.record.truncate(snapshot.rows);
        self.progress.arrivals.truncate(snapshot.arrivals);
        self.progress.counts = WorkCounts { wall: self.progress.counts.wall, ..snapshot.counts };
        self.clock.retry = snapshot.retry;
        self.clock.step_size = snapshot.step_size;
        Ok(())
    }

    fn missing_snapshot_error(&self, target: String, steps: usize) -> SimulationError {
        let now = self.progress.counts.steps;
        let kept = self.snapshots.first().zip(self.snapshots.unbroken_from(now));
        let time = |steps: usize| self.snapshots.find(steps).map_or(self.time(), |of| of.time);
        match kept {
            Some((first, _)) if steps < first.steps() => {
                SimulationError::BeforeFirst { target, first: first.time }
            }
            Some((first, from)) => SimulationError::NoSnapshot {
                target,
                steps: now - from,
                oldest: time(from),
                first: first.time,
                limit: self.snapshots.limit() as f64 / 1e6,
            },
            None => SimulationError::NoSnapshots { limit: self.snapshots.limit() as f64 / 1e6 },
        }
    }

    pub(super) fn store_snapshot(&mut self) {
        let Some(blank) = self.snapshots.blank() else { return };
        self.clock.grid.mark_reached(self.time());
        let snapshot = self.snapshot(blank);
        self.snapshots.push(snapshot);
    }

    pub(super) fn snapshot(&self, mut state: SystemState) -> Snapshot {
        self.model.write_state(&mut state);
        Snapshot {
            state,
            time: self.time(),
            rows: self.record.permanent_rows,
            last_step: self.progress.last_step,
            arrivals: self.progress.arrivals.len(),
            releases: Rc::clone(&self.progress.releases),
            counts: self.progress.counts,
            passed: self.clock.grid.passed(),
            retry: self.clock.retry,
            step_size: self.clock.step_size,
        }
    }

    /// Returns an independent copy of the simulation.
    ///
    /// # Errors
    /// Fails if the scene cannot be built again, although it was built before.
    pub fn fork(&self) -> Result<Self, SimulationError> {
        let mut fork = self.fork_without_snapshots()?;
        fork.snapshots = self.snapshots.clone();
        Ok(fork)
    }

    pub(super) fn fork_without_snapshots(&self) -> Result<Self, SimulationError> {
        let mut fork = Self::start(self.scene.clone(), self.settings)?;
        fork.restore_releases(&self.progress.releases)?;
        fork.model.restore(&self.model.state());
        fork.clock = StepClock { goal: f64::INFINITY, ..self.clock.clone() };
        fork.progress = self.progress.clone();
        fork.record = self.record.clone();
        Ok(fork)
    }
}
