//! What the screen is made of, and what keys do to it. Plain data: nothing here runs, reads or draws.

use std::mem;

use super::keys::Key;
use crate::exercises::catalogue::EXERCISES;
use crate::exercises::exercise::Exercise;
use crate::exercises::progress::StudentProgress;
use crate::exercises::report::{AttemptOutcome, AttemptReport};

/// The state of `withy learn watch`: all that is shown.
#[derive(Clone, Debug)]
pub struct TuiState {
    /// The exercise that is shown.
    pub exercise: &'static Exercise,
    /// The file of the exercise, as one would type it.
    pub file: String,
    /// The student's progress: which exercises are passed.
    pub progress: StudentProgress,
    /// What became of the last run of the attempt, if one has ended.
    pub last: Option<AttemptReport>,
    /// The seconds of the run that is going on, if one is.
    pub running: Option<u64>,
    /// The number of runs since the exercise was opened.
    pub runs: usize,
    /// The number of hints that are shown.
    pub hints: usize,
    /// The page that fills the screen.
    pub page: ScreenPage,
    /// The first line of the page on the screen.
    pub top: ScrollPosition,
    /// A word to the person who pressed a key.
    pub notice: Option<String>,
    /// The question that was asked: what the same key does when it is pressed once more.
    pub asked: Option<Confirmation>,
    /// The number that is being typed into the list of exercises; 0 where there is none.
    pub typed: usize,
}

/// A page that fills the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScreenPage {
    /// The page with the task, what became of the attempt, hints.
    Task,
    /// The page with all exercises; the one with this index is chosen.
    List(usize),
    /// The page with a solution.
    Solution,
}

/// The first line of a page that is longer than the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScrollPosition {
    /// The page begins so that this part is seen.
    Part(TaskSection),
    /// The page begins with this line, from 0.
    Line(usize),
}

/// A part of the page with the task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TaskSection {
    /// The beginning of the page.
    Beginning,
    /// What became of the attempt.
    Result,
    /// The last hint to the exercise.
    Hint,
}

/// A question that is asked before something is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Confirmation {
    /// Whether to leave an exercise that is not passed.
    Skip,
    /// Whether to see a solution when all hints were given.
    Solution,
}

/// What a key asks for that takes more than drawing the screen anew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyAction {
    /// The key asks for nothing more.
    Nothing,
    /// The key asks to leave.
    Leave,
    /// The key asks to stop for a while, as Ctrl-Z does.
    Suspend,
    /// The key asks to run the attempt again.
    Run,
    /// The key asks for another exercise.
    Open(&'static Exercise),
    /// The key asks for one more hint.
    Hint,
}

/// Which lines of the page were on the screen, for keys that scroll.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ScrollWindow {
    /// The first line of the page on the screen, from 0.
    pub top: usize,
    /// The last line of the page that can be the first on the screen.
    pub last: usize,
    /// The number of lines that there is room for on the screen.
    pub rows: usize,
}

impl TuiState {
    /// The state at the beginning of an exercise.
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
            asked: None,
            typed: 0,
        }
    }

    /// The number of the exercise that is shown, from 1.
    pub fn number(&self) -> usize {
        index(self.exercise) + 1
    }

    /// How many exercises the student has passed.
    pub fn passed(&self) -> usize {
        EXERCISES.iter().filter(|exercise| self.progress.has_passed(exercise)).count()
    }

    /// Whether the student has passed the exercise that is shown.
    pub fn has_passed(&self) -> bool {
        match &self.last {
            Some(report) => report.outcome == AttemptOutcome::Passed,
            None => self.progress.has_passed(self.exercise),
        }
    }

    /// The exercise to go to: the first behind the one that is shown that is not passed, else the first of all.
    pub fn next(&self) -> Option<&'static Exercise> {
        let (before, from) = EXERCISES.split_at(index(self.exercise));
        let others = from.iter().skip(1).chain(before);
        others.into_iter().find(|exercise| !self.progress.has_passed(exercise))
    }

    /// Notes what became of a run of the attempt.
    pub fn tell(&mut self, report: AttemptReport) {
        self.progress.note(self.exercise, report.outcome == AttemptOutcome::Passed);
        self.running = None;
        self.runs += 1;
        self.last = Some(report);
    }

    /// Does what a key asks for, as far as it concerns what is shown; gives what more it asks for.
    pub fn press(&mut self, key: Key, window: ScrollWindow) -> KeyAction {
        self.notice = None;
        let asked = self.asked.take();
        let typed = mem::take(&mut self.typed);
        match (key, self.page) {
            (Key::Letter('q') | Key::Interrupt, _) => return KeyAction::Leave,
            (Key::Suspend, _) => return KeyAction::Suspend,
            (Key::Letter('l'), ScreenPage::Task | ScreenPage::Solution) => self.turn_to(ScreenPage::List(index(self.exercise))),
            (Key::Letter('l' | 's') | Key::Escape, ScreenPage::List(_) | ScreenPage::Solution) => self.turn_to(ScreenPage::Task),
            (_, ScreenPage::List(chosen)) => return self.choose(key, chosen, typed, window),
            (Key::Letter('h'), ScreenPage::Task) => return self.ask_for_hint(asked),
            (Key::Letter('r'), _) => {
                self.page = ScreenPage::Task;
                return KeyAction::Run;
            }
            (Key::Letter('n'), _) => return self.go_on(asked),
            (Key::Letter('p'), _) => match index(self.exercise).checked_sub(1) {
                Some(before) => return KeyAction::Open(&EXERCISES[before]),
                None => self.say("this is the first exercise"),
            },
            (Key::Letter('s'), ScreenPage::Task) if self.has_passed() => self.turn_to(ScreenPage::Solution),
            (Key::Letter('s'), _) => self.say(
                "a solution is shown when you have passed; h gives a hint, one more each time, and after the last one a solution",
            ),
            _ => self.scroll(key, window),
        }
        KeyAction::Nothing
    }

    fn turn_to(&mut self, page: ScreenPage) {
        self.page = page;
        let part = if page == ScreenPage::Task && self.runs > 0 {
            TaskSection::Result
        } else {
            TaskSection::Beginning
        };
        self.top = ScrollPosition::Part(part);
    }

    fn say(&mut self, notice: &str) {
        self.notice = Some(notice.into());
    }

    fn ask_for_hint(&mut self, asked: Option<Confirmation>) -> KeyAction {
        let count = self.exercise.judge().hints.len();
        if self.hints < count {
            self.top = ScrollPosition::Part(TaskSection::Hint);
            return KeyAction::Hint;
        }
        match asked {
            Some(Confirmation::Solution) => self.turn_to(ScreenPage::Solution),
            _ => {
                self.asked = Some(Confirmation::Solution);
                self.say("these are all the hints; h once more shows a solution");
            }
        }
        KeyAction::Nothing
    }

    fn go_on(&mut self, asked: Option<Confirmation>) -> KeyAction {
        match self.next() {
            None if self.has_passed() => {
                self.say("all exercises are passed; l lists them, q leaves")
            }
            None => self.say("this is the only one that is left"),
            Some(next) if self.has_passed() || asked == Some(Confirmation::Skip) => {
                return KeyAction::Open(next);
            }
            Some(_) => {
                self.asked = Some(Confirmation::Skip);
                self.say("this one is not passed yet; n once more leaves it for later");
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
            // Digits one after another make a number.
            Key::Letter(digit) if digit.is_ascii_digit() => {
                let digit = digit as usize - '0' as usize;
                let numbers = [typed * 10 + digit, digit];
                let number = numbers.into_iter().find(|number| (1..=last + 1).contains(number));
                self.typed = number.unwrap_or_default();
                number.map_or(chosen, |number| number - 1)
            }
            _ => {
                self.say("arrows or a number choose an exercise, Enter opens it, l goes back");
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
                return self
                    .say(&format!("the key {letter} does nothing here; below are those that do"));
            }
            _ => return self.say("this key does nothing here; below are those that do"),
        };
        self.top = ScrollPosition::Line(top.min(last));
    }
}

/// The index of the exercise in the table of all.
pub fn index(exercise: &Exercise) -> usize {
    EXERCISES.iter().position(|other| other == exercise).unwrap_or_default()
}

#[cfg(test)]
mod tests;
