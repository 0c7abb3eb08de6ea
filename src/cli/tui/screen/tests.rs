use super::super::state::{ScreenPage, TuiState};
use super::*;
use crate::exercises::captured_output::CapturedOutput;
use crate::exercises::progress::StudentProgress;
use crate::exercises::report::{AttemptError, AttemptOutcome, AttemptReport, ScriptPosition};
use crate::output::Colours;

fn at(number: usize) -> TuiState {
    let exercise = &EXERCISES[number - 1];
    TuiState::open(
        exercise,
        format!("withy-exercises/{}", exercise.file()),
        StudentProgress::default(),
    )
}

fn judged(number: usize, outcome: AttemptOutcome, printed: &[&str]) -> TuiState {
    let mut state = at(number);
    let lines = printed.iter().map(|line| (*line).to_owned()).collect();
    state
        .set_report(AttemptReport { outcome, printed: CapturedOutput { lines, further_lines: 0 } });
    state
}

fn broken() -> AttemptOutcome {
    let text = EXERCISES[1].start.lines().find(|line| line.contains("todo(\"")).unwrap();
    let place = ScriptPosition {
        file: "./withy-exercises/beams/rectangle.rhai".into(),
        line: 15,
        text: text.into(),
        at: 36,
        length: 4,
    };
    let message = "still to do: the second moment of area, from width and height".into();
    let help = Some("replace all of todo(…), including the quotes".into());
    AttemptOutcome::Error(AttemptError { message, help, place: Some(place), calls: Vec::new() })
}

fn lines(state: &TuiState, size: (usize, usize)) -> Vec<String> {
    screen(state, size, &[]).lines.iter().map(ScreenLine::text).collect()
}

fn text(state: &TuiState, size: (usize, usize)) -> String {
    lines(state, size).join("\n")
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn without_blanks(text: &str) -> String {
    text.split_whitespace().collect()
}

#[test]
fn first_screen_shows_title_progress_file_and_task() {
    for size in [(80, 24), (120, 40), (60, 40), (40, 60)] {
        let shown = lines(&at(1), size);
        let all = without_blanks(&shown.join("\n"));
        for part in [
            "Exercise 1 of 28: Change one number and see what it does",
            "0 of 28 passed",
            "Edit withy-exercises/beams/change_one_number.rhai",
            "A strip of length 1 is clamped at its left end.",
            "To do: choose EI such that the tip sinks by no less than 0.08 and no more than 0.1.",
            "h hint",
        ] {
            let is_there = all.contains(&without_blanks(part));
            assert!(is_there, "{part} at {size:?}:\n{}", shown.join("\n"));
        }
        assert!(shown.last().unwrap().ends_with("q quit"), "{shown:#?}");
    }
}

#[test]
fn every_page_fits_any_screen_size() {
    let notice =
        Some("a word to who has pressed a key that does nothing, and a long one".to_owned());
    let code: Vec<ScreenLine> =
        EXERCISES[2].solution.lines().map(|line| ScreenLine::of(line, PLAIN)).collect();
    for number in 1..=EXERCISES.len() {
        for page in [ScreenPage::Task, ScreenPage::List(number - 1), ScreenPage::Solution] {
            for size in [(80, 24), (120, 40), (40, 24), (40, 8), (20, 5), (1, 1), (300, 100)] {
                let mut state =
                    TuiState { page, notice: notice.clone(), ..judged(number, broken(), &["x"]) };
                state.hints = 2;
                let Screen { lines, window } = screen(&state, size, &code);
                assert!(lines.len() <= size.1, "{number} {page:?} {size:?}");
                assert!(window.top <= window.last);
                let widest = lines.iter().map(ScreenLine::width).max().unwrap();
                assert!(widest < size.0.max(11), "{number} {page:?} {size:?}: {widest}");
            }
        }
    }
}

#[test]
fn narrow_screens_do_not_break_words_of_the_task() {
    for exercise in 1..=EXERCISES.len() {
        let all = text(&at(exercise), (40, 200));
        let known = EXERCISES[exercise - 1].start;
        let of_task = all.lines().skip_while(|line| !line.starts_with('─')).skip(1);
        for word in
            of_task.take_while(|line| !line.starts_with('─')).flat_map(str::split_whitespace)
        {
            assert!(known.contains(word), "{word} in\n{all}");
        }
    }
}

#[test]
fn error_is_shown_with_its_source_line() {
    let all = text(&judged(2, broken(), &[]), (80, 40));
    for part in [
        "line 15: still to do: the second moment of area",
        "   15 │ let second_moment = |width, height| todo(\"the second",
        "      │                                     ^^^^",
        "help: replace all of todo(…)",
    ] {
        assert!(all.contains(part), "{part}:\n{all}");
    }
}

#[test]
fn result_is_visible_after_a_run_and_the_page_scrolls() {
    let found = AttemptOutcome::WrongResult(vec!["the strip is too soft".into()]);
    let many: Vec<String> = (0..40).map(|number| format!("number {number}")).collect();
    let many: Vec<&str> = many.iter().map(String::as_str).collect();
    let mut state = judged(4, found, &many);
    assert!(text(&state, (80, 24)).contains("lines below"));
    state.top = ScrollPosition::Part(TaskSection::Result);
    let all = text(&state, (80, 24));
    for part in ["lines above", "Not yet (run 1): it runs", "- the strip is too soft"] {
        assert!(all.contains(part), "{part}:\n{all}");
    }
    assert!(
        all.contains("… and 28 more lines: withy run withy-exercises/beams/stocky.rhai"),
        "{all}"
    );
    assert!(all.contains("↑↓ scroll"), "{all}");
    let window = screen(&state, (80, 24), &[]).window;
    let mut seen = String::new();
    for top in 0..=window.last {
        state.top = ScrollPosition::Line(top);
        seen += &text(&state, (80, 24));
    }
    let whole = lines(&state, (80, 200));
    let page = whole.iter().skip(4).take_while(|line| !line.starts_with('─'));
    assert!(page.clone().count() > 20);
    for line in page {
        assert!(seen.contains(line.trim_end()), "{line}:\n{seen}");
    }
}

#[test]
fn hints_are_shown_on_request() {
    let mut state =
        judged(1, AttemptOutcome::WrongResult(vec!["too soft".into()]), &["one", "two"]);
    let hints = state.exercise.judge().hints;
    assert!(!text(&state, (80, 24)).contains("Hint"));
    state.hints = 2;
    state.top = ScrollPosition::Part(TaskSection::Hint);
    for size in [(80, 24), (40, 24)] {
        let all = words(&text(&state, size));
        assert!(all.contains(&format!("Hint 2 of {}: {}", hints.len(), words(&hints[1]))), "{all}");
    }
}

#[test]
fn passed_exercise_shows_progress_and_the_next_exercise() {
    let all = text(&judged(1, AttemptOutcome::Passed, &[]), (80, 24));
    for part in [
        "Passed.",
        "1 of 28 passed",
        "n continues with beams/rectangle",
        "s shows a solution",
        "s solution",
    ] {
        assert!(all.contains(part), "{part}:\n{all}");
    }
    assert!(!text(&at(1), (80, 24)).contains("s solution"));
    let mut state = judged(1, AttemptOutcome::Passed, &[]);
    for exercise in EXERCISES {
        state.progress.record(exercise, true);
    }
    let all = text(&state, (80, 24));
    assert!(all.contains("All 28 exercises are passed. Congratulations!"), "{all}");
    assert!(all.contains(&format!("[{}] 28 of 28 passed", "#".repeat(BAR))), "{all}");
}

#[test]
fn running_time_replaces_the_result_only_in_long_runs() {
    let mut state = judged(1, AttemptOutcome::WrongResult(vec!["too soft".into()]), &[]);
    let before = text(&state, (80, 24));
    state.running = Some(0);
    assert_eq!(text(&state, (80, 24)), before);
    state.running = Some(3);
    let all = text(&state, (80, 24));
    assert!(all.contains("Running, 3 s.") && !all.contains("too soft"), "{all}");
    assert!(text(&TuiState { running: Some(0), ..at(1) }, (80, 24)).contains("Running, 0 s."));
}

#[test]
fn exercise_list_shows_marks_and_the_selection() {
    let mut state = judged(1, AttemptOutcome::Passed, &[]);
    for chosen in [0, 10, 20] {
        state.page = ScreenPage::List(chosen);
        let shown = lines(&state, (80, 24));
        let line = shown.iter().find(|line| line.starts_with("> ")).expect("a choice");
        assert!(line.contains(EXERCISES[chosen].name), "{line}");
    }
    state.page = ScreenPage::List(0);
    let all = text(&state, (120, 40));
    assert!(all.contains("> passed  1  change_one_number"), "{all}");
    assert!(TRACKS.iter().all(|track| all.contains(track.title)), "{all}");
}

#[test]
fn screen_without_colours_has_the_same_text() {
    let state = judged(2, broken(), &["EI = 4.2"]);
    for line in screen(&state, (80, 24), &[]).lines {
        assert_eq!(line.drawn(Colours::None), line.text());
        assert!(!line.text().contains('\u{1b}'));
    }
}
