//! Energy and momenta of a model.

use serde::{Deserialize, Serialize};

use super::System;
use crate::geometry::{Vec2, larger};

/// The energy of a model, in parts [energy].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Energy {
    /// The kinetic energy `½ ∫ ρA |ẋ|² + ρI θ̇² dX`, with that of point masses and of kinks that move with sliders [energy].
    pub kinetic: f64,
    /// The strain energy `½ ∫ Γ·CΓ + EI κ² dX`, with that of kinks under sliders and of stops on which sliders lean [energy].
    pub strain: f64,
    /// The potential energy of gravity, zero at the origin [energy].
    pub potential: f64,
    /// `Σ U`, in springs and tendons.
    pub stored: f64,
}

impl Energy {
    /// The sum of kinetic, strain and potential energy [energy].
    pub fn total(&self) -> f64 {
        self.kinetic + self.strain + self.potential + self.stored
    }
}

/// What is measured of a model at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Measures {
    /// The time at which the model is measured [time].
    pub time: f64,
    /// The energy `E` of the model, in parts [energy].
    pub energy: Energy,
    /// The work `W` of the loads so far [energy].
    pub work: f64,
    /// `D`: what dampers have dissipated so far, and what was lost in blows [energy].
    pub dissipated: f64,
    /// The linear momentum `p` of the model [mass·length/time].
    pub momentum: Vec2,
    /// The impulse `∫ F dt` of loads, gravity and supports so far [force·time].
    pub impulse: Vec2,
    /// The angular momentum `L` of the model about the origin [mass·length²/time].
    pub angular_momentum: f64,
    /// The angular impulse `∫ M dt` of loads, gravity and supports so far, about the origin [force·length·time].
    pub angular_impulse: f64,
    /// The sum `∫ |F| dt` of the magnitudes of impulses so far, every load and support by itself [force·time].
    pub gross_impulse: f64,
    /// The sum `∫ |M| dt` of the magnitudes of angular impulses so far, every load and support by itself [force·length·time].
    pub gross_angular_impulse: f64,
    /// The largest distance between the partners of a joint of the model [length].
    pub gap: f64,
}

impl System {
    /// Measures energy and momenta of the model, and work and impulse so far.
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
            dissipated: self.elements.dissipated() + self.sliders.lost(),
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
