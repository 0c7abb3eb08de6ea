//! What the screen is made of, and what keys do to it. Plain data: nothing here runs, reads or draws.

use std::mem;

use super::keys::Key;
use crate::exercises::catalogue::EXERCISES;
use crate::exercises::exercise::Exercise;
use crate::exercises::progress::Progress;
use crate::exercises::report::{Outcome, Report};

/// All that is shown.
#[derive(Clone, Debug)]
pub struct State {
    /// The exercise at hand.
    pub exercise: &'static Exercise,
    /// Its file, as one would type it.
    pub file: String,
    /// What is passed.
    pub progress: Progress,
    /// What came of the last run of its attempt, if one has ended.
    pub last: Option<Report>,
    /// The seconds of the run that is going on.
    pub running: Option<u64>,
    /// Runs since the exercise was opened.
    pub runs: usize,
    /// Hints that are shown.
    pub hints: usize,
    /// What fills the screen.
    pub page: Page,
    /// Where the page begins.
    pub top: Top,
    /// A word to who pressed a key.
    pub notice: Option<String>,
    /// What the same key does when it is pressed once more.
    pub asked: Option<Asked>,
    /// The number that is being typed into the list; 0 where there is none.
    pub typed: usize,
}

/// What fills the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Page {
    /// The task, what came of it, hints.
    Task,
    /// All exercises; the one with this index is chosen.
    List(usize),
    /// A solution.
    Solution,
}

/// The first line of a page that is longer than the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Top {
    /// So that this part is seen.
    Part(Part),
    /// This line.
    Line(usize),
}

/// A part of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Its beginning.
    Beginning,
    /// What came of the attempt.
    Result,
    /// The last hint.
    Hint,
}

/// What was asked before it is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// To leave an exercise that is not passed.
    Skip,
    /// To see a solution when all hints were given.
    Solution,
}

/// What a key asks for that takes more than another picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wish {
    /// Nothing.
    Nothing,
    /// To leave.
    Leave,
    /// To stop for a while, as Ctrl-Z does.
    Suspend,
    /// To run the attempt again.
    Run,
    /// Another exercise.
    Open(&'static Exercise),
    /// One more hint.
    Hint,
}

/// Which lines of the page were on the screen, for keys that scroll.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Window {
    /// The first one.
    pub top: usize,
    /// The last one that can be the first.
    pub last: usize,
    /// How many there is room for.
    pub rows: usize,
}

impl State {
    /// At the beginning of an exercise.
    pub fn open(exercise: &'static Exercise, file: String, progress: Progress) -> Self {
        Self {
            exercise,
            file,
            progress,
            last: None,
            running: None,
            runs: 0,
            hints: 0,
            page: Page::Task,
            top: Top::Part(Part::Beginning),
            notice: None,
            asked: None,
            typed: 0,
        }
    }

    /// Its number, from 1.
    pub fn number(&self) -> usize {
        index(self.exercise) + 1
    }

    /// How many exercises are passed.
    pub fn passed(&self) -> usize {
        EXERCISES.iter().filter(|exercise| self.progress.has_passed(exercise)).count()
    }

    /// Whether the exercise at hand is passed.
    pub fn has_passed(&self) -> bool {
        match &self.last {
            Some(report) => report.outcome == Outcome::Passed,
            None => self.progress.has_passed(self.exercise),
        }
    }

    /// The exercise to go to: the first behind this one that is not passed, else the first of all.
    pub fn next(&self) -> Option<&'static Exercise> {
        let (before, from) = EXERCISES.split_at(index(self.exercise));
        let others = from.iter().skip(1).chain(before);
        others.into_iter().find(|exercise| !self.progress.has_passed(exercise))
    }

    /// Notes what came of a run.
    pub fn tell(&mut self, report: Report) {
        self.progress.note(self.exercise, report.outcome == Outcome::Passed);
        self.running = None;
        self.runs += 1;
        self.last = Some(report);
    }

    /// Does what a key asks for, as far as it concerns what is shown.
    pub fn press(&mut self, key: Key, window: Window) -> Wish {
        self.notice = None;
        let asked = self.asked.take();
        let typed = mem::take(&mut self.typed);
        match (key, self.page) {
            (Key::Letter('q') | Key::Interrupt, _) => return Wish::Leave,
            (Key::Suspend, _) => return Wish::Suspend,
            (Key::Letter('l'), Page::Task | Page::Solution) => self.turn_to(Page::List(index(self.exercise))),
            (Key::Letter('l' | 's') | Key::Escape, Page::List(_) | Page::Solution) => self.turn_to(Page::Task),
            (_, Page::List(chosen)) => return self.choose(key, chosen, typed, window),
            (Key::Letter('h'), Page::Task) => return self.ask_for_hint(asked),
            (Key::Letter('r'), _) => {
                self.page = Page::Task;
                return Wish::Run;
            }
            (Key::Letter('n'), _) => return self.go_on(asked),
            (Key::Letter('p'), _) => match index(self.exercise).checked_sub(1) {
                Some(before) => return Wish::Open(&EXERCISES[before]),
                None => self.say("this is the first exercise"),
            },
            (Key::Letter('s'), Page::Task) if self.has_passed() => self.turn_to(Page::Solution),
            (Key::Letter('s'), _) => self.say(
                "a solution is shown when you have passed; h gives a hint, one more each time, and after the last one a solution",
            ),
            _ => self.scroll(key, window),
        }
        Wish::Nothing
    }

    fn turn_to(&mut self, page: Page) {
        self.page = page;
        let part = if page == Page::Task && self.runs > 0 { Part::Result } else { Part::Beginning };
        self.top = Top::Part(part);
    }

    fn say(&mut self, notice: &str) {
        self.notice = Some(notice.into());
    }

    fn ask_for_hint(&mut self, asked: Option<Asked>) -> Wish {
        let count = self.exercise.judge().hints.len();
        if self.hints < count {
            self.top = Top::Part(Part::Hint);
            return Wish::Hint;
        }
        match asked {
            Some(Asked::Solution) => self.turn_to(Page::Solution),
            _ => {
                self.asked = Some(Asked::Solution);
                self.say("these are all the hints; h once more shows a solution");
            }
        }
        Wish::Nothing
    }

    fn go_on(&mut self, asked: Option<Asked>) -> Wish {
        match self.next() {
            None if self.has_passed() => {
                self.say("all exercises are passed; l lists them, q leaves")
            }
            None => self.say("this is the only one that is left"),
            Some(next) if self.has_passed() || asked == Some(Asked::Skip) => {
                return Wish::Open(next);
            }
            Some(_) => {
                self.asked = Some(Asked::Skip);
                self.say("this one is not passed yet; n once more leaves it for later");
            }
        }
        Wish::Nothing
    }

    fn choose(&mut self, key: Key, chosen: usize, typed: usize, window: Window) -> Wish {
        let last = EXERCISES.len() - 1;
        let chosen = match key {
            Key::Enter => return Wish::Open(&EXERCISES[chosen]),
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
        self.page = Page::List(chosen);
        Wish::Nothing
    }

    fn scroll(&mut self, key: Key, window: Window) {
        let Window { top, last, rows } = window;
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
        self.top = Top::Line(top.min(last));
    }
}

/// The place of an exercise in the table.
pub fn index(exercise: &Exercise) -> usize {
    EXERCISES.iter().position(|other| other == exercise).unwrap_or_default()
}

#[cfg(test)]
mod tests;
