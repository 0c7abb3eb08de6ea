//! Convergence studies: execution, output files, and conversion to script maps.

use rhai::{Dynamic, Map};

use super::case_runner::{CaseRunner, print_table};
use super::convergence_chart::chart;
use super::convergence_table::{head, summary};
use super::labels;
use super::options::ErrorOptions;
use super::plan::{ErrorStudyPlan, at_key};
use super::reference::{self, Reference};
use crate::analysis::{
    ALL_POSITIONS, Case, Convergence, RefinedParameter, Refinement, RunResult, all_combinations,
};
use crate::integrators::Method;
use crate::output::{CsvRecords, Panel, format_number};
use crate::script::bindings::call::Call;
use crate::script::messages::error::ScriptError;
use crate::script::state::settings::RunMode;
use crate::simulation::{SimulationSettings, StepSize};

pub fn study(call: &Call, options: &ErrorOptions) -> Result<Convergence, ScriptError> {
    let mut plan = ErrorStudyPlan::read(call, options)?;
    let refined = refined(call, &plan)?;
    let reference = Reference::read(call, options, &mut plan)?;
    if plan.subjects.len() > 1 {
        reference::expect_finer_than_all_meshes(call, options.reference.as_ref())?;
    }
    let runner = CaseRunner::open(call.context(), &plan.name)?;
    let combinations = all_combinations(&plan.subjects, &plan.all_settings());
    let cases: Vec<Case> =
        combinations.iter().map(|of| of.case(&plan.subjects, &plan.times)).collect();
    let found = match call.context().mode() {
        RunMode::DryRun => None,
        RunMode::Run => reference.trials(call, &runner, &plan, &cases)?,
    };
    let (trials, reference_solution) = found.unwrap_or_else(|| Reference::no_trials(&cases));
    let size = |subject: usize, settings: &SimulationSettings| match refined {
        RefinedParameter::Step => match settings.dt {
            StepSize::Fixed(dt) => dt,
            StepSize::Adaptive(control) => control.tolerance,
        },
        RefinedParameter::Mesh => 1.0 / plan.subjects[subject].spans().max(1) as f64,
    };
    let (mut ladders, mut failures) = (Vec::new(), Vec::new());
    for method in &plan.methods {
        let of_method =
            combinations.iter().zip(&trials).filter(|(of, _)| of.settings.method == *method);
        let mut rungs: Vec<(f64, RunResult)> =
            of_method.map(|(of, trial)| (size(of.subject, &of.settings), trial.clone())).collect();
        rungs.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (size, trial) in rungs.iter().filter(|(_, trial)| !trial.outcome.is_finished()) {
            failures.push((*size, *method, trial.outcome.describe()));
        }
        let by = (plan.observables(), &reference_solution, plan.length);
        ladders.extend(Convergence::ladders_of(*method, &rungs, by));
    }
    let fixed = match refined {
        RefinedParameter::Step => plan.subjects[0].mesh.clone(),
        RefinedParameter::Mesh => format!("dt = {}", labels::step_size(&plan.all_settings()[0])),
    };
    let (name, times, length) = (plan.name, plan.times, plan.length);
    let study = Convergence {
        name,
        refined,
        fixed,
        times,
        length,
        reference: reference_solution,
        ladders,
        failures,
    };
    print_table(call.context(), &summary(&study));
    write(call, &study)?;
    Ok(study)
}

/// Refined quantity, step or mesh. The other quantity must have a single value.
fn refined(call: &Call, plan: &ErrorStudyPlan) -> Result<RefinedParameter, ScriptError> {
    let is_adaptive = |dt: &StepSize| matches!(dt, StepSize::Adaptive(_));
    if plan.dts.len() > 1 && plan.dts.iter().any(is_adaptive) {
        let hint = "orders need fixed step sizes; study_work_precision also accepts adaptive steps";
        return Err(at_key(call, "dts", "adaptive steps have no size to refine", hint));
    }
    match (plan.subjects.len(), plan.dts.len()) {
        (1, 2..) => Ok(RefinedParameter::Step),
        (2.., 1) => Ok(RefinedParameter::Mesh),
        (meshes, dts) => {
            let message = format!("{meshes} mesh(es) and {dts} step size(s) are given");
            let hint = "give several step sizes and one mesh, or several meshes and one step size";
            Err(at_key(call, "dts", message, hint))
        }
    }
}

fn write(call: &Call, study: &Convergence) -> Result<(), ScriptError> {
    let context = call.context();
    context.write_file(&format!("{}.csv", study.name), records(study).to_text()?.as_bytes())?;
    let picture = chart(study, ALL_POSITIONS).figure()?.to_svg()?;
    context.write_file(&format!("{}.svg", study.name), picture.as_bytes())?;
    Ok(())
}

pub(super) fn size_name(study: &Convergence) -> &'static str {
    match study.refined {
        RefinedParameter::Step => "dt",
        RefinedParameter::Mesh => "1 / spans",
    }
}

fn records(study: &Convergence) -> CsvRecords {
    let names = ["quantity", "integrator", size_name(study), "error", "is_resolved", "order"];
    let number = |value: Option<f64>| value.map_or_else(String::new, format_number);
    let rows = study.ladders.iter().flat_map(|ladder| {
        ladder.sizes.iter().enumerate().map(move |(rung, size)| {
            let resolved = ladder.deviations[rung].map(|of| of.is_resolved().to_string());
            vec![
                ladder.quantity.clone(),
                labels::method(&ladder.method),
                format_number(*size),
                number(ladder.error(rung)),
                resolved.unwrap_or_default(),
                number(ladder.order(rung)),
            ]
        })
    });
    let units = format!(
        "errors of positions relative to length {}, others in their own unit",
        study.length
    );
    CsvRecords {
        comments: head(study).lines().map(str::to_owned).chain([units]).collect(),
        names: names.map(str::to_owned).to_vec(),
        rows: rows.collect(),
    }
}

pub fn map_of(study: &Convergence, ladder: &Refinement) -> Map {
    let array = |values: Vec<f64>| -> Dynamic {
        values.into_iter().map(Dynamic::from).collect::<rhai::Array>().into()
    };
    let rungs = 0..ladder.sizes.len();
    let or_nan = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let claimed = study.claimed_order(&ladder.method).map(f64::from);
    let facts: [(&str, Dynamic); 7] = [
        ("quantity", ladder.quantity.clone().into()),
        ("integrator", labels::method(&ladder.method).into()),
        ("sizes", array(ladder.sizes.clone())),
        ("errors", array(rungs.clone().map(|rung| or_nan(ladder.error(rung))).collect())),
        ("orders", array(rungs.skip(1).map(|rung| or_nan(ladder.order(rung))).collect())),
        ("order", or_nan(ladder.fitted_order()).into()),
        ("claimed", or_nan(claimed).into()),
    ];
    facts.into_iter().map(|(name, value)| (name.into(), value)).collect()
}

pub fn expect_quantity(
    call: &Call,
    study: &Convergence,
    quantity: &str,
) -> Result<(), ScriptError> {
    let known = study.quantities();
    if known.contains(&quantity) || call.context().mode() == RunMode::DryRun {
        return Ok(());
    }
    let message = format!("the study '{}' has no quantity \"{quantity}\"", study.name);
    Err(call.error(message).hint(format!("quantities: {}", known.join(", "))))
}

/// Errors of a quantity with an integrator; `None` in a dry run.
///
/// # Errors
/// Fails, with the known names, if the quantity or integrator is not in the study.
pub fn find<'s>(
    call: &Call,
    study: &'s Convergence,
    quantity: &'s str,
    method: &Method,
) -> Result<Option<&'s Refinement>, ScriptError> {
    expect_quantity(call, study, quantity)?;
    if !study.ladders.iter().any(|of| of.method == *method) {
        let message =
            format!("the study '{}' has no runs with {}", study.name, labels::method(method));
        let mut known: Vec<String> =
            study.ladders.iter().map(|of| labels::method(&of.method)).collect();
        known.dedup();
        return Err(call.error(message).hint(format!("integrators: {}", known.join(", "))));
    }
    Ok(study.ladders_with(quantity).find(|of| of.method == *method))
}
