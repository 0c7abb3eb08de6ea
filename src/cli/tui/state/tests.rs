use super::*;
use crate::exercises::captured_output::CapturedOutput;

const WINDOW: ScrollWindow = ScrollWindow { top: 2, last: 5, rows: 10 };

fn at(number: usize) -> TuiState {
    TuiState::open(&EXERCISES[number - 1], "mine.rhai".into(), StudentProgress::default())
}

fn press(state: &mut TuiState, keys: &str) -> KeyAction {
    keys.chars().fold(KeyAction::Nothing, |_, letter| state.press(Key::Letter(letter), WINDOW))
}

fn pass(state: &mut TuiState) {
    state.set_report(AttemptReport {
        outcome: AttemptOutcome::Passed,
        printed: CapturedOutput::default(),
    });
}

#[test]
fn next_key_needs_confirmation_if_the_exercise_is_not_passed() {
    let mut state = at(1);
    assert_eq!(press(&mut state, "n"), KeyAction::Nothing);
    assert!(state.notice.as_ref().unwrap().contains("n again skips"));
    assert_eq!(press(&mut state, "n"), KeyAction::Open(&EXERCISES[1]));
    let mut state = at(1);
    assert_eq!(press(&mut state, "njn"), KeyAction::Nothing, "not one after the other");
    pass(&mut state);
    assert_eq!(press(&mut state, "n"), KeyAction::Open(&EXERCISES[1]));
    assert_eq!(press(&mut at(1), "p"), KeyAction::Nothing);
    assert_eq!(press(&mut at(3), "p"), KeyAction::Open(&EXERCISES[1]));
}

#[test]
fn next_exercise_wraps_around_until_all_are_passed() {
    let mut state = at(EXERCISES.len());
    pass(&mut state);
    assert_eq!(state.next(), Some(&EXERCISES[0]));
    for exercise in EXERCISES {
        state.progress.record(exercise, true);
    }
    assert_eq!((state.next(), press(&mut state, "n")), (None, KeyAction::Nothing));
    assert!(state.notice.unwrap().contains("all exercises are passed"));
}

#[test]
fn solution_is_available_after_passing_or_all_hints() {
    let mut state = at(1);
    press(&mut state, "s");
    assert_eq!(state.page, ScreenPage::Task);
    assert!(state.notice.as_ref().unwrap().contains("after the exercise is passed"));
    assert_eq!(press(&mut state, "h"), KeyAction::Hint);
    state.hints = state.exercise.judge().hints.len();
    press(&mut state, "h");
    assert_eq!((state.page, state.confirmation), (ScreenPage::Task, Some(Confirmation::Solution)));
    press(&mut state, "h");
    assert_eq!(state.page, ScreenPage::Solution);
    let mut state = at(1);
    pass(&mut state);
    press(&mut state, "s");
    assert_eq!(state.page, ScreenPage::Solution);
    state.press(Key::Escape, WINDOW);
    assert_eq!(state.page, ScreenPage::Task);
}

#[test]
fn arrow_and_digit_keys_select_in_the_exercise_list() {
    let mut state = at(2);
    press(&mut state, "l");
    assert_eq!(state.page, ScreenPage::List(1));
    press(&mut state, "1");
    assert_eq!(state.page, ScreenPage::List(0), "the place is no digit");
    state.press(Key::Down, WINDOW);
    assert_eq!(state.page, ScreenPage::List(1));
    press(&mut state, "12");
    assert_eq!(state.page, ScreenPage::List(11));
    press(&mut state, "9");
    assert_eq!(state.page, ScreenPage::List(8), "there is no 129");
    assert_eq!(state.press(Key::Enter, WINDOW), KeyAction::Open(&EXERCISES[8]));
    press(&mut state, "x");
    assert!(state.notice.as_ref().unwrap().contains("Enter opens it"));
    press(&mut state, "l");
    assert_eq!(state.page, ScreenPage::Task);
}

#[test]
fn keys_scroll_within_the_page_and_unknown_keys_are_reported() {
    let mut state = at(1);
    for (key, top) in
        [(Key::Down, 3), (Key::Up, 1), (Key::PageDown, 5), (Key::PageUp, 0), (Key::End, 5)]
    {
        state.press(key, WINDOW);
        assert_eq!(state.top, ScrollPosition::Line(top), "{key:?}");
    }
    press(&mut state, "w");
    assert!(state.notice.as_ref().unwrap().contains("the key w has no function here"));
    press(&mut state, "j");
    assert_eq!(state.notice, None);
}

#[test]
fn q_and_interrupt_keys_quit_on_every_page() {
    for page in [ScreenPage::Task, ScreenPage::List(0), ScreenPage::Solution] {
        for key in [Key::Letter('q'), Key::Interrupt] {
            let mut state = TuiState { page, ..at(1) };
            assert_eq!(state.press(key, WINDOW), KeyAction::Leave);
        }
    }
}
