//! Work-precision studies: execution and output files.

use super::case_runner::{CaseRunner, CaseTask, print_table};
use super::options::{ErrorOptions, TimedOptions};
use super::plan::{ErrorStudyPlan, at_key};
use super::precision_chart::chart;
use super::precision_rows::{records, table};
use super::reference::{Reference, read_sheet};
use crate::analysis::{
    Case, ExternalResult, Precision, PrecisionRow, ReferenceSolution, RunResult, Timing,
    all_combinations,
};
use crate::script::bindings::call::Call;
use crate::script::messages::error::ScriptError;
use crate::script::state::settings::RunMode;

pub fn study(
    call: &Call,
    options: &ErrorOptions,
    timed: &TimedOptions,
) -> Result<Precision, ScriptError> {
    let mut plan = ErrorStudyPlan::read(call, options)?;
    let reference = Reference::read(call, options, &mut plan)?;
    let external_results = match &timed.other_programs {
        Some(file) => Some((read_sheet(call, "other_programs", file)?, file)),
        None => None,
    };
    let compared = |reference_solution: &ReferenceSolution| {
        let Some((sheet, file)) = &external_results else { return Ok(Vec::new()) };
        let by = (plan.times.as_slice(), plan.length);
        ExternalResult::of_sheet(sheet, plan.observables(), reference_solution, by).map_err(
            |error| {
                let hint = "other programs are compared at one time, at stations named as in the reference";
                at_key(call, "other_programs", format!("\"{file}\": {error}"), hint)
            },
        )
    };
    // Errors in the table of other programs are reported before any run.
    compared(&reference.placeholder(call, &plan)?)?;
    let runner = CaseRunner::open(call.context(), &plan.name)?;
    let combinations = all_combinations(&plan.subjects, &plan.all_settings());
    let cases: Vec<Case> =
        combinations.iter().map(|of| of.case(&plan.subjects, &plan.times)).collect();
    let repeats = call.context().studies().repeats.unwrap_or(timed.repeats);
    let found = match call.context().mode() {
        RunMode::DryRun => None,
        RunMode::Run => reference.trials(call, &runner, &plan, &cases)?,
    };
    let is_found = found.is_some();
    let (trials, reference_solution) = found.unwrap_or_else(|| Reference::no_trials(&cases));
    // In a study of several parts, all runs are timed when the parts are merged, because machines differ in speed.
    let timings = match is_found {
        true => timings(&runner, &plan, (&cases, &trials), repeats)?,
        false => vec![None; cases.len()],
    };
    let external_results = if is_found { compared(&reference_solution)? } else { Vec::new() };
    let judge = (plan.observables(), &reference_solution, plan.length);
    let found = combinations.iter().zip(trials).zip(timings);
    let rows = found.map(|((of, trial), timing)| {
        let mesh = plan.subjects[of.subject].mesh.clone();
        PrecisionRow::new((mesh, of.settings), trial, timing, judge)
    });
    let mut study = Precision {
        rows: rows.collect(),
        name: plan.name.clone(),
        times: plan.times.clone(),
        length: plan.length,
        observables: plan.observables().to_vec(),
        reference: reference_solution,
        external_results,
    };
    study.mark_front();
    print_table(call.context(), &table(&study));
    write(call, &study)?;
    Ok(study)
}

fn timings(
    runner: &CaseRunner,
    plan: &ErrorStudyPlan,
    (cases, trials): (&[Case], &[RunResult]),
    repeats: usize,
) -> Result<Vec<Option<Timing>>, ScriptError> {
    let is_finished = |trial: &RunResult| trial.outcome.is_finished();
    let both = cases.iter().zip(trials).filter(|(_, trial)| is_finished(trial));
    let finished: Vec<Case> = both.map(|(case, _)| case.clone()).collect();
    let task = CaseTask { name: "run times", parts: &repeats.to_le_bytes() };
    let timed = runner.run_sequentially(task, &finished, |case, may_go_on| {
        Timing::of(case, plan.limits, repeats, may_go_on)
    })?;
    let mut timed = timed.into_iter();
    let of = |trial: &RunResult| if is_finished(trial) { timed.next().flatten() } else { None };
    Ok(trials.iter().map(of).collect())
}

fn write(call: &Call, study: &Precision) -> Result<(), ScriptError> {
    let context = call.context();
    context.write_file(&format!("{}.csv", study.name), records(study).to_text()?.as_bytes())?;
    let picture = crate::output::Panel::figure(&chart(study))?.to_svg()?;
    context.write_file(&format!("{}.svg", study.name), picture.as_bytes())?;
    Ok(())
}
