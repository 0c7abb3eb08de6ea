//! Conditions, loops and blocks in the syntax of other languages.

use rhai::ParseErrorType;

use super::fix::{ForeignSyntax, SyntaxFix};
use super::token_window::TokenWindow;

pub const PATTERNS: &[ForeignSyntax] =
    &[else_if, word_operator, counting_loop, colon, body, handler, case, end];

fn else_if(spot: &TokenWindow) -> Option<SyntaxFix> {
    let (at, word) = spot.find_word(&["elif", "elseif", "elsif", "elseIf"])?;
    let message = format!("'{word}' is not a word of the language");
    spot.explain(at, message, "write else if … { … }")
}

/// Explains operators that are words: `and`, `or`, `not`, `is`, `xor`.
fn word_operator(spot: &TokenWindow) -> Option<SyntaxFix> {
    let (at, word) = spot.find_word(&["and", "or", "not", "is", "AND", "OR", "NOT", "xor"])?;
    let hint = match (word, spot.word(at + 1)) {
        ("and" | "AND", _) => "write && for and: a > 0 && a < 3",
        ("or" | "OR", _) => "write || for or: a < 0 || a > 3",
        ("not" | "NOT", "in") => "write !in for not in: 3 !in [1, 2]",
        ("not" | "NOT", _) => "write ! for not: !(a > 3)",
        ("is", "not") => "write !=; the value nothing is (): x != ()",
        ("is", _) => "write ==; the value nothing is (): x == ()",
        _ => "write a != b for two truth values",
    };
    spot.explain(at, format!("'{word}' is not an operator here"), hint)
}

/// Explains foreign loops with a counter or with `of`: `for (let i = 0; …)`, `for i = 1:10`, `for i <- xs`, `for x of xs`.
fn counting_loop(spot: &TokenWindow) -> Option<SyntaxFix> {
    let (at, _) = spot.find_word(&["for", "foreach"])?;
    let next = spot.word(at + 1);
    let is_in_parentheses = next == "(";
    let name = if is_in_parentheses { spot.word(at + 2) } else { next };
    let is_type = matches!(name, "let" | "var" | "int" | "const");
    let after = if is_in_parentheses { spot.word(at + 3) } else { spot.word(at + 2) };
    if after == "of" || (is_type && spot.word(at + 4) == "of") {
        let hint = "write for x in array { … }; for (x, i) in array { … } also counts the index";
        return spot.explain(0, "a for loop needs 'in'", hint);
    }
    if is_type || matches!(after, "=" | ";" | "<-") {
        let hint = "write for i in 0..10 { … }, which ends with 9, or 0..=10, which ends with 10; range(0, 10, 2) makes larger steps";
        return spot.explain(0, "a for loop needs a range in place of a counter", hint);
    }
    None
}

/// Explains a colon before a block: `if a == 1:`, `while x:`, `else:`, `for i in range(3):`.
fn colon(spot: &TokenWindow) -> Option<SyntaxFix> {
    const WORDS: &[&str] =
        &["if", "while", "for", "else", "try", "loop", "with", "class", "except", "finally"];
    if spot.word(0) != ":" || spot.missing().0 == "]" {
        return None;
    }
    let first = (1..20)
        .map(|back: isize| -back)
        .take_while(|at| !matches!(spot.word(*at), ";" | "}" | "{" | "#{" | ""))
        .find(|at| WORDS.contains(&spot.word(*at)))?;
    let head = match spot.word(first) {
        "for" => "for i in 0..10 { … }",
        "while" => "while x < 3 { … }",
        "else" => "else { … }",
        "try" => "try { … } catch { … }",
        "if" => "if a == 1 { … }",
        _ => "{ … }",
    };
    spot.explain(
        0,
        "a block is written in braces; a colon and indentation have no meaning",
        format!("write braces: {head}"),
    )
}

/// Explains a body without braces: `if (a == 1) print(a)`, `if a == 1 then`.
fn body(spot: &TokenWindow) -> Option<SyntaxFix> {
    let (token, why) = spot.missing();
    let is_body = token == "{" && why.contains("block");
    is_body.then_some(())?;
    let message = match spot.word(0) {
        "then" | "do" => format!("'{}' does not begin a block", spot.word(0)),
        _ => "the body of if, else, for and while needs braces".into(),
    };
    let head = match spot.in_statement(0) {
        "else" => "else { … }",
        "for" => "for x in array { … }",
        "while" => "while condition { … }",
        "fn" => "fn f(x) { … }",
        _ => "if condition { … }",
    };
    spot.explain(0, message, format!("write {head}"))
}

/// Explains foreign keywords for errors: `raise …`, `except …`.
fn handler(spot: &TokenWindow) -> Option<SyntaxFix> {
    if matches!(spot.in_statement(0), "raise" | "error") && spot.count() == 1 {
        let message = format!("'{}' is not a word of the language", spot.in_statement(0));
        return spot.explain(spot.first(), message, "write throw \"what is wrong\";");
    }
    let is_handler = matches!(spot.word(0), "except" | "finally" | "rescue" | "otherwise");
    is_handler.then_some(())?;
    spot.explain(
        0,
        format!("'{}' is not a word of the language", spot.word(0)),
        "write try { … } catch (problem) { print(problem.message); }",
    )
}

/// Explains foreign cases of `switch`: `case 1:` and `default:`.
fn case(spot: &TokenWindow) -> Option<SyntaxFix> {
    matches!(spot.word(0), "case" | "default").then_some(())?;
    spot.explain(
        0,
        format!("'{}' is not used in a switch", spot.word(0)),
        "write switch x { 1 => \"one\", 2 => \"two\", _ => \"many\" }",
    )
}

fn end(spot: &TokenWindow) -> Option<SyntaxFix> {
    if matches!(
        spot.word(0),
        "end" | "endif" | "endfor" | "endwhile" | "endfunction" | "fi" | "done"
    ) {
        let message = format!("'{}' does not end a block", spot.word(0));
        return spot.explain(0, message, "a block is written in braces: if a == 1 { … }");
    }
    let closes = matches!(spot.word(0), ")" | "]" | "}");
    let is_unexpected =
        matches!(spot.error, ParseErrorType::MissingToken(token, _) if token == ";");
    if closes && is_unexpected {
        let message = format!("this '{}' has no opening bracket", spot.word(0));
        return spot.explain(0, message, "remove it, or add the opening bracket before it");
    }
    None
}
