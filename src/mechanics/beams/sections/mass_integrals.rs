//! Integrals of products of two functions, from which the inertia of a beam is made.

use std::fmt::Debug;

use crate::beams::Section;
use crate::beams::dynamics::Movement;

/// An integral of a product of two functions along a beam.
pub(in crate::beams) trait MassIntegral:
    Copy + Default + Debug + Send + Sync
{
    /// Adds a product times its weight [length], where the beam has a section.
    fn add(&mut self, product: f64, section: &Section);

    /// The integral of the product alone, without inertia [length].
    fn length(self) -> f64;

    /// A factor times the inertia that belongs to it.
    fn inertia(self, factor: f64, uniform: &Section) -> Movement;
}

impl MassIntegral for f64 {
    fn add(&mut self, product: f64, _section: &Section) {
        *self += product;
    }

    fn length(self) -> f64 {
        self
    }

    #[inline]
    fn inertia(self, factor: f64, uniform: &Section) -> Movement {
        let entry = factor * self;
        let (mass, rotary) = (entry * uniform.mass_per_length, entry * uniform.rotary_inertia);
        [mass, mass, rotary]
    }
}

/// Length, mass and rotary inertia of a product of two functions.
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
    fn inertia(self, factor: f64, _uniform: &Section) -> Movement {
        let (mass, rotary) = (factor * self.mass, factor * self.rotary);
        [mass, mass, rotary]
    }
}
