//! Frequency spectrum of a column over time.
//!
//! The mean is subtracted, and the rows are weighted with a Blackman–Harris window (F. J. Harris 1978: side lobes of -92 dB).
//! A parabola through the logarithms of the three values around each maximum gives the frequency and amplitude of the maximum.
//! The Fourier transform (Cooley and Tukey 1965) uses the sines of this crate, so that results are identical on all machines.

use std::f64::consts::TAU;

use super::TimeSeries;
use crate::elementary::{cos, exp, ln, sin_cos};
use crate::system::rounded;

/// Largest relative difference of two row spacings that count as equal.
const EVEN: f64 = 1e-6;

/// Smallest number of rows of a column whose spectrum is computed.
const FEWEST: usize = 16;

/// Smallest ratio of the length with appended zeros to the original length of the column.
const PADDING: usize = 4;

/// Largest height of a maximum that may be a side lobe of the window function, as a fraction of the largest maximum.
const SIDE_LOBES: f64 = 5e-5;

const WINDOW: [f64; 4] = [0.35875, -0.48829, 0.14128, -0.01168];

/// Half width of the main lobe of the window function, as a multiple of the frequency that has one period over all rows.
/// Frequencies below the half width of the main lobe cannot be distinguished from the mean.
const LOBE: f64 = 4.0;

/// Vibration found in a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectrumPeak {
    /// Frequency [1/time].
    pub frequency: f64,
    /// Half the peak-to-peak value of the vibration, in the unit of the column.
    pub amplitude: f64,
}

/// Reason why a column has no spectrum.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SpectrumError {
    #[error(
        "a spectrum needs rows at equal time intervals, but the row at t = {} follows after {} and most others after {}",
        rounded(*.time), rounded(*.found), rounded(*.expected)
    )]
    Uneven { time: f64, found: f64, expected: f64 },
    #[error("a spectrum needs at least {FEWEST} rows, there are {rows}")]
    TooFewRows { rows: usize },
    #[error("the value at t = {time} is not a finite number")]
    NoNumber { time: f64 },
}

impl TimeSeries {
    /// Strongest vibrations of the column, in decreasing order of amplitude. The argument `most` limits their number.
    ///
    /// Two vibrations are not separated if their numbers of periods over all rows differ by less than about four.
    /// Vibrations with fewer than about four periods are not detected.
    ///
    /// # Errors
    /// Fails if there are too few or unevenly spaced rows, or if a value is not finite.
    pub fn spectrum(&self, most: usize) -> Result<Vec<SpectrumPeak>, SpectrumError> {
        let count = self.values.len();
        if count < FEWEST {
            return Err(SpectrumError::TooFewRows { rows: count });
        }
        if let Some(at) = self.values.iter().position(|value| !value.is_finite()) {
            return Err(SpectrumError::NoNumber { time: self.times[at] });
        }
        let dt = self.spacing()?;
        let magnitudes = self.windowed_magnitudes();
        let highest = magnitudes.iter().copied().fold(0.0, f64::max);
        let size = 2 * (magnitudes.len() - 1);
        let lobe = (LOBE * size as f64 / count as f64) as usize;
        let is_peak = |at: &usize| {
            let (before, here, behind) = (magnitudes[at - 1], magnitudes[*at], magnitudes[at + 1]);
            here > before && here >= behind && here > SIDE_LOBES * highest
        };
        let mut peaks: Vec<SpectrumPeak> = (lobe.max(1)..magnitudes.len() - 1)
            .filter(is_peak)
            .map(|at| {
                let [a, b, c] = [at - 1, at, at + 1].map(|at| ln(magnitudes[at]));
                let shift = 0.5 * (a - c) / (a - 2.0 * b + c);
                let frequency = (at as f64 + shift) / (size as f64 * dt);
                SpectrumPeak { frequency, amplitude: exp(b - 0.25 * (a - c) * shift) }
            })
            .collect();
        peaks.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
        peaks.truncate(most);
        Ok(peaks)
    }

    fn spacing(&self) -> Result<f64, SpectrumError> {
        let mut durations: Vec<f64> = self.times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let middle = durations.len() / 2;
        let expected = *durations.select_nth_unstable_by(middle, f64::total_cmp).1;
        for pair in self.times.windows(2) {
            let found = pair[1] - pair[0];
            if (found - expected).abs() > EVEN * expected {
                return Err(SpectrumError::Uneven { time: pair[1], found, expected });
            }
        }
        let count = self.times.len();
        Ok((self.times[count - 1] - self.times[0]) / (count - 1) as f64)
    }

    /// Amplitudes of the windowed column at multiples of a base frequency, from zero to half the sampling rate.
    fn windowed_magnitudes(&self) -> Vec<f64> {
        let count = self.values.len();
        let weights: Vec<f64> = (0..count)
            .map(|row| {
                let angle = TAU * (row as f64 + 0.5) / count as f64;
                WINDOW.iter().enumerate().map(|(k, factor)| factor * cos(k as f64 * angle)).sum()
            })
            .collect();
        let whole: f64 = weights.iter().sum();
        let sum: f64 = weights.iter().zip(&self.values).map(|(weight, value)| weight * value).sum();
        let mean = sum / whole;
        let size = (PADDING * count).next_power_of_two();
        let mut numbers = vec![(0.0, 0.0); size];
        for ((number, value), weight) in numbers.iter_mut().zip(&self.values).zip(&weights) {
            number.0 = 2.0 * (value - mean) * weight / whole;
        }
        transform(&mut numbers);
        numbers[..=size / 2].iter().map(|(re, im)| (re * re + im * im).sqrt()).collect()
    }
}

/// Computes the Fourier transform in place. The number of values must be a power of two.
fn transform(numbers: &mut [(f64, f64)]) {
    let size = numbers.len();
    let bits = size.trailing_zeros();
    for at in 0..size {
        let mirrored = at.reverse_bits() >> (usize::BITS - bits);
        if mirrored > at {
            numbers.swap(at, mirrored);
        }
    }
    let turns: Vec<(f64, f64)> = (0..size / 2)
        .map(|k| {
            let (sin, cos) = sin_cos(-TAU * k as f64 / size as f64);
            (cos, sin)
        })
        .collect();
    let mut half = 1;
    while half < size {
        let stride = size / (2 * half);
        for block in numbers.chunks_exact_mut(2 * half) {
            let (low, high) = block.split_at_mut(half);
            for (k, (a, b)) in low.iter_mut().zip(high).enumerate() {
                let (cos, sin) = turns[k * stride];
                let turned = (b.0 * cos - b.1 * sin, b.0 * sin + b.1 * cos);
                *b = (a.0 - turned.0, a.1 - turned.1);
                *a = (a.0 + turned.0, a.1 + turned.1);
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elementary::sin;

    fn sampled(count: usize, dt: f64, f: impl Fn(f64) -> f64) -> TimeSeries {
        let times: Vec<f64> = (0..count).map(|row| row as f64 * dt).collect();
        let values = times.iter().map(|t| f(*t)).collect();
        TimeSeries { times, values }
    }

    #[test]
    fn spectrum_finds_frequency_and_amplitude_of_sines() {
        let of = sampled(777, 0.02, |t| {
            5.0 + 2.0 * sin(TAU * 1.37 * t + 0.4) + 0.003 * sin(TAU * 7.21 * t)
        });
        let peaks = of.spectrum(5).unwrap();
        assert_eq!(peaks.len(), 2, "{peaks:?}");
        for (peak, (frequency, amplitude)) in peaks.iter().zip([(1.37, 2.0), (7.21, 0.003)]) {
            assert!((peak.frequency / frequency - 1.0).abs() < 1e-4, "{peak:?}");
            assert!((peak.amplitude / amplitude - 1.0).abs() < 2e-3, "{peak:?}");
        }
        assert_eq!(of.spectrum(1).unwrap(), peaks[..1]);
    }

    #[test]
    fn fft_agrees_with_the_definition() {
        let values = [3.0, -1.0, 0.5, 2.0, 0.0, 1.0, -2.0, 4.0];
        let mut numbers = values.map(|value| (value, 0.0));
        transform(&mut numbers);
        for (k, (re, im)) in numbers.into_iter().enumerate() {
            let sum = |part: fn((f64, f64)) -> f64| -> f64 {
                let terms = values.iter().enumerate();
                terms.map(|(j, v)| v * part(sin_cos(-TAU * (j * k) as f64 / 8.0))).sum()
            };
            assert!((re - sum(|(_, cos)| cos)).abs() < 1e-13);
            assert!((im - sum(|(sin, _)| sin)).abs() < 1e-13);
        }
    }

    #[test]
    fn spectrum_of_uneven_few_or_nan_rows_is_rejected() {
        let mut of = sampled(40, 0.1, |t| t);
        assert_eq!(sampled(9, 0.1, |t| t).spectrum(1), Err(SpectrumError::TooFewRows { rows: 9 }));
        of.values[3] = f64::NAN;
        assert!(matches!(of.spectrum(1), Err(SpectrumError::NoNumber { .. })));
        of.values[3] = 0.0;
        of.times[39] += 0.05;
        assert!(matches!(of.spectrum(1), Err(SpectrumError::Uneven { .. })));
        assert_eq!(sampled(64, 0.1, |_| 2.0).spectrum(3).unwrap().len(), 0);
    }
}
