//! Options of the studies: keys and typed structs.

use rhai::{Array, Dynamic, FnPtr};

use super::reference::FinestRun;
use crate::integrators::Method;
use crate::script::bindings::arguments::Arguments;
use crate::script::bindings::kind::{Kind, Type};
use crate::script::bindings::option_set::{FromOption, both, option_set};
use crate::script::bindings::parameter::{
    Parameter, Presence, array, callback, choice, either, integer, name, number, numbers, object,
    of_any_type, text,
};
use crate::script::messages::error::ScriptError;

const INTEGRATOR: Type = Type::of::<Method>();
const FINEST_RUN: Type = Type::of::<FinestRun>();

option_set! {
    pub struct StabilityOptions {
        name: String = name("name").doc("name of the study and its files"),
        scene: FnPtr = callback("scene").doc("|cell| …, a function that returns the scene of a cell"),
        rows: Dynamic = of_any_type("rows").doc("a name and its values: #{ stiffness: [1e4, 1e8] }"),
        columns: Dynamic = of_any_type("columns").doc("a name and its values: #{ dt: [0.1, 0.2] }"),
        maps: Option<Dynamic> =
            of_any_type("maps").doc("a name and its values, with one map for each").optional(),
        integrator: Option<Method> =
            object("integrator", INTEGRATOR).doc("integrator; default: energy_momentum()").optional(),
        /// Step size in a cell of the stability map, unless the values of the cell or the result of `scene` contain `dt` [time].
        dt: Option<f64> =
            number("dt").positive().unit("time").doc("step size of all cells").optional(),
        /// End time in a cell of the stability map, unless the values of the cell or the result of `scene` contain `end` [time].
        end: Option<f64> =
            number("end").positive().unit("time").doc("end time of all runs").optional(),
        /// Quantity that colours the cells.
        show: String = choice("show", &["energy growth", "iterations", "retries"])
            .or(Presence::Text("energy growth"))
            .doc("quantity shown by the colours of the cells"),
        /// Wall-clock limit of a cell [s].
        time_limit: f64 = number("time_limit")
            .positive()
            .unit("s")
            .or(Presence::Number(60.0))
            .doc("longest time of a cell by the clock"),
    }
}

option_set! {
    pub struct CostOptions {
        name: String = name("name").doc("name of the study and its files"),
        scene: FnPtr = callback("scene").doc("|| …, a function that returns the scene"),
        /// Step size of all cases of the cost study [time]. Each case is a row of the result table.
        dt: f64 = number("dt").positive().unit("time").doc("step size"),
        /// Map of names and functions that add a feature to a scene.
        features: Option<Dynamic> =
            of_any_type("features").doc("names and functions: #{ gravity: |scene| … }").optional(),
        /// Integrator of all rows of the result table, except the rows that compare other integrators.
        integrator: Option<Method> =
            object("integrator", INTEGRATOR).doc("integrator; default: energy_momentum()").optional(),
        steps: usize = integer("steps").positive().or(Presence::Integer(200)).doc("number of steps of each run"),
        repeats: usize = integer("repeats")
            .positive()
            .or(Presence::Integer(5))
            .doc("number of timed runs; every step is recorded unless the row says otherwise"),
    }
}

option_set! {
    pub struct ErrorOptions {
        name: String = name("name").doc("name of the study and its files"),
        scene: FnPtr = callback("scene").doc("|mesh| …, returns the scene on a mesh"),
        meshes: Array = array("meshes").doc("meshes, the arguments of `scene`"),
        integrators: Array = array("integrators").doc("at least one integrator"),
        dts: Array =
            array("dts").unit("time").doc("step sizes, including adaptive(#{ tolerance: 1e-4 })"),
        /// Times of the comparison [time].
        times: Vec<f64> =
            numbers("times").unit("time").doc("times at which results are compared; the last one ends a run"),
        reference: Option<ReferenceOption> = either("reference", &[Kind::Text, Kind::Object(FINEST_RUN)])
            .doc("name of a table, or finest_run(…); default: finest_run()")
            .optional(),
        columns: Option<Dynamic> = of_any_type("columns")
            .doc("columns of the reference with the columns of the history: #{ S: \
                \"slider1.position\" }, or with a factor: [\"…\", 3.2]")
            .optional(),
        /// Length scale of position errors [length].
        length: Option<f64> = number("length")
            .positive()
            .unit("length")
            .doc("length by which errors of positions are divided; default: the length of the \
                longest beam")
            .optional(),
        /// Wall-clock limit of a run [s].
        time_limit: f64 = number("time_limit")
            .positive()
            .or(Presence::Number(600.0))
            .doc("longest time of a run in seconds; longer runs fail"),
    }
}

option_set! {
    pub struct TimedOptions {
        /// Name of a table with results of other programs.
        other_programs: Option<String> =
            text("other_programs").doc("name of a table with the run times of other programs").optional(),
        repeats: usize = integer("repeats").positive().or(Presence::Integer(5)).doc(
            "number of timed runs, with every step recorded; fewer if they take more than 10 s",
        ),
    }
}

pub const PRECISION_KEYS: &[Parameter] = &both::<12>(ErrorOptions::KEYS, TimedOptions::KEYS);

option_set! {
    pub struct FinestOptions {
        mesh: Option<Dynamic> = of_any_type("mesh").doc("mesh, the argument of `scene`").optional(),
        /// Step size [time].
        dt: Option<f64> = number("dt").positive().unit("time").doc("step size").optional(),
        integrator: Option<Method> = object("integrator", INTEGRATOR).optional(),
    }
}

#[derive(Clone)]
pub enum ReferenceOption {
    Table(String),
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
