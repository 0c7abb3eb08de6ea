//! Resource limits and file access of scripts: limits with their flags, files, and errors across files.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// Time limit of a run: much shorter than the endless inputs, and sufficient with ten times as many processes as cores.
const TIME_LIMIT: Duration = Duration::from_secs(120);

const SCENE: &str = "let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });
let scene = new_scene(\"a\");
let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [10, 0]), basis: bspline(4), section: s, spin: 1 });
";

/// Folder with scripts. `main.rhai` is the one to run.
struct Home(TempDir);

impl Home {
    fn with(files: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        Self(folder)
    }

    fn withy(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
        command.args(arguments).current_dir(self.0.path()).output().unwrap()
    }

    fn run(&self, options: &[&str]) -> Output {
        self.withy(&[&["run", "main.rhai", "--quiet"], options].concat())
    }
}

fn run(text: &str, options: &[&str]) -> Output {
    Home::with(&[("main.rhai", text)]).run(options)
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Asserts exit code 2 and a message with all of these words.
#[track_caller]
fn expect(output: &Output, words: &[&str]) {
    let said = said(output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    for word in words {
        assert!(said.contains(word), "{word} is missing in\n{said}");
    }
}

#[test]
fn time_limit_ends_a_loop_that_catches_all_errors() {
    let begun = Instant::now();
    let output = run("\nloop { try { loop { } } catch { print(1); } }", &["--max-time", "0.3"]);
    expect(&output, &["takes longer than 0.3 s", "main.rhai:2:", "--max-time SECONDS"]);
    assert!(output.stdout.is_empty());
    assert!(begun.elapsed() < TIME_LIMIT);
}

#[test]
fn unlimited_growth_of_memory_is_an_error() {
    let script = "let all = []; loop { let x = []; x.pad(500000, 1); all.push(x); }";
    expect(&run(script, &["--max-memory", "60"]), &["more than 60 MB", "--max-memory MB"]);
}

#[test]
fn steps_are_counted_over_all_simulations() {
    let script = format!(
        "{SCENE}let one = scene.start(#{{ dt: 0.1 }}); let two = scene.start(#{{ dt: 0.1 }});
         one.run_to(1); two.step(5); print(\"fine\"); two.run_to(10);"
    );
    let home = Home::with(&[("main.rhai", &script)]);
    let output = home.run(&["--max-steps", "15"]);
    expect(&output, &["need more than 15 steps", "main.rhai:5:", "--max-steps N"]);
    assert_eq!(output.stdout, b"fine\n");
    // Lines: a comment, the column names, the start and the steps. The first run is complete.
    for (file, lines) in [("out/a-history.csv", 13), ("out/a-stopped.csv", 8)] {
        let kept = fs::read_to_string(home.0.path().join(file)).unwrap();
        assert_eq!(kept.lines().count(), lines, "{file}");
    }
    let output = home.run(&["--max-steps", "1000"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
}

#[test]
fn rescue_files_respect_the_limit_of_written_output() {
    let script = format!("{SCENE}let sim = scene.start(#{{ dt: 1e-3 }}); sim.run_to(100);");
    let home = Home::with(&[("main.rhai", &script)]);
    let output = home.run(&["--max-steps", "4000", "--max-written", "1"]);
    expect(&output, &["need more than 4000 steps"]);
    let kept = fs::read_to_string(home.0.path().join("out/a-stopped.csv")).unwrap();
    assert!(kept.len() < 1_050_000 && kept.contains("# rows: one in "), "{}", kept.len());
    let last: f64 =
        kept.lines().last().and_then(|row| row.split(',').next()).unwrap().parse().unwrap();
    assert!((last - 4.0).abs() < 1e-9, "{last}");
    // Printed output counts towards the same limit.
    let script = format!(
        "{SCENE}let sim = scene.start(#{{ dt: 1e-3 }}); sim.run_to(1); loop {{ print(\"{}\"); }}",
        "x".repeat(999)
    );
    let home = Home::with(&[("main.rhai", &script)]);
    expect(&home.run(&["--max-written", "1"]), &["1 MB"]);
    let kept = fs::read_to_string(home.0.path().join("out/a-history.csv")).unwrap();
    assert!(kept.len() < 60_000, "{}", kept.len());
}

/// Clusters limit the address space of a process.
#[cfg(target_os = "linux")]
#[test]
fn a_script_and_its_workers_fit_a_limited_address_space() {
    let script = "let found = study_sweep(#{ name: \"doubled\", parameters: #{ a: [1, 2, 3, 4] }, run: |p| #{ b: 2 * p.a } });
                  print(found.table);";
    let home = Home::with(&[("main.rhai", script)]);
    for megabytes in [512, 1000, 2000, 4000] {
        let line = format!("ulimit -v {}; exec \"$0\" run main.rhai", megabytes * 1024);
        let mut shell = std::process::Command::new("sh");
        shell.args(["-c", &line, env!("CARGO_BIN_EXE_withy")]).current_dir(home.0.path());
        let output = shell.output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{megabytes} MB: {}", said(&output));
    }
}

#[test]
fn failed_checks_count_towards_the_limit_of_written_output() {
    let script = format!("loop {{ check(false, \"{}\"); }}", "x".repeat(100));
    expect(&run(&script, &["--max-written", "1"]), &["1 MB", "--max-written MB"]);
}

#[test]
fn recursion_of_every_kind_is_an_error_and_not_a_crash() {
    let through = [
        "fn f(n) { 1 + f(n + 1) } f(0);",
        "fn f(n) { [1].map(|x| f(n + x)) } f(0);",
        "fn f(n) { [1].filter(|x| f(n + x)) } f(0);",
        "fn f(n) { let a = [2, 1]; a.sort(|x, y| f(n) + x); } f(0);",
        "fn f(g) { g.call(g) } f(|g| f(g));",
        "let h = []; let s = schedule(|t| { let g = h[0]; g.at(t) }); h.push(s); s.at(1);",
        "fn g(sim) { sim.at(sim.t + 0.01, |s| g(s)); sim.step(); }
         let sim = scene.start(#{ dt: 0.1 }); sim.at(0.5, |s| g(s)); sim.run_to(1);",
        "let h = [scene]; scene.force(rod.end, [1, 0], |t| { let scene = h[0]; scene.start(#{ dt: 0.1 }).step(); 1 });
         scene.start(#{ dt: 0.1 }).step();",
    ];
    for script in through {
        let output = run(&format!("{SCENE}{script}"), &["--max-depth", "1000"]);
        expect(&output, &["too deeply", "--max-depth N"]);
    }
}

#[test]
fn recursion_limit_can_be_raised() {
    let script = "fn f(n) { if n == 0 { 0 } else { 1 + f(n - 1) } } print(f(700));";
    expect(&run(script, &[]), &["too deeply"]);
    assert_eq!(run(script, &["--max-depth", "900"]).stdout, b"700\n");
    expect(&run(script, &["--max-depth", "100000"]), &["--max-depth"]);
}

#[test]
fn long_chain_of_closures_is_dropped_without_a_crash() {
    let script = "let a = |x| x; for i in 0..1000000 { let b = a; a = |x| { b.call(x) }; } a = 1; print(\"gone\");";
    let output = run(script, &[]);
    assert_eq!(output.stdout, b"gone\n", "{}", said(&output));
}

#[test]
fn a_script_cannot_sleep() {
    for script in ["sleep(100);", "sleep(0.5);"] {
        expect(&run(script, &[]), &["a script cannot sleep"]);
    }
}

#[test]
fn sorting_returns_errors_of_its_function() {
    expect(&run("[2, 1].sort(|x, y|\n x - lost);", &[]), &["no variable 'lost'", "main.rhai:2:"]);
    expect(&run("[2, 1].sort(|x, y| \"x\");", &[]), &["must return a number or true or false"]);
    let script =
        "let a = [0.1, 0.3, 0.2]; a.sort(|x, y| y - x); print(a); print(a.order(|x, y| x < y));";
    assert_eq!(run(script, &[]).stdout, b"[0.3, 0.2, 0.1]\n[0.1, 0.2, 0.3]\n");
}

#[test]
fn load_function_cannot_use_its_running_simulation() {
    let script = format!(
        "{SCENE}let held = [];
         scene.force(rod.end, [0, 1], |t| {{ if held.len() > 0 {{ print(held[0]); held[0].step(); }} 1 }});
         let sim = scene.start(#{{ dt: 0.1 }}); held.push(sim); sim.run_to(1);"
    );
    let output = run(&script, &[]);
    expect(
        &output,
        &["step: simulation 'a' is in the middle of a step", "a load is a function of time"],
    );
}

/// Imported file of the tests below.
const LIBRARY: &str = "import \"below/deep\" as deep;
const K = 3;
fn bad(x) {
    x + global::K + lost
}
fn native(x) {
    linspace(0, 1, -5)
}
fn mapped(list) {
    list.map(|x| bad(x))
}
fn push(scene, station) {
    scene.force(station, [1, 0], |t| deep::twice(t) * global::K)
}
fn push_bad(scene, station) {
    scene.force(station, [1, 0], |t| bad(t))
}
fn watch_bad(sim) {
    sim.at(0.3, |s| bad(s.t));
}
";

fn library(main: &str) -> Home {
    let main = format!("{SCENE}import \"library\" as library;\n{main}");
    let deep = "const TWO = 2;\nfn twice(t) { let u = t; u ^= 1; global::TWO * u }";
    Home::with(&[("main.rhai", &main), ("library.rhai", LIBRARY), ("below/deep.rhai", deep)])
}

#[test]
fn loads_and_events_of_an_imported_file_see_its_imports_and_constants() {
    let main = "const A = 2.5; library::push(scene, rod.end);
scene.force(rod.end, [0, 1], |t| global::A * library::deep::twice(t));
let sim = scene.start(#{ dt: 0.1 }); sim.at(0.3, |s| print(library::deep::twice(s.t))); sim.run_to(1);";
    let output = library(main).run(&[]);
    assert_eq!(output.stdout, b"0.6\n", "{}", said(&output));
}

#[test]
fn errors_in_imported_files_show_file_and_trace() {
    let bad = ["no variable 'lost'", "library.rhai:4:21", "x + global::K + lost"];
    let cases: &[(&str, &[&str])] = &[
        (
            "fn f(x) { library::bad(x) }\nf(3);",
            &["in 'bad', called at line 5", "in 'f', called at line 6"],
        ),
        (
            "library::mapped([1]);",
            &["in 'bad', called at library.rhai:10", "in 'mapped', called at line 5"],
        ),
        (
            "[1].map(|x|\nlibrary::bad(x));",
            &["in 'bad', called at line 6", "in a closure, called at line 5"],
        ),
        (
            "library::push_bad(scene, rod.end);\nlet sim = scene.start(#{ dt: 0.1 });\nsim.run_to(1);",
            &["in 'bad', called at library.rhai:16", "in a closure, called at line 7"],
        ),
        (
            "let sim = scene.start(#{ dt: 0.1 });\nlibrary::watch_bad(sim);\nsim.run_to(1);",
            &["in 'bad', called at library.rhai:19", "in a closure, called at line 7"],
        ),
        (
            "fn g(x) { library::bad(x) }\nlet sim = scene.start(#{ dt: 0.1 });\nsim.at(0.5, |s| g(s.t)); sim.run_to(1);",
            &[
                "in 'bad', called at line 5",
                "in 'g', called at line 7",
                "in a closure, called at line 7",
            ],
        ),
    ];
    for (main, steps) in cases {
        expect(&library(main).run(&[]), &[&bad, *steps].concat());
    }
    // A dry run reports the same chain of calls across files.
    for (main, steps) in [&cases[0], &cases[1], &cases[4]] {
        expect(&library(main).withy(&["check", "main.rhai"]), &[&bad, *steps].concat());
    }
    let native = library("library::native(1);").run(&[]);
    expect(&native, &["'count' must be", "library.rhai:7:20", "in 'native', called at line 5"]);
}

#[test]
fn an_imported_file_that_does_not_parse_is_shown() {
    let files = [
        ("main.rhai", "\nimport \"broken\" as b;"),
        ("broken.rhai", "fn ok() { 1 }\nfn no( { 2 }\n"),
    ];
    let home = Home::with(&files);
    for command in ["run", "check"] {
        let output = home.withy(&[command, "main.rhai"]);
        expect(
            &output,
            &["broken.rhai:2:8", "fn no( { 2 }", "in the file broken.rhai, imported at line 2"],
        );
    }
}

#[test]
fn imports_stay_in_the_folder_of_the_script() {
    let home = Home::with(&[("inner/main.rhai", ""), ("outside.rhai", "fn f() { 1 }")]);
    let inner = home.0.path().join("inner");
    #[cfg(unix)]
    std::os::unix::fs::symlink(home.0.path().join("outside.rhai"), inner.join("way.rhai")).unwrap();
    let absolute = home.0.path().join("outside").display().to_string();
    for name in ["../outside", "x/../../outside", &absolute, "way", "missing"] {
        fs::write(inner.join("main.rhai"), format!("import \"{name}\" as o;")).unwrap();
        let output = home.withy(&["run", "inner/main.rhai"]);
        expect(&output, &["script's own folder", "main.rhai:1:8", "NAME.rhai"]);
    }
}

#[test]
fn circular_imports_are_an_error() {
    let files = [
        ("main.rhai", "import \"a\" as a;"),
        ("a.rhai", "import \"b\" as b;"),
        ("b.rhai", "import \"a\" as a;"),
    ];
    expect(&Home::with(&files).run(&[]), &["'a' imports itself", "b.rhai:1:8"]);
    let home = Home::with(&[("main.rhai", "import \"m0\" as m;")]);
    for i in 0..80 {
        let text = format!("import \"m{}\" as m;", i + 1);
        fs::write(home.0.path().join(format!("m{i}.rhai")), text).unwrap();
    }
    expect(&home.run(&[]), &["files import each other in a chain"]);
}

/// Asserts exit code 2 and these words within the time limit.
#[track_caller]
fn ends_in_time(home: &Home, arguments: &[&str], words: &[&str]) {
    let begun = Instant::now();
    expect(&home.withy(arguments), words);
    assert!(begun.elapsed() < TIME_LIMIT, "{arguments:?} took {:?}", begun.elapsed());
}

#[test]
fn time_limit_ends_code_that_checks_no_limits() {
    // Four statements per line, because a script may have 65 000 lines.
    let lets: String = (0..200_000)
        .map(|i| format!("let a{i} = {i};{}", if i % 4 == 3 { "\n" } else { " " }))
        .collect();
    let home = Home::with(&[
        ("many.rhai", lets.as_str()),
        (
            "dedup.rhai",
            "let a = []; a.pad(10000000, 1); for i in 0..100 { let b = a + []; b.dedup(); }",
        ),
    ]);
    for file in ["many.rhai", "dedup.rhai"] {
        ends_in_time(&home, &["run", file, "--max-time", "1"], &["takes longer than 1 s"]);
    }
    ends_in_time(&home, &["check", "many.rhai", "--max-time", "1"], &["takes longer than 1 s"]);
}

#[test]
fn long_native_calls_and_long_texts_check_limits() {
    let lets: String = (0..60_000).map(|i| format!("let a{i} = {i};\n")).collect();
    let numbers =
        "let a = []; a.pad(3000000, 1); for i in 0..3000000 { a[i] = (i * 7919) % 3000017; }";
    let home = Home::with(&[
        ("many.rhai", lets.as_str()),
        ("dedup.rhai", "let a = []; a.pad(9000000, 1); loop { a.dedup(); a.pad(9000000, 1); }"),
        ("sort.rhai", &format!("{numbers} loop {{ let b = a + []; b.sort(); }}")),
    ]);
    for file in ["many.rhai", "dedup.rhai", "sort.rhai"] {
        let output = home.withy(&["run", file, "--max-time", "1.5"]);
        expect(&output, &["takes longer than 1.5 s"]);
        assert!(!said(&output).contains("a long operation"), "{file}: {}", said(&output));
    }
}

#[test]
fn dedup_removes_repetitions_and_returns_errors_of_its_function() {
    let script = "let a = [1, 1, 2, 2.0, \"x\", \"x\", 1]; a.dedup(); print(a);
        let b = [1, 2, 4, 5, 9]; b.dedup(|x, y| y - x == 1); print(b); let c = []; c.dedup(); print(c);";
    let output = run(script, &[]);
    assert_eq!(output.stdout, b"[1, 2, \"x\", 1]\n[1, 4, 9]\n[]\n", "{}", said(&output));
    expect(&run("let a = [1, 2]; a.dedup(|x, y| lost);", &[]), &["no variable 'lost'"]);
}

#[test]
fn errors_quote_only_a_part_of_long_values() {
    let text = "let t = \"\"; t.pad(15000000, 'x'); let a = []; a.pad(3000000, 1);";
    for wrong in [
        "throw t;",
        "throw a;",
        "let o = #{}; o[t] = 1; section(o);",
        "Fn(t).call(1);",
        "help(t);",
        "check(false, t); throw 1;",
        "todo(t);",
        "knots(t);",
        "vec(a, 1);",
        "new_scene(\"a\").beam(#{ name: t });",
    ] {
        let output = run(&format!("{text}\n{wrong}"), &[]);
        expect(&output, &["error"]);
        assert!(output.stderr.len() < 20_000, "{wrong}: {} bytes", output.stderr.len());
    }
}

#[test]
fn messages_and_journals_count_towards_the_limit_of_written_output() {
    let script = "let s = \"\"; s.pad(100000, 'a'); loop { debug(s); }";
    let output = run(script, &["--max-written", "2"]);
    expect(&output, &["prints and writes more than 2 MB"]);
    assert!(output.stderr.len() < 2_100_000);
}

#[test]
fn stopped_script_with_thousands_of_simulations_ends_soon() {
    let script = format!(
        "{SCENE}let sim = scene.start(#{{ dt: 0.1 }}); sim.run_to(2); let all = []; loop {{ all.push(sim.fork()); }}"
    );
    let home = Home::with(&[("main.rhai", &script)]);
    ends_in_time(
        &home,
        &["run", "main.rhai", "--max-time", "1"],
        &["longer than 1 s", "simulations are kept"],
    );
}

#[test]
fn too_many_pictures_side_by_side_are_rejected() {
    let script = format!(
        "{SCENE}let sim = scene.start(#{{ dt: 0.1 }}); sim.step(); let all = []; all.pad(3000, sim); plot_motion(all, \"a.svg\");"
    );
    expect(&run(&script, &[]), &["3000 pictures side by side are too many"]);
}

#[test]
fn check_of_an_endless_run_ends() {
    let script = format!("{SCENE}let sim = scene.start(#{{ dt: 0.1 }}); sim.run_to(1e10);");
    let begun = Instant::now();
    let output = Home::with(&[("main.rhai", &script)]).withy(&["check", "main.rhai"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(begun.elapsed() < TIME_LIMIT, "{:?}", begun.elapsed());
}

#[test]
fn too_long_text_is_rejected_before_it_is_allocated() {
    let script =
        "let s = \"\"; s.pad(1000000, 'a'); let t = s; s.replace(\"a\", t); print(s.len());";
    expect(&run(script, &["--max-memory", "500"]), &["main.rhai:1:"]);
    let script = "let s = \"abcabc\"; s.replace(\"bc\", 'x'); print(s); s.replace('x', \"yy\"); print(s);
        s.replace('y', 'z'); s.replace(\"zz\", \"\"); print(s); let e = \"ab\"; e.replace(\"\", \"-\"); print(e);";
    assert_eq!(run(script, &[]).stdout, b"axax\nayyayy\naa\n-a-b-\n");
}

#[test]
fn widths_of_any_size_are_printed() {
    let script = "let s = \"\"; s.pad(70000, 'a'); print(tabulate([\"a\", \"b\"], [[s, \"x\"], [\"y\", \"z\"]]));";
    let output = run(script, &[]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
}

#[test]
fn printed_and_written_output_is_limited() {
    let script = "let s = \"\"; s.pad(100000, 'a'); loop { print(s); }";
    let output = run(script, &["--max-written", "2"]);
    expect(&output, &["prints and writes more than 2 MB", "--max-written MB"]);
    assert!(output.stdout.len() <= 2_000_000 && output.stdout.len() > 1_500_000);
    let script = format!(
        "{SCENE}let sim = scene.start(#{{ dt: 0.1 }}); sim.step();
         for i in 0..10 {{ write_history(sim, `${{i}}.csv`); }}"
    );
    let home = Home::with(&[("main.rhai", &script)]);
    expect(&home.run(&["--max-files", "3"]), &["writes more than 3 files", "--max-files N"]);
    let visible = |entry: &fs::DirEntry| entry.file_name().to_string_lossy().ends_with(".csv");
    let files = fs::read_dir(home.0.path().join("out")).unwrap().map(Result::unwrap);
    // The history of the stopped run is written in addition to the limit.
    assert_eq!(files.filter(visible).count(), 4);
}

#[cfg(target_os = "linux")]
#[test]
fn output_that_cannot_be_written_is_an_error() {
    let home = Home::with(&[
        ("main.rhai", "for i in 0..3 { print(i); }"),
        ("class/ada/kink.rhai", "let a = 1;"),
    ]);
    let full = || fs::File::options().write(true).open("/dev/full").unwrap();
    for arguments in [
        &["run", "main.rhai"][..],
        &["repl", "main.rhai", "-e", "1"],
        &["learn", "grade", "class"],
        &["learn", "list"],
        &["docs"],
        &["--help"],
        &["--version"],
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
        let command = command.args(arguments).current_dir(home.0.path()).stdout(full());
        let output = command.output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", said(&output));
        assert!(
            arguments[0].starts_with("--") || said(&output).contains("writ"),
            "{}",
            said(&output)
        );
    }
    for arguments in [&["check", "main.rhai"][..], &["check", "none.rhai"]] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
        let command = command.args(arguments).current_dir(home.0.path()).stderr(full());
        assert_eq!(command.status().unwrap().code(), Some(2), "{arguments:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn pipes_devices_and_huge_files_are_rejected_at_once() {
    let home = Home::with(&[
        ("pipe_main.rhai", "import \"pipe\" as p;"),
        ("huge_main.rhai", "import \"huge\" as p;"),
        ("load.rhai", "load_simulation(\"pipe.rhai\");"),
        ("load_huge.rhai", "load_simulation(\"huge.rhai\");"),
    ]);
    let pipe = home.0.path().join("pipe.rhai");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    fs::File::create(home.0.path().join("huge.rhai")).unwrap().set_len(2 << 30).unwrap();
    for (file, words) in [
        ("pipe_main.rhai", "not a regular file"),
        ("huge_main.rhai", "the largest allowed size"),
        ("load.rhai", "not a regular file"),
        ("load_huge.rhai", "the largest allowed size"),
        ("pipe.rhai", "not a regular file"),
        ("huge.rhai", "the largest allowed size"),
        ("/dev/zero", "not a regular file"),
    ] {
        for command in ["run", "check"] {
            ends_in_time(&home, &[command, file], &[words]);
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn endless_input_is_rejected() {
    let home = Home::with(&[]);
    let begun = Instant::now();
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    let zero = fs::File::open("/dev/zero").unwrap();
    let output = command.arg("repl").current_dir(home.0.path()).stdin(zero).output().unwrap();
    expect(&output, &["cannot read the input: a line is too long"]);
    assert!(begun.elapsed() < TIME_LIMIT);
}

#[test]
fn report_replaces_only_reports() {
    let home = Home::with(&[("main.rhai", "print(1);"), ("notes.txt", "mine")]);
    for file in ["main.rhai", "notes.txt"] {
        let before = fs::read(home.0.path().join(file)).unwrap();
        expect(&home.run(&["--report", file]), &["is not a report"]);
        assert_eq!(fs::read(home.0.path().join(file)).unwrap(), before);
    }
    for _ in 0..2 {
        assert_eq!(home.run(&["--report", "report.json"]).status.code(), Some(0));
    }
}

#[test]
fn foreign_files_are_kept_and_reported() {
    let script = format!(
        "{SCENE}let sim = scene.start(#{{ dt: 0.1 }}); sim.step(); write_history(sim, \"a.csv\");"
    );
    let home = Home::with(&[("main.rhai", &script), ("out/a.csv", "mine")]);
    let output = home.run(&[]);
    assert!(said(&output).contains("it is kept as 'out/a.csv.kept'"), "{}", said(&output));
    assert_eq!(fs::read_to_string(home.0.path().join("out/a.csv.kept")).unwrap(), "mine");
    assert_eq!(said(&home.run(&[])), "", "its own file is replaced");
}

#[cfg(unix)]
#[test]
fn one_signal_ends_code_that_checks_no_limits() {
    let busy = "print(\"begun\"); let a = []; a.pad(10000000, 1); for i in 0..1000 { let b = a + []; b.dedup(); }";
    let home = Home::with(&[("main.rhai", busy)]);
    for signal in ["-INT", "-TERM"] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
        let command = command.args(["run", "main.rhai"]).current_dir(home.0.path());
        let mut running = command.stdout(std::process::Stdio::piped()).spawn().unwrap();
        let mut word = [0; 5];
        std::io::Read::read_exact(running.stdout.as_mut().unwrap(), &mut word).unwrap();
        std::thread::sleep(Duration::from_millis(300));
        let begun = Instant::now();
        Command::new("kill").args([signal, &running.id().to_string()]).status().unwrap();
        assert_eq!(running.wait().unwrap().code(), Some(130));
        assert!(begun.elapsed() < TIME_LIMIT, "{:?}", begun.elapsed());
    }
}
