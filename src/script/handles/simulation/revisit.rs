//! Temporary replacement of a simulation by a copy in an earlier state, to which all handles then refer.

use std::cell::{Ref, RefCell};
use std::rc::Rc;

use super::{Events, ProgressMonitor, SimulationHandle, explain};
use crate::script::bindings::stored::StoredFunction;
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;
use crate::simulation::Simulation;

/// Replacement of a simulation by a copy. Dropping this object restores the original.
pub struct Revisit {
    handle: SimulationHandle,
    original: RefCell<Simulation>,
    events: Events<Rc<StoredFunction>>,
    is_ending_told: bool,
}

impl Revisit {
    pub fn at_present(handle: &SimulationHandle) -> Result<Self, ScriptError> {
        let copy = handle.simulation().copy_at_present()?;
        Ok(Self::with(handle, copy))
    }

    /// Replaces a simulation by a copy of its initial state, so that the run can be repeated.
    pub fn at_start(handle: &SimulationHandle) -> Result<Self, ScriptError> {
        let copy = handle.simulation().copy_at_start()?;
        Ok(Self::with(handle, copy))
    }

    fn with(handle: &SimulationHandle, copy: Simulation) -> Self {
        let original = RefCell::new(copy);
        handle.0.simulation.swap(&original);
        Self {
            handle: handle.clone(),
            original,
            events: handle.0.events.borrow().clone(),
            is_ending_told: handle.0.is_ending_told.get(),
        }
    }

    pub fn original(&self) -> Ref<'_, Simulation> {
        self.original.borrow()
    }

    /// Number of steps that the copy has taken, and its present time [time].
    pub fn place(&self) -> (usize, f64) {
        (self.handle.simulation().counts().steps, self.handle.time())
    }

    /// Restores a state in the copy. Returns false if this state is not stored.
    pub fn restore_step(&self, steps: usize) -> Result<bool, ScriptError> {
        Ok(self.handle.0.simulation.borrow_mut().revisit(&self.original(), steps)?)
    }

    /// Advances the copy to a row of the history. Returns true if its energies and momenta equal those of the original.
    pub fn run_again(&self, row: usize, context: &Context) -> Result<bool, ScriptError> {
        loop {
            self.handle.command()?;
            let mut watch = ProgressMonitor::new(context, f64::INFINITY);
            watch.pauses = self.handle.is_controlled();
            let ran =
                self.handle.0.simulation.borrow_mut().run_again(&self.original(), row, &mut watch);
            if !watch.is_paused || ran.is_ok() {
                return ran.map_err(|error| explain(error, context));
            }
        }
    }
}

impl Drop for Revisit {
    fn drop(&mut self) {
        self.handle.0.simulation.swap(&self.original);
        self.handle.0.events.replace(self.events.clone());
        self.handle.0.is_ending_told.set(self.is_ending_told);
    }
}
