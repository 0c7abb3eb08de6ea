//! How the present configuration resists small movements, and with which inertia.
//!
//! Rotations are increments of the angle itself, for which the stiffness is the Hessian of the strain energy. Loads of fixed direction
//! have none; those that turn with a section are left out.

use super::Model;
use crate::beams::SpanAtRest;
use crate::elementary::square;
use crate::geometry::larger;
use crate::linalg::{PreciseBand, SymmetricSparse};
use crate::model::motion::UnknownKind;

/// A lever is so many times as stiff as anything else of a model where small movements are looked for: with 32 digits that hides nothing.
const RIGID: f64 = 1e12;

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

    /// Gives every lever as at rest, so stiff that what gives way is below rounding: a [`RIGID`] times the largest `stiffness` of a movement of the
    /// model [force/length, force·length].
    pub fn each_lever_at_rest(
        &self,
        stiffness: impl Fn(usize) -> f64,
        take: &mut dyn FnMut(&[usize], &SpanAtRest),
    ) {
        let kinds = self.unknowns.kinds().iter().enumerate();
        let of_movements = kinds.map(|(at, kind)| match kind {
            UnknownKind::Position => stiffness(at),
            UnknownKind::Rotation | UnknownKind::Force => 0.0,
        });
        let of_levers = self.levers.iter().map(|lever| {
            let [.., rotation] = self.bodies[lever.body].degrees_of_freedom[0];
            let (arm, turns) = (lever.arm().norm(), rotation < self.unknowns.count());
            let moment = if turns { stiffness(rotation) } else { 0.0 };
            larger(moment / square(arm), lever.force().norm() / arm)
        });
        let largest = of_movements.chain(of_levers).fold(0.0, larger);
        let rigid = if largest > 0.0 { RIGID * largest } else { 1.0 };
        self.levers.each_at_rest(&self.bodies, rigid, take);
    }

    /// How many movements with inertia fewer the model has than its inertia matrix: the levers hold them to each other.
    pub fn held_by_levers(&self, inertia: &SymmetricSparse) -> usize {
        if self.levers.count() == 0 {
            return 0;
        }
        let kinds = self.unknowns.kinds().iter().enumerate();
        let is_light = |(at, kind): &(usize, &UnknownKind)| {
            **kind != UnknownKind::Force && inertia.diagonal(*at) == 0.0
        };
        (2 * self.levers.count()).saturating_sub(kinds.filter(is_light).count())
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
        let own: Vec<f64> = (0..stiffness.size()).map(|at| stiffness.diagonal(at).abs()).collect();
        self.each_lever_at_rest(|at| own[at], &mut |degrees, span| {
            add_resistance(&mut stiffness, degrees, span);
        });
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
