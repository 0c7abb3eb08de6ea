//! Execution of study cases, with progress, limits, and an optional journal.

use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::analysis::{
    Case, CaseOutcome, Journal, RunResult, StabilityVerdict, Timing, on_all_cores,
};
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;
use crate::script::state::journals::{JournalLifetime, JournalNumber};
use crate::script::state::parts::find_parts;
use crate::script::state::settings::RunMode;

pub trait CaseResult: Serialize + DeserializeOwned {
    fn is_final(&self) -> bool;
}

impl CaseResult for RunResult {
    fn is_final(&self) -> bool {
        !matches!(self.outcome, CaseOutcome::LimitExceeded { .. })
    }
}

impl CaseResult for StabilityVerdict {
    fn is_final(&self) -> bool {
        !matches!(self.outcome, CaseOutcome::LimitExceeded { .. })
    }
}

impl CaseResult for Option<Timing> {
    fn is_final(&self) -> bool {
        self.is_some()
    }
}

pub fn print_table(context: &Context, table: &str) {
    if context.mode() == RunMode::Run {
        context.print(table);
        context.print("");
    }
}

pub struct CaseRunner<'c> {
    context: &'c Context,
    name: String,
    journal: Option<JournalNumber>,
}

#[derive(Clone, Copy)]
pub struct CaseTask<'t> {
    pub name: &'t str,
    /// Serialised data on which the results depend, in addition to the cases.
    pub parts: &'t [u8],
}

impl CaseTask<'_> {
    /// Fingerprint of a case and of the type of computation; `None` if the case cannot be serialised.
    fn fingerprint(&self, case: &Case) -> Option<u64> {
        Some(Journal::fingerprint(&[self.name.as_bytes(), self.parts, &case.to_bytes()?]))
    }
}

impl<'c> CaseRunner<'c> {
    /// Starts a study, and opens its journal if requested, or the journals of the parts that are merged. `name` is also the name of its files.
    ///
    /// # Errors
    /// Fails if the name is not valid for a file in the output folder, if a merged part is missing, or if a journal cannot be read.
    pub fn open(context: &'c Context, name: &str) -> Result<Self, ScriptError> {
        let options = context.studies();
        let path = |file: String| context.output().path_of(&file);
        let journal = match (options.part, options.merge.as_slice()) {
            (Some(part), _) => {
                let kept = (options.journal, JournalLifetime::Persistent);
                context.journals().open(path(part.file(name))?, kept)?
            }
            (None, []) => {
                let kept = (options.journal, JournalLifetime::Run);
                context.journals().open(path(format!("{name}.journal"))?, kept)?
            }
            (None, _) if context.mode() == RunMode::DryRun => None,
            (None, folders) => {
                let files = find_parts(name, folders)?.into_iter().map(|(_, file)| file);
                Some(context.journals().open_parts(files)?)
            }
        };
        Ok(Self { context, name: name.to_owned(), journal })
    }

    /// Computes all cases that are not in the journal, in parallel. A panic affects only its case.
    /// `steps_of` returns the number of steps of a result, which count towards the limits of the run.
    /// If the run computes a part of the study, the result is `None` after computing this part.
    ///
    /// # Errors
    /// Fails if the run is stopped, if the journal cannot be written, or if a case is missing in all merged parts.
    /// After a stop, finished cases are in the journal.
    pub fn in_parallel<R: CaseResult + Clone + Send>(
        &self,
        task: CaseTask,
        cases: &[Case],
        steps_of: fn(&R) -> usize,
        work: impl Fn(&Case, &AtomicBool) -> R + Sync,
    ) -> Result<Option<Vec<Result<R, String>>>, ScriptError> {
        let Some(part) = self.context.studies().part else {
            return self.all_in_parallel(task, cases, steps_of, work).map(Some);
        };
        let is_own = |(at, case): &(usize, &Case)| part.has(*at) && case.to_bytes().is_some();
        let own: Vec<Case> =
            cases.iter().enumerate().filter(is_own).map(|(_, case)| case.clone()).collect();
        self.all_in_parallel(task, &own, steps_of, work).map(|_| None)
    }

    fn all_in_parallel<R: CaseResult + Clone + Send>(
        &self,
        task: CaseTask,
        cases: &[Case],
        steps_of: fn(&R) -> usize,
        work: impl Fn(&Case, &AtomicBool) -> R + Sync,
    ) -> Result<Vec<Result<R, String>>, ScriptError> {
        let mut results: Vec<_> =
            cases.iter().map(|case| self.recall(task, case).map(Ok)).collect();
        self.expect_parts(task, cases, &results)?;
        let unknown: Vec<usize> = (0..cases.len()).filter(|at| results[*at].is_none()).collect();
        let known = cases.len() - unknown.len();
        self.report_known(task, known, cases.len());
        self.context.progress().begin_cases(&self.name, cases.len());
        let asked: Vec<Case> = unknown.iter().map(|at| cases[*at].clone()).collect();
        let (mut done, mut write_error) = (known, None);
        let context = self.context;
        let stop = AtomicBool::new(false);
        let found = on_all_cores(
            &asked,
            &stop,
            |case| work(case, &stop),
            |completed| {
                if let Some((number, result)) = completed {
                    done += 1;
                    context.progress().report_case(done);
                    if let Ok(result) = result {
                        context.meter().count_steps(steps_of(result));
                        write_error = self.write(task, &asked[number], result).err();
                    }
                }
                let has_steps = done == cases.len() || context.meter().allows_a_step();
                let may_go_on =
                    write_error.is_none() && has_steps && context.stopped_by().is_none();
                if may_go_on { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            },
        );
        context.progress().end();
        write_error.map_or(Ok(()), Err)?;
        for (at, result) in unknown.into_iter().zip(found) {
            results[at] = result;
        }
        let all: Option<Vec<_>> = results.into_iter().collect();
        all.ok_or_else(|| match context.proceed() {
            Err(stopped) => stopped,
            Ok(()) => ScriptError::internal_error("a study lost a case"),
        })
    }

    /// Computes the cases that are not in the journal one by one on this thread, for timing.
    /// `work` receives a function that returns false if the case must stop.
    ///
    /// # Errors
    /// Fails if the run is stopped or the journal cannot be written. Finished cases are then in the journal.
    pub fn run_sequentially<R: CaseResult>(
        &self,
        task: CaseTask,
        cases: &[Case],
        mut work: impl FnMut(&Case, &mut dyn FnMut() -> bool) -> R,
    ) -> Result<Vec<R>, ScriptError> {
        let context = self.context;
        context.progress().begin_cases(&format!("{}, {}", self.name, task.name), cases.len());
        let results = cases.iter().enumerate().map(|(number, case)| {
            context.progress().report_case(number);
            if let Some(known) = self.recall(task, case) {
                return Ok(known);
            }
            let found = work(case, &mut || context.stopped_by().is_none());
            context.proceed()?;
            self.write(task, case, &found)?;
            Ok(found)
        });
        let results = results.collect();
        // The progress bar is ended before an error is reported.
        context.progress().end();
        results
    }

    fn expect_parts<R>(
        &self,
        task: CaseTask,
        cases: &[Case],
        results: &[Option<R>],
    ) -> Result<(), ScriptError> {
        if self.context.studies().merge.is_empty() {
            return Ok(());
        }
        let missing = cases
            .iter()
            .zip(results)
            .filter(|(case, found)| found.is_none() && task.fingerprint(case).is_some());
        match (missing.count(), cases.len()) {
            (0, _) => Ok(()),
            (missing, all) => {
                let (name, what) = (&self.name, task.name);
                let message = format!(
                    "of the {all} {what} of the study '{name}' {missing} are missing in all \
                        parts"
                );
                Err(ScriptError::new(message).hint(
                    "these parts are of another script or another build of withy, or not \
                    finished: continue with the same command with --part",
                ))
            }
        }
    }

    fn recall<R: DeserializeOwned>(&self, task: CaseTask, case: &Case) -> Option<R> {
        self.context.journals().find(self.journal?, task.fingerprint(case)?)
    }

    fn write<R: CaseResult>(
        &self,
        task: CaseTask,
        case: &Case,
        result: &R,
    ) -> Result<(), ScriptError> {
        if !self.context.studies().merge.is_empty() {
            return Ok(());
        }
        let is_part = self.context.studies().part.is_some();
        match (self.journal, task.fingerprint(case)) {
            (Some(journal), Some(fingerprint)) if result.is_final() || is_part => {
                let bytes = self.context.journals().write(journal, fingerprint, result)?;
                // The result is ignored: after the limit of written bytes is exceeded, the study stops before its next case.
                self.context.meter().allows_to_write(bytes);
            }
            _ => (),
        }
        Ok(())
    }

    fn report_known(&self, task: CaseTask, known: usize, all: usize) {
        if known > 0 {
            let name = &self.name;
            let what = task.name;
            let message = format!(
                "study '{name}' continues: {known} of {all} {what} are known from an earlier \
                run"
            );
            self.context.print_message(&message);
        }
    }
}
