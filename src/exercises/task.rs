//! Task of an exercise: the comment at the beginning of the start file, as paragraphs.

use super::exercise::Exercise;

/// First words of the paragraph with the instructions for the student.
pub const TO_DO: &str = "To do:";

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Paragraph {
    Words(String),
    Set(Vec<String>),
}

impl Exercise {
    /// Returns the paragraphs below the title. The last paragraph contains the instructions for the student.
    pub fn task(&self) -> Vec<Paragraph> {
        let below_title = self.start.lines().skip(1);
        let mut paragraphs = Vec::new();
        let mut is_new = true;
        for line in below_title.map_while(|line| line.strip_prefix("//")) {
            let line = line.strip_prefix(' ').unwrap_or(line).trim_end();
            if line.is_empty() {
                is_new = true;
                continue;
            }
            let is_set = line.starts_with(' ');
            match paragraphs.last_mut() {
                Some(Paragraph::Words(words)) if !is_new && !is_set => {
                    *words += &format!(" {line}")
                }
                Some(Paragraph::Set(lines)) if !is_new && is_set => lines.push(line.to_owned()),
                _ if is_set => paragraphs.push(Paragraph::Set(vec![line.to_owned()])),
                _ => paragraphs.push(Paragraph::Words(line.to_owned())),
            }
            is_new = false;
        }
        paragraphs
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercises::catalogue::{EXERCISES, find};

    #[test]
    fn every_task_text_ends_with_its_to_do_paragraph() {
        for exercise in EXERCISES {
            let task = exercise.task();
            let Some(Paragraph::Words(last)) = task.last() else {
                panic!("{}: {task:?}", exercise.id())
            };
            assert!(last.starts_with(TO_DO) && task.len() > 1, "{}: {last}", exercise.id());
        }
    }

    #[test]
    fn task_formulas_keep_their_lines_and_text_becomes_paragraphs() {
        let task = find("stocky").unwrap().task();
        let Paragraph::Words(first) = &task[0] else { panic!("{task:?}") };
        assert!(first.ends_with("the end moves by"), "{first}");
        assert_eq!(
            task[1],
            Paragraph::Set(vec!["    P L³ / (3 EI)  by bending,  and  P L / GA  by shear.".into()])
        );
    }
}
