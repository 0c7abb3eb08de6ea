//! Point masses.

use crate::beams::Place;
use crate::geometry::{Vec2, cross};

use crate::model::Model;
use crate::model::bodies::Body;

/// A mass at a place of a beam: it moves with the control points whose functions are non-zero there.
#[derive(Debug, Clone, Copy)]
pub(in crate::model) struct Lump {
    pub(in crate::model) place: Place,
    pub(in crate::model) mass: f64,
    pub(in crate::model) rotary_inertia: f64,
}

impl Lump {
    fn inertia(&self) -> [f64; 3] {
        [self.mass, self.mass, self.rotary_inertia]
    }

    pub(in crate::model) fn add_inertia(
        &self,
        body: &Body,
        factor: f64,
        rates: &[f64],
        out: &mut [f64],
    ) {
        let rate = body.at(&self.place, rates);
        for (point, weight) in self.place.weights() {
            for ((&at, inertia), rate) in
                body.degrees_of_freedom[point].iter().zip(self.inertia()).zip(rate)
            {
                out[at] += factor * weight * inertia * rate;
            }
        }
    }

    /// Gives `factor · M` to `add`: row, column and value; several of one place add up.
    pub(in crate::model) fn inertia_entries(
        &self,
        body: &Body,
        factor: f64,
        unknowns: usize,
        add: &mut impl FnMut(usize, usize, f64),
    ) {
        for (a, weight_a) in self.place.weights() {
            for (b, weight_b) in self.place.weights() {
                let degrees = body.degrees_of_freedom[a].iter().zip(&body.degrees_of_freedom[b]);
                for ((&row, &column), inertia) in degrees.zip(self.inertia()) {
                    if row < unknowns && column < unknowns {
                        add(row, column, factor * weight_a * weight_b * inertia);
                    }
                }
            }
        }
    }

    /// Twice the kinetic energy, the momentum and the angular momentum about the origin.
    pub(in crate::model) fn momenta(&self, body: &Body, rates: &[f64]) -> (f64, Vec2, f64) {
        let [vx, vy, spin] = body.at(&self.place, rates);
        let velocity = Vec2::new(vx, vy);
        let momentum = velocity * self.mass;
        let at = self.place.interpolate(body.dynamics.control_points());
        let angular = self.rotary_inertia * spin;
        (momentum.dot(&velocity) + angular * spin, momentum, cross(at, momentum) + angular)
    }
}

impl Model {
    /// Gives `factor · M` to `add`: row, column and value; several of one place add up.
    pub(in crate::model) fn inertia_entries(
        &self,
        factor: f64,
        add: &mut impl FnMut(usize, usize, f64),
    ) {
        self.bodies.iter().for_each(|body| body.inertia_entries(factor, add));
        self.inertia_entries_of_lumps(factor, add);
    }

    pub(in crate::model) fn inertia_entries_of_lumps(
        &self,
        factor: f64,
        add: &mut impl FnMut(usize, usize, f64),
    ) {
        for lump in &self.lumps {
            lump.inertia_entries(&self.bodies[lump.place.body], factor, self.unknowns, add);
        }
    }
}
