//! Prescribed motions of supported degrees of freedom: increments in a step, and work and impulse of the drives.
//!
//! Work and impulses of the drives follow from the exact changes of energy and momenta in a step (docs/theory.md, section 9.5).

mod at_rest;

use super::motion_curvature::MotionCurvature;
use super::supports::Support;
use super::{Drive, ScheduleCheck, UnsampledChange, WorkAndImpulse};
use crate::beams::RotationIncrement;
use crate::geometry::{Vec2, cross, larger};
use crate::integrators::{Interval, PrescribedKinematics};
use crate::joints::Component;
use crate::loads::{LoadError, MotionAtStart, PrescribedMotion};
use crate::system::bodies::Body;
use crate::system::step_mean::StepMean;

pub struct PrescribedMovement {
    pub support: Support,
    pub drive: usize,
    pub motion: PrescribedMotion,
}

struct Driven {
    name: String,
    /// Work since the start [energy].
    work: f64,
}

#[derive(Debug, Clone, Copy, Default)]
struct PresentMotion {
    /// Prescribed acceleration at the end of the last step [length/time², rad/time²].
    acceleration: f64,
    /// Largest jump of the prescribed rate in the steps before the present step. The jump in the present step is stored in `step_curvature`.
    curvature: MotionCurvature,
    step_curvature: MotionCurvature,
    /// Check of the mean of the prescribed rate in each step; `None` if the mean is computed exactly.
    check: Option<ScheduleCheck>,
    /// Reaction of the drive [force, force·length]. A reaction moment is conjugate to the angle of the section.
    reaction: StepMean<f64>,
    impact_momentum: f64,
    /// Prescribed displacement of the drive from its initial position in a static analysis, at load factor 1 [length, rad].
    goal: f64,
    /// Displacement of the drive in the last accepted step of a static analysis: load factor times `goal` [length, rad].
    placed: f64,
    momentum: Vec2,
}

impl PresentMotion {
    fn of(movement: &PrescribedMovement) -> Self {
        let check = match &movement.motion {
            PrescribedMotion::Position(_) => None,
            PrescribedMotion::Rate(schedule) => ScheduleCheck::of(schedule),
        };
        Self { check, ..Self::default() }
    }
}

/// Work and reactions of a drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriveState {
    /// Work since the start [energy].
    pub work: f64,
    /// Mean force on the station in the last step [force].
    pub force: Vec2,
    /// Mean moment on the station in the last step, conjugate to the angle of the section [force·length].
    pub moment: f64,
}

fn per_angle(increment: f64, rotations: RotationIncrement) -> f64 {
    let angle = rotations.angle(increment);
    if angle == 0.0 { 1.0 } else { increment / angle }
}

/// Prescribed degrees of freedom of a model, in the order of their numbers.
#[derive(Default)]
pub struct PrescribedMovements {
    movements: Vec<PrescribedMovement>,
    present: Vec<PresentMotion>,
    drives: Vec<Driven>,
    first: usize,
    constraints: usize,
    prescribed: PrescribedKinematics,
    /// Largest prescribed rotation in the current step [rad].
    largest_rotation: f64,
    scratch: Vec<f64>,
}

impl PrescribedMovements {
    pub fn new<'d>(
        movements: Vec<PrescribedMovement>,
        drives: impl Iterator<Item = &'d Drive>,
        unknowns: usize,
        constraints: usize,
    ) -> Result<(Self, Vec<f64>), (String, LoadError)> {
        let driven = |drive: &Drive| Driven { name: drive.name.clone(), work: 0.0 };
        let drives: Vec<Driven> = drives.map(driven).collect();
        let prescribed = PrescribedKinematics::new(constraints, movements.len());
        let present = movements.iter().map(PresentMotion::of).collect();
        let room = vec![0.0; if movements.is_empty() { 0 } else { unknowns + prescribed.width() }];
        let first = unknowns + constraints;
        let mut all = Self {
            movements,
            present,
            drives,
            first,
            constraints,
            prescribed,
            largest_rotation: 0.0,
            scratch: room,
        };
        all.begin_at(0.0)?;
        let rates = all.prescribed.rates.clone();
        Ok((all, rates))
    }

    /// Evaluates prescribed rates and accelerations just after a time.
    ///
    /// # Errors
    /// Returns the name of the drive whose function has no value at this time, and the error of the function.
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

    pub fn with(self, movements: Vec<PrescribedMovement>, unknowns: usize) -> Self {
        let known = |wanted: &PrescribedMovement| {
            let mut all = self.movements.iter().zip(&self.present);
            let is_wanted = |own: &PrescribedMovement| {
                own.drive == wanted.drive && own.support.component == wanted.support.component
            };
            all.find(|(own, _)| is_wanted(own))
                .map_or_else(|| PresentMotion::of(wanted), |(_, now)| *now)
        };
        let present = movements.iter().map(known).collect();
        let prescribed = PrescribedKinematics::new(self.constraints, movements.len());
        let room = vec![0.0; if movements.is_empty() { 0 } else { unknowns + prescribed.width() }];
        let first = unknowns + self.constraints;
        Self { movements, present, first, prescribed, scratch: room, ..self }
    }

    pub fn count(&self) -> usize {
        self.movements.len()
    }

    /// For each prescribed degree of freedom: its support, the index of its drive, and its index in the vector of all rates.
    pub fn numbered(&self) -> impl Iterator<Item = (&Support, usize, usize)> {
        let movements = self.movements.iter().zip(self.first..);
        movements.map(|(movement, rate)| (&movement.support, movement.drive, rate))
    }

    pub fn supports(&self) -> impl Iterator<Item = &Support> {
        self.movements.iter().map(|movement| &movement.support)
    }

    pub fn in_step(&self) -> &PrescribedKinematics {
        &self.prescribed
    }

    pub fn has_start_rate(&self) -> bool {
        self.prescribed.rates.iter().skip(self.constraints).any(|rate| *rate != 0.0)
    }

    pub fn clear_work(&mut self) {
        self.drives.iter_mut().for_each(|drive| drive.work = 0.0);
    }

    pub fn largest_rotation(&self) -> f64 {
        self.largest_rotation
    }

    /// Works of the drives since the start, in the order of the scene [energy].
    pub fn works(&self) -> impl ExactSizeIterator<Item = f64> {
        self.drives.iter().map(|drive| drive.work)
    }

    /// Power of each prescribed movement as the product of its reaction and its rate [energy/time], with the index of its drive.
    pub fn powers(&self, rates: &[f64]) -> impl Iterator<Item = (usize, f64)> {
        let own = self.movements.iter().zip(&self.present).zip(rates.iter().skip(self.first));
        own.map(|((movement, present), rate)| (movement.drive, present.reaction.value * rate))
    }

    pub fn state(&self, drive: usize) -> DriveState {
        let own = self.movements.iter().zip(&self.present);
        let own = own.filter(|(movement, _)| movement.drive == drive);
        let (mut force, mut moment) = (Vec2::zeros(), 0.0);
        for (movement, present) in own {
            let (by, turning) = movement.support.reaction(present.reaction.value);
            (force, moment) = (force + by, moment + turning);
        }
        DriveState { work: self.drives[drive].work, force, moment }
    }

    pub fn bends(&self) -> impl Iterator<Item = (&str, MotionCurvature)> {
        let all = self.movements.iter().zip(&self.present);
        let bent = all.filter(|(_, present)| present.curvature.size() > 0.0);
        bent.map(|(movement, present)| {
            (self.drives[movement.drive].name.as_str(), present.curvature)
        })
    }

    pub fn missed_changes(&self) -> impl Iterator<Item = (&str, UnsampledChange)> {
        let all = self.movements.iter().zip(&self.present);
        all.filter_map(|(movement, present)| {
            let missed = present.check.as_ref()?.missed()?;
            Some((self.drives[movement.drive].name.as_str(), missed))
        })
    }

    /// Evaluates the prescribed increments in a step, the prescribed rates at its end, and the prescribed accelerations.
    ///
    /// # Errors
    /// Returns the name of the drive whose function has no finite value, and the error of the function.
    pub fn begin_step(
        &mut self,
        interval: Interval,
        rotations: RotationIncrement,
        rates: &[f64],
    ) -> Result<(), (String, LoadError)> {
        let duration = interval.duration();
        self.largest_rotation = 0.0;
        for (at, movement) in self.movements.iter().enumerate() {
            let step = movement
                .motion
                .over(interval.start, interval.end, duration)
                .map_err(|error| (self.drives[movement.drive].name.clone(), error))?;
            let entry = self.constraints + at;
            let turns = movement.support.component == Component::Rotation;
            self.prescribed.increments[entry] =
                if turns { rotations.of_angle(step.increment) } else { step.increment };
            if turns {
                self.largest_rotation = larger(self.largest_rotation, step.increment.abs());
            }
            let before = rates[self.first + at];
            self.prescribed.rates[entry] = step.rate;
            self.present[at]
                .check
                .iter_mut()
                .for_each(|check| check.begin_step(interval, step.mean));
            self.present[at].step_curvature =
                MotionCurvature::of(&movement.motion, interval, before, &step);
            self.prescribed.mean_accelerations[entry] = (step.rate - before) / duration;
            let [start, end] = &mut self.prescribed.accelerations;
            [start[entry], end[entry]] = step.accelerations;
        }
        Ok(())
    }

    /// Jumps of prescribed rates at the start of a step, indexed by the degree of freedom; `None` without a jump.
    /// Rates may jump at declared breaks of a function and at samples of a controller.
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

    pub fn fill(&mut self, rate: impl FnMut(usize) -> f64) -> &[f64] {
        self.scratch.clear();
        let width = if self.movements.is_empty() { 0 } else { self.first + self.movements.len() };
        self.scratch.extend((0..width).map(rate));
        &self.scratch
    }

    /// Prescribed accelerations at the start of the step, indexed by the degree of freedom; zero for unknowns.
    pub fn accelerations(&self) -> impl Iterator<Item = f64> {
        let behind = self.present.iter().map(|present| present.acceleration);
        let ahead = if self.movements.is_empty() { 0 } else { self.first };
        std::iter::repeat_n(0.0, ahead).chain(behind)
    }

    pub fn store_impact_momentum(&mut self, struck: &[f64]) {
        for (present, struck) in self.present.iter_mut().zip(&struck[self.first..]) {
            present.impact_momentum = *struck;
        }
    }

    pub fn store_mean_momentum(&mut self, bodies: &[Body], momentum: &[f64]) {
        for (movement, present) in self.movements.iter().zip(&mut self.present) {
            let Support { body, point, .. } = movement.support;
            let [x, y, _] = bodies[body].degrees_of_freedom[point];
            present.momentum = Vec2::new(momentum[x], momentum[y]);
        }
    }

    /// Work and impulse of the drives in the step whose increments are stored in the bodies. The work is added to the work of each drive.
    ///
    /// The callback `mean` returns the mean rate of a degree of freedom.
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
            let work = reaction * moved - missed * present.impact_momentum / duration;
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
            let conjugate = match component {
                Component::Rotation => {
                    let inertia = present.impact_momentum / duration;
                    (reaction - inertia) * per_angle(moved, rotations) + inertia
                }
                _ => reaction,
            };
            present.reaction.add(conjugate, duration);
            if present.step_curvature.size() > present.curvature.size() {
                present.curvature = present.step_curvature;
            }
            present.check.iter_mut().for_each(ScheduleCheck::advance);
            present.acceleration = self.prescribed.accelerations[1][self.constraints + at];
        }
        sum
    }

    pub fn start_reactions(&mut self, residual: &[f64]) {
        for (present, reaction) in self.present.iter_mut().zip(&residual[self.first..]) {
            present.reaction = StepMean::at_start(*reaction);
        }
    }

    pub fn end_step(&mut self) {
        self.present.iter_mut().for_each(|present| present.reaction.end_step());
    }

    /// Impulse and work of the drives in an impact.
    /// The work of a drive in an impact is the reaction impulse times the mean of the rates before and after the impact.
    pub fn impact_exchange(
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

    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend(
            self.present.iter().flat_map(|now| [now.acceleration, now.reaction.value, now.placed]),
        );
        state.extend(self.present.iter().map(|now| now.reaction.covered));
        let bends = self.present.iter().map(|now| now.curvature);
        state.extend(bends.flat_map(|MotionCurvature { time, rates }| [time, rates[0], rates[1]]));
        self.present.iter().flat_map(|now| &now.check).for_each(|check| check.save(state));
        state.extend(self.drives.iter().map(|drive| drive.work));
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        for present in &mut self.present {
            (present.acceleration, present.reaction.value) = (next(), next());
            present.placed = next();
        }
        self.present.iter_mut().for_each(|present| present.reaction.covered = next());
        for present in &mut self.present {
            present.curvature = MotionCurvature { time: next(), rates: [next(), next()] };
        }
        let checks = self.present.iter_mut().flat_map(|now| &mut now.check);
        checks.for_each(|check| check.restore(next));
        self.drives.iter_mut().for_each(|drive| drive.work = next());
    }
}
