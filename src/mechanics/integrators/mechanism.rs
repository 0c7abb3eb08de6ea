//! Interface between integrators and a mechanical system.

use super::{FailureSource, Interval, PrescribedKinematics, StepError};
use crate::linalg::{BandedMatrix, BlockLayout, Border, BorderShape};
use crate::newton::ResidualPart;

/// Time within a step at which forces are taken. Increments are relative to the start of the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stage {
    /// Start of the step, with loads at the start of a line that has their mean and their change over the step.
    Start,
    /// Middle of the step: mean configuration, averaged section forces, mean loads.
    ///
    /// The internal forces then do exactly the work by which the strain energy changes (Stander & Stein 1996; Simo, Tarnow & Doblaré 1995).
    Midpoint,
    /// As the [midpoint](Self::Midpoint), including loads, but the section forces are those of the mean strain plus `χ/2` times the change of strain;
    /// the value is `χ`.
    ///
    /// The internal forces then do additional work of `χ/2` times the integral of `ΔΓ·C ΔΓ + EI Δκ²`.
    DampedMidpoint(f64),
    /// End of the step, with loads at the end of a line that has their mean and their change over the step.
    End,
}

impl Stage {
    /// Stages at which loads have separate values, in the order of time.
    pub const ALL: [Self; 3] = [Self::Start, Self::Midpoint, Self::End];
}

/// Constant inertia matrix `M` of a mechanical system.
pub trait Inertia {
    /// Adds `factor · M · rates` to `out`, one entry per unknown degree of freedom.
    fn add_inertia(&mut self, factor: f64, rates: &[f64], out: &mut [f64]);

    /// Adds `factor · M` to the tangent.
    fn add_inertia_tangent(&self, factor: f64, tangent: &mut BandedMatrix);
}

/// Configuration-dependent forces of a mechanical system.
///
/// Section forces may be internal unknowns, which are condensed and corrected with the increments.
pub trait Forces {
    /// Adds `weight` times the forces of a stage (internal minus loads), for the current section forces, to `out`.
    ///
    /// Returns the largest mismatch between the strains of section forces and configuration.
    fn add_forces(&mut self, stage: Stage, increments: &[f64], weight: f64, out: &mut [f64])
    -> f64;

    /// Adds `weight` times the condensed forces of a stage to `out`, and their derivatives with respect to the increments to the tangent.
    fn add_linearised_forces(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    );

    /// Adds `weight` times the forces that would remove the current strain mismatch, with the strain derivatives of the last linearisation.
    fn add_mismatch_forces(&mut self, weight: f64, out: &mut [f64]);

    /// Updates the section forces after a correction of the increments, by the last linearisation.
    fn correct_section_forces(&mut self, correction: &[f64]);

    /// Largest force residual, relative to the forces of this step [-].
    fn relative_imbalance(&self, residual: &[f64]) -> f64;

    /// Location of the largest residual of a part, for messages.
    fn worst(&self, _part: ResidualPart, _residual: &[f64]) -> Option<FailureSource> {
        None
    }

    /// Largest rotation increment `Δω` of a section in the last evaluation [rad].
    fn largest_rotation(&self) -> f64;
}

/// Constraints of a mechanical system, with multipliers as unknowns.
pub trait Constraints {
    /// Number of constraint unknowns, and the largest number of entries of their equations.
    fn constraint_shape(&self) -> BorderShape;

    /// Blocks of five constraint unknowns, if these are to be eliminated block by block.
    fn constraint_blocks(&self) -> Option<&BlockLayout> {
        None
    }

    /// Predicts the constraint unknowns for a step over the interval.
    fn predict_constraints(&mut self, interval: Interval, unknowns: &mut [f64]);

    /// Adds the constraint forces to `out`, followed by the constraint violations.
    fn add_constraints(&mut self, increments: &[f64], unknowns: &[f64], out: &mut [f64]);

    /// Adds constraint forces and violations to `out`, and their derivatives with respect to increments and constraint unknowns to the tangent.
    fn add_linearised_constraints(
        &mut self,
        increments: &[f64],
        unknowns: &[f64],
        out: &mut [f64],
        border: &mut Border,
    );

    /// Largest relative constraint violation [-].
    fn relative_violation(&self, residual: &[f64]) -> f64;

    /// Checks that the constraint unknowns allow the step to be accepted.
    ///
    /// # Errors
    /// Fails if a slider passes a limit within the step, or misses the limit at which the step has to end.
    fn check_constraints(&mut self, unknowns: &[f64]) -> Result<(), Overshoot>;

    /// Shortest chord of a path along a constraint in the mean configuration of the last evaluation, relative to the path as built [-].
    fn shortest_chord(&self) -> f64;
}

/// Mechanical system that integrators advance: its unknowns, its state, and the present step.
///
/// Increments and rates belong to the unknown degrees of freedom. The unknowns of constraints (contact forces, contact positions) follow. They have
/// no inertia and as many equations. Force vectors have further entries for supported degrees of freedom, which are fixed or prescribed; their
/// residual is the support reaction. If motions are prescribed, the vectors of increments and rates extend to the last prescribed degree of freedom.
pub trait Mechanism: Inertia + Forces + Constraints {
    /// Number of unknown degrees of freedom.
    fn unknowns(&self) -> usize;

    /// Length of force vectors: unknowns, constraints and supported degrees of freedom.
    fn degrees_of_freedom(&self) -> usize;

    /// Half-bandwidth of the tangent.
    fn half_bandwidth(&self) -> usize;

    /// Number of threads for the equations, which does not affect results.
    fn threads(&self) -> usize {
        1
    }

    /// Rates of the unknowns at the start of the step [length/time, 1/time].
    fn rates(&self) -> &[f64];

    /// Rates that predict the next step [length/time, 1/time].
    fn expected_rates(&self) -> &[f64];

    /// Prescribed motions in the present step.
    fn prescribed(&self) -> &PrescribedKinematics;

    /// Prepares a step: evaluates loads and prescribed motions. The method evaluates forces at the given stages.
    ///
    /// # Errors
    /// Fails if a load has no finite value.
    fn begin_step(&mut self, interval: Interval, stages: &[Stage]) -> Result<(), StepError>;

    /// Accepts a step: configuration, rates, work and impulse.
    fn advance(&mut self, solution: &Solution<'_>);

    /// Checkpoint interface, for methods that go back within a step.
    fn checkpoint(&mut self) -> &mut dyn Checkpoint;

    /// Acceleration interface, for methods with accelerations in their state.
    fn accelerated(&mut self) -> &mut dyn Accelerated;
}

/// Mechanical system that stores one of its states, for methods with substeps.
pub trait Checkpoint {
    /// Stores the present state at the start of a step, replacing the previous one.
    fn save_state(&mut self);

    /// Restores the stored state bit for bit.
    fn restore_state(&mut self);
}

/// Mechanical system with accelerations in its state.
pub trait Accelerated {
    /// Adds accelerations to the state. They are unknown until set.
    fn enable_accelerations(&mut self);

    /// Accelerations just after the start of the present step, if known [length/time², 1/time²].
    fn accelerations(&self) -> Option<&[f64]>;

    /// Sets the accelerations [length/time², 1/time²], if enabled.
    fn set_accelerations(&mut self, accelerations: &[f64]);
}

/// Result of an integrator for a step.
#[derive(Debug, Clone, Copy)]
pub struct Solution<'a> {
    /// Increments of the unknowns [length, rad].
    pub increments: &'a [f64],
    /// Constraint unknowns.
    pub constraints: &'a [f64],
    /// Rates at the end of the step [length/time, 1/time].
    pub rates: &'a [f64],
    /// Residual of the equations [force, force·length]; reactions at supported degrees of freedom.
    pub residual: &'a [f64],
    /// Stages of the forces with their shares [-]; their forces, constraints and supports give the change of the momenta. Empty if the method
    /// balances accelerations instead.
    pub balanced: &'a [(Stage, f64)],
}

/// Constraint limit that is passed within a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overshoot {
    /// Index among the limits of all constraints.
    pub limit: usize,
    /// Distance beyond the limit [length]; negative if the limit was not reached.
    pub distance: f64,
}
