//! Rewinding and forking of simulations.

use rhai::Dynamic;

use super::simulations::{SIMULATION, SPINNING};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Presence, name, number, whole};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, method};
use crate::script::handles::simulation::{RunTarget, SimulationHandle};
use crate::script::messages::error::ScriptError;

pub const TABLE: BindingTable = BindingTable {
    name: "going back",
    doc: "A simulation can go back to states that it was in, bit for bit, as long as these fit into the memory set aside for them. \
          That is 256 MB for each simulation of a script that says back or rewind or imports a file somewhere (the library does not count), and none else; \
          scene.start(#{ …, snapshots: 64 }) sets aside 64 MB. When it is full, the oldest states but the start are forgotten.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        method(SIMULATION, "back", &[whole("count").non_negative().or(Presence::Whole(1))], |call| {
            go_back(call, RunTarget::Steps(call.count("count")?))
        })
        .summary("Goes back a step, or so many.")
        .doc(
            "State, time, history and counts of work are what they were, to the last bit. Steps are rows of the history: halves of a \
             step that failed, and steps cut where a slider arrives, count as well. Functions set with sim.at for times that lie \
             ahead again are called again. Variables of the script stay as they are.",
        )
        .example("sim.step(10);\nlet energy = sim.energy;\nsim.step(5);\nsim.back(5);\ncheck(sim.steps == 10 && sim.energy == energy);\nsim.back();\ncheck(sim.steps == 9);")
        .see(&["rewind", "fork", "keep_snapshots"]),
        method(SIMULATION, "rewind", &[number("t").any_number().unit("time")], |call| {
            go_back(call, RunTarget::Time(call.number("t")?))
        })
        .summary("Goes back to a time: to the end of the last step at or before it.")
        .doc("sim.rewind(0) leads to the start, whenever that was, which is kept whatever else was forgotten.")
        .example("sim.run_to(1);\nsim.rewind(0.55);\ncheck(sim.t == 0.5);\nsim.rewind(0);\ncheck(sim.t == 0);")
        .see(&["back", "run_to"]),
        method(SIMULATION, "fork", &[name("name").optional()], |call| {
            let handle = call.receiver::<SimulationHandle>()?;
            let name = call.text_if_given("name")?.unwrap_or_else(|| format!("{} fork", handle.name()));
            Ok(Dynamic::from(handle.fork(name, call.context())?))
        })
        .returns(Returns::object(SIMULATION))
        .summary("A copy that has been through the same and goes its own way from here.")
        .doc("It has a history of its own, can go back as far, and calls the functions that were set with sim.at. Stations, beams and sliders of the scene work with both.")
        .example("sim.run_to(0.5);\nlet other = sim.fork(\"what if\");\nother.run_to(1);\ncheck(sim.t == 0.5 && other.t == 1);\nsim.run_to(1);\ncheck(sim.energy == other.energy);")
        .see(&["back", "save"]),
        method(SIMULATION, "keep_snapshots", &[number("megabytes").non_negative()], |call| {
            let limit = bytes(call.number("megabytes")?);
            call.receiver::<SimulationHandle>()?.keep_snapshots(limit);
            Ok(Dynamic::UNIT)
        })
        .summary("Sets aside so much memory for states to go back to, from here on; 0 forgets them all.")
        .doc("A megabyte is a million bytes. A smaller limit than before forgets at once.")
        .example("sim.keep_snapshots(1);\nsim.step(20);\nsim.keep_snapshots(0);")
        .see(&["back", "start"]),
    ],
};

pub(super) fn bytes(megabytes: f64) -> usize {
    (megabytes * 1e6) as usize
}

fn go_back(call: &Call, goal: RunTarget) -> Result<Dynamic, ScriptError> {
    call.receiver::<SimulationHandle>()?.go_back(call, &goal)?;
    Ok(Dynamic::UNIT)
}
