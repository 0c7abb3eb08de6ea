//! Sliding law for a master whose kink is kept constant in a step.

use super::dual::{ContactDuals, NO_SLOPES};
use super::kink_on_path::{KinkOnPath, vanish};
use super::{CONTACT_UNKNOWNS, Conserving, Contact, Equation, Kink, KinkState, SlidingLaw};
use crate::geometry::{Dual, DualVector};

/// Sliding law for a master with a kink. In a step, the kink rotates with the master and is independent of the contact force.
/// The gap to the kinked axis is closed, and energy, linear and angular momentum are conserved for any step size.
/// Derivation: docs/theory.md, section 10.1.
#[derive(Debug, Clone, Copy)]
pub struct Frozen;

impl SlidingLaw for Frozen {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let Some(kink) = &contact.kink else { return Conserving.equations(contact) };
        let duals = ContactDuals::of(contact);
        let step = FrozenInStep::of(&duals, kink);
        let balance = (duals.force - step.inertia).dot(&step.direction) - step.energy_slope;
        vanish(step.on_path.imbalances((contact, kink), &duals, step.jump, balance))
    }

    fn kink_at_end(&self, contact: &Contact<'_>) -> KinkState {
        let Some(kink) = &contact.kink else { return KinkState::default() };
        let step = FrozenInStep::<NO_SLOPES>::of(&ContactDuals::of(contact), kink);
        KinkState { jump: step.jump.value(), speed: step.speed.value }
    }
}

struct FrozenInStep<const SLOPES: usize> {
    on_path: KinkOnPath<SLOPES>,
    direction: DualVector<SLOPES>,
    speed: Dual<SLOPES>,
    jump: DualVector<SLOPES>,
    inertia: DualVector<SLOPES>,
    energy_slope: Dual<SLOPES>,
}

impl<const SLOPES: usize> FrozenInStep<SLOPES> {
    fn of(duals: &ContactDuals<SLOPES>, kink: &Kink) -> Self {
        let &ContactDuals { tangent, tangent_change: swing, increment: way, .. } = duals;
        let (along, motion, before) =
            (&kink.along, &kink.motion, DualVector::constant(kink.before));
        let one = Dual::constant(1.0);
        let on_path = KinkOnPath::of(duals, kink);
        let &KinkOnPath { length, difference, stretch, over_square, .. } = &on_path;

        let turn = tangent.turned().dot(&swing) * over_square * 2.0;
        let jump = (before * (one - turn * turn) + before.turned() * (turn * 2.0))
            * (one + turn * turn).inverse();
        let opened = (before + before.turned() * turn) * difference * kink.compliance;
        let direction = tangent - swing.turned() * (turn * 2.0) + opened;

        let unit = tangent * (stretch * over_square);
        let speed =
            unit.dot(&direction) * way * (2.0 / motion.duration) - Dual::constant(motion.speed);
        let energy = kink.before.norm_squared() * kink.compliance;
        let change = (length * speed - Dual::constant(along.start * motion.speed))
            * (energy * motion.inverse_square_speed / motion.duration);
        let softening = one - speed * (motion.speed * motion.inverse_square_speed);
        let energy_slope = softening * difference * (0.5 * energy);
        Self { on_path, direction, speed, jump, inertia: unit * change, energy_slope }
    }
}
