//! Going back to states that were, and copies that go their own way.

use super::snapshots::Snapshot;
use super::{Simulation, SimulationError, WorkCounts};
use crate::model::ModelState;

impl Simulation {
    /// Keeps the state after every step from here on, as long as all of them fit into so many bytes; then the oldest but the
    /// first are forgotten. Zero keeps none, and costs nothing. A smaller limit than before forgets at once.
    pub fn keep_snapshots(&mut self, limit: usize) {
        let mut snapshots = std::mem::take(&mut self.snapshots);
        snapshots.set_limit(limit, || self.snapshot(self.model.state()));
        self.snapshots = snapshots;
    }

    /// The memory that snapshots may take [bytes]; zero when none are kept.
    pub fn snapshot_limit(&self) -> usize {
        self.snapshots.limit()
    }

    /// How many snapshots are kept, and the memory that they take [bytes].
    pub fn snapshots_kept(&self) -> (usize, usize) {
        (self.snapshots.count(), self.snapshots.bytes())
    }

    /// Goes back so many steps, bit for bit. Halves of steps count as steps, as they do in the history; cuts of the time grid
    /// stay.
    ///
    /// # Errors
    /// When fewer steps were taken, or the state there is not kept.
    pub fn back(&mut self, steps: usize) -> Result<(), SimulationError> {
        let (rows, taken) = (self.history.samples().len(), self.counts.steps);
        match rows.checked_sub(steps) {
            Some(rows) if rows > 0 => self.go_back_to(rows),
            _ => Err(SimulationError::FewerSteps { steps, taken }),
        }
    }

    /// Goes back to the end of the last step at or before a time, bit for bit; the present is such an end too.
    ///
    /// # Errors
    /// When the time is before the start or to come, or the state there is not kept.
    pub fn rewind(&mut self, time: f64) -> Result<(), SimulationError> {
        let (now, slack) = (self.time(), self.grid.slack());
        let samples = self.history.samples();
        let rows = samples.partition_point(|row| row.measures.time <= time + slack);
        if rows == 0 || time.is_nan() || time > now + slack {
            return Err(SimulationError::NotBehind { time, now });
        }
        self.go_back_to(rows)
    }

    /// For checking scripts: goes back as [`back`](Self::back) does, or as near as a pretended run allows.
    pub fn pretend_back(&mut self, steps: usize) {
        let rows = self.history.samples().len().saturating_sub(steps);
        self.pretend_back_to(rows);
    }

    /// For checking scripts: goes back as [`rewind`](Self::rewind) does, or as near as a pretended run allows.
    pub fn pretend_rewind(&mut self, time: f64) {
        let samples = self.history.samples();
        let slack = self.grid.slack();
        let rows = samples.partition_point(|row| row.measures.time <= time + slack);
        self.pretend_back_to(rows);
    }

    fn pretend_back_to(&mut self, rows: usize) {
        let Some(first) = self.snapshots.first().map(|first| first.rows) else { return };
        if self.go_back_to(rows.max(first)).is_err() {
            // The first is always kept.
            let _: Result<(), SimulationError> = self.go_back_to(first);
        }
    }

    fn go_back_to(&mut self, rows: usize) -> Result<(), SimulationError> {
        if rows == self.history.samples().len() {
            return Ok(());
        }
        let Some(snapshot) = self.snapshots.find(rows) else { return Err(self.forgotten(rows)) };
        self.model.restore(&snapshot.state);
        self.grid.go_back(snapshot.passed);
        self.history.truncate(snapshot.rows);
        self.trajectory.go_back(snapshot.rows);
        self.arrivals.truncate(snapshot.arrivals);
        self.counts = WorkCounts { wall: self.counts.wall, ..snapshot.counts };
        self.under_way = snapshot.under_way;
        self.pace = snapshot.pace;
        self.snapshots.truncate(rows);
        Ok(())
    }

    /// The error of a state that is not kept.
    fn forgotten(&self, rows: usize) -> SimulationError {
        let now = self.history.samples().len();
        let time = |rows: usize| self.history.samples()[rows - 1].measures.time;
        let kept = self.snapshots.first().zip(self.snapshots.unbroken_from(now));
        match kept {
            Some((first, _)) if rows < first.rows => {
                SimulationError::BeforeFirst { time: time(rows), first: time(first.rows) }
            }
            Some((first, from)) => SimulationError::Forgotten {
                time: time(rows),
                steps: now - from,
                oldest: time(from),
                first: time(first.rows),
                limit: self.snapshots.limit() as f64 / 1e6,
            },
            None => SimulationError::NoSnapshots { limit: self.snapshots.limit() as f64 / 1e6 },
        }
    }

    /// Keeps the present state, if snapshots are kept.
    pub(super) fn remember(&mut self) {
        let Some(blank) = self.snapshots.blank() else { return };
        self.grid.reach(self.time());
        let snapshot = self.snapshot(blank);
        self.snapshots.push(snapshot);
    }

    /// The present, written into a state that may have held another.
    fn snapshot(&self, mut state: ModelState) -> Snapshot {
        self.model.write_state(&mut state);
        Snapshot {
            state,
            rows: self.history.samples().len(),
            arrivals: self.arrivals.len(),
            counts: self.counts,
            passed: self.grid.passed(),
            under_way: self.under_way,
            pace: self.pace,
        }
    }

    /// A copy that has been through the same and goes its own way from here.
    ///
    /// # Errors
    /// When the scene cannot be built, which it could before.
    pub fn fork(&self) -> Result<Self, SimulationError> {
        let mut fork = Self::start(self.scene.clone(), self.settings)?;
        fork.model.restore(&self.model.state());
        fork.grid = self.grid.clone();
        fork.history = self.history.clone();
        fork.trajectory = self.trajectory.clone();
        fork.counts = self.counts;
        fork.arrivals = self.arrivals.clone();
        fork.under_way = self.under_way;
        fork.pace = self.pace;
        fork.snapshots = self.snapshots.clone();
        Ok(fork)
    }
}
