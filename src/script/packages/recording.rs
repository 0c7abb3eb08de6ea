//! Recording options of runs.

use std::num::NonZeroUsize;

use rhai::Dynamic;

use super::simulations::SPINNING;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Scripted, Type};
use crate::script::bindings::parameter::whole;
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function};
use crate::script::handles::simulation::SimulationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::format_number;
use crate::simulation::Recording;

pub const TABLE: BindingTable = BindingTable {
    name: "recording",
    doc: "A simulation records every step: a row in its history, a configuration for pictures. A long run need not: \
          scene.start(#{ …, record: every(100) }). Its start, the end of every run_to, the times of sim.at and the arrivals of \
          sliders are recorded in any case, and the present has a row as long as it is the present, so that sim.energy and its like \
          always work. What is not recorded is not measured, and takes no memory.",
    types: &[RECORDING],
    setup: SPINNING,
    constants: &[],
    rows: &[
        function("every", &[whole("steps").positive()], |call| {
            let steps = NonZeroUsize::new(call.count("steps")?).unwrap_or(NonZeroUsize::MIN);
            Ok(Dynamic::from(Recording::Every(steps)))
        })
        .returns(Returns::object(RECORDING))
        .summary("Records the states after every so many steps.")
        .example("let long = scene.start(#{ dt: 0.1, record: every(10) });\nlong.run_to(5);\ncheck(long.steps == 50 && long.history.rows == 6);")
        .see(&["nothing", "start"]),
        function("nothing", &[], |_| Ok(Dynamic::from(Recording::Nothing)))
            .returns(Returns::object(RECORDING))
            .summary("Records the start and the ends of runs, and nothing between.")
            .example("let quiet = scene.start(#{ dt: 0.1, record: nothing() });\nquiet.run_to(5);\ncheck(quiet.history.rows == 2 && quiet.history.drift(\"energy\") < 1e-12);")
            .see(&["every", "start"]),
    ],
};

pub const RECORDING: Type = Type::of::<Recording>();

impl Scripted for Recording {
    const NAME: &'static str = "recording";
    const DOC: &'static str = "Which states of a run are recorded.";

    fn show(&self) -> String {
        format!("recording of {}", self.describe())
    }
}

pub(super) fn expect_all_rows(
    call: &Call,
    of: &SimulationHandle,
    what: &str,
) -> Result<(), ScriptError> {
    let simulation = of.simulation();
    if simulation.has_all_rows() {
        return Ok(());
    }
    let told = format!(
        "{what} needs every step, but '{}' recorded {}",
        of.name(),
        simulation.recording().describe()
    );
    Err(call.error(told).hint("start it without the option record: scene.start(#{ dt: … })"))
}

pub(super) fn expect_rows_between(call: &Call, of: &SimulationHandle) -> Result<(), ScriptError> {
    let simulation = of.simulation();
    if simulation.recording() != Recording::Nothing || simulation.has_all_rows() {
        return Ok(());
    }
    let told = format!("'{}' recorded {}", of.name(), simulation.recording().describe());
    Err(call.error(told).hint("start it with the option record: every(100), or without it"))
}

pub(super) struct Missing {
    /// Description of the missing data.
    pub what: &'static str,
    /// Alternative without the missing data.
    pub instead: &'static str,
}

/// Reports that the states of a run cannot be reproduced from `time` on: as an error if the data was requested explicitly, otherwise as a
/// note.
pub(super) fn tell_another_run(
    call: &Call,
    of: &SimulationHandle,
    time: f64,
    (missing, is_asked): (Missing, bool),
) -> Result<(), ScriptError> {
    let (name, time) = (of.name(), format_number(time));
    let told = format!(
        "the states of '{name}' are forgotten, and the run made again is another one from t = {time} or before"
    );
    let more = "start it with the option snapshots: 1000 to keep more states";
    if is_asked {
        let hint = format!("{more}, or write #{{ {} }}", missing.instead);
        return Err(call.error(told).hint(hint).at(CallPart::Key("fields".into())));
    }
    call.context().tell(&format!("note: {told}: {} are not written; {more}", missing.what));
    Ok(())
}

/// Rejects a picture at a time too far from the nearest recorded configuration.
pub(super) fn expect_near(
    call: &Call,
    of: &SimulationHandle,
    (time, recorded): (f64, f64),
    apart: f64,
) -> Result<(), ScriptError> {
    let simulation = of.simulation();
    if simulation.has_all_rows() || (time - recorded).abs() <= 0.5 * apart {
        return Ok(());
    }
    let told = format!(
        "'{}' recorded {}: the configuration nearest to t = {} is that of t = {}",
        of.name(),
        simulation.recording().describe(),
        format_number(time),
        format_number(recorded)
    );
    let hint =
        "start it with the option record: every(n) and a smaller n, or draw with a larger `every`";
    Err(call.error(told).hint(hint))
}
