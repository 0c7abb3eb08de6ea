//! Record of the warnings of a simulation that have been reported.

use std::cell::RefCell;

use crate::script::state::context::Context;
use crate::simulation::{Simulation, Warning};

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Printing {
    #[default]
    AtTheEnd,
    Never,
}

#[derive(Debug, Clone, Default)]
pub struct Notes {
    printing: Printing,
    reported: RefCell<Vec<Warning>>,
}

impl Notes {
    pub fn new(printing: Printing) -> Self {
        Self { printing, reported: RefCell::default() }
    }

    pub fn report_warnings(&self, name: &str, simulation: &Simulation, context: &Context) {
        if self.printing == Printing::Never || context.is_stopped() {
            return;
        }
        let mut reported = self.reported.borrow_mut();
        for note in simulation.warnings() {
            if note.is_new_or_worse(&reported) {
                context.print_message(&format!("note: simulation '{name}': {note}"));
                reported.push(note);
            }
        }
    }

    pub fn report_changed_scene(&self, name: &str, scene: &str, context: &Context) {
        if self.printing != Printing::Never {
            context.print_message(&format!(
                "note: scene '{scene}' was changed after the start of simulation '{name}', which keeps the earlier scene; \
                 call scene.start again to simulate the changed one"
            ));
        }
    }
}
