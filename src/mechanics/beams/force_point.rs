//! A quadrature point for `Γ`: axial and shear strain, and the section force as an unknown of its own.
//!
//! With `Δg = Σ N_a' Δx_a`, `Δω = Σ N_a Δω_a`, `1/q = dΔθ/dΔω` and `C = diag(EA, GA)`:
//!
//! ```text
//! Λ1 = Λ0 R(Δθ(Δω))    Γ1 = Λ1ᵀ (g0 + Δg) - e1
//! gτ = g0 + τ Δg             Λτ = (1-τ) Λ0 + τ Λ1        N = C ((1-σ) Γ0 + σ Γ1)      n = Λτ N
//! R_a = w N_a' n             S_a = -w N_a gτ × n
//! ```
//!
//! The gradient `g = x'` and the rotation are kept at the point and advanced by increments, so that the strains do not
//! depend on how far from the origin the beam has flown.

use pulp::Simd;

use super::at_rest::SpanAtRest;
use super::axis_point::AxisPoint;
use super::block::Block;
use super::dynamics::{Collocation, ForceSummary, Movement};
use super::{Rotation, RotationIncrement, Section};
use crate::geometry::{Vec2, cross, larger, perpendicular};

/// Strains that differ by less are the same but for rounding.
const SAME_STRAIN: f64 = 64.0 * f64::EPSILON;

#[derive(Debug, Clone)]
pub(super) struct ForcePoint<const N: usize> {
    axis: AxisPoint<N>,
    /// `g0`
    gradient: Vec2,
    /// `Λ0`
    rotation: Rotation,
    /// `Γ0`
    strain: Vec2,
    /// The section force `N` of the iterate.
    force: Vec2,
    /// That of the last step, from which the next one starts: in a motion with fast vibration it is nearer to the solution
    /// than `C Γ0`, whose sign may change from step to step.
    last_force: Vec2,
    /// `m = Γσ - C⁻¹ N`, where forces were taken last.
    mismatch: Vec2,
    linearised_at: Configuration,
}

/// The configuration that increments lead to.
#[derive(Debug, Clone, Copy)]
struct Configuration {
    end_rotation: Rotation,
    end_strain: Vec2,
    collocated_strain: Vec2,
    collocated_rotation: Rotation,
    collocated_gradient: Vec2,
    /// `σ`
    stress: f64,
    /// `1/q`
    inverse_q: f64,
    /// `Δω`
    increment: f64,
}

impl<const N: usize> ForcePoint<N> {
    /// A quadrature point for axial and shear strain at a point of the undeformed axis, with its unit tangent there.
    pub(super) fn new((axis, tangent): (AxisPoint<N>, Vec2)) -> Self {
        let rotation = Rotation { cos: tangent.x, sin: tangent.y };
        let undeformed = Configuration {
            end_rotation: rotation,
            end_strain: Vec2::zeros(),
            collocated_strain: Vec2::zeros(),
            collocated_rotation: rotation,
            collocated_gradient: tangent,
            stress: 0.0,
            inverse_q: 1.0,
            increment: 0.0,
        };
        Self {
            axis,
            gradient: tangent,
            rotation,
            strain: Vec2::zeros(),
            force: Vec2::zeros(),
            last_force: Vec2::zeros(),
            mismatch: Vec2::zeros(),
            linearised_at: undeformed,
        }
    }

    pub(super) fn begin_step(&mut self) {
        self.force = self.last_force;
    }

    /// `(Δg, Δω)` of movements.
    #[inline(always)]
    fn interpolate(&self, moved: &[Movement; N]) -> (Vec2, f64) {
        let (mut gradient, mut rotation) = (Vec2::zeros(), 0.0);
        for ((shape, slope), [x, y, omega]) in
            self.axis.shape.iter().zip(&self.axis.slope).zip(moved)
        {
            gradient.x += slope * x;
            gradient.y += slope * y;
            rotation += shape * omega;
        }
        (gradient, rotation)
    }

    #[inline(always)]
    fn configuration(&self, at: Collocation, moved: &[Movement; N]) -> Configuration {
        let (change, increment) = self.interpolate(moved);
        let turn = at.rotations.turn(increment);
        let end_rotation = self.rotation.times(&turn);
        let end_strain = strain_of(end_rotation, self.gradient + change);
        Configuration {
            end_rotation,
            end_strain,
            collocated_strain: self.strain + (end_strain - self.strain) * at.stress,
            collocated_rotation: self.rotation.mixed(end_rotation, at.configuration),
            collocated_gradient: self.gradient + change * at.configuration,
            stress: at.stress,
            inverse_q: turn.rate,
            increment,
        }
    }

    #[inline(always)]
    fn distribute(&self, weight: f64, gradient: Vec2, force: Vec2, forces: &mut [Movement; N]) {
        let (force, torque) = (
            force * (weight * self.axis.weight),
            cross(gradient, force) * (weight * self.axis.weight),
        );
        for ((shape, slope), [x, y, omega]) in
            self.axis.shape.iter().zip(&self.axis.slope).zip(forces)
        {
            *x += slope * force.x;
            *y += slope * force.y;
            *omega -= shape * torque;
        }
    }

    #[inline(always)]
    pub(super) fn add_forces(
        &mut self,
        section: &Section,
        at: Collocation,
        moved: &[Movement; N],
        weight: f64,
        forces: &mut [Movement; N],
        summary: &mut ForceSummary,
    ) {
        let now = self.configuration(at, moved);
        // Where the strain of the start alone counts, the section force is known.
        let force = if at.stress == 0.0 { force_of(section, self.strain) } else { self.force };
        let spatial = now.collocated_rotation.to_space(force);
        self.distribute(weight, now.collocated_gradient, spatial, forces);
        self.mismatch = now.collocated_strain - strain_from(section, force);
        let force = larger(force.x.abs(), force.y.abs());
        summary.join(&ForceSummary {
            strain_mismatch: larger(self.mismatch.x.abs(), self.mismatch.y.abs()),
            force,
            moment: self.axis.weight * force,
            rotation: now.increment.abs(),
        });
    }

    #[inline(always)]
    pub(super) fn add_linearised_forces<S: Simd>(
        &mut self,
        section: &Section,
        at: Collocation,
        moved: &[Movement; N],
        weight: f64,
        forces: &mut [Movement; N],
        block: &mut Block<S, N>,
    ) {
        let now = self.configuration(at, moved);
        let (tau, sigma) = (at.configuration, at.stress);
        let (rotation, gradient) = (now.collocated_rotation, now.collocated_gradient);
        let condensed = rotation.to_space(force_of(section, now.collocated_strain));
        self.distribute(weight, gradient, condensed, forces);

        // δn = A δg + b δω  and  δ(gτ × n) = e·δg + f δω, the geometric terms with the section force of the iterate.
        let end = now.end_rotation;
        let column =
            |axis: Vec2| rotation.to_space(force_of(section, end.to_section(axis))) * sigma;
        let (a1, a2) = (column(Vec2::x()), column(Vec2::y()));
        let turned_strain = perpendicular(now.end_strain + Vec2::x());
        let b = (end.to_space(perpendicular(self.force)) * tau
            - rotation.to_space(force_of(section, turned_strain)) * sigma)
            * now.inverse_q;
        let lever = perpendicular(gradient);
        let geometric = perpendicular(rotation.to_space(self.force)) * tau;
        let e = Vec2::new(a1.dot(&lever), a2.dot(&lever)) - geometric;
        let f = lever.dot(&b);

        // The rows of one component are multiples of each other.
        let mut rows = [[[0.0; 3]; N]; 3];
        let by = [[a1.x, a2.x, b.x], [a1.y, a2.y, b.y], [e.x, e.y, f]];
        for (row, [by_x, by_y, by_rotation]) in rows.iter_mut().zip(by) {
            let functions = self.axis.slope.iter().zip(&self.axis.shape);
            for (entry, (slope, shape)) in row.iter_mut().zip(functions) {
                *entry = [by_x * slope, by_y * slope, by_rotation * shape];
            }
        }
        let w = weight * self.axis.weight;
        let functions = self.axis.slope.iter().zip(&self.axis.shape);
        for (function, (slope, shape)) in functions.enumerate() {
            let factors = [w * slope, w * slope, -w * shape];
            for (component, (factor, row)) in factors.into_iter().zip(&rows).enumerate() {
                block.add_multiple((function, component), factor, row);
            }
        }
        self.mismatch = now.collocated_strain - strain_from(section, self.force);
        self.linearised_at = now;
    }

    /// Adds the forces `C m` of the strain mismatch `m` at this point, in the directions of the last linearisation.
    #[inline(always)]
    pub(super) fn add_mismatch_forces(
        &self,
        section: &Section,
        weight: f64,
        forces: &mut [Movement; N],
    ) {
        let Configuration { collocated_rotation, collocated_gradient, .. } = self.linearised_at;
        let force = collocated_rotation.to_space(force_of(section, self.mismatch));
        self.distribute(weight, collocated_gradient, force, forces);
    }

    /// Corrects the section force at this point: `N ← N + C (m + σ δΓ1)`, `δΓ1 = Λ1ᵀ δg - J (Γ1 + e1) δω/q`.
    #[inline(always)]
    pub(super) fn correct_section_force(&mut self, section: &Section, correction: &[Movement; N]) {
        let (gradient, rotation) = self.interpolate(correction);
        let Configuration { end_rotation, end_strain, inverse_q, stress, .. } = self.linearised_at;
        let turned = perpendicular(end_strain + Vec2::x()) * (rotation * inverse_q);
        let change = end_rotation.to_section(gradient) - turned;
        self.force += force_of(section, self.mismatch + change * stress);
    }

    /// Adds the rows of axial and shear strain at rest at this point, and those of the section force if there is one.
    pub(super) fn write_at_rest(&self, section: &Section, span: &mut SpanAtRest) {
        let w = self.axis.weight;
        let row = |by_gradient: Vec2, by_rotation: f64| -> [[f64; 3]; N] {
            std::array::from_fn(|a| {
                let (slope, shape) = (self.axis.slope[a], self.axis.shape[a]);
                [by_gradient.x * slope, by_gradient.y * slope, by_rotation * shape]
            })
        };
        let turned = perpendicular(self.strain + Vec2::x());
        let stiffness = [section.axial_stiffness, section.shear_stiffness];
        let axes = [(Vec2::x(), turned.x), (Vec2::y(), turned.y)];
        for (stiffness, (axis, turned)) in stiffness.into_iter().zip(axes) {
            span.add_strain(w * stiffness, row(self.rotation.to_space(axis), -turned));
        }
        let (force, is_known) = self.present_force(section);
        if force != Vec2::zeros() {
            let rounding = force_of(section, Vec2::new(SAME_STRAIN, SAME_STRAIN)).norm();
            let doubt = if is_known { 0.0 } else { (rounding / force.norm()).min(1.0) };
            let force = self.rotation.to_space(force) * w;
            let p = row(perpendicular(force), -0.5 * self.gradient.dot(&force));
            span.add_twist(doubt, p, row(Vec2::zeros(), 1.0));
        }
    }

    /// The section force of the present strain, and whether it is the one of the last solution.
    ///
    /// The section force that was an unknown of the last solution is known to its own rounding, that of the strain to the stiffness times the
    /// rounding of a number of size one.
    fn present_force(&self, section: &Section) -> (Vec2, bool) {
        let missing = self.strain - strain_from(section, self.last_force);
        let is_known = larger(missing.x.abs(), missing.y.abs()) <= SAME_STRAIN;
        (if is_known { self.last_force } else { force_of(section, self.strain) }, is_known)
    }

    /// The section force `n` in space [force] and `w x' × n` [force·length] of this point at the start of the step.
    pub(super) fn transmitted(&self, section: &Section) -> (Vec2, f64) {
        let force = self.rotation.to_space(self.present_force(section).0);
        (force, self.axis.weight * cross(self.gradient, force))
    }

    /// The strain energies of stretching and of shear at this point [energy].
    pub(super) fn strain_energies(&self, section: &Section) -> [f64; 2] {
        let energies = self.strain.component_mul(&force_of(section, self.strain));
        [0.5 * self.axis.weight * energies.x, 0.5 * self.axis.weight * energies.y]
    }

    #[inline(always)]
    pub(super) fn advance(&mut self, moved: &[Movement; N], rotations: RotationIncrement) {
        let (change, increment) = self.interpolate(moved);
        self.last_force = self.force;
        self.gradient += change;
        self.rotation = self.rotation.turned(rotations, increment).normalised();
        self.strain = strain_of(self.rotation, self.gradient);
    }

    pub(super) fn strain_energy(&self, section: &Section) -> f64 {
        0.5 * self.axis.weight * self.strain.dot(&force_of(section, self.strain))
    }

    /// The normal [-] of the section at this point, in space, at the start of the step.
    pub(super) fn normal(&self) -> Vec2 {
        Vec2::new(self.rotation.cos, self.rotation.sin)
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.gradient.x, self.gradient.y, self.rotation.cos, self.rotation.sin]);
        // At the start the strain is zero; that of the configuration there is only rounded to it.
        state.extend([self.last_force.x, self.last_force.y, self.strain.x, self.strain.y]);
    }

    pub(super) fn restore(&mut self, [x, y, cos, sin, axial, shear, stretch, slide]: [f64; 8]) {
        (self.gradient, self.rotation) = (Vec2::new(x, y), Rotation { cos, sin });
        self.last_force = Vec2::new(axial, shear);
        self.strain = Vec2::new(stretch, slide);
    }
}

/// `Γ = Λᵀ x' - e1`
#[inline(always)]
fn strain_of(rotation: Rotation, gradient: Vec2) -> Vec2 {
    rotation.to_section(gradient) - Vec2::x()
}

/// `C Γ`
#[inline(always)]
fn force_of(section: &Section, strain: Vec2) -> Vec2 {
    Vec2::new(section.axial_stiffness * strain.x, section.shear_stiffness * strain.y)
}

/// `C⁻¹ N`
#[inline(always)]
fn strain_from(section: &Section, force: Vec2) -> Vec2 {
    Vec2::new(force.x / section.axial_stiffness, force.y / section.shear_stiffness)
}
