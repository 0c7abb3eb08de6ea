//! Event loop of `withy learn watch`. It handles keys, saved files and finished runs.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::judge_process::{JudgeProcess, cannot};
use super::keys::Key;
use super::line::ScreenLine;
use super::screen::screen;
use super::solution::ScriptPainter;
use super::state::{KeyAction, ScreenPage, ScrollPosition, ScrollWindow, TaskSection, TuiState};
use super::terminal::RawTerminal;
use crate::cli::learn::shown;
use crate::cli::limits::LimitOptions;
use crate::exercises::catalogue::EXERCISES;
use crate::exercises::error::ExerciseError;
use crate::exercises::exercise::Exercise;
use crate::exercises::report::AttemptOutcome;
use crate::exercises::watch::{INTERVAL, Watcher};
use crate::exercises::workbook::{Advice, Workbook};
use crate::panics::caught;

const POLLING_INTERVAL: Duration = Duration::from_millis(50);

pub(in crate::cli) fn watch(
    workbook: &Workbook,
    limits: &LimitOptions,
    stop: &AtomicBool,
) -> Result<(), ExerciseError> {
    let mut event_loop = EventLoop::open(workbook, limits)?;
    // A panic is caught, so that it is reported only after the terminal has been restored.
    let done = caught(|| {
        let mut terminal = RawTerminal::enter()?;
        event_loop.work(&mut terminal, stop)
    });
    let done = done
        .unwrap_or_else(|panic| Err(io::Error::other(format!("internal error of withy: {panic}"))));
    done.map_err(ExerciseError::Terminal)
}

struct EventLoop<'a> {
    workbook: &'a Workbook,
    limits: &'a LimitOptions,
    watcher: Watcher<'a>,
    last_check: Instant,
    judge_process: Option<JudgeProcess>,
    painter: ScriptPainter,
    solution: Vec<ScreenLine>,
    state: TuiState,
}

impl<'a> EventLoop<'a> {
    fn open(workbook: &'a Workbook, limits: &'a LimitOptions) -> Result<Self, ExerciseError> {
        let next = workbook.next()?;
        let exercise = next.unwrap_or(&EXERCISES[0]);
        let painter = ScriptPainter::new();
        let mut event_loop = Self {
            workbook,
            limits,
            watcher: Watcher::new(workbook),
            last_check: Instant::now(),
            judge_process: None,
            solution: painter.solution(exercise),
            painter,
            state: TuiState::open(exercise, shown(&workbook.file(exercise)), workbook.progress()?),
        };
        event_loop.run();
        if next.is_none() {
            event_loop.state.page = ScreenPage::List(0);
            event_loop.state.notice = Some("All exercises are passed. Congratulations!".into());
        }
        Ok(event_loop)
    }

    fn work(&mut self, terminal: &mut RawTerminal, stop: &AtomicBool) -> io::Result<()> {
        while !stop.load(Ordering::Relaxed) {
            self.check_files();
            let size = terminal.size();
            let screen = screen(&self.state, size, &self.solution);
            terminal.show(&screen.lines, size)?;
            let Some(key) = terminal.key(POLLING_INTERVAL)? else { continue };
            match self.press(key, screen.window) {
                KeyAction::Leave => break,
                KeyAction::Suspend => terminal.suspend()?,
                _ => {}
            }
        }
        Ok(())
    }

    fn press(&mut self, key: Key, window: ScrollWindow) -> KeyAction {
        let wish = self.state.press(key, window);
        match wish {
            KeyAction::Run => {
                self.run();
                self.state.top = ScrollPosition::Part(TaskSection::Result);
            }
            KeyAction::Open(exercise) => self.select_exercise(exercise),
            KeyAction::Hint => self.hint(),
            KeyAction::Nothing | KeyAction::Leave | KeyAction::Suspend => {}
        }
        wish
    }

    fn check_files(&mut self) {
        if self.last_check.elapsed() >= INTERVAL {
            self.last_check = Instant::now();
            if let Some(exercise) = self.watcher.changed() {
                if exercise != self.state.exercise {
                    self.select_exercise(exercise);
                } else {
                    self.run();
                }
                self.state.page = ScreenPage::Task;
                self.state.top = ScrollPosition::Part(TaskSection::Result);
                self.state.notice = None;
            }
        }
        let Some(trial) = &mut self.judge_process else { return };
        self.state.running = Some(trial.seconds());
        if let Some(report) = trial.result() {
            self.judge_process = None;
            if report.outcome != AttemptOutcome::Interrupted {
                let has_passed = report.outcome == AttemptOutcome::Passed;
                if let Err(error) = self.workbook.record(self.state.exercise, has_passed) {
                    self.state.notice = Some(format!("the result was not recorded: {error}"));
                }
            }
            self.state.set_report(report);
            if let Ok(progress) = self.workbook.progress() {
                self.state.progress = progress;
            }
        }
    }

    fn select_exercise(&mut self, exercise: &'static Exercise) {
        // An error of reading the progress file is ignored here, because the next write reports it.
        let progress = self.workbook.progress().unwrap_or_else(|_| self.state.progress.clone());
        self.state = TuiState::open(exercise, shown(&self.workbook.file(exercise)), progress);
        self.solution = self.painter.solution(exercise);
        self.run();
    }

    fn run(&mut self) {
        self.judge_process = None;
        match JudgeProcess::begin(self.state.exercise, self.limits) {
            Ok(trial) => {
                self.judge_process = Some(trial);
                self.state.running = Some(0);
            }
            Err(error) => self.state.set_report(cannot(&error)),
        }
    }

    fn hint(&mut self) {
        let exercise = self.state.exercise;
        let given = self.state.progress.hints(exercise);
        if given > self.state.hints {
            self.state.hints = given;
            return;
        }
        match self.workbook.hint(exercise) {
            Ok(Advice::Hint { number, .. }) => {
                self.state.hints = number;
                self.state.progress.record_hint(exercise);
            }
            Ok(Advice::Solution(_)) => self.state.hints = exercise.judge().hints.len(),
            Err(error) => self.state.notice = Some(format!("the result was not recorded: {error}")),
        }
    }
}
