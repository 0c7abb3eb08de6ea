//! What supports give.

use super::{PrescribedMovements, WorkAndImpulse};
use crate::geometry::{Vec2, cross};
use crate::joints::Component;
use crate::system::bodies::Body;

/// A supported degree of freedom: the body, its control point and the component that does not move.
#[derive(Debug, Clone, Copy)]
pub struct Support {
    pub body: usize,
    pub point: usize,
    pub component: Component,
}

impl Support {
    /// A reaction as a force and a moment.
    pub fn reaction(&self, reaction: f64) -> (Vec2, f64) {
        match self.component {
            Component::X => (Vec2::new(reaction, 0.0), 0.0),
            Component::Y => (Vec2::new(0.0, reaction), 0.0),
            Component::Rotation => (Vec2::zeros(), reaction),
        }
    }
}

/// The supports of a model, in the order of their degrees of freedom, which stand last of all: those that move as is prescribed, then those that do not
/// move.
pub struct Supports {
    prescribed: PrescribedMovements,
    held: Vec<Support>,
}

impl Supports {
    /// The supports of a model: prescribed movements, and held ones in the order of their degrees of freedom.
    pub fn new(prescribed: PrescribedMovements, held: Vec<Support>) -> Self {
        Self { prescribed, held }
    }

    /// The number of supported degrees of freedom.
    pub fn count(&self) -> usize {
        self.prescribed.count() + self.held.len()
    }

    /// The supports, in the order of their degrees of freedom.
    pub fn iter(&self) -> impl Iterator<Item = &Support> {
        self.prescribed.supports().chain(&self.held)
    }

    /// The supports that hold still.
    pub fn held(&self) -> impl Iterator<Item = &Support> {
        self.held.iter()
    }

    /// The supports whose motion is prescribed.
    pub fn prescribed(&self) -> &PrescribedMovements {
        &self.prescribed
    }

    /// The supports whose motion is prescribed, to be moved.
    pub fn prescribed_mut(&mut self) -> &mut PrescribedMovements {
        &mut self.prescribed
    }

    /// The supports with their reactions, which are the last entries of a residual.
    fn with_reactions<'a>(
        &'a self,
        residual: &'a [f64],
    ) -> impl Iterator<Item = (&'a Support, f64)> {
        let first = residual.len() - self.count();
        self.iter().zip(residual[first..].iter().copied())
    }

    /// The impulse that the supports give that hold still, in the step of the movements that the bodies gathered last, with its reactions.
    ///
    /// What is free moves, as a roller does: they act at the mean place.
    pub fn exchange(&self, bodies: &[Body], residual: &[f64], duration: f64) -> WorkAndImpulse {
        self.impulse(residual, duration, |body, point| {
            let [x, y, _] = bodies[body].moved()[point];
            bodies[body].dynamics.control_points()[point] + 0.5 * Vec2::new(x, y)
        })
    }

    /// The impulse that these supports give in a blow, which moves nothing, with its impulses.
    pub fn exchange_in_blow(&self, bodies: &[Body], impulses: &[f64]) -> WorkAndImpulse {
        self.impulse(impulses, 1.0, |body, point| bodies[body].dynamics.control_points()[point])
    }

    fn impulse(
        &self,
        residual: &[f64],
        duration: f64,
        place: impl Fn(usize, usize) -> Vec2,
    ) -> WorkAndImpulse {
        let mut sum = WorkAndImpulse::default();
        for (support, reaction) in self.with_reactions(residual).skip(self.prescribed.count()) {
            let (force, moment) = support.reaction(reaction);
            let at = place(support.body, support.point);
            let angular = (cross(at, force) + moment) * duration;
            sum += WorkAndImpulse::of(0.0, force * duration, angular);
        }
        sum
    }

    /// The force [force] and the moment [force·length] on some nodes, bodies and control points, and against the rotation of bodies that turn as a whole,
    /// with the reactions of a residual; none
    /// where nothing is held.
    pub fn force_on(
        &self,
        nodes: &[(usize, usize)],
        turning: &[usize],
        residual: &[f64],
    ) -> Option<(Vec2, f64)> {
        let is_there = |support: &Support| {
            let turns = support.component == Component::Rotation && turning.contains(&support.body);
            turns || nodes.contains(&(support.body, support.point))
        };
        let mut held = self.with_reactions(residual).filter(|(at, _)| is_there(at)).peekable();
        held.peek()?;
        Some(held.fold((Vec2::zeros(), 0.0), |(force, moment), (support, reaction)| {
            let (by, turning) = support.reaction(reaction);
            (force + by, moment + turning)
        }))
    }
}
