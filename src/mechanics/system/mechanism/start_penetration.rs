//! Bodies that start inside an obstacle or another body.

use super::System;
use crate::geometry::Vec2;
use crate::integrators::Stage;
use crate::system::elements::{InternalForce, Penetration, TrialState};

/// Limit of the contact force as a multiple of the resultant of the other forces on the body [-].
/// Below this limit, the penetration is attributed to the other forces.
const EXPLAINED: f64 = 2.0;

/// Largest penetration that is attributed to the approximation of the axis by the mesh, as a fraction of the largest coordinate of the body [-].
const APPROXIMATION: f64 = 1e-5;

impl System {
    /// Name of the first contact whose force has no direction at the start, and the index of the body in the contact.
    /// The contact force has no direction if a contact point lies on the axis or at the centre of the body that it touches. Obstacles are not checked.
    pub(in crate::system) fn undirected_contact(&self) -> Option<(&str, usize)> {
        self.elements.resistances().find_map(|contact| {
            let inside = contact.penetrations(&self.bodies);
            let one = inside.iter().find(|one| !one.energy.is_finite())?;
            Some((contact.name(), one.body))
        })
    }

    /// Bodies inside obstacles or other bodies at the start, with the name of the obstacle or contact, sorted by decreasing energy of the contact.
    /// Penetrations due to weight, loads and springs are left out.
    pub(crate) fn start_penetrations(&mut self) -> Vec<(String, Penetration)> {
        let bodies = &self.bodies;
        let inside = self.elements.resistances().flat_map(|obstacle| {
            let all = obstacle.penetrations(bodies).into_iter();
            all.map(|one| (obstacle.name().to_owned(), one))
        });
        let mut inside: Vec<_> =
            inside.filter(|(_, one)| one.depth > self.tolerance(one)).collect();
        // A load without a value is ignored here, because the first step reports it.
        if !inside.is_empty() && self.elements.evaluate_after(self.motion.time).is_ok() {
            let others = self.resultants_without_contact();
            inside.retain(|(_, one)| one.force > EXPLAINED * others[one.body].norm());
        }
        inside.sort_by(|(_, a), (_, b)| b.energy.total_cmp(&a.energy));
        inside
    }

    fn tolerance(&self, Penetration { body, .. }: &Penetration) -> f64 {
        let points = self.bodies[*body].dynamics.control_points();
        APPROXIMATION * points.iter().map(Vec2::amax).fold(0.0, f64::max)
    }

    /// Sums of the forces of loads, weight, springs and dampers on each body [force].
    fn resultants_without_contact(&mut self) -> Vec<Vec2> {
        let rates = self.bodies.by_control_point(&self.motion.rates);
        let joined = self.bodies.number_separately();
        let mut forces = vec![0.0; joined.iter().map(|body| 3 * body.len()).sum()];
        let at =
            TrialState { bodies: &self.bodies, stage: Stage::End, increments: &[], weight: 1.0 };
        self.elements.subtract_from(at, &mut forces);
        let is_obstacle = |one: &dyn InternalForce| one.contact().is_some();
        let others = self.elements.resistances().filter(|one| !is_obstacle(*one));
        others.for_each(|one| one.add_forces_at_start(&self.bodies, &rates, &mut forces));
        self.bodies.number_as(joined);
        let mut points = forces.chunks_exact(3).map(|force| Vec2::new(force[0], force[1]));
        rates
            .iter()
            .map(|points_of_body| points.by_ref().take(points_of_body.len()).sum())
            .collect()
    }
}
