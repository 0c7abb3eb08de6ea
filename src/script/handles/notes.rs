//! What has been told of a simulation.

use std::cell::RefCell;

use crate::script::state::context::Context;
use crate::simulation::{Simulation, Warning};

/// Whether notes are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Printing {
    /// Notes are printed when a run ends.
    #[default]
    AtTheEnd,
    /// Notes are not printed: they are kept for those who ask.
    Never,
}

/// The notes of a simulation that have been told.
#[derive(Debug, Clone, Default)]
pub struct Notes {
    printing: Printing,
    told: RefCell<Vec<Warning>>,
}

impl Notes {
    /// Notes of which none has been told so far.
    pub fn new(printing: Printing) -> Self {
        Self { printing, told: RefCell::default() }
    }

    /// Tells what the steps of a simulation do not resolve, each thing once unless it gets worse.
    pub fn tell(&self, name: &str, simulation: &Simulation, context: &Context) {
        if self.printing == Printing::Never || context.is_stopped() {
            return;
        }
        let mut told = self.told.borrow_mut();
        for note in simulation.notes() {
            if note.is_news_after(&told) {
                context.tell(&format!("note: simulation '{name}': {note}"));
                told.push(note);
            }
        }
    }
}
