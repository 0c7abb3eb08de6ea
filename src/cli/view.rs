//! `withy view`: writes a viewer page of a saved simulation, or of the simulations in the variables of a script.

use std::fs;
use std::io::stdout;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::Exit;
use super::console::print_error;
use super::interrupt::{self, InterruptLoss};
use super::progress_display::{self, ProgressPreference};
use super::run::{exit_for, last_resort, report_error, show_summary};
use super::saved::{folder_of, literal, program, stem_of};
use super::view_options::ViewOptions;
use crate::output::write_atomic;
use crate::panics;
use crate::sandbox_fs::Scratch;
use crate::script::diagnose::Diagnostic;
use crate::script::engine::runner::{self, Ending};
use crate::script::packages::language;
use crate::script::source::outline::ScriptOutline;
use crate::script::source::program::Program;
use crate::script::source::text::Source;
use crate::script::state::settings::{RunMode, RunSettings};

struct ViewRun {
    program: Program,
    out: PathBuf,
    page: String,
    /// Temporary folder for the page of a saved simulation; `None` if the user chose a file for the page.
    _scratch: Option<Scratch>,
}

pub fn view(options: &ViewOptions) -> Exit {
    match prepare(options) {
        Ok(run) => perform(run, options),
        Err(diagnostic) => report_error(&diagnostic),
    }
}

fn prepare(options: &ViewOptions) -> Result<ViewRun, Diagnostic> {
    let file = &options.file;
    let page = format!("{}.html", stem_of(file));
    let is_saved = file.extension().is_some_and(|ending| ending == "withy");
    if !is_saved {
        let program = Program::load(file)?;
        let text = format!("{}\n;\n{}", &*program.text, showing_all(&program, &page));
        let program = Program { text: text.as_str().into(), ..program };
        return Ok(ViewRun { program, out: options.out.clone(), page, _scratch: None });
    }
    let line = format!("write_viewer(sim, {});", literal(&page));
    let program = program("withy view", file, &line);
    let scratch = options.output.as_ref().map(|_| Scratch::new()).transpose();
    let scratch = scratch.map_err(|error| {
        Diagnostic::general(format!("cannot create a folder for temporary files: {error}"))
    })?;
    let out = scratch.as_ref().map_or_else(|| folder_of(file), |scratch| scratch.path().to_owned());
    Ok(ViewRun { program, out, page, _scratch: scratch })
}

fn showing_all(program: &Program, page: &str) -> String {
    let mut names: Vec<String> = Vec::new();
    for (name, _) in ScriptOutline::of(&Source::from(&*program.text)).top_level {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    format!(
        "{{ let shown = simulations_among([{}]);\n\
         write_viewer(if shown.is_empty() {{ [latest_simulation()] }} else {{ shown }}, {}); }}\n",
        names.join(", "),
        literal(page)
    )
}

fn perform(run: ViewRun, options: &ViewOptions) -> Exit {
    let inputs = match options.inputs.inputs() {
        Ok(inputs) => inputs,
        Err(diagnostic) => return report_error(&diagnostic),
    };
    let wish = if options.quiet { ProgressPreference::Hide } else { ProgressPreference::Show };
    let settings = RunSettings {
        out: run.out.clone(),
        inputs,
        interrupt: interrupt::flag(InterruptLoss::Run),
        limits: options.limits.limits(),
        printed: Box::new(stdout()),
        diagnostics: Box::new(std::io::stderr()),
        progress: progress_display::progress(wish),
        last_resort: Some(last_resort()),
        ..RunSettings::silent(RunMode::Run)
    };
    panics::silence();
    let mut outcome = runner::run(&run.program, &language(), settings);
    let mut page = run.out.join(&run.page);
    if let (Ending::Finished, Some(place)) = (&outcome.ending, &options.output) {
        if let Err(diagnostic) = write_page(&page, place) {
            return report_error(&diagnostic);
        }
        outcome.files.retain(|file| *file != page);
        outcome.files.push(place.clone());
        page = place.clone();
    }
    if wish == ProgressPreference::Show {
        show_summary(&outcome);
    }
    if matches!(outcome.ending, Ending::Finished) && !options.no_open && !open(&page) {
        print_error(&format!("open '{}' in a browser to see it\n", page.display()));
    }
    exit_for(&outcome)
}

fn write_page(page: &Path, place: &Path) -> Result<(), Diagnostic> {
    let failed = |error: String| {
        Diagnostic::general(format!("cannot write the page '{}': {error}", place.display()))
            .with_hint("-o takes the path of a file in a folder that you may write to")
    };
    let bytes = fs::read(page).map_err(|error| failed(error.to_string()))?;
    write_atomic(place, &bytes).map_err(|error| failed(error.to_string()))?;
    fs::remove_file(page).map_err(|error| failed(error.to_string()))
}

fn open(page: &Path) -> bool {
    let program = match std::env::consts::OS {
        "macos" => "open",
        "windows" => "explorer",
        _ => "xdg-open",
    };
    let mut command = Command::new(program);
    command.arg(page).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().is_ok()
}
