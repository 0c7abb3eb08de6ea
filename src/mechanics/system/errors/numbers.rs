//! Formats of numbers, places, times and counts in messages.

use crate::geometry::Vec2;

/// Largest number of objects listed in a message.
pub const MOST: usize = 6;

/// Formats a number with at most six digits.
pub fn rounded(number: f64) -> String {
    let rounded: f64 = format!("{number:.5e}").parse().unwrap_or(number);
    rounded.to_string()
}

pub fn written(at: Vec2) -> String {
    format!("({}, {})", rounded(at.x), rounded(at.y))
}

/// Lists the first times; `None` if there are none.
pub fn in_words(times: &[f64]) -> Option<String> {
    match times {
        [] => None,
        [first, .., last] if times.len() > MOST => {
            Some(format!("{first}, …, {last} ({} times)", times.len()))
        }
        times => Some(times.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")),
    }
}

/// Formats a count as in `1 hinge`, `2 hinges`.
pub fn plural(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_have_at_most_six_digits() {
        assert_eq!(rounded(std::f64::consts::FRAC_PI_2), "1.5708");
        assert_eq!(
            (rounded(2.800_000_000_000_000_3), rounded(-0.25)),
            ("2.8".into(), "-0.25".into())
        );
    }
}
