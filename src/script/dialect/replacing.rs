//! The method `text.replace(found, other)`. Unlike in Rhai, the length is checked before memory is allocated.

use rhai::{Engine, EvalAltResult, ImmutableString};

use super::sizes::expect_text;

trait TextPiece {
    fn as_text(&self) -> String;
}

impl TextPiece for char {
    fn as_text(&self) -> String {
        self.to_string()
    }
}

impl TextPiece for ImmutableString {
    fn as_text(&self) -> String {
        self.to_string()
    }
}

pub fn install(engine: &mut Engine) {
    engine.register_fn("replace", replace::<ImmutableString, ImmutableString>);
    engine.register_fn("replace", replace::<ImmutableString, char>);
    engine.register_fn("replace", replace::<char, ImmutableString>);
    engine.register_fn("replace", replace::<char, char>);
}

fn replace<F: TextPiece, O: TextPiece>(
    text: &mut ImmutableString,
    found: F,
    other: O,
) -> Result<(), Box<EvalAltResult>> {
    let (found, other) = (found.as_text(), other.as_text());
    let count = text.matches(&found).count();
    let length = text.len() - count * found.len();
    let length = other.len().checked_mul(count).and_then(|more| length.checked_add(more));
    expect_text(length)?;
    if !text.is_empty() {
        *text = text.replace(&found, &other).into();
    }
    Ok(())
}
