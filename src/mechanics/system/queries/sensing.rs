//! Evaluation of the sensors of a scene.

use crate::beams::{BodyIndex, BodyPoint, Station};
use crate::geometry::Vec2;
use crate::integrators::Mechanism;
use crate::system::{
    BodyEnergy, CrossSection, Instant, Reactions, Scene, SensorSource, System, SystemError,
    Transmission, Value,
};

/// Sensors of a scene, with their places located in its model.
#[derive(Debug, Clone, Default)]
pub struct SensorReader {
    readings: Vec<SensorReading>,
    needs_instant: bool,
    needs_mean: bool,
    values: Vec<f64>,
}

#[derive(Debug, Clone)]
enum SensorReading {
    Place(BodyPoint, Value),
    Angle(usize),
    Section(CrossSection, Value),
    Body(usize, Value),
    Joint(Transmission, Value),
    MeanJointForce(Transmission, Value),
    Contact(usize, Value),
    External,
}

impl SensorReader {
    /// Locates the sensors of a scene.
    ///
    /// # Errors
    /// Fails if the force of a joint is not determined.
    pub fn of(scene: &Scene, model: &System) -> Result<Self, SystemError> {
        let readings = scene.sensors.iter().map(|sensor| match &sensor.probe {
            SensorSource::Station(station, quantity) => {
                at_station(scene, model, station, quantity.value)
            }
            SensorSource::Body(BodyIndex::Beam(beam), quantity) => {
                Ok(SensorReading::Body(*beam, quantity.value))
            }
            SensorSource::Body(BodyIndex::Particle(particle), quantity) => {
                Ok(SensorReading::Body(scene.beams.len() + particle, quantity.value))
            }
            SensorSource::Body(BodyIndex::Rigid(body, _), quantity) => {
                let first = scene.first_rigid_body();
                Ok(SensorReading::Body(first + body, quantity.value))
            }
            SensorSource::Joint(joint, quantity) => {
                let transmission = model.transmission(scene, *joint)?;
                Ok(match quantity.value.is_of_step() {
                    true => SensorReading::MeanJointForce(transmission, quantity.value),
                    false => SensorReading::Joint(transmission, quantity.value),
                })
            }
            SensorSource::Slider(slider, quantity) => {
                Ok(SensorReading::Contact(*slider, quantity.value))
            }
            SensorSource::External => Ok(SensorReading::External),
        });
        let readings = readings.collect::<Result<Vec<_>, SystemError>>()?;
        let needs_instant = readings.iter().any(|reading| {
            use Value::{AccelerationX, AccelerationY};
            let of_moment = |value: &Value| matches!(value, AccelerationX | AccelerationY);
            match reading {
                SensorReading::Joint(..) | SensorReading::Contact(..) => true,
                SensorReading::Place(_, value) => of_moment(value),
                _ => false,
            }
        });
        let of_step =
            |reading: &SensorReading| matches!(reading, SensorReading::MeanJointForce(..));
        let needs_mean = readings.iter().any(of_step);
        let values = Vec::with_capacity(readings.len());
        Ok(Self { values, readings, needs_instant, needs_mean })
    }

    /// Returns true if a sensor needs the mean forces of joints and supports over a step.
    pub(crate) fn need_mean_forces(&self) -> bool {
        self.needs_mean
    }

    /// Evaluates all sensors. Values that are unavailable or provided by the caller are NaN.
    pub fn read(&mut self, model: &mut System) -> &[f64] {
        self.values.clear();
        let now = if self.needs_instant { model.instant().ok() } else { None };
        let mean = if self.needs_mean { model.mean_reactions() } else { None };
        let at = SensorContext { instant: now.as_ref(), mean: mean.as_ref() };
        for reading in &self.readings {
            self.values.push(value(reading, model, at).unwrap_or(f64::NAN));
        }
        &self.values
    }
}

fn at_station(
    scene: &Scene,
    model: &System,
    station: &Station,
    value: Value,
) -> Result<SensorReading, SystemError> {
    Ok(match value {
        Value::Axial
        | Value::Shear
        | Value::Moment
        | Value::AxialStrain
        | Value::ShearStrain
        | Value::Curvature => SensorReading::Section(model.cross_section(scene, station)?, value),
        Value::Angle => match model.tracked_section(scene, station) {
            Some(section) => SensorReading::Angle(section),
            None => SensorReading::External,
        },
        _ => SensorReading::Place(scene.place(station, model.meshes())?, value),
    })
}

/// Quantities of a model that several sensors share, computed before they are read.
#[derive(Clone, Copy)]
struct SensorContext<'a> {
    instant: Option<&'a Instant>,
    mean: Option<&'a Reactions>,
}

fn value(reading: &SensorReading, model: &mut System, at: SensorContext<'_>) -> Option<f64> {
    match reading {
        SensorReading::Place(place, value) => at_place(place, *value, model, at.instant),
        SensorReading::Angle(section) => model.section_angle(*section),
        SensorReading::Section(section, value) => {
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
        SensorReading::Body(body, value) => Some(of_energy(&model.energy_of(*body), *value)),
        SensorReading::Joint(joint, value) => {
            Some(of_force(joint.read(at.instant?.reactions()), *value))
        }
        SensorReading::Contact(slider, value) => {
            Some(of_force((at.instant?.contact(*slider), 0.0), *value))
        }
        SensorReading::MeanJointForce(joint, value) => Some(of_force(joint.read(at.mean?), *value)),
        SensorReading::External => None,
    }
}

fn at_place(place: &BodyPoint, value: Value, model: &System, now: Option<&Instant>) -> Option<f64> {
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

fn of_force((force, moment): (Vec2, f64), value: Value) -> f64 {
    match value {
        Value::Force | Value::MeanForce => force.norm(),
        Value::ForceX | Value::MeanForceX => force.x,
        Value::ForceY | Value::MeanForceY => force.y,
        _ => moment,
    }
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

impl System {
    /// Angular velocity of the section at a place [1/time].
    pub fn spin(&self, place: &BodyPoint) -> f64 {
        let [_, _, spin] = self.bodies()[place.body].at(place, self.rates());
        spin
    }
}
