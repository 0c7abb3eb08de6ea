//! A label with its value, and values in a few words.

use crate::geometry::Vec2;
use crate::output::significant;

/// Digits of a number among the details.
const DIGITS: usize = 6;

/// A component that is less than this part of a vector is rounding.
const ROUNDING: f64 = 1e-12;

/// Most things of a kind that are listed by name.
const LISTED: usize = 4;

pub(super) fn line(label: &str, value: impl Into<String>) -> (String, String) {
    (label.to_owned(), value.into())
}

/// A number in the details of a value, with a few digits.
pub(super) fn number(x: f64) -> String {
    significant(x, DIGITS)
}

/// A point or vector in the details of a value, with a few digits; a component that is rounding beside the other one is 0.
pub(super) fn pair(of: Vec2) -> String {
    let [x, y] = [of.x, of.y].map(|x| if x.abs() < ROUNDING * of.norm() { 0.0 } else { x });
    format!("({}, {})", number(x), number(y))
}

/// Things in a line of the details of a value, the last of many left out and counted.
pub(super) fn listed(things: impl ExactSizeIterator<Item = String>) -> String {
    let count = things.len();
    let shown: Vec<String> = things.take(LISTED).collect();
    match count > LISTED {
        true => format!("{}, … ({count})", shown.join(", ")),
        false => shown.join(", "),
    }
}

/// Numbers in a line of the details of a value, the middle of many left out and all counted.
pub(super) fn numbers(all: &[f64]) -> String {
    let texts = |part: &[f64]| part.iter().copied().map(number).collect::<Vec<_>>().join(", ");
    match all {
        [first @ .., last] if all.len() > 2 * LISTED => {
            format!("{}, …, {} ({})", texts(&first[..LISTED]), number(*last), all.len())
        }
        all => texts(all),
    }
}
