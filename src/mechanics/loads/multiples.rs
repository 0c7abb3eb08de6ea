//! Multiples of a time as decimal numbers.

/// Relative tolerance within which a time is one over a whole number.
const WHOLE: f64 = 1e-15;

/// `n` times a time. If the time is one over a whole number, the result is the rounded quotient: n/10 is the decimal number, n · 0.1 often its
/// neighbour [time].
pub fn multiple(time: f64, n: u64) -> f64 {
    let rate = (1.0 / time).round();
    let is_whole = (rate * time - 1.0).abs() < WHOLE;
    if is_whole { n as f64 / rate } else { n as f64 * time }
}
