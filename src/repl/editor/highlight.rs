//! Colours of an input. Only colours: what can be read stays as it was typed.

use std::collections::{HashMap, HashSet};

use super::commands::command_named;
use super::completeness::is_command;
use super::input::pair;
use super::scanner::{Kind, Token, scan};
use super::surroundings::{Operand, Surroundings};
use super::words::{FUNCTIONS, is_keyword};
use crate::script::table::Form;

/// How a piece of an input is drawn, as numbers of an ANSI sequence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Style(&'static str);

const KEYWORD: Style = Style("35");
const NUMBER: Style = Style("36");
const TEXT: Style = Style("32");
const COMMENT: Style = Style("2");
const FUNCTION: Style = Style("34");
const CONSTANT: Style = Style("36");
const COMMAND: Style = Style("1");
const UNKNOWN_MEMBER: Style = Style("4");
const PARTNER: Style = Style("1;4");
const STRAY: Style = Style("31");

/// Members that every value has.
const UNIVERSAL: &[&str] =
    &["to_string", "to_debug", "type_of", "print", "debug", "is_shared", "call"];

/// Names that are drawn in colours of their own; made once for each prompt, as lines are drawn at each key.
pub struct Vocabulary {
    functions: HashSet<String>,
    constants: HashSet<String>,
    /// The type of each variable whose type has members of ours.
    variables: HashMap<String, &'static str>,
    members: HashMap<&'static str, HashSet<&'static str>>,
    surroundings: Surroundings,
}

impl Vocabulary {
    /// The names of a session.
    pub fn of(surroundings: Surroundings) -> Self {
        let catalog = &surroundings.catalog;
        let own = surroundings.functions.iter().map(|function| function.name.clone());
        let built_in = FUNCTIONS.iter().map(|(name, _)| (*name).to_owned());
        let functions =
            catalog.function_names().map(str::to_owned).chain(own).chain(built_in).collect();
        let mut members: HashMap<&str, HashSet<&str>> = HashMap::new();
        for row in catalog.rows() {
            if let Some(receiver) = row.receiver().filter(|_| !matches!(row.form, Form::Operator)) {
                members.entry(receiver.name()).or_default().insert(row.name);
            }
        }
        let typed = surroundings.variables.iter().filter_map(|variable| {
            members.get_key_value(variable.of.as_str()).map(|(of, _)| (variable.name.clone(), *of))
        });
        let variables = typed.collect();
        let constants = catalog.constants().map(str::to_owned).collect();
        Self { functions, constants, variables, members, surroundings }
    }

    /// The session that the names are of.
    pub fn surroundings(&self) -> &Surroundings {
        &self.surroundings
    }

    /// Whether the value called `variable` has no member `name`; not if either is unknown.
    fn lacks(&self, variable: &str, name: &str) -> bool {
        let members = self.variables.get(variable).and_then(|of| self.members.get(of));
        members.is_some_and(|members| !members.contains(name))
            && !self.functions.contains(name)
            && !UNIVERSAL.contains(&name)
    }
}

/// `text` with colours; a bracket at the cursor and its partner stand out.
pub fn highlight(text: &str, cursor: Option<usize>, vocabulary: &Vocabulary) -> String {
    // An escape character in the input could join with ours; nobody types one.
    if text.contains('\x1b') {
        return text.to_owned();
    }
    match is_command(text) {
        true => highlight_command(text, cursor, vocabulary),
        false => highlight_language(text, cursor, vocabulary),
    }
}

fn highlight_command(text: &str, cursor: Option<usize>, vocabulary: &Vocabulary) -> String {
    let begin = text.len() - text.trim_start().len();
    let length = text[begin..].find(char::is_whitespace).unwrap_or(text.len() - begin);
    let (word, operand) = text.split_at(begin + length);
    let command = command_named(word.trim_start(), vocabulary.surroundings());
    let is_known = command.is_some() || word.trim_start().starts_with('?');
    let mut drawn = String::new();
    draw(&mut drawn, word, is_known.then_some(COMMAND));
    if command.is_some_and(|command| command.operand == Operand::Expression) {
        let cursor = cursor.and_then(|cursor| cursor.checked_sub(word.len()));
        drawn.push_str(&highlight_language(operand, cursor, vocabulary));
    } else {
        drawn.push_str(operand);
    }
    drawn
}

fn highlight_language(text: &str, cursor: Option<usize>, vocabulary: &Vocabulary) -> String {
    let tokens = scan(text);
    let (partners, _) = pair(&tokens);
    let touched = cursor.and_then(|cursor| bracket_at(&tokens, cursor));
    let marked = touched.and_then(|at| partners[at].map(|partner| [at, partner]));
    // Parameters of functions hide variables of the session: their members are not judged.
    let has_parameters =
        tokens.iter().any(|token| matches!(token.of(text), "fn" | "|" | "let" | "for"));
    let mut drawn = String::with_capacity(text.len() * 2);
    let mut before = [0; 2];
    for (index, token) in tokens.iter().enumerate() {
        let written = token.of(text);
        let style = match token.kind {
            _ if marked.is_some_and(|marked| marked.contains(&index)) => Some(PARTNER),
            Kind::Comment | Kind::OpenComment => Some(COMMENT),
            Kind::Text | Kind::OpenText | Kind::Piece | Kind::OpenPiece => Some(TEXT),
            Kind::Number => Some(NUMBER),
            Kind::Close(_) if partners[index].is_none() => Some(STRAY),
            Kind::Word => {
                let is_last = index + 1 == tokens.len();
                let [value, dot] = before.map(|at: usize| tokens[at].of(text));
                let is_member = index > 1 && matches!(dot, "." | "?.");
                match is_member {
                    true => (!has_parameters && !is_last && vocabulary.lacks(value, written))
                        .then_some(UNKNOWN_MEMBER),
                    false => word_style(written, vocabulary),
                }
            }
            Kind::Space | Kind::Open(_) | Kind::Close(_) | Kind::Symbol => None,
        };
        draw(&mut drawn, written, style);
        if token.is_significant() {
            before = [before[1], index];
        }
    }
    drawn
}

fn word_style(word: &str, vocabulary: &Vocabulary) -> Option<Style> {
    match word {
        _ if is_keyword(word) => Some(KEYWORD),
        _ if vocabulary.functions.contains(word) => Some(FUNCTION),
        _ if vocabulary.constants.contains(word) => Some(CONSTANT),
        _ => None,
    }
}

/// The bracket under the cursor, or else the one before it.
fn bracket_at(tokens: &[Token], cursor: usize) -> Option<usize> {
    let is_bracket = |token: &Token| matches!(token.kind, Kind::Open(_) | Kind::Close(_));
    let under = tokens.iter().position(|token| token.start == cursor && is_bracket(token));
    under.or_else(|| tokens.iter().position(|token| token.end == cursor && is_bracket(token)))
}

fn draw(drawn: &mut String, text: &str, style: Option<Style>) {
    match style.filter(|_| !text.is_empty()) {
        Some(Style(numbers)) => {
            for part in ["\x1b[", numbers, "m", text, "\x1b[0m"] {
                drawn.push_str(part);
            }
        }
        None => drawn.push_str(text),
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::super::samples::surroundings;
    use super::*;
    use proptest::prelude::*;

    fn vocabulary() -> Vocabulary {
        Vocabulary::of(surroundings())
    }

    /// The pieces that have a colour, with its numbers.
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
    fn words_have_the_colour_of_what_they_are() {
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
        assert_eq!(style_of("f(1))", ")").as_deref(), Some(STRAY.0));
    }

    #[test]
    fn the_bracket_at_the_cursor_and_its_partner_stand_out() {
        let marked = |cursor| pieces("f((a))", Some(cursor)).len();
        assert_eq!(marked(1), 2);
        assert_eq!(marked(6), 2);
        assert_eq!(marked(0), 0);
        assert_eq!(pieces("f(\")\"", Some(1)).len(), 1, "a bracket in a text is no partner");
    }

    #[test]
    fn a_member_that_a_variable_has_not_is_underlined() {
        assert_eq!(style_of("rod.lenght * 2", "lenght").as_deref(), Some(UNKNOWN_MEMBER.0));
        assert_eq!(style_of("rod.length * 2", "length"), None);
        assert_eq!(style_of("rod.leng", "leng"), None, "it is still being typed");
        assert_eq!(style_of("|rod| rod.x + 1", "x"), None, "another rod");
        assert_eq!(style_of("settings.any + 1", "any"), None);
    }

    #[test]
    fn commands_stand_out_and_their_expressions_have_colours() {
        assert_eq!(style_of(":step 10", ":step").as_deref(), Some(COMMAND.0));
        assert_eq!(style_of(":time sqrt(2)", "sqrt").as_deref(), Some(FUNCTION.0));
        assert_eq!(pieces(":nonsense 10", None), []);
    }

    #[test]
    fn a_long_input_is_drawn_fast() {
        let vocabulary = vocabulary();
        let line = "let a = scene.beam(#{ axis: line([0, 0], [1.5, 2]) }); // `x`\n";
        for part in [line, "(", "#", "`${a}", "rod.x.", "\"'"] {
            let text = part.repeat(10_000 / part.len() + 1);
            let drawing = |_| {
                let start = Instant::now();
                assert!(highlight(&text, Some(text.len()), &vocabulary).len() >= 10_000);
                start.elapsed()
            };
            let fastest = (0..20).map(drawing).min().unwrap_or_default();
            assert!(fastest < Duration::from_millis(5), "{part}: {fastest:?}");
        }
    }

    proptest! {
        #[test]
        fn colours_never_change_what_is_read(
            text in "([ -~äξ\n]|rod\\.|let |\\(|\\)|#\\{|\\}|\"|`|\\$\\{|:time |/\\*|//){0,40}", cursor in 0..60_usize
        ) {
            let drawn = highlight(&text, Some(cursor), &vocabulary());
            prop_assert_eq!(without_colours(&drawn), text);
        }
    }
}
