//! How the present configuration resists small movements, and with which inertia.
//!
//! Rotations are increments of the angle itself, for which the stiffness is the Hessian of the strain energy. Loads of fixed direction
//! have none; those that turn with a section are left out.

use super::Model;
use crate::beams::SpanAtRest;
use crate::elementary::square;
use crate::linalg::{PreciseBand, SymmetricSparse};

impl Model {
    /// Gives every span of every body, and every spring, as at rest: the unknowns of its components, and its rows. Those of supported components stand
    /// behind the unknowns of all.
    pub fn each_span_at_rest(&self, take: &mut dyn FnMut(&[usize], &SpanAtRest)) {
        for body in self.bodies.iter() {
            let order = body.dynamics.order();
            body.dynamics.each_span_at_rest(&mut |span| {
                let degrees = &body.degrees_of_freedom[span.first..span.first + order];
                take(degrees.as_flattened(), span);
            });
        }
        self.elements.each_at_rest(&self.bodies, take);
    }

    /// The power that dampers, damped materials and drag dissipate at such rates of the unknowns in the present configuration, as at rest there
    /// [energy/time].
    pub fn dissipation(&self, rates: &[f64]) -> f64 {
        self.elements.dissipation(&self.bodies, rates)
    }

    /// About the square of the slowest bending, as if all beams were one: the least `EI` over the largest `ρA` and the fourth power of
    /// their length together; none without a beam [1/time²].
    pub fn slowest_bending(&self) -> Option<f64> {
        let extents = || self.bodies.iter().filter_map(|body| body.dynamics.extent());
        let length: f64 = extents().map(|(_, length)| length).sum();
        let bending =
            extents().map(|(section, _)| section.bending_stiffness).fold(f64::INFINITY, f64::min);
        let mass = extents().map(|(section, _)| section.mass_per_length).fold(0.0, f64::max);
        (length > 0.0).then(|| bending / mass / square(square(length)))
    }

    /// In how many ways a movement from here would release energy if loads keep their directions: the negative eigenvalues of the
    /// stiffness.
    pub fn falls(&self) -> usize {
        let nothing = SymmetricSparse::new(self.unknowns.count(), |_| {});
        let mut stiffness =
            PreciseBand::zeros(self.unknowns.count(), self.unknowns.half_bandwidth());
        self.each_span_at_rest(&mut |degrees, span| add_resistance(&mut stiffness, degrees, span));
        stiffness.pivots(0.0, &nothing).map_or(0, |pivots| pivots.negative)
    }
}

/// Adds to the stiffness of a configuration how a span resists: `Bᵀ k B + K_g`.
pub fn add_resistance(stiffness: &mut PreciseBand, degrees: &[usize], span: &SpanAtRest) {
    let width = degrees.len();
    for (factor, row) in span.stiffness.iter().zip(span.strains.chunks_exact(width)) {
        stiffness.add_square(degrees, *factor, row);
    }
    for twist in span.twists.chunks_exact(2 * width) {
        let (p, q) = twist.split_at(width);
        stiffness.add_product(degrees, p, q);
    }
}
