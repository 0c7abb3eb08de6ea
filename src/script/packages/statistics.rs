//! Statistics of columns.

use rhai::{Array, Dynamic, Map};

use super::histories::{HISTORY, column};
use super::simulations::SPINNING;
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Parameter, Presence, integer, number, text};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, method};
use crate::script::handles::history::HistoryHandle;
use crate::script::messages::error::ScriptError;
use crate::simulation::{History, SpectrumPeak, TimeSeries};

pub const TABLE: BindingTable = BindingTable {
    name: "statistics",
    doc: "Statistics of a column of a history, which is linearly interpolated between rows. For \
        a time window use: sim.history.after(2).statistics(\"energy\").",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        method(HISTORY, "statistics", &[COLUMN], statistics)
            .returns(Returns::MAP)
            .summary("Returns the extremes of a column with their times, its means and its integral \
                over time.")
            .doc("The map has min, min_at, max, max_at, mean (over time), rms (root mean square) \
                and integral.")
            .example(
                "sim.run_to(1);\nlet t = sim.history.statistics(\"t\");\n\
                 check(t.min == 0 && t.max == 1 && t.max_at == 1);\n\
                 check_close(t.mean, 0.5, 1e-12);\ncheck_close(t.rms, sqrt(1 / 3.0), 1e-12);",
            )
            .with_related(&["largest", "spectrum", "crossings", "derivative"]),
        method(HISTORY, "derivative", &[COLUMN], |call| Ok(numbers(series(call)?.derivative())))
            .returns(Returns::NUMBERS)
            .summary("Returns the time derivative of a column at each row.")
            .doc(
                "Computed from the parabola through a row and its neighbours: second order, \
                also with varying steps. At a jump, where two rows have the same time, each \
                has the one-sided difference quotient.",
            )
            .example("sim.run_to(1);\ncheck_close(sim.history.derivative(\"t\")[5], 1, 1e-12);")
            .with_related(&["column", "crossings"]),
        method(HISTORY, "crossings", &[COLUMN, number("level").or(Presence::Number(0.0))], |call| {
            Ok(numbers(series(call)?.crossings(call.number("level")?)))
        })
        .returns(Returns::NUMBERS.unit("time"))
        .summary("Returns the times at which a column crosses a level, upwards or downwards.")
        .example("sim.run_to(1);\ncheck_close(sim.history.crossings(\"t\", 0.25)[0], 0.25, 1e-12);")
        .with_related(&["statistics", "spectrum"]),
        method(HISTORY, "spectrum", &[COLUMN, integer("most").positive().or(Presence::Integer(5))], spectrum)
            .returns(Returns::array_of(&ValueKind::Map))
            .summary("Returns frequency and amplitude of the strongest vibrations in a column, in \
                descending order of amplitude.")
            .doc(
                "The frequency is in cycles per unit of time; multiply by 2π for the angular \
                frequency. The mean is excluded. Rows must be evenly spaced: use a fixed dt, \
                and a window without additional ends of steps. Two vibrations less than about \
                four cycles over the window apart are not separated, and slower ones are not \
                found. Window of Blackman and Harris; F. J. Harris, Proc. IEEE 66 (1978) \
                51-83.",
            )
            .example(
                "let swing = new_scene(\"swing\");\nlet bob = swing.beam(#{ name: \"bob\", axis: line([0, 0], [1, 0]), basis: bspline(2), section: s, spin: 8, about: [0, 0] });\n\
                 swing.hinge(bob.start);\nswing.record(\"bob.end.x\");\nlet run = swing.start(#{ dt: 0.02 });\nrun.run_to(10);\n\
                 let turning = run.history.spectrum(\"bob.end.x\")[0];\ncheck_close(turning.frequency, 8 / 6.283185307, 0.01);\ncheck_close(turning.amplitude, 1, 0.05);",
            )
            .with_related(&["statistics", "modes"]),
    ],
};

const COLUMN: Parameter = text("column").doc("name of a column of this history");

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
    let summary = of
        .summary()
        .ok_or_else(|| ScriptError::internal_error("a column without rows".to_owned()))?;
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
        let hint = "use sim.history.between(t1, t2) with steps of one size: a fixed dt, record: \
            every(n), no shortened steps";
        call.error(error).hint(hint)
    })?;
    let peak_map =
        |peak: SpectrumPeak| map(&[("frequency", peak.frequency), ("amplitude", peak.amplitude)]);
    Ok(peaks.into_iter().map(peak_map).collect::<Array>().into())
}

pub(super) fn map(entries: &[(&str, f64)]) -> Dynamic {
    entries.iter().map(|(name, value)| ((*name).into(), (*value).into())).collect::<Map>().into()
}

fn numbers(values: Vec<f64>) -> Dynamic {
    values.into_iter().map(Dynamic::from).collect::<Array>().into()
}
