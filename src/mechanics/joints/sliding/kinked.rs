//! Sliding rule that conserves energy, linear and angular momentum and the closed gap to a kinked axis.

use super::dual::{ContactDuals, Dual, DualVector, NO_SLOPES};
use super::kink_on_path::{KinkOnPath, UNITS, vanish};
use super::{CONTACT_UNKNOWNS, Conserving, Contact, Equation, Kink, KinkState, SlidingLaw, Unit};

/// Conserving sliding law for an axis with a kink.
/// The gap is closed at the end of every step, and energy, linear and angular momentum are conserved for any step size.
///
/// ```text
/// closed gap at the end:  x_s1 = Σ B_i(ξ1) x_i1 + g1 a1
/// balance of moments:     |τ|² χ + (r × λ) Jτ = 0
/// arm of the force:       r = Δξ d + ½ (g0 a0 + g1 a1)
/// jump of the tangent:    ā·w + (Δg/Δξ) (½ a0·a1 + b a0 × a1) = 0
/// direction of the path:  w = τ - 4 b J d with b = Jτ·d/|τ|²
/// contact force:          λ = (GA - ρA v0 v1) ā + (Δπ/Δt) (Δs/Δξ) τ/|τ|²
/// momentum of the kink:   π = ρA g |a|² v
/// speed of the kink:      ½ (v0 + v1) Δt = (Δs/Δξ) τ·u/|τ|²
/// abbreviation:           u = Δξ τ + Δ(g a) - 4 b J r
/// ```
///
/// The slave is on the axis, which has a kink under the contact force.
/// The tangent of the axis jumps by `a` at the slave, and the kink moves along the master with the speed `v`.
/// The mesh does not contain the energy `½ g |a|² (GA + ρA v²)` of the kink.
/// In the energy of the kink, `ρA` is slightly larger than the mass per length of the beam.
/// The jump at the end of the step follows from the equation for the jump of the tangent, and from the component of `λ` across the master.
/// The remaining equation is the balance of forces along the master. Without a [`Kink`] the law is [`Conserving`].
/// Derivation: docs/theory.md, sections 10 and 10.1.
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
    let jets = ContactDuals::of(contact);
    let step = KinkInStep::of(&jets, kink);
    let set_in_motion = step.inertia * step.on_path.stretch;
    let balance = (jets.force - step.mean_force).dot(&jets.tangent) - set_in_motion;
    step.on_path.imbalances((contact, kink), &jets, step.jump, balance)
}

struct KinkInStep<const SLOPES: usize> {
    on_path: KinkOnPath<SLOPES>,
    /// Speed `v1` of the kink along the master at the end of the step [length/time].
    speed: Dual<SLOPES>,
    /// Force `p1 = GA a1` of the jump `a1` of the tangent at the end of the step [force].
    jump: DualVector<SLOPES>,
    /// Mean force of the kink, `κ ½ (p0 + p1)`, with `κ = 1 - ρA v0 v1/GA` [force].
    mean_force: DualVector<SLOPES>,
    /// Inertia force of the kink: `Δπ/Δt` [force].
    inertia: Dual<SLOPES>,
}

impl<const SLOPES: usize> KinkInStep<SLOPES> {
    fn of(jets: &ContactDuals<SLOPES>, kink: &Kink) -> Self {
        let &ContactDuals { offset, tangent, tangent_change: swing, force, increment: way, .. } =
            jets;
        let (along, motion, before) =
            (&kink.along, &kink.motion, DualVector::constant(kink.before));
        let on_path = KinkOnPath::of(jets, kink);
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
