//! Syntax highlighting at the prompt: commands, help requests, and the language.

use super::commands::command_named;
use super::completeness::is_command;
use super::surroundings::{CommandOperand, CompletionContext};
use crate::script::presentation::highlight::{self, HighlightStyle, UNMATCHED, draw};

const COMMAND: HighlightStyle = HighlightStyle("1");

/// Names of a session with their colours, collected once per prompt.
pub struct SessionNames {
    language: highlight::Vocabulary,
    context: CompletionContext,
}

impl SessionNames {
    /// Collects the names of a session.
    pub fn of(context: CompletionContext) -> Self {
        let mut language = highlight::Vocabulary::of_language(&context.catalog);
        for function in &context.functions {
            language.add_function(&function.name);
        }
        for variable in &context.variables {
            language.add_variable(&variable.name, &variable.of);
        }
        for module in &context.modules {
            let functions = module.functions.iter().map(|function| function.name.as_str());
            language.add_module(&module.alias, functions);
        }
        Self { language, context }
    }

    /// Session data from which the names were collected.
    pub fn surroundings(&self) -> &CompletionContext {
        &self.context
    }
}

/// Text with colours. A bracket at the cursor and its matching bracket are emphasised.
pub fn highlight(text: &str, cursor: Option<usize>, vocabulary: &SessionNames) -> String {
    match is_command(text) && !text.contains('\x1b') {
        true => highlight_command(text, cursor, vocabulary),
        false => highlight::highlight(text, cursor, &vocabulary.language),
    }
}

fn highlight_command(text: &str, cursor: Option<usize>, vocabulary: &SessionNames) -> String {
    let begin = text.len() - text.trim_start().len();
    let is_question = text[begin..].starts_with('?');
    let length = match is_question {
        true => 1,
        false => text[begin..].find(char::is_whitespace).unwrap_or(text.len() - begin),
    };
    let (word, operand) = text.split_at(begin + length);
    let surroundings = vocabulary.surroundings();
    let command = command_named(word.trim_start(), surroundings);
    let mut commands = surroundings.commands.iter();
    let may_become =
        operand.is_empty() && commands.any(|command| command.name.starts_with(word.trim_start()));
    let style = match command.is_some() || is_question {
        true => Some(COMMAND),
        false if may_become => None,
        false => Some(UNMATCHED),
    };
    let mut drawn = String::new();
    draw(&mut drawn, word, style);
    let has_colours = |operand| {
        matches!(
            operand,
            CommandOperand::Expression
                | CommandOperand::Curves
                | CommandOperand::Name
                | CommandOperand::OptionsOf(_)
        )
    };
    if is_question || command.is_some_and(|command| has_colours(command.operand)) {
        let cursor = cursor.and_then(|cursor| cursor.checked_sub(word.len()));
        drawn.push_str(&highlight::highlight(operand, cursor, &vocabulary.language));
    } else {
        drawn.push_str(operand);
    }
    drawn
}

#[cfg(test)]
mod tests {
    use super::super::samples::surroundings;
    use super::*;
    use crate::script::presentation::highlight::{
        COMMENT, CONSTANT, FUNCTION, KEYWORD, NUMBER, TEXT, UNKNOWN_MEMBER,
    };
    use proptest::prelude::*;

    fn vocabulary() -> SessionNames {
        SessionNames::of(surroundings())
    }

    fn pieces(text: &str, cursor: Option<usize>) -> Vec<(String, String)> {
        let drawn = highlight(text, cursor, &vocabulary());
        let coloured = drawn.split("\x1b[").filter_map(|piece| piece.split_once('m'));
        let coloured = coloured.filter(|(numbers, _)| *numbers != "0");
        coloured.map(|(numbers, piece)| (piece.to_owned(), numbers.to_owned())).collect()
    }

    fn style_of(text: &str, piece: &str) -> Option<String> {
        pieces(text, None).into_iter().find(|(drawn, _)| drawn == piece).map(|(_, numbers)| numbers)
    }

    fn without_colours(drawn: &str) -> String {
        let mut pieces = drawn.split("\x1b[");
        let first = pieces.next().unwrap_or_default().to_owned();
        pieces.fold(first, |text, piece| text + piece.split_once('m').map_or("", |(_, rest)| rest))
    }

    #[test]
    fn tokens_are_coloured_by_kind() {
        let text = "let a = line(1.5, PI) + \"b\" // c";
        for (piece, style) in [
            ("let", KEYWORD),
            ("line", FUNCTION),
            ("1.5", NUMBER),
            ("PI", CONSTANT),
            ("\"b\"", TEXT),
            ("// c", COMMENT),
        ] {
            assert_eq!(style_of(text, piece).as_deref(), Some(style.0), "{piece}");
        }
        assert_eq!(style_of(text, "a"), None);
        assert_eq!(style_of("`x ${1} y`", "1").as_deref(), Some(NUMBER.0));
        assert_eq!(style_of("`x ${1} y`", " y`").as_deref(), Some(TEXT.0));
        assert_eq!(style_of("f(1))", ")").as_deref(), Some(UNMATCHED.0));
    }

    #[test]
    fn bracket_at_the_cursor_and_its_partner_are_highlighted() {
        let marked = |cursor| pieces("f((a))", Some(cursor)).len();
        assert_eq!(marked(1), 2);
        assert_eq!(marked(6), 2);
        assert_eq!(marked(0), 0);
        assert_eq!(pieces("f(\")\"", Some(1)).len(), 1, "a bracket in a text is no partner");
    }

    #[test]
    fn unknown_members_of_a_variable_are_underlined() {
        assert_eq!(style_of("rod.lenght * 2", "lenght").as_deref(), Some(UNKNOWN_MEMBER.0));
        assert_eq!(style_of("rod.length * 2", "length"), None);
        assert_eq!(style_of("rod.leng", "leng"), None, "it is still being typed");
        assert_eq!(style_of("|rod| rod.x + 1", "x"), None, "another rod");
        assert_eq!(style_of("settings.any + 1", "any"), None);
    }

    #[test]
    fn commands_and_their_expressions_are_coloured() {
        assert_eq!(style_of(":step 10", ":step").as_deref(), Some(COMMAND.0));
        assert_eq!(style_of(":time sqrt(2)", "sqrt").as_deref(), Some(FUNCTION.0));
        assert_eq!(style_of(":plot sqrt(sim.t)", "sqrt").as_deref(), Some(FUNCTION.0));
        assert_eq!(style_of("?sqrt", "sqrt").as_deref(), Some(FUNCTION.0));
        assert_eq!(style_of("sqrt?", "sqrt").as_deref(), Some(FUNCTION.0));
    }

    #[test]
    fn unknown_commands_are_red_after_their_name_is_complete() {
        for unknown in [":nonsense 10", ":nonsense", ":s 10"] {
            let word = unknown.split(' ').next().unwrap_or_default();
            assert_eq!(style_of(unknown, word).as_deref(), Some(UNMATCHED.0), "{unknown}");
        }
        assert_eq!(pieces(":s", None), [], "it may become :step or :save");
        assert_eq!(style_of(":ste", ":ste").as_deref(), Some(COMMAND.0), "it will do");
    }

    #[test]
    fn long_input_is_highlighted_without_loss() {
        let vocabulary = vocabulary();
        let line = "let a = scene.beam(#{ axis: line([0, 0], [1.5, 2]) }); // `x`\n";
        for part in [line, "(", "#", "`${a}", "rod.x.", "\"'"] {
            let text = part.repeat(10_000 / part.len() + 1);
            let drawn = highlight(&text, Some(text.len()), &vocabulary);
            assert!(without_colours(&drawn) == text, "{part}");
        }
    }

    proptest! {
        #[test]
        fn highlighting_any_input_keeps_its_text(
            text in "([ -~äξ\n]|rod\\.|let |\\(|\\)|#\\{|\\}|\"|`|\\$\\{|:time |/\\*|//){0,40}", cursor in 0..60_usize
        ) {
            let drawn = highlight(&text, Some(cursor), &vocabulary());
            prop_assert_eq!(without_colours(&drawn), text);
        }
    }
}
