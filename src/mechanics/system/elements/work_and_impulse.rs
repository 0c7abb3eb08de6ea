//! Work and impulse that a model exchanges with its surroundings.

use crate::geometry::Vec2;

/// Sums of work [energy], impulse [force·time] and angular impulse about the origin [force·length·time].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WorkAndImpulse {
    pub work: f64,
    pub impulse: Vec2,
    pub angular_impulse: f64,
    /// Sum of the magnitudes of all impulses [force·time].
    pub gross_impulse: f64,
    pub gross_angular_impulse: f64,
}

impl WorkAndImpulse {
    pub fn of(work: f64, impulse: Vec2, angular_impulse: f64) -> Self {
        let (gross_impulse, gross_angular_impulse) = (impulse.norm(), angular_impulse.abs());
        Self { work, impulse, angular_impulse, gross_impulse, gross_angular_impulse }
    }

    pub fn negated(self) -> Self {
        Self {
            gross_impulse: -self.gross_impulse,
            gross_angular_impulse: -self.gross_angular_impulse,
            ..self
        }
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.work, self.impulse.x, self.impulse.y]);
        state.extend([self.angular_impulse, self.gross_impulse, self.gross_angular_impulse]);
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.work = next();
        self.impulse = Vec2::new(next(), next());
        (self.angular_impulse, self.gross_impulse) = (next(), next());
        self.gross_angular_impulse = next();
    }
}

impl std::ops::AddAssign for WorkAndImpulse {
    fn add_assign(&mut self, other: Self) {
        self.work += other.work;
        self.impulse += other.impulse;
        self.angular_impulse += other.angular_impulse;
        self.gross_impulse += other.gross_impulse;
        self.gross_angular_impulse += other.gross_angular_impulse;
    }
}
