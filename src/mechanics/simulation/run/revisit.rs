//! Access to earlier states in a copy of the run. The copy restores the state from a snapshot or computes it again.

use super::Simulation;
use crate::simulation::{Monitor, SimulationError};

struct PauseTime<'m> {
    time: f64,
    monitor: &'m mut dyn Monitor,
}

impl Monitor for PauseTime<'_> {
    fn continues(&mut self, time: f64) -> bool {
        self.monitor.continues(time) && time < self.time
    }
}

impl Simulation {
    /// Step numbers and times of the stored states, from the step after the last missing state to the present step.
    pub fn stored_states(&self) -> Vec<(usize, f64)> {
        let steps = self.progress.counts.steps;
        let from = self.snapshots.unbroken_from(steps).unwrap_or(steps);
        let kept = self.snapshots.places().filter(|(place, _)| (from..steps).contains(place));
        kept.chain([(steps, self.time())]).collect()
    }

    /// Restores in this copy the state of the original simulation `of` after `steps` steps. Returns false if the state is not stored.
    ///
    /// # Errors
    /// Fails if the scene cannot be built again, although it was built before.
    pub fn revisit(&mut self, of: &Self, steps: usize) -> Result<bool, SimulationError> {
        if steps == self.progress.counts.steps {
            return Ok(true);
        }
        let found = of.snapshots.find(steps).filter(|_| steps < self.progress.counts.steps);
        let Some(snapshot) = found else { return Ok(false) };
        self.restore_snapshot(snapshot)?;
        self.show_present();
        Ok(true)
    }

    /// Returns a copy of the present state without snapshots.
    ///
    /// # Errors
    /// Fails if the scene cannot be built again, although it was built before.
    pub fn copy_at_present(&self) -> Result<Self, SimulationError> {
        self.fork_without_snapshots()
    }

    /// Returns a copy of the state at the start of the run, from which the run can be repeated.
    ///
    /// # Errors
    /// Fails if the scene cannot be built again, although it was built before.
    pub fn copy_at_start(&self) -> Result<Self, SimulationError> {
        let mut copy = self.fork_without_snapshots()?;
        match self.snapshots.find(0) {
            Some(first) => copy.restore_snapshot(first)?,
            None => {
                let start = Self::start(self.scene.clone(), self.settings)?;
                copy.restore_snapshot(&start.snapshot(start.model.state()))?;
            }
        }
        copy.show_present();
        Ok(copy)
    }

    /// Repeats in this copy the run of the original simulation `of`, up to the time of the given row of its history.
    /// The returned flag is true if the row exists, and if energies, momenta, work and impulses agree bit for bit with the original run.
    /// The repeated run may differ from the original run if script functions were called during the original run.
    ///
    /// # Errors
    /// Fails in the same cases as [`run_to`](Self::run_to).
    pub fn run_again(
        &mut self,
        of: &Self,
        row: usize,
        monitor: &mut dyn Monitor,
    ) -> Result<bool, SimulationError> {
        let rows = of.record.history.samples();
        let Some(wanted) = rows.get(row) else { return Ok(false) };
        let time = wanted.measures.time;
        if time > self.time() {
            let is_arrival = |at: &f64| of.arrivals().iter().any(|arrival| arrival.time == *at);
            let mut ends = rows[row..].iter().map(|row| row.measures.time);
            let planned = || self.clock.grid.end_of_step(self.time());
            let goal = ends.find(|end| !is_arrival(end)).unwrap_or_else(planned);
            let goal = if goal.is_finite() { goal } else { time };
            match self.run_to(goal, &mut PauseTime { time, monitor }) {
                Err(SimulationError::Interrupted { .. }) if self.time() == time => {}
                ran => ran?,
            }
        }
        Ok(self
            .record
            .history
            .samples()
            .last()
            .is_some_and(|last| last.measures == wanted.measures))
    }
}
