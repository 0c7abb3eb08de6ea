//! Operators, comments and quotes in the syntax of other languages.

use rhai::{LexError, ParseErrorType};

use super::fix::{ForeignSyntax, SyntaxFix};
use super::token_window::TokenWindow;

pub const PATTERNS: &[ForeignSyntax] = &[comment, sign, dotted_operator, quotes, formatted_text];

/// Explains foreign comments: `# …` and, at the start of a statement, `% …`.
fn comment(spot: &TokenWindow) -> Option<SyntaxFix> {
    let hint = "a comment begins with //";
    match spot.word(0) {
        "#" => spot.explain(0, "# does not begin a comment", hint),
        text if text.starts_with('#') && !text.starts_with("#{") => {
            spot.explain(0, "# does not begin a comment", hint)
        }
        text if text.starts_with('%') && spot.count() == 0 => {
            spot.explain(0, "% does not begin a comment: it is the remainder", hint)
        }
        text if text.starts_with('%') && spot.is_value(1) && matches!(spot.word(-1), ";" | "}") => {
            spot.explain(0, "% does not begin a comment: it is the remainder", hint)
        }
        _ => None,
    }
}

fn sign(spot: &TokenWindow) -> Option<SyntaxFix> {
    let signs: &[(&str, &str)] = &[
        ("===", "write == to compare"),
        ("!==", "write != to compare"),
        ("~=", "write != for not equal"),
        ("<>", "write != for not equal"),
        (":=", "write = to assign, and let to declare a variable: let x = 3;"),
        ("++", "write x += 1"),
        ("--", "write x -= 1"),
        ("<-", "write = to assign; to compare with a negative number add a space: x < -1"),
        ("->", "write |x| … for a function without a name; the type of the result is not declared"),
        ("=>", ARROW),
        ("@", "write |x| x^2 for a function without a name"),
        ("...", "a statement continues on the next line without a sign: remove the dots"),
        ("..", "a range needs both ends: 0..10, or 0..=10 including the last one"),
        ("\\", "a statement continues on the next line without a sign: remove the \\"),
        ("$", "names have no $; in a text between backquotes, ${x} is the value of x"),
    ];
    for (sign, hint) in signs {
        let is_here = spot.word(0) == *sign;
        let halves = spot.word(0).len() < sign.len()
            && format!("{}{}", spot.word(0), spot.word(1)).starts_with(sign)
            && spot.is_joined(1);
        let starts = *sign == "@" && spot.word(0).starts_with('@');
        let is_body = spot.in_statement(0) == "fn" && matches!(*sign, "=>" | "->");
        if (is_here || halves || starts) && !is_body {
            return spot.explain(0, format!("'{sign}' is not part of the language"), *hint);
        }
    }
    (spot.word(0) == "~").then_some(())?;
    let hint = "write ! for not, and != for not equal";
    spot.explain(0, "'~' is not part of the language", hint)
}

const ARROW: &str = "write |x| … for a function without a name; in switch, => follows a case";

/// Explains operators for elements of arrays: `.*`, `./` and `.^`.
fn dotted_operator(spot: &TokenWindow) -> Option<SyntaxFix> {
    let operator = spot.word(0).chars().next().filter(|sign| "*/^\\'".contains(*sign))?;
    let is_dotted = spot.word(-1) == "." && spot.is_joined(0);
    is_dotted.then_some(())?;
    spot.explain(
        -1,
        format!("there is no operator '.{operator}'"),
        format!(
            "array.map(|x| x {operator} 2) works on each element; points made by vec(x, y) can \
            be added and multiplied by numbers"
        ),
    )
}

fn quotes(spot: &TokenWindow) -> Option<SyntaxFix> {
    let is_quote = spot.word(0).starts_with('\'');
    match spot.error {
        ParseErrorType::BadInput(LexError::MalformedChar(text)) => spot.explain(
            0,
            "single quotes enclose one character, not a text",
            format!("write \"{}\": a text is written in double quotes", text.trim_matches('\'')),
        ),
        ParseErrorType::BadInput(_) if is_quote && spot.is_joined(0) && spot.is_transposable() => {
            spot.explain(
                0,
                "' does not transpose: it begins a character",
                "matrices are not available: remove the '; texts are written in double quotes",
            )
        }
        ParseErrorType::BadInput(_) if is_quote => spot.explain(
            0,
            "single quotes enclose one character, not a text",
            "write a text in double quotes: \"text\"",
        ),
        _ => None,
    }
}

impl TokenWindow<'_> {
    fn is_transposable(&self) -> bool {
        self.is_name(-1) || matches!(self.word(-1), "]" | ")")
    }
}

/// Explains text with inserted values as in Python: `f"x = {x}"`.
fn formatted_text(spot: &TokenWindow) -> Option<SyntaxFix> {
    let is_prefix = matches!(spot.word(-1), "f" | "F" | "r" | "b" | "u");
    let is_text = spot.word(0).starts_with('"') && spot.is_joined(0);
    (is_prefix && is_text).then_some(())?;
    spot.explain(
        -1,
        format!("a text has no letter before its quotes, got {}\"", spot.word(-1)),
        "texts between backquotes contain values: `x = ${x}`",
    )
}
