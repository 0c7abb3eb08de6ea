//! Means of schedules over steps.
//!
//! Constants and tables, and their sums and products up to degree five, are integrated exactly by a three-point Gauss rule.
//! Sines and smooth pulses, and their sums and products with each other and with tables, are integrated in closed form.
//! All other schedules are sampled at five points, for two quadrature rules that are exact for cubic polynomials.
//! The difference between the results of the two quadrature rules is an estimate of the sampling error.

use super::{GAUSS, LimitSide, LoadError, Operation, Schedule, table_value};
use crate::elementary::{cos, sin};
use std::f64::consts::TAU;

/// Mean of a schedule over a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepMean {
    /// Mean factor [-].
    pub mean: f64,
    /// Difference between the results of two quadrature rules [-]; zero if the mean is exact.
    pub sampling_error: f64,
    /// Largest absolute value of the samples [-]; the absolute mean if no samples are used. For a sum of schedules, the sum of these values.
    pub largest: f64,
}

/// Highest degree of a polynomial that three Gauss points integrate exactly.
const EXACT_DEGREE: usize = 5;

/// Distance of the additional quadrature points from the middle of the step, on [-1, 1].
/// The quadrature points are inside the step, so that a jump of the schedule at an end of the step does not affect the mean.
const OUTER: f64 = 0.96;

/// Weight of each additional quadrature point. The rule with these points and the middle point is exact for cubic polynomials.
const OUTER_WEIGHT: f64 = 1.0 / (6.0 * OUTER * OUTER);

/// Largest number of terms in a closed form. Products with more terms are sampled.
const MOST_WAVES: usize = 64;

/// Largest degree of a product of tables that is integrated in closed form.
const MOST_DEGREE: usize = 4;

/// Largest number of parts of a step in which a schedule is sampled.
const MOST_SAMPLED_PARTS: f64 = 64.0;

/// Number of terms in the power series for slowly oscillating functions. The series is accurate to rounding up to a phase of 1.
const TERMS: usize = 10;

impl Schedule {
    /// Mean factor [-] over a step. No break of the schedule may lie inside the step.
    ///
    /// # Errors
    /// Fails if a script function fails or a value is not finite.
    pub fn mean(&self, start: f64, end: f64) -> Result<StepMean, LoadError> {
        if let Self::Constant(factor) = self {
            return Ok(StepMean { mean: *factor, sampling_error: 0.0, largest: factor.abs() });
        }
        let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
        match self.shape() {
            Some(shape) if shape.suits_points() => {
                return Ok(gauss_mean(self.gauss_values(middle, half)?));
            }
            Some(shape) if shape.suits_waves() => {
                let factors = ScheduleFactors { first: self, others: None };
                let mean = Step { middle, half }.mean(Some(&factors), Wave::one());
                if let Some(mean) = mean {
                    let found = StepMean { mean, sampling_error: 0.0, largest: mean.abs() };
                    let failed = LoadError::NotFinite { time: middle, value: mean };
                    return mean.is_finite().then_some(found).ok_or(failed);
                }
            }
            _ => {}
        }
        if let Self::Combined { operation, parts, .. } = self {
            match (operation, &parts.0, &parts.1) {
                (Operation::Sum, a, b) => {
                    let (a, b) = (a.mean(start, end)?, b.mean(start, end)?);
                    return Ok(StepMean {
                        mean: a.mean + b.mean,
                        sampling_error: a.sampling_error + b.sampling_error,
                        largest: a.largest + b.largest,
                    });
                }
                (Operation::Product, Self::Constant(factor), other)
                | (Operation::Product, other, Self::Constant(factor)) => {
                    let StepMean { mean, sampling_error: missed, largest } =
                        other.mean(start, end)?;
                    return Ok(StepMean {
                        mean: factor * mean,
                        sampling_error: factor.abs() * missed,
                        largest: factor.abs() * largest,
                    });
                }
                _ => {}
            }
        }
        let inner = self.gauss_values(middle, half)?;
        let StepMean { mean, largest, .. } = gauss_mean(inner);
        let at = |place: f64| self.value(middle + half * place, LimitSide::After);
        let [first, centre, last] = [at(-OUTER)?, inner[1], at(OUTER)?];
        let other = (1.0 - 2.0 * OUTER_WEIGHT) * centre + OUTER_WEIGHT * (first + last);
        let largest = largest.max(first.abs()).max(last.abs());
        Ok(StepMean { mean, sampling_error: (mean - other).abs(), largest })
    }

    /// Mean factor [-] over a step. A sampled schedule is sampled in parts of at most the given duration, up to a maximum number of parts.
    ///
    /// # Errors
    /// As for [`mean`](Self::mean).
    pub fn mean_of_parts(&self, start: f64, end: f64, longest: f64) -> Result<StepMean, LoadError> {
        let parts = ((end - start) / longest).ceil().min(MOST_SAMPLED_PARTS);
        if parts.is_nan() || parts <= 1.0 || !self.is_sampled_in_steps() {
            return self.mean(start, end);
        }
        let (duration, share) = ((end - start) / parts, 1.0 / parts);
        let mut whole = StepMean::default();
        for part in 0..parts as usize {
            let from = start + part as f64 * duration;
            let StepMean { mean, sampling_error, largest } = self.mean(from, from + duration)?;
            whole.mean += share * mean;
            whole.sampling_error += share * sampling_error;
            whole.largest = whole.largest.max(largest);
        }
        Ok(whole)
    }

    pub(crate) fn is_sampled_in_steps(&self) -> bool {
        !self.shape().is_some_and(|shape| shape.suits_points() || shape.suits_waves())
    }

    fn gauss_values(&self, middle: f64, half: f64) -> Result<[f64; 3], LoadError> {
        let mut values = [0.0; 3];
        for (value, (place, _)) in values.iter_mut().zip(GAUSS) {
            *value = self.value(middle + half * place, LimitSide::After)?;
        }
        Ok(values)
    }

    fn shape(&self) -> Option<ScheduleShape> {
        let wave = |waves| ScheduleShape { degree: 0, waves, is_polynomial: false };
        match self {
            Self::Constant(_) | Self::Sampled(_) | Self::DigitalController { .. } => {
                Some(ScheduleShape { degree: 0, waves: 1, is_polynomial: true })
            }
            Self::Table(_) => Some(ScheduleShape { degree: 1, waves: 1, is_polynomial: true }),
            Self::Sine { .. } => Some(wave(2)),
            Self::SmoothPulse { .. } => Some(wave(7)),
            Self::Function { .. } => None,
            Self::Combined { operation, parts, .. } => {
                let (a, b) = (parts.0.shape()?, parts.1.shape()?);
                let is_polynomial = a.is_polynomial && b.is_polynomial;
                let (degree, waves) = match operation {
                    Operation::Sum => (a.degree.max(b.degree), a.waves.saturating_add(b.waves)),
                    Operation::Product => (a.degree + b.degree, a.waves.saturating_mul(b.waves)),
                };
                Some(ScheduleShape { degree, waves, is_polynomial })
            }
        }
    }
}

fn gauss_mean(values: [f64; 3]) -> StepMean {
    let mut found = StepMean::default();
    for (value, (_, weight)) in values.into_iter().zip(GAUSS) {
        found.mean += 0.5 * weight * value;
        found.largest = found.largest.max(value.abs());
    }
    found
}

struct ScheduleShape {
    degree: usize,
    waves: usize,
    is_polynomial: bool,
}

impl ScheduleShape {
    fn suits_points(&self) -> bool {
        self.is_polynomial && self.degree <= EXACT_DEGREE
    }

    fn suits_waves(&self) -> bool {
        self.waves <= MOST_WAVES && self.degree <= MOST_DEGREE
    }
}

struct ScheduleFactors<'a> {
    first: &'a Schedule,
    others: Option<&'a ScheduleFactors<'a>>,
}

struct Step {
    middle: f64,
    half: f64,
}

impl Step {
    fn mean(&self, factors: Option<&ScheduleFactors>, wave: Wave) -> Option<f64> {
        let Some(ScheduleFactors { first, others }) = factors else { return Some(wave.mean()) };
        let Self { middle, half } = *self;
        match first {
            Schedule::Constant(factor) => self.mean(*others, wave.times([*factor, 0.0])),
            Schedule::Table(rows) => {
                let [value, change] = line(rows, middle, half);
                self.mean(*others, wave.times_line(value, change)?)
            }
            Schedule::Sine { amplitude, rate, phase } => {
                let phase = rate * middle + phase;
                let sine = [amplitude * sin(phase), -amplitude * cos(phase)];
                self.mean_of_product(*others, wave, (sine, rate * half))
            }
            // The integral of a smooth pulse uses the identity 16/5 sin⁶ x = 1 - 3/2 cos 2x + 3/5 cos 4x - 1/10 cos 6x.
            Schedule::SmoothPulse { duration } if middle > 0.0 && middle < *duration => {
                let mut sum = self.mean(*others, wave)?;
                for (order, amplitude) in [(1.0, -1.5), (2.0, 0.6), (3.0, -0.1)] {
                    let rate = order * TAU / duration;
                    let phase = rate * middle;
                    let cosine = [amplitude * cos(phase), amplitude * sin(phase)];
                    sum += self.mean_of_product(*others, wave, (cosine, rate * half))?;
                }
                Some(sum)
            }
            Schedule::SmoothPulse { .. } => Some(0.0),
            Schedule::Combined { operation, parts, .. } => {
                let (a, b) = (&parts.0, &parts.1);
                match operation {
                    Operation::Sum => {
                        let a =
                            self.mean(Some(&ScheduleFactors { first: a, others: *others }), wave)?;
                        let b =
                            self.mean(Some(&ScheduleFactors { first: b, others: *others }), wave)?;
                        Some(a + b)
                    }
                    Operation::Product => {
                        let b = ScheduleFactors { first: b, others: *others };
                        self.mean(Some(&ScheduleFactors { first: a, others: Some(&b) }), wave)
                    }
                }
            }
            Schedule::Sampled(value) | Schedule::DigitalController { value, .. } => {
                self.mean(*others, wave.times([value.get(), 0.0]))
            }
            Schedule::Function { .. } => None,
        }
    }

    fn mean_of_product(
        &self,
        factors: Option<&ScheduleFactors>,
        wave: Wave,
        (amplitude, turn): ([f64; 2], f64),
    ) -> Option<f64> {
        if wave.is_constant() {
            let [real, _] = wave.amplitude;
            let amplitude = amplitude.map(|part| real * part);
            return self.mean(factors, Wave { amplitude, turn, ..wave });
        }
        let [real, imaginary] = amplitude.map(|part| 0.5 * part);
        let sum = Wave { turn: wave.turn + turn, ..wave.times([real, imaginary]) };
        let difference = Wave { turn: wave.turn - turn, ..wave.times([real, -imaginary]) };
        Some(self.mean(factors, sum)? + self.mean(factors, difference)?)
    }
}

fn line(rows: &[(f64, f64)], middle: f64, half: f64) -> [f64; 2] {
    let passed = rows.partition_point(|row| row.0 <= middle);
    let value = table_value(rows, middle, LimitSide::After);
    let slope = match (passed.checked_sub(1).and_then(|at| rows.get(at)), rows.get(passed)) {
        (Some(before), Some(after)) => (after.1 - before.1) / (after.0 - before.0),
        _ => 0.0,
    };
    [value, slope * half]
}

/// Function `p(x) Re(amplitude exp(i turn x))` on [-1, 1], with a polynomial `p`.
#[derive(Clone, Copy)]
struct Wave {
    polynomial: [f64; MOST_DEGREE + 1],
    degree: usize,
    amplitude: [f64; 2],
    turn: f64,
}

impl Wave {
    fn one() -> Self {
        let mut polynomial = [0.0; MOST_DEGREE + 1];
        polynomial[0] = 1.0;
        Self { polynomial, degree: 0, amplitude: [1.0, 0.0], turn: 0.0 }
    }

    fn is_constant(&self) -> bool {
        self.turn == 0.0
    }

    fn times(self, [real, imaginary]: [f64; 2]) -> Self {
        let [own, other] = self.amplitude;
        let amplitude = [own * real - other * imaginary, own * imaginary + other * real];
        Self { amplitude, ..self }
    }

    fn times_line(self, value: f64, change: f64) -> Option<Self> {
        if change == 0.0 {
            return Some(self.times([value, 0.0]));
        }
        let degree = self.degree + 1;
        let mut polynomial = [0.0; MOST_DEGREE + 1];
        *polynomial.get_mut(degree)? = change * self.polynomial[self.degree];
        for at in (0..degree).rev() {
            let lower = if at > 0 { change * self.polynomial[at - 1] } else { 0.0 };
            polynomial[at] = value * self.polynomial[at] + lower;
        }
        Some(Self { polynomial, degree, ..self })
    }

    fn mean(&self) -> f64 {
        let [real, imaginary] = self.amplitude;
        let (sine, cosine) = (sin(self.turn), cos(self.turn));
        let mut moment = if self.turn == 0.0 { 1.0 } else { sine / self.turn };
        let mut sum = real * self.polynomial[0] * moment;
        for (power, coefficient) in self.polynomial.iter().enumerate().take(self.degree + 1).skip(1)
        {
            let is_even = power % 2 == 0;
            moment = if self.turn.abs() < 1.0 {
                slow_moment(power, self.turn)
            } else {
                let by_parts = power as f64 / self.turn * moment;
                if is_even { sine / self.turn - by_parts } else { by_parts - cosine / self.turn }
            };
            sum += coefficient * moment * if is_even { real } else { -imaginary };
        }
        sum
    }
}

fn slow_moment(power: usize, turn: f64) -> f64 {
    let odd = power % 2;
    let (mut term, mut sum) = (if odd == 1 { turn } else { 1.0 }, 0.0);
    for order in 0..TERMS {
        let exponent = 2 * order + odd;
        sum += term / (exponent + power + 1) as f64;
        term *= -turn * turn / ((exponent + 1) * (exponent + 2)) as f64;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::rc::Rc;

    fn product(a: &Schedule, b: &Schedule) -> Schedule {
        Schedule::combined(Operation::Product, a.clone(), b.clone()).unwrap()
    }

    fn by_parts(schedule: &Schedule, start: f64, end: f64) -> f64 {
        let parts = 4000;
        let width = (end - start) / f64::from(parts);
        let part = |at| {
            let middle = start + (f64::from(at) + 0.5) * width;
            gauss_mean(schedule.gauss_values(middle, 0.5 * width).unwrap())
        };
        (0..parts).map(|at| part(at).mean).sum::<f64>() / f64::from(parts)
    }

    #[test]
    fn library_schedules_and_their_products_have_exact_means() {
        let sine = Schedule::sine(1.5, 40.0, 0.3).unwrap();
        let slow = Schedule::sine(-2.0, 0.1, 1.0).unwrap();
        let pulse = Schedule::smooth_pulse(2.0).unwrap();
        let ramp = Schedule::ramp(-1.0, 3.0).unwrap();
        let sum = Schedule::combined(Operation::Sum, sine.clone(), ramp.clone()).unwrap();
        let line = product(&ramp, &product(&ramp, &ramp));
        let all = [
            sine.clone(),
            slow.clone(),
            pulse.clone(),
            product(&sine, &sine),
            product(&sine, &slow),
            product(&pulse, &sine),
            product(&ramp, &pulse),
            product(&product(&line, &ramp), &slow),
            product(&line, &sine),
            product(&sum, &pulse),
            product(&sum, &product(&ramp, &sine)),
            product(&line, &line),
        ];
        for schedule in all {
            for (start, end) in [(0.0, 2.0), (0.1, 0.2), (0.7, 0.72), (0.5, 0.3), (1.0, 1.0 + 1e-9)]
            {
                let found = schedule.mean(start, end).unwrap();
                let exact = by_parts(&schedule, start, end);
                let is_sampled = schedule.is_sampled_in_steps();
                let close = if is_sampled { 0.03 } else { 1e-12 };
                assert!(
                    (found.mean - exact).abs() < close
                        && (is_sampled || found.sampling_error == 0.0),
                    "{} on {start}, {end}: {found:?}, exact {exact}",
                    schedule.describe()
                );
            }
        }
    }

    #[test]
    fn short_pulses_and_fast_sines_have_exact_impulses() {
        for duration in [0.01, 0.05, 0.1] {
            let pulse = Schedule::smooth_pulse(duration).unwrap();
            assert!((pulse.mean(0.0, duration).unwrap().mean - 1.0).abs() < 1e-15);
            assert_eq!(pulse.mean(duration, 0.2).unwrap().mean, 0.0);
        }
        for turns in [2.0, 3.0] {
            let sine = Schedule::sine(1.0, turns * TAU / 0.1, 0.7).unwrap();
            assert!(sine.mean(0.3, 0.4).unwrap().mean.abs() < 1e-15);
        }
    }

    #[test]
    fn mean_of_parts_detects_a_short_pulse_in_a_long_step() {
        let pulse = |t: f64| (-((t - 3.3) / 0.02).powi(2)).exp();
        let schedule =
            Schedule::Function { function: Rc::new(move |t: f64| Ok(pulse(t))), breaks: vec![] };
        let missed = schedule.mean(0.0, 6.25).unwrap();
        assert!(missed.mean < 1e-12);
        assert_eq!(schedule.mean_of_parts(0.0, 6.25, f64::INFINITY).unwrap(), missed);
        let found = schedule.mean_of_parts(0.0, 6.25, 0.1).unwrap().mean;
        let exact = 0.02 * std::f64::consts::PI.sqrt() / 6.25;
        assert!((found / exact - 1.0).abs() < 0.5, "{found} {exact}");
        let sine = Schedule::sine(1.0, 40.0, 0.3).unwrap();
        assert_eq!(sine.mean_of_parts(0.0, 6.25, 0.1).unwrap(), sine.mean(0.0, 6.25).unwrap());
    }

    #[test]
    fn sampling_error_of_a_function_is_estimated() {
        let missed = |function: fn(f64) -> f64| {
            let schedule = Schedule::Function {
                function: Rc::new(move |t: f64| Ok(function(t))),
                breaks: vec![],
            };
            assert!(schedule.is_sampled_in_steps());
            let StepMean { sampling_error: missed, largest, .. } = schedule.mean(0.5, 0.6).unwrap();
            missed / largest
        };
        assert!(missed(|t| (TAU * t / 2.0).sin()) < 1e-5);
        assert!(missed(|t| t * t * t - t) < 1e-15);
        for jump in [0.503, 0.537, 0.55, 0.57, 0.598] {
            let step = Schedule::Function {
                function: Rc::new(move |t: f64| Ok(f64::from(u8::from(t > jump)))),
                breaks: vec![],
            };
            let StepMean { sampling_error: missed, largest, .. } = step.mean(0.5, 0.6).unwrap();
            assert!(largest == 1.0 && missed > 0.09, "{jump}: {missed}");
        }
        assert_eq!(missed(|t| if t < 0.6 { 1.0 } else { 0.0 }), 0.0, "a jump at the end of a step");
        assert!(missed(|t| (-((t - 0.537) / 0.01).powi(2)).exp()) > 0.1);
    }
}
