//! Stability maps.

use rhai::{Array, Dynamic};

use crate::analysis::{Case, CaseOutcome, StabilityVerdict};
use crate::output::Panel;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Scripted, Type};
use crate::script::bindings::parameter::options;
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, function, property};
use crate::script::messages::error::ScriptError;
use crate::script::state::settings::RunMode;
use crate::script::studies::case_runner::{CaseRunner, CaseTask, print_table};
use crate::script::studies::options::StabilityOptions;
use crate::script::studies::plan::case_limits;
use crate::script::studies::stability::{MapColouring, StabilityMap, StabilityPlan};

pub const TABLE: BindingTable = BindingTable {
    name: "stability maps",
    doc: "Stability maps: runs for every combination of parameters, on all cores.",
    types: &[STABILITY_MAP],
    setup: "let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\n\
            let spinning = |cell| {\n\
            \x20   let scene = new_scene(\"example\");\n\
            \x20   scene.beam(#{ axis: line([0, 0], [2, 0]), basis: bspline(2), section: s, spin: 1 });\n\
            \x20   scene\n\
            };",
    constants: &[],
    rows: &[
        function("study_stability", &[options("options", StabilityOptions::KEYS)], study)
            .returns(Returns::object(STABILITY_MAP))
            .summary("Runs a scene for all combinations of parameters and shows which runs finish, \
                and in which the energy grows.")
            .doc(
                "`scene` is a function of a map with the values of a cell by name. It returns a \
                scene, or a map with settings of the simulation: #{ scene: scene, dt: 0.1, \
                end: 5, integrator: trapezoidal() }. Missing settings are taken from the \
                values of the cell, then from the options of the study. An exception of the \
                function is the outcome of the cell. The energy growth of a cell is the \
                largest rise of E - W above an earlier value after the last kink or jump of \
                the schedules, relative to the largest energy. The maps are printed, plotted \
                in NAME.svg and written to NAME.csv. Labels are numbers, texts, names of \
                integrators, or the key `name` of a map.",
            )
            .example(
                "let map = study_stability(#{\n    name: \"spin\", scene: spinning, end: 0.5,\n    rows: #{ dt: [0.05, 0.1] },\n    columns: #{ integrator: [energy_momentum(), trapezoidal()] },\n});\n\
                 check(map.cells.all(|cell| cell.finished));\ncheck(map.cells[0].energy_growth < 1e-12);",
            )
            .with_related(&["cells", "study_cost"]),
        property(STABILITY_MAP, "cells", |call| {
            let cells = call.receiver::<StabilityMap>()?.cells();
            Ok(Dynamic::from(cells.into_iter().map(Dynamic::from).collect::<Array>()))
        })
        .returns(Returns::array_of(&ValueKind::Map))
        .summary("Array with a map for each cell: its values, and finished, outcome, energy_growth, \
            iterations, most_iterations, retries and steps.")
        .example(
            "let map = study_stability(#{ name: \"spin\", scene: spinning, end: 1, rows: #{ dt: [0.1] }, columns: #{ integrator: [fourth_order()] } });\n\
             check(map.cells.len() == 1 && map.cells[0].steps == 10 && map.cells[0].dt == 0.1);",
        ),
    ],
};

const STABILITY_MAP: Type = Type::of::<StabilityMap>();

impl Scripted for StabilityMap {
    const NAME: &'static str = "stability map";
    const DOC: &'static str = "Outcomes of runs for every combination of parameters.";

    fn show(&self) -> String {
        let (all, finished) = self.counts();
        format!("stability map '{}': {finished} of {all} cells finished", self.name())
    }
}

fn study(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = StabilityOptions::of(&call.options("options")?)?;
    call.expect_arguments(
        &options.scene,
        1,
        "|cell| …, a function that makes the scene of a cell",
    )?;
    let plan = StabilityPlan::read(call, &options)?;
    let made = plan.cases(call, &options)?;
    let context = call.context();
    let limits = case_limits(call, options.time_limit);
    let shown = MapColouring::ALL.iter().find(|(name, _)| *name == options.show);
    let shown = shown.map_or(MapColouring::EnergyGrowth, |(_, shown)| *shown);
    let runner = CaseRunner::open(context, &plan.name)?;
    let verdicts = match context.mode() {
        RunMode::DryRun => {
            vec![StabilityVerdict::not_started(CaseOutcome::Finished); made.len()]
        }
        RunMode::Run => {
            let task = CaseTask { name: "cells", parts: &[] };
            let work = |case: &_, stop: &_| StabilityVerdict::of(case, limits, stop);
            let cases: Vec<Case> = made.iter().flatten().cloned().collect();
            let verdicts = runner.in_parallel(
                task,
                &cases,
                |verdict: &StabilityVerdict| verdict.steps,
                work,
            )?;
            let pretended =
                || vec![Ok(StabilityVerdict::not_started(CaseOutcome::Finished)); cases.len()];
            let verdicts = verdicts.unwrap_or_else(pretended);
            let panicked =
                |message| StabilityVerdict::not_started(CaseOutcome::Panicked { message });
            let mut ran = verdicts.into_iter().map(|verdict| verdict.unwrap_or_else(panicked));
            let of = |made: Result<Case, String>| match made {
                Ok(_) => ran.next(),
                Err(reason) => {
                    Some(StabilityVerdict::not_started(CaseOutcome::Failed { time: 0.0, reason }))
                }
            };
            made.into_iter().filter_map(of).collect()
        }
    };
    let map = plan.judged(shown, verdicts);
    print_table(context, &map.text());
    context.write_file(&format!("{}.csv", map.name()), map.records().to_text()?.as_bytes())?;
    let picture = map.page().figure()?.to_svg()?;
    context.write_file(&format!("{}.svg", map.name()), picture.as_bytes())?;
    Ok(Dynamic::from(map))
}
