//! Momenta of bodies.

use crate::geometry::Vec2;

/// Twice the kinetic energy [energy], momentum [mass·length/time] and angular momentum about the origin [mass·length²/time].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Momenta {
    pub twice_kinetic: f64,
    pub linear: Vec2,
    pub angular: f64,
}

impl std::ops::AddAssign for Momenta {
    fn add_assign(&mut self, other: Self) {
        self.twice_kinetic += other.twice_kinetic;
        self.linear += other.linear;
        self.angular += other.angular;
    }
}
