//! Start velocities: rigid motions of beams and bodies, and velocities of single nodes.

use super::{Assembly, Numbering};
use crate::beams::{BodyDynamics, BodyIndex, Station};
use crate::geometry::{Vec2, cross, larger, perpendicular};
use crate::system::elements::AssemblyContext;
use crate::system::errors::{rounded, written};
use crate::system::{Scene, StartMotion, StationVelocity, SystemError, Turning};

/// Largest difference between the start velocities of two joined bodies that counts as zero, as a fraction of the velocities.
/// The same limit applies to the velocity across an inclined roller.
const SAME_VELOCITY: f64 = 1e-9;

/// Largest accepted difference between a start velocity and the velocity that a drive or a joint requires, as a fraction of the larger one.
/// The limit allows for the error of the initial rate of a drive, which is computed by finite differences.
const SAME_START: f64 = 1e-6;

const COMPONENTS: [&str; 3] = ["velocity along x", "velocity along y", "spin"];

const GROUND: &str = "the ground is at rest there";

fn given_rate_text(rate: f64) -> String {
    format!("its motion is prescribed there and begins with {}", rounded(rate))
}

struct SharedRates<'a> {
    rates: Vec<Option<(usize, f64)>>,
    requested: Vec<Option<RequestedRate<'a>>>,
}

#[derive(Clone, Copy)]
struct RequestedRate<'a> {
    rate: f64,
    at: &'a Station,
}

#[derive(Clone, Copy)]
struct InitialDriveRates<'a> {
    unknowns: usize,
    rates: &'a [f64],
    constraints: usize,
}

impl InitialDriveRates<'_> {
    fn at(&self, degree: usize) -> Option<f64> {
        let entry = degree.checked_sub(self.unknowns)?;
        if entry < self.constraints { None } else { self.rates.get(entry).copied() }
    }
}

impl SharedRates<'_> {
    fn set_rate(
        &mut self,
        at: usize,
        beam: usize,
        rate: f64,
        size: f64,
    ) -> Option<Option<(usize, f64)>> {
        let other = match self.rates.get_mut(at) {
            Some(free @ None) => {
                *free = Some((beam, rate));
                return None;
            }
            Some(taken) => *taken,
            None => None,
        };
        let expected = other.map_or(0.0, |(_, rate)| rate);
        let differs = (rate - expected).abs() > SAME_VELOCITY * size.max(expected.abs());
        differs.then_some(other)
    }
}

impl RequestedRate<'_> {
    fn description(&self, scene: &Scene) -> String {
        format!(
            "{}, joined there, has the start velocity {}",
            scene.name_of_body(self.at),
            rounded(self.rate)
        )
    }
}

impl Assembly<'_> {
    /// Rates of the unknowns at the start, compatible with joints, drives and start velocities [length/time, rad/time].
    ///
    /// The argument `prescribed` contains `constraints` zeros for the contact unknowns, followed by the initial rates of the drives.
    pub fn start_rates(
        &self,
        numbering: &Numbering,
        constraints: usize,
        prescribed: &[f64],
    ) -> Result<Vec<f64>, SystemError> {
        let begun =
            InitialDriveRates { unknowns: numbering.unknowns, rates: prescribed, constraints };
        let asked = self.requested_rates(numbering)?;
        let mut shared = SharedRates { rates: vec![None; numbering.unknowns], requested: asked };
        for (index, beam) in self.scene.beams.iter().enumerate() {
            let degrees = &numbering.degrees_of_freedom[index];
            let length = beam.axis.length();
            self.apply_rigid_motion(index, length, &beam.motion, degrees, &mut shared, begun)?;
        }
        let first = self.scene.first_rigid_body();
        for (index, body) in (first..).zip(&self.scene.rigid_bodies) {
            let degrees = &numbering.degrees_of_freedom[index];
            // Differences of angular velocities are multiplied by the size of the body and compared with velocities.
            // A body whose points are all at its centre may have any size here, because nothing is tied to its rotation.
            let size = if body.size() > 0.0 { body.size() } else { 1.0 };
            self.apply_rigid_motion(index, size, &body.motion, degrees, &mut shared, begun)?;
        }
        let rates = shared.rates.into_iter();
        let mut rates: Vec<f64> = rates.map(|rate| rate.map_or(0.0, |(_, value)| value)).collect();
        for velocity in &self.scene.velocities {
            self.set_velocity(velocity, numbering, &mut rates, begun)?;
        }
        self.check_rollers(numbering, &rates)?;
        Ok(rates)
    }

    fn check_rollers(&self, numbering: &Numbering, rates: &[f64]) -> Result<(), SystemError> {
        let inclined =
            self.scene.joints.iter().filter_map(|joint| Some((joint, joint.kind.inclined()?)));
        for (place, (joint, along)) in numbering.rollers.iter().zip(inclined) {
            let Some((_, (body, point))) = *place else { continue };
            let [x, y, _] = numbering.degrees_of_freedom[body][point];
            let rate = |at: usize| rates.get(at).copied().unwrap_or(0.0);
            let velocity = Vec2::new(rate(x), rate(y));
            let across = cross(along, velocity);
            if across.abs() > SAME_VELOCITY * velocity.norm() {
                return Err(SystemError::StartVelocity {
                    body: self.scene.name_of_body(&joint.station),
                    place: "inclined roller (velocity across it)".to_owned(),
                    velocity: across,
                    other: format!("the roller allows motion along {} only", written(along)),
                });
            }
        }
        Ok(())
    }

    fn apply_rigid_motion(
        &self,
        index: usize,
        length: f64,
        motion: &StartMotion,
        degrees_of_freedom: &[[usize; 3]],
        shared: &mut SharedRates,
        begun: InitialDriveRates<'_>,
    ) -> Result<(), SystemError> {
        let body = self.body(index);
        let about = motion.centre.unwrap_or_else(|| match index < self.scene.beams.len() {
            true => centre(body),
            false => body.control_points()[0],
        });
        let rests = motion.velocity == Vec2::zeros() && motion.spin == 0.0;
        let speed = motion.velocity.norm() + motion.spin.abs() * length;
        let sizes = [speed, speed, speed / length];
        for (point, degrees) in body.control_points().iter().zip(degrees_of_freedom) {
            let velocity = motion.velocity + perpendicular(point - about) * motion.spin;
            let rates = [velocity.x, velocity.y, motion.spin];
            let sized = degrees.iter().zip(rates).zip(sizes).zip(COMPONENTS);
            for (((&at, rate), size), component) in sized {
                if let Some(begins) = begun.at(at) {
                    // A body at rest may be joined to a drive that starts with a velocity. An impact at the start sets the body in motion.
                    if !rests && (rate - begins).abs() > SAME_START * size.max(begins.abs()) {
                        return Err(SystemError::StartVelocity {
                            body: self.name_of(index),
                            place: format!("drive ({component})"),
                            velocity: rate,
                            other: given_rate_text(begins),
                        });
                    }
                    continue;
                }
                if let Some(asked) = shared.requested.get(at).copied().flatten() {
                    // A start velocity given for a single station replaces the velocity of the beam at this station.
                    // A different velocity is an error for rigid bodies, and for a moving beam that is joined to a particle.
                    let is_rigid = degrees_of_freedom.len() > 1 && index >= self.scene.beams.len();
                    let moves_apart = !rests && matches!(asked.at.body, BodyIndex::Particle(_));
                    let missed = (rate - asked.rate).abs();
                    if (is_rigid || moves_apart) && missed > SAME_START * size.max(asked.rate.abs())
                    {
                        return Err(SystemError::StartVelocity {
                            body: self.name_of(index),
                            place: format!("joint ({component})"),
                            velocity: rate,
                            other: asked.description(self.scene),
                        });
                    }
                    continue;
                }
                if let Some(other) = shared.set_rate(at, index, rate, size) {
                    let other = other.map_or(GROUND.to_owned(), |(other, rate)| {
                        format!("{}, joined there, has {}", self.name_of(other), rounded(rate))
                    });
                    return Err(SystemError::StartVelocity {
                        body: self.name_of(index),
                        place: format!("joint ({component})"),
                        velocity: rate,
                        other,
                    });
                }
            }
        }
        Ok(())
    }

    /// Start velocities given for single stations. The entry at the index of an unknown is the velocity given for this unknown.
    ///
    /// # Errors
    /// Fails if joined stations have different requested rates.
    fn requested_rates(
        &self,
        numbering: &Numbering,
    ) -> Result<Vec<Option<RequestedRate<'_>>>, SystemError> {
        let mut asked: Vec<Option<RequestedRate>> = vec![None; numbering.unknowns];
        for StationVelocity { station, velocity, spin } in &self.scene.velocities {
            if let BodyIndex::Rigid(..) = station.body {
                continue;
            }
            let place = self.place(station)?;
            let degrees = numbering.degrees_of_freedom[place.body][place.nearest_control_point()];
            let values = [Some(velocity.x), Some(velocity.y), *spin];
            for ((at, value), component) in degrees.into_iter().zip(values).zip(COMPONENTS) {
                let (Some(taken), Some(rate)) = (asked.get_mut(at), value) else { continue };
                if let Some(other) = taken
                    && other.at != station
                    && (rate - other.rate).abs() > SAME_START * larger(rate.abs(), other.rate.abs())
                {
                    return Err(SystemError::StartVelocity {
                        body: self.scene.name_of_body(station),
                        place: format!("joint ({component})"),
                        velocity: rate,
                        other: other.description(self.scene),
                    });
                }
                *taken = Some(RequestedRate { rate, at: station });
            }
        }
        Ok(asked)
    }

    fn name_of(&self, index: usize) -> String {
        let first = self.scene.first_rigid_body();
        match self.scene.beams.get(index) {
            Some(beam) => format!("beam '{}'", beam.name),
            None => format!("body '{}'", self.scene.rigid_bodies[index - first].name),
        }
    }

    fn set_velocity(
        &self,
        velocity: &StationVelocity,
        numbering: &Numbering,
        rates: &mut [f64],
        begun: InitialDriveRates<'_>,
    ) -> Result<(), SystemError> {
        let StationVelocity { station, velocity, spin } = velocity;
        let object = format!("start velocity of {}", self.scene.describe(station));
        if let BodyIndex::Rigid(..) = station.body {
            return Err(SystemError::PointAlone { object });
        }
        if !station.turns() && spin.is_some() {
            return Err(SystemError::ParticleTurned { object, by: Turning::Spin });
        }
        let place = self.place(station)?;
        let degrees = numbering.degrees_of_freedom[place.body][place.nearest_control_point()];
        let values = [Some(velocity.x), Some(velocity.y), *spin];
        let differs = |begins: f64, value: f64| {
            (value - begins).abs() > SAME_START * value.abs().max(begins.abs())
        };
        for ((at, value), component) in degrees.into_iter().zip(values).zip(COMPONENTS) {
            match (value, rates.get_mut(at)) {
                (Some(value), Some(rate)) => *rate = value,
                (Some(value), None)
                    if begun.at(at).is_some_and(|begins| differs(begins, value)) =>
                {
                    return Err(SystemError::StartVelocity {
                        body: self.scene.name_of_body(station),
                        place: format!("drive ({component})"),
                        velocity: value,
                        other: given_rate_text(begun.at(at).unwrap_or_default()),
                    });
                }
                (Some(_), None) if begun.at(at).is_some() => {}
                (Some(value), None) if value != 0.0 => {
                    return Err(SystemError::StartVelocity {
                        body: self.scene.name_of_body(station),
                        place: format!("support ({component})"),
                        velocity: value,
                        other: GROUND.to_owned(),
                    });
                }
                _ => {}
            }
        }
        Ok(())
    }
}

fn centre(beam: &dyn BodyDynamics) -> Vec2 {
    let lengths = beam.lumped_lengths();
    let moment: Vec2 =
        beam.control_points().iter().zip(&lengths).map(|(point, length)| point * *length).sum();
    moment / lengths.iter().sum::<f64>()
}
