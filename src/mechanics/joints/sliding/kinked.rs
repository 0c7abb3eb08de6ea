//! Sliding rule that conserves energy, linear and angular momentum, and keeps the gap to a kinked axis closed.

use super::dual::{ContactDuals, NO_SLOPES};
use super::kink_on_path::{KinkOnPath, UNITS, vanish};
use super::{CONTACT_UNKNOWNS, Conserving, Contact, Equation, Kink, KinkState, SlidingLaw, Unit};
use crate::geometry::{Dual, DualVector};

/// Conserving sliding law for an axis with a kink, a jump of its tangent, at the slave.
/// The gap is closed at the end of every step, and energy, linear and angular momentum are conserved for any step size.
///
/// The kinked law adds the energy of the kink, which the mesh does not contain.
/// Without a [`Kink`], the law is [`Conserving`]. Derivation: docs/theory.md, sections 10 and 10.1.
#[derive(Debug, Clone, Copy)]
pub struct Kinked;

impl SlidingLaw for Kinked {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let Some(kink) = &contact.kink else { return Conserving.equations(contact) };
        vanish(imbalances(contact, kink))
    }

    fn values(&self, contact: &Contact<'_>) -> [(f64, Unit); CONTACT_UNKNOWNS] {
        let Some(kink) = &contact.kink else { return Conserving.values(contact) };
        let numbers = imbalances::<NO_SLOPES>(contact, kink);
        std::array::from_fn(|at| (numbers[at].value, UNITS[at]))
    }

    fn kink_at_end(&self, contact: &Contact<'_>) -> KinkState {
        let Some(kink) = &contact.kink else { return KinkState::default() };
        let step = KinkInStep::<NO_SLOPES>::of(&ContactDuals::of(contact), kink);
        KinkState { jump: step.jump.value(), speed: step.speed.value }
    }
}

fn imbalances<const SLOPES: usize>(
    contact: &Contact<'_>,
    kink: &Kink,
) -> [Dual<SLOPES>; CONTACT_UNKNOWNS] {
    let duals = ContactDuals::of(contact);
    let step = KinkInStep::of(&duals, kink);
    let set_in_motion = step.inertia * step.on_path.stretch;
    let balance = (duals.force - step.mean_force).dot(&duals.tangent) - set_in_motion;
    step.on_path.imbalances((contact, kink), &duals, step.jump, balance)
}

struct KinkInStep<const SLOPES: usize> {
    on_path: KinkOnPath<SLOPES>,
    speed: Dual<SLOPES>,
    jump: DualVector<SLOPES>,
    mean_force: DualVector<SLOPES>,
    inertia: Dual<SLOPES>,
}

impl<const SLOPES: usize> KinkInStep<SLOPES> {
    fn of(duals: &ContactDuals<SLOPES>, kink: &Kink) -> Self {
        let &ContactDuals { offset, tangent, tangent_change: swing, force, increment: way, .. } =
            duals;
        let (along, motion, before) =
            (&kink.along, &kink.motion, DualVector::constant(kink.before));
        let on_path = KinkOnPath::of(duals, kink);
        let &KinkOnPath { length, difference, stretch, over_square, offset_before, arm } = &on_path;

        let swung = tangent.turned().dot(&swing) * over_square * 4.0;
        let moved = tangent * way + offset - offset_before - arm.turned() * swung;
        let speed = stretch * over_square * tangent.dot(&moved) * (2.0 / motion.duration)
            - Dual::constant(motion.speed);
        let softening = Dual::constant(1.0) - speed * (motion.speed * motion.inverse_square_speed);

        let normal = tangent.turned();
        let across = force.dot(&normal) * softening.inverse() * 2.0 - before.dot(&normal);
        let direction = tangent - swing.turned() * swung;
        let turned = before.turned() * swung * 0.25;
        let rises = direction * 0.5 + (before * 0.5 + turned) * difference * kink.compliance;
        let jump =
            DualVector::with_products([normal, rises], [across, before.dot(&direction) * -0.5]);

        let mass = jump.dot(&jump) * length;
        let mass_before = along.start * kink.before.norm_squared();
        let change = mass * speed - Dual::constant(mass_before * motion.speed);
        let inertia = change * (motion.inverse_square_speed * kink.compliance / motion.duration);
        let mean_force = (before + jump) * softening * 0.5;
        Self { on_path, speed, jump, mean_force, inertia }
    }
}
