//! States in which a simulation was, one after another: those that are kept, or those of the run made again in a copy.

use super::{Revisit, SimulationHandle};
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;
use crate::simulation::Simulation;

/// Takes a state: the number of its time among those asked for, and the simulation as it was.
pub type Look<'l> = &'l mut dyn FnMut(usize, &Simulation) -> Result<(), ScriptError>;

/// Whether the states could be had again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Visited {
    /// All of them.
    All,
    /// The run made again was another one, seen first at this time: a function of the script had changed it on its way, or it
    /// did not begin as its scene does.
    Another(f64),
}

impl SimulationHandle {
    /// Shows the states that belong to rows of the history, by their times in rising order. Where one of them is not kept, the run is made
    /// again in a copy, and energies and momenta are compared bit for bit; then time passes, and steps count.
    ///
    /// # Errors
    /// When a step fails that did not, the run is stopped, or looking fails.
    pub fn visit(
        &self,
        times: &[f64],
        context: &Context,
        look: Look,
    ) -> Result<Visited, ScriptError> {
        let kept = self.simulation().states_kept();
        let steps_at = |time: &f64| {
            let last = kept[..kept.partition_point(|(_, kept)| kept <= time)].last()?;
            (last.1 == *time).then_some(last.0)
        };
        match times.iter().map(steps_at).collect::<Option<Vec<usize>>>() {
            Some(steps) => self.visit_kept(&steps, look),
            None => self.visit_again(times, context, look),
        }
    }

    /// From the last to the first, as a copy goes back.
    fn visit_kept(&self, steps: &[usize], look: Look) -> Result<Visited, ScriptError> {
        let revisit = Revisit::at_present(self)?;
        for (index, steps) in steps.iter().enumerate().rev() {
            if !revisit.go_back_to(*steps)? {
                return Err(ScriptError::bug(format!("the state after {steps} steps is lost")));
            }
            look(index, &self.simulation())?;
        }
        Ok(Visited::All)
    }

    fn visit_again(
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
                    return Ok(Visited::Another(*time));
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
