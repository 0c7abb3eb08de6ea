//! A copy that is shown the states in which a simulation has been: those that are kept, or, where they are forgotten, those of the
//! same run made again.

use super::Simulation;
use crate::simulation::{Monitor, SimulationError};

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
    pub fn revisit(&mut self, of: &Self, steps: usize) -> bool {
        if steps == self.progress.counts.steps {
            return true;
        }
        let found = of.snapshots.find(steps).filter(|_| steps < self.progress.counts.steps);
        found.inspect(|snapshot| {
            self.stand_at(snapshot);
            self.show_present();
        });
        found.is_some()
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
            Some(first) => copy.stand_at(first),
            None => {
                let start = Self::start(self.scene.clone(), self.settings)?;
                copy.stand_at(&start.snapshot(start.model.state()));
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
        let Some(wanted) = of.record.history.samples().get(row) else { return Ok(false) };
        if wanted.measures.time > self.time() {
            self.run_to(wanted.measures.time, monitor)?;
        }
        Ok(self
            .record
            .history
            .samples()
            .last()
            .is_some_and(|last| last.measures == wanted.measures))
    }
}
