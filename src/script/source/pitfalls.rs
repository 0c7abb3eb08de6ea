//! Notes on valid expressions that probably do not mean what the user intends.

use super::scanner::{Bracket, Token, TokenKind, is_name, scan};

/// Note on a valid expression that probably does not mean what its author intends.
pub struct Pitfall {
    /// Start of the expression [bytes].
    pub at: usize,
    pub note: String,
}

pub fn pitfalls(text: &str) -> Vec<Pitfall> {
    let all = scan(text);
    let tokens: Vec<Token> = all.iter().copied().filter(Token::is_significant).collect();
    let comments = all.iter().filter(|token| token.kind == TokenKind::Comment);
    let mut found: Vec<Pitfall> = comments.filter_map(|at| note_on_comment(text, at)).collect();
    for (index, token) in tokens.iter().enumerate() {
        let note = match token.kind {
            TokenKind::Text => note_on_braces(token.of(text)),
            TokenKind::Word => note_on_schedule(text, &tokens[index.saturating_sub(1)..]),
            TokenKind::Symbol if token.of(text) == "+" => {
                note_on_sum(text, &tokens[..index], &tokens[index + 1..])
            }
            _ => None,
        };
        found.extend(note.map(|note| Pitfall { at: token.start, note }));
    }
    found.sort_by_key(|pitfall| pitfall.at);
    found
}

/// Messages about [`pitfalls`] with their positions, in a text after `lines_before` lines of a program.
pub fn messages(text: &str, lines_before: usize) -> Vec<String> {
    let placed = |Pitfall { at, note }| {
        let before = &text[..at];
        let line = before.matches('\n').count() + 1 + lines_before;
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        format!("note: line {line}, column {column}: {note}")
    };
    pitfalls(text).into_iter().map(placed).collect()
}

/// Note on a comment that is a number and follows a value, as in `7 // 2`.
fn note_on_comment(text: &str, comment: &Token) -> Option<Pitfall> {
    let divisor = comment.of(text).strip_prefix("//")?.trim().trim_end_matches(';').trim_end();
    divisor.parse::<f64>().ok()?;
    let before = text[..comment.start].trim_end_matches([' ', '\t']);
    let is_value = |last: char| is_name(last) || matches!(last, ')' | ']');
    before.ends_with(is_value).then(|| Pitfall {
        at: comment.start,
        note: "// begins a comment: write floor(a / b) for a whole quotient".to_owned(),
    })
}

fn note_on_braces(literal: &str) -> Option<String> {
    let inside = literal.strip_prefix('"')?;
    let name = inside.split('{').skip(1).find_map(|part| {
        let name = part.split_once('}')?.0;
        (name.starts_with(char::is_alphabetic) && name.chars().all(is_name)).then_some(name)
    })?;
    Some(format!(
        "{{{name}}} in quotes is text: write `… ${{{name}}} …` in backticks for its value"
    ))
}

fn note_on_schedule(text: &str, tokens: &[Token]) -> Option<String> {
    let [dot, name, open, rest @ ..] = tokens else { return None };
    let name = name.of(text);
    let is_load = dot.of(text) == "." && matches!(name, "force" | "moment" | "line_load");
    if !is_load || open.kind != TokenKind::Open(Bracket::Round) {
        return None;
    }
    let (mut depth, mut commas) = (0_usize, 0);
    for (index, token) in rest.iter().enumerate() {
        match token.kind {
            TokenKind::Open(_) => depth += 1,
            TokenKind::Close(_) if depth == 0 => return None,
            TokenKind::Close(_) => depth -= 1,
            TokenKind::Symbol if depth == 0 && token.of(text) == "," => commas += 1,
            TokenKind::Number if commas == 2 && depth == 0 => {
                let number = token.of(text);
                let is_alone = rest[index - 1].of(text) == ","
                    && rest.get(index + 1).is_some_and(|next| matches!(next.of(text), ")" | ","));
                let is_factor = number.parse::<f64>().is_ok_and(|factor| factor != 1.0);
                return (is_alone && is_factor).then(|| {
                    format!(
                        "{name}: {number} is a factor of the load at all times: write \
                        hold_for({number}) for a load that acts for a time, or multiply the load"
                    )
                });
            }
            _ => {}
        }
    }
    None
}

fn note_on_sum(text: &str, before: &[Token], after: &[Token]) -> Option<String> {
    let is_point = |inside: &[Token]| {
        let is_flat = !inside.iter().any(|token| matches!(token.kind, TokenKind::Open(_)));
        is_flat && inside.iter().filter(|token| token.of(text) == ",").count() == 1
    };
    let square = Bracket::Square;
    let start = before.iter().rposition(|token| token.kind == TokenKind::Open(square))?;
    let (ahead, left) = before.split_at(start);
    let is_index = ahead.last().is_some_and(|token| {
        matches!(token.kind, TokenKind::Word | TokenKind::Close(_) | TokenKind::Text)
    });
    let end = after.iter().position(|token| token.kind == TokenKind::Close(square))?;
    let right = after[..end].strip_prefix(&after[..1])?;
    let are_closed =
        left.last()?.kind == TokenKind::Close(square) && after[0].kind == TokenKind::Open(square);
    (are_closed && !is_index && is_point(&left[1..left.len() - 1]) && is_point(right)).then(|| {
        "+ joins two arrays of 2 elements to one of 4: write vec(1, 2) + [3, 4] for the sum of vectors"
            .to_owned()
    })
}
