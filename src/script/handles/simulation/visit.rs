//! Iteration over earlier states of a simulation, restored from snapshots or computed again in a copy.

use super::{Revisit, SimulationHandle};
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;
use crate::simulation::Simulation;

pub type Look<'l> = &'l mut dyn FnMut(usize, &Simulation) -> Result<(), ScriptError>;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Visited {
    All,
    /// The repeated run differs from the original run. The field is the first visited time at which the runs differ [time].
    Diverged(f64),
}

impl SimulationHandle {
    /// Calls `look` with the states at the given times of the history. Stored states are visited from the last to the first.
    /// If a state is not stored, the run is repeated in a copy, and states are visited in the order of time. The repeated steps count towards the step limit.
    /// Energies and momenta of the repeated run must equal those of the original bit by bit.
    pub fn for_each_state(
        &self,
        times: &[f64],
        context: &Context,
        look: Look,
    ) -> Result<Visited, ScriptError> {
        let kept = self.simulation().stored_states();
        let steps_at = |time: &f64| {
            let last = kept[..kept.partition_point(|(_, kept)| kept <= time)].last()?;
            (last.1 == *time).then_some(last.0)
        };
        match times.iter().map(steps_at).collect::<Option<Vec<usize>>>() {
            Some(steps) => self.for_each_stored(&steps, look),
            None => self.for_each_rerun(times, context, look),
        }
    }

    /// Calls `look` with stored states, from the last to the first, because the copy can only be rewound.
    fn for_each_stored(&self, steps: &[usize], look: Look) -> Result<Visited, ScriptError> {
        let revisit = Revisit::at_present(self)?;
        for (index, steps) in steps.iter().enumerate().rev() {
            if !revisit.restore_step(*steps)? {
                return Err(ScriptError::internal_error(format!(
                    "the state after {steps} steps is lost"
                )));
            }
            look(index, &self.simulation())?;
        }
        Ok(Visited::All)
    }

    fn for_each_rerun(
        &self,
        times: &[f64],
        context: &Context,
        look: Look,
    ) -> Result<Visited, ScriptError> {
        let (first, last) = (times.first().copied(), times.last().copied());
        let revisit = Revisit::at_start(self)?;
        let rows = revisit.original().history().column("t").unwrap_or_default();
        context.progress().begin(self.name(), first.unwrap_or(0.0), last.unwrap_or(0.0));
        let mut visit = || {
            for (index, time) in times.iter().enumerate() {
                let row = rows.partition_point(|row| row <= time).saturating_sub(1);
                if !revisit.run_again(row, context)? {
                    return Ok(Visited::Diverged(*time));
                }
                look(index, &self.simulation())?;
            }
            Ok(Visited::All)
        };
        let visited = visit();
        context.progress().end();
        visited
    }
}
