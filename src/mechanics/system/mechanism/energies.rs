//! Energy of a single body.

use super::System;

/// Energies of a body, including its point masses [energy].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyEnergy {
    /// Kinetic energy of the body [energy].
    pub kinetic: f64,
    /// Axial strain energy of the body [energy].
    pub axial: f64,
    /// Shear strain energy of the body, including the energy of kinks (jumps of the tangent under sliders) [energy].
    pub shear: f64,
    /// Bending strain energy of the body [energy].
    pub bending: f64,
    /// Potential energy of the body in gravity, relative to the origin of coordinates [energy].
    pub potential: f64,
}

impl BodyEnergy {
    /// Sum of the axial, shear and bending strain energies of the body [energy].
    pub fn strain(&self) -> f64 {
        self.axial + self.shear + self.bending
    }

    /// Sum of the kinetic, strain and potential energies of the body [energy].
    pub fn total(&self) -> f64 {
        self.kinetic + self.strain() + self.potential
    }
}

impl System {
    /// Energy of a body. Body indices count beams first, then particles, then rigid bodies.
    pub fn energy_of(&mut self, body: usize) -> BodyEnergy {
        let rates = &self.motion.rates;
        let own = self.bodies[body].momenta(rates).twice_kinetic;
        let carried = self.elements.double_kinetic_energy(&self.bodies, body, rates);
        let [axial, shear, bending] = self.bodies[body].dynamics.strain_energies();
        let shear = shear + self.sliders.strain_energy(Some(body));
        let potential = self.elements.potential_of(&self.bodies, body);
        let kinetic = 0.5 * (own + carried) + self.sliders.kinetic_energy(Some(body));
        BodyEnergy { kinetic, axial, shear, bending, potential }
    }
}
