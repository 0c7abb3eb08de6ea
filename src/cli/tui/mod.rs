//! `withy learn watch` in a terminal: one screen with the task, the file, the result and the hints.

mod event_loop;
pub(super) mod judge_process;
mod keys;
mod line;
mod result_page;
mod screen;
mod solution;
mod state;
pub(super) mod terminal;

pub(super) use event_loop::watch;
pub(super) use solution::ScriptPainter;
