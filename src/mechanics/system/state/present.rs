//! Rates of a model, and the prediction of the next step.

use super::accelerations::Accelerations;
use super::forecast::{IncrementPrediction, Prediction};
use super::{MonitoredBody, Resolution, StepMeasures};

pub struct MotionState {
    /// Present time, which is the end of the last step [time].
    pub time: f64,
    pub rates: Vec<f64>,
    pub accelerations: Accelerations,
    forecast: IncrementPrediction,
    resolution: Resolution,
    /// Beams with material damping, for which the resolution measures are also computed separately; empty if there is only one body.
    monitored: Vec<MonitoredBody>,
}

impl MotionState {
    /// Starts the motion at t = 0. Kinetic energies below `noise` are attributed to rounding [energy].
    pub fn new(rates: Vec<f64>, noise: f64) -> Self {
        Self {
            time: 0.0,
            forecast: IncrementPrediction::new(&rates, Vec::new()),
            rates,
            accelerations: Accelerations::default(),
            resolution: Resolution::above(noise),
            monitored: Vec::new(),
        }
    }

    pub fn begin(&mut self, inertia: Vec<f64>) {
        self.forecast = IncrementPrediction::new(&self.rates, inertia);
    }

    pub fn measure_resolution_of(&mut self, bodies: impl Iterator<Item = (usize, Vec<usize>)>) {
        let noise = self.resolution.noise();
        self.monitored = bodies.map(|(body, at)| MonitoredBody::new(body, at, noise)).collect();
    }

    pub fn watched(&self) -> &[MonitoredBody] {
        &self.monitored
    }

    pub fn renumber(
        &mut self,
        rates: Vec<f64>,
        inertia: Vec<f64>,
        mut movements: impl FnMut(usize) -> Vec<usize>,
    ) {
        for one in &mut self.monitored {
            one.renumber(movements(one.body));
        }
        self.accelerations.resize(inertia.len());
        self.rates = rates;
        self.begin(inertia);
    }

    /// Predicted rates of the next step [length/time, 1/time].
    pub fn expected_rates(&self) -> &[f64] {
        self.forecast.rates(&self.rates)
    }

    pub fn resolution(&self) -> &Resolution {
        &self.resolution
    }

    pub fn advance(&mut self, step: &StepMeasures, increments: &[f64], rates: &[f64]) {
        let duration = step.interval.duration();
        for one in &mut self.monitored {
            one.add(&self.forecast, &self.rates, increments, duration);
        }
        let missed = self.forecast.update(&self.rates, increments, duration);
        self.resolution.add(&missed, duration, step.summary.rotation, step.rotations);
        self.rates.copy_from_slice(rates);
        self.time = step.interval.end;
    }

    pub fn jump(&mut self, change: &[f64]) {
        self.rates.iter_mut().zip(change).for_each(|(rate, change)| *rate += change);
        self.forecast.jump(change);
        self.accelerations.mark_unknown();
    }

    pub fn trend(&self) -> Prediction {
        self.forecast.trend()
    }

    pub fn save(&self, numbers: &mut Vec<f64>) {
        numbers.push(self.time);
        numbers.extend(&self.rates);
        self.forecast.save(numbers);
        self.resolution.save(numbers);
        self.monitored.iter().for_each(|one| one.save(numbers));
    }

    pub fn restore(&mut self, trend: Prediction, next: &mut dyn FnMut() -> f64) {
        self.time = next();
        self.rates.iter_mut().for_each(|rate| *rate = next());
        self.forecast.restore(trend, next);
        self.resolution.restore(next);
        self.monitored.iter_mut().for_each(|one| one.restore(next));
    }
}
