//! Reading the sensors of a scene.

use crate::beams::{BodyIndex, Place, Station};
use crate::geometry::Vec2;
use crate::integrators::Mechanism;
use crate::model::{
    BodyEnergy, CrossSection, Instant, Model, ModelError, Probe, Scene, Transmission, Value,
};

/// The sensors of a scene, found in its model once.
#[derive(Debug, Clone, Default)]
pub struct Sensing {
    readings: Vec<Reading>,
    /// Whether one of them needs accelerations or forces.
    needs_instant: bool,
    values: Vec<f64>,
}

#[derive(Debug, Clone)]
enum Reading {
    Place(Place, Value),
    Angle(usize),
    Section(CrossSection, Value),
    Body(usize, Value),
    Joint(Transmission, Value),
    Outside,
}

impl Sensing {
    /// The sensors of a scene.
    ///
    /// # Errors
    /// When the force of a joint is not determined.
    pub fn of(scene: &Scene, model: &Model) -> Result<Self, ModelError> {
        let readings = scene.sensors.iter().map(|sensor| match &sensor.probe {
            Probe::Station(station, quantity) => at_station(scene, model, station, quantity.value),
            Probe::Body(BodyIndex::Beam(beam), quantity) => {
                Ok(Reading::Body(*beam, quantity.value))
            }
            Probe::Body(BodyIndex::Particle(particle), quantity) => {
                Ok(Reading::Body(scene.beams.len() + particle, quantity.value))
            }
            Probe::Body(BodyIndex::Rigid(body, _), quantity) => {
                let first = scene.beams.len() + scene.particles.len();
                Ok(Reading::Body(first + body, quantity.value))
            }
            Probe::Joint(joint, quantity) => {
                Ok(Reading::Joint(model.transmission(scene, *joint)?, quantity.value))
            }
            Probe::Outside => Ok(Reading::Outside),
        });
        let readings = readings.collect::<Result<Vec<_>, ModelError>>()?;
        let needs_instant = readings.iter().any(|reading| {
            use Value::{AccelerationX, AccelerationY};
            matches!(reading, Reading::Joint(..) | Reading::Place(_, AccelerationX | AccelerationY))
        });
        Ok(Self { values: Vec::with_capacity(readings.len()), readings, needs_instant })
    }

    /// Reads all; what cannot be had, and what somebody outside is to fill in, is not a number.
    pub fn read(&mut self, model: &mut Model) -> &[f64] {
        self.values.clear();
        let now = if self.needs_instant { model.instant().ok() } else { None };
        for reading in &self.readings {
            self.values.push(value(reading, model, now.as_ref()).unwrap_or(f64::NAN));
        }
        &self.values
    }
}

fn at_station(
    scene: &Scene,
    model: &Model,
    station: &Station,
    value: Value,
) -> Result<Reading, ModelError> {
    Ok(match value {
        Value::Axial
        | Value::Shear
        | Value::Moment
        | Value::AxialStrain
        | Value::ShearStrain
        | Value::Curvature => Reading::Section(model.cross_section(scene, station)?, value),
        Value::Angle => match model.followed_section(scene, station) {
            Some(section) => Reading::Angle(section),
            None => Reading::Outside,
        },
        _ => Reading::Place(scene.place(station, model.meshes())?, value),
    })
}

fn value(reading: &Reading, model: &mut Model, now: Option<&Instant>) -> Option<f64> {
    match reading {
        Reading::Place(place, value) => at_place(place, *value, model, now),
        Reading::Angle(section) => model.section_angle(*section),
        Reading::Section(section, value) => {
            let forces = model.section_forces(section);
            Some(match value {
                Value::Axial => forces.axial,
                Value::Shear => forces.shear,
                Value::Moment => forces.moment,
                Value::AxialStrain => forces.axial_strain,
                Value::ShearStrain => forces.shear_strain,
                _ => forces.curvature,
            })
        }
        Reading::Body(body, value) => Some(of_energy(&model.energy_of(*body), *value)),
        Reading::Joint(joint, value) => {
            let (force, moment) = joint.read(now?);
            Some(match value {
                Value::Force => force.norm(),
                Value::ForceX => force.x,
                Value::ForceY => force.y,
                _ => moment,
            })
        }
        Reading::Outside => None,
    }
}

fn at_place(place: &Place, value: Value, model: &Model, now: Option<&Instant>) -> Option<f64> {
    let acceleration = || -> Option<Vec2> { Some(model.acceleration(now?, place)) };
    Some(match value {
        Value::X => model.position(place).x,
        Value::Y => model.position(place).y,
        Value::VelocityX => model.velocity(place).x,
        Value::VelocityY => model.velocity(place).y,
        Value::Speed => model.velocity(place).norm(),
        Value::AccelerationX => acceleration()?.x,
        Value::AccelerationY => acceleration()?.y,
        _ => model.spin(place),
    })
}

fn of_energy(energy: &BodyEnergy, value: Value) -> f64 {
    match value {
        Value::Kinetic => energy.kinetic,
        Value::Strain => energy.strain(),
        Value::StrainAxial => energy.axial,
        Value::StrainShear => energy.shear,
        Value::StrainBending => energy.bending,
        Value::Potential => energy.potential,
        _ => energy.total(),
    }
}

impl Model {
    /// The angular velocity of the section at a place [1/time].
    pub fn spin(&self, place: &Place) -> f64 {
        let [_, _, spin] = self.bodies()[place.body].at(place, self.rates());
        spin
    }
}
