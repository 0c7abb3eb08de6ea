//! Numbers, places, times and counts as they stand in messages.

use crate::geometry::Vec2;

/// More beams, loads or times than this are told of together.
pub const MOST: usize = 6;

/// A number in words, of seven digits at most.
pub fn rounded(number: f64) -> String {
    let rounded: f64 = format!("{number:.6e}").parse().unwrap_or(number);
    rounded.to_string()
}

/// A point in words, such as `(1.570796, 2.8)`.
pub fn written(at: Vec2) -> String {
    format!("({}, {})", rounded(at.x), rounded(at.y))
}

/// The first few of some times in words; none where there are none.
pub fn in_words(times: &[f64]) -> Option<String> {
    match times {
        [] => None,
        [first, .., last] if times.len() > MOST => {
            Some(format!("{first}, …, {last} ({} times)", times.len()))
        }
        times => Some(times.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")),
    }
}

/// A count of things in words: `1 hinge`, `2 hinges`.
pub fn plural(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_told_in_seven_digits() {
        assert_eq!(rounded(std::f64::consts::FRAC_PI_2), "1.570796");
        assert_eq!(
            (rounded(2.800_000_000_000_000_3), rounded(-0.25)),
            ("2.8".into(), "-0.25".into())
        );
    }
}
