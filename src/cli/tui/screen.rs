//! Converts the state to the lines of the screen, without side effects.

use super::line::{
    FAINT, GOOD, HEADING, LineStyle, PLAIN, STRONG, ScreenLine, WARNING, labelled, paragraph,
    wrapped,
};
use super::result_page::outcome;
use super::state::{ScreenPage, ScrollPosition, ScrollWindow, TaskSection, TuiState};
use crate::exercises::catalogue::{EXERCISES, TRACKS};
use crate::exercises::task::{Paragraph, TO_DO};

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Screen {
    pub lines: Vec<ScreenLine>,
    pub window: ScrollWindow,
}

struct PageLayout {
    lines: Vec<ScreenLine>,
    result: usize,
    hint: usize,
    chosen: Option<usize>,
}

impl PageLayout {
    fn of(lines: Vec<ScreenLine>) -> Self {
        Self { lines, result: 0, hint: 0, chosen: None }
    }
}

/// Maximum width of text [columns], because wider text is harder to read.
const WIDEST: usize = 100;

pub fn screen(
    state: &TuiState,
    (columns, rows): (usize, usize),
    solution: &[ScreenLine],
) -> Screen {
    // The last column stays empty, because some terminals wrap a line that reaches it.
    let columns = columns.saturating_sub(1).max(10);
    let mut head = head(state, columns);
    let mut body = body(state, columns, solution);
    let draw = |window: ScrollWindow| foot(state, window, columns);
    let is_long = |foot: &[ScreenLine], head: &[ScreenLine]| {
        head.len() + body.lines.len() + foot.len() > rows
    };
    let mut foot = draw(ScrollWindow::default());
    if is_long(&foot, &head) {
        foot = draw(ScrollWindow { last: 1, ..ScrollWindow::default() });
    }
    while rows < head.len() + foot.len() + 3 && head.len() > 1 {
        head.pop();
    }
    while rows < head.len() + foot.len() + 1 && !foot.is_empty() {
        foot.remove(0);
    }
    let room = rows.saturating_sub(head.len() + foot.len());
    let last = body.lines.len().saturating_sub(room);
    let top = match (state.top, body.chosen) {
        (_, Some(chosen)) => chosen.saturating_sub(room / 2),
        (ScrollPosition::Line(line), _) => line,
        (ScrollPosition::Part(TaskSection::Beginning), _) => 0,
        (ScrollPosition::Part(TaskSection::Result), _) => body.result.saturating_sub(1),
        (ScrollPosition::Part(TaskSection::Hint), _) => body.hint.saturating_sub(1),
    };
    let window = ScrollWindow { top: top.min(last), last, rows: room };
    let mut lines = head;
    lines.extend(visible_lines(&mut body.lines, window));
    if foot.len() + lines.len() < rows {
        lines.resize(rows - foot.len(), ScreenLine::default());
    }
    lines.extend(foot);
    lines.truncate(rows);
    Screen { lines: lines.into_iter().map(|line| line.cut(columns)).collect(), window }
}

fn visible_lines(lines: &mut Vec<ScreenLine>, window: ScrollWindow) -> Vec<ScreenLine> {
    let ScrollWindow { top, last, rows } = window;
    let mut shown: Vec<ScreenLine> = lines.drain(..).skip(top).take(rows).collect();
    let above = if top > 0 { top + 1 } else { 0 };
    let below = if top < last { last - top + 1 } else { 0 };
    if rows >= 3
        && above > 0
        && let Some(first) = shown.first_mut()
    {
        *first = ScreenLine::of(&format!("↑ {above} lines above"), FAINT);
    }
    if rows >= 3
        && below > 0
        && let Some(last) = shown.last_mut()
    {
        *last = ScreenLine::of(&format!("↓ {below} lines below"), WARNING);
    }
    shown
}

fn rule(columns: usize) -> ScreenLine {
    ScreenLine::of(&"─".repeat(columns), FAINT)
}

fn head(state: &TuiState, columns: usize) -> Vec<ScreenLine> {
    let count = EXERCISES.len();
    let title = match state.page {
        ScreenPage::Task => {
            format!("Exercise {} of {count}: {}", state.number(), state.exercise.title())
        }
        ScreenPage::List(_) => format!("All {count} exercises"),
        ScreenPage::Solution => {
            format!(
                "A solution of exercise {} of {count}: {}",
                state.number(),
                state.exercise.title()
            )
        }
    };
    let mut lines = paragraph(&title, "  ", columns, &STRONG);
    lines.push(progress(state, columns));
    match state.page {
        ScreenPage::Task => {
            let tail = " and save it: it is then judged here";
            let whole = format!("Edit {}{tail}", state.file);
            let whole = if crate::output::columns(&whole) <= columns {
                whole
            } else {
                format!("Edit {}", state.file)
            };
            lines.extend(labelled(
                ("Edit", HEADING),
                whole.trim_start_matches("Edit "),
                "",
                columns,
            ));
        }
        ScreenPage::List(_) => {}
        ScreenPage::Solution => {
            let word = "Other correct solutions pass as well. » marks the differences from the initial file.";
            lines.extend(paragraph(word, "", columns, &PLAIN));
        }
    }
    lines.push(rule(columns));
    lines
}

const BAR: usize = 32;

fn progress(state: &TuiState, columns: usize) -> ScreenLine {
    let (passed, count) = (state.passed(), EXERCISES.len());
    let word = format!(" {passed} of {count} passed");
    let room = columns.saturating_sub(word.len() + 2).clamp(4, BAR);
    // The division rounds down, so that the bar is full only if all exercises are passed.
    let full = room * passed / count;
    let bar = ScreenLine::of("[", PLAIN)
        .and(&"#".repeat(full), GOOD)
        .and(&"-".repeat(room - full), FAINT);
    bar.and("]", PLAIN).and(&word, STRONG)
}

fn body(state: &TuiState, columns: usize, solution: &[ScreenLine]) -> PageLayout {
    match state.page {
        ScreenPage::Task => task(state, columns.min(WIDEST)),
        ScreenPage::List(chosen) => list(state, chosen, columns),
        ScreenPage::Solution => {
            PageLayout::of(solution.iter().flat_map(|line| line.clone().wrapped(columns)).collect())
        }
    }
}

fn task(state: &TuiState, columns: usize) -> PageLayout {
    let mut lines = Vec::new();
    for paragraph in state.exercise.task() {
        if !lines.is_empty() {
            lines.push(ScreenLine::default());
        }
        lines.extend(set(&paragraph, columns));
    }
    lines.push(ScreenLine::default());
    let result = lines.len();
    lines.extend(outcome(state, columns));
    let hints = state.exercise.judge().hints;
    let mut hint = result;
    for (index, text) in hints.iter().take(state.hints).enumerate() {
        if index == 0 {
            lines.push(ScreenLine::default());
        }
        hint = lines.len();
        let label = format!("Hint {} of {}:", index + 1, hints.len());
        lines.extend(labelled((&label, HEADING), text, "  ", columns));
    }
    PageLayout { result, hint, ..PageLayout::of(lines) }
}

fn set(paragraph: &Paragraph, columns: usize) -> Vec<ScreenLine> {
    match paragraph {
        Paragraph::Words(words) => match words.strip_prefix(TO_DO) {
            Some(rest) => labelled((TO_DO, HEADING), rest.trim_start(), "", columns),
            None => super::line::paragraph(words, "", columns, &PLAIN),
        },
        Paragraph::Set(lines) => {
            let wrap = |line: &String| {
                let indent = line.len() - line.trim_start().len() + 2;
                wrapped(line, &" ".repeat(indent), columns)
            };
            lines.iter().flat_map(wrap).map(|line| ScreenLine::of(&line, PLAIN)).collect()
        }
    }
}

fn list(state: &TuiState, chosen: usize, columns: usize) -> PageLayout {
    let longest = EXERCISES.iter().map(|exercise| exercise.name.len()).max().unwrap_or(0);
    let mut lines = Vec::new();
    let mut at = None;
    let numbered = |track: &'static str| {
        EXERCISES.iter().enumerate().filter(move |(_, exercise)| exercise.track == track)
    };
    for track in TRACKS {
        lines.push(ScreenLine::of(track.title, STRONG));
        for (index, exercise) in numbered(track.name) {
            let (mark, style): (_, LineStyle) = match state.progress.has_passed(exercise) {
                true => ("passed", GOOD),
                false => ("", PLAIN),
            };
            let is_chosen = index == chosen;
            if is_chosen {
                at = Some(lines.len());
            }
            let name = format!(" {:>2}  {:<longest$}", index + 1, exercise.name);
            let (arrow, look) = if is_chosen { ("> ", "1;7".into()) } else { ("  ", PLAIN) };
            let line =
                ScreenLine::of(arrow, HEADING).and(&format!("{mark:<6}"), style).and(&name, look);
            lines.push(line.and("  ", PLAIN).and(exercise.title(), FAINT).cut(columns));
        }
    }
    PageLayout { chosen: at, ..PageLayout::of(lines) }
}

fn foot(state: &TuiState, window: ScrollWindow, columns: usize) -> Vec<ScreenLine> {
    let mut keys = match state.page {
        ScreenPage::Task => {
            vec![("h", "hint"), ("l", "list"), ("r", "run again"), ("n", "next"), ("p", "previous")]
        }
        ScreenPage::List(_) => vec![("↑↓ 1-9", "choose"), ("Enter", "open"), ("l", "back")],
        ScreenPage::Solution => vec![("s", "back"), ("n", "next"), ("l", "list")],
    };
    if state.page == ScreenPage::Task && state.has_passed() {
        keys.insert(0, ("s", "solution"));
        keys.rotate_left(1);
    }
    if window.last > 0 && !matches!(state.page, ScreenPage::List(_)) {
        keys.push(("↑↓", "scroll"));
    }
    keys.push(("q", "quit"));
    let mut lines = vec![rule(columns)];
    if let Some(notice) = &state.notice {
        lines.extend(paragraph(notice, "", columns, &WARNING));
    }
    let mut line = ScreenLine::default();
    for (key, does) in keys {
        let between = if line.width() > 0 { "   " } else { "" };
        let wide = line.width() + between.len() + crate::output::columns(key) + 1 + does.len();
        if wide > columns && line.width() > 0 {
            lines.push(std::mem::take(&mut line).and("", PLAIN));
            line = ScreenLine::of(key, HEADING).and(&format!(" {does}"), PLAIN);
        } else {
            line = line.and(between, PLAIN).and(key, HEADING).and(&format!(" {does}"), PLAIN);
        }
    }
    lines.push(line);
    lines
}

#[cfg(test)]
mod tests;
