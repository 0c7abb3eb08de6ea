//! `withy learn watch` at a terminal: one screen with task, file, result and hints; keys; the attempt in a process of its own.
//!
//! ```text
//! desk (the loop) → terminal → keys
//!                 → trial (a process for each run)
//!                 → screen → outcome, solution → line      lines from a state, and nothing else
//!                 → state                                  what keys do
//! ```

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
