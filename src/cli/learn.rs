//! `withy learn`: offers exercises to students.

use std::io::{IsTerminal, stderr, stdout};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::{env, thread};

use super::console::{is_output_lost, print_line};
use super::grade::{GradeFormat, GradeOptions, grade};
use super::interrupt::{self, InterruptLoss};
use super::learn_options::{LearnAction, LearnOptions};
use super::limits::LimitOptions;
use super::progress_display::{self, ProgressPreference};
use super::run::{last_resort, report_error};
use super::tui::{self, ScriptPainter, judge_process, terminal};
use super::{Exit, attempt_process};
use crate::exercises::attempt;
use crate::exercises::catalogue::{EXERCISES, TRACKS, find};
use crate::exercises::error::ExerciseError;
use crate::exercises::exercise::Exercise;
use crate::exercises::judging::{AttemptVerdict, judge};
use crate::exercises::watch::{INTERVAL, Watcher};
use crate::exercises::workbook::{Advice, Workbook};
use crate::output::printable_line;
use crate::panics;
use crate::script::diagnose::{Colours, Diagnostic};
use crate::script::state::settings::{RunMode, RunSettings};

pub fn learn(options: &LearnOptions) -> Exit {
    panics::silence();
    let workbook = Workbook::near(Path::new("."));
    let done = match &options.action {
        None => welcome(&workbook),
        Some(LearnAction::List) => list(&workbook),
        Some(LearnAction::Next) => begin(&workbook).and_then(|()| show_next(&workbook)),
        Some(LearnAction::Check { name: Some(name), limits, .. }) => {
            let flag = interrupt::flag(InterruptLoss::Run);
            begin(&workbook).and_then(|()| check(&workbook, find(name)?, limits, &flag))
        }
        Some(LearnAction::Check { name: None, all, limits }) => {
            let detail = if *all { Detail::Each } else { Detail::Summary };
            check_all(&workbook, detail, limits)
        }
        Some(LearnAction::Hint { name }) => hint(&workbook, name.as_deref()),
        Some(LearnAction::Solution { name }) => solution(&workbook, name),
        Some(LearnAction::Reset { name }) => reset(&workbook, name),
        Some(LearnAction::Watch { limits }) => watch(&workbook, limits),
        Some(LearnAction::Try { name, limits }) => {
            find(name).map(|exercise| judge_process::try_here(&workbook, exercise, limits))
        }
        Some(LearnAction::Grade { folder, json, marks, jobs, limits }) => {
            let form = if *json { GradeFormat::Json } else { GradeFormat::Table };
            grade(&GradeOptions { folder, form, marks: marks.as_deref(), jobs: *jobs, limits })
        }
        Some(LearnAction::Attempt { folder, file, name, limits }) => {
            find(name).map(|exercise| attempt_process::judge_one(folder, file, exercise, limits))
        }
    };
    if is_output_lost() {
        return report_error(&Diagnostic::general("part of the output could not be written"));
    }
    done.unwrap_or_else(|error| report_error(&Diagnostic::general(error.to_string())))
}

type Done = Result<Exit, ExerciseError>;

fn begin(workbook: &Workbook) -> Result<(), ExerciseError> {
    if workbook.fill()? == EXERCISES.len() {
        print_line(&format!(
            "{} exercises were written to {}\n",
            EXERCISES.len(),
            shown(workbook.folder())
        ));
    }
    Ok(())
}

fn welcome(workbook: &Workbook) -> Done {
    begin(workbook)?;
    let progress = workbook.progress()?;
    let passed = EXERCISES.iter().filter(|exercise| progress.has_passed(exercise)).count();
    print_line(&format!("{passed} of {} exercises are passed.\n", EXERCISES.len()));
    show_next(workbook)?;
    print_line(
        "\nwithy learn watch judges each file when you save it; withy learn list shows all exercises.",
    );
    Ok(Exit::Success)
}

fn list(workbook: &Workbook) -> Done {
    let progress = workbook.progress()?;
    let longest = EXERCISES.iter().map(|exercise| exercise.name.len()).max().unwrap_or(0);
    for track in TRACKS {
        print_line(track.title);
        for exercise in EXERCISES.iter().filter(|exercise| exercise.track == track.name) {
            let mark = if progress.has_passed(exercise) { "passed" } else { "" };
            print_line(&format!("  {mark:<6}  {:<longest$}  {}", exercise.name, exercise.title()));
        }
    }
    Ok(Exit::Success)
}

fn show_next(workbook: &Workbook) -> Done {
    match workbook.next()? {
        Some(exercise) => {
            print_line(&format!("Next: {}. {}", exercise.id(), exercise.title()));
            print_line(&format!("  edit           {}", shown(&workbook.file(exercise))));
            print_line(&format!("  then           withy learn check {}", exercise.name));
            print_line(&format!("  if it is hard  withy learn hint {}", exercise.name));
        }
        None => print_line(
            "All exercises are passed. Congratulations!\n\
             withy learn solution NAME shows a solution to compare with.",
        ),
    }
    Ok(Exit::Success)
}

fn check(
    workbook: &Workbook,
    exercise: &Exercise,
    limits: &LimitOptions,
    flag: &Arc<AtomicBool>,
) -> Done {
    let settings = RunSettings {
        out: workbook.folder().join("out"),
        interrupt: Arc::clone(flag),
        limits: limits.limits(),
        printed: Box::new(stdout()),
        diagnostics: Box::new(stderr()),
        progress: progress_display::progress(ProgressPreference::Show),
        last_resort: Some(last_resort()),
        ..RunSettings::silent(RunMode::Run)
    };
    let verdict = judge_file(workbook, exercise, settings);
    let has_passed = matches!(verdict, AttemptVerdict::Passed);
    let is_noted =
        matches!(verdict, AttemptVerdict::Interrupted) || note(workbook, exercise, has_passed);
    let off = match verdict {
        AttemptVerdict::Passed => {
            print_line(&format!("passed: {}", exercise.id()));
            if is_noted {
                show_next(workbook)?;
            }
            return Ok(Exit::Success);
        }
        AttemptVerdict::Interrupted => {
            print_line("interrupted before the attempt was judged");
            return Ok(Exit::Interrupted);
        }
        AttemptVerdict::Error(why) | AttemptVerdict::Stopped(why) => why.render(colours()),
        AttemptVerdict::WrongResult(found) => {
            found.iter().map(|found| format!("  - {found}\n")).collect()
        }
    };
    print_line(&format!("{off}\nnot yet: {}", exercise.id()));
    print_line(&format!("a hint: withy learn hint {}", exercise.name));
    Ok(Exit::CheckFailed)
}

fn note(workbook: &Workbook, exercise: &Exercise, has_passed: bool) -> bool {
    let noted = workbook.record(exercise, has_passed);
    if let Err(error) = &noted {
        print_line(&format!("the result was not recorded: {error}"));
    }
    noted.is_ok()
}

fn judge_file(workbook: &Workbook, exercise: &Exercise, settings: RunSettings) -> AttemptVerdict {
    match attempt::load(&workbook.file(exercise), workbook.folder()) {
        Ok(attempt) => judge(exercise, &attempt, settings),
        Err(why) => AttemptVerdict::Error(why),
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Detail {
    Summary,
    Each,
}

fn check_all(workbook: &Workbook, detail: Detail, limits: &LimitOptions) -> Done {
    begin(workbook)?;
    let flag = interrupt::flag(InterruptLoss::Run);
    let bar = progress_display::progress(ProgressPreference::Show);
    bar.begin_cases("judging", EXERCISES.len());
    let (mut passed, mut begun) = (0, Vec::new());
    for (done, exercise) in EXERCISES.iter().enumerate() {
        bar.report_case(done);
        let settings = RunSettings {
            out: workbook.folder().join("out"),
            interrupt: Arc::clone(&flag),
            limits: limits.limits(),
            last_resort: Some(last_resort()),
            ..RunSettings::silent(RunMode::Run)
        };
        let verdict = judge_file(workbook, exercise, settings);
        let has_passed = matches!(verdict, AttemptVerdict::Passed);
        let word = match verdict {
            AttemptVerdict::Interrupted => {
                bar.end();
                return Ok(Exit::Interrupted);
            }
            _ if has_passed => "passed ",
            _ => "not yet",
        };
        note(workbook, exercise, has_passed);
        passed += usize::from(has_passed);
        if !has_passed && workbook.is_begun(exercise) {
            begun.push(exercise.id());
        }
        if detail == Detail::Each {
            bar.without_progress_bar(&mut || print_line(&format!("{word}  {}", exercise.id())));
        }
    }
    bar.end();
    if !begun.is_empty() {
        print_line(&format!("Begun, but not passed: {}", begun.join(", ")));
    }
    if detail == Detail::Summary {
        show_next(workbook)?;
    }
    print_line(&format!("\n{passed} of {} exercises are passed.", EXERCISES.len()));
    Ok(if passed == EXERCISES.len() { Exit::Success } else { Exit::CheckFailed })
}

fn solution(workbook: &Workbook, name: &str) -> Done {
    begin(workbook)?;
    let exercise = find(name)?;
    if !workbook.progress()?.has_passed(exercise) {
        print_line(&format!(
            "{} is not passed yet; its solution is shown after that.\n\
             withy learn hint {} gives one more hint each time, and a solution after the last one.",
            exercise.id(),
            exercise.name
        ));
        return Ok(Exit::CheckFailed);
    }
    let solution = exercise.solution.trim_end();
    match colours() {
        Colours::Ansi => print_line(&ScriptPainter::new().paint(solution)),
        Colours::None => print_line(solution),
    }
    Ok(Exit::Success)
}

fn hint(workbook: &Workbook, name: Option<&str>) -> Done {
    begin(workbook)?;
    let exercise = match name {
        Some(name) => find(name)?,
        None => match workbook.next()? {
            Some(exercise) => exercise,
            None => return show_next(workbook),
        },
    };
    match workbook.hint(exercise)? {
        Advice::Hint { text, number, count } => {
            print_line(&format!("{}, hint {number} of {count}: {text}", exercise.id()));
        }
        Advice::Solution(solution) => {
            print_line(&format!("{}: there are no more hints. One solution:\n", exercise.id()));
            print_line(solution.trim_end());
        }
    }
    Ok(Exit::Success)
}

fn reset(workbook: &Workbook, name: &str) -> Done {
    begin(workbook)?;
    let exercise = find(name)?;
    let kept = workbook.reset(exercise)?;
    print_line(&format!(
        "{} was reset; your attempt was saved as {}",
        shown(&workbook.file(exercise)),
        shown(&kept)
    ));
    Ok(Exit::Success)
}

fn watch(workbook: &Workbook, limits: &LimitOptions) -> Done {
    begin(workbook)?;
    let flag = interrupt::flag(InterruptLoss::Run);
    if !terminal::is_there() {
        return watch_in_lines(workbook, limits, &flag);
    }
    tui::watch(workbook, limits, &flag)?;
    let progress = workbook.progress()?;
    let passed = EXERCISES.iter().filter(|exercise| progress.has_passed(exercise)).count();
    print_line(&format!("{passed} of {} exercises are passed.", EXERCISES.len()));
    show_next(workbook)
}

fn watch_in_lines(workbook: &Workbook, limits: &LimitOptions, flag: &Arc<AtomicBool>) -> Done {
    let mut watcher = Watcher::new(workbook);
    let mut current = workbook.next()?;
    while let Some(exercise) = current {
        let exit = check(workbook, exercise, limits, flag)?;
        let next = workbook.next()?;
        if next.is_none() || flag.load(Ordering::Relaxed) {
            return Ok(Exit::Success);
        }
        if exit == Exit::Success {
            print_line("");
        }
        print_line(&format!(
            "waiting for a saved file in {}; Ctrl-C ends",
            shown(workbook.folder())
        ));
        current = loop {
            if flag.load(Ordering::Relaxed) {
                return Ok(Exit::Success);
            }
            match watcher.changed() {
                Some(exercise) => break Some(exercise),
                None => thread::sleep(INTERVAL),
            }
        };
    }
    show_next(workbook)
}

pub(super) fn shown(path: &Path) -> String {
    let path: PathBuf = path.strip_prefix(".").unwrap_or(path).into();
    if path.as_os_str().is_empty() {
        "this folder".into()
    } else {
        printable_line(&path.display().to_string())
    }
}

fn colours() -> Colours {
    let wants =
        stdout().is_terminal() && env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    if wants { Colours::Ansi } else { Colours::None }
}
