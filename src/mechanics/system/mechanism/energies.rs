//! The energy of a single body.

use super::System;

/// The energy of a body with what stands on it, by kind [energy].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyEnergy {
    /// The energy of the motion of the body, and of point masses on it.
    pub kinetic: f64,
    /// The energy of stretching, `½ ∫ EA Γ1² dX`.
    pub axial: f64,
    /// The energy of shear, `½ ∫ GA Γ2² dX`, with that of kinks under sliders.
    pub shear: f64,
    /// The energy of bending, `½ ∫ EI κ² dX`.
    pub bending: f64,
    /// The potential energy in gravity, zero at the origin.
    pub potential: f64,
}

impl BodyEnergy {
    /// The energy of stretching, shear and bending together.
    pub fn strain(&self) -> f64 {
        self.axial + self.shear + self.bending
    }

    /// All together.
    pub fn total(&self) -> f64 {
        self.kinetic + self.strain() + self.potential
    }
}

impl System {
    /// The energy of a body: beams come first, then particles, then rigid bodies.
    pub fn energy_of(&mut self, body: usize) -> BodyEnergy {
        let rates = &self.motion.rates;
        let own = self.bodies[body].momenta(rates).twice_kinetic;
        let carried = self.elements.twice_kinetic_on(&self.bodies, body, rates);
        let [axial, shear, bending] = self.bodies[body].dynamics.strain_energies();
        let shear = shear + self.sliders.strain_energy(Some(body));
        let potential = self.elements.potential_of(&self.bodies, body);
        let kinetic = 0.5 * (own + carried) + self.sliders.kinetic_energy(Some(body));
        BodyEnergy { kinetic, axial, shear, bending, potential }
    }
}
