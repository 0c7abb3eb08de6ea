//! `withy run`, `withy study` and `withy check`.

use std::io::{IsTerminal, sink, stderr, stdout};
use std::path::Path;
use std::process;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::Exit;
use super::args::{CheckOptions, ErrorChoice, RunOptions, StudyOptions};
use super::console::{print_error, print_error_styled, print_line};
use super::interrupt::{self, InterruptLoss};
use super::progress_display::{self, ProgressPreference};
use super::watch::watch;
use crate::output::{TextTable, write_atomic};
use crate::panics;
use crate::repl::terminal::typed_ahead;
use crate::sandbox_fs::read_file;
use crate::script::diagnose::{Colours, Diagnostic};
use crate::script::engine::runner::{self, Ending, RunOutcome};
use crate::script::messages::stop::Stop;
use crate::script::packages::language;
use crate::script::source::program::Program;
use crate::script::state::files_read::FilesRead;
use crate::script::state::inputs::Inputs;
use crate::script::state::limits::HardAbort;
use crate::script::state::settings::{
    ErrorEstimation, JournalPreference, RunMode, RunSettings, StudyPreferences,
};

/// Maximum size of an existing report that may be replaced [bytes].
const LARGEST_REPORT: u64 = 1 << 28;

pub fn run(options: &RunOptions) -> Exit {
    if let Some(Err(diagnostic)) = options.report.as_deref().map(check_report_path) {
        return report_error(&diagnostic);
    }
    let interrupt = interrupt::flag(InterruptLoss::Run);
    match options.watch {
        true => watch(&options.file, &interrupt, |read| run_once(options, &interrupt, read)),
        false => run_once(options, &interrupt, FilesRead::default()),
    }
}

fn run_once(options: &RunOptions, interrupt: &Arc<AtomicBool>, files_read: FilesRead) -> Exit {
    let wish = if options.quiet { ProgressPreference::Hide } else { ProgressPreference::Show };
    let inputs = match options.inputs.inputs() {
        Ok(inputs) => inputs,
        Err(diagnostic) => return report_error(&diagnostic),
    };
    let settings = RunSettings {
        out: options.out.clone(),
        interrupt: Arc::clone(interrupt),
        inputs: inputs.clone(),
        files_read: files_read.clone(),
        limits: options.limits.limits(),
        printed: Box::new(stdout()),
        diagnostics: Box::new(stderr()),
        progress: progress_display::progress(wish),
        errors: error_estimation(options),
        last_resort: Some(last_resort()),
        ..RunSettings::silent(RunMode::Run)
    };
    let outcome = match start(&options.file, settings) {
        Ok(outcome) => outcome,
        Err(diagnostic) => return report_error(&diagnostic),
    };
    files_read.remove(&outcome.files);
    if let Some(Err(diagnostic)) =
        options.report.as_deref().map(|file| write_report(file, &outcome, &inputs))
    {
        return report_error(&diagnostic);
    }
    if wish == ProgressPreference::Show {
        show_summary(&outcome);
    }
    exit_for(&outcome)
}

/// Error estimation of a run, as selected by the options.
/// With `auto`, errors are estimated only if stderr is a terminal and the closing lines are shown.
/// Output that programs read must not depend on the run time.
fn error_estimation(options: &RunOptions) -> ErrorEstimation {
    match options.error {
        ErrorChoice::Always => ErrorEstimation::Always,
        ErrorChoice::Auto if !options.quiet && stderr().is_terminal() => ErrorEstimation::Auto,
        ErrorChoice::Auto => ErrorEstimation::Remark,
        ErrorChoice::Never => ErrorEstimation::Never,
    }
}

pub fn study(options: &StudyOptions) -> Exit {
    let wish = if options.quiet { ProgressPreference::Hide } else { ProgressPreference::Show };
    let studies = StudyPreferences {
        journal: if options.fresh { JournalPreference::Restart } else { JournalPreference::Resume },
        repeats: options.repeats.map(|repeats| repeats as usize),
        part: options.part,
        merge: options.merge.clone(),
    };
    let inputs = match options.inputs.inputs() {
        Ok(inputs) => inputs,
        Err(diagnostic) => return report_error(&diagnostic),
    };
    let settings = RunSettings {
        out: options.out.clone(),
        inputs,
        interrupt: interrupt::flag(InterruptLoss::Run),
        limits: options.limits.limits(),
        printed: if options.part.is_some() { Box::new(sink()) } else { Box::new(stdout()) },
        diagnostics: Box::new(stderr()),
        progress: progress_display::progress(wish),
        studies,
        last_resort: Some(last_resort()),
        ..RunSettings::silent(RunMode::Run)
    };
    match start(&options.file, settings) {
        Ok(outcome) if options.part.is_some() => exit_for_part(&outcome, options),
        Ok(outcome) => {
            if wish == ProgressPreference::Show {
                show_summary(&outcome);
            }
            exit_for_study(&outcome, &options.out)
        }
        Err(diagnostic) => report_error(&diagnostic),
    }
}

pub fn check(options: &CheckOptions) -> Exit {
    let inputs = match options.inputs.inputs() {
        Ok(inputs) => inputs,
        Err(diagnostic) => return report_error(&diagnostic),
    };
    let settings = RunSettings {
        inputs: inputs.clone(),
        interrupt: interrupt::flag(InterruptLoss::Run),
        limits: options.limits.limits(),
        last_resort: Some(last_resort()),
        ..RunSettings::silent(RunMode::DryRun)
    };
    match start(&options.file, settings) {
        Ok(outcome) => {
            let file = options.file.display();
            list_inputs(&inputs);
            match outcome.ending {
                Ending::Finished => print_error(&format!("{file}: no errors found\n")),
                Ending::Undecided => print_error(&format!(
                    "{file}: no errors found so far\nnote: the rest of the script depends on results of a simulation and was not checked\n"
                )),
                _ => (),
            }
            exit_for(&outcome)
        }
        Err(diagnostic) => report_error(&diagnostic),
    }
}

fn list_inputs(inputs: &Inputs) {
    let declared = inputs.declared();
    if declared.is_empty() {
        return;
    }
    let mut table = TextTable::new(&["input", "default", "allowed", "description"]);
    for (of, _) in &declared {
        let allowed = match of.allowed() {
            allowed if allowed.is_empty() => of.default.type_words().to_owned(),
            allowed => allowed,
        };
        table.row([of.name.clone(), of.default_with_unit(), allowed, of.about.clone()]);
    }
    let table = table.to_string();
    table.lines().for_each(|line| print_line(line.trim_end()));
}

fn start(file: &Path, settings: RunSettings) -> Result<RunOutcome, Diagnostic> {
    let program = Program::load(file)?;
    panics::silence();
    Ok(runner::run(&program, &language(), settings))
}

pub(super) fn exit_for(outcome: &RunOutcome) -> Exit {
    match &outcome.ending {
        Ending::Failed(diagnostic) => report_error(diagnostic),
        Ending::Interrupted => {
            print_error("interrupted: results up to this point are kept\n");
            Exit::Interrupted
        }
        Ending::PipeClosed | Ending::Undecided => Exit::Success,
        Ending::Finished if !outcome.checks.failed().is_empty() => Exit::CheckFailed,
        Ending::Finished => Exit::Success,
    }
}

fn exit_for_study(outcome: &RunOutcome, out: &Path) -> Exit {
    let (cases, are) = match outcome.kept_cases {
        0 => return exit_for(outcome),
        1 => ("1 finished case".to_owned(), "is"),
        many => (format!("{many} finished cases"), "are"),
    };
    let kept =
        format!("{cases} {are} kept in '{}'; the same command continues the study", out.display());
    match &outcome.ending {
        Ending::Interrupted => {
            print_error(&format!("interrupted: {kept}\n"));
            Exit::Interrupted
        }
        Ending::Failed(diagnostic) => {
            // The usual hint at an endless loop would be misleading after a time limit in a long study.
            let hint = match outcome.stopped_by {
                Some(Stop::Time(_)) => Some("--max-time SECONDS allows more".to_owned()),
                _ => diagnostic.hint.clone(),
            };
            let exit = report_error(&Diagnostic { hint, ..diagnostic.clone() });
            print_error(&format!("{kept}\n"));
            exit
        }
        Ending::Finished | Ending::Undecided | Ending::PipeClosed => exit_for(outcome),
    }
}

/// Exit code of a run that computes only a part of the studies.
/// An error of the script after its studies is ignored, because statements that need the results of the other parts must fail.
fn exit_for_part(outcome: &RunOutcome, options: &StudyOptions) -> Exit {
    let cases = match outcome.kept_cases {
        1 => "1 finished case is".to_owned(),
        many => format!("{many} finished cases are"),
    };
    let kept = format!("{cases} kept in '{}'", options.out.display());
    match (&outcome.ending, outcome.stopped_by) {
        (Ending::Interrupted, _) | (Ending::Failed(_), Some(_)) => {
            exit_for_study(outcome, &options.out)
        }
        (Ending::Failed(_), None) if outcome.kept_cases == 0 => exit_for(outcome),
        (Ending::Failed(diagnostic), None) => {
            if !options.quiet {
                let message = &diagnostic.message;
                print_error(&format!(
                    "{kept}\nnote: then the script failed, perhaps because it needs the results of all parts: {message}\n"
                ));
            }
            Exit::Success
        }
        (Ending::Finished | Ending::Undecided | Ending::PipeClosed, _) => {
            if !options.quiet {
                print_error(&format!("{kept}\n"));
            }
            Exit::Success
        }
    }
}

pub(super) fn report_error(diagnostic: &Diagnostic) -> Exit {
    let wants_colours =
        stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    print_error_styled(&diagnostic.render(if wants_colours {
        Colours::Ansi
    } else {
        Colours::None
    }));
    Exit::Failure
}

pub(super) fn show_summary(outcome: &RunOutcome) {
    for line in outcome.summary() {
        print_error(&format!("{line}\n"));
    }
}

pub(super) fn last_resort() -> HardAbort {
    Arc::new(end_at)
}

fn end_at(stop: Stop) {
    typed_ahead::restore();
    let (message, hint) = stop.message_and_hint();
    report_error(&Diagnostic { hint, ..Diagnostic::general(message) });
    print_error(
        "note: a long operation could not be interrupted: files written before it are complete, all other results are lost\n",
    );
    process::exit(Exit::Failure as i32)
}

fn check_report_path(file: &Path) -> Result<(), Diagnostic> {
    if file.symlink_metadata().is_err() {
        return Ok(());
    }
    let content = read_file(file, LARGEST_REPORT).ok();
    let content =
        content.and_then(|bytes| serde_json::from_slice::<serde_json::Value>(&bytes).ok());
    match content.is_some_and(|content| content.get("simulations").is_some()) {
        true => Ok(()),
        false => {
            let message = format!("'{}' exists and is not a report", file.display());
            Err(Diagnostic::general(message)
                .with_hint("--report takes the name of a new file, or of an earlier report"))
        }
    }
}

fn write_report(file: &Path, outcome: &RunOutcome, inputs: &Inputs) -> Result<(), Diagnostic> {
    let mut report = serde_json::json!({ "simulations": outcome.simulations });
    let declared = inputs.declared();
    if !declared.is_empty() {
        let values = declared.into_iter().map(|(of, value)| (of.name, value.to_json()));
        report["inputs"] = values.collect::<serde_json::Map<_, _>>().into();
    }
    write_atomic(file, format!("{report:#}\n").as_bytes()).map_err(|error| {
        Diagnostic::general(format!("cannot write the report '{}': {error}", file.display()))
            .with_hint("--report takes the path of a file in a folder that exists")
    })
}
