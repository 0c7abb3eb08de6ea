//! State of the screen of `withy learn watch`, and the effect of keys on the state.

use std::mem;

use super::keys::Key;
use crate::exercises::catalogue::EXERCISES;
use crate::exercises::exercise::Exercise;
use crate::exercises::progress::StudentProgress;
use crate::exercises::report::{AttemptOutcome, AttemptReport};

#[derive(Clone, Debug)]
pub struct TuiState {
    pub exercise: &'static Exercise,
    pub file: String,
    pub progress: StudentProgress,
    pub last: Option<AttemptReport>,
    /// Seconds since the current run started; `None` without a run.
    pub running: Option<u64>,
    pub runs: usize,
    pub hints: usize,
    pub page: ScreenPage,
    pub top: ScrollPosition,
    pub notice: Option<String>,
    pub confirmation: Option<Confirmation>,
    pub typed: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScreenPage {
    Task,
    List(usize),
    Solution,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScrollPosition {
    Part(TaskSection),
    Line(usize),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TaskSection {
    Beginning,
    Result,
    Hint,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Confirmation {
    Skip,
    Solution,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyAction {
    Nothing,
    Leave,
    Suspend,
    Run,
    Open(&'static Exercise),
    Hint,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ScrollWindow {
    pub top: usize,
    pub last: usize,
    pub rows: usize,
}

impl TuiState {
    pub fn open(exercise: &'static Exercise, file: String, progress: StudentProgress) -> Self {
        Self {
            exercise,
            file,
            progress,
            last: None,
            running: None,
            runs: 0,
            hints: 0,
            page: ScreenPage::Task,
            top: ScrollPosition::Part(TaskSection::Beginning),
            notice: None,
            confirmation: None,
            typed: 0,
        }
    }

    pub fn number(&self) -> usize {
        index(self.exercise) + 1
    }

    pub fn passed(&self) -> usize {
        EXERCISES.iter().filter(|exercise| self.progress.has_passed(exercise)).count()
    }

    pub fn has_passed(&self) -> bool {
        match &self.last {
            Some(report) => report.outcome == AttemptOutcome::Passed,
            None => self.progress.has_passed(self.exercise),
        }
    }

    /// Returns the first exercise after the current one, cyclically, that has not been passed.
    pub fn next(&self) -> Option<&'static Exercise> {
        let (before, from) = EXERCISES.split_at(index(self.exercise));
        let others = from.iter().skip(1).chain(before);
        others.into_iter().find(|exercise| !self.progress.has_passed(exercise))
    }

    pub fn set_report(&mut self, report: AttemptReport) {
        self.progress.record(self.exercise, report.outcome == AttemptOutcome::Passed);
        self.running = None;
        self.runs += 1;
        self.last = Some(report);
    }

    pub fn press(&mut self, key: Key, window: ScrollWindow) -> KeyAction {
        self.notice = None;
        let asked = self.confirmation.take();
        let typed = mem::take(&mut self.typed);
        match (key, self.page) {
            (Key::Letter('q') | Key::Interrupt, _) => return KeyAction::Leave,
            (Key::Suspend, _) => return KeyAction::Suspend,
            (Key::Letter('l'), ScreenPage::Task | ScreenPage::Solution) => self.show_page(ScreenPage::List(index(self.exercise))),
            (Key::Letter('l' | 's') | Key::Escape, ScreenPage::List(_) | ScreenPage::Solution) => self.show_page(ScreenPage::Task),
            (_, ScreenPage::List(chosen)) => return self.choose(key, chosen, typed, window),
            (Key::Letter('h'), ScreenPage::Task) => return self.ask_for_hint(asked),
            (Key::Letter('r'), _) => {
                self.page = ScreenPage::Task;
                return KeyAction::Run;
            }
            (Key::Letter('n'), _) => return self.next_exercise(asked),
            (Key::Letter('p'), _) => match index(self.exercise).checked_sub(1) {
                Some(before) => return KeyAction::Open(&EXERCISES[before]),
                None => self.set_notice("this is the first exercise"),
            },
            (Key::Letter('s'), ScreenPage::Task) if self.has_passed() => self.show_page(ScreenPage::Solution),
            (Key::Letter('s'), _) => self.set_notice(
                "the solution is shown after the exercise is passed; h gives one more hint each time, and a solution after the last one",
            ),
            _ => self.scroll(key, window),
        }
        KeyAction::Nothing
    }

    fn show_page(&mut self, page: ScreenPage) {
        self.page = page;
        let part = if page == ScreenPage::Task && self.runs > 0 {
            TaskSection::Result
        } else {
            TaskSection::Beginning
        };
        self.top = ScrollPosition::Part(part);
    }

    fn set_notice(&mut self, notice: &str) {
        self.notice = Some(notice.into());
    }

    fn ask_for_hint(&mut self, asked: Option<Confirmation>) -> KeyAction {
        let count = self.exercise.judge().hints.len();
        if self.hints < count {
            self.top = ScrollPosition::Part(TaskSection::Hint);
            return KeyAction::Hint;
        }
        match asked {
            Some(Confirmation::Solution) => self.show_page(ScreenPage::Solution),
            _ => {
                self.confirmation = Some(Confirmation::Solution);
                self.set_notice("there are no more hints; h again shows a solution");
            }
        }
        KeyAction::Nothing
    }

    fn next_exercise(&mut self, asked: Option<Confirmation>) -> KeyAction {
        match self.next() {
            None if self.has_passed() => {
                self.set_notice("all exercises are passed; l lists them, q exits")
            }
            None => self.set_notice("this is the only exercise not passed yet"),
            Some(next) if self.has_passed() || asked == Some(Confirmation::Skip) => {
                return KeyAction::Open(next);
            }
            Some(_) => {
                self.confirmation = Some(Confirmation::Skip);
                self.set_notice("this exercise is not passed yet; n again skips it");
            }
        }
        KeyAction::Nothing
    }

    fn choose(&mut self, key: Key, chosen: usize, typed: usize, window: ScrollWindow) -> KeyAction {
        let last = EXERCISES.len() - 1;
        let chosen = match key {
            Key::Enter => return KeyAction::Open(&EXERCISES[chosen]),
            Key::Up | Key::Letter('k') => chosen.saturating_sub(1),
            Key::Down | Key::Letter('j') => (chosen + 1).min(last),
            Key::PageUp => chosen.saturating_sub(window.rows),
            Key::PageDown | Key::Letter(' ') => (chosen + window.rows).min(last),
            Key::Home => 0,
            Key::End => last,
            Key::Letter(digit) if digit.is_ascii_digit() => {
                let digit = digit as usize - '0' as usize;
                let numbers = [typed * 10 + digit, digit];
                let number = numbers.into_iter().find(|number| (1..=last + 1).contains(number));
                self.typed = number.unwrap_or_default();
                number.map_or(chosen, |number| number - 1)
            }
            _ => {
                self.set_notice("arrows or a number select an exercise, Enter opens it, l returns");
                chosen
            }
        };
        self.page = ScreenPage::List(chosen);
        KeyAction::Nothing
    }

    fn scroll(&mut self, key: Key, window: ScrollWindow) {
        let ScrollWindow { top, last, rows } = window;
        let top = match key {
            Key::Up | Key::Letter('k') => top.saturating_sub(1),
            Key::Down | Key::Letter('j') => top + 1,
            Key::PageUp => top.saturating_sub(rows.max(2) - 1),
            Key::PageDown | Key::Letter(' ') => top + rows.max(2) - 1,
            Key::Home => 0,
            Key::End => last,
            Key::Enter | Key::Escape => return,
            Key::Letter(letter) => {
                return self.set_notice(&format!(
                    "the key {letter} has no function here; see the keys below"
                ));
            }
            _ => return self.set_notice("this key has no function here; see the keys below"),
        };
        self.top = ScrollPosition::Line(top.min(last));
    }
}

pub fn index(exercise: &Exercise) -> usize {
    EXERCISES.iter().position(|other| other == exercise).unwrap_or_default()
}

#[cfg(test)]
mod tests;
