//! Cost studies of features.

use rhai::{Array, Dynamic};

use crate::analysis::{CaseOutcome, RunLimits, StepCost, step_costs};
use crate::output::Panel;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Scripted, Type};
use crate::script::bindings::parameter::options;
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, function, property};
use crate::script::messages::error::ScriptError;
use crate::script::state::settings::RunMode;
use crate::script::studies::case_runner::print_table;
use crate::script::studies::cost::{CostStepping, CostTable, cases};
use crate::script::studies::options::CostOptions;
use crate::script::studies::plan::{case_limits, study_name};

pub const TABLE: BindingTable = BindingTable {
    name: "costs",
    doc: "Cost of a step, and the additional cost of each feature of a scene.",
    types: &[COST_TABLE],
    setup: "let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\n\
            let spinning = || {\n\
            \x20   let scene = new_scene(\"example\");\n\
            \x20   scene.beam(#{ axis: line([0, 0], [2, 0]), basis: bspline(2), section: s, spin: 1 });\n\
            \x20   scene\n\
            };",
    constants: &[],
    rows: &[
        function("study_cost", &[options("options", CostOptions::KEYS)], study)
            .returns(Returns::object(COST_TABLE))
            .summary("Measures the cost of a step of a scene, alone and with features added one by \
                one.")
            .doc(
                "`scene` is a function that creates the scene; each feature is a function that \
                adds something to it. Default features: all that apply to a scene with a beam, \
                small enough to change the motion little. Further rows: no recording, \
                snapshots, and the other integrators. The scene alone is measured twice, which \
                shows the accuracy of the times. Runs are timed one at a time, without \
                building the scene; minimum and median are reported. The table is printed, \
                written to NAME.csv and plotted in NAME.svg.",
            )
            .example(
                "let costs = study_cost(#{ name: \"cost\", scene: spinning, dt: 0.05, steps: 10, repeats: 1, features: #{ gravity: |scene| scene.gravity([0, -9.81]) } });\n\
                 let rows = costs.rows;\ncheck(rows[2].feature == \"gravity\" && rows[2].unknowns == rows[0].unknowns);",
            )
            .with_related(&["rows", "study_stability", "explain"]),
        property(COST_TABLE, "rows", |call| {
            let rows = call.receiver::<CostTable>()?.rows();
            Ok(Dynamic::from(rows.into_iter().map(Dynamic::from).collect::<Array>()))
        })
        .returns(Returns::array_of(&ValueKind::Map))
        .summary(
            "Array with a map for each row: feature, outcome, shortest and median time of a \
            step in seconds, ratio to the scene alone, iterations, factorisations, unknowns, \
            half_bandwidth, border and columns.",
        )
        .example(
            "let costs = study_cost(#{ name: \"cost\", scene: spinning, dt: 0.05, steps: 10, repeats: 1, features: #{} });\n\
             check(costs.rows[1].feature == \"the same again\" && costs.rows[1].iterations == costs.rows[0].iterations);",
        ),
    ],
};

const COST_TABLE: Type = Type::of::<CostTable>();

impl Scripted for CostTable {
    const NAME: &'static str = "table of costs";
    const DOC: &'static str = "Cost of a step of a scene with different features.";

    fn show(&self) -> String {
        self.text()
    }
}

fn study(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = CostOptions::of(&call.options("options")?)?;
    let context = call.context();
    let method = options.integrator.unwrap_or_default();
    let stepping = CostStepping { method, dt: options.dt, steps: options.steps };
    let cases = cases(call, &options, stepping)?;
    let name = study_name(call, &options.name)?;
    let repeats = match context.mode() {
        RunMode::DryRun => {
            let pretended = |case| StepCost::unmeasured(case, CaseOutcome::Finished);
            let costs = cases.iter().map(pretended).collect();
            return Ok(Dynamic::from(CostTable::new(name, costs)));
        }
        RunMode::Run => context.studies().repeats.unwrap_or(options.repeats),
    };
    let limits = case_limits(call, RunLimits::default().wall.as_secs_f64());
    let costs = step_costs(&cases, limits, repeats, &mut || context.stopped_by().is_none());
    let Some(costs) = costs else {
        return Err(context.why_stopped("a study of costs"));
    };
    let table = CostTable::new(name, costs);
    print_table(context, &table.text());
    context.write_file(&format!("{}.csv", table.name()), table.records().to_text()?.as_bytes())?;
    let picture = table.chart().figure()?.to_svg()?;
    context.write_file(&format!("{}.svg", table.name()), picture.as_bytes())?;
    Ok(Dynamic::from(table))
}
