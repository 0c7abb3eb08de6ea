//! The largest texts, arrays and maps of a script.
//!
//! Rhai's own limits count all that is in an array again for every call of one of its methods. Here the length of a variable is looked at where the
//! variable is used, and functions that make much of little know how much before they do. What grows inside of something else is held by the
//! limit of memory.

use rhai::{Array, Dynamic, Engine, EvalAltResult, INT, ImmutableString, Map, Position};

use crate::script::messages::error::EngineResult;

/// The longest text [bytes].
pub const LONGEST_TEXT: usize = 16 << 20;
const LARGEST_ARRAY: usize = 10_000_000;
const LARGEST_MAP: usize = 1_000_000;

const TEXT: &str = "Length of string";
const ARRAY: &str = "Size of array/BLOB";
const MAP: &str = "Size of object map";

/// Registers the functions that lengthen a text or an array at once, in the place of Rhai's own.
pub fn install(engine: &mut Engine) {
    engine.register_fn("pad", pad_array);
    engine.register_fn("pad", pad_text::<char>);
    engine.register_fn("pad", pad_text::<ImmutableString>);
}

/// Checks that a value of a variable is not too large to be used.
///
/// # Errors
/// Fails when its text or its number of elements is longer than a script may make one.
pub fn check(value: &Dynamic) -> EngineResult<()> {
    if let Some(text) = value.read_lock::<ImmutableString>() {
        expect(text.len() <= LONGEST_TEXT, TEXT)
    } else if let Some(array) = value.read_lock::<Array>() {
        expect(array.len() <= LARGEST_ARRAY, ARRAY)
    } else if let Some(map) = value.read_lock::<Map>() {
        expect(map.len() <= LARGEST_MAP, MAP)
    } else {
        Ok(())
    }
}

/// The refusal of a text that is too long.
pub fn expect_text(bytes: Option<usize>) -> EngineResult<()> {
    expect(bytes.is_some_and(|bytes| bytes <= LONGEST_TEXT), TEXT)
}

fn expect(is_allowed: bool, what: &str) -> EngineResult<()> {
    match is_allowed {
        true => Ok(()),
        false => Err(EvalAltResult::ErrorDataTooLarge(what.into(), Position::NONE).into()),
    }
}

/// The number of elements of a value and of all that is in it.
fn elements(value: &Dynamic) -> usize {
    if let Some(array) = value.read_lock::<Array>() {
        array.iter().map(elements).fold(1, usize::saturating_add)
    } else if let Some(map) = value.read_lock::<Map>() {
        map.values().map(elements).fold(1, usize::saturating_add)
    } else {
        1
    }
}

/// Lengthens an array to `length` elements by copies of one.
fn pad_array(array: &mut Array, length: INT, element: Dynamic) -> EngineResult<()> {
    let length = usize::try_from(length).unwrap_or(0);
    let more = length.saturating_sub(array.len());
    if more > 0 {
        let total = elements(&element).saturating_mul(more).saturating_add(array.len());
        expect(total <= LARGEST_ARRAY, ARRAY)?;
        array.resize(length, element);
    }
    Ok(())
}

/// Lengthens a text to `length` characters by repetitions of another one, the last of which may be cut.
fn pad_text<P: ToString>(text: &mut ImmutableString, length: INT, padding: P) -> EngineResult<()> {
    let padding = padding.to_string();
    let length = usize::try_from(length).unwrap_or(0);
    let more = length.saturating_sub(text.chars().count());
    if more > 0 && !padding.is_empty() {
        expect(more <= LONGEST_TEXT, TEXT)?;
        let mut padded = text.to_string();
        padded.extend(padding.chars().cycle().take(more));
        expect(padded.len() <= LONGEST_TEXT, TEXT)?;
        *text = padded.into();
    }
    Ok(())
}
