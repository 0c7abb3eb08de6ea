//! Work–precision studies.

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
    doc: "Studies of error against run time. withy study FILE saves finished runs when it is \
        interrupted, and continues from them the next time.",
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
        .summary("Runs a scene with all meshes, integrators and step sizes, and measures the error \
            and the run time of each combination.")
        .doc(
            "scene is a function of a mesh that returns the scene, or #{ scene: scene, \
            stations: #{ tip: rod.end } }; default stations: the ends of all beams and all \
            particles. The error is the largest distance of a station from the reference at \
            the times, divided by the length. The reference is the name of a table with the \
            columns t and, for a station called tip, xtip, ytip and thtip, or finest_run(). \
            All cases first run in parallel; then finished runs are timed one by one. Failed \
            runs stay in the table with the reason. The table is printed, written to NAME.csv \
            and plotted in NAME.svg.",
        )
        .example(
            "let study = study_work_precision(#{\n    name: \"spinning\", scene: spinning, meshes: [bspline(2), bspline(4)],\n    \
             integrators: [energy_momentum(), fourth_order()], dts: [0.2, 0.1], times: [1], repeats: 1,\n});\n\
             check(study.rows.len() == 8);",
        )
        .with_related(&["finest_run", "study_convergence", "cheapest", "front"]),
        function("finest_run", &[options("options", FinestOptions::KEYS).optional()], finest_run)
            .returns(Returns::object(FINEST_RUN))
            .summary("Creates a reference of a study by a fine run, which the results mark as such.")
            .doc(
                "Defaults: the finest mesh of the study, its integrator of the highest order \
                and a quarter of its smallest step size. The reference must be finer than the \
                runs it is compared with. It is also run with twice its step, and the \
                difference is added to all errors: they are bounds, marked with ≤ where this \
                changes their digits. Errors below twice the difference have no order. No such \
                run is needed if all runs of the study have the integrator and step size of \
                the reference, because the time errors are then equal. The mesh error of the \
                reference is unknown; to measure mesh errors give a finer mesh here.",
            )
            .example(
                "let study = study_work_precision(#{\n    name: \"spinning\", scene: spinning, meshes: [bspline(2), bspline(4)],\n    \
                 integrators: [energy_momentum()], dts: [0.1], times: [1], repeats: 1,\n    \
                 reference: finest_run(#{ mesh: bspline(8), integrator: fourth_order(), dt: 0.1 }),\n});\n\
                 check(study.reference.contains(\"own finest run\"));",
            )
            .with_related(&["study_work_precision", "study_convergence"]),
        of_study("table", |call| Ok(table(&call.receiver::<PrecisionStudy>()?.0).into()))
            .returns(Returns::TEXT)
            .summary("Table of all combinations, mesh by mesh: errors, times, work and the drift of \
                energy; ● marks those on the front.")
            .example("print(study.table);"),
        of_study("rows", |call| {
            let PrecisionStudy(study) = call.receiver()?;
            Ok(study.rows.iter().map(|row| map_of(&study, row).into()).collect::<Array>().into())
        })
        .returns(Returns::array_of(&ValueKind::Map))
        .summary("Array with a map for each combination: mesh, integrator, dt, error, run_time, \
            steps, energy_drift, outcome and more.")
        .example("for row in study.rows { check(row.outcome == \"finished\" && row.energy_drift < 1e-12); }"),
        of_study("front", |call| {
            let PrecisionStudy(study) = call.receiver()?;
            Ok(study.front().into_iter().map(|row| map_of(&study, row).into()).collect::<Array>().into())
        })
        .returns(Returns::array_of(&ValueKind::Map))
        .summary("Array of the Pareto-optimal combinations, for which no other one is both faster \
            and more accurate, the fastest first.")
        .example("check(study.front[0].on_front);")
        .with_related(&["cheapest"]),
        of_study("reference", |call| Ok(call.receiver::<PrecisionStudy>()?.0.reference.source.clone().into()))
            .returns(Returns::TEXT)
            .summary("Description of the reference of the errors.")
            .example("print(study.reference);"),
        method(PRECISION, "cheapest", &[ERRORS], cheapest)
            .returns(Returns::one_of(&[ValueKind::Map, ValueKind::Nothing, ValueKind::Text]).with_description("a map, () or a text"))
            .summary("Returns the fastest combination with at most this error; for several errors a \
                table, with the other programs of the option other_programs for comparison.")
            .doc("For one error the result is a map like those of rows, or () if no combination \
                reaches the error.")
            .example("let best = study.cheapest(0.5);\nprint(best.run_time);\nprint(study.cheapest([0.5, 0.01]));")
            .with_related(&["front", "cheapest_confirmed"]),
        method(PRECISION, "cheapest_confirmed", &[ERROR], |call| {
            let PrecisionStudy(study) = call.receiver()?;
            let found = study.cheapest_confirmed(call.number("error")?);
            Ok(found.map_or(Dynamic::UNIT, |row| map_of(&study, row).into()))
        })
        .returns(Returns::one_of(&[ValueKind::Map, ValueKind::Nothing]).with_description("a map or ()"))
        .summary("Returns the fastest combination with at most this error for which all smaller \
            steps on its mesh have no larger error.")
        .doc("Errors of mesh and step size can cancel; a small error that smaller steps do not \
            confirm is a coincidence. The result is () if there is no such combination.")
        .example("print(study.cheapest_confirmed(0.5));")
        .with_related(&["cheapest"]),
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
    .doc("an error, or an array of errors");

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
    const DOC: &'static str =
        "Error against run time of many combinations of mesh, integrator and step size.";

    fn show(&self) -> String {
        let Precision { name, rows, .. } = &*self.0;
        let finished = rows.iter().filter(|row| row.result.outcome.is_finished()).count();
        let front = self.0.front().len();
        format!(
            "study '{name}': {finished} of {} combinations finished, {front} on the front",
            rows.len()
        )
    }

    fn details(&self) -> Details {
        vec![("reference".to_owned(), self.0.reference.source.clone())]
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
                .hint("errors must be positive numbers")
                .at(CallPart::Argument(0))),
            None => Ok(comparison(&study, &errors).into()),
        };
    };
    let pretended = study.rows.first().filter(|_| call.context().mode() == RunMode::DryRun);
    let row = pretended.or_else(|| study.cheapest(error));
    Ok(row.map_or(Dynamic::UNIT, |row| map_of(&study, row).into()))
}
