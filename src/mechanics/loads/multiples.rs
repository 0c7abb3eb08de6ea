//! Multiples of a time, as people write them.

/// So near to one, times the time, is a whole number of them in a unit of time.
const WHOLE: f64 = 1e-15;

/// `n` times a time. One that is one over a whole number is taken as such: n/10 is the number people write, n · 0.1 is often its neighbour [time].
pub fn multiple(time: f64, n: u64) -> f64 {
    let rate = (1.0 / time).round();
    let is_whole = (rate * time - 1.0).abs() < WHOLE;
    if is_whole { n as f64 / rate } else { n as f64 * time }
}
