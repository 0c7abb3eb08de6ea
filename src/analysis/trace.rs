//! Values of a quantity during a run, and their differences from the values in another run of the same scene.

use crate::beams::Station;
use crate::geometry::Vec2;
use crate::simulation::Simulation;

/// Largest difference of two times that count as equal, as a fraction of the duration of a run.
const SAME_TIME: f64 = 1e-9;

#[derive(Debug, Clone, PartialEq)]
pub struct TracedQuantity {
    pub name: String,
    pub dimension: &'static str,
    pub source: TraceSource,
}

#[derive(Debug, Clone, PartialEq)]
pub enum TraceSource {
    /// Position of a station in all recorded configurations [length].
    Position(Station),
    Column,
    /// Column of the history whose values are means over a step, such as contact forces.
    StepMean,
}

#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trace {
    times: Vec<f64>,
    values: Vec<Vec2>,
    is_integral: bool,
}

impl Trace {
    pub fn of(simulation: &Simulation, quantity: &TracedQuantity) -> Self {
        let history = simulation.history();
        let column = |name: &str| history.column(name).unwrap_or_default();
        match &quantity.source {
            TraceSource::Position(station) => {
                let path = simulation.place(station).map(|place| simulation.path(&place));
                let (times, values) = path.unwrap_or_default().into_iter().unzip();
                Self { times, values, is_integral: false }
            }
            TraceSource::Column => {
                let values = column(&quantity.name).into_iter().map(scalar).collect();
                Self { times: column("t"), values, is_integral: false }
            }
            TraceSource::StepMean => {
                let means = column(&quantity.name);
                let mut sum = 0.0;
                let add = |(mean, dt): (&f64, f64)| {
                    // The first row of a history has no preceding step, so that its step mean may be undefined.
                    sum += if dt > 0.0 { mean * dt } else { 0.0 };
                    scalar(sum)
                };
                let values = means.iter().zip(column("dt")).map(add).collect();
                Self { times: column("t"), values, is_integral: true }
            }
        }
    }

    /// Trace of a value at one time.
    pub fn at_one_time(value: Vec2) -> Self {
        Self { times: vec![0.0], values: vec![value], is_integral: false }
    }

    #[cfg(test)]
    pub fn of_values(times: Vec<f64>, values: impl IntoIterator<Item = f64>) -> Self {
        let values = values.into_iter().map(scalar).collect();
        Self { times, values, is_integral: false }
    }

    pub fn largest(&self) -> f64 {
        let steps = self.times.windows(2).zip(self.values.windows(2));
        match self.is_integral {
            false => self.values.iter().map(|value| value.norm()).fold(0.0, f64::max),
            true => steps
                .filter(|(times, _)| times[0] < times[1])
                .map(|(times, values)| (values[1] - values[0]).norm() / (times[1] - times[0]))
                .fold(0.0, f64::max),
        }
    }

    pub fn range(&self) -> f64 {
        let first = self.values.first().copied().unwrap_or_default();
        self.values.iter().map(|value| (value - first).norm()).fold(0.0, f64::max)
    }

    /// Distances of a coarser trace from this trace at the times of the coarser trace [time, dimension of the values].
    /// If the values are time integrals, the means of the integrand over the steps of the coarser trace are compared.
    pub fn distances(&self, coarser: &Self) -> Vec<(f64, f64)> {
        let differences = self.differences(coarser, coarser).into_iter();
        differences.map(|(time, difference)| (time, difference.norm())).collect()
    }

    /// Differences of another trace from this trace at the times of a third trace.
    /// If the values are time integrals, the means of the integrand over the steps of the third trace are compared.
    pub fn differences(&self, other: &Self, of_times: &Self) -> Vec<(f64, Vec2)> {
        let difference = |time: f64| Some((time, other.at(time)? - self.at(time)?));
        let all: Vec<(f64, Vec2)> =
            of_times.times.iter().filter_map(|time| difference(*time)).collect();
        if !self.is_integral {
            return all;
        }
        let over_step = |pair: &[(f64, Vec2)]| {
            let ((start, before), (end, after)) = (pair[0], pair[1]);
            (end > start).then(|| (end, (after - before) / (end - start)))
        };
        all.windows(2).filter_map(over_step).collect()
    }

    /// Returns the value at a time, by cubic interpolation between recorded times; `None` outside the trace.
    /// If one of these times is that of an event with several rows, the interpolation is linear.
    fn at(&self, time: f64) -> Option<Vec2> {
        let (first, last) = (*self.times.first()?, *self.times.last()?);
        let slack = SAME_TIME * (last - first);
        let after = self.times.partition_point(|other| *other < time - slack);
        let nearest = self.times.get(after)?;
        if (nearest - time).abs() <= slack {
            // At an event, several rows have the same time; the last one is the value after the event.
            let equal = self.times[after..].iter().take_while(|other| **other <= time + slack);
            return Some(self.values[after + equal.count() - 1]);
        }
        let from = after.checked_sub(1)?.saturating_sub(1).min(self.times.len().saturating_sub(4));
        let to = (from + 4).min(self.times.len());
        let (times, values) = (&self.times[from..to], &self.values[from..to]);
        if times.windows(2).any(|pair| pair[0] >= pair[1]) {
            let (start, end) = (self.times[after - 1], self.times[after]);
            let share = (time - start) / (end - start);
            return Some(self.values[after - 1] * (1.0 - share) + self.values[after] * share);
        }
        let weight = |index: usize| -> f64 {
            let others = times.iter().enumerate().filter(|(other, _)| *other != index);
            others.map(|(_, other)| (time - other) / (times[index] - other)).product()
        };
        Some(values.iter().enumerate().map(|(index, value)| value * weight(index)).sum())
    }
}

fn scalar(value: f64) -> Vec2 {
    Vec2::new(value, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cubic(times: &[f64]) -> Trace {
        Trace::of_values(times.to_vec(), times.iter().map(|t| t * t * (t - 1.0)))
    }

    #[test]
    fn traces_are_interpolated_by_cubics_at_other_times() {
        let fine = cubic(&[0.0, 0.3, 0.5, 1.0, 1.5, 1.6]);
        let coarse = cubic(&[0.0, 0.1, 0.4, 0.7, 1.5, 1.55]);
        let distances = fine.distances(&coarse);
        assert_eq!(distances.len(), 6);
        assert!(distances.iter().all(|(_, distance)| *distance < 1e-14), "{distances:?}");
        assert_eq!(fine.distances(&cubic(&[2.0])), []);
    }

    #[test]
    fn trace_comparison_uses_the_value_after_an_event() {
        let fine = Trace::of_values(vec![0.0, 1.0, 1.0, 2.0], [0.0, 1.0, 5.0, 6.0]);
        let coarse = Trace::of_values(vec![0.0, 1.0, 1.5], [0.0, 5.0, 5.5]);
        assert_eq!(fine.distances(&coarse), [(0.0, 0.0), (1.0, 0.0), (1.5, 0.0)]);
    }

    #[test]
    fn step_means_are_compared_over_equal_intervals() {
        let integral = |times: &[f64]| Trace {
            is_integral: true,
            ..Trace::of_values(times.to_vec(), times.iter().map(|t| t * t))
        };
        let (fine, coarse) = (integral(&[0.0, 1.0, 2.0, 3.0, 4.0]), integral(&[0.0, 2.0, 4.0]));
        assert_eq!(fine.distances(&coarse), [(2.0, 0.0), (4.0, 0.0)]);
        assert_eq!(coarse.largest(), 6.0);
    }
}
