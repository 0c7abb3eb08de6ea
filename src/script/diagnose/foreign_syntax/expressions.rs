//! Expressions in the syntax of other languages.

use rhai::ParseErrorType;

use super::fix::{ForeignSyntax, SyntaxFix};
use super::token_window::TokenWindow;
use crate::script::bindings::table::CallSyntax;

pub const PATTERNS: &[ForeignSyntax] = &[
    choice,
    whole_division,
    comprehension,
    slice,
    range,
    call_without_parentheses,
    juxtaposed,
    keyword,
    stepping,
];

/// Explains foreign conditional expressions: `a ? 1 : 2` and `1 if a else 2`.
fn choice(spot: &TokenWindow) -> Option<SyntaxFix> {
    let hint = "use if as an expression: let x = if a > 0 { 1 } else { 2 };";
    if spot.word(0) == "?" {
        return spot.explain(0, "the operator '?' does not exist", hint);
    }
    let follows = spot.is_value(-1) || matches!(spot.word(-1), ")" | "]");
    let is_behind = spot.word(0) == "if" && follows && spot.count() > 0;
    is_behind.then_some(())?;
    spot.explain(0, "a condition must be written before its branches", hint)
}

/// Explains the integer division `7 // 2`, where `//` starts a comment.
fn whole_division(spot: &TokenWindow) -> Option<SyntaxFix> {
    let is_operand = spot.is_number(-1) || spot.is_name(-1) || matches!(spot.word(-1), ")" | "]");
    (spot.missing().0 == ";" && is_operand && spot.has_comment_before()).then_some(())?;
    spot.explain(
        -1,
        "';' is missing before the comment",
        "statements end with a semicolon; // begins a comment, quotient(n, d) divides whole \
        numbers",
    )
}

/// Explains list comprehensions: `[x^2 for x in xs]`.
fn comprehension(spot: &TokenWindow) -> Option<SyntaxFix> {
    let is_within = spot.word(0) == "for" && spot.missing().0 == ",";
    is_within.then_some(())?;
    spot.explain(
        0,
        "for is not allowed inside the brackets of an array",
        "write [1, 2, 3].map(|x| x^2); array.filter(|x| x > 1) selects elements",
    )
}

/// Explains slices of arrays: `a[0:2]`.
fn slice(spot: &TokenWindow) -> Option<SyntaxFix> {
    (spot.word(0) == ":" && spot.missing().0 == "]").then_some(())?;
    spot.explain(
        0,
        "an index must not contain a colon",
        "array.extract(0..2) returns the elements 0 and 1, text.sub_string(0, 2) two characters",
    )
}

/// Explains ranges with a colon: `1:10`.
fn range(spot: &TokenWindow) -> Option<SyntaxFix> {
    let is_range = spot.word(0) == ":" && spot.is_number(-1) && spot.is_value(1);
    (is_range && spot.word(-2) != "{").then_some(())?;
    let (from, to) = (spot.word(-1), spot.word(1));
    spot.explain(
        0,
        "a range is not written with a colon",
        format!("write {from}..={to}, which ends with {to}, or {from}..{to}, which ends before it; linspace(0, 1, 5) for other numbers"),
    )
}

/// Explains calls without parentheses: `print "hello"`, `sqrt 2`, `typeof x`.
/// Also explains the foreign words `new`, `null`, `nil` and `void`, as in `new Scene()`.
fn call_without_parentheses(spot: &TokenWindow) -> Option<SyntaxFix> {
    if let ParseErrorType::Reserved(word) = spot.error {
        match word.as_str() {
            "new" => {
                let hint = "call the function without new, such as new_scene(\"name\")";
                return spot.explain(0, "'new' is not part of the language", hint);
            }
            "null" | "nil" | "void" => {
                let message = format!("'{word}' is not a value");
                return spot.explain(0, message, "the value nothing is written (): x == ()");
            }
            "print" | "debug" if spot.is_value(1) => {
                let hint = format!("write {word}({})", spot.word(1));
                return spot.explain(0, format!("{word} must be called with parentheses"), hint);
            }
            _ => (),
        }
    }
    let name = spot.word(-1);
    let is_known = spot.catalog.named(name).any(|row| matches!(row.form, CallSyntax::Function))
        || spot.catalog.built_ins_named(name).any(|known| known.is_function())
        || matches!(name, "typeof" | "disp" | "echo");
    let is_argument = spot.is_value(0) && !spot.is_joined(0);
    (is_known && is_argument && spot.is_name(-1) && spot.word(-2) != ".").then_some(())?;
    let name = match name {
        "typeof" => "type_of",
        "disp" | "echo" => "print",
        other => other,
    };
    let hint = format!("write {name}({})", spot.word(0));
    spot.explain(-1, "a function must be called with parentheses", hint)
}

/// Explains values without an operator or comma between them: `2x`, `2(x + 1)`, `1e3f`, `[1 2 3]`.
fn juxtaposed(spot: &TokenWindow) -> Option<SyntaxFix> {
    let (missing, why) = spot.missing();
    let in_array = missing == "," && why.contains("array");
    if in_array && spot.word(0) == ";" {
        let hint = "rows are arrays in an array: [[1, 2], [3, 4]]";
        return spot.explain(0, "a semicolon cannot separate the rows of an array", hint);
    }
    if in_array && (spot.is_value(0) || spot.word(0) == "-") && !spot.is_joined(0) {
        let hint = format!("write [{}, {}, …]", spot.word(-1), spot.word(0));
        return spot.explain(0, "elements of an array are separated by commas", hint);
    }
    let is_factor = spot.is_number(-1) && (spot.is_name(0) || spot.word(0) == "(");
    (is_factor && spot.is_joined(0)).then_some(())?;
    let factor = if spot.word(0) == "(" { "(…)" } else { spot.word(0) };
    let hint = format!("write {} * {factor}; numbers have no suffix", spot.word(-1));
    spot.explain(0, "a product must be written with *", hint)
}

/// Explains `x++` and `x--` where the parser reports only a missing token.
fn stepping(spot: &TokenWindow) -> Option<SyntaxFix> {
    let sign = spot.word(0);
    (matches!(sign, "+" | "-") && spot.word(1) == sign && spot.is_joined(1)).then_some(())?;
    spot.explain(
        0,
        format!("'{sign}{sign}' is not part of the language"),
        format!("write x {sign}= 1"),
    )
}

/// Explains arguments with names: `section(EA = 1e4)`, `section(EA: 1e4)`.
fn keyword(spot: &TokenWindow) -> Option<SyntaxFix> {
    let (missing, why) = spot.missing();
    let is_argument = missing == "," && why.contains("argument");
    let is_named = matches!(spot.word(0), "=" | ":") && spot.is_name(-1);
    (is_argument && is_named).then_some(())?;
    let called = why.split('\'').nth(1).filter(|name| !name.is_empty()).unwrap_or("f");
    spot.explain(
        0,
        "arguments are given by position, not by name",
        format!("options are written #{{ … }}: {called}(#{{ {}: … }})", spot.word(-1)),
    )
}
