//! Energy and momenta of a model.

use serde::{Deserialize, Serialize};

use super::Model;
use crate::geometry::{Vec2, larger};

/// The energy of a model, in parts [energy].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Energy {
    /// `½ ∫ ρA |ẋ|² + ρI θ̇² dX`, and that of point masses.
    pub kinetic: f64,
    /// `½ ∫ Γ·CΓ + EI κ² dX`
    pub strain: f64,
    /// Of gravity, zero at the origin.
    pub potential: f64,
    /// `Σ U`, in springs and tendons.
    pub stored: f64,
}

impl Energy {
    /// Their sum.
    pub fn total(&self) -> f64 {
        self.kinetic + self.strain + self.potential + self.stored
    }
}

/// What is measured of a model at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Measures {
    /// Time.
    pub time: f64,
    /// `E`, in parts.
    pub energy: Energy,
    /// `W`: work of the loads so far [energy].
    pub work: f64,
    /// `D`: what dampers have dissipated so far [energy].
    pub dissipated: f64,
    /// `p` [mass·length/time]
    pub momentum: Vec2,
    /// `∫ F dt` of loads, gravity and supports so far.
    pub impulse: Vec2,
    /// `L` about the origin [mass·length²/time].
    pub angular_momentum: f64,
    /// `∫ M dt` of loads, gravity and supports so far, about the origin.
    pub angular_impulse: f64,
    /// `∫ |F| dt`, every load and support by itself.
    pub gross_impulse: f64,
    /// `∫ |M| dt`, every load and support by itself.
    pub gross_angular_impulse: f64,
    /// The largest distance between the partners of a joint [length].
    pub gap: f64,
}

impl Model {
    /// Energy, momenta and what was exchanged so far.
    pub fn measure(&mut self) -> Measures {
        let rates = &self.motion.rates;
        let mut momenta = self.bodies.momenta(rates);
        self.elements.add_momenta(&self.bodies, rates, &mut momenta);
        let energy = Energy {
            kinetic: 0.5 * momenta.twice_kinetic,
            strain: self.bodies.strain_energy(),
            potential: self.elements.energy(&self.bodies),
            stored: self.elements.stored(),
        };
        Measures {
            time: self.motion.time,
            energy,
            work: self.exchanged.work,
            dissipated: self.elements.dissipated(),
            momentum: momenta.linear,
            impulse: self.exchanged.impulse,
            angular_momentum: momenta.angular,
            angular_impulse: self.exchanged.angular_impulse,
            gross_impulse: self.exchanged.gross_impulse,
            gross_angular_impulse: self.exchanged.gross_angular_impulse,
            gap: larger(self.bodies.largest_gap(), self.sliders.largest_gap(&self.bodies)),
        }
    }
}
