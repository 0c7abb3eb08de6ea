//! Checks of documents, as by `withy check`.

use std::io::stdout;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use gen_lsp_types as lsp;
use lsp::{Notification, Uri};

use super::connection::send;
use super::documents::Document;
use super::{positions, uris};
use crate::script::diagnose::{Diagnostic, Location};
use crate::script::engine::runner::{self, Ending};
use crate::script::messages::stop::Stop;
use crate::script::packages::language;
use crate::script::source::pitfalls::{Pitfall, pitfalls};
use crate::script::source::program::Program;
use crate::script::source::scanner::scan;
use crate::script::state::limits::Limits;
use crate::script::state::settings::{RunMode, RunSettings};

const PAUSE: Duration = Duration::from_millis(150);

/// Largest run time of a check; the rest of the script is then not checked.
const LONGEST_CHECK: Duration = Duration::from_secs(10);

pub fn start(uri: &Uri, document: &mut Document) {
    stop(document);
    document.check = Arc::default();
    let program = document.program(uri);
    let (uri, version, stopped) = (uri.clone(), document.version, Arc::clone(&document.check));
    thread::spawn(move || {
        thread::sleep(PAUSE);
        if stopped.load(Ordering::Relaxed) {
            return;
        }
        let found = check(&program, &stopped);
        // Holding the lock of stdout prevents another message between the test of `stopped` and the result.
        let _output = stdout().lock();
        if !stopped.load(Ordering::Relaxed) {
            let notes = pitfalls(&program.text).into_iter();
            let warnings = notes.map(|pitfall| pitfall_warning(pitfall, &program.text));
            publish(uri, Some(version), found.into_iter().chain(warnings).collect());
        }
    });
}

pub fn stop(document: &Document) {
    document.check.store(true, Ordering::Relaxed);
}

pub fn publish(uri: Uri, version: Option<i32>, diagnostics: Vec<lsp::Diagnostic>) {
    let method = lsp::PublishDiagnosticsNotification::METHOD.as_str();
    let shown = lsp::PublishDiagnosticsParams { uri, version, diagnostics };
    send(lsp_server::Notification::new(method.into(), shown));
}

/// Error of a script, or a warning if the check exceeds its time limit; `None` if there is no error.
fn check(program: &Program, stopped: &Arc<AtomicBool>) -> Option<lsp::Diagnostic> {
    let settings = RunSettings {
        interrupt: Arc::clone(stopped),
        limits: Limits { time: Some(LONGEST_CHECK), ..Limits::default() },
        ..RunSettings::silent(RunMode::DryRun)
    };
    let outcome = runner::run(program, &language(), settings);
    match (outcome.ending, outcome.stopped_by) {
        (_, Some(Stop::Time(_))) => Some(timeout_warning(program)),
        (Ending::Failed(error), _) => Some(error_diagnostic(&error, program)),
        _ => None,
    }
}

fn timeout_warning(program: &Program) -> lsp::Diagnostic {
    let message = format!(
        "the check was stopped after {} s; the rest of the script is not checked",
        LONGEST_CHECK.as_secs()
    );
    diagnostic(line_range(&program.text, 1), lsp::DiagnosticSeverity::Warning, message)
}

fn error_diagnostic(error: &Diagnostic, program: &Program) -> lsp::Diagnostic {
    let is_here = |at: &&Location| at.program.name == program.name;
    let here = error.location.as_ref().filter(is_here);
    let elsewhere = error.location.as_ref().filter(|at| !is_here(at));
    // An error in an imported file is shown at the call in this script that led to it.
    let called = || error.trace.iter().rev().find(|frame| frame.file.is_none())?.line;
    let range = match here {
        Some(at) => positions::range(&at.program.text, at.bytes()),
        None => line_range(&program.text, called().unwrap_or(1)),
    };
    let notes = error.notes(usize::MAX);
    let lines: Vec<&str> = [&error.message].into_iter().chain(&notes).map(String::as_str).collect();
    lsp::Diagnostic {
        related_information: elsewhere.and_then(related).map(|place| vec![place]),
        ..diagnostic(range, lsp::DiagnosticSeverity::Error, lines.join("\n"))
    }
}

fn pitfall_warning(Pitfall { at, note }: Pitfall, text: &str) -> lsp::Diagnostic {
    let length = scan(&text[at..]).first().map_or(0, |token| token.end);
    diagnostic(positions::range(text, at..at + length), lsp::DiagnosticSeverity::Warning, note)
}

fn diagnostic(
    range: lsp::Range,
    severity: lsp::DiagnosticSeverity,
    message: String,
) -> lsp::Diagnostic {
    lsp::Diagnostic {
        range,
        severity: Some(severity),
        source: Some("withy".into()),
        message: lsp::Message::String(message),
        ..lsp::Diagnostic::default()
    }
}

fn related(at: &Location) -> Option<lsp::DiagnosticRelatedInformation> {
    let uri = uris::uri(Path::new(&at.program.name))?;
    let range = positions::range(&at.program.text, at.bytes());
    let location = lsp::Location { uri, range };
    Some(lsp::DiagnosticRelatedInformation { location, message: "the error is here".into() })
}

fn line_range(text: &str, line: usize) -> lsp::Range {
    let start: usize = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
    let line = text[start..].lines().next().unwrap_or_default();
    let start = start + line.len() - line.trim_start().len();
    positions::range(text, start..start + line.trim().len())
}
