//! Commands that are accepted without their colon: help, quitting, and steps with a number.

use super::{Command, HELP, QUIT, find};

/// Command and operand of an input without a colon, such as `quit`, `exit()`, `help sine` or `sim?`; `None` for other inputs.
/// The words `quit`, `exit`, `bye` and `help` are not commands if `is_variable` returns true for them.
pub fn meant(text: &str, is_variable: impl Fn(&str) -> bool) -> Option<(&'static Command, &str)> {
    let text = text.trim_end_matches(';').trim_end();
    let asked = text.trim_end_matches('?').trim_end();
    if asked.len() < text.len() && is_name(asked.strip_suffix("()").unwrap_or(asked)) {
        return Some((&HELP, asked));
    }
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    let bare = word.strip_suffix("()").unwrap_or(word);
    if is_variable(bare) {
        return None;
    }
    match (bare, rest.trim()) {
        ("quit" | "exit" | "bye", "") => Some((&QUIT, "")),
        ("run" | "step" | "back", number) if number.parse::<f64>().is_ok() => {
            find(&format!(":{bare}")).ok().map(|command| (command, number))
        }
        ("help", name) if word == "help" && (name.is_empty() || is_name(name)) => {
            Some((&HELP, name))
        }
        _ => None,
    }
}

fn is_name(text: &str) -> bool {
    let begins = text.starts_with(|letter: char| letter.is_alphabetic() || letter == '_');
    begins && text.chars().all(|letter| letter.is_alphanumeric() || "_.:/".contains(letter))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_without_a_colon_are_recognised() {
        let name = |text| meant(text, |name| name == "exit").map(|(of, rest)| (of.name, rest));
        assert_eq!(name("quit"), Some((":quit", "")));
        assert_eq!(name("quit();"), Some((":quit", "")));
        assert_eq!(name("help"), Some((":help", "")));
        assert_eq!(name("help sine"), Some((":help", "sine")));
        assert_eq!(name("sim.run_to?"), Some((":help", "sim.run_to")));
        assert_eq!(name("sim??"), Some((":help", "sim")));
        assert_eq!(name("half()?"), Some((":help", "half()")));
        assert_eq!(name("step 3"), Some((":step", "3")));
        assert_eq!(name("run 7.5;"), Some((":run", "7.5")));
        for own in [
            "step",
            "run fast",
            "step = 3",
            "exit",
            "help(\"sine\")",
            "1 ?? 2",
            "quit + 1",
            "a ? 1 : 2",
            "help = 3",
        ] {
            assert_eq!(name(own), None, "{own}");
        }
    }
}
