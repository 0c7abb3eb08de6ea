//! Supported movements that are given: their increments in a step, and what the drives give by that.
//!
//! Let `v` be the rates, of which those of given movements are derivatives of the given functions, and `ε = Δx - Δt v̄` by how much a given increment
//! differs from its mean rate (of third order in `Δt`; zero for what is unknown). By the proofs of the energy–momentum step
//!
//! ```text
//! ΔE = Σ R·Δx - Σ ε·M Δv/Δt          Δp = Δt Σ R          ΔL = Δt Σ x̄ × R + Σ ε × M v̄          R: what is left of the equations
//! ```
//!
//! over the given movements, exactly. These are work, impulse and angular impulse of a drive.

use std::borrow::Cow;

use super::Exchange;
use super::supports::Support;
use crate::beams::RotationIncrement;
use crate::elementary::tan;
use crate::geometry::{Vec2, cross, larger};
use crate::integrators::{Given, Interval};
use crate::joints::Component;
use crate::loads::{Beginning, Course, LoadError, Side};
use crate::model::bodies::Body;

/// A supported movement that is given.
pub struct Guided {
    /// Where it is.
    pub support: Support,
    /// The number of its drive.
    pub drive: usize,
    /// What it does.
    pub course: Course,
}

/// A drive, and what it has given so far.
struct Driven {
    name: String,
    /// Which of x, y and the angle it gives, or gave before it let go.
    given: [bool; 3],
    /// Since the start [energy].
    work: f64,
}

/// The present of a given movement.
#[derive(Debug, Clone, Copy, Default)]
struct Present {
    /// At the end of the last step [length/time², 1/time²].
    acceleration: f64,
    /// Mean of the last step [force, force·length].
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
    /// Its name.
    pub name: &'a str,
    /// Which of x, y and the angle it gives.
    pub given: [bool; 3],
    /// Its work since the start [energy].
    pub work: f64,
    /// The force on the station, mean of the last step [force].
    pub force: Vec2,
    /// The moment on the station, mean of the last step [force·length].
    pub moment: f64,
}

/// The movements of a model that are given, in the order of their degrees of freedom.
#[derive(Default)]
pub struct Guides {
    guided: Vec<Guided>,
    present: Vec<Present>,
    drives: Vec<Driven>,
    /// The number of the first degree of freedom among them.
    first: usize,
    /// Entries of constraints in what is given.
    constraints: usize,
    given: Given,
    /// The largest turn of the step [rad].
    turn: f64,
    /// Room for rates of everything.
    room: Vec<f64>,
}

impl Guides {
    /// The given movements of drives, of which names and components are told, behind some unknown movements and unknowns of constraints.
    ///
    /// # Errors
    /// When a function has no value at the start: the name of its drive, and why.
    pub fn new(
        guided: Vec<Guided>,
        drives: impl Iterator<Item = (String, [bool; 3])>,
        unknowns: usize,
        constraints: usize,
    ) -> Result<(Self, Vec<f64>), (String, LoadError)> {
        let drives: Vec<Driven> = drives.map(|(name, given)| Driven { name, given, work: 0.0 }).collect();
        let mut given = Given::new(constraints, guided.len());
        let mut present = vec![Present::default(); guided.len()];
        for (at, guide) in guided.iter().enumerate() {
            let Beginning { rate, acceleration } = guide
                .course
                .beginning()
                .map_err(|error| (drives[guide.drive].name.clone(), error))?;
            given.rates[constraints + at] = rate;
            present[at].acceleration = acceleration;
        }
        let rates = given.rates.clone();
        let room = vec![0.0; if guided.is_empty() { 0 } else { unknowns + given.width() }];
        let first = unknowns + constraints;
        let all = Self { guided, present, drives, first, constraints, given, turn: 0.0, room };
        Ok((all, rates))
    }

    /// The same drives with such given movements, those that are left where some let go, behind so many unknown movements. What is known of those that
    /// stay is kept.
    pub fn with(self, guided: Vec<Guided>, unknowns: usize) -> Self {
        let is_same = |one: &Guided, other: &Guided| {
            one.drive == other.drive && one.support.component == other.support.component
        };
        let known = |guide: &Guided| {
            let mut all = self.guided.iter().zip(&self.present);
            all.find(|(own, _)| is_same(own, guide)).map(|(_, present)| *present)
        };
        let present = guided.iter().map(|guide| known(guide).unwrap_or_default()).collect();
        let given = Given::new(self.constraints, guided.len());
        let room = vec![0.0; if guided.is_empty() { 0 } else { unknowns + given.width() }];
        let first = unknowns + self.constraints;
        Self { guided, present, first, given, room, ..self }
    }

    /// The number of movements that are given.
    pub fn count(&self) -> usize {
        self.guided.len()
    }

    /// Where the given movements are.
    pub fn supports(&self) -> impl Iterator<Item = &Support> {
        self.guided.iter().map(|guide| &guide.support)
    }

    /// What they do in the present step.
    pub fn given(&self) -> &Given {
        &self.given
    }

    /// The largest turn that is given in the present step [rad].
    pub fn turn(&self) -> f64 {
        self.turn
    }

    /// What the drives have given, in the order of the scene.
    pub fn states(&self) -> impl Iterator<Item = DriveState<'_>> {
        self.drives.iter().enumerate().map(|(index, drive)| {
            let own = self.guided.iter().zip(&self.present);
            let own = own.filter(|(guide, _)| guide.drive == index);
            let (mut force, mut moment) = (Vec2::zeros(), 0.0);
            for (guide, present) in own {
                let (by, turning) = guide.support.reaction(present.reaction);
                (force, moment) = (force + by, moment + turning);
            }
            DriveState { name: &drive.name, given: drive.given, work: drive.work, force, moment }
        })
    }

    /// Finds what is given in a step, with the rates at its start.
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
        for (at, guide) in self.guided.iter().enumerate() {
            let piece = guide
                .course
                .over(interval.start, interval.end, duration)
                .map_err(|error| (self.drives[guide.drive].name.clone(), error))?;
            let entry = self.constraints + at;
            let turns = guide.support.component == Component::Rotation;
            self.given.increments[entry] = match rotations {
                RotationIncrement::TangentScaled if turns => 2.0 * tan(0.5 * piece.moved),
                _ => piece.moved,
            };
            if turns {
                self.turn = larger(self.turn, piece.moved.abs());
            }
            let before = rates[self.first + at];
            self.given.rates[entry] = piece.rate;
            self.given.mean_accelerations[entry] = (piece.rate - before) / duration;
            let [start, end] = &mut self.given.accelerations;
            [start[entry], end[entry]] = piece.accelerations;
        }
        Ok(())
    }

    /// Room for rates of all movements, filled by a function of their number.
    pub fn fill(&mut self, rate: impl FnMut(usize) -> f64) -> &[f64] {
        self.room.clear();
        let width = if self.guided.is_empty() { 0 } else { self.first + self.guided.len() };
        self.room.extend((0..width).map(rate));
        &self.room
    }

    /// The accelerations of what is given at the start of the step, where its degrees of freedom are; zero for what is unknown.
    pub fn accelerations(&self) -> Vec<f64> {
        let behind = self.present.iter().map(|present| present.acceleration);
        let ahead = if self.guided.is_empty() { 0 } else { self.first };
        std::iter::repeat_n(0.0, ahead).chain(behind).collect()
    }

    /// Takes the part of `M Δv` of a step that belongs to what is given.
    pub fn take_struck(&mut self, struck: &[f64]) {
        for (present, struck) in self.present.iter_mut().zip(&struck[self.first..]) {
            present.struck = *struck;
        }
    }

    /// Takes the part of `M v̄` of a step that belongs to what is given.
    pub fn take_momentum(&mut self, bodies: &[Body], momentum: &[f64]) {
        for (guide, present) in self.guided.iter().zip(&mut self.present) {
            let Support { body, point, .. } = guide.support;
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
        duration: f64,
        mean: impl Fn(usize) -> f64,
    ) -> Exchange {
        let mut sum = Exchange::default();
        for (at, (guide, present)) in self.guided.iter().zip(&mut self.present).enumerate() {
            let Support { body, point, component } = guide.support;
            let reaction = residual[self.first + at];
            let [x, y, turned] = bodies[body].moved()[point];
            let moved = [x, y, turned][component as usize];
            let missed = moved - duration * mean(self.first + at);
            let work = reaction * moved - missed * present.struck / duration;
            let middle = bodies[body].dynamics.control_points()[point] + 0.5 * Vec2::new(x, y);
            let (force, moment) = guide.support.reaction(reaction);
            let (aside, _) = match component {
                Component::Rotation => (Vec2::zeros(), 0.0),
                _ => guide.support.reaction(missed),
            };
            let angular =
                (cross(middle, force) + moment) * duration + cross(aside, present.momentum);
            sum += Exchange::of(work, force * duration, angular);
            self.drives[guide.drive].work += work;
            present.reaction = reaction;
            present.acceleration = self.given.accelerations[1][self.constraints + at];
        }
        sum
    }

    /// What the drives gave in a blow, with its impulses, at these rates of everything.
    pub fn exchange_in_blow(
        &mut self,
        bodies: &[Body],
        impulses: &[f64],
        rates: &[f64],
    ) -> Exchange {
        let mut sum = Exchange::default();
        for (at, guide) in self.guided.iter().enumerate() {
            let Support { body, point, .. } = guide.support;
            let impulse = impulses[self.first + at];
            let work = impulse * rates[self.first + at];
            let (force, moment) = guide.support.reaction(impulse);
            let place = bodies[body].dynamics.control_points()[point];
            sum += Exchange::of(work, force, cross(place, force) + moment);
            self.drives[guide.drive].work += work;
        }
        sum
    }

    /// Takes the places that are given at a time, which equilibria put on with their loads.
    ///
    /// # Errors
    /// When a function has no finite value: the name of its drive, and why.
    pub fn hold_at(&mut self, time: f64) -> Result<(), (String, LoadError)> {
        for (guide, present) in self.guided.iter().zip(&mut self.present) {
            if let Course::Place(schedule) = &guide.course {
                present.goal = schedule
                    .value(time, Side::After)
                    .map_err(|error| (self.drives[guide.drive].name.clone(), error))?;
            }
        }
        Ok(())
    }

    /// Whether something is given that an equilibrium has to put on.
    pub fn moves_at_rest(&self) -> bool {
        self.present.iter().any(|present| present.goal != 0.0)
    }

    /// Movements at rest, those that are given behind the unknown ones: from where they are to their places under a part of the load.
    pub fn at_rest<'m>(&self, movements: &'m [f64], load_factor: f64) -> Cow<'m, [f64]> {
        if self.guided.is_empty() {
            return Cow::Borrowed(movements);
        }
        let mut all = movements.to_vec();
        all.resize(self.first, 0.0);
        all.extend(self.present.iter().map(|now| load_factor * now.goal - now.placed));
        Cow::Owned(all)
    }

    /// Leaves what is given where it is under a part of the load.
    pub fn place(&mut self, load_factor: f64) {
        for present in &mut self.present {
            present.placed = load_factor * present.goal;
        }
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend(
            self.present.iter().flat_map(|now| [now.acceleration, now.reaction, now.placed]),
        );
        state.extend(self.drives.iter().map(|drive| drive.work));
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        for present in &mut self.present {
            (present.acceleration, present.reaction) = (next(), next());
            present.placed = next();
        }
        self.drives.iter_mut().for_each(|drive| drive.work = next());
    }
}
