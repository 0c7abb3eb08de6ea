//! Warnings about features that the steps do not resolve.

use rhai::{Array, Dynamic};

use super::simulations::{SIMULATION, SPINNING};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, property};
use crate::script::handles::notes::Printing;
use crate::script::handles::simulation::SimulationHandle;

pub const TABLE: BindingTable = BindingTable {
    name: "notes",
    doc: "Steps may keep energy and momenta to rounding and be too long to mean anything. While a simulation runs, it measures how well its \
          steps resolve what happens: vibration that they do not follow, sections that turn far in a step, sliders that pass many \
          spans, bounces on stiff beams. What is not resolved is told once, when sim.run_to(…) ends; when all is well, nothing is. \
          scene.start(#{ …, notes: \"keep\" }) prints none of it. sim.notes, sim.explain() and the report have it in any case.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[property(SIMULATION, "notes", |call| {
        let handle = call.receiver::<SimulationHandle>()?;
        let notes = handle.simulation().notes();
        let texts = notes.iter().map(|note| Dynamic::from(note.to_string()));
        Ok(texts.collect::<Array>().into())
    })
    .returns(Returns::array_of(&ValueKind::Text))
    .summary("What the steps so far do not resolve; empty when all is well.")
    .doc(
        "They are about the steps that led to the present: going back takes the notes on the steps undone away, forks and saved \
         simulations have those of their past. sim.run_to(…) tells each at its end, and again only when it has become twice as bad.",
    )
    .example(
        "sim.run_to(1);\ncheck(sim.notes.is_empty());\n\
         let coarse = scene.start(#{ dt: 1, notes: \"keep\" });\ncoarse.run_to(4);\n\
         check(coarse.notes.len() == 1 && coarse.notes[0].contains(\"rad in a step\"));",
    )
    .see(&["start", "explain", "run_to"])],
};

pub(super) const PRINTING: [(&str, Printing); 2] =
    [("print", Printing::AtTheEnd), ("keep", Printing::Never)];
