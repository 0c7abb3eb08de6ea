//! Multiples of a time, rounded once if the time is the inverse of a whole number.

/// Largest relative difference for which a time counts as the inverse of a whole number.
const WHOLE: f64 = 1e-15;

/// Returns `n` times a time [time]. If the time is the inverse of a whole number `m`, the function returns the rounded quotient `n/m`.
/// For example, `n/10` is the floating-point number nearest to the decimal number, whereas the product `n · 0.1` often differs in the last bit.
pub fn multiple(time: f64, n: u64) -> f64 {
    let rate = (1.0 / time).round();
    let is_whole = (rate * time - 1.0).abs() < WHOLE;
    if is_whole { n as f64 / rate } else { n as f64 * time }
}
