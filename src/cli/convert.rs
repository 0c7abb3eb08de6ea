//! `withy convert`: exports a saved simulation without its script.

use std::io::{stderr, stdout};

use super::Exit;
use super::convert_options::{ConvertOptions, ConvertTarget};
use super::interrupt::{self, InterruptLoss};
use super::progress_display::{self, ProgressPreference};
use super::run::{exit_for, last_resort, show_summary};
use super::saved::{folder_of, literal, program, stem_of};
use crate::panics;
use crate::script::engine::runner;
use crate::script::packages::language;
use crate::script::state::settings::{RunMode, RunSettings};

pub fn convert(options: &ConvertOptions) -> Exit {
    let wish = if options.quiet { ProgressPreference::Hide } else { ProgressPreference::Show };
    let settings = RunSettings {
        out: options.out.clone().unwrap_or_else(|| folder_of(&options.file)),
        interrupt: interrupt::flag(InterruptLoss::Run),
        limits: options.limits.limits(),
        printed: Box::new(stdout()),
        diagnostics: Box::new(stderr()),
        progress: progress_display::progress(wish),
        last_resort: Some(last_resort()),
        ..RunSettings::silent(RunMode::Run)
    };
    let line = line(options.to, &stem_of(&options.file));
    panics::silence();
    let outcome =
        runner::run(&program("withy convert", &options.file, &line), &language(), settings);
    if wish == ProgressPreference::Show {
        show_summary(&outcome);
    }
    exit_for(&outcome)
}

fn line(to: ConvertTarget, stem: &str) -> String {
    let file = |ending: &str| literal(&format!("{stem}.{ending}"));
    match to {
        ConvertTarget::Vtk => format!("write_vtk(sim, {});", file("pvd")),
        ConvertTarget::Npz => format!("write_npz(sim, {});", file("npz")),
        ConvertTarget::Csv => format!("write_csv(sim, {}, #{{ units: true }});", file("csv")),
        ConvertTarget::Html => format!("write_viewer(sim, {});", file("html")),
    }
}
