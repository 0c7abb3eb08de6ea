//! What may be said of studies: the keys of their options, and the values that they are read into.

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
        /// The name of the study and of its files.
        name: String = name("name").doc("of the study and its files"),
        /// Makes what is run in a cell.
        scene: FnPtr = callback("scene").doc("|cell| …, a function that makes the scene of a cell"),
        /// A map of a name and its values.
        rows: Dynamic = anything("rows").doc("a name and its values: #{ stiffness: [1e4, 1e8] }"),
        /// A map of a name and its values.
        columns: Dynamic = anything("columns").doc("a name and its values: #{ dt: [0.1, 0.2] }"),
        /// A map of a name and its values.
        maps: Option<Dynamic> =
            anything("maps").doc("a name and its values, one map for each").optional(),
        /// For cells that do not say.
        integrator: Option<Method> =
            object("integrator", INTEGRATOR).doc("energy_momentum() unless given").optional(),
        /// For cells that do not say [time].
        dt: Option<f64> =
            number("dt").positive().unit("time").doc("the step size of all cells").optional(),
        /// For cells that do not say [time].
        end: Option<f64> =
            number("end").positive().unit("time").doc("the end of all runs").optional(),
        /// What colours the cells, in words.
        show: String = choice("show", &["energy growth", "iterations", "retries"])
            .or(Presence::Text("energy growth"))
            .doc("what colours the cells"),
        /// How long a cell may take [s].
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
        /// The name of the study and of its files.
        name: String = name("name").doc("of the study and its files"),
        /// Makes the scene.
        scene: FnPtr = callback("scene").doc("|| …, a function that makes the scene"),
        /// Of all rows [time].
        dt: f64 = number("dt").positive().unit("time").doc("the step size"),
        /// A map of names and functions that add something to a scene.
        features: Option<Dynamic> =
            anything("features").doc("names and functions: #{ gravity: |scene| … }").optional(),
        /// Of all rows that are not about integrators.
        integrator: Option<Method> =
            object("integrator", INTEGRATOR).doc("energy_momentum() unless given").optional(),
        /// Of each run.
        steps: usize = whole("steps").positive().or(Presence::Whole(200)).doc("of each run"),
        /// How often each run is timed.
        repeats: usize = whole("repeats")
            .positive()
            .or(Presence::Whole(5))
            .doc("how often each run is timed; it records every step unless the row says otherwise"),
    }
}

option_set! {
    /// The options of all studies of errors.
    pub struct ErrorOptions {
        /// The name of the study and of its files.
        name: String = name("name").doc("of the study and of its files"),
        /// Makes the scene on a mesh.
        scene: FnPtr = callback("scene").doc("|mesh| …, makes the scene on a mesh"),
        /// What the function is called with.
        meshes: Array = array("meshes").doc("what `scene` is called with, one by one"),
        /// The integrators.
        integrators: Array = array("integrators").doc("at least one"),
        /// The step sizes.
        dts: Array =
            array("dts").unit("time").doc("step sizes, adaptive(#{ tolerance: 1e-4 }) among them"),
        /// When results are compared [time].
        times: Vec<f64> =
            numbers("times").unit("time").doc("when results are compared; the last one ends a run"),
        /// What results are compared with.
        reference: Option<ReferenceOption> = either("reference", &[Kind::Text, Kind::Object(FINEST_RUN)])
            .doc("the name of a table, or finest_run(…), which holds unless given")
            .optional(),
        /// A map of columns of the reference and what they are here.
        columns: Option<Dynamic> = anything("columns")
            .doc("columns of the reference that are columns of the history: #{ S: \"slider1.position\" }, or with a factor: [\"…\", 3.2]")
            .optional(),
        /// What errors of positions are relative to [length].
        length: Option<f64> = number("length")
            .positive()
            .unit("length")
            .doc("errors of positions are relative to it; that of the longest beam unless given")
            .optional(),
        /// How long a run may take [s].
        patience: f64 = number("patience")
            .positive()
            .or(Presence::Number(600.0))
            .doc("seconds that one run may take; it fails when it takes more"),
    }
}

option_set! {
    /// The options of `study_work_precision`, besides those of all studies of errors.
    pub struct TimedOptions {
        /// The name of a table.
        rivals: Option<String> =
            text("rivals").doc("the name of a table of what other programs need").optional(),
        /// How often each run is timed.
        repeats: usize = whole("repeats").positive().or(Presence::Whole(5)).doc(
            "how often a run is timed, with every step recorded; fewer when that takes more than 10 s",
        ),
    }
}

/// The keys of `study_work_precision`.
pub const PRECISION_KEYS: &[Parameter] = &both::<12>(ErrorOptions::KEYS, TimedOptions::KEYS);

option_set! {
    /// The options of `finest_run`.
    pub struct FinestOptions {
        /// What the function of the study makes the scene of.
        mesh: Option<Dynamic> = anything("mesh").doc("what `scene` is called with").optional(),
        /// [time]
        dt: Option<f64> = number("dt").positive().unit("time").doc("its step size").optional(),
        /// The integrator.
        integrator: Option<Method> = object("integrator", INTEGRATOR).optional(),
    }
}

/// What a script wants results to be compared with.
#[derive(Clone)]
pub enum ReferenceOption {
    /// The table of this name.
    Table(String),
    /// A run of our own.
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
