//! The program as users run it: commands, exit codes, files, limits, pipes and terminals.

mod cli;
mod convert;
mod docs_command;
mod editors;
mod gallery;
mod inputs;
mod language_server;
mod learn_command;
mod learn_watch;
mod limits;
mod repl_pipe;
mod repl_terminal;
mod scripts;
mod studies;
mod sweeps;
mod viewers;
