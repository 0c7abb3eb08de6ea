//! Evaluation of inputs, which are statements or commands, and output of replies.

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
use crate::script::state::inputs::Inputs;

/// Result of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommandOutcome {
    /// Success.
    Success,
    /// The input failed, and the error was reported.
    Failed,
    /// Interrupted by Ctrl-C.
    Interrupted,
    /// The reader of the output has closed the pipe.
    PipeClosed,
    /// The user wants to quit.
    Quit,
}

/// Destination of replies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReplyTarget {
    /// A terminal with the given style.
    Terminal(TerminalStyle),
    /// Another program or a file.
    Pipe,
}

const WIDTH: usize = 100;

/// Session with commands, watched expressions and a destination for replies.
pub struct Shell {
    session: Session,
    screen: ReplyTarget,
    watched: Vec<String>,
    reported_files: usize,
    saved: HashMap<PathBuf, String>,
    clock: Rc<dyn Clock>,
    pager: Option<Box<dyn Pager>>,
}

impl Shell {
    /// Creates a shell for a session. Its replies are written to `screen`.
    pub fn new(session: Session, screen: ReplyTarget) -> Self {
        Self {
            session,
            screen,
            watched: Vec::new(),
            reported_files: 0,
            saved: HashMap::new(),
            clock: Rc::new(Stopwatch::default()),
            pager: None,
        }
    }

    /// Replaces the clock.
    #[must_use]
    pub fn with_clock(self, clock: Rc<dyn Clock>) -> Self {
        Self { clock, ..self }
    }

    /// Sets the pager for long replies.
    pub fn page_with(&mut self, pager: Box<dyn Pager>) {
        self.pager = Some(pager);
    }

    /// Clock for the measurement of run times.
    pub fn clock(&self) -> Rc<dyn Clock> {
        Rc::clone(&self.clock)
    }

    /// Session of the shell.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// Mutable session of the shell.
    pub fn session_mut(&mut self) -> &mut Session {
        &mut self.session
    }

    /// Destination of replies.
    pub fn screen(&self) -> ReplyTarget {
        self.screen
    }

    /// Updates the size of the terminal.
    pub fn resize(&mut self, columns: usize, lines: usize) {
        if let ReplyTarget::Terminal(style) = self.screen {
            self.screen = ReplyTarget::Terminal(style.on_terminal(columns, lines));
        }
        if let Some(pager) = &mut self.pager {
            pager.resize(columns, lines);
        }
    }

    /// Evaluates a complete input, which is a command, a help request, or statements.
    pub fn submit(&mut self, input: &str) -> CommandOutcome {
        self.session.clear_interrupt();
        let input = without_prompt(input);
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
        let outcome = self.print_reply(reply);
        let has_moved = self.latest().map(|latest| latest.time()) != before;
        match outcome == CommandOutcome::Success && has_moved {
            true => self.show_watched(),
            false => outcome,
        }
    }

    fn command(&mut self, text: &str) -> CommandOutcome {
        let (name, operand) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        let operand = operand.trim();
        match commands::find(name) {
            Ok(command) if command.operand == CommandOperand::Nothing && !operand.is_empty() => {
                let message = format!("'{}' takes no argument, got '{operand}'", command.name);
                let hint = format!("write {0}; :help {0} describes it", command.name);
                self.report_error(&Diagnostic::general(message).with_hint(hint))
            }
            Ok(command) => (command.body)(self, operand),
            Err(refusal) => self.report_error(&refusal),
        }
    }

    /// Evaluates a program with the values `inputs` of its script inputs, like typed input. The value of the last statement is not shown.
    /// Shows errors and the names of written files.
    pub fn run_program(&mut self, program: Program, inputs: Inputs) -> CommandOutcome {
        let reply = self.session.load(program, inputs);
        match reply {
            Reply::Value(_) => self.print_reply(Reply::Done),
            reply => self.print_reply(reply),
        }
    }

    /// Shows a reply of the session.
    pub fn print_reply(&mut self, reply: Reply) -> CommandOutcome {
        let outcome = match reply {
            Reply::Done => CommandOutcome::Success,
            Reply::Value(value) => {
                let shown = present(self.session.catalog(), &value, self.width());
                self.print(&shown);
                CommandOutcome::Success
            }
            Reply::Failed(diagnostic) => self.report_error(&diagnostic),
            Reply::Interrupted => {
                self.print_note(&match self.latest() {
                    Some(latest) => format!("interrupted: {}", latest.show()),
                    None => "interrupted".into(),
                });
                CommandOutcome::Interrupted
            }
            Reply::PipeClosed => CommandOutcome::PipeClosed,
        };
        self.print_written_files();
        outcome
    }

    fn print_written_files(&mut self) {
        let written = self.session.context().output().written();
        for file in written.iter().skip(self.reported_files) {
            self.print_note(&format!("wrote {}", file.display()));
        }
        self.reported_files = written.len();
    }

    /// Removes all variables, functions and imports of the session, and the watched expressions.
    pub fn reset(&mut self) {
        self.session.reset();
        self.watched.clear();
    }

    /// Returns true if a file does not exist, or is unchanged since this shell wrote it.
    pub fn may_write(&self, path: &Path) -> bool {
        let ours = || self.saved.get(path).map(String::as_bytes);
        let is_there = path.symlink_metadata().is_ok();
        !is_there || read_file(path, LARGEST_SCRIPT).is_ok_and(|bytes| Some(&*bytes) == ours())
    }

    /// Records that a script was saved to a file.
    pub fn record_saved(&mut self, path: &Path, script: String) {
        self.saved.insert(path.to_owned(), script);
    }

    /// Prints a text as a reply.
    pub fn print(&self, text: &str) {
        self.session.context().print_drawn(text);
        self.session.context().flush();
    }

    /// Prints a reply that may be long, in pages if there is a pager.
    pub fn print_in_pages(&mut self, text: &str) -> CommandOutcome {
        let interrupt = self.session.context().interrupt_flag();
        let shown = match &mut self.pager {
            Some(pager) => pager.show(text, &|| interrupt.swap(false, Ordering::Relaxed)),
            None => PagerOutcome::NotPaged,
        };
        match shown {
            PagerOutcome::Shown => CommandOutcome::Success,
            PagerOutcome::Interrupted => CommandOutcome::Interrupted,
            PagerOutcome::NotPaged => {
                self.print(text);
                CommandOutcome::Success
            }
        }
    }

    /// Prints a note that is not part of a reply.
    pub fn print_note(&self, text: &str) {
        self.session.context().print_message(text);
    }

    /// Reports an error.
    pub fn report_error(&self, diagnostic: &Diagnostic) -> CommandOutcome {
        let width = match self.screen {
            ReplyTarget::Terminal(style) => style.width,
            ReplyTarget::Pipe => usize::MAX,
        };
        let message = diagnostic.render_within(self.colours(), width);
        self.session.context().print_styled_message(message.trim_end());
        CommandOutcome::Failed
    }

    /// Colours of replies.
    pub fn colours(&self) -> Colours {
        match self.screen {
            ReplyTarget::Terminal(style) => style.colours,
            ReplyTarget::Pipe => Colours::None,
        }
    }

    /// Largest width of a line of output [columns].
    pub fn width(&self) -> usize {
        match self.screen {
            ReplyTarget::Terminal(style) => style.width,
            ReplyTarget::Pipe => WIDTH,
        }
    }
}

/// Removes the error position in an input that a command generated, because the user has not typed this input.
fn without_position_in(input: &str, reply: Reply) -> Reply {
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

const LATEST: &str = "latest_simulation()";

impl Shell {
    /// Simulation that was started, loaded, copied, stepped or rewound most recently.
    pub fn latest(&self) -> Option<SimulationHandle> {
        self.session.context().latest_simulation()?.try_cast()
    }

    /// Returns true if a variable contains the last used simulation.
    pub fn has_latest_simulation(&self) -> bool {
        self.name_of_latest().is_ok_and(|name| name != LATEST)
    }

    fn name_of_latest(&self) -> Result<String, Diagnostic> {
        let Some(latest) = self.latest() else {
            return Err(no_simulation());
        };
        let is_it = |value: &rhai::Dynamic| {
            value.read_lock::<SimulationHandle>().is_some_and(|held| held.is_same(&latest))
        };
        let variables = self.session.variables();
        let held = variables.iter_raw().find(|(name, _, value)| *name != ANSWER && is_it(value));
        Ok(held.map_or_else(|| LATEST.into(), |(name, ..)| name.to_owned()))
    }

    /// Shows the time and the number of steps of the last used simulation.
    pub fn print_position(&self) {
        if let Some(latest) = self.latest() {
            let steps = latest.simulation().counts().steps;
            let plural = if steps == 1 { "" } else { "s" };
            let time = significant(latest.time(), 10);
            let ended = latest.simulation().ending().map(|ending| format!("; ended: {ending}"));
            let ended = ended.unwrap_or_default();
            let control = latest.step_control();
            self.print(&format!("t = {time} after {steps} step{plural}{control}{ended}"));
        }
    }

    fn input_for_latest(&self, call: &str) -> Result<String, Diagnostic> {
        self.name_of_latest().map(|name| format!("{name}.{call};"))
    }

    /// Evaluates a method call of the last used simulation as if the user had typed it.
    pub fn call_latest(&mut self, call: &str) -> CommandOutcome {
        match self.input_for_latest(call) {
            Ok(input) => {
                let reply = without_position_in(&input, self.session.eval(&input));
                self.print_reply(reply)
            }
            Err(refusal) => self.report_error(&refusal),
        }
    }

    /// Calls a method of the last used simulation for a command, records the call, and shows the watched expressions.
    /// If the call fails, a completed part of an advance or rewind is recorded.
    pub fn call_latest_and_watch(&mut self, call: &str) -> CommandOutcome {
        let input = match self.input_for_latest(call) {
            Ok(input) => input,
            Err(refusal) => return self.report_error(&refusal),
        };
        let before = self.session.simulation_positions();
        let outcome = match self.session.evaluate_preview(&input) {
            Reply::Value(_) => CommandOutcome::Success,
            reply => self.print_reply(without_position_in(&input, reply)),
        };
        match outcome {
            CommandOutcome::Success => {
                self.session.record_success(&input);
                self.show_watched()
            }
            failed => {
                self.session.record_movement(&before);
                failed
            }
        }
    }

    /// Calls a method of the last used simulation and shows the result.
    pub fn show_latest_result(&mut self, call: &str) -> CommandOutcome {
        match self.preview_latest(call) {
            Ok(reply) => self.print_reply(reply),
            Err(refusal) => self.report_error(&refusal),
        }
    }

    /// Evaluates a method of the last used simulation without changes of variables.
    ///
    /// # Errors
    /// Fails if there is no last used simulation.
    pub fn preview_latest(&mut self, call: &str) -> Result<Reply, Diagnostic> {
        let name = self.name_of_latest()?;
        Ok(self.session.evaluate_preview(&format!("{name}.{call}")))
    }

    /// End time of the next step of the last used simulation [time]; `None` if this simulation has reached `end` or has ended.
    pub fn next_stop(&self, end: f64) -> Option<f64> {
        let latest = self.latest()?;
        let simulation = latest.simulation();
        let is_there = simulation.has_reached(end) || simulation.has_ended();
        (!is_there).then(|| simulation.next_stop(end))
    }
}

/// Error message for a command that needs a simulation, if the session has none.
pub fn no_simulation() -> Diagnostic {
    Diagnostic::general("there is no simulation yet")
        .with_hint("start one: let sim = scene.start(#{ dt: 0.1 })")
}

/// Input without the text of a prompt at its start, as in a copied transcript.
fn without_prompt(input: &str) -> &str {
    let numbered = input.trim_start().strip_prefix("withy:");
    let rest = numbered.map(|rest| rest.trim_start_matches(|digit: char| digit.is_ascii_digit()));
    rest.and_then(|rest| rest.strip_prefix("> ")).unwrap_or(input)
}
