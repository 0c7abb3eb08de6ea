//! Converts a model solution to coloured lines, and marks the lines that differ from the start file.

use std::collections::HashSet;

use super::line::{GOOD, ScreenLine, coloured};
use crate::exercises::exercise::Exercise;
use crate::repl::editor::highlight::{SessionNames, highlight};
use crate::repl::editor::surroundings::CompletionContext;
use crate::script::packages::language;

pub struct ScriptPainter(SessionNames);

impl ScriptPainter {
    pub fn new() -> Self {
        Self(SessionNames::of(CompletionContext::of_language(language())))
    }

    pub fn paint(&self, text: &str) -> String {
        highlight(text, None, &self.0)
    }

    pub fn solution(&self, exercise: &Exercise) -> Vec<ScreenLine> {
        let is_head = |line: &&str| line.starts_with("//") || line.is_empty();
        let code: Vec<&str> = exercise.solution.lines().skip_while(is_head).collect();
        let known: HashSet<&str> = exercise.start.lines().collect();
        let painted = coloured(&self.paint(&code.join("\n")));
        let mark = |(line, code): (&ScreenLine, &str)| {
            ScreenLine::of(if known.contains(code) { "  " } else { "» " }, GOOD).before(line)
        };
        painted.iter().zip(code).map(mark).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercises::catalogue::EXERCISES;

    #[test]
    fn solutions_are_shown_completely_with_changed_lines_marked() {
        let painter = ScriptPainter::new();
        for exercise in EXERCISES {
            let lines = painter.solution(exercise);
            assert!(lines.iter().any(|line| line.text().starts_with("» ")), "{}", exercise.id());
            let is_known = |line: &ScreenLine| line.text().starts_with("  ") && line.width() > 2;
            assert!(lines.iter().any(is_known), "{}", exercise.id());
            for line in lines {
                let read = line.text().chars().skip(2).collect::<String>();
                assert!(exercise.solution.lines().any(|line| line == read), "{read}");
            }
        }
    }
}
