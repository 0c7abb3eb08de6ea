//! Formats of numbers, positions, times and counts in messages.

use crate::elementary::rounded_to;
use crate::geometry::Vec2;

/// Largest number of objects listed in a message.
pub const MOST: usize = 6;

/// Formats a number with at most six significant digits. Very small and very large numbers are written with a power of ten.
pub fn rounded(number: f64) -> String {
    let rounded = rounded_to(6, number);
    let is_plain = rounded == 0.0 || !rounded.is_finite() || (1e-4..1e7).contains(&rounded.abs());
    if is_plain { rounded.to_string() } else { format!("{rounded:e}") }
}

pub fn written(at: Vec2) -> String {
    format!("({}, {})", rounded(at.x), rounded(at.y))
}

/// Formats a list of times as text. Of a long list, only the first and the last time are written. The result is `None` if the list is empty.
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

/// Adds the indefinite article to a noun, as in `a beam` or `an obstacle`. A plural such as `knots` has no article.
pub fn with_article(noun: &str) -> String {
    // The noun before "of" or "with" determines the article, as in "a table of costs".
    let head =
        [" of ", " with "].iter().fold(noun, |head, of| head.split(of).next().unwrap_or(head));
    match noun.chars().next() {
        _ if head.ends_with('s') || head == "nothing" => noun.to_owned(),
        Some('a' | 'e' | 'i' | 'o' | 'A' | 'E' | 'I' | 'O') => format!("an {noun}"),
        _ => format!("a {noun}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extreme_numbers_are_written_as_powers_of_ten() {
        for (number, message) in [
            (0.0, "0"),
            (1.0 / 3.0, "0.333333"),
            (-1234567.8, "-1234570"),
            (1e-4, "0.0001"),
            (-2.449_291e-16, "-2.44929e-16"),
            (1e300, "1e300"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(rounded(number), message);
        }
    }

    #[test]
    fn rounded_numbers_have_at_most_six_digits() {
        assert_eq!(rounded(std::f64::consts::FRAC_PI_2), "1.5708");
        assert_eq!(
            (rounded(2.800_000_000_000_000_3), rounded(-0.25)),
            ("2.8".into(), "-0.25".into())
        );
    }
}
