//! What an element that resists movements offers to the steps of a model: a spring, a damper.

use super::{Branch, ShortBounce, TrialState, WorkAndImpulse};
use crate::beams::{ForceSummary, Movement, SectionPlace, SpanStiffness};
use crate::geometry::Vec2;
use crate::integrators::Interval;
use crate::linalg::BandedMatrix;
use crate::system::bodies::Body;

/// What a spring measures, and its force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringTrialState {
    /// What it measures at the start of the step: a length [length] or an angle [rad].
    pub elongation: f64,
    /// The force in it, or the moment, mean of the last step [force, force·length].
    pub force: f64,
    /// Its stiffness at the start of the step; zero of a damper [force/length, force·length/rad].
    pub stiffness: f64,
}

/// An element that resists movements of bodies, with an energy that it stores or with what it dissipates.
///
/// Its force is an unknown of its own, as the section forces of beams are: where forces are taken it is used as it is, a linearisation
/// is condensed by what it would be, and it is corrected with the movements. However stiff the element is, its force then does not
/// carry the rounding of the configuration, and as many iterations do. It is called by dynamic dispatch, once an element and iterate.
pub trait InternalForce {
    /// What it is called in messages and columns.
    fn name(&self) -> &str;

    /// Prepares a step that begins with such rates of the unknowns: forces start from those of the last one.
    fn begin_step(&mut self, interval: Interval, bodies: &[Body], rates: &[f64]);

    /// Prepares a movement that takes no time, in which nothing is damped.
    fn begin_movement(&mut self);

    /// Rates have jumped: what was seen of those before tells nothing of those behind.
    fn forget_rates(&mut self) {}

    /// Adds `at.weight` times its forces on bodies, as they are; the largest of them, and how far they are from those of the configuration.
    fn add_forces(&mut self, at: TrialState<'_>, out: &mut [f64]) -> ForceSummary;

    /// Adds `at.weight` times its condensed forces, and their derivative by the increments; there are so many unknowns.
    fn add_linearised_forces(
        &mut self,
        at: TrialState<'_>,
        out: &mut [f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    );

    /// Adds `weight` times the forces that would close the mismatch met by the last forces, in the directions of the last linearisation.
    fn add_mismatch_forces(&self, bodies: &[Body], weight: f64, out: &mut [f64]);

    /// Carries a correction of the increments over to its force.
    fn correct(&mut self, bodies: &[Body], correction: &[f64]);

    /// What the ground gave to it in the step of the movements that the bodies gathered last.
    fn exchange(&self, bodies: &[Body], duration: f64) -> WorkAndImpulse;

    /// Accepts the movements that the bodies gathered last.
    fn advance(&mut self, bodies: &[Body]);

    /// The energy that is stored in it at the start of the step [energy].
    fn stored(&self) -> f64 {
        0.0
    }

    /// What it has dissipated since the start of the simulation [energy].
    fn dissipated(&self) -> f64;

    /// What the wind has given by it since the start, where there is wind [energy].
    fn wind_work(&self) -> Option<f64> {
        None
    }

    /// What it measures and its force, where it has one of each: a spring.
    fn stretched(&self) -> Option<SpringTrialState> {
        None
    }

    /// The branch of its law on which it is, with these rates of the unknowns, at the end of the last step; none where the law has no sharp corner.
    fn branch(&self, _bodies: &[Body], _rates: &[f64]) -> Option<Branch> {
        None
    }

    /// The bounce on it that lasted so few steps that they do not resolve it; none where all did.
    fn short_bounce(&self) -> Option<ShortBounce> {
        None
    }

    /// What it lets a beam, by its index, transmit at one of its places, besides what strains ask for, at such rates of the unknowns and at the start of
    /// the step: a force in space [force] and a moment [force·length]. None where it is no damping of that beam.
    fn transmitted(
        &self,
        _bodies: &[Body],
        (_beam, _place): (usize, &SectionPlace),
        _rates: &[f64],
    ) -> Option<(Vec2, f64)> {
        None
    }

    /// The beam, by its index, whose material it damps.
    fn damped_beam(&self) -> Option<usize> {
        None
    }

    /// Adds the forces of such rates of the bodies to those on them, at the start of the step.
    fn add_forces_now(&self, bodies: &[Body], rates: &[Vec<Movement>], out: &mut [f64]);

    /// Gives each rate that it damps at such rates of the unknowns, at the start of the step, behind what damps small ones: products of either with the square
    /// of the other add up to the power that it dissipates. As many are given, in the same order, at any rates.
    fn each_damped_rate(&self, bodies: &[Body], rates: &[f64], take: &mut dyn FnMut(f64, f64));

    /// Gives how it resists small movements at rest: degrees of freedom, and its rows.
    fn at_rest(&self, _bodies: &[Body], _take: &mut dyn FnMut(&[usize], &SpanStiffness)) {}

    /// Lets go at the start of a step: it acts no longer, and what it stores counts as dissipated. What cannot let go does not.
    fn let_go(&mut self) {}

    /// Makes it one that has let go, to be given a state of such a one.
    fn detach(&mut self) {}

    /// Makes it one that has not let go, to be given a state of such a one.
    fn attach(&mut self) {}

    /// Appends the state at the start of a step.
    fn save(&self, state: &mut Vec<f64>);

    /// Takes the state back, in the order in which it was appended.
    fn restore(&mut self, next: &mut dyn FnMut() -> f64);

    /// How a step uses it, in words.
    fn explain(&self) -> String;
}
