//! Warnings about motion that the steps do not resolve.

use rhai::{Array, Dynamic};

use super::simulations::{SIMULATION, SPINNING};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, property};
use crate::script::handles::notes::Printing;
use crate::script::handles::simulation::SimulationHandle;

pub const TABLE: BindingTable = BindingTable {
    name: "notes",
    doc: "Notes on steps that are too large. Steps may keep energy and momenta to rounding and \
        still not resolve the motion. A simulation checks for vibration faster than the steps, \
        accumulated phase errors of vibration, drives that start with a speed at a beam at rest, large rotations of sections within a step, sliders that pass many spans in a step, steps \
        without a solution for the friction of a slider, and bounces on stiff beams. Each problem is printed once, at the end of sim.run_to(…); \
        without problems nothing is printed. scene.start(#{ …, notes: \"keep\" }) suppresses \
        the output. sim.notes, sim.explain() and the report contain the notes in any case.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[property(SIMULATION, "notes", |call| {
        let handle = call.receiver::<SimulationHandle>()?;
        let notes = handle.simulation().warnings();
        let texts = notes.iter().map(|note| Dynamic::from(note.to_string()));
        Ok(texts.collect::<Array>().into())
    })
    .returns(Returns::array_of(&ValueKind::Text))
    .summary("Notes on the steps so far that do not resolve the motion; empty if there are none.")
    .doc(
        "The notes refer to the steps that led to the present state: going back removes the \
        notes on the removed steps, and forks and saved simulations keep the notes on their \
        past. sim.run_to(…) prints each note once, and again only if the value has doubled.",
    )
    .example(
        "sim.run_to(1);\ncheck(sim.notes.is_empty());\n\
         let coarse = scene.start(#{ dt: 1, notes: \"keep\" });\ncoarse.run_to(4);\n\
         check(coarse.notes.len() == 1 && coarse.notes[0].contains(\"rad per step\"));",
    )
    .with_related(&["start", "explain", "run_to"])],
};

pub(super) const PRINTING: [(&str, Printing); 2] =
    [("print", Printing::AtTheEnd), ("keep", Printing::Never)];
