//! Recording options of runs.

use std::num::NonZeroUsize;

use rhai::Dynamic;

use super::simulations::SPINNING;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Scripted, Type};
use crate::script::bindings::parameter::integer;
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function};
use crate::script::handles::simulation::SimulationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::format_number;
use crate::simulation::Recording;

pub const TABLE: BindingTable = BindingTable {
    name: "recording",
    doc: "Selection of recorded states. By default a simulation records every step: a row in its \
        history and a configuration for pictures. For long runs select fewer: scene.start(#{ \
        …, record: every(100) }). The start, the end of every run_to, the times of sim.at and \
        the arrivals of sliders are always recorded. The present state always has a row while \
        it is the present, so that sim.energy and similar properties always work. States that \
        are not recorded use no memory and are missing in all evaluations of the history.",
    types: &[RECORDING],
    setup: SPINNING,
    constants: &[],
    rows: &[
        function("every", &[integer("steps").positive()], |call| {
            let steps = NonZeroUsize::new(call.count("steps")?).unwrap_or(NonZeroUsize::MIN);
            Ok(Dynamic::from(Recording::Every(steps)))
        })
        .returns(Returns::object(RECORDING))
        .summary("Records every n-th step.")
        .example("let long = scene.start(#{ dt: 0.1, record: every(10) });\nlong.run_to(5);\ncheck(long.steps == 50 && long.history.rows == 6);")
        .with_related(&["nothing", "start"]),
        function("nothing", &[], |_| Ok(Dynamic::from(Recording::Nothing)))
            .returns(Returns::object(RECORDING))
            .summary("Records only the start and the ends of runs.")
            .example("let quiet = scene.start(#{ dt: 0.1, record: nothing() });\nquiet.run_to(5);\ncheck(quiet.history.rows == 2 && quiet.history.drift(\"energy\") < 1e-12);")
            .with_related(&["every", "start"]),
    ],
};

pub const RECORDING: Type = Type::of::<Recording>();

impl Scripted for Recording {
    const NAME: &'static str = "recording";
    const DOC: &'static str = "Selection of the recorded states of a run.";

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
    let message = format!(
        "{what} needs every step, but '{}' recorded {}",
        of.name(),
        simulation.recording().describe()
    );
    Err(call.error(message).hint("start it without the option record: scene.start(#{ dt: … })"))
}

pub(super) fn expect_rows_between(call: &Call, of: &SimulationHandle) -> Result<(), ScriptError> {
    let simulation = of.simulation();
    if simulation.recording() != Recording::Nothing || simulation.has_all_rows() {
        return Ok(());
    }
    let message = format!("'{}' recorded {}", of.name(), simulation.recording().describe());
    Err(call
        .error(message)
        .hint("start it with the option record: every(100), or without this option"))
}

pub(super) struct Missing {
    /// Name, for messages, of the data that are missing because states cannot be computed again.
    pub what: &'static str,
    /// Suggestion, for messages, of an alternative without the missing data.
    pub instead: &'static str,
}

/// Reports that the states of a run from `time` on cannot be computed again.
/// The report is an error if the data were requested explicitly, otherwise a note.
pub(super) fn report_diverged_rerun(
    call: &Call,
    of: &SimulationHandle,
    time: f64,
    (missing, is_asked): (Missing, bool),
) -> Result<(), ScriptError> {
    let (name, time) = (of.name(), format_number(time));
    let message = format!(
        "the earlier states of '{name}' are no longer stored, and the repeated run differs at \
        t = {time} or before"
    );
    let more = "start it with the option snapshots: 1000 to store more states";
    if is_asked {
        let hint = format!("{more}, or write #{{ {} }}", missing.instead);
        return Err(call.error(message).hint(hint).at(CallPart::Key("fields".into())));
    }
    call.context()
        .print_message(&format!("note: {message}: {} are not written; {more}", missing.what));
    Ok(())
}

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
    let message = format!(
        "'{}' recorded {}: the recorded configuration nearest to t = {} is at t = {}",
        of.name(),
        simulation.recording().describe(),
        format_number(time),
        format_number(recorded)
    );
    let hint = "start it with the option record: every(n) and a smaller n, or plot with a larger \
        `every`";
    Err(call.error(message).hint(hint))
}
