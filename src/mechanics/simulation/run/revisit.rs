//! A copy that is shown the states in which a simulation has been: those that are kept, or, where they are forgotten, those of the
//! same run made again.

use super::Simulation;
use crate::simulation::{Monitor, SimulationError};

/// Pauses a run where it has come to a time.
struct PauseTime<'m> {
    time: f64,
    monitor: &'m mut dyn Monitor,
}

impl Monitor for PauseTime<'_> {
    fn goes_on(&mut self, time: f64) -> bool {
        self.monitor.goes_on(time) && time < self.time
    }
}

impl Simulation {
    /// Steps and times of the states that the simulation keeps without a gap up to the present, the present included.
    pub fn states_kept(&self) -> Vec<(usize, f64)> {
        let steps = self.progress.counts.steps;
        let from = self.snapshots.unbroken_from(steps).unwrap_or(steps);
        let kept = self.snapshots.places().filter(|(place, _)| (from..steps).contains(place));
        kept.chain([(steps, self.time())]).collect()
    }

    /// Takes the state in which another simulation, of which this is a copy that has not gone on, was after fewer steps than this
    /// one is now. Gives whether that state is kept.
    ///
    /// # Errors
    /// When the scene cannot be built, which it could before.
    pub fn revisit(&mut self, of: &Self, steps: usize) -> Result<bool, SimulationError> {
        if steps == self.progress.counts.steps {
            return Ok(true);
        }
        let found = of.snapshots.find(steps).filter(|_| steps < self.progress.counts.steps);
        let Some(snapshot) = found else { return Ok(false) };
        self.stand_at(snapshot)?;
        self.show_present();
        Ok(true)
    }

    /// A copy of the simulation at the present, without states of its own to go back to.
    ///
    /// # Errors
    /// When the scene cannot be built, which it could before.
    pub fn copy_at_present(&self) -> Result<Self, SimulationError> {
        self.fork_without_snapshots()
    }

    /// A copy of the simulation at the start of the run, to make it again.
    ///
    /// # Errors
    /// When the scene cannot be built, which it could before.
    pub fn copy_at_start(&self) -> Result<Self, SimulationError> {
        let mut copy = self.fork_without_snapshots()?;
        match self.snapshots.find(0) {
            Some(first) => copy.stand_at(first)?,
            None => {
                let start = Self::start(self.scene.clone(), self.settings)?;
                copy.stand_at(&start.snapshot(start.model.state()))?;
            }
        }
        copy.show_present();
        Ok(copy)
    }

    /// Goes on, in a copy at an earlier place of the same run, to a row of the history of the original. Gives whether energy, momenta and
    /// what was exchanged are there what they were, to the last bit: functions that a script had called on the way, or loads that it
    /// computes, may have made another run of it.
    ///
    /// # Errors
    /// As [`run_to`](Self::run_to), and when there is no such row.
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
            // No step was to end where a slider arrived: the run goes on towards the next row, and pauses.
            let is_arrival = |at: &f64| of.arrivals().iter().any(|arrival| arrival.time == *at);
            let mut ends = rows[row..].iter().map(|row| row.measures.time);
            let goal = ends.find(|end| !is_arrival(end)).unwrap_or(time);
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
