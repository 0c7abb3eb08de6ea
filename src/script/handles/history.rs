//! Time interval of the history of a simulation.

use rhai::Dynamic;

use super::simulation::SimulationHandle;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Scripted};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::format_number;
use crate::script::presentation::details;
use crate::script::presentation::plots::{column_hint, column_names};
use crate::simulation::{History, Sample};

#[derive(Clone)]
pub struct HistoryHandle {
    pub of: SimulationHandle,
    /// Start of the interval [time].
    pub from: f64,
    /// End of the interval [time].
    pub to: f64,
}

impl HistoryHandle {
    pub fn read<T>(&self, read: impl FnOnce(&History) -> T) -> T {
        self.of.read_history((self.from, self.to), read)
    }

    pub fn no_rows(&self, call: &Call) -> ScriptError {
        let now = format_number(self.of.time());
        let recording = self.of.simulation().recording();
        let recorded = match recording.is_complete() {
            true => String::new(),
            false => format!(" and recorded {} (option record)", recording.describe()),
        };
        call.error("the history has no rows in this interval")
            .hint(format!("the simulation has run from t = 0 to {now}{recorded}"))
    }

    pub fn column_names(&self) -> String {
        column_names(self.of.simulation().history())
    }

    pub fn expect_column(
        &self,
        call: &Call,
        given: &Dynamic,
        argument: usize,
    ) -> Result<String, ScriptError> {
        let name = given.clone().into_string().unwrap_or_default();
        let simulation = self.of.primary();
        let history = simulation.history();
        if history.dimension(&name).is_some() {
            return Ok(name);
        }
        let got = call.show(given);
        let is_sensor = simulation.scene().clone().record(&name).is_ok();
        let hint = match is_sensor {
            true => format!(
                "it is a sensor, and must be recorded: scene.record(\"{name}\") before \
                scene.start(…)"
            ),
            false => column_hint(history, &name),
        };
        Err(call
            .error(format!("the history of '{}' has no column {got}", self.of.name()))
            .hint(hint)
            .at(CallPart::Argument(argument)))
    }

    pub fn between(&self, from: f64, to: f64) -> Self {
        Self { of: self.of.clone(), from: self.from.max(from), to: self.to.min(to) }
    }
}

impl Scripted for HistoryHandle {
    const NAME: &'static str = "history";
    const DOC: &'static str = "Recorded values of a simulation by step.";

    fn is_busy(&self) -> Option<String> {
        self.of.is_busy()
    }

    fn show(&self) -> String {
        if let Some(reason) = self.is_busy() {
            return format!("history: {reason}");
        }
        let (rows, first, last) = self.read(|history| {
            let time = |row: Option<&Sample>| row.map_or(f64::NAN, |row| row.measures.time);
            (
                history.samples().len(),
                time(history.samples().first()),
                time(history.samples().last()),
            )
        });
        format!(
            "history of {rows} rows from t = {} to {}",
            format_number(first),
            format_number(last)
        )
    }

    fn details(&self) -> Details {
        self.read(details::of_history)
    }

    fn parameter_set(
        &self,
    ) -> Option<std::rc::Rc<crate::script::bindings::parameter_variants::ParameterSet>> {
        Scripted::parameter_set(&self.of)
    }
}
