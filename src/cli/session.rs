//! `withy`, `withy repl` and `withy -e`: open sessions that read their inputs from a terminal, a pipe or the command line.

use std::io::{self, IsTerminal, stderr, stdin, stdout};
use std::path::{Path, PathBuf};

use super::Exit;
use super::args::{ReplOptions, SessionOptions};
use super::console::print_error;
use super::input_options::InputOptions;
use super::interrupt::{self, InterruptLoss};
use super::progress_display::{self, ProgressPreference};
use super::run::{last_resort, report_error};
use crate::output::{Glyphs, TerminalStyle};
use crate::panics;
use crate::repl::batch;
use crate::repl::session::Session;
use crate::repl::shell::{CommandOutcome, ReplyTarget, Shell};
use crate::repl::terminal::line_editor::{Editor, EditorOptions};
use crate::repl::terminal::pager::TerminalPager;
use crate::repl::terminal::prompt;
use crate::script::diagnose::Diagnostic;
use crate::script::engine::stack::on_large_stack;
use crate::script::messages::stop::{MEGABYTE, Stop};
use crate::script::packages::language;
use crate::script::source::program::Program;
use crate::script::state::settings::{RunMode, RunSettings};

pub fn open(options: &ReplOptions) -> Exit {
    panics::silence();
    if is_interactive(&options.session) {
        interrupt::end_on_signal();
    }
    match on_large_stack(&options.session.limits.limits(), || run(options)) {
        Ok(Ok(exit)) => exit,
        Ok(Err(diagnostic)) | Err(diagnostic) => report_error(&diagnostic),
    }
}

pub fn start(options: SessionOptions) -> Exit {
    open(&ReplOptions { file: None, inputs: InputOptions::default(), session: options })
}

fn is_interactive(options: &SessionOptions) -> bool {
    options.inputs.is_empty() && stdin().is_terminal() && stdout().is_terminal()
}

fn run(options: &ReplOptions) -> Result<Exit, Diagnostic> {
    let ReplOptions { file, inputs, session: options } = options;
    let is_conversation = is_interactive(options);
    let settings = RunSettings { folder: folder_of(file), ..settings(options, is_conversation) };
    let session = Session::new(language(), settings)?;
    let screen =
        if is_conversation { ReplyTarget::Terminal(style(options)) } else { ReplyTarget::Pipe };
    let mut shell = Shell::new(session, screen);
    let mut outcome = match file {
        Some(file) => shell.run_program(Program::load(file)?, inputs.inputs()?),
        None => CommandOutcome::Success,
    };
    if is_conversation {
        return read_inputs(&mut shell, options).map(|()| Exit::Success);
    }
    for input in &options.inputs {
        if outcome == CommandOutcome::Success {
            outcome = batch::run(&mut shell, input.as_bytes());
        }
    }
    if options.inputs.is_empty() && outcome == CommandOutcome::Success {
        outcome = batch::run(&mut shell, stdin().lock());
    }
    Ok(exit_for(&shell, outcome))
}

fn read_inputs(shell: &mut Shell, options: &SessionOptions) -> Result<(), Diagnostic> {
    let no_terminal = |error: io::Error| {
        Diagnostic::general(format!("cannot read from the terminal: {error}"))
            .with_hint("inputs can also be read from a file: withy repl < FILE")
    };
    if let Some(pager) = TerminalPager::of_environment(|name| std::env::var(name).ok()) {
        shell.page_with(Box::new(pager));
    }
    let mut editing = EditorOptions::from_environment(shell.colours());
    if let Some(keys) = options.keys {
        editing.keys = keys.into();
    }
    let mut editor = Editor::new(editing).map_err(no_terminal)?;
    shell.print(concat!(
        "withy ",
        env!("CARGO_PKG_VERSION"),
        ": interactive prompt. :help for help, Tab completes, Ctrl-D exits."
    ));
    prompt::run(shell, &mut editor).map_err(no_terminal)
}

fn exit_for(shell: &Shell, outcome: CommandOutcome) -> Exit {
    let has_failed = shell.session().context().with_checks(|checks| !checks.failed().is_empty());
    let stopped = shell.session().context().stopped_by();
    let is_lost = matches!(stopped, Some(Stop::OutputLost(_)));
    if is_lost && outcome != CommandOutcome::Failed {
        print_error("error: part of the output could not be written\n");
    }
    match outcome {
        CommandOutcome::Failed => Exit::Failure,
        CommandOutcome::Interrupted => Exit::Interrupted,
        CommandOutcome::Success | CommandOutcome::Quit if is_lost => Exit::Failure,
        CommandOutcome::PipeClosed => Exit::Success,
        CommandOutcome::Success | CommandOutcome::Quit if has_failed => Exit::CheckFailed,
        CommandOutcome::Success | CommandOutcome::Quit => Exit::Success,
    }
}

fn settings(options: &SessionOptions, is_conversation: bool) -> RunSettings {
    RunSettings {
        out: options.out.clone(),
        interrupt: interrupt::flag(match is_conversation {
            true => InterruptLoss::Session,
            false => InterruptLoss::Run,
        }),
        limits: options.limits.limits(),
        snapshots: (u64::from(options.snapshots) * MEGABYTE) as usize,
        printed: Box::new(stdout()),
        diagnostics: Box::new(stderr()),
        progress: progress_display::progress(if is_conversation {
            ProgressPreference::Show
        } else {
            ProgressPreference::Hide
        }),
        last_resort: Some(last_resort()),
        ..RunSettings::silent(RunMode::Run)
    }
}

fn folder_of(file: &Option<PathBuf>) -> PathBuf {
    let parent = file.as_deref().and_then(Path::parent);
    parent.filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new(".")).into()
}

fn style(options: &SessionOptions) -> TerminalStyle {
    let style = TerminalStyle::of_environment(|name| std::env::var(name).ok());
    match options.ascii {
        true => TerminalStyle { glyphs: Glyphs::Ascii, ..style },
        false => style,
    }
}
