//! `withy view`: a page on which a saved simulation moves, or the last one of a script.
//!
//! It is a run with one line more, which writes the page.

use std::fs;
use std::io::stdout;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::Exit;
use super::bar::{self, Wish};
use super::interrupt::{self, AtStake};
use super::run::{exit_for, last_resort, refuse, show_summary};
use super::say::tell;
use super::view_options::ViewOptions;
use crate::folders::Scratch;
use crate::output::write_whole;
use crate::panics;
use crate::script::diagnose::Diagnostic;
use crate::script::engine::runner::{self, Ending};
use crate::script::packages::language;
use crate::script::source::program::Program;
use crate::script::state::settings::{Mode, Settings};

/// What is run, and where it may write.
struct Run {
    program: Program,
    out: PathBuf,
    /// The name of the page in that folder.
    page: String,
    /// What the page is written into first where a person has named another place for it.
    _scratch: Option<Scratch>,
}

/// Writes a page and opens it.
pub fn view(options: &ViewOptions) -> Exit {
    match prepare(options) {
        Ok(run) => perform(run, options),
        Err(diagnostic) => refuse(&diagnostic),
    }
}

fn prepare(options: &ViewOptions) -> Result<Run, Diagnostic> {
    let file = &options.file;
    let stem = file.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let stem = stem.unwrap_or_else(|| "view".into());
    let page = format!("{stem}.html");
    let is_saved = file.extension().is_some_and(|ending| ending == "withy");
    if !is_saved {
        let program = Program::load(file)?;
        let text = format!(
            "{}\n;\nwrite_viewer(latest_simulation(), {});\n",
            &*program.text,
            literal(&page)
        );
        let program = Program { text: text.as_str().into(), ..program };
        return Ok(Run { program, out: options.out.clone(), page, _scratch: None });
    }
    let parent = file.parent().filter(|parent| !parent.as_os_str().is_empty());
    let beside = parent.unwrap_or(Path::new(".")).to_owned();
    let name = file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let (saved, page_text) = (literal(&name), literal(&page));
    let text = format!("write_viewer(load_simulation({saved}), {page_text});\n");
    let program = Program { folder: beside.clone(), ..Program::named("withy view", &text) };
    let scratch = options.output.as_ref().map(|_| Scratch::new()).transpose();
    let scratch = scratch.map_err(|error| {
        Diagnostic::general(format!("cannot make a folder for what is not ready yet: {error}"))
    })?;
    let out = scratch.as_ref().map_or(beside, |scratch| scratch.path().to_owned());
    Ok(Run { program, out, page, _scratch: scratch })
}

/// A text of the language.
fn literal(text: &str) -> String {
    let escape = |letter: char| match letter {
        '\\' | '"' => format!("\\{letter}"),
        '\n' => "\\n".to_owned(),
        '\r' => "\\r".to_owned(),
        other => other.to_string(),
    };
    format!("\"{}\"", text.chars().map(escape).collect::<String>())
}

fn perform(run: Run, options: &ViewOptions) -> Exit {
    let wish = if options.quiet { Wish::Hide } else { Wish::Show };
    let settings = Settings {
        out: run.out.clone(),
        interrupt: interrupt::flag(AtStake::Run),
        limits: options.limits.limits(),
        printed: Box::new(stdout()),
        told: Box::new(std::io::stderr()),
        progress: bar::progress(wish),
        last_resort: Some(last_resort()),
        ..Settings::silent(Mode::Run)
    };
    panics::silence();
    let mut outcome = runner::run(&run.program, &language(), settings);
    let mut page = run.out.join(&run.page);
    if let (Ending::Finished, Some(place)) = (&outcome.ending, &options.output) {
        if let Err(diagnostic) = put(&page, place) {
            return refuse(&diagnostic);
        }
        outcome.files.retain(|file| *file != page);
        outcome.files.push(place.clone());
        page = place.clone();
    }
    if wish == Wish::Show {
        show_summary(&outcome);
    }
    if matches!(outcome.ending, Ending::Finished) && !options.no_open && !open(&page) {
        tell(&format!("open '{}' in a browser to see it\n", page.display()));
    }
    exit_for(&outcome)
}

/// Puts the page where a person wants it.
fn put(page: &Path, place: &Path) -> Result<(), Diagnostic> {
    let failed = |error: String| {
        Diagnostic::general(format!("cannot write the page '{}': {error}", place.display()))
            .with_hint("-o takes the path of a file in a folder that you may write to")
    };
    let bytes = fs::read(page).map_err(|error| failed(error.to_string()))?;
    write_whole(place, &bytes).map_err(|error| failed(error.to_string()))?;
    fs::remove_file(page).map_err(|error| failed(error.to_string()))
}

/// Lets the system open a page. Whether it knows how to.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_quotes_are_texts_of_the_language() {
        assert_eq!(literal("run.html"), "\"run.html\"");
        assert_eq!(literal("a \"b\" \\ c"), r#""a \"b\" \\ c""#);
    }
}
