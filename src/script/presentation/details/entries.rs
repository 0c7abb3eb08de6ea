//! Formats of labels and values in summaries.

use crate::geometry::Vec2;
use crate::output::significant;

const DIGITS: usize = 6;

/// Largest component of a vector that is attributed to rounding, as a fraction of the length of the vector.
const ROUNDING: f64 = 1e-12;

const LISTED: usize = 4;

pub(super) fn line(label: &str, value: impl Into<String>) -> (String, String) {
    (label.to_owned(), value.into())
}

pub(super) fn number(x: f64) -> String {
    significant(x, DIGITS)
}

pub(super) fn pair(of: Vec2) -> String {
    let [x, y] = [of.x, of.y].map(|x| if x.abs() < ROUNDING * of.norm() { 0.0 } else { x });
    format!("({}, {})", number(x), number(y))
}

pub(super) fn listed(things: impl ExactSizeIterator<Item = String>) -> String {
    let count = things.len();
    let shown: Vec<String> = things.take(LISTED).collect();
    match count > LISTED {
        true => format!("{}, … ({count})", shown.join(", ")),
        false => shown.join(", "),
    }
}

pub(super) fn numbers(all: &[f64]) -> String {
    let texts = |part: &[f64]| part.iter().copied().map(number).collect::<Vec<_>>().join(", ");
    match all {
        [first @ .., last] if all.len() > 2 * LISTED => {
            format!("{}, …, {} ({})", texts(&first[..LISTED]), number(*last), all.len())
        }
        all => texts(all),
    }
}
