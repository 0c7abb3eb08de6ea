//! Check of docs/theory.md against the code: names, files and numeric tolerances.

#![allow(clippy::unwrap_used)]

use std::path::PathBuf;

use crate::layering::{crates, in_crate, sources};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn theory() -> String {
    std::fs::read_to_string(root().join("docs/theory.md")).unwrap()
}

/// Returns true if a crate has a file of this name.
fn is_source(name: &str) -> bool {
    crates().iter().any(|root| root.join(name).is_file())
}

/// Inline code of the text, outside of fenced blocks.
fn in_code_style(text: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut is_fenced = false;
    for line in text.lines() {
        is_fenced ^= line.trim_start().starts_with("```");
        if !is_fenced {
            words.extend(line.split('`').skip(1).step_by(2).map(str::to_owned));
        }
    }
    words
}

fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_alphabetic())
        && word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Returns true if a line of code contains a whole word.
fn has_word(line: &str, word: &str) -> bool {
    line.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|other| other == word)
}

/// Returns true if a line declares a name: as a function, type, constant, module, field or variant.
fn declares(line: &str, name: &str) -> bool {
    let line = line.trim_start();
    let line =
        line.split_once(") ").filter(|_| line.starts_with("pub(")).map_or(line, |(_, rest)| rest);
    let line = line.strip_prefix("pub ").unwrap_or(line);
    let line = line.strip_prefix("const fn").map_or(line.to_owned(), |rest| format!("fn{rest}"));
    let keyword = ["fn ", "struct ", "enum ", "trait ", "type ", "const ", "static ", "mod "];
    let (rest, is_item) = match keyword.iter().find_map(|word| line.strip_prefix(word)) {
        Some(rest) => (rest, true),
        None => (line.as_str(), false),
    };
    let Some(after) = rest.strip_prefix(name) else { return false };
    match after.chars().next() {
        Some(c) if c.is_alphanumeric() || c == '_' => false,
        _ if is_item => true,
        next => matches!(next, None | Some(',' | ':' | '(' | ' ')) && !after.starts_with("::"),
    }
}

/// Returns true if a type has a member, declared in its body or in one of its implementations.
fn has_member(all: &[(PathBuf, String)], of: &str, member: &str) -> bool {
    all.iter().any(|(_, text)| {
        let mut is_inside = false;
        text.lines().any(|line| {
            let is_head = ["struct ", "enum ", "trait ", "impl"].iter().any(|word| {
                line.trim_start_matches("pub(super) ").trim_start_matches("pub ").starts_with(word)
            });
            if !line.starts_with([' ', '}']) && !line.is_empty() {
                is_inside = is_head && has_word(line, of) || is_inside && line.starts_with(')');
            }
            let is_found = is_inside && line.starts_with(' ') && declares(line, member);
            is_inside &= !line.starts_with('}');
            is_found
        })
    })
}

/// Returns true if a module, in `src` or below one of its folders, declares a name.
fn has_item(all: &[(PathBuf, String)], module: &str, name: &str) -> bool {
    let folder = PathBuf::from(module.replace("::", "/"));
    all.iter().any(|(path, text)| {
        let own = in_crate(path);
        (own.starts_with(&folder) || own == folder.with_extension("rs"))
            && (text.lines().any(|line| declares(line, name))
                || path.file_stem().is_some_and(|stem| stem == name))
    })
}

#[test]
fn names_in_the_theory_document_exist_in_the_code() {
    let all = sources();
    let mut missing = Vec::new();
    let mut count = 0;
    for word in in_code_style(&theory()) {
        let Some((of, name)) = word.rsplit_once("::") else { continue };
        if !is_name(name) || !of.split("::").all(is_name) {
            continue;
        }
        count += 1;
        let first = of.rsplit("::").next().unwrap();
        let is_there = match first.starts_with(|c: char| c.is_ascii_uppercase()) {
            true => has_member(&all, first, name),
            false => has_item(&all, of, name),
        };
        if !is_there {
            missing.push(word);
        }
    }
    for gone in ["mass", "axial"] {
        assert!(
            !has_member(&all, "Section", gone),
            "has_member finds a member that does not exist"
        );
    }
    assert!(count > 60, "only {count} names were found");
    assert!(missing.is_empty(), "docs/theory.md has names that are not in src: {missing:?}");
}

#[test]
fn files_named_in_the_theory_document_exist() {
    let mut missing = Vec::new();
    let mut folder = String::new();
    for word in theory().split(|c: char| c.is_whitespace() || "`();".contains(c)) {
        let word = word.trim_end_matches(['.', ',', ':']);
        let is_file = [".rs", ".rhai", ".md"].iter().any(|ending| word.ends_with(ending));
        if !is_file || word.contains("](") {
            continue;
        }
        let names: Vec<String> = match word.split_once('{').zip(word.split_once('}')) {
            Some(((before, _), (_, after))) => {
                let inside = word.split(['{', '}']).nth(1).unwrap();
                inside.split(',').map(|name| format!("{before}{name}{after}")).collect()
            }
            // A name without a folder is a file in the folder of the previous one.
            None if !word.contains('/') => vec![format!("{folder}/{word}")],
            None => vec![word.to_owned()],
        };
        for name in names {
            folder = name.rsplit_once('/').unwrap().0.to_owned();
            if !root().join(&name).is_file() && !is_source(&name) {
                missing.push(name);
            }
        }
    }
    assert!(missing.is_empty(), "docs/theory.md has files that do not exist: {missing:?}");
}

/// Phrase of the theory with a number, source file, and the line of code with that number.
const NUMBERS: &[(&str, &str, &str)] = &[
    (
        "to 1e-12 of the beam's length plus the distance from the origin",
        "system/scene/ties.rs",
        "const CLOSED: f64 = 1e-12;",
    ),
    (
        "to 1e-6 of its length plus the distance from the origin",
        "system/scene/sliders.rs",
        "const CLOSED: f64 = 1e-6;",
    ),
    (
        "less than a thousandth of the length",
        "integrators/balance.rs",
        "const SHORTEST_CHORD: f64 = 1e-3;",
    ),
    (
        "to `4e-15` of the interval",
        "system/sliders/master_curve.rs",
        "const END_TOLERANCE: f64 = 4e-15;",
    ),
    ("within `1e-10` of an end", "simulation/run/event_location.rs", "const NEAR: f64 = 1e-10;"),
    ("no multiplier is above 8", "linalg/elimination.rs", "const LARGEST_SQUARE: f64 = 64.0;"),
    ("Four columns are eliminated at once", "linalg/elimination.rs", "const LANES: usize = 4;"),
    ("Four columns are eliminated at once", "linalg/elimination.rs", "const PANEL: usize = LANES;"),
    (
        "A band of 6 000 rows or more without a border",
        "linalg/two_ended.rs",
        "const FEWEST_ROWS: usize = 6000;",
    ),
    ("repeat at most 15 times", "newton/solver.rs", "iterations: 15 }"),
    (
        "violation of constraints ≤ 1e-11",
        "newton/solver.rs",
        "force: 1e-11, strain: 1e-11, constraint: 1e-11",
    ),
    (
        "while the imbalance is above 5e-16 and shrinks to a tenth",
        "newton/solver.rs",
        "polish: 5e-16",
    ),
    (
        "while the imbalance is above 5e-16 and shrinks to a tenth",
        "newton/solver.rs",
        "const STANDSTILL: f64 = 0.1;",
    ),
    ("if it is below 1e-4, and shrinks", "newton/solver.rs", "const NEAR: f64 = 1e-4;"),
    (
        "than 1e-9 Δt, or than `4 ε t`, are one",
        "simulation/time_grid.rs",
        "const SAME: f64 = 1e-9;",
    ),
    (
        "than 1e-9 Δt, or than `4 ε t`, are one",
        "simulation/time_grid.rs",
        "const ROUNDINGS: f64 = 4.0;",
    ),
    ("down to `Δt/2¹²`", "simulation/step_retry.rs", "const MOST_HALVINGS: u32 = 12;"),
    ("`ρ(r) = 0.9 r^(-1/(p+1))`", "simulation/controller.rs", "const SAFETY: f64 = 0.9;"),
    ("ρ(r)^0.7/ρ(r₋)^0.4", "simulation/controller.rs", "const NOW: f64 = 0.7;"),
    ("ρ(r)^0.7/ρ(r₋)^0.4", "simulation/controller.rs", "const BEFORE: f64 = 0.4;"),
    ("between 1/5 and 5 times h", "simulation/controller.rs", "const MOST_GROWTH: f64 = 5.0;"),
    ("accepted at once; r ≥ 1e-4", "simulation/controller.rs", "const LEAST_ERROR: f64 = 1e-4;"),
    (
        "if not given a million times the first",
        "simulation/adaptive.rs",
        "const LARGEST: f64 = 1e6;",
    ),
    (
        "if not given a millionth of the first",
        "simulation/adaptive.rs",
        "const SMALLEST: f64 = 1e-6;",
    ),
    (
        "more than a tenth of a turn in a step",
        "simulation/warning.rs",
        "LARGEST_ROTATION: f64 = 0.1 * TAU;",
    ),
    (
        "the mean has to be nearer by a fifth",
        "system/state/forecast.rs",
        "const SELECTION_RATIO: f64 = 0.8;",
    ),
    ("is halved, eight times at most", "statics/continuation.rs", "const MOST_HALVINGS: u32 = 8;"),
    (
        "more than four times as far as the last step went",
        "statics/continuation.rs",
        "const SNAP_THROUGH_RATIO: f64 = 4.0;",
    ),
    ("where it ends more than `2 Δs` away", "statics/continuation.rs", "const FAR: f64 = 2.0;"),
    (
        "a step takes about four iterations",
        "statics/continuation.rs",
        "const WANTED_ITERATIONS: f64 = 4.0;",
    ),
    ("Up to 240 unknowns, and up to 2000", "vibration/search.rs", "const SMALL: usize = 240;"),
    ("Up to 240 unknowns, and up to 2000", "vibration/search.rs", "const MEDIUM: usize = 2000;"),
    (
        "with a residual above 1e-6 are refused",
        "vibration/search.rs",
        "const LARGEST_RESIDUAL: f64 = 1e-6;",
    ),
    ("(by 1e-6 of `ω² + σ`)", "vibration/search.rs", "const EQUAL: f64 = 1e-6;"),
    ("64 times `Σ k (ε Σ |B| |φ|)²`", "vibration/search.rs", "const ROUNDING: f64 = 64.0;"),
    ("and `1e-14 σ`", "vibration/search.rs", "const HIDDEN: f64 = 1e-14;"),
    ("have grown by 1e12", "vibration/pencil.rs", "const MOST_GROWTH: f64 = 1e12;"),
];

#[test]
fn tolerances_in_the_theory_document_equal_those_of_the_code() {
    let theory = theory().split_whitespace().collect::<Vec<_>>().join(" ");
    let mut wrong = Vec::new();
    for (said, file, code) in NUMBERS {
        let words = said.split_whitespace().collect::<Vec<_>>().join(" ");
        if !theory.contains(&words) {
            wrong.push(format!("docs/theory.md does not contain \"{said}\""));
        }
        if !std::fs::read_to_string(crates()[0].join(file)).unwrap().contains(code) {
            wrong
                .push(format!("{file} does not contain `{code}`, the source of this phrase of theory.md: \"{said}\""));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
