//! What an integrator may ask of the mechanical system that it advances.

use super::{FailureSource, Interval, PrescribedKinematics, StepError};
use crate::linalg::{BandedMatrix, BlockLayout, Border, BorderShape};
use crate::newton::ResidualPart;

/// The place in a step where forces are taken. Increments are counted from the start of the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stage {
    /// Forces are taken at the start of the step, loads as they are just after it.
    Start,
    /// Forces are taken between start and end: mean configuration, averaged section forces, mean loads.
    ///
    /// The internal forces then do exactly the work by which the strain energy changes
    /// (Stander & Stein 1996; Simo, Tarnow & Doblaré 1995).
    Midpoint,
    /// As at the [midpoint](Self::Midpoint), loads too, but with section forces of a later strain: half of its change times
    /// this number `χ` is added to its mean.
    ///
    /// The internal forces then do more work than that by `χ/2` times the integral of `ΔΓ·C ΔΓ + EI Δκ²`.
    DampedMidpoint(f64),
    /// Forces are taken at the end of the step, loads as they are just before it.
    End,
}

impl Stage {
    /// The stages at which loads have values of their own, in the order of time.
    pub const ALL: [Self; 3] = [Self::Start, Self::Midpoint, Self::End];
}

/// The constant inertia matrix `M` of a mechanical system.
pub trait Inertia {
    /// Adds `factor · M · rates` to `out`, one entry for each unknown movement.
    fn add_inertia(&mut self, factor: f64, rates: &[f64], out: &mut [f64]);

    /// Adds the inertia `factor · M` to the tangent.
    fn add_inertia_tangent(&self, factor: f64, tangent: &mut BandedMatrix);
}

/// The forces of a mechanical system, which depend on its configuration.
///
/// Section forces may be unknowns of their own, which forces are condensed by and which are corrected with the increments.
pub trait Forces {
    /// Adds `weight` times the forces of a stage (internal minus loads), as its section forces have them, to `out`.
    ///
    /// Returns the largest mismatch between the strain of the section forces and that of the configuration.
    fn add_forces(&mut self, stage: Stage, increments: &[f64], weight: f64, out: &mut [f64])
    -> f64;

    /// Adds `weight` times the condensed forces of a stage to `out`, and their derivative by the increments to the tangent.
    fn add_linearised_forces(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    );

    /// Adds `weight` times the forces that would close the strain mismatch met by the last forces, in the directions
    /// of the last linearisation.
    fn add_mismatch_forces(&mut self, weight: f64, out: &mut [f64]);

    /// Carries a correction of the increments over to the section forces of the last linearisation.
    fn correct_section_forces(&mut self, correction: &[f64]);

    /// The largest residual of a movement, relative to the forces that balance in this step [-].
    fn relative_imbalance(&self, residual: &[f64]) -> f64;

    /// What is worst where a residual was left, of that part of its imbalance which is. For messages; it changes nothing.
    fn worst(&self, _part: ResidualPart, _residual: &[f64]) -> Option<FailureSource> {
        None
    }

    /// The largest rotation increment `Δω` that the last forces met at any section [rad].
    fn largest_rotation(&self) -> f64;
}

/// The constraints of a mechanical system, with unknowns of their own.
pub trait Constraints {
    /// How many unknowns the constraints of the mechanism add, and how many entries their equations may have.
    fn constraint_shape(&self) -> BorderShape;

    /// The blocks that the unknowns of the constraints form, where these are better eliminated one by one than together; each has five.
    fn constraint_blocks(&self) -> Option<&BlockLayout> {
        None
    }

    /// Guesses the unknowns of the constraints for a step over the interval.
    fn predict_constraints(&mut self, interval: Interval, unknowns: &mut [f64]);

    /// Adds the forces of the constraints to `out`, and behind the movements by how much the constraints are violated.
    fn add_constraints(&mut self, increments: &[f64], unknowns: &[f64], out: &mut [f64]);

    /// Adds forces and violations of the constraints to `out`, and their derivatives by the increments and by the unknowns of the constraints to the
    /// tangent.
    fn add_linearised_constraints(
        &mut self,
        increments: &[f64],
        unknowns: &[f64],
        out: &mut [f64],
        border: &mut Border,
    );

    /// The largest violation of a constraint, relative to its size [-].
    fn relative_violation(&self, residual: &[f64]) -> f64;

    /// Whether the unknowns of the constraints are such that the step may be accepted.
    ///
    /// # Errors
    /// When a constraint ends within the step, or not where it should.
    fn check_constraints(&mut self, unknowns: &[f64]) -> Result<(), Overshoot>;

    /// The shortest chord of a way along a constraint in the mean configuration that the last forces met, relative to the length
    /// of that way as it is built [-].
    fn shortest_chord(&self) -> f64;
}

/// A mechanical system that integrators advance: its unknowns, its state, and the present step.
///
/// Increments and rates are those of the movements that are unknown. Constraints add unknowns of their own (contact forces,
/// places of contacts), which have no inertia and stand behind the movements, with as many equations. Forces have, after the
/// entries of all these, those of the supported degrees of freedom, which do not move, or move as is prescribed: what is left of a
/// residual there is the reaction of the supports. Where movements are prescribed, increments and rates have as many entries as
/// lead up to them.
pub trait Mechanism: Inertia + Forces + Constraints {
    /// The number of unknown movements of the mechanism in a step.
    fn unknowns(&self) -> usize;

    /// The number of entries of a force vector of the mechanism: movements, constraints and supported degrees of freedom.
    fn degrees_of_freedom(&self) -> usize;

    /// The half-bandwidth of the tangent of the mechanism: how far from the diagonal it has entries.
    fn half_bandwidth(&self) -> usize;

    /// How many threads may work on the equations of the mechanism at once, with the same results.
    fn threads(&self) -> usize {
        1
    }

    /// The rates of the unknown movements at the start of the step [length/time, 1/time].
    fn rates(&self) -> &[f64];

    /// The rates with which the unknown movements of the next step may be guessed [length/time, 1/time].
    fn expected_rates(&self) -> &[f64];

    /// The movements that are prescribed in the present step.
    fn prescribed(&self) -> &PrescribedKinematics;

    /// Prepares a step that takes forces at the given stages: evaluates what depends on time only.
    ///
    /// # Errors
    /// When a load has no finite value.
    fn begin_step(&mut self, interval: Interval, stages: &[Stage]) -> Result<(), StepError>;

    /// Accepts a step of the mechanism: new configuration and rates, work and impulse of loads and supports.
    fn advance(&mut self, solution: &Solution<'_>);

    /// The mechanism as one that remembers a state, for methods that go back within a step.
    fn checkpoint(&mut self) -> &mut dyn Checkpoint;

    /// The mechanism as one that keeps accelerations, for methods whose state they are a part of.
    fn accelerated(&mut self) -> &mut dyn Accelerated;
}

/// A mechanical system that remembers one of its states: what a method asks for whose steps have parts.
pub trait Checkpoint {
    /// Remembers the present state of the mechanism, at the start of a step, in the place of the one remembered before.
    fn keep(&mut self);

    /// Goes back to the state of the mechanism that is remembered, bit for bit.
    fn go_back(&mut self);
}

/// A mechanical system with accelerations as a part of its state: what a method asks for that uses those of the step before.
pub trait Accelerated {
    /// Makes accelerations a part of the mechanism's state from here on; they are unknown until they are set.
    fn keep_accelerations(&mut self);

    /// The accelerations just after the start of the step that has begun, if they are known [length/time², 1/time²].
    fn accelerations(&self) -> Option<&[f64]>;

    /// Sets the accelerations of the mechanism [length/time², 1/time²], where they are kept.
    fn set_accelerations(&mut self, accelerations: &[f64]);
}

/// What an integrator has found in a step.
#[derive(Debug, Clone, Copy)]
pub struct Solution<'a> {
    /// The increments of the movements in the step [length, rad].
    pub increments: &'a [f64],
    /// The unknowns of the constraints that the step has found, in the units of each.
    pub constraints: &'a [f64],
    /// The rates of the movements at the end of the step [length/time, 1/time].
    pub rates: &'a [f64],
    /// What is left of the equations of the step [force, force·length]; reactions at supported degrees of freedom.
    pub residual: &'a [f64],
    /// The stages at which forces were taken, with their shares [-]: what these did, with constraints and supports, changed the momenta. Empty
    /// where the method balances accelerations of its own, and not the change of the rates.
    pub balanced: &'a [(Stage, f64)],
}

/// A limit of a constraint that is passed within a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overshoot {
    /// The number of the limit that is passed, among those of its constraint.
    pub limit: usize,
    /// How far beyond its limit the constraint was found [length]; negative when it should have come further.
    pub distance: f64,
}
