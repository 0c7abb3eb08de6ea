//! Definitions of the command line, and nothing else.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use super::convert_options::ConvertOptions;
use super::learn_options::LearnOptions;
use super::limits::LimitOptions;
use super::view_options::ViewOptions;
use crate::repl::editor::Keys;
use crate::script::state::parts::StudyPart;

/// Planar dynamics of flexible beams, scripted.
///
/// Without a command it opens a prompt.
#[derive(Parser)]
#[command(version, args_conflicts_with_subcommands = true, after_help = EXIT_CODES)]
pub struct CliArguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<CliCommand>,
    /// How a session goes, where there is no command.
    #[command(flatten)]
    pub session: SessionOptions,
}

/// What withy can do.
#[derive(Subcommand)]
pub enum CliCommand {
    /// Run a script: simulate, check, draw.
    #[command(after_help = EXIT_CODES)]
    Run(RunOptions),
    /// Run a script of studies; what is finished when it is stopped is not run again the next time.
    #[command(after_help = EXIT_CODES)]
    Study(StudyOptions),
    /// Parse a script and build its scenes without running, printing or writing anything.
    #[command(after_help = EXIT_CODES)]
    Check(CheckOptions),
    /// Write a saved simulation for other programs: frames for ParaView, arrays for NumPy, a table, a page.
    #[command(after_help = EXIT_CODES)]
    Convert(ConvertOptions),
    /// Write a page on which a saved simulation moves, or those in the variables of a script, and open it in a browser.
    #[command(after_help = EXIT_CODES)]
    View(ViewOptions),
    /// Show help on a name, the whole reference, or write definition files for editors.
    Docs(DocsOptions),
    /// Learn by doing: exercises with hints and a judge.
    Learn(LearnOptions),
    /// Open a prompt: step, look, go back. Reads inputs from a pipe where there is no terminal.
    #[command(after_help = EXIT_CODES)]
    Repl(ReplOptions),
}

/// Options of `withy repl`.
#[derive(Args)]
pub struct ReplOptions {
    /// A script that is evaluated first, as if it had been typed.
    pub file: Option<PathBuf>,
    /// How the session goes.
    #[command(flatten)]
    pub session: SessionOptions,
}

/// Options of a session, with a terminal or without.
#[derive(Args)]
pub struct SessionOptions {
    /// Evaluate this input and leave; several are evaluated one after another.
    #[arg(short = 'e', long = "evaluate", value_name = "INPUT", allow_hyphen_values = true)]
    pub inputs: Vec<String>,
    /// Folder for pictures and tables; made when the first one is written.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Memory of each simulation for going back, in megabytes.
    #[arg(long, value_name = "MB", default_value_t = 256)]
    pub snapshots: u32,
    /// Keys of the line editor; the variable WITHY_KEYS says it for all sessions.
    #[arg(long, value_enum)]
    pub keys: Option<KeyBindings>,
    /// Draw with plain ASCII.
    #[arg(long)]
    pub ascii: bool,
    /// What the session may use; time and steps are those of one input.
    #[command(flatten)]
    pub limits: LimitOptions,
}

/// Keys of the line editor.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum KeyBindings {
    /// As in Emacs and most shells.
    Emacs,
    /// As in vi.
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
    /// The script, a .rhai file.
    pub file: PathBuf,
    /// Folder for pictures and tables; made when the first one is written.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Write what each simulation says about itself to this JSON file, whole or not at all, also after a failure.
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
    /// No progress bar and no closing lines; what the script prints and what fails is still shown.
    #[arg(long, short)]
    pub quiet: bool,
    /// What the script may use.
    #[command(flatten)]
    pub limits: LimitOptions,
}

/// Options of `withy study`.
#[derive(Args)]
pub struct StudyOptions {
    /// The script, a .rhai file.
    pub file: PathBuf,
    /// Folder for tables, pictures, and journals of what is finished; made when the first one is written.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Forget what an interrupted run of these studies has finished.
    #[arg(long)]
    pub fresh: bool,
    /// Make only this part of each study, such as 3/16, and keep it in the folder of --out until --merge joins all parts.
    #[arg(long, value_name = "K/N", conflicts_with = "merge")]
    pub part: Option<StudyPart>,
    /// Join the parts in these folders in the place of making them: the same files as those of one machine.
    #[arg(long, value_name = "DIR", num_args = 1.., conflicts_with = "fresh")]
    pub merge: Vec<PathBuf>,
    /// How often each run is timed, whatever the script says.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub repeats: Option<u32>,
    /// No progress bar and no closing lines; what the script prints and what fails is still shown.
    #[arg(long, short)]
    pub quiet: bool,
    /// What the script may use.
    #[command(flatten)]
    pub limits: LimitOptions,
}

/// Options of `withy check`.
#[derive(Args)]
pub struct CheckOptions {
    /// The script, a .rhai file.
    pub file: PathBuf,
    /// What the script may use.
    #[command(flatten)]
    pub limits: LimitOptions,
}

/// Options of `withy docs`.
#[derive(Args)]
pub struct DocsOptions {
    /// A function, type, option, constant or part of the language, such as section or simulation.run_to; without it, an overview.
    #[arg(conflicts_with_all = ["markdown", "grammar", "definitions"])]
    pub name: Option<String>,
    /// Print the whole reference as Markdown.
    #[arg(long, conflicts_with_all = ["grammar", "definitions"])]
    pub markdown: bool,
    /// Print a TextMate grammar (JSON), by which editors colour scripts.
    #[arg(long, conflicts_with = "definitions")]
    pub grammar: bool,
    /// Write definition files (.d.rhai) for the Rhai language server into this folder.
    #[arg(long, value_name = "DIR")]
    pub definitions: Option<PathBuf>,
}

const EXIT_CODES: &str = "Exit codes: 0 all is well, 1 a check in the script failed, 2 the script or an argument is wrong, \
                          130 stopped by Ctrl-C.";
