//! A simulation that stands for a while where it has been: whoever asks it, by whatever name, is answered from there.

use std::cell::{Ref, RefCell};
use std::rc::Rc;

use super::{Events, ProgressMonitor, SimulationHandle, explain};
use crate::script::bindings::stored::StoredFunction;
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;
use crate::simulation::Simulation;

/// Puts a copy in the place of a simulation, as long as it lives; then all is as it was.
pub struct Revisit {
    handle: SimulationHandle,
    /// The copy when it is not in the place of the original.
    original: RefCell<Simulation>,
    events: Events<Rc<StoredFunction>>,
    is_ending_told: bool,
}

impl Revisit {
    /// Puts a copy at the present in the place of a simulation.
    ///
    /// # Errors
    /// When the scene cannot be built, which it could before.
    pub fn at_present(handle: &SimulationHandle) -> Result<Self, ScriptError> {
        let copy = handle.simulation().copy_at_present()?;
        Ok(Self::with(handle, copy))
    }

    /// Puts a copy at the start of the run in the place of a simulation, to make the run again.
    ///
    /// # Errors
    /// When the scene cannot be built, which it could before.
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

    /// The simulation whose place the copy takes.
    pub fn original(&self) -> Ref<'_, Simulation> {
        self.original.borrow()
    }

    /// The number of steps that led to where the copy stands, and its time.
    pub fn place(&self) -> (usize, f64) {
        (self.handle.simulation().counts().steps, self.handle.time())
    }

    /// Takes the copy back to a state that is kept; gives whether it is.
    ///
    /// # Errors
    /// When the scene cannot be built, which it could before.
    pub fn go_back_to(&self, steps: usize) -> Result<bool, ScriptError> {
        Ok(self.handle.0.simulation.borrow_mut().revisit(&self.original(), steps)?)
    }

    /// Takes the copy on to a row of the original's history; gives whether all is there as it was.
    ///
    /// # Errors
    /// When a step fails that did not, or the run is stopped.
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
        // What was looked at may have gone on, and called what waits for the original.
        self.handle.0.events.replace(self.events.clone());
        self.handle.0.is_ending_told.set(self.is_ending_told);
    }
}
