//! Statistics of columns.

use rhai::{Array, Dynamic, Map};

use super::histories::{HISTORY, column};
use super::simulations::SPINNING;
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Parameter, Presence, number, text, whole};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, method};
use crate::script::handles::history::HistoryHandle;
use crate::script::messages::error::ScriptError;
use crate::simulation::{History, SpectrumPeak, TimeSeries};

pub const TABLE: BindingTable = BindingTable {
    name: "statistics",
    doc: "What a column of a history tells as a whole. Between rows it is taken as straight. Windows narrow it: sim.history.after(2).statistics(\"energy\").",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        method(HISTORY, "statistics", &[COLUMN], statistics)
            .returns(Returns::MAP)
            .summary("The extremes of a column with their times, its means and its integral over time.")
            .doc("The map holds min, min_at, max, max_at, mean (over time), rms (root mean square) and integral.")
            .example(
                "sim.run_to(1);\nlet t = sim.history.statistics(\"t\");\n\
                 check(t.min == 0 && t.max == 1 && t.max_at == 1);\n\
                 check_close(t.mean, 0.5, 1e-12);\ncheck_close(t.rms, sqrt(1 / 3.0), 1e-12);",
            )
            .see(&["largest", "spectrum", "crossings", "derivative"]),
        method(HISTORY, "derivative", &[COLUMN], |call| Ok(numbers(series(call)?.derivative())))
            .returns(Returns::NUMBERS)
            .summary("The derivative of a column by time, for each row.")
            .doc(
                "That of the parabola through a row and its neighbours: of second order, also where steps vary. Where two rows have one time, at a jump, \
                 each has the quotient on its own side.",
            )
            .example("sim.run_to(1);\ncheck_close(sim.history.derivative(\"t\")[5], 1, 1e-12);")
            .see(&["column", "crossings"]),
        method(HISTORY, "crossings", &[COLUMN, number("level").or(Presence::Number(0.0))], |call| {
            Ok(numbers(series(call)?.crossings(call.number("level")?)))
        })
        .returns(Returns::NUMBERS.unit("time"))
        .summary("When a column passes a level, up or down.")
        .example("sim.run_to(1);\ncheck_close(sim.history.crossings(\"t\", 0.25)[0], 0.25, 1e-12);")
        .see(&["statistics", "spectrum"]),
        method(HISTORY, "spectrum", &[COLUMN, whole("most").positive().or(Presence::Whole(5))], spectrum)
            .returns(Returns::array_of(&ValueKind::Map))
            .summary("The strongest vibrations in a column, the strongest first: frequency and amplitude of each.")
            .doc(
                "The frequency is in periods a unit of time; the circular one is 2π times as much. The mean is no vibration. Rows must be evenly spaced: with \
                 adaptive steps or cuts take a fixed dt, or a window without the cut. Two vibrations that are nearer than about four periods over the window \
                 are not told apart, and slower ones are not seen. Window of Blackman and Harris; F. J. Harris, Proc. IEEE 66 (1978) 51-83.",
            )
            .example(
                "let swing = new_scene(\"swing\");\nlet bob = swing.beam(#{ name: \"bob\", axis: line([0, 0], [1, 0]), basis: bspline(2), section: s, spin: 8, about: [0, 0] });\n\
                 swing.hinge(bob.start);\nswing.record(\"bob.end.x\");\nlet run = swing.start(#{ dt: 0.02 });\nrun.run_to(10);\n\
                 let turning = run.history.spectrum(\"bob.end.x\")[0];\ncheck_close(turning.frequency, 8 / 6.283185307, 0.01);\ncheck_close(turning.amplitude, 1, 0.05);",
            )
            .see(&["statistics", "modes"]),
    ],
};

const COLUMN: Parameter = text("column").doc("the name of a column of this history");

fn series(call: &Call) -> Result<TimeSeries, ScriptError> {
    let values = column(call, History::column)?;
    let history = call.receiver::<HistoryHandle>()?;
    let times = history.read(|history| history.column("t")).unwrap_or_default();
    match values.is_empty() {
        true => Err(history.no_rows(call)),
        false => Ok(TimeSeries { times, values }),
    }
}

fn statistics(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let of = series(call)?;
    let summary =
        of.summary().ok_or_else(|| ScriptError::bug("a column without rows".to_owned()))?;
    Ok(map(&[
        ("min", summary.min),
        ("min_at", summary.min_at),
        ("max", summary.max),
        ("max_at", summary.max_at),
        ("mean", summary.mean),
        ("rms", summary.rms),
        ("integral", summary.integral),
    ]))
}

fn spectrum(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let peaks = series(call)?.spectrum(call.count("most")?).map_err(|error| {
        let hint = "take sim.history.between(t1, t2) with steps of one size: a fixed dt, record: every(n), no cut inside";
        call.error(error).hint(hint)
    })?;
    let told =
        |peak: SpectrumPeak| map(&[("frequency", peak.frequency), ("amplitude", peak.amplitude)]);
    Ok(peaks.into_iter().map(told).collect::<Array>().into())
}

pub(super) fn map(entries: &[(&str, f64)]) -> Dynamic {
    entries.iter().map(|(name, value)| ((*name).into(), (*value).into())).collect::<Map>().into()
}

fn numbers(values: Vec<f64>) -> Dynamic {
    values.into_iter().map(Dynamic::from).collect::<Array>().into()
}
