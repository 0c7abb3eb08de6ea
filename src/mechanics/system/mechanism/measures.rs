//! Energy and momenta of a mechanism.

use serde::{Deserialize, Serialize};

use super::System;
use crate::geometry::{Vec2, larger};

/// Energy of a mechanism by type [energy].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Energy {
    /// Kinetic energy, including point masses and moving kinks under sliders [energy].
    pub kinetic: f64,
    /// Strain energy, including kinks under sliders and energy stored in stops [energy].
    pub strain: f64,
    /// Potential energy of gravity, relative to the origin [energy].
    pub potential: f64,
    /// Potential energy of springs, tendons, brakes, obstacles and contacts between bodies [energy].
    pub stored: f64,
}

impl Energy {
    /// Sum of kinetic, strain, potential and stored energy [energy].
    pub fn total(&self) -> f64 {
        self.kinetic + self.strain + self.potential + self.stored
    }
}

/// Energy, momenta, work and impulse of a mechanism at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Measures {
    /// Time of the measures [time].
    pub time: f64,
    /// Energy by type [energy].
    pub energy: Energy,
    /// Work of loads, drives and wind so far [energy].
    pub work: f64,
    /// Energy dissipated by dampers, drag and friction, and lost in impacts, so far [energy].
    pub dissipated: f64,
    /// Linear momentum [mass·length/time].
    pub momentum: Vec2,
    /// Impulse of all external forces so far [force·time].
    pub impulse: Vec2,
    /// Angular momentum about the origin [mass·length²/time].
    pub angular_momentum: f64,
    /// Angular impulse of all external forces about the origin so far [force·length·time].
    pub angular_impulse: f64,
    /// Sum of the magnitudes of all impulses so far, added up separately for each external force [force·time].
    pub gross_impulse: f64,
    /// Sum of the magnitudes of all angular impulses so far, added up separately for each external force [force·length·time].
    pub gross_angular_impulse: f64,
    /// Largest distance between the partners of a joint, of a slider or of a rigid link, or of an inclined roller from its line [length].
    pub gap: f64,
}

impl System {
    /// Evaluates energy, momenta, work and impulse.
    pub fn measure(&mut self) -> Measures {
        let rates = &self.motion.rates;
        let mut momenta = self.bodies.momenta(rates);
        self.elements.add_momenta(&self.bodies, rates, &mut momenta);
        let energy = Energy {
            kinetic: 0.5 * momenta.twice_kinetic + self.sliders.kinetic_energy(None),
            strain: self.bodies.strain_energy() + self.sliders.strain_energy(None),
            potential: self.elements.energy(&self.bodies),
            stored: self.elements.stored(),
        };
        Measures {
            time: self.motion.time,
            energy,
            work: self.exchanged.total.work,
            dissipated: self.elements.dissipated() + self.sliders.lost_energy(),
            momentum: momenta.linear,
            impulse: self.exchanged.total.impulse,
            angular_momentum: momenta.angular,
            angular_impulse: self.exchanged.total.angular_impulse,
            gross_impulse: self.exchanged.total.gross_impulse,
            gross_angular_impulse: self.exchanged.total.gross_angular_impulse,
            gap: larger(
                larger(self.bodies.largest_gap(), self.sliders.largest_gap(&self.bodies)),
                self.links.largest_gap(&self.bodies),
            ),
        }
    }
}
