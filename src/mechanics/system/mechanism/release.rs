//! Releases of joints and drives. Degrees of freedom tied by a joint have a common number. A release gives them separate numbers.
//!
//! A release changes neither positions nor rates. Energy and momenta of the bodies are unchanged to the last bit.

use super::System;
use crate::beams::BodyPoint;
use crate::integrators::Mechanism;
use crate::joints::Releasable;
use crate::linalg::BlockLayout;
use crate::system::elements::{PrescribedMovement, Support, Supports};
use crate::system::state::{StepMeasures, Unknowns};

pub struct DofNumbers {
    pub degrees_of_freedom: Vec<Vec<[usize; 3]>>,
    pub links: Vec<[usize; 2]>,
    /// Force unknowns of inclined rollers; `None` for a released roller.
    pub rollers: Vec<Option<usize>>,
    pub prescribed: Vec<PrescribedMovement>,
    /// Fixed degrees of freedom, in the order of their numbers.
    pub held: Vec<Support>,
    pub unknowns: Unknowns,
    pub joined: Vec<(BodyPoint, BodyPoint)>,
    /// Blocks for the separate elimination of contacts; `None` if all contacts are eliminated together.
    pub contacts: Option<BlockLayout>,
}

impl System {
    pub(in crate::system) fn renumber(&mut self, numbers: DofNumbers) {
        let moving = self.bodies.by_control_point(&self.motion.rates);
        let DofNumbers { degrees_of_freedom, prescribed, held, unknowns, joined, contacts, .. } =
            numbers;
        let count = unknowns.count();
        self.sliders.renumber(contacts);
        self.unknowns = unknowns;
        self.bodies.renumber(degrees_of_freedom, count, joined);
        self.links.renumber(numbers.links.into_iter(), numbers.rollers.into_iter());
        let movements = std::mem::take(self.supports.prescribed_mut()).with(prescribed, count);
        let mut rates = vec![0.0; count + movements.in_step().width()];
        self.supports = Supports::new(movements, held);
        for (body, moving) in self.bodies.iter().zip(&moving) {
            for (degrees, movement) in body.degrees_of_freedom.iter().zip(moving) {
                for (at, rate) in degrees.iter().zip(movement) {
                    rates.get_mut(*at).into_iter().for_each(|own| *own = *rate);
                }
            }
        }
        self.links.write_forces(&mut rates);
        let inertia = self.diagonal_of_inertia();
        self.motion
            .renumber(rates, inertia, |body| self.bodies[body].degrees_of_freedom.below(count));
        self.step = StepMeasures::new(self.degrees_of_freedom());
    }

    pub(in crate::system) fn release_spring(&mut self, spring: usize) {
        self.elements.release(spring);
        self.motion.accelerations.mark_unknown();
    }

    pub(in crate::system) fn detach_springs(&mut self, released: &[Releasable]) {
        self.elements.detach_only(|spring| released.contains(&Releasable::Spring(spring)));
    }
}
