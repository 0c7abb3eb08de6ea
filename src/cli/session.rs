//! `withy`, `withy repl` and `withy -e`: a session with a terminal, with a pipe, or with inputs of the command line.

use std::io::{self, IsTerminal, stderr, stdin, stdout};
use std::path::{Path, PathBuf};

use super::Exit;
use super::args::{ReplOptions, SessionOptions};
use super::bar::{self, Wish};
use super::interrupt::{self, AtStake};
use super::run::{last_resort, refuse};
use super::say::tell;
use crate::output::{Glyphs, Style};
use crate::panics;
use crate::repl::editor::{self, Editor};
use crate::repl::pager::TerminalPager;
use crate::repl::session::Session;
use crate::repl::shell::{Outcome, Screen, Shell};
use crate::repl::{batch, prompt};
use crate::script::diagnose::Diagnostic;
use crate::script::engine::stack::on_large_stack;
use crate::script::packages::language;
use crate::script::source::program::Program;
use crate::script::state::settings::{Mode, Settings};
use crate::script::words::stop::{MEGABYTE, Stop};

/// Does what `withy repl` asks for: opens a session in which a file may be evaluated first.
pub fn open(options: &ReplOptions) -> Exit {
    panics::silence();
    if is_conversation(&options.session) {
        interrupt::end_when_asked();
    }
    match on_large_stack(&options.session.limits.limits(), || hold(options)) {
        Ok(Ok(exit)) => exit,
        Ok(Err(diagnostic)) | Err(diagnostic) => refuse(&diagnostic),
    }
}

/// Opens a session without a file.
pub fn start(options: SessionOptions) -> Exit {
    open(&ReplOptions { file: None, session: options })
}

/// Whether a person types.
fn is_conversation(options: &SessionOptions) -> bool {
    options.inputs.is_empty() && stdin().is_terminal() && stdout().is_terminal()
}

/// A session from its beginning to its end.
fn hold(options: &ReplOptions) -> Result<Exit, Diagnostic> {
    let ReplOptions { file, session: options } = options;
    let is_conversation = is_conversation(options);
    let settings = Settings { folder: folder_of(file), ..settings(options, is_conversation) };
    let session = Session::new(language(), settings)?;
    let screen = if is_conversation { Screen::Terminal(style(options)) } else { Screen::Pipe };
    let mut shell = Shell::new(session, screen);
    let mut outcome = match file {
        Some(file) => shell.run_program(Program::load(file)?),
        None => Outcome::Good,
    };
    if is_conversation {
        return converse(&mut shell, options).map(|()| Exit::Good);
    }
    for input in &options.inputs {
        if outcome == Outcome::Good {
            outcome = batch::run(&mut shell, input.as_bytes());
        }
    }
    if options.inputs.is_empty() && outcome == Outcome::Good {
        outcome = batch::run(&mut shell, stdin().lock());
    }
    Ok(exit_for(&shell, outcome))
}

/// Lets a person type.
fn converse(shell: &mut Shell, options: &SessionOptions) -> Result<(), Diagnostic> {
    let no_terminal = |error: io::Error| {
        Diagnostic::general(format!("cannot read from the terminal: {error}"))
            .with_hint("inputs can also be piped in: withy repl < FILE")
    };
    if let Some(pager) = TerminalPager::of_environment(|name| std::env::var(name).ok()) {
        shell.page_with(Box::new(pager));
    }
    let mut editing = editor::Options::from_environment(shell.colours());
    if let Some(keys) = options.keys {
        editing.keys = keys.into();
    }
    let mut editor = Editor::new(editing).map_err(no_terminal)?;
    shell.print(concat!(
        "withy ",
        env!("CARGO_PKG_VERSION"),
        ": step, look, go back. :help for help, Tab completes, Ctrl-D leaves."
    ));
    prompt::run(shell, &mut editor).map_err(no_terminal)
}

fn exit_for(shell: &Shell, outcome: Outcome) -> Exit {
    let has_failed = shell.session().context().with_checks(|checks| !checks.failed().is_empty());
    let stopped = shell.session().context().stopped_by();
    let is_lost = matches!(stopped, Some(Stop::OutputLost(_)));
    if is_lost && outcome != Outcome::Failed {
        tell("error: some of the output could not be written\n");
    }
    match outcome {
        Outcome::Failed => Exit::Wrong,
        Outcome::Interrupted => Exit::Interrupted,
        Outcome::Good | Outcome::Quit if is_lost => Exit::Wrong,
        Outcome::PipeClosed => Exit::Good,
        Outcome::Good | Outcome::Quit if has_failed => Exit::CheckFailed,
        Outcome::Good | Outcome::Quit => Exit::Good,
    }
}

fn settings(options: &SessionOptions, is_conversation: bool) -> Settings {
    Settings {
        out: options.out.clone(),
        interrupt: interrupt::flag(match is_conversation {
            true => AtStake::Session,
            false => AtStake::Run,
        }),
        limits: options.limits.limits(),
        snapshots: (u64::from(options.snapshots) * MEGABYTE) as usize,
        printed: Box::new(stdout()),
        told: Box::new(stderr()),
        progress: bar::progress(if is_conversation { Wish::Show } else { Wish::Hide }),
        last_resort: Some(last_resort()),
        ..Settings::silent(Mode::Run)
    }
}

/// A session may read where its file is, or where it was started.
fn folder_of(file: &Option<PathBuf>) -> PathBuf {
    let parent = file.as_deref().and_then(Path::parent);
    parent.filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new(".")).into()
}

/// What the terminal can show.
fn style(options: &SessionOptions) -> Style {
    let style = Style::of_environment(|name| std::env::var(name).ok());
    match options.ascii {
        true => Style { glyphs: Glyphs::Ascii, ..style },
        false => style,
    }
}
