//! `withy learn watch` in a terminal. One screen shows the task, the file, the result and the hints.
//! Each attempt runs in a separate process.
//!
//! The module `event_loop` reads keys, changes the state, starts the process of a run and draws the screen.

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
