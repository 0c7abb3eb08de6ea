//! The rates of a model, and what its last steps tell of the next.

use super::accelerations::Accelerations;
use super::forecast::{Forecast, Trend};
use super::{MonitoredBody, Resolution, StepMeasures};

/// The present time and rates of a model, and what was learnt of its motion.
pub struct MotionState {
    /// The present time: the end of the last step [time].
    pub time: f64,
    /// The rates of the unknown movements at the present time [length/time, 1/time].
    pub rates: Vec<f64>,
    pub accelerations: Accelerations,
    forecast: Forecast,
    resolution: Resolution,
    /// Bodies that are judged by themselves; none where all is one of them.
    watched: Vec<MonitoredBody>,
}

impl MotionState {
    /// The motion at t = 0 with some rates; motions below the energy `noise` are rounding [energy].
    pub fn new(rates: Vec<f64>, noise: f64) -> Self {
        Self {
            time: 0.0,
            forecast: Forecast::new(&rates, Vec::new()),
            rates,
            accelerations: Accelerations::default(),
            resolution: Resolution::above(noise),
            watched: Vec::new(),
        }
    }

    /// Guesses the first step from the present rates, in the norm of the diagonal of the inertia matrix.
    pub fn begin(&mut self, inertia: Vec<f64>) {
        self.forecast = Forecast::new(&self.rates, inertia);
    }

    /// Judges bodies by themselves from here on, each by its number and the places of its movements among the unknowns.
    pub fn watch(&mut self, bodies: impl Iterator<Item = (usize, Vec<usize>)>) {
        let noise = self.resolution.noise();
        self.watched = bodies.map(|(body, at)| MonitoredBody::new(body, at, noise)).collect();
    }

    /// Bodies that are judged by themselves.
    pub fn watched(&self) -> &[MonitoredBody] {
        &self.watched
    }

    /// Goes on with the same motion in rates of other unknowns, in the norm of the diagonal of their inertia: nothing jumps but accelerations. Told are the places of
    /// the movements of a body, by its number.
    pub fn renumber(
        &mut self,
        rates: Vec<f64>,
        inertia: Vec<f64>,
        mut movements: impl FnMut(usize) -> Vec<usize>,
    ) {
        for one in &mut self.watched {
            one.renumber(movements(one.body));
        }
        self.accelerations.resize(inertia.len());
        self.rates = rates;
        self.begin(inertia);
    }

    /// The rates with which the movements of the next step may be guessed [length/time, 1/time].
    pub fn expected_rates(&self) -> &[f64] {
        self.forecast.rates(&self.rates)
    }

    /// How far the steps so far resolve the motion of the model.
    pub fn resolution(&self) -> &Resolution {
        &self.resolution
    }

    /// Accepts the increments of a step and the rates at its end, and learns from them for the next.
    pub fn advance(&mut self, step: &StepMeasures, increments: &[f64], rates: &[f64]) {
        let duration = step.interval.duration();
        for one in &mut self.watched {
            one.add(&self.forecast, &self.rates, increments, duration);
        }
        let missed = self.forecast.learn(&self.rates, increments, duration);
        self.resolution.add(&missed, duration, step.summary.rotation, step.rotations);
        self.rates.copy_from_slice(rates);
        self.time = step.interval.end;
    }

    /// Takes over a sudden change of all rates [length/time, 1/time].
    pub fn jump(&mut self, change: &[f64]) {
        self.rates.iter_mut().zip(change).for_each(|(rate, change)| *rate += change);
        self.forecast.jump(change);
        self.accelerations.forget();
    }

    /// What the next step is guessed from: the part of the state that is no number.
    pub fn trend(&self) -> Trend {
        self.forecast.trend()
    }

    /// Appends time, rates and what was learnt of the motion in numbers; accelerations are saved by themselves.
    pub fn save(&self, numbers: &mut Vec<f64>) {
        numbers.push(self.time);
        numbers.extend(&self.rates);
        self.forecast.save(numbers);
        self.resolution.save(numbers);
        self.watched.iter().for_each(|one| one.save(numbers));
    }

    /// Takes time, rates and what was learnt of the motion back, in the order in which they were appended.
    pub fn restore(&mut self, trend: Trend, next: &mut dyn FnMut() -> f64) {
        self.time = next();
        self.rates.iter_mut().for_each(|rate| *rate = next());
        self.forecast.restore(trend, next);
        self.resolution.restore(next);
        self.watched.iter_mut().for_each(|one| one.restore(next));
    }
}
