//! Return of simulations to earlier states, and copies of simulations.

use rhai::Dynamic;

use super::simulations::{SIMULATION, SPINNING};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Presence, integer, name, number};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, method};
use crate::script::handles::simulation::{RunTarget, SimulationHandle};
use crate::script::messages::error::ScriptError;

pub const TABLE: BindingTable = BindingTable {
    name: "going back",
    doc: "A simulation can go back to its earlier states, bit for bit, as far as they are stored \
        in memory. The default limit is 256 MB for each simulation if the script contains back \
        or rewind or imports a file (other than of the library), else 0; scene.start(#{ …, \
        snapshots: 64 }) sets 64 MB. If the limit is exceeded, the oldest states except the \
        start are deleted.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        method(SIMULATION, "back", &[integer("count").non_negative().or(Presence::Integer(1))], |call| {
            rewind(call, RunTarget::Steps(call.count("count")?))
        })
        .summary("Goes back by one step or the given number of steps.")
        .doc(
            "State, time, history and counts of work are restored exactly. Steps are rows of \
            the history: halves of a failed step and steps shortened by the arrival of a \
            slider count as well. Functions registered with sim.at for later times are called \
            again. Variables of the script do not change.",
        )
        .example("sim.step(10);\nlet energy = sim.energy;\nsim.step(5);\nsim.back(5);\ncheck(sim.steps == 10 && sim.energy == energy);\nsim.back();\ncheck(sim.steps == 9);")
        .with_related(&["rewind", "fork", "keep_snapshots"]),
        method(SIMULATION, "rewind", &[number("t").allow_non_finite().unit("time")], |call| {
            rewind(call, RunTarget::Time(call.number("t")?))
        })
        .summary("Goes back to a time: to the end of the last step at or before it.")
        .doc("sim.rewind(0) goes to the start, at any start time; the start is always stored.")
        .example("sim.run_to(1);\nsim.rewind(0.55);\ncheck(sim.t == 0.5);\nsim.rewind(0);\ncheck(sim.t == 0);")
        .with_related(&["back", "run_to"]),
        method(SIMULATION, "fork", &[name("name").optional()], |call| {
            let handle = call.receiver::<SimulationHandle>()?;
            let name = call.optional_text("name")?.unwrap_or_else(|| format!("{} fork", handle.name()));
            Ok(Dynamic::from(handle.fork(name, call.context())?))
        })
        .returns(Returns::object(SIMULATION))
        .summary("Returns an independent copy of the simulation with the same past.")
        .doc("It has its own history, can go back as far, and calls the functions registered \
            with sim.at. Stations, beams and sliders of the scene are valid for both.")
        .example("sim.run_to(0.5);\nlet other = sim.fork(\"what if\");\nother.run_to(1);\ncheck(sim.t == 0.5 && other.t == 1);\nsim.run_to(1);\ncheck(sim.energy == other.energy);")
        .with_related(&["back", "save"]),
        method(SIMULATION, "keep_snapshots", &[number("megabytes").non_negative()], |call| {
            let limit = bytes(call.number("megabytes")?);
            call.receiver::<SimulationHandle>()?.set_snapshot_memory(limit);
            Ok(Dynamic::UNIT)
        })
        .summary("Sets the memory limit for stored states from now on; 0 deletes all of them.")
        .doc("A megabyte is a million bytes. A smaller limit deletes states at once.")
        .example("sim.keep_snapshots(1);\nsim.step(20);\nsim.keep_snapshots(0);")
        .with_related(&["back", "start"]),
    ],
};

pub(super) fn bytes(megabytes: f64) -> usize {
    (megabytes * 1e6) as usize
}

fn rewind(call: &Call, goal: RunTarget) -> Result<Dynamic, ScriptError> {
    call.receiver::<SimulationHandle>()?.rewind_to(call, &goal)?;
    Ok(Dynamic::UNIT)
}
