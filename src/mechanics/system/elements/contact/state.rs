//! Data structures for the state of a contact, and for the penetration of a body at the start of a simulation.

use crate::geometry::Vec2;

/// State of the contact with an obstacle or between bodies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactState {
    /// Contact force on the bodies that touch an obstacle, or on the first body of a contact between bodies, averaged over the last step [force].
    pub force: Vec2,
    /// Sum of the friction forces on the same bodies along the surface, averaged over the last step, positive to the right of the normal [force].
    pub friction: f64,
    /// Number of contact points with a negative gap.
    pub closed: usize,
}

/// Body whose contact points lie inside an obstacle or another body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Penetration {
    /// Index of the penetrating body in the model.
    pub body: usize,
    /// Largest penetration of a contact point [length].
    pub depth: f64,
    /// Magnitude of the sum of the elastic contact forces on the body [force].
    pub force: f64,
    /// Energy stored in the contacts of the body [energy]; infinite if a contact force has no direction.
    pub energy: f64,
}
