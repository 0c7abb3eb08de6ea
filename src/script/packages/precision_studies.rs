//! Work-precision studies.

use std::rc::Rc;

use rhai::{Array, Dynamic};

use crate::analysis::Precision;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Kind, NumberRange, Scripted, Type};
use crate::script::bindings::parameter::{Parameter, either, number, options};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, FunctionBinding, function, method, property};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::{as_number, format_number};
use crate::script::state::settings::RunMode;
use crate::script::studies::options::{ErrorOptions, FinestOptions, PRECISION_KEYS, TimedOptions};
use crate::script::studies::precision::study;
use crate::script::studies::precision_comparison::comparison;
use crate::script::studies::precision_rows::{map_of, table};
use crate::script::studies::reference::FinestRun;

pub const TABLE: BindingTable = BindingTable {
    name: "error against run time",
    doc: "A study runs a scene in many ways and says what they say together. withy study FILE keeps what is finished when it is \
          interrupted, and goes on there the next time.",
    types: &[PRECISION, FINEST_RUN],
    setup: SETUP,
    constants: &[],
    rows: &[
        function("study_work_precision", &[options("options", PRECISION_KEYS)], |call| {
            let options = call.options("options")?;
            let study = study(call, &ErrorOptions::of(&options)?, &TimedOptions::of(&options)?)?;
            Ok(Dynamic::from(PrecisionStudy(Rc::new(study))))
        })
        .returns(Returns::object(PRECISION))
        .summary("Runs a scene with all meshes, integrators and step sizes: the error of each, and the time it takes.")
        .doc(
            "scene is a function that makes the scene on a mesh and gives it, or #{ scene: scene, stations: #{ tip: rod.end } }; \
             without stations they are the ends of all beams and all particles. The error is the largest distance of a station \
             from the reference at the times, divided by the length. The reference is the name of a table with the columns t and, \
             for a station called tip, xtip, ytip and thtip, or finest_run(). All cases run in parallel first; then those that came \
             to their end are timed one by one. Those that fail stay, with the reason. The table is printed, written into NAME.csv and drawn into NAME.svg.",
        )
        .example(
            "let study = study_work_precision(#{\n    name: \"spinning\", scene: spinning, meshes: [bspline(2), bspline(4)],\n    \
             integrators: [energy_momentum(), fourth_order()], dts: [0.2, 0.1], times: [1], repeats: 1,\n});\n\
             check(study.rows.len() == 8);",
        )
        .see(&["finest_run", "study_convergence", "cheapest", "front"]),
        function("finest_run", &[options("options", FinestOptions::KEYS).optional()], finest_run)
            .returns(Returns::object(FINEST_RUN))
            .summary("As a reference of a study: a run of our own, marked as such in the results.")
            .doc(
                "Unless told otherwise it is made on the finest mesh of the study, with its integrator of the highest order and a \
                 quarter of its smallest step size; it must be finer than the runs that it judges. It is run with twice its step as well, and the difference is added to all errors: they are bounds, \
                 marked with ≤ where that changes their digits. No order is told of errors below twice the difference. There is none where all runs of the study have its very integrator and step size, so that \
                 errors in time are the same. Its error of the mesh is not known; errors of meshes need a finer mesh here.",
            )
            .example(
                "let study = study_work_precision(#{\n    name: \"spinning\", scene: spinning, meshes: [bspline(2), bspline(4)],\n    \
                 integrators: [energy_momentum()], dts: [0.1], times: [1], repeats: 1,\n    \
                 reference: finest_run(#{ mesh: bspline(8), integrator: fourth_order(), dt: 0.1 }),\n});\n\
                 check(study.reference.contains(\"own finest run\"));",
            )
            .see(&["study_work_precision", "study_convergence"]),
        of_study("table", |call| Ok(table(&call.receiver::<PrecisionStudy>()?.0).into()))
            .returns(Returns::TEXT)
            .summary("All combinations, mesh by mesh: errors, times, work and the drift of energy; ● marks those on the front.")
            .example("print(study.table);"),
        of_study("rows", |call| {
            let PrecisionStudy(study) = call.receiver()?;
            Ok(study.rows.iter().map(|row| map_of(&study, row).into()).collect::<Array>().into())
        })
        .returns(Returns::array_of(&ValueKind::Map))
        .summary("All combinations: mesh, integrator, dt, error, run_time, steps, energy_drift, outcome and more.")
        .example("for row in study.rows { check(row.outcome == \"finished\" && row.energy_drift < 1e-12); }"),
        of_study("front", |call| {
            let PrecisionStudy(study) = call.receiver()?;
            Ok(study.front().into_iter().map(|row| map_of(&study, row).into()).collect::<Array>().into())
        })
        .returns(Returns::array_of(&ValueKind::Map))
        .summary("The combinations that are worth their time: none is both faster and better. The fastest comes first.")
        .example("check(study.front[0].on_front);")
        .see(&["cheapest"]),
        of_study("reference", |call| Ok(call.receiver::<PrecisionStudy>()?.0.truth.source.clone().into()))
            .returns(Returns::TEXT)
            .summary("What the errors are measured against.")
            .example("print(study.reference);"),
        method(PRECISION, "cheapest", &[ERRORS], cheapest)
            .returns(Returns::one_of(&[ValueKind::Map, ValueKind::Nothing, ValueKind::Text]).words("a map, () or a text"))
            .summary("The fastest combination with at most this error; of several errors a table, with rivals beside.")
            .doc("For one error it is a map such as those of rows, or () when no combination is so good.")
            .example("let best = study.cheapest(0.5);\nprint(best.run_time);\nprint(study.cheapest([0.5, 0.01]));")
            .see(&["front", "cheapest_confirmed"]),
        method(PRECISION, "cheapest_confirmed", &[ERROR], |call| {
            let PrecisionStudy(study) = call.receiver()?;
            let found = study.cheapest_confirmed(call.number("error")?);
            Ok(found.map_or(Dynamic::UNIT, |row| map_of(&study, row).into()))
        })
        .returns(Returns::one_of(&[ValueKind::Map, ValueKind::Nothing]).words("a map or ()"))
        .summary("The fastest combination with at most this error of which all smaller steps on its mesh err no more.")
        .doc("Errors of mesh and step may cancel; what smaller steps contradict is right by luck. () where there is none.")
        .example("print(study.cheapest_confirmed(0.5));")
        .see(&["cheapest"]),
    ],
};

const PRECISION: Type = Type::of::<PrecisionStudy>();
const FINEST_RUN: Type = Type::of::<FinestRun>();

const SETUP: &str = "let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\n\
    let spinning = |mesh| {\n    let scene = new_scene(\"spinning\");\n    \
    scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: mesh, section: s, spin: 1 });\n    scene\n};\n\
    let study = study_work_precision(#{ name: \"first\", scene: spinning, meshes: [bspline(2)], \
    integrators: [energy_momentum()], dts: [0.1], times: [1], repeats: 1 });";

const ERRORS: Parameter = either("error", &[Kind::Number(NumberRange::Positive), Kind::Numbers])
    .doc("an error, or several");

const ERROR: Parameter = number("error").positive().doc("an error");

const fn of_study(
    name: &'static str,
    body: crate::script::bindings::table::NativeFunction,
) -> FunctionBinding {
    property(PRECISION, name, body)
}

#[derive(Clone)]
struct PrecisionStudy(Rc<Precision>);

impl Scripted for PrecisionStudy {
    const NAME: &'static str = "precision study";
    const DOC: &'static str = "Error against run time of many ways to compute the same.";

    fn show(&self) -> String {
        let Precision { name, rows, .. } = &*self.0;
        let finished = rows.iter().filter(|row| row.trial.outcome.is_finished()).count();
        let front = self.0.front().len();
        format!(
            "study '{name}': {finished} of {} combinations finished, {front} on the front",
            rows.len()
        )
    }

    fn details(&self) -> Details {
        vec![("reference".to_owned(), self.0.truth.source.clone())]
    }
}

fn finest_run(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = FinestOptions::of(&call.options_or_defaults("options")?)?;
    let FinestOptions { mesh, dt, integrator } = options;
    Ok(Dynamic::from(FinestRun { mesh, dt, method: integrator }))
}

fn cheapest(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let PrecisionStudy(study) = call.receiver()?;
    let Some(error) = as_number(&call.value("error")?) else {
        let errors = call.numbers("error")?;
        return match errors.iter().find(|error| **error <= 0.0) {
            Some(wrong) => Err(call
                .error(format!("error holds {}", format_number(*wrong)))
                .hint("errors are positive numbers")
                .at(CallPart::Argument(0))),
            None => Ok(comparison(&study, &errors).into()),
        };
    };
    // In a dry build a placeholder row is returned, because no row has run.
    let pretended = study.rows.first().filter(|_| call.context().mode() == RunMode::DryBuild);
    let row = pretended.or_else(|| study.cheapest(error));
    Ok(row.map_or(Dynamic::UNIT, |row| map_of(&study, row).into()))
}
