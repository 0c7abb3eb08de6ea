//! Command line: defines the options, starts runs and sessions, and shows the progress bar. Scripts are run by the modules `script` and `repl`.

mod args;
mod attempt_process;
mod console;
mod convert;
mod convert_options;
mod docs;
mod exit;
mod grade;
mod input_options;
mod interrupt;
mod learn;
mod learn_options;
mod limits;
mod lsp;
mod progress_display;
mod run;
mod saved;
mod session;
mod start;
mod tui;
mod view;
mod view_options;
mod watch;

pub use exit::Exit;
pub use start::main;
