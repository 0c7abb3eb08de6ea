//! Every machine of `scripts/gallery/` runs, passes its checks, and draws its picture and its animation. `docs/gallery.md` has its results.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Largest size of an animation [bytes].
const LARGEST: usize = 300_000;
/// Number of scripts that run at the same time.
const WORKERS: usize = 2;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn scripts() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join("scripts/gallery")).unwrap();
    let mut scripts: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    scripts.retain(|path| path.extension().is_some_and(|ending| ending == "rhai"));
    scripts.sort();
    scripts
}

fn name(script: &Path) -> &str {
    script.file_stem().unwrap().to_str().unwrap()
}

/// Line of the table of the page or of the results of a machine: benchmark, value, ours and error.
#[derive(Clone, Debug)]
struct Row<T> {
    machine: String,
    benchmark: String,
    numbers: [T; 3],
}

/// Lines of the first table of the page, as text.
fn table_rows(page: &str) -> Vec<Row<String>> {
    let lines = page.lines().skip_while(|line| !line.starts_with("| ---")).skip(1);
    let lines = lines.take_while(|line| line.starts_with('|'));
    let row = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        assert_eq!(cells.len(), 5, "machine, benchmark, value, ours, error: {line}");
        let machine = cells[0].split_once("](#").unwrap().1.trim_end_matches(')');
        Row {
            machine: machine.replace('-', "_"),
            benchmark: cells[1].to_owned(),
            numbers: [cells[2], cells[3], cells[4]].map(str::to_owned),
        }
    };
    lines.map(row).collect()
}

/// Results of a machine, as numbers.
fn found(machine: &str, csv: &str) -> Vec<Row<f64>> {
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("benchmark,error,ours,value"), "{machine}");
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |at: usize| cells[at].parse().unwrap();
        assert_eq!(cells.len(), 4, "{machine}: {line}");
        Row {
            machine: machine.to_owned(),
            benchmark: cells[0].to_owned(),
            numbers: [number(3), number(2), number(1)],
        }
    };
    lines.map(row).collect()
}

/// Formats a number like a cell, with the same number of digits.
fn in_the_way_of(cell: &str, number: f64) -> String {
    let decimals = |text: &str| text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    match cell.split_once('e') {
        Some((mantissa, _)) => format!("{number:.*e}", decimals(mantissa)),
        None => format!("{number:.*}", decimals(cell)),
    }
}

/// Runs a machine in its own folder. Returns its results, or an error message.
fn run(script: &Path) -> Result<Vec<Row<f64>>, String> {
    let out = tempfile::tempdir().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_withy"))
        .args(["run", "--quiet", "--out"])
        .args([out.path(), script])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    if output.status.code() != Some(0) || said.contains("note: simulation") {
        return Err(said.into_owned());
    }
    let read = |ending: &str| {
        let file = format!("{}{ending}", name(script));
        std::fs::read(out.path().join(&file)).map_err(|_| format!("{file} is missing"))
    };
    let picture = String::from_utf8(read(".svg")?).unwrap();
    if !picture.contains("<polyline") {
        return Err("the picture has no line".to_owned());
    }
    let animation = read(".png")?;
    if !animation.windows(4).any(|chunk| chunk == b"acTL") || animation.len() > LARGEST {
        return Err(format!("no animation, or a large one: {} bytes", animation.len()));
    }
    Ok(found(name(script), &String::from_utf8(read("-row.csv")?).unwrap()))
}

#[test]
fn gallery_shows_the_results_of_its_scripts() {
    let page = std::fs::read_to_string(root().join("docs/gallery.md")).unwrap();
    let scripts = scripts();
    assert!(scripts.len() >= 4);
    let next = AtomicUsize::new(0);
    let work = || {
        let mut results = Vec::new();
        while let Some(script) = scripts.get(next.fetch_add(1, Ordering::Relaxed)) {
            results.push((name(script), run(script)));
        }
        results
    };
    let results = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..WORKERS).map(|_| scope.spawn(work)).collect();
        workers.into_iter().flat_map(|worker| worker.join().unwrap()).collect::<Vec<_>>()
    });
    let expected = table_rows(&page);
    let mut wrong = Vec::new();
    for (machine, result) in results {
        let found = match result {
            Ok(found) => found,
            Err(problem) => {
                wrong.push(format!("{machine}: {problem}"));
                continue;
            }
        };
        let lines: Vec<_> = expected.iter().filter(|row| row.machine == machine).collect();
        if lines.len() != found.len() {
            wrong.push(format!("{machine}: {} lines in the table of {}", lines.len(), found.len()));
        }
        for (line, row) in lines.iter().zip(&found) {
            let cells = [0, 1, 2].map(|at| in_the_way_of(&line.numbers[at], row.numbers[at]));
            if line.benchmark != row.benchmark || line.numbers != cells {
                wrong.push(format!(
                    "{machine}: docs/gallery.md says {line:?}, it wrote {row:?}, that is {cells:?}"
                ));
            }
        }
    }
    for row in &expected {
        if !scripts.iter().any(|script| name(script) == row.machine) {
            wrong.push(format!("docs/gallery.md: no scripts/gallery/{}.rhai", row.machine));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn gallery_shows_every_script() {
    let page = std::fs::read_to_string(root().join("docs/gallery.md")).unwrap();
    for script in scripts() {
        let name = name(&script);
        for ending in ["svg", "png"] {
            let picture = format!("pictures/gallery/{name}.{ending}");
            assert!(root().join("docs").join(&picture).is_file(), "no docs/{picture}");
            assert!(
                page.contains(&format!("]({picture})")),
                "docs/gallery.md does not show {picture}"
            );
        }
        let text = std::fs::read_to_string(&script).unwrap();
        assert!(text.starts_with("//! "), "{name} does not say what it is");
        assert!(page.contains(&format!("](../scripts/gallery/{name}.rhai)")), "no way to {name}");
    }
}

#[test]
fn cells_are_compared_to_the_digits_shown() {
    for (cell, number, same) in [
        ("1.94", 1.9425, "1.94"),
        ("5.2e-6", 5.2142e-6, "5.2e-6"),
        ("12", 11.6, "12"),
        ("-0.30", -0.2951, "-0.30"),
    ] {
        assert_eq!(in_the_way_of(cell, number), same, "{cell}");
    }
    let page = "| a | b |\n| --- | --- |\n| [Four-bar](#four-bar) | bend | 1.9 | 2 | 1e-2 |\n";
    let rows = table_rows(page);
    assert_eq!((rows[0].machine.as_str(), rows[0].benchmark.as_str()), ("four_bar", "bend"));
    assert_eq!(rows[0].numbers, ["1.9", "2", "1e-2"]);
}
