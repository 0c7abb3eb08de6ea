//! Definitions of the command line arguments.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use super::convert_options::ConvertOptions;
use super::input_options::InputOptions;
use super::learn_options::LearnOptions;
use super::limits::LimitOptions;
use super::view_options::ViewOptions;
use crate::repl::terminal::line_editor::Keys;
use crate::script::state::parts::StudyPart;

/// Simulates the planar dynamics of flexible beams from scripts.
///
/// Without a command it opens the interactive prompt.
#[derive(Parser)]
#[command(version, args_conflicts_with_subcommands = true, after_help = EXIT_CODES)]
pub struct CliArguments {
    /// Command.
    #[command(subcommand)]
    pub command: Option<CliCommand>,
    /// Options of a session without a command.
    #[command(flatten)]
    pub session: SessionOptions,
}

/// Commands of withy.
#[derive(Subcommand)]
pub enum CliCommand {
    /// Runs a script.
    #[command(after_help = EXIT_CODES)]
    Run(RunOptions),
    /// Runs a script with studies; an interrupted study continues with its unfinished cases.
    #[command(after_help = EXIT_CODES)]
    Study(StudyOptions),
    /// Checks a script: parses it and builds its scenes, without running, printing or writing anything.
    #[command(after_help = EXIT_CODES)]
    Check(CheckOptions),
    /// Converts a saved simulation to files for ParaView or NumPy, a table or a web page.
    #[command(after_help = EXIT_CODES)]
    Convert(ConvertOptions),
    /// Writes an animated page of a saved simulation, or of the simulations of a script, and opens it in a browser.
    #[command(after_help = EXIT_CODES)]
    View(ViewOptions),
    /// Shows the help on one name or the whole reference, or writes definition files for editors.
    Docs(DocsOptions),
    /// Offers exercises with hints and automatic judging.
    Learn(LearnOptions),
    /// Opens the interactive prompt; without a terminal it reads inputs from a pipe.
    #[command(after_help = EXIT_CODES)]
    Repl(ReplOptions),
    /// Starts the language server for editors: errors while typing, completion, help and definitions.
    ///
    /// The editor starts it, and exchanges messages of the Language Server Protocol with it through stdin and stdout. Scripts are checked as by `withy check`.
    #[command(after_help = LSP_EXIT_CODES)]
    Lsp,
}

/// Options of `withy repl`.
#[derive(Args)]
pub struct ReplOptions {
    /// Script that is evaluated first, as if it had been typed.
    pub file: Option<PathBuf>,
    /// Inputs of the script.
    #[command(flatten)]
    pub inputs: InputOptions,
    /// Options of the session.
    #[command(flatten)]
    pub session: SessionOptions,
}

/// Options of a session, with a terminal or without.
#[derive(Args)]
pub struct SessionOptions {
    /// Evaluates this input and exits; may be repeated.
    #[arg(short = 'e', long = "evaluate", value_name = "INPUT", allow_hyphen_values = true)]
    pub inputs: Vec<String>,
    /// Folder for pictures and tables; created with the first file.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Memory for the snapshots of each simulation, in megabytes.
    #[arg(long, value_name = "MB", default_value_t = 256)]
    pub snapshots: u32,
    /// Keys of the line editor; the environment variable WITHY_KEYS sets the default.
    #[arg(long, value_enum)]
    pub keys: Option<KeyBindings>,
    /// Draws with ASCII characters only.
    #[arg(long)]
    pub ascii: bool,
    /// Limits of the session; time and steps apply to each input.
    #[command(flatten)]
    pub limits: LimitOptions,
}

/// Keys of the line editor.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum KeyBindings {
    /// Key bindings as in Emacs and most shells.
    Emacs,
    /// Key bindings as in vi.
    Vi,
}

impl From<KeyBindings> for Keys {
    fn from(keys: KeyBindings) -> Self {
        match keys {
            KeyBindings::Emacs => Self::Emacs,
            KeyBindings::Vi => Self::Vi,
        }
    }
}

/// Options of `withy run`.
#[derive(Args)]
pub struct RunOptions {
    /// Script, a .rhai file.
    pub file: PathBuf,
    /// Folder for pictures and tables; created with the first file.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Writes the reports of all simulations to this JSON file, also after a failure.
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
    /// Estimates the discretisation errors of all simulations. The estimates need additional runs with larger steps and on other meshes.
    /// With auto, errors are estimated only if the output is a terminal and the run took less than a second.
    #[arg(long, value_enum, value_name = "WHEN", default_value_t = ErrorChoice::Auto, num_args = 0..=1, require_equals = true, default_missing_value = "always")]
    pub error: ErrorChoice,
    /// Hides the progress bar and the closing lines; printed text and errors are still shown.
    #[arg(long, short)]
    pub quiet: bool,
    /// Runs again whenever the script, or a file that it imports or reads, has changed. Ctrl-C ends.
    #[arg(long)]
    pub watch: bool,
    /// Inputs of the script.
    #[command(flatten)]
    pub inputs: InputOptions,
    /// Limits of the script.
    #[command(flatten)]
    pub limits: LimitOptions,
}

/// Condition under which discretisation errors are estimated after a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ErrorChoice {
    /// No estimate.
    Never,
    /// Estimate on a terminal, after runs of less than a second.
    Auto,
    /// Estimate after every run.
    Always,
}

/// Options of `withy study`.
#[derive(Args)]
pub struct StudyOptions {
    /// Script, a .rhai file.
    pub file: PathBuf,
    /// Folder for tables, pictures and journals of finished cases; created with the first file.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Discards the finished cases of an interrupted run of these studies.
    #[arg(long)]
    pub fresh: bool,
    /// Computes only this part of each study, such as 3/16, and stores it in the output folder for --merge.
    #[arg(long, value_name = "K/N", conflicts_with = "merge")]
    pub part: Option<StudyPart>,
    /// Joins the parts in these folders; the files are identical to those of a single run.
    #[arg(long, value_name = "DIR", num_args = 1.., conflicts_with = "fresh")]
    pub merge: Vec<PathBuf>,
    /// Number of timed repetitions of each run; overrides the script.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub repeats: Option<u32>,
    /// Hides the progress bar and the closing lines; printed text and errors are still shown.
    #[arg(long, short)]
    pub quiet: bool,
    /// Inputs of the script.
    #[command(flatten)]
    pub inputs: InputOptions,
    /// Limits of the script.
    #[command(flatten)]
    pub limits: LimitOptions,
}

/// Options of `withy check`.
#[derive(Args)]
pub struct CheckOptions {
    /// Script, a .rhai file.
    pub file: PathBuf,
    /// Inputs of the script.
    #[command(flatten)]
    pub inputs: InputOptions,
    /// Limits of the script.
    #[command(flatten)]
    pub limits: LimitOptions,
}

/// Options of `withy docs`.
#[derive(Args)]
pub struct DocsOptions {
    /// Function, type, option, constant or topic, such as section, simulation.run_to or boundary condition; without it, an overview.
    #[arg(conflicts_with_all = ["markdown", "grammar", "definitions"])]
    pub name: Vec<String>,
    /// Prints the whole reference as Markdown.
    #[arg(long, conflicts_with_all = ["grammar", "definitions"])]
    pub markdown: bool,
    /// Prints a TextMate grammar (JSON) for syntax highlighting in editors.
    #[arg(long, conflicts_with = "definitions")]
    pub grammar: bool,
    /// Writes definition files (.d.rhai) for the Rhai language server to this folder.
    #[arg(long, value_name = "DIR")]
    pub definitions: Option<PathBuf>,
}

const EXIT_CODES: &str = "Exit codes: 0 success, 1 a check in the script failed, 2 error in the script or the arguments, 130 interrupted by Ctrl-C.";

const LSP_EXIT_CODES: &str = "Exit codes: 0 the editor ended the server, 1 the editor closed the connection without the request `shutdown`.";
