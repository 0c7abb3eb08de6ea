//! Stiffness, inertia and damping matrices of the present configuration.
//!
//! Rotations are increments of the angle, so that the stiffness is the Hessian of the strain energy.
//! Loads of fixed direction have no stiffness, and the stiffness of follower loads is neglected.

use super::{StaticOrder, System};
use crate::beams::SpanStiffness;
use crate::elementary::square;
use crate::geometry::larger;
use crate::linalg::{PreciseBand, SymmetricSparse};
use crate::system::links::RigidLink;
use crate::system::state::UnknownKind;

/// Penalty stiffness of rigid links, inclined rollers and sliders, as a multiple of the largest stiffness of the model.
/// The penalty stiffness changes frequencies by a relative amount below 1/`RIGID`.
/// Rounding of the penalty stiffness does not affect other stiffnesses, because the matrices have 32 digits.
const RIGID: f64 = 1e8;

impl System {
    pub(crate) fn for_each_static_span(
        &self,
        order: &StaticOrder,
        take: &mut dyn FnMut(&[usize], &SpanStiffness),
    ) {
        self.each_span(&mut in_order(order, take));
    }

    fn each_span(&self, take: &mut dyn FnMut(&[usize], &SpanStiffness)) {
        self.each_span_of_bodies(take);
        self.elements.for_each_static_stiffness(&self.bodies, take);
    }

    pub(super) fn each_span_of_bodies(&self, take: &mut dyn FnMut(&[usize], &SpanStiffness)) {
        for body in self.bodies.iter() {
            let order = body.dynamics.order();
            body.dynamics.for_each_static_span(&mut |span| {
                let degrees = &body.degrees_of_freedom[span.first..span.first + order];
                take(degrees.as_flattened(), span);
            });
        }
    }

    /// Power that all elements dissipate at the given small rates of the unknowns in the present configuration [energy/time].
    pub(crate) fn dissipation(&self, rates: &[f64]) -> f64 {
        let mut power = 0.0;
        self.each_damped_rate(rates, &mut |damping, rate| power += damping * square(rate));
        power
    }

    pub(crate) fn each_damped_rate(&self, rates: &[f64], take: &mut dyn FnMut(f64, f64)) {
        self.elements.each_damped_rate(&self.bodies, rates, take);
    }

    pub(super) fn half_bandwidth_at_rest(&self) -> usize {
        let of_link = |link: &RigidLink| {
            let degrees = &self.bodies[link.body].degrees_of_freedom;
            let ([x, y, rotation], [point_x, point_y, _]) = (degrees[0], degrees[link.point]);
            let free = [x, y, rotation, point_x, point_y];
            let free = free.into_iter().filter(|at| *at < self.unknowns.count());
            free.clone().max().unwrap_or(0) - free.min().unwrap_or(0)
        };
        let of_rollers = self.links.rollers().map(|(_, roller)| {
            let [x, y] = roller.degrees(&self.bodies);
            if x.max(y) < self.unknowns.count() { x.abs_diff(y) } else { 0 }
        });
        let reaches = self.links.iter().map(of_link).chain(of_rollers);
        reaches.fold(self.unknowns.half_bandwidth(), usize::max)
    }

    pub(crate) fn for_each_static_constraint(
        &self,
        order: &StaticOrder,
        stiffness: impl Fn(usize) -> f64,
        take: &mut dyn FnMut(&[usize], &SpanStiffness),
    ) {
        let stiffness = |unknown: usize| stiffness(order.place(unknown));
        let take = &mut in_order(order, take);
        let kinds = self.unknowns.kinds().iter().enumerate();
        let of_movements = kinds.map(|(at, kind)| match kind {
            UnknownKind::Position => stiffness(at),
            UnknownKind::Rotation | UnknownKind::Force => 0.0,
        });
        let of_links = self.links.iter().map(|link| {
            let own = self.links.iter().filter(|other| other.body == link.body);
            let size = own.map(|other| other.arm().norm()).fold(0.0, larger);
            let [.., rotation] = self.bodies[link.body].degrees_of_freedom[0];
            let moment = if rotation < self.unknowns.count() { stiffness(rotation) } else { 0.0 };
            larger(moment / square(size), link.force().norm() / size)
        });
        let largest = of_movements.chain(of_links).fold(0.0, larger);
        let rigid = if largest > 0.0 { RIGID * largest } else { 1.0 };
        self.links.for_each_static_stiffness(&self.bodies, rigid, take);
        self.sliders.for_each_static_stiffness(&self.bodies, self.unknowns.count(), rigid, take);
    }

    pub(crate) fn constrained_movements(
        &self,
        order: &StaticOrder,
        inertia: &SymmetricSparse,
    ) -> usize {
        self.held_by_links(order, inertia) + self.sliders.movements_held()
    }

    fn held_by_links(&self, order: &StaticOrder, inertia: &SymmetricSparse) -> usize {
        if self.links.forces() == 0 {
            return 0;
        }
        let kinds = self.unknowns.kinds().iter().enumerate();
        let is_light = |(at, kind): &(usize, &UnknownKind)| {
            **kind != UnknownKind::Force && inertia.diagonal(order.place(*at)) == 0.0
        };
        self.links.forces().saturating_sub(kinds.filter(is_light).count())
    }

    /// Estimate of the square of the lowest angular frequency of bending [1/time²]; `None` without a beam.
    /// The estimate is the smallest bending stiffness, divided by the largest mass per length and the fourth power of the total length.
    pub(crate) fn slowest_bending(&self) -> Option<f64> {
        let extents = || self.bodies.iter().filter_map(|body| body.dynamics.extent());
        let length: f64 = extents().map(|(_, length)| length).sum();
        let bending =
            extents().map(|(section, _)| section.bending_stiffness).fold(f64::INFINITY, f64::min);
        let mass = extents().map(|(section, _)| section.mass_per_length).fold(0.0, f64::max);
        (length > 0.0).then(|| bending / mass / square(square(length)))
    }

    /// Number of negative eigenvalues of the stiffness for loads of fixed direction.
    pub(crate) fn negative_stiffness_count(&self) -> usize {
        self.negative_stiffness_count_with_inertia(0.0)
    }

    /// Number of negative eigenvalues of the stiffness plus `rate` [1/time²] times the inertia.
    pub(crate) fn negative_stiffness_count_with_inertia(&self, rate: f64) -> usize {
        let order = self.static_order();
        let inertia = match rate > 0.0 {
            true => self.sparse_inertia(&order),
            false => SymmetricSparse::new(order.count(), |_| {}),
        };
        let mut stiffness = PreciseBand::zeros(order.count(), order.half_bandwidth());
        self.for_each_static_span(&order, &mut |degrees, span| {
            add_resistance(&mut stiffness, degrees, span);
        });
        let own: Vec<f64> = (0..stiffness.size()).map(|at| stiffness.diagonal(at).abs()).collect();
        self.for_each_static_constraint(&order, |at| own[at], &mut |degrees, span| {
            add_resistance(&mut stiffness, degrees, span);
        });
        stiffness.pivots(rate, &inertia).map_or(0, |pivots| pivots.negative)
    }
}

fn in_order<'t>(
    order: &'t StaticOrder,
    take: &'t mut dyn FnMut(&[usize], &SpanStiffness),
) -> impl FnMut(&[usize], &SpanStiffness) {
    move |unknowns, span| match order.is_step_order() {
        true => take(unknowns, span),
        false => {
            let places: Vec<usize> = unknowns.iter().map(|at| order.place(*at)).collect();
            take(&places, span);
        }
    }
}

/// Adds the stiffness of a span or an element with the given degrees of freedom to a stiffness matrix.
pub fn add_resistance(stiffness: &mut PreciseBand, degrees: &[usize], span: &SpanStiffness) {
    let width = degrees.len();
    for (factor, row) in span.stiffness.iter().zip(span.strains.chunks_exact(width)) {
        stiffness.add_square(degrees, *factor, row);
    }
    for twist in span.twists.chunks_exact(2 * width) {
        let (p, q) = twist.split_at(width);
        stiffness.add_product(degrees, p, q);
    }
}
