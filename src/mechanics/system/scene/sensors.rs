//! Recorded quantities of a scene in addition to the standard ones.
//!
//! Built-in sensors have names composed of object, place and quantity: `rod.end.x`, `rod[0.5].M`, `rod.energy`, `hinge1.force`.

use serde::{Serialize, Serializer};

use super::Scene;
use crate::beams::{BodyIndex, Station};
use crate::joints::{Joint, JointKind, Partner};
use crate::system::SystemError;
use crate::system::errors::check_name;

/// Word for a sensor in messages about its name.
const COLUMN: &str = "column";

/// Recorded quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Name of the column.
    pub name: String,
    /// Source of the values.
    pub probe: SensorSource,
}

/// Source of the values of a sensor.
#[derive(Debug, Clone, PartialEq)]
pub enum SensorSource {
    /// Quantity of a station or of its support.
    Station(Station, Quantity),
    /// Quantity of a whole beam, particle or rigid body.
    Body(BodyIndex, Quantity),
    /// Quantity of a joint.
    Joint(usize, Quantity),
    /// Quantity of the contact of a slider.
    Slider(usize, Quantity),
    /// Value that the caller provides after every row.
    External,
}

/// Quantity with its name, dimension and the rule for its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quantity {
    /// Name as part of sensor names.
    pub name: &'static str,
    /// Dimension of the quantity.
    pub dimension: &'static str,
    /// Rule for the value.
    pub value: Value,
}

/// Value of a station, body, joint or slider.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names of the quantities say it")]
pub enum Value {
    X,
    Y,
    VelocityX,
    VelocityY,
    Speed,
    AccelerationX,
    AccelerationY,
    Angle,
    Spin,
    Axial,
    Shear,
    Moment,
    AxialStrain,
    ShearStrain,
    Curvature,
    Force,
    ForceX,
    ForceY,
    Couple,
    MeanForce,
    MeanForceX,
    MeanForceY,
    MeanCouple,
    Energy,
    Kinetic,
    Strain,
    StrainAxial,
    StrainShear,
    StrainBending,
    Potential,
}

impl Value {
    /// Returns true if the value is an average over the last step and not an instantaneous value.
    pub(crate) fn is_of_step(self) -> bool {
        matches!(self, Self::MeanForce | Self::MeanForceX | Self::MeanForceY | Self::MeanCouple)
    }
}

const fn quantity(name: &'static str, dimension: &'static str, value: Value) -> Quantity {
    Quantity { name, dimension, value }
}

/// Quantities of stations. Particles have the first seven of the list, points of rigid bodies the first nine.
pub const OF_STATIONS: &[Quantity] = &[
    quantity("x", "length", Value::X),
    quantity("y", "length", Value::Y),
    quantity("vx", "length/time", Value::VelocityX),
    quantity("vy", "length/time", Value::VelocityY),
    quantity("speed", "length/time", Value::Speed),
    quantity("ax", "length/time²", Value::AccelerationX),
    quantity("ay", "length/time²", Value::AccelerationY),
    quantity("angle", "rad", Value::Angle),
    quantity("spin", "1/time", Value::Spin),
    quantity("N", "force", Value::Axial),
    quantity("Q", "force", Value::Shear),
    quantity("M", "force·length", Value::Moment),
    quantity("axial_strain", "-", Value::AxialStrain),
    quantity("shear_strain", "-", Value::ShearStrain),
    quantity("curvature", "1/length", Value::Curvature),
];

const OF_PARTICLES: usize = 7;

const OF_POINTS: usize = 9;

/// Quantities of joints: the force on the first station, averaged over the last step and instantaneous.
pub const OF_JOINTS: &[Quantity] = &[
    quantity("force", "force", Value::MeanForce),
    quantity("fx", "force", Value::MeanForceX),
    quantity("fy", "force", Value::MeanForceY),
    quantity("moment", "force·length", Value::MeanCouple),
    quantity("present_force", "force", Value::Force),
    quantity("present_fx", "force", Value::ForceX),
    quantity("present_fy", "force", Value::ForceY),
    quantity("present_moment", "force·length", Value::Couple),
];

/// Quantities of sliders in addition to those that every history contains: the instantaneous force on the master.
pub const OF_SLIDERS: &[Quantity] = &[
    quantity("present_force", "force", Value::Force),
    quantity("present_force_x", "force", Value::ForceX),
    quantity("present_force_y", "force", Value::ForceY),
];

/// Quantities of a whole body.
pub const OF_BODIES: &[Quantity] = &[
    quantity("energy", "energy", Value::Energy),
    quantity("kinetic", "energy", Value::Kinetic),
    quantity("strain", "energy", Value::Strain),
    quantity("axial", "energy", Value::StrainAxial),
    quantity("shear", "energy", Value::StrainShear),
    quantity("bending", "energy", Value::StrainBending),
    quantity("potential", "energy", Value::Potential),
];

impl Sensor {
    /// Dimension of the values.
    pub fn dimension(&self) -> &'static str {
        match &self.probe {
            SensorSource::Station(_, quantity)
            | SensorSource::Body(_, quantity)
            | SensorSource::Joint(_, quantity)
            | SensorSource::Slider(_, quantity) => quantity.dimension,
            SensorSource::External => "-",
        }
    }

    /// Returns true if the values are averages over the last step.
    pub(crate) fn is_of_step(&self) -> bool {
        matches!(&self.probe, SensorSource::Joint(_, quantity) if quantity.value.is_of_step())
    }

    /// Returns true if the sensor can be stored, that is, if it can be created again from its name.
    pub fn can_be_stored(&self) -> bool {
        self.probe != SensorSource::External
    }
}

/// A sensor is stored by its name.
impl Serialize for Sensor {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.can_be_stored() {
            true => self.name.serialize(serializer),
            false => Err(serde::ser::Error::custom("a function cannot be stored")),
        }
    }
}

impl Scene {
    /// Records a built-in quantity, given by its name.
    ///
    /// # Errors
    /// Fails if the object, place or quantity does not exist, or if the quantity is recorded already.
    pub fn record(&mut self, name: &str) -> Result<(), SystemError> {
        self.check_column(name)?;
        let probe = self.find_sensor(name)?;
        if let SensorSource::Station(station, Quantity { value: Value::Angle, .. }) = probe
            && let Some(beam) = station.beam()
        {
            self.station(beam, station.arc_length)?;
        }
        self.sensors.push(Sensor { name: name.to_owned(), probe });
        Ok(())
    }

    /// Adds a column that the caller fills after every row.
    ///
    /// # Errors
    /// Fails if the column exists, or the name has invisible characters or characters that cannot be typed.
    pub fn record_outside(&mut self, name: &str) -> Result<(), SystemError> {
        check_name(COLUMN, name)?;
        self.check_column(name)?;
        self.sensors.push(Sensor { name: name.to_owned(), probe: SensorSource::External });
        Ok(())
    }

    fn check_column(&self, name: &str) -> Result<(), SystemError> {
        if name.contains([',', '"']) {
            let why = "it has a comma or a quotation mark";
            return Err(SystemError::Unnamed { kind: COLUMN, name: name.to_owned(), reason: why });
        }
        match self.sensors.iter().any(|sensor| sensor.name == name) {
            true => Err(SystemError::DuplicateSensor { name: name.to_owned() }),
            false => Ok(()),
        }
    }

    /// Names of all built-in sensors, except those at places inside beams.
    pub fn sensor_names(&self) -> Vec<String> {
        let listed = |object: String, quantities: &'static [Quantity]| {
            quantities.iter().map(move |quantity| format!("{object}.{}", quantity.name))
        };
        let beams = self.beams.iter().flat_map(|beam| {
            let ends = ["start", "end"].map(|end| format!("{}.{end}", beam.name));
            let of_ends = ends.into_iter().flat_map(move |end| listed(end, OF_STATIONS));
            of_ends.chain(listed(beam.name.clone(), OF_BODIES))
        });
        let particles = self.particles.iter().flat_map(|particle| {
            listed(particle.name.clone(), &OF_STATIONS[..OF_PARTICLES])
                .chain(listed(particle.name.clone(), OF_BODIES))
        });
        let rigid = self.rigid_bodies.iter().flat_map(|body| {
            let points = body.points.iter().map(|(point, _)| format!("{}.{point}", body.name));
            let places = std::iter::once(body.name.clone()).chain(points);
            let of_places = places.flat_map(move |place| listed(place, &OF_STATIONS[..OF_POINTS]));
            of_places.chain(listed(body.name.clone(), OF_BODIES))
        });
        let joints = self.joint_names().into_iter().flat_map(|joint| listed(joint, OF_JOINTS));
        let sliders = self.sliders.iter().map(|slider| slider.name.clone());
        let sliders = sliders.flat_map(|slider| listed(slider, OF_SLIDERS));
        beams.chain(particles).chain(rigid).chain(joints).chain(sliders).collect()
    }

    /// Names of the joints for sensors, in the order of the joints: `hinge1`, `clamp1`, `hinge2`, `rigid1`, `support1`.
    pub fn joint_names(&self) -> Vec<String> {
        let mut counts = [0; 4];
        let name = |joint: &Joint| {
            let (kind, at) = match (joint.kind, &joint.partner) {
                (JointKind::Hinge, _) => ("hinge", 0),
                (JointKind::Rigid, Partner::Ground) => ("clamp", 1),
                (JointKind::Rigid, Partner::Station(_)) => ("rigid", 2),
                (
                    JointKind::Support(_)
                    | JointKind::InclinedRoller(_)
                    | JointKind::InclinedGuide(_),
                    _,
                ) => ("support", 3),
            };
            counts[at] += 1;
            format!("{kind}{}", counts[at])
        };
        self.joints.iter().map(name).collect()
    }

    fn find_sensor(&self, name: &str) -> Result<SensorSource, SystemError> {
        let refused = |why: String| SystemError::NoSensor { name: name.to_owned(), reason: why };
        let of = |known: &str| {
            let rest = name.strip_prefix(known)?;
            (rest.starts_with('.') || rest.starts_with('[')).then_some((known.len(), rest))
        };
        let beams = self.beams.iter().enumerate();
        let beams = beams.filter_map(|(at, beam)| Some((of(&beam.name)?, Object::Beam(at))));
        let particles = self.particles.iter().enumerate();
        let particles =
            particles.filter_map(|(at, of_one)| Some((of(&of_one.name)?, Object::Particle(at))));
        let names = self.joint_names();
        let joints = names.iter().enumerate();
        let joints = joints.filter_map(|(at, joint)| Some((of(joint)?, Object::Joint(at))));
        let rigid = self.rigid_bodies.iter().enumerate();
        let rigid = rigid.filter_map(|(at, body)| Some((of(&body.name)?, Object::Rigid(at))));
        let sliders = self.sliders.iter().enumerate();
        let sliders =
            sliders.filter_map(|(at, slider)| Some((of(&slider.name)?, Object::Slider(at))));
        // A name may be the beginning of another name. Of equal names the first is used.
        let all = beams.chain(particles).chain(rigid).chain(joints).chain(sliders);
        let longest = all.reduce(|best, other| if other.0.0 > best.0.0 { other } else { best });
        let mut others = self.springs().map(|spring| &spring.name);
        let Some(((_, rest), object)) = longest else {
            if let Some(other) = others.find(|known| of(known).is_some()) {
                return Err(refused(format!(
                    "springs such as '{other}' have columns in every history and need no recording"
                )));
            }
            if let Some(drive) = self.drives.iter().find(|drive| of(&drive.name).is_some()) {
                return Err(refused(format!(
                    "drives such as '{}' have columns in every history and need no recording",
                    drive.name
                )));
            }
            return Err(refused(
                "it must begin with the name of a beam, particle, body, slider or joint (hinge1, clamp1, rigid1) of the scene".to_owned(),
            ));
        };
        let find = |known: &'static [Quantity], rest: &str| {
            let wanted = rest.strip_prefix('.').unwrap_or_default();
            known.iter().find(|quantity| quantity.name == wanted).copied().ok_or_else(|| {
                let names: Vec<&str> = known.iter().map(|quantity| quantity.name).collect();
                refused(format!("its last part must be one of {}", names.join(", ")))
            })
        };
        match object {
            Object::Joint(at) => Ok(SensorSource::Joint(at, find(OF_JOINTS, rest)?)),
            Object::Slider(at) => match find(OF_SLIDERS, rest) {
                Ok(quantity) => Ok(SensorSource::Slider(at, quantity)),
                Err(_) => Err(refused(format!(
                    "position, speed and force of slider '{}' have columns in every history and need no recording; its other quantities are {}",
                    self.sliders[at].name,
                    OF_SLIDERS.iter().map(|quantity| quantity.name).collect::<Vec<_>>().join(", ")
                ))),
            },
            Object::Particle(at) => match find(OF_BODIES, rest) {
                Ok(quantity) => Ok(SensorSource::Body(BodyIndex::Particle(at), quantity)),
                Err(_) => Ok(SensorSource::Station(
                    Station::on_particle(at),
                    find(&OF_STATIONS[..OF_PARTICLES], rest)?,
                )),
            },
            Object::Rigid(at) => {
                let dotted = rest.strip_prefix('.').unwrap_or_default();
                let point = dotted.split_once('.').and_then(|(point, _)| {
                    Some((self.rigid_bodies[at].control_point(point)?, point.len() + 1))
                });
                let (point, rest) = match point {
                    Some((point, length)) => (point, &rest[length..]),
                    None => (0, rest),
                };
                match find(OF_BODIES, rest) {
                    Ok(quantity) if point == 0 => {
                        Ok(SensorSource::Body(BodyIndex::Rigid(at, 0), quantity))
                    }
                    _ => Ok(SensorSource::Station(
                        Station::on_rigid_body(at, point),
                        find(&OF_STATIONS[..OF_POINTS], rest)?,
                    )),
                }
            }
            Object::Beam(at) => {
                let length = self.beams[at].axis.length();
                let (arc_length, rest) = if let Some(rest) = rest.strip_prefix(".start.") {
                    (0.0, rest)
                } else if let Some(rest) = rest.strip_prefix(".end.") {
                    (length, rest)
                } else if let Some(inside) = rest.strip_prefix('[') {
                    let place = inside.split_once("].").and_then(|(number, rest)| {
                        let number: f64 = number.trim_matches(' ').parse().ok()?;
                        (0.0..=length).contains(&number).then_some((number, rest))
                    });
                    place.ok_or_else(|| {
                        refused(format!(
                            "write {}[s].x with s from 0 to {length}",
                            self.beams[at].name
                        ))
                    })?
                } else {
                    let wanted = rest.strip_prefix('.').unwrap_or_default();
                    let known = OF_BODIES.iter().find(|quantity| quantity.name == wanted);
                    let beam = &self.beams[at].name;
                    return known.map(|known| SensorSource::Body(BodyIndex::Beam(at), *known)).ok_or_else(|| {
                        let names: Vec<&str> = OF_BODIES.iter().map(|quantity| quantity.name).collect();
                        refused(format!(
                            "a whole beam has {}; its places have {beam}.start.x, {beam}.end.x, {beam}[s].x and so on",
                            names.join(", ")
                        ))
                    });
                };
                let dotted = format!(".{rest}");
                Ok(SensorSource::Station(
                    Station::on_beam(at, arc_length),
                    find(OF_STATIONS, &dotted)?,
                ))
            }
        }
    }
}

enum Object {
    Beam(usize),
    Particle(usize),
    Rigid(usize),
    Joint(usize),
    Slider(usize),
}
