//! Packing of time series as text: numbers are rounded, replaced by differences, compressed by DEFLATE, and encoded in base64.

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use serde_json::{Value, json};

use crate::output::OutputError;
use crate::output::base64::base64;

/// Code of values that are not finite, larger than the codes of finite values.
const MISSING: u16 = u16::MAX;
pub const FINEST: u16 = MISSING - 1;

/// Rounding of numbers to steps: `number = origin + step · code`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantisation {
    pub origin: f64,
    /// Difference between the numbers of consecutive codes; zero if all numbers are equal.
    pub step: f64,
}

impl Quantisation {
    pub fn over(numbers: impl Iterator<Item = f64>, steps: u16) -> Self {
        let finite = numbers.filter(|number| number.is_finite());
        let (least, greatest) = finite
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), number| {
                (a.min(number), b.max(number))
            });
        match least <= greatest {
            // Halved numbers are subtracted, because the difference of two large numbers may be infinite.
            true => Self {
                origin: least,
                step: (greatest / 2.0 - least / 2.0) / f64::from(steps) * 2.0,
            },
            false => Self { origin: 0.0, step: 0.0 },
        }
    }

    fn code(&self, number: f64) -> u16 {
        match number.is_finite() {
            false => MISSING,
            true if self.step == 0.0 => 0,
            true => (number / self.step - self.origin / self.step)
                .round()
                .clamp(0.0, f64::from(FINEST)) as u16,
        }
    }
}

/// Packs `numbers` time series of `frames` values each for the page. The arguments of `value` are the series and the frame.
///
/// # Errors
/// Fails if the compression fails, which would be an internal error.
pub fn pack(
    scale: Quantisation,
    (numbers, frames): (usize, usize),
    value: impl Fn(usize, usize) -> f64,
) -> Result<Value, OutputError> {
    let codes: Vec<Vec<u16>> = (0..numbers)
        .map(|number| (0..frames).map(|frame| scale.code(value(number, frame))).collect())
        .collect();
    // Second differences are smaller for smooth motions, and first differences for others. The order with the shorter result is used.
    let cost = |order: u32| -> u64 {
        let all = codes.iter().flat_map(|series| differences(series, order));
        all.map(|difference| u64::from(u16::BITS - difference.leading_zeros())).sum()
    };
    let order = if cost(2) < cost(1) { 2 } else { 1 };
    let words: Vec<u16> = codes.iter().flat_map(|series| differences(series, order)).collect();
    let high = words.iter().map(|word| (word >> 8) as u8);
    let bytes: Vec<u8> = high.chain(words.iter().map(|word| *word as u8)).collect();
    let mut deflated = ZlibEncoder::new(Vec::new(), Compression::default());
    let failed = |error: std::io::Error| OutputError::Paint { reason: error.to_string() };
    deflated.write_all(&bytes).map_err(failed)?;
    let deflated = deflated.finish().map_err(failed)?;
    Ok(json!({
        "origin": scale.origin,
        "step": scale.step,
        "numbers": numbers,
        "frames": frames,
        "order": order,
        "data": base64(&deflated),
    }))
}

fn differences(codes: &[u16], order: u32) -> impl Iterator<Item = u16> + '_ {
    let (mut last, mut last_change) = (0u16, 0u16);
    codes.iter().map(move |&code| {
        let change = code.wrapping_sub(last);
        let difference = if order == 2 { change.wrapping_sub(last_change) } else { change };
        (last, last_change) = (code, change);
        let signed = difference as i16;
        ((signed << 1) ^ (signed >> 15)) as u16
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantisation_error_is_at_most_half_a_step() {
        let numbers = [-3.0, 0.1, 2.7, 9.0, f64::NAN];
        let scale = Quantisation::over(numbers.into_iter(), FINEST);
        for number in &numbers[..4] {
            let back = scale.origin + scale.step * f64::from(scale.code(*number));
            assert!((back - number).abs() <= 0.500001 * scale.step);
        }
        assert_eq!((scale.code(-3.0), scale.code(9.0), scale.code(f64::NAN)), (0, FINEST, MISSING));
        assert_eq!(Quantisation::over([7.0; 3].into_iter(), FINEST).code(7.0), 0);
        let huge = Quantisation::over([-f64::MAX, f64::MAX].into_iter(), FINEST);
        assert_eq!((huge.code(-f64::MAX), huge.code(f64::MAX)), (0, FINEST));
        assert_eq!(
            Quantisation::over([f64::NAN].into_iter(), FINEST),
            Quantisation { origin: 0.0, step: 0.0 }
        );
    }

    #[test]
    fn second_differences_of_uniform_motion_are_zero() {
        let codes: Vec<u16> = (0..5).map(|frame| 64_000 + 300 * frame).collect();
        let second: Vec<u16> = differences(&codes, 2).collect();
        assert_eq!(second[2..], [0, 0, 0]);
        let first: Vec<u16> = differences(&[3, 2, 2, 4], 1).collect();
        assert_eq!(first, [6, 1, 0, 4]);
    }
}
