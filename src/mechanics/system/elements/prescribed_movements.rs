//! Supported movements that are prescribed: their increments in a step, and what the drives give by that.
//!
//! Let `v` be the rates, of which those of prescribed movements are derivatives of the prescribed functions, and `ε = Δx - Δt v̄` by how much a prescribed
//! increment
//! differs from its mean rate (of third order in `Δt`; zero for what is unknown). By the proofs of the energy–momentum step
//!
//! ```text
//! ΔE = Σ R·Δx - Σ ε·M Δv/Δt          Δp = Δt Σ R          ΔL = Δt Σ x̄ × R + Σ ε × M v̄          R: what is left of the equations
//! ```
//!
//! over the prescribed movements, exactly. These are work, impulse and angular impulse of a drive.

mod at_rest;

use super::motion_curvature::MotionCurvature;
use super::supports::Support;
use super::{Drive, WorkAndImpulse};
use crate::beams::RotationIncrement;
use crate::geometry::{Vec2, cross, larger};
use crate::integrators::{Interval, PrescribedKinematics};
use crate::joints::Component;
use crate::loads::{LoadError, MotionAtStart, PrescribedMotion};
use crate::system::bodies::Body;

/// A supported movement that is prescribed.
pub struct PrescribedMovement {
    /// The support whose movement is prescribed.
    pub support: Support,
    /// The number of its drive.
    pub drive: usize,
    /// What it does.
    pub motion: PrescribedMotion,
}

/// A drive, and what it has given so far.
struct Driven {
    name: String,
    /// Which of x, y and the angle it prescribes, or did before it let go.
    prescribed: [bool; 3],
    /// Since the start [energy].
    work: f64,
}

/// The present of a prescribed movement.
#[derive(Debug, Clone, Copy, Default)]
struct PresentMotion {
    /// At the end of the last step [length/time², 1/time²].
    acceleration: f64,
    /// The sharpest bend within a step so far, and that of the present step.
    bend: MotionCurvature,
    bend_in_step: MotionCurvature,
    /// Mean of the last step; a moment is that which belongs to the angle [force, force·length].
    reaction: f64,
    /// `M Δv` of the step that is being accepted [force·time, force·length·time].
    struck: f64,
    /// The place or turn that it has at rest under the whole load [length, rad].
    goal: f64,
    /// How far it has been moved there [length, rad].
    placed: f64,
    /// `M v̄` at its control point in that step [mass·length/time].
    momentum: Vec2,
}

/// What a drive has given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriveState<'a> {
    /// The name of the drive.
    pub name: &'a str,
    /// Which of x, y and the angle it gives.
    pub prescribed: [bool; 3],
    /// The work of the drive since the start [energy].
    pub work: f64,
    /// The force on the station, mean of the last step [force].
    pub force: Vec2,
    /// The moment on the station, mean of the last step: what its work is with the angle that the section turned by [force·length].
    pub moment: f64,
}

/// `Δω/Δθ` of an increment of rotation, whatever it stands for: what a moment that works on increments is times, as one that works on angles.
fn per_angle(increment: f64, rotations: RotationIncrement) -> f64 {
    let angle = rotations.angle(increment);
    if angle == 0.0 { 1.0 } else { increment / angle }
}

/// The movements of a model that are prescribed, in the order of their degrees of freedom.
#[derive(Default)]
pub struct PrescribedMovements {
    movements: Vec<PrescribedMovement>,
    present: Vec<PresentMotion>,
    drives: Vec<Driven>,
    /// The number of the first degree of freedom among them.
    first: usize,
    /// Entries of constraints in what is prescribed.
    constraints: usize,
    prescribed: PrescribedKinematics,
    /// The largest turn of the step [rad].
    turn: f64,
    /// Room for rates of everything.
    room: Vec<f64>,
}

impl PrescribedMovements {
    /// The prescribed movements of drives behind some unknown movements and unknowns of constraints.
    ///
    /// # Errors
    /// When a function has no value at the start: the name of its drive, and why.
    pub fn new<'d>(
        movements: Vec<PrescribedMovement>,
        drives: impl Iterator<Item = &'d Drive>,
        unknowns: usize,
        constraints: usize,
    ) -> Result<(Self, Vec<f64>), (String, LoadError)> {
        let driven = |drive: &Drive| Driven {
            name: drive.name.clone(),
            prescribed: drive.prescribed(),
            work: 0.0,
        };
        let drives: Vec<Driven> = drives.map(driven).collect();
        let prescribed = PrescribedKinematics::new(constraints, movements.len());
        let present = vec![PresentMotion::default(); movements.len()];
        let room = vec![0.0; if movements.is_empty() { 0 } else { unknowns + prescribed.width() }];
        let first = unknowns + constraints;
        let mut all =
            Self { movements, present, drives, first, constraints, prescribed, turn: 0.0, room };
        all.begin_at(0.0)?;
        let rates = all.prescribed.rates.clone();
        Ok((all, rates))
    }

    /// Takes the rates and accelerations that functions have just after a time.
    ///
    /// # Errors
    /// When a function has no value there: the name of its drive, and why.
    pub fn begin_at(&mut self, time: f64) -> Result<(), (String, LoadError)> {
        for (at, (movement, present)) in self.movements.iter().zip(&mut self.present).enumerate() {
            let MotionAtStart { rate, acceleration } = movement
                .motion
                .beginning(time)
                .map_err(|error| (self.drives[movement.drive].name.clone(), error))?;
            self.prescribed.rates[self.constraints + at] = rate;
            present.acceleration = acceleration;
        }
        Ok(())
    }

    /// The same drives with such prescribed movements, those that are left where some let go, behind so many unknown movements. What is known of those
    /// that stay is kept.
    pub fn with(self, movements: Vec<PrescribedMovement>, unknowns: usize) -> Self {
        let known = |wanted: &PrescribedMovement| {
            let mut all = self.movements.iter().zip(&self.present);
            let is_wanted = |own: &PrescribedMovement| {
                own.drive == wanted.drive && own.support.component == wanted.support.component
            };
            all.find(|(own, _)| is_wanted(own)).map_or_else(PresentMotion::default, |(_, now)| *now)
        };
        let present = movements.iter().map(known).collect();
        let prescribed = PrescribedKinematics::new(self.constraints, movements.len());
        let room = vec![0.0; if movements.is_empty() { 0 } else { unknowns + prescribed.width() }];
        let first = unknowns + self.constraints;
        Self { movements, present, first, prescribed, room, ..self }
    }

    /// The number of movements that are prescribed.
    pub fn count(&self) -> usize {
        self.movements.len()
    }

    /// Where the prescribed movements are.
    pub fn supports(&self) -> impl Iterator<Item = &Support> {
        self.movements.iter().map(|movement| &movement.support)
    }

    /// What they do in the present step.
    pub fn in_step(&self) -> &PrescribedKinematics {
        &self.prescribed
    }

    /// Whether something prescribed moves at the start.
    pub fn begins_with_a_rate(&self) -> bool {
        self.prescribed.rates.iter().skip(self.constraints).any(|rate| *rate != 0.0)
    }

    /// Begins the sums of what the drives have given.
    pub fn forget_work(&mut self) {
        self.drives.iter_mut().for_each(|drive| drive.work = 0.0);
    }

    /// The largest turn that is prescribed in the present step [rad].
    pub fn turn(&self) -> f64 {
        self.turn
    }

    /// What the drives have given, in the order of the scene.
    pub fn states(&self) -> impl Iterator<Item = DriveState<'_>> {
        self.drives.iter().enumerate().map(|(index, drive)| {
            let own = self.movements.iter().zip(&self.present);
            let own = own.filter(|(movement, _)| movement.drive == index);
            let (mut force, mut moment) = (Vec2::zeros(), 0.0);
            for (movement, present) in own {
                let (by, turning) = movement.support.reaction(present.reaction);
                (force, moment) = (force + by, moment + turning);
            }
            let Driven { name, prescribed, work } = drive;
            DriveState { name, prescribed: *prescribed, work: *work, force, moment }
        })
    }

    /// The drives whose motion bends within a step, each with its sharpest bend.
    pub fn bends(&self) -> impl Iterator<Item = (&str, MotionCurvature)> {
        let all = self.movements.iter().zip(&self.present);
        let bent = all.filter(|(_, present)| present.bend.size() > 0.0);
        bent.map(|(movement, present)| (self.drives[movement.drive].name.as_str(), present.bend))
    }

    /// Finds what is prescribed in a step, with the rates at its start.
    ///
    /// # Errors
    /// When a function has no finite value: the name of its drive, and why.
    pub fn begin_step(
        &mut self,
        interval: Interval,
        rotations: RotationIncrement,
        rates: &[f64],
    ) -> Result<(), (String, LoadError)> {
        let duration = interval.duration();
        self.turn = 0.0;
        for (at, movement) in self.movements.iter().enumerate() {
            let step = movement
                .motion
                .over(interval.start, interval.end, duration)
                .map_err(|error| (self.drives[movement.drive].name.clone(), error))?;
            let entry = self.constraints + at;
            let turns = movement.support.component == Component::Rotation;
            self.prescribed.increments[entry] =
                if turns { rotations.of_angle(step.moved) } else { step.moved };
            if turns {
                self.turn = larger(self.turn, step.moved.abs());
            }
            let before = rates[self.first + at];
            self.prescribed.rates[entry] = step.rate;
            self.present[at].bend_in_step =
                MotionCurvature::of(&movement.motion, interval, before, &step);
            self.prescribed.mean_accelerations[entry] = (step.rate - before) / duration;
            let [start, end] = &mut self.prescribed.accelerations;
            [start[entry], end[entry]] = step.accelerations;
        }
        Ok(())
    }

    /// By how much rates that are prescribed jump at the start of a step, where their degrees of freedom are; none where none of them does. They may at
    /// times at which a function is said to bend, and wherever a controller speaks.
    ///
    /// # Errors
    /// When a function has no finite value.
    pub fn jumps(&self, interval: Interval, rates: &[f64]) -> Result<Option<Vec<f64>>, LoadError> {
        let mut found = None;
        for (at, movement) in self.movements.iter().enumerate() {
            let before = rates[self.first + at];
            let Some(jump) = movement.motion.jump_of_rate(interval.start, interval.end, before)?
            else {
                continue;
            };
            found.get_or_insert_with(|| vec![0.0; rates.len()])[self.first + at] = jump;
        }
        Ok(found)
    }

    /// Room for rates of all movements, filled by a function of their number.
    pub fn fill(&mut self, rate: impl FnMut(usize) -> f64) -> &[f64] {
        self.room.clear();
        let width = if self.movements.is_empty() { 0 } else { self.first + self.movements.len() };
        self.room.extend((0..width).map(rate));
        &self.room
    }

    /// The accelerations of what is prescribed at the start of the step, where its degrees of freedom are; zero for what is unknown.
    pub fn accelerations(&self) -> Vec<f64> {
        let behind = self.present.iter().map(|present| present.acceleration);
        let ahead = if self.movements.is_empty() { 0 } else { self.first };
        std::iter::repeat_n(0.0, ahead).chain(behind).collect()
    }

    /// Takes the part of `M Δv` of a step that belongs to what is prescribed.
    pub fn take_struck(&mut self, struck: &[f64]) {
        for (present, struck) in self.present.iter_mut().zip(&struck[self.first..]) {
            present.struck = *struck;
        }
    }

    /// Takes the part of `M v̄` of a step that belongs to what is prescribed.
    pub fn take_momentum(&mut self, bodies: &[Body], momentum: &[f64]) {
        for (movement, present) in self.movements.iter().zip(&mut self.present) {
            let Support { body, point, .. } = movement.support;
            let [x, y, _] = bodies[body].degrees_of_freedom[point];
            present.momentum = Vec2::new(momentum[x], momentum[y]);
        }
    }

    /// What the drives gave in the step of the movements that the bodies gathered last, with its reactions; their works are kept.
    ///
    /// `mean` tells mean rates by degree of freedom.
    pub fn exchange(
        &mut self,
        bodies: &[Body],
        residual: &[f64],
        (duration, rotations): (f64, RotationIncrement),
        mean: impl Fn(usize) -> f64,
    ) -> WorkAndImpulse {
        let mut sum = WorkAndImpulse::default();
        for (at, (movement, present)) in self.movements.iter().zip(&mut self.present).enumerate() {
            let Support { body, point, component } = movement.support;
            let reaction = residual[self.first + at];
            let [x, y, turned] = bodies[body].moved()[point];
            let moved = [x, y, turned][component as usize];
            let missed = moved - duration * mean(self.first + at);
            let work = reaction * moved - missed * present.struck / duration;
            let middle = bodies[body].dynamics.control_points()[point] + 0.5 * Vec2::new(x, y);
            let (force, moment) = movement.support.reaction(reaction);
            let (aside, _) = match component {
                Component::Rotation => (Vec2::zeros(), 0.0),
                _ => movement.support.reaction(missed),
            };
            let angular =
                (cross(middle, force) + moment) * duration + cross(aside, present.momentum);
            sum += WorkAndImpulse::of(work, force * duration, angular);
            self.drives[movement.drive].work += work;
            present.reaction = match component {
                Component::Rotation => {
                    let inertia = present.struck / duration;
                    (reaction - inertia) * per_angle(moved, rotations) + inertia
                }
                _ => reaction,
            };
            if present.bend_in_step.size() > present.bend.size() {
                present.bend = present.bend_in_step;
            }
            present.acceleration = self.prescribed.accelerations[1][self.constraints + at];
        }
        sum
    }

    /// What the drives gave in a blow, with its impulses, at these mean rates of everything, of before and after it.
    pub fn exchange_in_blow(
        &mut self,
        bodies: &[Body],
        impulses: &[f64],
        rates: &[f64],
    ) -> WorkAndImpulse {
        let mut sum = WorkAndImpulse::default();
        for (at, movement) in self.movements.iter().enumerate() {
            let Support { body, point, .. } = movement.support;
            let impulse = impulses[self.first + at];
            let work = impulse * rates[self.first + at];
            let (force, moment) = movement.support.reaction(impulse);
            let place = bodies[body].dynamics.control_points()[point];
            sum += WorkAndImpulse::of(work, force, cross(place, force) + moment);
            self.drives[movement.drive].work += work;
        }
        sum
    }

    /// Appends the state of the prescribed movements at the start of a step.
    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend(
            self.present.iter().flat_map(|now| [now.acceleration, now.reaction, now.placed]),
        );
        let bends = self.present.iter().map(|now| now.bend);
        state.extend(bends.flat_map(|MotionCurvature { time, rates }| [time, rates[0], rates[1]]));
        state.extend(self.drives.iter().map(|drive| drive.work));
    }

    /// Takes the state of the prescribed movements back, in the order in which it was appended.
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        for present in &mut self.present {
            (present.acceleration, present.reaction) = (next(), next());
            present.placed = next();
        }
        for present in &mut self.present {
            present.bend = MotionCurvature { time: next(), rates: [next(), next()] };
        }
        self.drives.iter_mut().for_each(|drive| drive.work = next());
    }
}
