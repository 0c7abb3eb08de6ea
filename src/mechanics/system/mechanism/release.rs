//! Letting go: joints and drives tie movements by giving them one number, and what lets go gives them numbers of their own.
//!
//! Nothing is moved by that, and no rate jumps: energy and momenta of the bodies stay, to the last bit.

use super::System;
use crate::beams::BodyPoint;
use crate::integrators::Mechanism;
use crate::joints::Releasable;
use crate::linalg::BlockLayout;
use crate::system::elements::{PrescribedMovement, Support, Supports};
use crate::system::state::{StepMeasures, Unknowns};

/// Numbers for all movements of a model, and what follows from them.
pub struct DofNumbers {
    /// The degree of freedom of each component of each control point of each body.
    pub degrees_of_freedom: Vec<Vec<[usize; 3]>>,
    /// The unknowns of the forces of rigid links.
    pub links: Vec<[usize; 2]>,
    /// The unknowns of the forces of inclined rollers, none of those that have let go.
    pub rollers: Vec<Option<usize>>,
    /// The movements that are prescribed, in the order of their numbers.
    pub prescribed: Vec<PrescribedMovement>,
    /// The movements that are held, in the order of their numbers.
    pub held: Vec<Support>,
    /// What is left unknown.
    pub unknowns: Unknowns,
    /// The places that joints hold together.
    pub joined: Vec<(BodyPoint, BodyPoint)>,
    /// The contacts of sliders, where they are eliminated one by one.
    pub contacts: Option<BlockLayout>,
}

impl System {
    /// Numbers all movements anew; the state of motion stays.
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

    /// Lets go of a spring, by its index: it acts no longer, and what it stored counts as dissipated.
    pub(in crate::system) fn let_go_of_spring(&mut self, spring: usize) {
        self.elements.let_go(spring);
        self.motion.accelerations.forget();
    }

    /// Makes exactly these springs ones that have let go, to be given a state of such ones.
    pub(in crate::system) fn detach_springs(&mut self, released: &[Releasable]) {
        self.elements.detach_only(|spring| released.contains(&Releasable::Spring(spring)));
    }
}
