//! Integrals of products of two basis functions, for the inertia matrix of a beam.

use std::fmt::Debug;

use crate::beams::Section;
use crate::beams::dynamics::Movement;

pub(in crate::beams) trait MassIntegral:
    Copy + Default + Debug + Send + Sync
{
    fn add(&mut self, product: f64, section: &Section);

    /// Integral of the product of the two basis functions, without the inertia per length [length].
    fn length(self) -> f64;

    fn weights(self) -> Movement;

    fn shares(uniform: &Section) -> Movement;

    #[inline]
    fn inertia(self, factor: f64, uniform: &Section) -> Movement {
        let (weights, shares) = (self.weights(), Self::shares(uniform));
        std::array::from_fn(|component| factor * weights[component] * shares[component])
    }
}

impl MassIntegral for f64 {
    fn add(&mut self, product: f64, _section: &Section) {
        *self += product;
    }

    fn length(self) -> f64 {
        self
    }

    #[inline]
    fn weights(self) -> Movement {
        [self; 3]
    }

    #[inline]
    fn shares(uniform: &Section) -> Movement {
        let (mass, rotary) = (uniform.mass_per_length, uniform.rotary_inertia);
        [mass, mass, rotary]
    }
}

#[derive(Debug, Clone, Copy, Default)]
pub(in crate::beams) struct SectionIntegral {
    length: f64,
    mass: f64,
    rotary: f64,
}

impl MassIntegral for SectionIntegral {
    fn add(&mut self, product: f64, section: &Section) {
        self.length += product;
        self.mass += product * section.mass_per_length;
        self.rotary += product * section.rotary_inertia;
    }

    fn length(self) -> f64 {
        self.length
    }

    #[inline]
    fn weights(self) -> Movement {
        [self.mass, self.mass, self.rotary]
    }

    #[inline]
    fn shares(_uniform: &Section) -> Movement {
        [1.0; 3]
    }
}
