//! Simulations, histories and stations shown in pictures and written to files.

use rhai::{Array, Dynamic};

use crate::geometry::Vec2;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Kind, Scripted};
use crate::script::bindings::parameter::{Parameter, either};
use crate::script::handles::history::HistoryHandle;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::handles::station::StationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::packages::histories::HISTORY;
use crate::script::packages::recording::expect_rows_between;
use crate::script::packages::simulations::SIMULATION;

pub const MOVING: Parameter = either("of", &[Kind::Object(SIMULATION), Kind::Array])
    .doc("a simulation, or an array of simulations");
pub const RECORDED: Parameter =
    either("of", &[Kind::Object(SIMULATION), Kind::Object(HISTORY), Kind::Array])
        .doc("a simulation or history, or an array of them");

const MOST_SIDE_BY_SIDE: usize = 100;

fn things<T: Scripted>(
    call: &Call,
    convert: fn(&Dynamic) -> Option<T>,
) -> Result<Vec<T>, ScriptError> {
    let of = call.value("of")?;
    let values = of.read_lock::<Array>().map_or_else(|| vec![of.clone()], |array| array.clone());
    if values.len() > MOST_SIDE_BY_SIDE {
        let message = format!(
            "{} pictures side by side are too many; the limit is {MOST_SIDE_BY_SIDE}",
            values.len()
        );
        return Err(call.error(message).hint("plot fewer of them").at(CallPart::Argument(0)));
    }
    let things: Option<Vec<T>> = values.iter().map(convert).collect();
    things.filter(|things| !things.is_empty()).ok_or_else(|| {
        call.error("the array must hold one or more simulations")
            .hint("for example [first, second]")
            .at(CallPart::Argument(0))
    })
}

pub fn simulations(call: &Call) -> Result<Vec<SimulationHandle>, ScriptError> {
    things(call, as_simulation)
}

pub fn histories(call: &Call) -> Result<Vec<HistoryHandle>, ScriptError> {
    let histories = things(call, as_history)?;
    match histories.iter().find(|of| of.read(|rows| rows.samples().is_empty())) {
        Some(empty) => Err(empty.no_rows(call)),
        None => Ok(histories),
    }
}

/// Histories that a call draws. Fails if a history is empty or was recorded only at the ends of runs.
pub fn histories_over_time(call: &Call) -> Result<Vec<HistoryHandle>, ScriptError> {
    let histories = histories(call)?;
    histories.iter().try_for_each(|history| expect_rows_between(call, &history.of))?;
    Ok(histories)
}

fn as_simulation(value: &Dynamic) -> Option<SimulationHandle> {
    value.clone().try_cast()
}

pub fn as_history(value: &Dynamic) -> Option<HistoryHandle> {
    let whole = |of| HistoryHandle { of, from: f64::NEG_INFINITY, to: f64::INFINITY };
    value.clone().try_cast::<HistoryHandle>().or_else(|| as_simulation(value).map(whole))
}

pub fn plain(point: &Vec2) -> (f64, f64) {
    (point.x, point.y)
}

/// Stations in an array. `at` is the position of the array in the call.
pub fn stations(
    call: &Call,
    array: &Array,
    at: CallPart,
) -> Result<Vec<StationHandle>, ScriptError> {
    let stations = array.iter().map(|value| value.clone().try_cast::<StationHandle>());
    stations.collect::<Option<_>>().ok_or_else(|| {
        call.error("the array must hold stations").hint("for example [rod.end]").at(at)
    })
}
