//! `withy learn`, run with the binary: messages, files, exit codes, watching and grading.

#![allow(clippy::unwrap_used)]

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;
use std::{fs, thread};

use tempfile::TempDir;
use withy::exercises::catalogue::EXERCISES;

fn learn(folder: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    command.arg("learn").args(words).current_dir(folder).output().unwrap()
}

/// Exit code and all output.
fn said(folder: &Path, words: &[&str]) -> (i32, String) {
    let output = learn(folder, words);
    let text = [output.stdout, output.stderr].map(|said| String::from_utf8(said).unwrap()).concat();
    (output.status.code().unwrap(), text)
}

fn classroom() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn solve(folder: &Path, count: usize) {
    for exercise in &EXERCISES[..count] {
        let file = folder.join(exercise.file());
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, exercise.solution).unwrap();
    }
}

#[test]
fn first_call_creates_the_folder_and_shows_the_next_exercise() {
    let class = classroom();
    let (code, text) = said(class.path(), &[]);
    assert_eq!(code, 0);
    let first = EXERCISES[0].name;
    assert!(
        text.contains(&format!("{} exercises were written to withy-exercises", EXERCISES.len())),
        "{text}"
    );
    assert!(text.contains(&format!("0 of {} exercises are passed", EXERCISES.len())), "{text}");
    assert!(text.contains(&format!("withy learn check {first}")), "{text}");
    let files =
        EXERCISES.iter().map(|exercise| class.path().join("withy-exercises").join(exercise.file()));
    for (file, exercise) in files.zip(EXERCISES) {
        assert_eq!(fs::read_to_string(file).unwrap(), exercise.start);
    }
    let (_, again) = said(&class.path().join("withy-exercises"), &["next"]);
    assert!(
        again.contains(&format!("edit           {}/{first}.rhai", EXERCISES[0].track)),
        "{again}"
    );
}

#[test]
fn listing_writes_nothing_and_shows_every_title() {
    let class = classroom();
    let (code, text) = said(class.path(), &["list"]);
    assert_eq!(code, 0);
    assert!(EXERCISES.iter().all(|exercise| text.contains(exercise.title())), "{text}");
    assert_eq!(fs::read_dir(class.path()).unwrap().count(), 0);
}

#[test]
fn check_sets_the_exit_code_and_stores_progress() {
    let class = classroom();
    let name = EXERCISES[0].name;
    let (code, text) = said(class.path(), &["check", name]);
    assert_eq!(code, 1, "{text}");
    assert!(
        text.contains("the tip of the strip does not sink by") && text.contains("not yet:"),
        "{text}"
    );
    let folder = class.path().join("withy-exercises");
    solve(&folder, 1);
    let (code, text) = said(class.path(), &["check", name]);
    assert_eq!(code, 0, "{text}");
    assert!(text.contains(&format!("Next: {}", EXERCISES[1].id())), "{text}");
    assert!(said(&folder, &["list"]).1.contains(&format!("passed  {name}")));
    assert!(said(&folder, &[]).1.contains("1 of "));
}

#[test]
fn mistakes_are_shown_at_their_line_and_column() {
    let class = classroom();
    said(class.path(), &[]);
    let file = class.path().join("withy-exercises/splines/kink.rhai");
    fs::write(&file, "let k = knots(2)\nlet roof = 1;").unwrap();
    let (code, text) = said(class.path(), &["check", "kink"]);
    assert_eq!(code, 1);
    assert!(text.contains("kink.rhai:1:17"), "{text}");
    assert!(!text.contains('\u{1b}'), "no colours in a pipe");
}

#[test]
fn check_of_all_prints_a_summary_and_details_on_request() {
    let class = classroom();
    said(class.path(), &[]);
    let folder = class.path().join("withy-exercises");
    solve(&folder, 2);
    fs::write(folder.join(EXERCISES[4].file()), "let a = 1;").unwrap();
    let (_, text) = said(&folder, &["check"]);
    assert!(text.lines().count() < 10 && !text.contains("not yet "), "{text}");
    assert!(text.contains(&format!("Next: {}", EXERCISES[2].id())), "{text}");
    let begun = format!("Begun, but not passed: {}\n", EXERCISES[4].id());
    assert!(text.contains(&begun), "{text}");
    let (code, text) = said(&folder, &["check", "--all"]);
    assert_eq!(code, 1);
    assert!(text.contains(&format!("passed   {}\n", EXERCISES[1].id())), "{text}");
    assert_eq!(text.matches("not yet  ").count(), EXERCISES.len() - 2, "{text}");
    assert_eq!(said(&folder, &["check", "kink", "--all"]).0, 2);
}

#[test]
fn solution_is_shown_only_after_passing() {
    let class = classroom();
    let name = EXERCISES[0].name;
    let (code, text) = said(class.path(), &["solution", name]);
    assert_eq!(code, 1);
    assert!(text.contains("is not passed yet") && text.contains("withy learn hint"), "{text}");
    assert!(!text.contains(EXERCISES[0].solution.trim_end()), "{text}");
    let folder = class.path().join("withy-exercises");
    solve(&folder, 1);
    said(&folder, &["check", name]);
    let (code, text) = said(&folder, &["solution", name]);
    assert_eq!((code, text.as_str()), (0, EXERCISES[0].solution));
    assert_eq!(said(&folder, &["solution", "knik"]).0, 2);
}

#[test]
fn all_are_checked_without_a_name() {
    let class = classroom();
    said(class.path(), &[]);
    let folder = class.path().join("withy-exercises");
    solve(&folder, 2);
    let (code, text) = said(&folder, &["check"]);
    assert_eq!(code, 1);
    assert!(text.ends_with(&format!("2 of {} exercises are passed.\n", EXERCISES.len())), "{text}");
    solve(&folder, EXERCISES.len());
    let (code, text) = said(&folder, &["check"]);
    assert_eq!(code, 0, "{text}");
    assert!(said(&folder, &["next"]).1.contains("Congratulations"));
}

#[test]
fn hints_come_one_by_one_and_then_the_solution() {
    let class = classroom();
    let exercise = &EXERCISES[1];
    let hints = exercise.judge().hints;
    for (index, hint) in hints.iter().enumerate() {
        let (code, text) = said(class.path(), &["hint", exercise.name]);
        assert_eq!(code, 0);
        assert!(text.contains(&format!("hint {} of {}: {hint}", index + 1, hints.len())), "{text}");
    }
    let (_, text) = said(class.path(), &["hint", exercise.name]);
    assert!(
        text.contains("One solution:") && text.contains(exercise.solution.trim_end()),
        "{text}"
    );
    assert!(said(class.path(), &["hint"]).1.contains(&format!("{}, hint 1", EXERCISES[0].id())));
}

#[test]
fn reset_keeps_the_attempt_and_prints_its_location() {
    let class = classroom();
    said(class.path(), &[]);
    let file = class.path().join("withy-exercises").join(EXERCISES[0].file());
    fs::write(&file, "mine").unwrap();
    let (code, text) = said(class.path(), &["reset", EXERCISES[0].name]);
    assert_eq!(code, 0);
    let kept = file.with_extension("old");
    assert!(
        text.contains(&format!(
            "saved as withy-exercises/{}/{}.old",
            EXERCISES[0].track, EXERCISES[0].name
        )),
        "{text}"
    );
    assert_eq!(fs::read_to_string(kept).unwrap(), "mine");
    assert_eq!(fs::read_to_string(file).unwrap(), EXERCISES[0].start);
}

#[test]
fn unknown_names_and_damaged_progress_are_reported() {
    let class = classroom();
    let (code, text) = said(class.path(), &["check", "knik"]);
    assert_eq!(code, 2);
    assert!(text.contains("there is no exercise 'knik'; did you mean 'kink'?"), "{text}");
    fs::write(class.path().join("withy-exercises/withy-progress.json"), "[]").unwrap();
    let (code, text) = said(class.path(), &["next"]);
    assert_eq!(code, 2);
    assert!(text.contains("is damaged"), "{text}");
    // Damaged progress does not prevent the check of an attempt.
    let (code, text) = said(class.path(), &["check", "change_one_number"]);
    assert_eq!(code, 1);
    assert!(text.contains("is damaged") && text.contains("not yet: beams/change_one"), "{text}");
}

fn lines(output: impl std::io::Read + Send + 'static) -> Receiver<String> {
    let (send, receive) = channel();
    thread::spawn(move || {
        for line in BufReader::new(output).lines().map_while(Result::ok) {
            if send.send(line).is_err() {
                return;
            }
        }
    });
    receive
}

fn wait_for(lines: &Receiver<String>, phrase: &str) {
    let mut heard = Vec::new();
    loop {
        match lines.recv_timeout(Duration::from_secs(60)) {
            Ok(line) if line.contains(phrase) => return,
            Ok(line) => heard.push(line),
            Err(_) => panic!("'{phrase}' was not said, but: {heard:#?}"),
        }
    }
}

#[cfg(unix)]
#[test]
fn watch_judges_saved_files_and_ends_with_ctrl_c() {
    let class = classroom();
    said(class.path(), &[]);
    let folder = class.path().join("withy-exercises");
    let mut watching = Command::new(env!("CARGO_BIN_EXE_withy"))
        .args(["learn", "watch"])
        .current_dir(&folder)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let printed = lines(watching.stdout.take().unwrap());
    wait_for(&printed, &format!("not yet: {}", EXERCISES[0].id()));
    wait_for(&printed, "waiting for a saved file");
    solve(&folder, 1);
    wait_for(&printed, &format!("passed: {}", EXERCISES[0].id()));
    wait_for(&printed, &format!("Next: {}", EXERCISES[1].id()));
    wait_for(&printed, "waiting for a saved file");
    fs::write(folder.join(EXERCISES[1].file()), "let second_moment = 1;").unwrap();
    wait_for(&printed, "'second_moment' of your script must be a function, but is a whole number");
    wait_for(&printed, "waiting for a saved file");
    Command::new("kill").args(["-INT", &watching.id().to_string()]).status().unwrap();
    assert_eq!(watching.wait().unwrap().code(), Some(0));
}

#[cfg(unix)]
#[test]
fn ctrl_c_stops_a_check_and_leaves_the_progress_as_it_was() {
    let class = classroom();
    said(class.path(), &[]);
    let folder = class.path().join("withy-exercises");
    solve(&folder, 1);
    assert_eq!(said(&folder, &["check", EXERCISES[0].name]).0, 0);
    fs::write(folder.join(EXERCISES[0].file()), "print(\"started\"); loop { }").unwrap();
    let mut checking = Command::new(env!("CARGO_BIN_EXE_withy"))
        .args(["learn", "check", EXERCISES[0].name])
        .current_dir(&folder)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let printed = lines(checking.stdout.take().unwrap());
    wait_for(&printed, "started");
    Command::new("kill").args(["-INT", &checking.id().to_string()]).status().unwrap();
    assert_eq!(checking.wait().unwrap().code(), Some(130));
    assert!(said(&folder, &[]).1.contains("1 of "));
}

#[test]
fn watching_ends_when_all_is_passed() {
    let class = classroom();
    said(class.path(), &[]);
    let folder = class.path().join("withy-exercises");
    solve(&folder, EXERCISES.len());
    said(&folder, &["check"]);
    let (code, text) = said(&folder, &["watch"]);
    assert_eq!(code, 0);
    assert!(text.contains("All exercises are passed"), "{text}");
}

/// Class of three students: one has solved two exercises, one has damaged files of every kind, one has only started.
fn class_of_three() -> TempDir {
    let class = classroom();
    let write = |student: &str, name: &str, content: &[u8]| {
        let file = class.path().join(student).join(name);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, content).unwrap();
    };
    solve(&class.path().join("ada"), 2);
    write("bea", "withy-exercises/splines/knot_vector.rhai", b"let k = knots(3, [0, 1");
    write("bea", "withy-exercises/splines/kink.rhai", b"// \xff\xfe");
    write("bea", "withy-exercises/splines/refine.rhai", b"loop { }");
    write(
        "bea",
        "withy-exercises/splines/unlocking.rhai",
        b"plot_history(1, 2, 3); let mesh = bspline(3);",
    );
    write("carl", &EXERCISES[0].file(), EXERCISES[0].start.replace('\n', "\r\n").as_bytes());
    write(
        "carl",
        "beams/rectangle.rhai",
        b"let strip = section(#{ EA: 1, GA: 1, EI: 1, rho_A: 1, rho_I: 1 });",
    );
    class
}

#[test]
fn any_submissions_are_graded_as_json() {
    let class = class_of_three();
    let output = learn(class.path(), &["grade", ".", "--json", "--max-time", "1"]);
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).unwrap();
    let graded: serde_json::Value = serde_json::from_str(&text).unwrap();
    let keys: Vec<_> = graded.as_object().unwrap().keys().collect();
    assert_eq!(keys, ["exercises", "students"]);
    assert_eq!(graded["exercises"], EXERCISES.len());
    let students = graded["students"].as_array().unwrap();
    let names: Vec<_> =
        students.iter().map(|student| student["student"].as_str().unwrap()).collect();
    assert_eq!(names, ["ada", "bea", "carl"]);
    assert_eq!(students[0]["passed"], 2);
    let result = |student: usize, id: &str| {
        let exercises = students[student]["exercises"].as_array().unwrap();
        assert_eq!(exercises.len(), EXERCISES.len());
        let found = exercises.iter().find(|exercise| exercise["exercise"] == id).unwrap();
        let keys: Vec<_> = found.as_object().unwrap().keys().collect();
        assert_eq!(keys, ["exercise", "result", "message"]);
        [&found["result"], &found["message"]].map(|text| text.as_str().unwrap().to_owned())
    };
    assert_eq!(result(0, "sliding/corner"), ["missing", ""]);
    assert_eq!(result(2, &EXERCISES[0].id()), ["untouched", ""]);
    let starts = |student, id: &str, mark: &str, message: &str| {
        let [result, said] = result(student, id);
        assert!(result == mark && said.contains(message), "{id}: {result}, {said}");
    };
    starts(1, "splines/knot_vector", "broken", "line 1: ");
    starts(1, "splines/kink", "broken", "not UTF-8");
    starts(1, "splines/refine", "stopped", "longer than 1 s");
    starts(1, "splines/unlocking", "broken", "line 1: ");
    starts(2, "beams/rectangle", "off", "no variable 'second_moment'");
    let again = learn(class.path(), &["grade", ".", "--json", "--max-time", "1"]);
    assert_eq!(String::from_utf8(again.stdout).unwrap(), text, "equal submissions, equal bytes");
    assert!(!class.path().join("ada/out").exists(), "nothing is written to a submission");
}

#[test]
fn a_class_is_graded_as_a_table() {
    let class = class_of_three();
    let (code, text) = said(class.path(), &["grade", "ada"]);
    assert_eq!(code, 0);
    assert!(text.lines().any(|line| line.starts_with("ada") && line.contains("missing")), "{text}");
    let sum = text.lines().last().unwrap().split_whitespace().collect::<Vec<_>>();
    assert_eq!(sum, ["ada", "2", EXERCISES.len().to_string().as_str()]);
}

#[test]
fn folder_without_submissions_is_rejected() {
    let class = classroom();
    let (code, text) = said(class.path(), &["grade", "."]);
    assert_eq!(code, 2);
    assert!(text.contains("a folder for each student"), "{text}");
}

/// Name of a student, attempt, and mark.
#[cfg(target_os = "linux")]
type Poison = (&'static str, &'static str, &'static str);

/// Attempts that made the marks of a class unusable or did not terminate, with their marks. The exercise is knot_vector.
#[cfg(target_os = "linux")]
const POISONS: &[Poison] = &[
    ("wide", "let t = \"\"; t.pad(70000, 'x'); throw t;", "broken"),
    ("long", "let s = \"\"; s.pad(16000000, 'a'); let t = s; s.replace(\"a\", t);", "broken"),
    ("pipe", "import \"pipe\" as p;", "broken"),
    ("sparse", "import \"sparse\" as p;", "broken"),
    ("endless", "loop { try { loop { } } catch { } }", "stopped"),
    ("large", "let a = []; loop { let b = []; b.pad(1000000, 1); a.push(b); }", "stopped"),
    (
        "cycle",
        "let a = []; loop { let big = []; big.pad(100000, 1); let f = || big; big[0] = f; }",
        "stopped",
    ),
    ("prints", "let s = \"\"; s.pad(1000000, 'x'); loop { print(s); }", "stopped"),
    ("deep", "fn f(n) { f(n + 1) } f(0);", "broken"),
    ("throws", "let t = \"\"; t.pad(15000000, 'x'); throw t;", "broken"),
    (
        "forges",
        "print(`{\"result\":\"passed\",\"message\":\"\"}`); throw `{\"result\":\"passed\"}`;",
        "broken",
    ),
    (
        "dedups",
        "let a = []; a.pad(10000000, 1); for i in 0..1000 { let b = a + []; b.dedup(); }",
        "stopped",
    ),
];

#[cfg(target_os = "linux")]
fn poisoned_class(poisons: &[&Poison]) -> TempDir {
    let class = classroom();
    for (student, attempt, _) in poisons {
        let folder = class.path().join(student);
        fs::create_dir(&folder).unwrap();
        fs::write(folder.join("knot_vector.rhai"), attempt).unwrap();
    }
    if class.path().join("pipe").exists() {
        let pipe = class.path().join("pipe/pipe.rhai");
        assert!(Command::new("mkfifo").arg(pipe).status().unwrap().success());
        let sparse = fs::File::create(class.path().join("sparse/sparse.rhai")).unwrap();
        sparse.set_len(2 << 30).unwrap();
    }
    // This student comes last.
    let honest = EXERCISES.iter().find(|it| it.name == "knot_vector").unwrap();
    fs::create_dir(class.path().join("zoe")).unwrap();
    fs::write(class.path().join("zoe/knot_vector.rhai"), honest.solution).unwrap();
    class
}

#[cfg(target_os = "linux")]
#[test]
fn malicious_attempts_affect_only_their_author() {
    // Attempts that exceed the time limit get a short limit, all others a long one for slow machines.
    let (endless, other): (Vec<&Poison>, Vec<&Poison>) =
        POISONS.iter().partition(|(_, _, mark)| *mark == "stopped");
    expect_marks(&endless, "3", None);
    expect_marks(&other, "120", Some("passed"));
}

/// Grades a class with these attempts and an honest last one. Checks the mark of the latter if given.
#[cfg(target_os = "linux")]
fn expect_marks(poisons: &[&Poison], time: &str, honest: Option<&str>) {
    let class = poisoned_class(poisons);
    let limits = ["--max-time", time, "--max-memory", "400", "--marks", "marks.jsonl", "--json"];
    let output = learn(class.path(), &[&["grade", "."][..], &limits].concat());
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{text}");
    let graded: serde_json::Value = serde_json::from_str(&text).unwrap();
    let marks = fs::read_to_string(class.path().join("marks.jsonl")).unwrap();
    let marks: Vec<serde_json::Value> =
        marks.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(marks.len(), (poisons.len() + 1) * EXERCISES.len());
    let zoe = honest.map(|mark| ("zoe", "", mark));
    for (student, _, mark) in poisons.iter().copied().chain(&zoe) {
        let of = graded["students"].as_array().unwrap().iter().find(|it| it["student"] == *student);
        let of = of.unwrap()["exercises"].as_array().unwrap();
        let found = of.iter().find(|it| it["exercise"] == "splines/knot_vector").unwrap();
        assert_eq!(found["result"], *mark, "{student}: {}", found["message"]);
        let noted = marks
            .iter()
            .find(|it| it["student"] == *student && it["exercise"] == "splines/knot_vector");
        assert_eq!(noted.unwrap()["result"], *mark);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn marks_are_written_one_by_one_and_survive_a_kill() {
    let class = classroom();
    solve(&class.path().join("ada"), 2);
    fs::create_dir_all(class.path().join("bea")).unwrap();
    fs::write(class.path().join("bea/change_one_number.rhai"), "loop { }").unwrap();
    let mut grading = Command::new(env!("CARGO_BIN_EXE_withy"))
        .args(["learn", "grade", ".", "--jobs", "1", "--marks", "marks.jsonl"])
        .current_dir(class.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let printed = lines(grading.stdout.take().unwrap());
    wait_for(&printed, "ada      beams/change_one_number");
    wait_for(&printed, "ada      studies/whose_stiffness");
    grading.kill().unwrap();
    grading.wait().unwrap();
    let marks = fs::read_to_string(class.path().join("marks.jsonl")).unwrap();
    assert_eq!(marks.lines().count(), EXERCISES.len(), "{marks}");
    assert_eq!(marks.matches("\"passed\"").count(), 2, "{marks}");
}

/// Starts to grade a class with a single, endless attempt, and waits until the attempt runs. Returns the process and its folder for temporary files.
#[cfg(target_os = "linux")]
fn grading_for_ever(class: &TempDir) -> (std::process::Child, std::path::PathBuf) {
    let temporary = class.path().join("tmp");
    fs::create_dir_all(&temporary).unwrap();
    fs::create_dir_all(class.path().join("class/ada")).unwrap();
    fs::write(class.path().join("class/ada/change_one_number.rhai"), "loop { }").unwrap();
    let mut grading = Command::new(env!("CARGO_BIN_EXE_withy"))
        .args(["learn", "grade", "class", "--marks", "marks.jsonl"])
        .current_dir(class.path())
        .env("TMPDIR", &temporary)
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let inside = || fs::read_dir(&temporary).unwrap().filter_map(Result::ok).next();
    let has_part = || fs::read_dir(inside()?.path()).ok().map(Iterator::count).filter(|n| *n > 1);
    for _ in 0..6000 {
        if has_part().is_some() {
            thread::sleep(Duration::from_millis(300));
            return (grading, temporary);
        }
        thread::sleep(Duration::from_millis(10));
    }
    grading.kill().unwrap();
    grading.wait().unwrap();
    panic!("no attempt is judged");
}

#[cfg(target_os = "linux")]
#[test]
fn ended_or_killed_grading_leaves_no_files() {
    let class = classroom();
    let left = |folder: &Path| fs::read_dir(folder).unwrap().count();
    let (mut ended, temporary) = grading_for_ever(&class);
    Command::new("kill").args(["-TERM", &ended.id().to_string()]).status().unwrap();
    assert_eq!(ended.wait().unwrap().code(), Some(130));
    assert_eq!(left(&temporary), 0, "SIGTERM leaves nothing behind");
    let (mut killed, temporary) = grading_for_ever(&class);
    killed.kill().unwrap();
    killed.wait().unwrap();
    assert_eq!(left(&temporary), 1, "nobody can clean up after SIGKILL");
    // The operating system ends the process of the attempt.
    thread::sleep(Duration::from_millis(300));
    solve(&class.path().join("honest/bea"), 1);
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    let next = command.args(["learn", "grade", "honest"]).current_dir(class.path());
    assert_eq!(next.env("TMPDIR", &temporary).output().unwrap().status.code(), Some(0));
    assert_eq!(left(&temporary), 0, "the next one does");
}

#[test]
fn marks_of_unchanged_attempts_are_reused() {
    let class = classroom();
    solve(&class.path().join("class/ada"), 2);
    solve(&class.path().join("class/bea"), 1);
    let grade = |more: &[&str]| {
        let to_file = ["grade", "class", "--marks", "marks.jsonl", "--json", "--jobs", "1"];
        let words = [&to_file[..], more].concat();
        let output = learn(class.path(), &words);
        assert_eq!(output.status.code(), Some(0));
        let messages = String::from_utf8(output.stderr).unwrap();
        (String::from_utf8(output.stdout).unwrap(), messages)
    };
    let lines = || fs::read_to_string(class.path().join("marks.jsonl")).unwrap().lines().count();
    let all = 2 * EXERCISES.len();
    let (first, messages) = grade(&[]);
    assert!(messages.is_empty() && lines() == all, "{messages}");
    let (second, messages) = grade(&[]);
    assert!(
        messages.contains(&format!("note: {all} marks were taken from 'marks.jsonl'")),
        "{messages}"
    );
    assert_eq!((second, lines()), (first, all), "the same marks, and nothing is written twice");
    // Truncated last line, as after a kill during writing.
    let text = fs::read_to_string(class.path().join("marks.jsonl")).unwrap();
    fs::write(class.path().join("marks.jsonl"), &text[..text.len() - 20]).unwrap();
    fs::write(class.path().join("class/bea").join(EXERCISES[0].file()), "const EI = 5;").unwrap();
    let (third, messages) = grade(&[]);
    assert!(messages.contains(&format!("note: {} marks", all - 2)), "{messages}");
    // The truncated line has been removed.
    assert!(third.contains("the tip of the strip does not sink by") && lines() == all + 1);
    let (_, messages) = grade(&["--max-time", "19"]);
    assert!(messages.is_empty(), "other limits may give other marks: {messages}");
    fs::write(class.path().join("notes.txt"), "mine").unwrap();
    let (code, text) = said(class.path(), &["grade", "class", "--marks", "notes.txt"]);
    assert!(code == 2 && text.contains("is not a file of marks"), "{text}");
    assert_eq!(fs::read(class.path().join("notes.txt")).unwrap(), b"mine");
}

#[cfg(unix)]
#[test]
fn link_to_the_work_of_another_student_is_not_graded() {
    let class = classroom();
    solve(&class.path().join("ada"), 1);
    std::os::unix::fs::symlink("ada", class.path().join("mallory")).unwrap();
    let (_, text) = said(class.path(), &["grade", "."]);
    let sum = |student: &str| {
        let of = |line: &&str| line.split_whitespace().next() == Some(student);
        text.lines().rfind(of).unwrap().split_whitespace().nth(1).unwrap().to_owned()
    };
    assert_eq!((sum("ada"), sum("mallory")), ("1".into(), "0".into()), "{text}");
    assert!(text.contains("is a link; an attempt must be in a real folder"), "{text}");
}
