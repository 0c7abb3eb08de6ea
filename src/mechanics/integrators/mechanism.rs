//! Interface between integrators and a mechanical system.

use super::{FailureSource, Interval, PrescribedKinematics, StepError};
use crate::linalg::{BandedMatrix, BlockLayout, Border, BorderShape};
use crate::newton::ResidualPart;

/// Stage of a step: a time within the step at which forces are evaluated. Increments are relative to the start of the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stage {
    /// Start of the step. In each step, a load is replaced by the linear function of time with the same mean and the same change.
    /// At this stage, the load has the value of this function at the start of the step.
    Start,
    /// Middle of the step: mean configuration, averaged section forces, mean loads.
    ///
    /// At the midpoint stage, the work of the internal forces is exactly the change of the strain energy in the step.
    /// References: Stander & Stein 1996; Simo, Tarnow & Doblaré 1995.
    Midpoint,
    /// Middle of the step as for [`Midpoint`](Self::Midpoint), but with section forces that belong to a later strain.
    /// The later strain is the mean strain plus `χ/2` times the change of the strain in the step.
    /// The value of the variant `DampedMidpoint` is the dissipation parameter `χ` [-].
    DampedMidpoint(f64),
    /// End of the step. Each load is replaced by the same linear function of time as at the stage [`Start`](Self::Start).
    /// At this stage, the load has the value of this function at the end of the step.
    End,
}

impl Stage {
    /// Stages with separate load values, in the order of time.
    pub const ALL: [Self; 3] = [Self::Start, Self::Midpoint, Self::End];
}

/// Constant inertia matrix `M` of a mechanical system.
pub trait Inertia {
    /// Adds `factor · M · rates` to `out`, where `M` is the inertia matrix, with one entry per unknown degree of freedom.
    fn add_inertia(&mut self, factor: f64, rates: &[f64], out: &mut [f64]);

    /// Adds `factor · M` to the tangent, where `M` is the inertia matrix.
    fn add_inertia_tangent(&self, factor: f64, tangent: &mut BandedMatrix);
}

/// Forces of a mechanical system that depend on its configuration.
///
/// Section forces may be internal unknowns, which are eliminated from the equations and corrected together with the increments.
pub trait Forces {
    /// Adds `weight` times the forces of a stage to `out`: internal forces minus loads, computed from the present section forces.
    ///
    /// Returns the largest strain residual: strain of the configuration minus the strain that belongs to the section force.
    fn add_forces(&mut self, stage: Stage, increments: &[f64], weight: f64, out: &mut [f64])
    -> f64;

    /// Adds `weight` times the forces of a stage to `out`, with the section force unknowns eliminated.
    /// Adds the derivatives of the forces with respect to the increments to the tangent.
    fn add_linearised_forces(
        &mut self,
        stage: Stage,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    );

    /// Adds the force corrections that would satisfy the linearised force laws, times `weight`, to `out`.
    fn add_mismatch_forces(&mut self, weight: f64, out: &mut [f64]);

    /// Updates the section forces after an iteration has corrected the increments.
    fn correct_section_forces(&mut self, correction: &[f64]);

    /// Largest force residual, as a fraction of the forces in this step [-].
    fn relative_imbalance(&self, residual: &[f64]) -> f64;

    /// Object with the largest force, strain or constraint residual, for messages.
    fn worst(&self, _part: ResidualPart, _residual: &[f64]) -> Option<FailureSource> {
        None
    }

    /// Name of an obstacle, or of a contact between bodies, through which a point passes within a step with the given increments.
    fn crossed_obstacle(&self, _increments: &[f64]) -> Option<&str> {
        None
    }

    /// Largest rotation increment `Δω` of a section in the last evaluation [rad].
    fn largest_rotation(&self) -> f64;
}

/// Constraints of a mechanical system, whose multipliers are unknowns.
pub trait Constraints {
    /// Number of constraint unknowns, and an upper bound of the number of nonzero derivatives of the constraint equations.
    fn constraint_shape(&self) -> BorderShape;

    /// Blocks of five constraint unknowns; `None` if the constraints are not eliminated block by block.
    fn constraint_blocks(&self) -> Option<&BlockLayout> {
        None
    }

    /// Predicts the constraint unknowns of a step over the interval.
    fn predict_constraints(&mut self, interval: Interval, unknowns: &mut [f64]);

    /// Adds the constraint forces and the constraint violations to `out`, at the indices of degrees of freedom and of constraints.
    fn add_constraints(&mut self, increments: &[f64], unknowns: &[f64], out: &mut [f64]);

    /// Adds the constraint forces and the constraint violations to `out`.
    /// Adds the derivatives of constraint forces and violations with respect to increments and constraint unknowns to the border of the tangent.
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
    /// Fails if an event of a constraint occurs within the step (arrival at a limit, landing, stop force in tension, start or end of a slip).
    /// Also fails if the step misses the event at which it has to end.
    fn check_constraints(&mut self, unknowns: &[f64]) -> Result<(), Overshoot>;

    /// Returns true if [`check_end`](Self::check_end) may fail.
    fn has_end_conditions(&self) -> bool {
        false
    }

    /// Checks the state at the end of a step whose iteration has converged.
    ///
    /// # Errors
    /// Fails if the present forces violate a condition of the constraints. The step must then be undone.
    fn check_end(&mut self) -> Result<(), Overshoot> {
        Ok(())
    }

    /// Smallest chord of the path of a slider in the mean configuration, as a fraction of the initial length of the path [-].
    fn shortest_chord(&self) -> f64;
}

/// Mechanical system that integrators advance. It has unknowns, a state, and data of the present step.
///
/// Vectors of increments and rates contain the unknown degrees of freedom.
/// With prescribed motions, zeros for the constraint unknowns follow, and then the prescribed degrees of freedom.
/// Constraint unknowns are contact forces and contact positions. They have no inertia, and each has one constraint equation.
/// Force vectors have entries for unknowns, constraints and supported degrees of freedom.
/// The residual at a supported degree of freedom is the support reaction.
pub trait Mechanism: Inertia + Forces + Constraints {
    /// Number of unknown degrees of freedom.
    fn unknowns(&self) -> usize;

    /// Length of force vectors, which is the number of unknowns, constraints and supported degrees of freedom.
    fn degrees_of_freedom(&self) -> usize;

    /// Half-bandwidth of the tangent.
    fn half_bandwidth(&self) -> usize;

    /// Number of threads that solve the equations. The number of threads does not affect the results.
    fn threads(&self) -> usize {
        1
    }

    /// Rates of the unknowns at the start of the step [length/time, 1/time].
    fn rates(&self) -> &[f64];

    /// Rates that the next step uses for the start values of its iteration [length/time, 1/time].
    fn expected_rates(&self) -> &[f64];

    /// Prescribed motions in the present step.
    fn prescribed(&self) -> &PrescribedKinematics;

    /// Prepares a step: evaluates loads and prescribed motions. `stages` lists the stages at which the integrator evaluates forces.
    ///
    /// # Errors
    /// Fails if a load or a prescribed motion has no valid value.
    fn begin_step(&mut self, interval: Interval, stages: &[Stage]) -> Result<(), StepError>;

    /// Ends a step with the given solution: updates configuration, rates, work and impulse.
    fn advance(&mut self, solution: &Solution<'_>);

    /// Interface that stores and restores the state, for methods that return to an earlier state within a step.
    fn checkpoint(&mut self) -> &mut dyn Checkpoint;

    /// Interface that stores accelerations, for methods whose state includes them.
    fn accelerated(&mut self) -> &mut dyn Accelerated;
}

/// Mechanical system that can store one of its states, for methods with substeps.
pub trait Checkpoint {
    /// Stores the present state at the start of a step. The previously stored state is overwritten.
    fn save_state(&mut self);

    /// Restores the stored state bit for bit.
    fn restore_state(&mut self);
}

/// Mechanical system that can have accelerations in its state.
pub trait Accelerated {
    /// Adds accelerations to the state. The accelerations are unknown until they are set.
    fn enable_accelerations(&mut self);

    /// Accelerations just after the start of the present step [length/time², 1/time²]; `None` if unknown.
    fn accelerations(&self) -> Option<&[f64]>;

    /// Sets the accelerations [length/time², 1/time²]. The call has no effect unless accelerations are enabled.
    fn set_accelerations(&mut self, accelerations: &[f64]);
}

/// Solution of a step.
#[derive(Debug, Clone, Copy)]
pub struct Solution<'a> {
    /// Increments of the unknowns [length, rad].
    pub increments: &'a [f64],
    /// Constraint unknowns.
    pub constraints: &'a [f64],
    /// Rates at the end of the step [length/time, 1/time].
    pub rates: &'a [f64],
    /// Residual of the equations [force, force·length]. At supported degrees of freedom, it is the support reaction.
    pub residual: &'a [f64],
    /// Stages and their weights [-]. The weighted sum of the forces at these stages is the rate of change of the momenta in the step.
    /// The list of stages is empty if the method balances accelerations instead of momenta.
    pub balanced: &'a [(Stage, f64)],
}

/// Event of a constraint because of which a step is rejected, for example a slider that passes the end of its master.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overshoot {
    /// Index of the event among the events of all constraints.
    pub event: usize,
    /// Distance beyond the event, in the unit of the constraint; negative if the event was not reached.
    pub distance: f64,
}
