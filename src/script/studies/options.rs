//! Options of the studies: keys and typed structs.

use rhai::{Array, Dynamic, FnPtr};

use super::reference::FinestRun;
use crate::integrators::Method;
use crate::script::bindings::arguments::Arguments;
use crate::script::bindings::kind::{Kind, Type};
use crate::script::bindings::option_set::{FromOption, both, option_set};
use crate::script::bindings::parameter::{
    Parameter, Presence, anything, array, callback, choice, either, name, number, numbers, object,
    text, whole,
};
use crate::script::messages::error::ScriptError;

const INTEGRATOR: Type = Type::of::<Method>();
const FINEST_RUN: Type = Type::of::<FinestRun>();

option_set! {
    /// The options of `study_stability`.
    pub struct StabilityOptions {
        /// Name of the study and its files.
        name: String = name("name").doc("of the study and its files"),
        /// Function that makes the scene of a cell.
        scene: FnPtr = callback("scene").doc("|cell| …, a function that makes the scene of a cell"),
        /// Map with a name and its values.
        rows: Dynamic = anything("rows").doc("a name and its values: #{ stiffness: [1e4, 1e8] }"),
        /// Map with a name and its values.
        columns: Dynamic = anything("columns").doc("a name and its values: #{ dt: [0.1, 0.2] }"),
        /// Map with a name and its values.
        maps: Option<Dynamic> =
            anything("maps").doc("a name and its values, one map for each").optional(),
        /// Default integrator of the cells.
        integrator: Option<Method> =
            object("integrator", INTEGRATOR).doc("energy_momentum() unless given").optional(),
        /// Default step size of the cells [time].
        dt: Option<f64> =
            number("dt").positive().unit("time").doc("the step size of all cells").optional(),
        /// Default end of the runs [time].
        end: Option<f64> =
            number("end").positive().unit("time").doc("the end of all runs").optional(),
        /// Quantity that colours the cells.
        show: String = choice("show", &["energy growth", "iterations", "retries"])
            .or(Presence::Text("energy growth"))
            .doc("what colours the cells"),
        /// Wall-clock limit of a cell [s].
        patience: f64 = number("patience")
            .positive()
            .unit("s")
            .or(Presence::Number(60.0))
            .doc("the longest that a cell may take by the clock"),
    }
}

option_set! {
    /// The options of `study_cost`.
    pub struct CostOptions {
        /// Name of the study and its files.
        name: String = name("name").doc("of the study and its files"),
        /// Function that makes the scene.
        scene: FnPtr = callback("scene").doc("|| …, a function that makes the scene"),
        /// Step size of all rows [time].
        dt: f64 = number("dt").positive().unit("time").doc("the step size"),
        /// Map of names and functions that add a feature to a scene.
        features: Option<Dynamic> =
            anything("features").doc("names and functions: #{ gravity: |scene| … }").optional(),
        /// Integrator of all rows that do not vary it.
        integrator: Option<Method> =
            object("integrator", INTEGRATOR).doc("energy_momentum() unless given").optional(),
        /// Number of steps of each run.
        steps: usize = whole("steps").positive().or(Presence::Whole(200)).doc("of each run"),
        /// Number of timed repetitions.
        repeats: usize = whole("repeats")
            .positive()
            .or(Presence::Whole(5))
            .doc("how often each run is timed; it records every step unless the row says otherwise"),
    }
}

option_set! {
    /// Options of all studies of errors.
    pub struct ErrorOptions {
        /// Name of the study and its files.
        name: String = name("name").doc("of the study and of its files"),
        /// Function that makes the scene on a mesh.
        scene: FnPtr = callback("scene").doc("|mesh| …, makes the scene on a mesh"),
        /// Arguments of the function.
        meshes: Array = array("meshes").doc("what `scene` is called with, one by one"),
        /// Integrators.
        integrators: Array = array("integrators").doc("at least one"),
        /// Step sizes.
        dts: Array =
            array("dts").unit("time").doc("step sizes, adaptive(#{ tolerance: 1e-4 }) among them"),
        /// Times of the comparison [time].
        times: Vec<f64> =
            numbers("times").unit("time").doc("when results are compared; the last one ends a run"),
        /// Reference of the comparison.
        reference: Option<ReferenceOption> = either("reference", &[Kind::Text, Kind::Object(FINEST_RUN)])
            .doc("the name of a table, or finest_run(…), which holds unless given")
            .optional(),
        /// Map of reference columns to history columns.
        columns: Option<Dynamic> = anything("columns")
            .doc("columns of the reference that are columns of the history: #{ S: \"slider1.position\" }, or with a factor: [\"…\", 3.2]")
            .optional(),
        /// Length scale of position errors [length].
        length: Option<f64> = number("length")
            .positive()
            .unit("length")
            .doc("errors of positions are relative to it; that of the longest beam unless given")
            .optional(),
        /// Wall-clock limit of a run [s].
        patience: f64 = number("patience")
            .positive()
            .or(Presence::Number(600.0))
            .doc("seconds that one run may take; it fails when it takes more"),
    }
}

option_set! {
    /// Additional options of `study_work_precision`.
    pub struct TimedOptions {
        /// Name of a table with results of other programs.
        rivals: Option<String> =
            text("rivals").doc("the name of a table of what other programs need").optional(),
        /// Number of timed repetitions.
        repeats: usize = whole("repeats").positive().or(Presence::Whole(5)).doc(
            "how often a run is timed, with every step recorded; fewer when that takes more than 10 s",
        ),
    }
}

/// The keys of `study_work_precision`.
pub const PRECISION_KEYS: &[Parameter] = &both::<12>(ErrorOptions::KEYS, TimedOptions::KEYS);

option_set! {
    /// Options of `finest_run`.
    pub struct FinestOptions {
        /// Argument of the scene function.
        mesh: Option<Dynamic> = anything("mesh").doc("what `scene` is called with").optional(),
        /// Step size [time].
        dt: Option<f64> = number("dt").positive().unit("time").doc("its step size").optional(),
        /// Integrator.
        integrator: Option<Method> = object("integrator", INTEGRATOR).optional(),
    }
}

/// Reference requested by a script.
#[derive(Clone)]
pub enum ReferenceOption {
    /// A table file.
    Table(String),
    /// A reference run.
    Run(FinestRun),
}

impl FromOption for ReferenceOption {
    fn read(options: &Arguments, key: &str) -> Result<Self, ScriptError> {
        match options.get_if::<FinestRun>(key) {
            Some(run) => Ok(Self::Run(run)),
            None => Ok(Self::Table(options.text(key)?.into())),
        }
    }
}
