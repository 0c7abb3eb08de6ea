//! `withy learn watch` at a terminal: all exercises from the first screen to the last solution, keys during an endless attempt, and the restored terminal.
#![allow(clippy::unwrap_used)]
#![cfg(unix)]

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use rexpect::session::{PtySession, spawn_command};
use withy::exercises::catalogue::EXERCISES;
use withy::exercises::exercise::Exercise;

/// Time limit of a wait [ms], generous for loaded machines.
const TIME_LIMIT: u64 = 60_000;

/// Student at a terminal of a given size in an empty folder. The shell reports the state of the terminal afterwards.
struct Student {
    session: PtySession,
    folder: tempfile::TempDir,
}

impl Student {
    fn watches(size: &str, options: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut command = Command::new("sh");
        let script = format!(
            "stty {size}; stty -g > before; \
             sh -c 'echo $$ > process; exec \"$WITHY\" learn watch {options}'; \
             stty -g > after; echo gone"
        );
        command.current_dir(folder.path()).args(["-c", &script]);
        command.env("WITHY", env!("CARGO_BIN_EXE_withy"));
        command.env("TERM", "xterm").env("LANG", "C.UTF-8").env("NO_COLOR", "1");
        Self { session: spawn_command(command, Some(TIME_LIMIT)).unwrap(), folder }
    }

    fn sees(&mut self, words: &str) {
        let seen = self.session.exp_string(words);
        seen.unwrap_or_else(|error| panic!("'{words}' was not seen: {error}"));
    }

    fn presses(&mut self, key: &str) {
        self.session.send(key).unwrap();
        self.session.flush().unwrap();
    }

    fn saves(&self, exercise: &Exercise, text: &str) {
        fs::write(self.folder.path().join("withy-exercises").join(exercise.file()), text).unwrap();
    }

    /// Waits until the screen is closed and the terminal is restored.
    fn has_left(&mut self) {
        self.sees("\u{1b}[?25h");
        self.sees("\u{1b}[?1049l");
        self.sees("exercises are passed.");
        self.sees("gone");
        let said = |name: &str| fs::read_to_string(self.folder.path().join(name)).unwrap();
        assert_eq!(said("before"), said("after"));
    }
}

/// Wrong but plausible attempt.
fn attempt(exercise: &Exercise) -> String {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    fs::read_to_string(root.join("tests/attempts").join(exercise.file())).unwrap()
}

#[test]
fn all_exercises_can_be_completed_in_the_terminal() {
    let mut student = Student::watches("rows 70 cols 110", "");
    let count = EXERCISES.len();
    for (index, exercise) in EXERCISES.iter().enumerate() {
        student.sees(&format!("Exercise {} of {count}: {}", index + 1, exercise.title()));
        student.sees(&format!("{index} of {count} passed"));
        student.sees(&format!("Edit withy-exercises/{}", exercise.file()));
        student.sees("To do:");
        student.sees("Not yet");
        student.sees("(run 1)");
        student.saves(exercise, &attempt(exercise));
        student.sees("Not yet");
        student.sees("(run 2)");
        student.presses("s");
        student.sees("the solution is shown after the exercise is passed");
        student.presses("h");
        student.sees(&format!("Hint 1 of {}:", exercise.judge().hints.len()));
        student.saves(exercise, exercise.solution);
        student.sees(&format!("{} of {count} passed", index + 1));
        student.sees("Passed. (run 3)");
        student.presses("s");
        student.sees(&format!("A solution of exercise {}", index + 1));
        student.sees("» ");
        student.presses("s");
        student.sees("Passed. (run 3)");
        student.presses("n");
    }
    student.sees("all exercises are passed; l lists them, q exits");
    student.presses("l");
    student.sees(&format!("> passed {count:>2}  {}", EXERCISES[count - 1].name));
    student.presses("q");
    student.has_left();
}

#[test]
fn keys_work_during_an_endless_attempt_and_saving_restarts_it() {
    let mut student = Student::watches("rows 40 cols 100", "");
    student.sees("(run 1)");
    student.saves(&EXERCISES[0], "loop { }");
    student.sees("Running, 1 s.");
    student.presses("h");
    student.sees("Hint 1 of 3:");
    student.presses("w");
    student.sees("the key w has no function here");
    student.saves(&EXERCISES[0], EXERCISES[0].solution);
    student.sees("Passed. (run 2)");
    student.saves(&EXERCISES[1], "loop { try { loop { } } catch { } }");
    student.sees("Exercise 2 of 28");
    student.sees("Running, 1 s.");
    student.presses("q");
    student.has_left();
}

#[test]
fn time_limit_stops_an_endless_attempt() {
    let mut student = Student::watches("rows 40 cols 100", "--max-time 1");
    student.sees("(run 1)");
    student.saves(&EXERCISES[0], "loop { }");
    student.sees("it was stopped");
    student.sees("the run takes longer than 1 s");
    student.presses("q");
    student.has_left();
}

#[test]
fn memory_limit_stops_an_attempt() {
    let mut student = Student::watches("rows 40 cols 100", "--max-memory 300");
    student.sees("(run 1)");
    let eater =
        "let a = []; loop { let big = []; big.pad(100000, 1); let f = || big; big[0] = f; }";
    student.saves(&EXERCISES[0], eater);
    student.sees("it was stopped");
    student.sees("the run needs more than 300 MB of memory");
    student.presses("q");
    student.has_left();
}

#[test]
fn the_list_opens_another_exercise_and_previous_goes_back() {
    let mut student = Student::watches("rows 24 cols 80", "");
    student.sees("Exercise 1 of 28");
    student.presses("l");
    student.sees("All 28 exercises");
    student.presses("7");
    student.sees(">         7  kink");
    student.presses("\r");
    student.sees("Exercise 7 of 28");
    student.presses("p");
    student.sees("Exercise 6 of 28");
    student.presses("n");
    student.sees("n again skips it");
    student.presses("n");
    student.sees("Exercise 7 of 28");
    student.presses("\u{3}");
    student.has_left();
}

#[test]
fn termination_restores_the_terminal() {
    let mut student = Student::watches("rows 40 cols 100", "");
    student.sees("(run 1)");
    student.saves(&EXERCISES[0], "loop { }");
    student.sees("Running, 1 s.");
    let process = fs::read_to_string(student.folder.path().join("process")).unwrap();
    let killed = Command::new("kill").args(["-TERM", process.trim()]).status().unwrap();
    assert!(killed.success());
    student.has_left();
}
