//! Quadrature point for the axial and shear strain `Γ`, with its state between two steps and its static tangent stiffness.

use super::axis_point::AxisPoint;
use super::span_stiffness::{SpanStiffness, StrainKind};
use super::{Rotation, Section};
use crate::geometry::{Vec2, cross, larger, perpendicular};

const SAME_STRAIN: f64 = 64.0 * f64::EPSILON;

#[derive(Debug, Clone)]
pub(super) struct ForcePoint<const N: usize> {
    pub(super) axis: AxisPoint<N>,
    pub(super) gradient: Vec2,
    pub(super) rotation: Rotation,
    pub(super) strain: Vec2,
    pub(super) last_force: Vec2,
}

impl<const N: usize> ForcePoint<N> {
    /// Quadrature point for an unused vector lane, with zero strain for all increments.
    pub(super) const EMPTY: Self = Self {
        axis: AxisPoint::EMPTY,
        gradient: Vec2::new(1.0, 0.0),
        rotation: Rotation { cos: 1.0, sin: 0.0 },
        strain: Vec2::new(0.0, 0.0),
        last_force: Vec2::new(0.0, 0.0),
    };

    pub(super) fn new((axis, tangent): (AxisPoint<N>, Vec2)) -> Self {
        Self {
            axis,
            gradient: tangent,
            rotation: Rotation { cos: tangent.x, sin: tangent.y },
            strain: Vec2::zeros(),
            last_force: Vec2::zeros(),
        }
    }

    pub(super) fn write_static_rows(&self, section: &Section, span: &mut SpanStiffness) {
        let w = self.axis.weight;
        let row = |by_gradient: Vec2, by_rotation: f64| -> [[f64; 3]; N] {
            std::array::from_fn(|a| {
                let (slope, shape) = (self.axis.slope[a], self.axis.shape[a]);
                [by_gradient.x * slope, by_gradient.y * slope, by_rotation * shape]
            })
        };
        let turned = perpendicular(self.strain + Vec2::x());
        let stretch = row(self.rotation.to_space(Vec2::x()), -turned.x);
        let shear = row(self.rotation.to_space(Vec2::y()), -turned.y);
        span.add_strain(StrainKind::Axial, w * section.axial_stiffness, stretch);
        span.add_strain(StrainKind::Shear, w * section.shear_stiffness, shear);
        let turn = row(Vec2::zeros(), 1.0);
        let by_turn = |force: Vec2| row(perpendicular(force), -0.5 * self.gradient.dot(&force));
        let first = span.stiffness.len() - 2;
        for (strain, axis) in [Vec2::x(), Vec2::y()].into_iter().enumerate() {
            let p = by_turn(self.rotation.to_space(axis));
            span.add_second_derivative(first + strain, p.as_flattened(), turn.as_flattened());
        }
        let (force, is_known) = self.present_force(section);
        if force != Vec2::zeros() {
            let rounding = force_of(section, Vec2::new(SAME_STRAIN, SAME_STRAIN)).norm();
            let doubt = if is_known { 0.0 } else { (rounding / force.norm()).min(1.0) };
            span.add_twist(doubt, by_turn(self.rotation.to_space(force) * w), turn);
        }
    }

    /// Section force that belongs to the strain between two steps, and a flag.
    /// The flag is true for the section force of the last solution, and false for a force computed from the strain.
    /// The section force of the last solution is used if it agrees with the strain, because its rounding error is smaller.
    fn present_force(&self, section: &Section) -> (Vec2, bool) {
        let missing = self.strain - strain_from(section, self.last_force);
        let is_known = larger(missing.x.abs(), missing.y.abs()) <= SAME_STRAIN;
        (if is_known { self.last_force } else { force_of(section, self.strain) }, is_known)
    }

    pub(super) fn transmitted(&self, section: &Section) -> (Vec2, f64) {
        let force = self.rotation.to_space(self.present_force(section).0);
        (force, self.axis.weight * cross(self.gradient, force))
    }

    pub(super) fn strain_energies(&self, section: &Section) -> [f64; 2] {
        let energies = self.strain.component_mul(&force_of(section, self.strain));
        [0.5 * self.axis.weight * energies.x, 0.5 * self.axis.weight * energies.y]
    }

    pub(super) fn strain_energy(&self, section: &Section) -> f64 {
        0.5 * self.axis.weight * self.strain.dot(&force_of(section, self.strain))
    }

    /// Unit normal of the section at the start of the step [-], as a vector in space.
    pub(super) fn normal(&self) -> Vec2 {
        Vec2::new(self.rotation.cos, self.rotation.sin)
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.gradient.x, self.gradient.y, self.rotation.cos, self.rotation.sin]);
        // The strain is stored because a strain computed from the configuration has rounding errors.
        state.extend([self.last_force.x, self.last_force.y, self.strain.x, self.strain.y]);
    }

    pub(super) fn restore(&mut self, [x, y, cos, sin, axial, shear, stretch, slide]: [f64; 8]) {
        (self.gradient, self.rotation) = (Vec2::new(x, y), Rotation { cos, sin });
        self.last_force = Vec2::new(axial, shear);
        self.strain = Vec2::new(stretch, slide);
    }
}

fn force_of(section: &Section, strain: Vec2) -> Vec2 {
    Vec2::new(section.axial_stiffness * strain.x, section.shear_stiffness * strain.y)
}

fn strain_from(section: &Section, force: Vec2) -> Vec2 {
    Vec2::new(force.x / section.axial_stiffness, force.y / section.shear_stiffness)
}
