//! What a line at the prompt does: an input of the language, or a command. Replies go to where the session prints.

mod refusing;
mod watched_expressions;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::atomic::Ordering;

use super::clock::{Clock, Stopwatch};
use super::commands;
use super::editor::surroundings::CommandOperand;
use super::pager::{Pager, PagerOutcome};
use super::session::{ANSWER, Reply, Session};
use crate::output::{Colours, TerminalStyle, significant};
use crate::sandbox_fs::read_file;
use crate::script::bindings::kind::Scripted;
use crate::script::diagnose::{Diagnostic, Location};
use crate::script::handles::simulation::SimulationHandle;
use crate::script::presentation::present::present;
use crate::script::source::program::{LARGEST_SCRIPT, Program};

/// What became of a line that was typed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommandOutcome {
    /// The line worked.
    Good,
    /// The line was wrong; the user was told.
    Failed,
    /// The line was stopped by Ctrl-C.
    Interrupted,
    /// The line was stopped, for nobody reads what is printed any more.
    PipeClosed,
    /// The line says that the user wants to leave.
    Quit,
}

/// Who sees the replies of the shell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReplyTarget {
    /// A person at a terminal sees the replies, in this style.
    Terminal(TerminalStyle),
    /// Another program, or a file, gets the replies.
    Pipe,
}

/// Characters in a line where no terminal says how many.
const WIDTH: usize = 100;

/// A session with commands and watched expressions.
pub struct Shell {
    session: Session,
    screen: ReplyTarget,
    watched: Vec<String>,
    /// How many of the files that were written the user knows of.
    told_files: usize,
    /// What was saved under which name.
    saved: HashMap<PathBuf, String>,
    /// What times are taken with.
    clock: Rc<dyn Clock>,
    /// What shows replies that are longer than the terminal.
    pager: Option<Box<dyn Pager>>,
}

impl Shell {
    /// A shell around a session, for somebody who sees its replies on `screen`.
    pub fn new(session: Session, screen: ReplyTarget) -> Self {
        Self {
            session,
            screen,
            watched: Vec::new(),
            told_files: 0,
            saved: HashMap::new(),
            clock: Rc::new(Stopwatch::default()),
            pager: None,
        }
    }

    /// Makes the shell take times with another clock.
    #[must_use]
    pub fn with_clock(self, clock: Rc<dyn Clock>) -> Self {
        Self { clock, ..self }
    }

    /// Shows long help in pages from now on.
    pub fn page_with(&mut self, pager: Box<dyn Pager>) {
        self.pager = Some(pager);
    }

    /// The clock that the shell takes times with.
    pub fn clock(&self) -> Rc<dyn Clock> {
        Rc::clone(&self.clock)
    }

    /// The session of the shell.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// The session of the shell, to look at something in it.
    pub fn session_mut(&mut self) -> &mut Session {
        &mut self.session
    }

    /// Who sees the replies of the shell.
    pub fn screen(&self) -> ReplyTarget {
        self.screen
    }

    /// Takes the size of the terminal as it is now: people change it.
    pub fn resize(&mut self, columns: usize, lines: usize) {
        if let ReplyTarget::Terminal(style) = self.screen {
            self.screen = ReplyTarget::Terminal(style.on_terminal(columns, lines));
        }
        if let Some(pager) = &mut self.pager {
            pager.resize(columns, lines);
        }
    }

    /// Does what a complete input says: a command, a question, or statements.
    pub fn submit(&mut self, input: &str) -> CommandOutcome {
        self.session.forget_interrupt();
        let text = input.trim();
        if text.starts_with(':') {
            return match text.strip_suffix('?').filter(|name| !name.contains(char::is_whitespace)) {
                Some(command) => (commands::HELP.body)(self, command),
                None => self.command(text),
            };
        }
        if let Some(name) = text.strip_prefix('?') {
            return (commands::HELP.body)(self, name.trim());
        }
        let is_variable = |name: &str| {
            self.session.variables().contains(name)
                || self.session.functions().any(|function| function.name == name)
        };
        if let Some((command, operand)) = commands::meant(text, is_variable) {
            return (command.body)(self, operand);
        }
        let before = self.latest().map(|latest| latest.time());
        let reply = self.session.eval(input);
        let outcome = self.tell(reply);
        let has_moved = self.latest().map(|latest| latest.time()) != before;
        match outcome == CommandOutcome::Good && has_moved {
            true => self.show_watched(),
            false => outcome,
        }
    }

    fn command(&mut self, text: &str) -> CommandOutcome {
        let (name, operand) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        let operand = operand.trim();
        match commands::find(name) {
            Ok(command) if command.operand == CommandOperand::Nothing && !operand.is_empty() => {
                let told = format!("'{}' takes nothing, got '{operand}'", command.name);
                let hint = format!("write {0}; :help {0} says what it does", command.name);
                self.refuse(&Diagnostic::general(told).with_hint(hint))
            }
            Ok(command) => (command.body)(self, operand),
            Err(refusal) => self.refuse(&refusal),
        }
    }

    /// Evaluates a program as if it had been typed, and shows what became of it.
    pub fn run_program(&mut self, program: Program) -> CommandOutcome {
        let reply = self.session.eval_program(program);
        match reply {
            // A file is not asked for its last value.
            Reply::Value(_) => self.tell(Reply::Done),
            reply => self.tell(reply),
        }
    }

    /// Shows what became of an input.
    pub fn tell(&mut self, reply: Reply) -> CommandOutcome {
        let outcome = match reply {
            Reply::Done => CommandOutcome::Good,
            Reply::Value(value) => {
                let shown = present(self.session.catalog(), &value, self.width());
                self.print(&shown);
                CommandOutcome::Good
            }
            Reply::Failed(diagnostic) => self.refuse(&diagnostic),
            Reply::Interrupted => {
                self.note(&match self.latest() {
                    Some(latest) => format!("interrupted: {}", latest.show()),
                    None => "interrupted".into(),
                });
                CommandOutcome::Interrupted
            }
            Reply::PipeClosed => CommandOutcome::PipeClosed,
        };
        self.tell_files();
        outcome
    }

    fn tell_files(&mut self) {
        let written = self.session.context().output().written();
        for file in written.iter().skip(self.told_files) {
            self.note(&format!("wrote {}", file.display()));
        }
        self.told_files = written.len();
    }

    /// Forgets everything of the session but the screen.
    pub fn reset(&mut self) {
        self.session.reset();
        self.watched.clear();
    }

    /// Whether a file may be written: it is new, or still as this shell has written it.
    pub fn may_write(&self, path: &Path) -> bool {
        let ours = || self.saved.get(path).map(String::as_bytes);
        let is_there = path.symlink_metadata().is_ok();
        !is_there || read_file(path, LARGEST_SCRIPT).is_ok_and(|bytes| Some(&*bytes) == ours())
    }

    /// Remembers the script that the shell has written to a file.
    pub fn note_saved(&mut self, path: &Path, script: String) {
        self.saved.insert(path.to_owned(), script);
    }

    /// Prints a reply of the shell.
    pub fn print(&self, text: &str) {
        self.session.context().print_drawn(text);
        self.session.context().flush();
    }

    /// Prints a reply that may be long: in pages, where there is a pager.
    pub fn print_in_pages(&mut self, text: &str) -> CommandOutcome {
        let interrupt = self.session.context().interrupt_flag();
        let shown = match &mut self.pager {
            Some(pager) => pager.show(text, &|| interrupt.swap(false, Ordering::Relaxed)),
            None => PagerOutcome::NotByThis,
        };
        match shown {
            PagerOutcome::Seen => CommandOutcome::Good,
            PagerOutcome::Interrupted => CommandOutcome::Interrupted,
            PagerOutcome::NotByThis => {
                self.print(text);
                CommandOutcome::Good
            }
        }
    }

    /// Tells the user something beside the replies.
    pub fn note(&self, text: &str) {
        self.session.context().tell(text);
    }

    /// Tells the user what is wrong.
    pub fn refuse(&self, diagnostic: &Diagnostic) -> CommandOutcome {
        let width = match self.screen {
            ReplyTarget::Terminal(style) => style.width,
            ReplyTarget::Pipe => usize::MAX,
        };
        let told = diagnostic.render_within(self.colours(), width);
        self.session.context().tell_drawn(told.trim_end());
        CommandOutcome::Failed
    }

    /// Whether the replies of the shell have colours.
    pub fn colours(&self) -> Colours {
        match self.screen {
            ReplyTarget::Terminal(style) => style.colours,
            ReplyTarget::Pipe => Colours::None,
        }
    }

    /// The number of characters in a line of the screen.
    pub fn width(&self) -> usize {
        match self.screen {
            ReplyTarget::Terminal(style) => style.width,
            ReplyTarget::Pipe => WIDTH,
        }
    }
}

/// An error in an input that a command has made is told without that input, which nobody has typed.
fn without_place_in(input: &str, reply: Reply) -> Reply {
    let is_made = |location: &Location| {
        let line = location.program.text.lines().nth(location.line.saturating_sub(1));
        line.is_some_and(|line| line.trim() == input.trim())
    };
    match reply {
        Reply::Failed(diagnostic) if diagnostic.location.as_ref().is_some_and(is_made) => {
            Reply::Failed(Diagnostic { location: None, ..diagnostic })
        }
        other => other,
    }
}

/// What names the last simulation where no variable holds it.
const LATEST: &str = "latest_simulation()";

/// The last simulation, on which commands act.
impl Shell {
    /// The last simulation: the one that was started, loaded, forked or stepped last.
    pub fn latest(&self) -> Option<SimulationHandle> {
        self.session.context().latest_simulation()?.try_cast()
    }

    /// Whether a variable of the session holds the last simulation.
    pub fn holds_latest(&self) -> bool {
        self.name_of_latest().is_ok_and(|name| name != LATEST)
    }

    /// How an input names the last simulation: by a variable that holds it, if there is one.
    fn name_of_latest(&self) -> Result<String, Diagnostic> {
        let Some(latest) = self.latest() else {
            return Err(no_simulation());
        };
        let is_it = |value: &rhai::Dynamic| {
            value.read_lock::<SimulationHandle>().is_some_and(|held| held.is_same(&latest))
        };
        let variables = self.session.variables();
        let held = variables.iter_raw().find(|(name, _, value)| {
            // The last answer will soon be another one.
            *name != ANSWER && is_it(value)
        });
        Ok(held.map_or_else(|| LATEST.into(), |(name, ..)| name.to_owned()))
    }

    /// Tells the user at which time the last simulation is.
    pub fn tell_place(&self) {
        if let Some(latest) = self.latest() {
            let steps = latest.simulation().counts().steps;
            let plural = if steps == 1 { "" } else { "s" };
            let time = significant(latest.time(), 10);
            let ended = latest.simulation().ending().map(|ending| format!("; ended: {ending}"));
            let ended = ended.unwrap_or_default();
            self.print(&format!("t = {time} after {steps} step{plural}{ended}"));
        }
    }

    fn input_for_latest(&self, call: &str) -> Result<String, Diagnostic> {
        self.name_of_latest().map(|name| format!("{name}.{call};"))
    }

    /// Calls a method of the last simulation as if it had been typed.
    pub fn call_latest(&mut self, call: &str) -> CommandOutcome {
        match self.input_for_latest(call) {
            Ok(input) => {
                let reply = without_place_in(&input, self.session.eval(&input));
                self.tell(reply)
            }
            Err(refusal) => self.refuse(&refusal),
        }
    }

    /// Calls a method of the last simulation as a part of a command, and shows the watched expressions. The record of the session
    /// gets the call, or how far it came.
    pub fn call_latest_watched(&mut self, call: &str) -> CommandOutcome {
        let input = match self.input_for_latest(call) {
            Ok(input) => input,
            Err(refusal) => return self.refuse(&refusal),
        };
        let before = self.session.whereabouts();
        let outcome = match self.session.peek(&input) {
            Reply::Value(_) => CommandOutcome::Good,
            reply => self.tell(without_place_in(&input, reply)),
        };
        match outcome {
            CommandOutcome::Good => {
                self.session.note_worked(&input);
                self.show_watched()
            }
            failed => {
                self.session.note_moved(&before);
                failed
            }
        }
    }

    /// Shows what a method of the last simulation gives back.
    pub fn show_of_latest(&mut self, call: &str) -> CommandOutcome {
        match self.name_of_latest() {
            Ok(name) => {
                let reply = self.session.peek(&format!("{name}.{call}"));
                self.tell(reply)
            }
            Err(refusal) => self.refuse(&refusal),
        }
    }

    /// The time at which the next step of the last simulation ends, if it is not at `end` already.
    pub fn next_stop(&self, end: f64) -> Option<f64> {
        let latest = self.latest()?;
        let simulation = latest.simulation();
        let is_there = simulation.has_reached(end) || simulation.has_ended();
        (!is_there).then(|| simulation.next_stop(end))
    }
}

/// The error of a command that needs a simulation when there is none.
pub fn no_simulation() -> Diagnostic {
    Diagnostic::general("there is no simulation yet")
        .with_hint("start one: let sim = scene.start(#{ dt: 0.1 })")
}
