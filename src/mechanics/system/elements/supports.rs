//! Supports and their reactions.

use super::{PrescribedMovements, WorkAndImpulse};
use crate::geometry::{Vec2, cross};
use crate::joints::Component;
use crate::system::bodies::Body;

#[derive(Debug, Clone, Copy)]
pub struct Support {
    pub body: usize,
    pub point: usize,
    pub component: Component,
}

impl Support {
    pub fn reaction(&self, reaction: f64) -> (Vec2, f64) {
        match self.component {
            Component::X => (Vec2::new(reaction, 0.0), 0.0),
            Component::Y => (Vec2::new(0.0, reaction), 0.0),
            Component::Rotation => (Vec2::zeros(), reaction),
        }
    }
}

/// Supported degrees of freedom of a model. They are numbered after the unknowns and the contact unknowns:
/// first the prescribed, then the fixed degrees of freedom.
pub struct Supports {
    prescribed: PrescribedMovements,
    held: Vec<Support>,
}

impl Supports {
    pub fn new(prescribed: PrescribedMovements, held: Vec<Support>) -> Self {
        Self { prescribed, held }
    }

    pub fn count(&self) -> usize {
        self.prescribed.count() + self.held.len()
    }

    pub fn iter(&self) -> impl Iterator<Item = &Support> {
        self.prescribed.supports().chain(&self.held)
    }

    pub fn held(&self) -> impl Iterator<Item = &Support> {
        self.held.iter()
    }

    pub fn prescribed(&self) -> &PrescribedMovements {
        &self.prescribed
    }

    pub fn prescribed_mut(&mut self) -> &mut PrescribedMovements {
        &mut self.prescribed
    }

    fn with_reactions<'a>(
        &'a self,
        residual: &'a [f64],
    ) -> impl Iterator<Item = (&'a Support, f64)> {
        let first = residual.len() - self.count();
        self.iter().zip(residual[first..].iter().copied())
    }

    /// Impulse of the fixed supports in the step whose increments are stored in the bodies.
    ///
    /// The reaction acts at the mean position of the support in the step. This position matters because a roller moves along its free direction.
    pub fn exchange(&self, bodies: &[Body], residual: &[f64], duration: f64) -> WorkAndImpulse {
        self.impulse(residual, duration, |body, point| {
            let [x, y, _] = bodies[body].moved()[point];
            bodies[body].dynamics.control_points()[point] + 0.5 * Vec2::new(x, y)
        })
    }

    pub fn impact_exchange(&self, bodies: &[Body], impulses: &[f64]) -> WorkAndImpulse {
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

    /// Reaction of the supports at the given nodes: force [force] and moment [force·length]. Each node is a pair of body and control point.
    /// The moment includes the supports of the rotations of the rigid bodies `turning`, which may be at other points of these bodies.
    /// The result is `None` if none of these supports exists.
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
