//! Declarations of variables and functions in the syntax of other languages, and misspelt keywords.

use rhai::ParseErrorType;

use super::fix::{ForeignSyntax, SyntaxFix};
use super::token_window::TokenWindow;
use crate::script::messages::suggest::nearest;

pub const PATTERNS: &[ForeignSyntax] = &[
    function,
    function_body,
    unnamed_function,
    type_first,
    tuple,
    several_names,
    parts,
    declared_type,
    compared,
    import,
    class,
    misspelt,
];

const FUNCTION_WORDS: &[&str] = &["def", "func", "function", "fun", "sub", "proc", "define"];

/// Explains foreign function definitions: `def f(x):`, `function y = f(x)`.
fn function(spot: &TokenWindow) -> Option<SyntaxFix> {
    let word = spot.in_statement(0);
    if !FUNCTION_WORDS.contains(&word) || spot.count() == 0 {
        return None;
    }
    let first = spot.first();
    let is_open = |index: &isize| spot.word(*index) == "(" && spot.is_name(index - 1);
    let open = (first + 1..first + 12).find(is_open);
    let written = open.and_then(|open| {
        let close = (open..open + 20).find(|index| spot.word(*index) == ")")?;
        Some(format!("{}{}", spot.word(open - 1), spot.piece(open, close + 1)))
    });
    let written = written.unwrap_or_else(|| "f(x)".into());
    spot.explain(
        first,
        format!("'{word}' is not a word of the language"),
        format!("a function is written fn {written} {{ … }}; its last expression is the result"),
    )
}

/// Explains functions with a wrong head or body: `fn f(x) => x`, `fn f(x) = x^2;`, `let f(x) = x^2;`, `f(x) = x^2;`, `fn f x { … }`.
fn function_body(spot: &TokenWindow) -> Option<SyntaxFix> {
    let is_headed = spot.in_statement(0) == "fn"
        && matches!(
            spot.error,
            ParseErrorType::FnMissingBody(_) | ParseErrorType::FnMissingParams(_)
        );
    let is_arrow = spot.in_statement(0) == "fn" && matches!(spot.word(0), "=>" | "->");
    let is_let = matches!(spot.word(-2), "let" | "const") && spot.word(0) == "(";
    let is_assigned = matches!(spot.error, ParseErrorType::AssignmentToInvalidLHS(_))
        && spot.is_name(0)
        && spot.word(1) == "(";
    (is_headed || is_arrow || is_let || is_assigned).then_some(())?;
    spot.explain(
        0,
        "this definition of a function is not valid",
        "write fn f(x) { x^2 }: the body needs braces, and its last expression is the result",
    )
}

/// Explains foreign closures: `let f = function(x) { … }`, `let f = fn(x) { … }`, `let f = lambda x: …`.
fn unnamed_function(spot: &TokenWindow) -> Option<SyntaxFix> {
    let hint = "a function without a name is written |x| …, and called by f.call(x)";
    if let Some((at, word)) = spot.find_word(&["lambda"]) {
        return spot.explain(at, format!("'{word}' is not a word of the language"), hint);
    }
    let is_value = |before: isize| matches!(spot.word(before), "=" | "(" | "," | ":");
    if spot.word(0) == "fn" && is_value(-1) {
        return spot.explain(
            0,
            "fn is only allowed in the definition of a function with a name",
            hint,
        );
    }
    let back = (-12..0).find(|at| FUNCTION_WORDS.contains(&spot.word(*at)) && is_value(at - 1))?;
    let message = format!("'{}' is not a word of the language", spot.word(back));
    spot.explain(back, message, hint)
}

/// Explains foreign declarations of variables: `var x = 3`, `int x = 3`.
fn type_first(spot: &TokenWindow) -> Option<SyntaxFix> {
    const WORDS: &[&str] = &[
        "var", "val", "int", "float", "double", "auto", "bool", "string", "String", "real",
        "local", "global", "static", "my", "dim", "real64", "number",
    ];
    let word = spot.in_statement(0);
    let name = spot.in_statement(1);
    let is_declaration = WORDS.contains(&word) && matches!(spot.in_statement(2), "=" | ";" | "");
    (is_declaration && !name.is_empty() && name.starts_with(char::is_alphabetic)).then_some(())?;
    spot.explain(
        spot.first(),
        format!("'{word}' does not declare a variable"),
        format!("declare a variable of any type by let {name} = …"),
    )
}

/// Explains lists where one value is expected: `let a, b = 1, 2;`, `a, b = 1, 2`, `let a = 1, b = 2;`, `let x = 0,5;`, `return 1, 2`.
fn several_names(spot: &TokenWindow) -> Option<SyntaxFix> {
    if spot.word(0) != "," || spot.missing().0 != ";" {
        return None;
    }
    let is_decimal =
        spot.is_number(-1) && spot.is_number(1) && spot.is_joined(0) && spot.is_joined(1);
    if is_decimal && !spot.word(-1).contains('.') && spot.in_statement(0) != "return" {
        let (whole, fraction) = (spot.word(-1), spot.word(1));
        let hint = format!("use a decimal point in numbers: {whole}.{fraction}");
        return spot.explain(0, "a number contains a comma", hint);
    }
    if spot.in_statement(0) == "return" {
        let value = spot.piece(spot.first() + 1, 0);
        let hint =
            format!("return an array: return [{value}, …]; or a map: return #{{ a: …, b: … }}");
        return spot.explain(0, "a function returns one value", hint);
    }
    spot.explain(
        0,
        "a statement assigns one variable",
        "write one statement for each variable: let a = 1; let b = 2;",
    )
}

/// Explains tuples: `let t = (1, 2);`, `let t = {1, 2};`.
fn tuple(spot: &TokenWindow) -> Option<SyntaxFix> {
    let is_open = matches!(spot.word(-2), "(" | "{") && matches!(spot.word(-3), "=" | "(" | ",");
    let is_missing = spot.missing().0 == ")" || spot.word(-2) == "{";
    (spot.word(0) == "," && is_open && is_missing).then_some(())?;
    let hint = format!("write [{}, …]", spot.word(-1));
    spot.explain(-2, "several values must be an array", hint)
}

/// Explains declarations that take an array or a map apart: `let [a, b] = pair;`.
fn parts(spot: &TokenWindow) -> Option<SyntaxFix> {
    let declares = matches!(spot.word(-1), "let" | "const");
    (declares && matches!(spot.word(0), "[" | "{" | "(" | "#{")).then_some(())?;
    spot.explain(
        0,
        "let cannot split an array or a map",
        "assign the parts one by one: let a = pair[0]; let b = pair[1]; or map.key",
    )
}

/// Explains declared types and defaults: `let x: int = 3`, `fn f(x: number)`, `fn f(x = 1)`.
fn declared_type(spot: &TokenWindow) -> Option<SyntaxFix> {
    let is_variable = matches!(spot.word(-2), "let" | "const") && spot.word(0) == ":";
    if is_variable {
        let hint = format!("omit the type: let {} = …", spot.word(-1));
        return spot.explain(0, "variables have no declared types", hint);
    }
    if !spot.missing().1.contains("parameters of function") {
        return None;
    }
    match spot.word(0) {
        ":" => spot.explain(
            0,
            "parameters have no declared types",
            format!("omit the types: fn f({}) {{ … }}", spot.word(-1)),
        ),
        "=" => spot.explain(
            0,
            "parameters have no default values",
            "define a second function with fewer parameters, fn f() { f(1) }, or use a map of \
            options",
        ),
        _ => None,
    }
}

/// Explains a confusion of `=` and `==`: `let a == 3;` and `if x = 3`.
fn compared(spot: &TokenWindow) -> Option<SyntaxFix> {
    if spot.word(0) == "==" && matches!(spot.word(-2), "let" | "const") {
        let hint = format!("write let {} = …", spot.word(-1));
        return spot.explain(0, "== compares; use = to assign a value", hint);
    }
    let is_condition = matches!(spot.in_statement(0), "if" | "while" | "until");
    let else_if = spot.in_statement(0) == "else" && spot.in_statement(1) == "if";
    if spot.word(0) == "=" && (is_condition || else_if) {
        return spot.explain(0, "= assigns a value; use == to compare", "write ==");
    }
    None
}

/// Explains foreign imports: `from math import sin`, `using`, `include`, `require`.
fn import(spot: &TokenWindow) -> Option<SyntaxFix> {
    let word = spot.in_statement(0);
    let is_import = matches!(word, "from" | "using" | "include" | "require" | "use" | "load")
        && spot.count() >= 1;
    let is_reserved = matches!(word, "use") || matches!(spot.word(0), "use");
    (is_import || is_reserved).then_some(())?;
    spot.explain(
        spot.first(),
        format!("'{}' does not import a module", if word.is_empty() { spot.word(0) } else { word }),
        "sin, PI and others are available without import; import a module by import \
        \"std/sections\" as sections;",
    )
}

/// Explains definitions of classes and other types: `class Beam { … }`, `struct Beam { … }`.
fn class(spot: &TokenWindow) -> Option<SyntaxFix> {
    let word = spot.in_statement(0);
    let is_class = matches!(word, "class" | "struct" | "interface" | "enum" | "type" | "classdef");
    (is_class && spot.count() == 1).then_some(())?;
    spot.explain(
        spot.first(),
        format!("'{word}' is not part of the language"),
        "use a map for values that belong together, #{ length: 2, name: \"rod\" }; define \
        functions by fn",
    )
}

/// Explains misspelt keywords, such as `lett y = 3`, `retrun x`, `whlie x < 3 {`.
fn misspelt(spot: &TokenWindow) -> Option<SyntaxFix> {
    const WORDS: &[&str] = &[
        "let", "const", "if", "else", "for", "while", "loop", "fn", "return", "import", "export",
        "throw", "try", "switch", "break", "continue",
    ];
    let word = spot.in_statement(0);
    let reached = spot.count() == 1 && (spot.is_value(0) || matches!(spot.word(0), "(" | "{"));
    let before = spot.word(spot.first() - 1);
    let starts = !matches!(before, "," | "(" | "[" | "#{" | ":");
    let is_statement = matches!(spot.error, ParseErrorType::MissingToken(token, _) if token == ";");
    let is_word = word.chars().count() > 2 && spot.is_name(spot.first());
    if !(reached && starts && is_statement && is_word) {
        return None;
    }
    let near = nearest(word, WORDS.iter().copied())?;
    spot.explain(
        spot.first(),
        format!("'{word}' is not a word of the language"),
        format!("did you mean '{near}'?"),
    )
}
