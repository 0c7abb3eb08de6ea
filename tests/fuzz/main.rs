//! 100 000 inputs to parser, bindings, editor and prompt: no panic, no internal error, no hang, and every error can be displayed.
//!
//! All inputs run if `WITHY_LONG` is set, as in `.ci/run`, otherwise the first tenth of them. A failure names its seed. `WITHY_SEED=n` runs a single seed and
//! shows its input; `WITHY_SEEDS=n` runs the first n seeds.
#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;

use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use common::corpus::Corpus;
use common::notepad::Notepad;
use withy::repl::editor::completeness::completeness;
use withy::repl::editor::completion::complete;
use withy::repl::editor::highlight::{SessionNames, highlight};
use withy::repl::editor::hints::hint;
use withy::repl::editor::surroundings::CompletionContext;
use withy::repl::session::Session;
use withy::repl::shell::{ReplyTarget, Shell};
use withy::script::bindings::catalog::Catalog;
use withy::script::diagnose::Blame;
use withy::script::engine::parse::parse;
use withy::script::engine::script_engine::{Halt, ScriptEngine};
use withy::script::engine::stack::on_large_stack;
use withy::script::messages::stop::{MEGABYTE, Stop};
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::limits::Limits;
use withy::script::state::settings::{RunMode, RunSettings};

const SEEDS: u64 = 100_000;
const SEEDS_IN_SHORT: u64 = 10_000;
const BATCH: u64 = 200;
const WORKERS: usize = 2;
const TIME: Duration = Duration::from_millis(200);
/// Time after which an input is considered to hang: the time limit plus a margin for a loaded machine. The assembly checks for interrupts only between beams,
/// and a beam of 400 000 spans takes some seconds.
const HANG: Duration = Duration::from_secs(90);
const LIMITS: Limits = Limits {
    time: Some(TIME),
    steps: Some(12),
    memory: Some(3000 * MEGABYTE),
    depth: 60,
    written: None,
    files: None,
};

/// Input that a worker currently runs, for the detection of hangs.
type Present = Mutex<Option<(u64, Instant)>>;

#[derive(Default)]
struct Report {
    failures: Vec<String>,
    longest: (Duration, u64),
    parsed: u64,
    stopped: u64,
}

#[test]
fn no_input_causes_a_crash_of_the_language() {
    let corpus = Corpus::load();
    if let Some(seed) = number_in("WITHY_SEED") {
        println!("{}\n", corpus.input(seed));
    }
    let seeds = match number_in("WITHY_SEED") {
        Some(seed) => seed..seed + 1,
        None => 0..number_in("WITHY_SEEDS").unwrap_or_else(usual_seeds),
    };
    let folder = tempfile::tempdir().unwrap();
    let (next, end) = (AtomicU64::new(seeds.start), seeds.end);
    let report = Mutex::new(Report::default());
    let present: Vec<Present> = (0..WORKERS).map(|_| Mutex::default()).collect();
    let begun = Instant::now();
    thread::scope(|scope| {
        let (corpus, report, next, folder) = (&corpus, &report, &next, folder.path());
        let workers: Vec<_> = present
            .iter()
            .map(|present| {
                let work = move || loop {
                    let from = next.fetch_add(BATCH, Ordering::Relaxed);
                    if from >= end {
                        return;
                    }
                    run_batch(corpus, from..(from + BATCH).min(end), folder, present, report);
                };
                scope.spawn(move || on_large_stack(&LIMITS, work).unwrap())
            })
            .collect();
        while workers.iter().any(|worker| !worker.is_finished()) {
            thread::sleep(Duration::from_millis(200));
            for (seed, since) in present.iter().filter_map(|present| *present.lock().unwrap()) {
                if since.elapsed() > HANG {
                    // A macro would write to the captured output of the harness, which is lost when the process exits here.
                    let message = format!("seed {seed} hangs:\n{}\n", corpus.input(seed));
                    std::io::stderr().write_all(message.as_bytes()).unwrap();
                    // A thread that hangs cannot be joined.
                    std::process::exit(101);
                }
            }
        }
    });
    let report = report.into_inner().unwrap();
    println!(
        "{} inputs in {:.0} s, {} parsed, {} stopped by a limit, the longest {:?} (seed {})",
        end - seeds.start,
        begun.elapsed().as_secs_f64(),
        report.parsed,
        report.stopped,
        report.longest.0,
        report.longest.1
    );
    let shown = &report.failures[..report.failures.len().min(10)];
    assert!(
        report.failures.is_empty(),
        "{} inputs failed\n\n{}",
        report.failures.len(),
        shown.join("\n\n")
    );
}

fn usual_seeds() -> u64 {
    if std::env::var_os("WITHY_LONG").is_some() { SEEDS } else { SEEDS_IN_SHORT }
}

fn number_in(variable: &str) -> Option<u64> {
    std::env::var(variable).ok()?.parse().ok()
}

fn run_batch(
    corpus: &Corpus,
    seeds: std::ops::Range<u64>,
    folder: &std::path::Path,
    present: &Present,
    report: &Mutex<Report>,
) {
    let catalog = language();
    let settings = RunSettings {
        out: folder.join("out"),
        folder: folder.to_owned(),
        limits: LIMITS,
        ..RunSettings::silent(RunMode::Run)
    };
    let host = ScriptEngine::open(catalog.clone(), settings).unwrap();
    let mut prompt = Prompt::new(&catalog, folder);
    for seed in seeds {
        let text = corpus.input(seed);
        let program = Program { folder: folder.to_owned(), ..Program::named("input", &text) };
        *present.lock().unwrap() = Some((seed, Instant::now()));
        let begun = Instant::now();
        let judged = catch_unwind(AssertUnwindSafe(|| {
            prompt.judge(seed, &text)?;
            judge(&program, &host)
        }));
        let lasted = begun.elapsed();
        *present.lock().unwrap() = None;
        let mut report = report.lock().unwrap();
        if lasted > report.longest.0 {
            report.longest = (lasted, seed);
        }
        match judged {
            Ok(Ok(ran)) => {
                report.parsed += u64::from(ran != Ran::NotAtAll);
                report.stopped += u64::from(ran == Ran::UntilALimit);
            }
            Ok(Err(reason)) => report.failures.push(format!("seed {seed}: {reason}\n{text}")),
            Err(_) => report.failures.push(format!("seed {seed}: a panic\n{text}")),
        }
    }
}

/// Session that runs every fourth input, and editor that receives every input.
struct Prompt {
    shell: Shell,
    message: Notepad,
    /// Names of the session before its last reset.
    vocabulary: SessionNames,
}

/// Prefixes of some inputs. `:save` and `:load` are left out because they access files outside the folder.
const COMMANDS: [&str; 10] =
    [":watch ", ":time ", ":plot ", ":show ", ":help ", "?", ":step ", ":run ", ":back ", ":"];

impl Prompt {
    fn new(catalog: &Catalog, folder: &Path) -> Self {
        let message = Notepad::default();
        let settings = RunSettings {
            out: folder.join("out"),
            folder: folder.to_owned(),
            limits: LIMITS,
            snapshots: MEGABYTE as usize,
            diagnostics: Box::new(message.clone()),
            ..RunSettings::silent(RunMode::Run)
        };
        let session = Session::new(catalog.clone(), settings).unwrap();
        let vocabulary = SessionNames::of(CompletionContext::of_language(catalog.clone()));
        Self { shell: Shell::new(session, ReplyTarget::Pipe), message, vocabulary }
    }

    fn judge(&mut self, seed: u64, text: &str) -> Result<(), String> {
        let _ = completeness(text);
        if seed.is_multiple_of(4) {
            let input = match seed % 16 {
                0 => format!("{}{text}", COMMANDS[(seed / 16) as usize % COMMANDS.len()]),
                _ => text.to_owned(),
            };
            if !input.trim_start().starts_with([':', '?']) || seed.is_multiple_of(16) {
                self.shell.submit(&input);
            }
            let message = self.message.take();
            if message.contains("a bug in withy") {
                return Err(format!("at the prompt: {message}"));
            }
            if seed.is_multiple_of(64) {
                self.vocabulary = SessionNames::of(self.shell.surroundings());
                self.shell.reset();
            }
        }
        let middle = text.floor_char_boundary(text.len() / 2);
        let surroundings = self.vocabulary.surroundings();
        let _ = highlight(text, Some(middle), &self.vocabulary);
        let _ = hint(&text[..middle], middle, surroundings);
        let _ = complete(text, middle, surroundings);
        Ok(())
    }
}

#[derive(PartialEq, Eq)]
enum Ran {
    NotAtAll,
    UntilALimit,
    ToAnEnd,
}

fn judge(program: &Program, host: &ScriptEngine) -> Result<Ran, String> {
    let mut is_parsed = false;
    let ran = host.watch().and_then(|guard| {
        let ran = host.run(
            &guard,
            || program.clone(),
            |engine| {
                let ast = parse(engine, program)?;
                is_parsed = true;
                engine.run_ast(&ast)
            },
        );
        // Freeing the results of the input may also take time and memory.
        host.context().report();
        ran
    });
    let stop = host.context().stopped_by();
    if let Err(Halt::Failed(diagnostic)) = ran {
        let shown = diagnostic.to_string();
        if diagnostic.blame != Blame::User || !shown.starts_with("error: ") {
            return Err(shown);
        }
    }
    Ok(match (is_parsed, stop) {
        (_, Some(Stop::Time(_) | Stop::Memory(_) | Stop::Steps(_))) => Ran::UntilALimit,
        (true, _) => Ran::ToAnEnd,
        (false, _) => Ran::NotAtAll,
    })
}
