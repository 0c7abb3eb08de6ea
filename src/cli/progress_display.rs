//! Shows a progress bar in a terminal.

use std::cell::{Cell, RefCell};
use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::output::printable_line;
use crate::script::messages::numbers::format_number;
use crate::script::messages::progress::{NoProgress, Progress};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProgressPreference {
    Show,
    Hide,
}

pub fn progress(wish: ProgressPreference) -> Box<dyn Progress + Send> {
    match wish == ProgressPreference::Show && stderr().is_terminal() {
        true => Box::new(ProgressDisplay::default()),
        false => Box::new(NoProgress),
    }
}

#[derive(Default)]
struct ProgressDisplay {
    start: Cell<Option<Instant>>,
    name: RefCell<String>,
    from: Cell<f64>,
    to: Cell<f64>,
    shown: RefCell<Option<ProgressBar>>,
}

const PARTS: u64 = 1000;
const SHORTEST_SHOWN: Duration = Duration::from_millis(300);

impl ProgressDisplay {
    fn create_bar(&self) -> ProgressBar {
        let bar = ProgressBar::new(PARTS);
        // The default bar is used if the template is invalid.
        let style = ProgressStyle::with_template("{prefix} {wide_bar} {msg} {eta}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.set_prefix(self.name.borrow().clone());
        bar.enable_steady_tick(Duration::from_millis(200));
        bar
    }

    fn show(&self, reached: f64, message: impl FnOnce() -> String) {
        let mut shown = self.shown.borrow_mut();
        if shown.is_none() && self.start.get().is_none_or(|begun| begun.elapsed() < SHORTEST_SHOWN)
        {
            return;
        }
        let bar = shown.get_or_insert_with(|| self.create_bar());
        let fraction = (reached - self.from.get()) / (self.to.get() - self.from.get());
        bar.set_position((fraction.clamp(0.0, 1.0) * PARTS as f64) as u64);
        bar.set_message(message());
    }
}

impl Progress for ProgressDisplay {
    fn begin(&self, name: &str, from: f64, to: f64) {
        self.end();
        self.from.set(from);
        self.to.set(to);
        *self.name.borrow_mut() = printable_line(name);
        self.start.set(Some(Instant::now()));
    }

    fn report_time(&self, t: f64) {
        self.show(t, || format!("t = {}", format_number((t * 1e6).round() / 1e6)));
    }

    fn begin_cases(&self, name: &str, count: usize) {
        self.begin(name, 0.0, count as f64);
    }

    fn report_case(&self, done: usize) {
        self.show(done as f64, || format!("{done} of {} cases", self.to.get()));
    }

    fn end(&self) {
        self.start.set(None);
        if let Some(bar) = self.shown.borrow_mut().take() {
            bar.finish_and_clear();
        }
    }

    fn without_progress_bar(&self, write: &mut dyn FnMut()) {
        match &*self.shown.borrow() {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_bar_is_shown_only_for_long_runs() {
        let bar = ProgressDisplay::default();
        bar.begin("rod", 0.0, 1.0);
        bar.report_time(0.5);
        assert!(bar.shown.borrow().is_none());
        std::thread::sleep(SHORTEST_SHOWN);
        bar.report_time(0.6);
        assert!(bar.shown.borrow().is_some());
        bar.end();
        bar.report_time(0.7);
        assert!(bar.shown.borrow().is_none());
    }

    #[test]
    fn progress_bar_of_a_study_counts_its_cases() {
        let bar = ProgressDisplay::default();
        bar.begin_cases("flight", 8);
        std::thread::sleep(SHORTEST_SHOWN);
        bar.report_case(2);
        let shown = bar.shown.borrow();
        let shown = shown.as_ref().expect("a bar");
        assert_eq!((shown.position(), shown.message().as_str()), (PARTS / 4, "2 of 8 cases"));
    }
}
