//! The command line: definitions, running, sessions, and the progress bar. What it does is done by `script` and `repl`.

mod args;
mod attempt_process;
mod bar;
mod docs;
mod exit;
mod grade;
mod interrupt;
mod learn;
mod learn_options;
mod limits;
mod run;
mod say;
mod session;
mod start;
mod view;
mod view_options;
mod watching;

pub use exit::Exit;
pub use start::main;
