//! `withy docs`: prints help pages and the reference, and writes definition files for editors.

use std::io::{self, IsTerminal, Write, stdout};
use std::path::Path;

use super::Exit;
use super::args::DocsOptions;
use super::run::report_error;
use crate::output::{Colours, TerminalStyle, write_atomic};
use crate::sandbox_fs::read_text;
use crate::script::bindings::catalog::Catalog;
use crate::script::diagnose::Diagnostic;
use crate::script::help::definitions::definitions;
use crate::script::help::grammar::grammar;
use crate::script::help::lookup::{self, WIDTH};
use crate::script::help::reference::reference;
use crate::script::packages::language;

/// Maximum size of an existing definition file that may be replaced [bytes].
const LARGEST_DEFINITION: u64 = 1 << 24;

pub fn docs(options: &DocsOptions) -> Exit {
    let catalog = language();
    let text = match &options.definitions {
        Some(folder) => write_definitions(&catalog, folder),
        None if options.grammar => Ok(grammar(&catalog)),
        None if options.markdown => Ok(reference(&catalog)),
        None => page(&catalog, &options.name.join(" ")),
    };
    match text {
        Ok(text) => show(&text),
        Err(diagnostic) => report_error(&diagnostic),
    }
}

fn page(catalog: &Catalog, name: &str) -> Result<String, Diagnostic> {
    let page = lookup::page(catalog, name).map_err(|unknown| {
        Diagnostic::general(unknown.to_string()).with_hint(match unknown.is_strange() {
            true => "withy docs lists all topics".to_owned(),
            false => unknown.hint(),
        })
    })?;
    let style = TerminalStyle::of_environment(|name| std::env::var(name).ok());
    let wants_colours = stdout().is_terminal() && style.colours == Colours::Ansi;
    Ok(if wants_colours { page.ansi(width()) } else { page.plain(width()) })
}

fn width() -> usize {
    let columns = std::env::var("COLUMNS").ok().and_then(|text| text.parse().ok());
    columns.filter(|columns| *columns > 0).unwrap_or(WIDTH)
}

fn write_definitions(catalog: &Catalog, folder: &Path) -> Result<String, Diagnostic> {
    let refused = |path: &Path, why: &dyn std::fmt::Display| {
        Diagnostic::general(format!("cannot write '{}': {why}", path.display()))
            .with_hint("--definitions takes a folder, which is created if necessary")
    };
    std::fs::create_dir_all(folder).map_err(|error| refused(folder, &error))?;
    let mut listing = String::new();
    for file in definitions(catalog) {
        let path = folder.join(&file.name);
        if path.symlink_metadata().is_ok() && !is_definition(&path) {
            return Err(refused(&path, &"a file of this name exists and is not a definition file"));
        }
        write_atomic(&path, file.text.as_bytes()).map_err(|error| refused(&path, &error))?;
        listing += &format!("wrote {}\n", path.display());
    }
    Ok(listing)
}

fn is_definition(path: &Path) -> bool {
    read_text(path, LARGEST_DEFINITION)
        .is_ok_and(|text| text.lines().any(|line| line == "module static;"))
}

fn show(text: &str) -> Exit {
    let mut out = stdout();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            report_error(&Diagnostic::general(format!("cannot write to the output: {error}")))
        }
        _ => Exit::Success,
    }
}
