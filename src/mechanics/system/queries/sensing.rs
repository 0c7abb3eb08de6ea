//! Evaluation of sensors.

use super::{CrossSection, Transmission};
use crate::beams::{BodyIndex, BodyPoint};
use crate::integrators::Mechanism;
use crate::joints::Wrench;
use crate::system::sensors::quantities::QuantityReader;
use crate::system::{
    Instant, Quantity, Reactions, Scene, Sensor, SensorSource, System, SystemError, ValueTime,
};

/// Sensors of a scene, located in its model.
#[derive(Debug, Clone, Default)]
pub struct SensorReader {
    located: Vec<(Located, &'static Quantity)>,
    needs_instant: bool,
    needs_mean: bool,
    values: Vec<f64>,
}

#[derive(Debug, Clone)]
enum Located {
    Point(BodyPoint),
    Section(CrossSection),
    Joint(Transmission),
    Number(usize),
    Source(SensorSource),
}

impl SensorReader {
    /// Locates sensors of a scene.
    ///
    /// # Errors
    /// Fails if a station lies outside its beam, or if a section force of a particle or a rigid body is requested.
    pub fn of(sensors: &[Sensor], scene: &Scene, model: &System) -> Result<Self, SystemError> {
        let located =
            sensors.iter().map(|sensor| Ok((sensor.locate(scene, model)?, sensor.quantity)));
        let located = located.collect::<Result<Vec<_>, SystemError>>()?;
        let values = Vec::with_capacity(located.len());
        let needs_instant = sensors.iter().any(|one| one.quantity.timing == ValueTime::Instant);
        let needs_mean = sensors.iter().any(Sensor::is_mean_of_joint);
        Ok(Self { located, needs_instant, needs_mean, values })
    }

    /// Evaluates all sensors. The values of unavailable quantities, and of quantities provided by the caller, are NaN.
    pub fn read(&mut self, model: &mut System) -> &[f64] {
        self.values.clear();
        let now = if self.needs_instant { model.instant().ok() } else { None };
        let mean = if self.needs_mean { model.mean_reactions() } else { None };
        for (located, quantity) in &self.located {
            let reactions = match quantity.timing {
                ValueTime::SummedMean => mean.as_ref(),
                _ => now.as_ref().map(Instant::reactions),
            };
            let value = located.read(quantity.read, model, (now.as_ref(), reactions));
            self.values.push(value.unwrap_or(f64::NAN));
        }
        &self.values
    }
}

impl Sensor {
    fn locate(&self, scene: &Scene, model: &System) -> Result<Located, SystemError> {
        Ok(match &self.source {
            SensorSource::Station(station) => match self.quantity.read {
                QuantityReader::Section(_) => {
                    Located::Section(model.cross_section(scene, station)?)
                }
                QuantityReader::Angle => model
                    .tracked_section(scene, station)
                    .map_or(Located::Source(SensorSource::External), Located::Number),
                _ => Located::Point(scene.place(station, model.meshes())?),
            },
            SensorSource::Body(BodyIndex::Beam(beam)) => Located::Number(*beam),
            SensorSource::Body(BodyIndex::Particle(at)) => Located::Number(scene.beams.len() + at),
            SensorSource::Body(BodyIndex::Rigid(body, _)) => {
                Located::Number(scene.first_rigid_body() + body)
            }
            SensorSource::Joint(joint) => Located::Joint(model.transmission(scene, *joint)?),
            source => Located::Source(*source),
        })
    }
}

impl Located {
    /// Value of a quantity; `None` if it is unavailable or provided by the caller.
    fn read(
        &self,
        read: QuantityReader,
        model: &mut System,
        (now, reactions): (Option<&Instant>, Option<&Reactions>),
    ) -> Option<f64> {
        use SensorSource::{Drive, InternalForce, Load, Slider};
        Some(match (self, read) {
            (Self::Point(at), QuantityReader::Motion(read)) => read(model, at),
            (Self::Point(at), QuantityReader::Acceleration(read)) => {
                read(model.acceleration(now?, at))
            }
            (Self::Number(section), QuantityReader::Angle) => model.section_angle(*section)?,
            (Self::Section(at), QuantityReader::Section(read)) => read(&model.section_forces(at)),
            (Self::Number(body), QuantityReader::Energy(read)) => read(&model.energy_of(*body)),
            (Self::Joint(joint), QuantityReader::Force(read)) => {
                let (force, moment) = joint.read(reactions?);
                read(force, moment)
            }
            (Self::Source(Slider(at)), QuantityReader::Force(read)) => {
                let Wrench { force, couple } = now?.wrench(*at);
                read(force, couple)
            }
            (
                Self::Source(Slider(at) | Drive(at) | Load(at) | InternalForce(at)),
                QuantityReader::Index(read),
            ) => read(model, *at),
            (Self::Source(source), QuantityReader::Sum(read)) => read(model, *source)?,
            _ => return None,
        })
    }
}

impl System {
    pub(crate) fn enable_means_for(&mut self, sensors: &[Sensor]) {
        for sensor in sensors.iter().filter(|sensor| sensor.is_summed()) {
            match sensor.source {
                SensorSource::Joint(_) => self.accumulate_impulses(),
                _ => self.enable_powers(),
            }
        }
    }

    /// Angular velocity of the section at a point of a body [1/time].
    pub fn spin(&self, place: &BodyPoint) -> f64 {
        let [_, _, spin] = self.bodies()[place.body].at(place, self.rates());
        spin
    }
}
