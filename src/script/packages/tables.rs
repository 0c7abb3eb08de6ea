//! Tables of histories, sweeps, and arrays of maps.

use std::collections::BTreeSet;

use rhai::{Array, Dynamic, Map};

use super::histories::HISTORY;
use super::simulations::SIMULATION;
use super::sweeps::SWEEP_TABLE;
use crate::output::{DataColumn, DataTable, DataValues};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Kind;
use crate::script::bindings::parameter::{Parameter, either};
use crate::script::handles::history::HistoryHandle;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::as_number;
use crate::script::presentation::arrays;
use crate::script::studies::sweeps::table::SweepTable;

pub(super) const TABULAR: Parameter = either(
    "of",
    &[Kind::Object(SIMULATION), Kind::Object(HISTORY), Kind::Object(SWEEP_TABLE), Kind::Array],
)
.doc(
    "a simulation or history, the table of a sweep, or an array of maps such as the \
            cells of a stability map",
);

pub(super) fn table(call: &Call) -> Result<DataTable, ScriptError> {
    let of = call.value("of")?;
    if let Some(simulation) = of.clone().try_cast::<SimulationHandle>() {
        return Ok(arrays::table(simulation.simulation().history()));
    }
    if let Some(history) = of.clone().try_cast::<HistoryHandle>() {
        return match history.read(|rows| rows.samples().is_empty()) {
            true => Err(history.no_rows(call)),
            false => Ok(history.read(arrays::table)),
        };
    }
    if let Some(sweep) = of.clone().try_cast::<SweepTable>() {
        return Ok(sweep.data());
    }
    let rows = of.try_cast::<Array>().unwrap_or_default().into_iter();
    let rows: Option<Vec<Map>> = rows.map(Dynamic::try_cast::<Map>).collect();
    let rows = rows.filter(|rows| !rows.is_empty()).ok_or_else(|| {
        call.error("the array must hold one or more maps, each a row of the table")
            .hint(
                "for example map.cells, or [#{ mesh: 8, error: 0.1 }, #{ mesh: 16, error: 0.02 }]",
            )
            .at(CallPart::Argument(0))
    })?;
    let names: BTreeSet<&str> = rows.iter().flat_map(|row| row.keys()).map(|key| &**key).collect();
    let column = |name: &str| {
        call.context().proceed()?;
        let values = values(call, &rows, name);
        Ok(DataColumn { name: name.to_owned(), dimension: String::new(), values })
    };
    let columns = names.into_iter().map(column);
    Ok(DataTable { columns: columns.collect::<Result<_, ScriptError>>()? })
}

fn values(call: &Call, rows: &[Map], name: &str) -> DataValues {
    let cells: Vec<Option<&Dynamic>> =
        rows.iter().map(|row| row.get(name).filter(|cell| !cell.is_unit())).collect();
    let are = |fits: fn(&Dynamic) -> bool| cells.iter().flatten().all(|cell| fits(cell));
    let of_cells = cells.iter().copied();
    if are(Dynamic::is_int) {
        return DataValues::Integers(of_cells.map(|cell| cell?.as_int().ok()).collect());
    }
    if are(|cell| as_number(cell).is_some()) {
        return DataValues::Numbers(of_cells.map(|cell| as_number(cell?)).collect());
    }
    if are(Dynamic::is_bool) {
        return DataValues::Booleans(of_cells.map(|cell| cell?.as_bool().ok()).collect());
    }
    let text = |cell: &Dynamic| cell.clone().into_string().unwrap_or_else(|_| call.show(cell));
    DataValues::Texts(of_cells.map(|cell| cell.map(text)).collect())
}
