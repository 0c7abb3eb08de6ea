//! Maps in the syntax of other languages, and unclosed brackets.

use rhai::ParseErrorType;

use super::fix::{ForeignSyntax, SyntaxFix};
use super::token_window::TokenWindow;

pub const PATTERNS: &[ForeignSyntax] = &[map_without_sign, assigned_key, unclosed];

/// Explains a map without the sign `#`: `{ EA: 1e4 }`.
fn map_without_sign(spot: &TokenWindow) -> Option<SyntaxFix> {
    let is_key = spot.is_name(-1) || spot.is_text(-1) || spot.is_number(-1);
    (spot.word(0) == ":" && is_key && spot.word(-2) == "{").then_some(())?;
    spot.explain(
        -2,
        "{ begins a block of statements, not a map of options",
        format!("options are written #{{ … }}: #{{ {}: … }}", spot.word(-1)),
    )
}

/// Explains a map with equals signs: `#{ EA = 1e4 }`.
fn assigned_key(spot: &TokenWindow) -> Option<SyntaxFix> {
    let (missing, why) = spot.missing();
    let is_key = missing == ":" && why.contains("map") && spot.word(0) == "=";
    is_key.then_some(())?;
    let hint = format!("write {}: …", spot.word(-1));
    spot.explain(0, "a key of a map must be followed by a colon", hint)
}

fn unclosed(spot: &TokenWindow) -> Option<SyntaxFix> {
    let is_missing =
        matches!(spot.error, ParseErrorType::MissingToken(..) | ParseErrorType::UnexpectedEOF);
    (spot.is_at_end() && is_missing).then_some(())?;
    let mut open = Vec::new();
    for at in -(spot.reach() as isize)..0 {
        match spot.word(at) {
            "{" | "(" | "[" | "#{" | "?[" => open.push(at),
            "}" | ")" | "]" => _ = open.pop(),
            _ => (),
        }
    }
    let at = *open.last()?;
    let closing = match spot.word(at) {
        "(" => ")",
        "[" | "?[" => "]",
        _ => "}",
    };
    spot.explain(
        at,
        format!("this '{}' has no closing bracket", spot.word(at)),
        format!("add '{closing}' at the end"),
    )
}

impl TokenWindow<'_> {
    fn reach(&self) -> usize {
        (1..=40_isize).take_while(|back| !self.word(-back).is_empty()).count()
    }
}
