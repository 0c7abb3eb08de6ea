//! Converts the result of an attempt to lines of the screen.

use super::line::{BAD, FAINT, GOOD, HEADING, PLAIN, ScreenLine, WARNING, labelled, paragraph};
use super::state::TuiState;
use crate::exercises::captured_output::CapturedOutput;
use crate::exercises::catalogue::EXERCISES;
use crate::exercises::report::{AttemptError, AttemptOutcome, AttemptReport, ScriptPosition};
use crate::output::columns_of;

const PRINTED: usize = 12;
const SHORTEST_SHOWN: u64 = 1;

pub fn outcome(state: &TuiState, columns: usize) -> Vec<ScreenLine> {
    match (state.running, &state.last) {
        (Some(seconds), last) if seconds >= SHORTEST_SHOWN || last.is_none() => {
            let word = format!("Running, {seconds} s.");
            labelled((&word, WARNING), "Saving the file restarts it; q exits at once.", "", columns)
        }
        (_, Some(report)) => judged(state, report, columns),
        (_, None) => Vec::new(),
    }
}

fn judged(state: &TuiState, report: &AttemptReport, columns: usize) -> Vec<ScreenLine> {
    let not_yet = |what: &str| {
        let message = format!("(run {}): {what}", state.runs);
        labelled(("Not yet", BAD), &message, "  ", columns)
    };
    let mut lines;
    match &report.outcome {
        AttemptOutcome::Passed => {
            lines =
                vec![ScreenLine::of("Passed.", GOOD).and(&format!(" (run {})", state.runs), FAINT)];
            lines.extend(paragraph(&next_actions(state), "", columns, &PLAIN));
        }
        AttemptOutcome::WrongResult(found) => {
            lines = not_yet("it runs, but the result is wrong.");
            let finding = |found| paragraph(&format!("- {found}"), "  ", columns, &PLAIN);
            lines.extend(found.iter().flat_map(finding));
        }
        AttemptOutcome::Error(why) => {
            lines = not_yet("it stops with an error.");
            lines.extend(error_lines(state, why, columns));
        }
        AttemptOutcome::Stopped(why) => {
            lines = not_yet("it was stopped.");
            lines.extend(error_lines(state, why, columns));
        }
        AttemptOutcome::Interrupted => lines = not_yet("it was interrupted and not judged."),
    }
    lines.extend(printed(state, &report.printed, columns));
    lines
}

fn next_actions(state: &TuiState) -> String {
    let on = match state.next() {
        Some(next) => format!("n continues with {}: {}", next.id(), next.title()),
        None => format!("All {} exercises are passed. Congratulations!", EXERCISES.len()),
    };
    format!("s shows a solution to compare with yours.\n{on}")
}

fn error_lines(state: &TuiState, why: &AttemptError, columns: usize) -> Vec<ScreenLine> {
    let label = match &why.place {
        Some(place) if place.file.replace('\\', "/").ends_with(&state.exercise.file()) => {
            format!("line {}:", place.line)
        }
        Some(place) => format!("{}, line {}:", place.file, place.line),
        None => "error:".into(),
    };
    let mut lines = labelled((&label, BAD), &why.message, "  ", columns);
    lines.extend(why.place.iter().flat_map(|place| excerpt(place, columns)));
    lines.extend(
        why.calls.iter().flat_map(|call| paragraph(&format!("  {call}"), "  ", columns, &FAINT)),
    );
    let help = why.help.iter().flat_map(|help| labelled(("help:", HEADING), help, "  ", columns));
    lines.extend(help);
    lines
}

const TAB: usize = 4;

fn excerpt(place: &ScriptPosition, columns: usize) -> Vec<ScreenLine> {
    let mut text = String::new();
    let (mut at, mut length) = (0, 0);
    for (index, character) in place.text.chars().enumerate() {
        let width = if character == '\t' { TAB } else { columns_of(character) };
        at += if index < place.at { width } else { 0 };
        let is_inside = (place.at..place.at + place.length).contains(&index);
        length += if is_inside { width } else { 0 };
        text += &if character == '\t' { " ".repeat(TAB) } else { character.to_string() };
    }
    let number = format!("{:>5} │ ", place.line);
    let room = columns.saturating_sub(crate::output::columns(&number) + 1).max(8);
    // The beginning of the source line is omitted if the error would otherwise not be visible.
    let skipped = if at + length.max(1) <= room { 0 } else { at.saturating_sub(room / 3) };
    let (before, seen) =
        if skipped > 0 { ("…", text_from_column(&text, skipped + 1)) } else { ("", text) };
    let line = ScreenLine::of(&number, FAINT).and(before, FAINT).and(&seen, PLAIN).cut(columns);
    let marks = "^".repeat(length.clamp(1, room - (at - skipped).min(room - 1)));
    let mark = format!("{}{marks}", " ".repeat(at - skipped));
    vec![line, ScreenLine::of("      │ ", FAINT).and(&mark, BAD).cut(columns)]
}

fn text_from_column(text: &str, columns: usize) -> String {
    let (mut left_out, mut rest) = (0, text.chars());
    while left_out < columns {
        let Some(letter) = rest.next() else { break };
        left_out += columns_of(letter);
    }
    format!("{}{}", " ".repeat(left_out.saturating_sub(columns)), rest.as_str())
}

fn printed(state: &TuiState, printed: &CapturedOutput, columns: usize) -> Vec<ScreenLine> {
    let CapturedOutput { lines: captured, further_lines: more } = printed;
    if captured.is_empty() {
        return Vec::new();
    }
    let mut lines = vec![ScreenLine::default(), ScreenLine::of("It prints:", FAINT)];
    for line in captured.iter().take(PRINTED) {
        lines.extend(paragraph(&format!("  {line}"), "    ", columns, &PLAIN));
    }
    let more = captured.len().saturating_sub(PRINTED) + more;
    if more > 0 {
        let word = format!("  … and {more} more lines: withy run {}", state.file);
        lines.extend(paragraph(&word, "    ", columns, &FAINT));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str, at: usize, length: usize, columns: usize) -> [String; 2] {
        let place = ScriptPosition { file: "mine".into(), line: 7, text: text.into(), at, length };
        let lines = excerpt(&place, columns);
        assert!(lines.iter().all(|line| line.width() <= columns), "{lines:?}");
        [lines[0].text(), lines[1].text()]
    }

    #[test]
    fn error_marker_is_below_the_error_position() {
        let [line, mark] = shown("let b = todo(\"b\");", 8, 4, 40);
        assert_eq!(
            (line.as_str(), mark.as_str()),
            ("    7 │ let b = todo(\"b\");", "      │         ^^^^")
        );
        let [line, mark] = shown("let a = \"漢字\" + x;", 15, 1, 40);
        let before = |text: &str, what: char| {
            text.split_once(what).map(|(before, _)| crate::output::columns(before))
        };
        assert_eq!(before(&line, 'x'), before(&mark, '^'));
        let [line, mark] = shown("\tx = 1;", 1, 1, 40);
        assert_eq!(line.find('x').unwrap() + 2, mark.find('^').unwrap() + 2);
    }

    #[test]
    fn long_source_lines_are_cut_around_the_error() {
        let text = format!("{}here{}", "-".repeat(100), "+".repeat(100));
        let [line, mark] = shown(&text, 100, 4, 40);
        let place = |text: &str, what: char| text.chars().position(|c| c == what).unwrap();
        assert_eq!(place(&line, 'h'), place(&mark, '^'));
        assert!(line.ends_with('…') && line.contains("here"), "{line}");
        let [_, mark] = shown(&text, 0, 200, 40);
        assert!(mark.ends_with('^') || mark.ends_with('…'), "{mark}");
        shown("", 0, 0, 40);
    }
}
