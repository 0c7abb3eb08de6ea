//! Plain-language messages for syntax errors of the parser.

use rhai::{Engine, LexError, ParseErrorType};

pub fn explain(error: &ParseErrorType, word: &str) -> (String, Option<String>) {
    match error {
        ParseErrorType::UnexpectedEOF => {
            ("the script ends too early".into(), Some("a bracket may not be closed".into()))
        }
        ParseErrorType::BadInput(LexError::Runtime(advice)) => match advice.split_once(": ") {
            Some((fix, why)) => (why.into(), Some(fix.into())),
            None => (advice.clone(), None),
        },
        ParseErrorType::BadInput(LexError::UnterminatedString) => {
            ("the text has no closing quote".into(), Some("add the closing quote".into()))
        }
        ParseErrorType::Reserved(word) | ParseErrorType::ForbiddenVariable(word) => reserved(word),
        ParseErrorType::VariableExpected | ParseErrorType::PropertyExpected if is_word(word) => {
            reserved(word)
        }
        ParseErrorType::MissingToken(token, _) if token == "}" && is_reserved(word) => {
            reserved(word)
        }
        ParseErrorType::BadInput(LexError::ImproperSymbol(word, why))
            if why.contains("disabled") =>
        {
            (format!("'{word}' is not part of the language"), None)
        }
        ParseErrorType::BadInput(LexError::UnexpectedInput(_))
        | ParseErrorType::UnknownOperator(_)
            if word == "." =>
        {
            (
                "a number cannot begin with a decimal point".into(),
                Some("write 0.5 instead of .5".into()),
            )
        }
        ParseErrorType::MissingToken(token, why) => {
            (format!("'{token}' is missing {why}").trim_end().to_owned(), missing_token_hint(token))
        }
        ParseErrorType::ExprTooDeep => (
            "the expression is nested too deeply".into(),
            Some("assign parts of it to variables with let".into()),
        ),
        ParseErrorType::DuplicatedProperty(key) => {
            (format!("the key '{key}' is given twice"), None)
        }
        ParseErrorType::AssignmentToConstant(name) => (
            format!("the constant '{name}' cannot be changed"),
            Some("declare it with let instead of const".into()),
        ),
        ParseErrorType::MismatchedType(wanted, got) if wanted == "an iterable value" => {
            let got = got.replace("an object map", "a map");
            (format!("for cannot loop over {got}"), Some(FOR_HINT.into()))
        }
        ParseErrorType::MismatchedType(wanted, got) => {
            let hint = (wanted == "a boolean expression")
                .then(|| "a condition is true or false: write a comparison, x != 0".to_owned());
            (format!("expected {wanted}, got {got}"), hint)
        }
        ParseErrorType::WrongDocComment => {
            ("a comment with /// must be followed by a function".into(), Some("use // here".into()))
        }
        other => (lower_first(&other.to_string()), None),
    }
}

pub const FOR_HINT: &str = "for loops over an array, a text or a range: for i in 0..10 { … }; over a map with for key \
    in map.keys() { … }";

fn reserved(word: &str) -> (String, Option<String>) {
    (
        format!("'{word}' is a reserved word and cannot be used here"),
        Some("choose another name".into()),
    )
}

fn is_word(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic())
}

fn is_reserved(word: &str) -> bool {
    is_word(word) && Engine::new_raw().compile(format!("let {word} = 1;")).is_err()
}

fn missing_token_hint(token: &str) -> Option<String> {
    (token == ";").then(|| "statements end with a semicolon".into())
}

fn lower_first(text: &str) -> String {
    let mut characters = text.chars();
    match characters.next() {
        Some(first) => first.to_lowercase().chain(characters).collect(),
        None => String::new(),
    }
}
