//! Geometry of a body in contact: the axis of a beam with its thickness, or a disc around a point.

use std::iter::once;

use crate::beams::{BodyPoint, Movement};
use crate::elementary::square;
use crate::geometry::{Basis, BasisValues, Span, Vec2, cross};
use crate::system::elements::contact::DiscPath;

/// Number of intervals between the samples of a span in the search for the nearest point.
const SAMPLES: usize = 4;

const MOST_ITERATIONS: usize = 60;

/// Largest cosine of the angle between two lines that count as perpendicular: the axis, and the line from the contact point to its foot.
const PERPENDICULAR: f64 = 1e-6;

/// Relative rounding error of distances.
const ROUNDING: f64 = 1e-12;

#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    low: Vec2,
    high: Vec2,
}

impl Default for Bounds {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl Bounds {
    const EMPTY: Self = Self {
        low: Vec2::new(f64::INFINITY, f64::INFINITY),
        high: Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    pub(super) fn of(points: impl Iterator<Item = Vec2>) -> Self {
        points.fold(Self::EMPTY, |all, point| all.joined(Self { low: point, high: point }))
    }

    pub(super) fn joined(self, other: Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    pub(super) fn diagonal(&self) -> f64 {
        (self.high - self.low).norm()
    }

    fn grown(self, fraction: f64) -> Self {
        let by = (self.high - self.low) * fraction;
        Self { low: self.low - by, high: self.high + by }
    }

    pub(super) fn squared_distance(&self, other: &Self) -> f64 {
        let apart = |axis: usize| {
            (self.low[axis] - other.high[axis]).max(other.low[axis] - self.high[axis]).max(0.0)
        };
        square(apart(0)) + square(apart(1))
    }

    fn squared_distance_from(&self, point: Vec2) -> f64 {
        self.squared_distance(&Self { low: point, high: point })
    }
}

/// Foot of the perpendicular from a contact point: the nearest point of an axis, as a combination of control points.
/// The foot of a disc is its centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct Foot {
    pub(super) xi: f64,
    pub(super) span: usize,
    /// Weights of the control points in the position of the foot, and the derivatives of these weights with respect to ξ.
    pub(super) values: BasisValues,
    /// True if the foot can move along the axis of the touched body. False at the ends of a beam, at corners, and for discs.
    pub(super) is_free: bool,
}

impl Foot {
    pub(super) fn weights(&self, order: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        (self.values.first..).zip(self.values.derivatives(order).iter().copied())
    }

    pub(super) fn combine(&self, order: usize, of_points: &[Vec2]) -> Vec2 {
        self.weights(order).fold(Vec2::zeros(), |sum, (at, weight)| sum + of_points[at] * weight)
    }
}

/// Parts of an axis that a contact point can touch, as intervals of the parameter. Infinite bounds extend to the ends of the axis.
pub(super) type AllowedParts = [(f64, f64); 2];

pub(super) const WHOLE_AXIS: AllowedParts =
    [(f64::NEG_INFINITY, f64::INFINITY), (f64::INFINITY, f64::NEG_INFINITY)];

#[derive(Debug, Clone)]
pub(super) struct ContactSite {
    pub(super) place: BodyPoint,
    /// Quadrature weight of a contact point of a beam [length]; 1 for a particle or a point of a body.
    pub(super) weight: f64,
    /// Parts of the axis of the same beam that the contact point can touch, without the parts close to the point along the axis.
    pub(super) allowed: AllowedParts,
    pub(super) touched: Vec<usize>,
}

#[derive(Debug, Clone, Default)]
pub(super) struct Configuration {
    pub(super) points: Vec<Vec2>,
    bounds: Bounds,
    /// Boxes around the spans; empty until needed.
    spans: Vec<Bounds>,
    /// Samples of all spans, one span after the other.
    samples: Vec<Vec2>,
}

impl Configuration {
    pub(super) fn is_beyond(&self, position: Vec2, distance: f64) -> bool {
        self.bounds().squared_distance_from(position) >= square(distance)
    }

    pub(super) fn bounds(&self) -> Bounds {
        self.bounds
    }
}

#[derive(Debug, Clone)]
enum Axis {
    Curve(SampledCurve),
    Point(Box<Foot>),
}

#[derive(Debug, Clone)]
struct SampledCurve {
    basis: Basis,
    spans: Vec<Span>,
    weights: Vec<f64>,
    /// Enlargement of the box around the control points of a span, as a fraction of the size of the box [-]. The enlarged box contains the curve.
    growth: f64,
}

impl SampledCurve {
    fn new(basis: &Basis) -> Self {
        // B-splines lie in the convex hull of their control points. Lagrange polynomials overshoot.
        let growth = if matches!(basis, Basis::BSpline(_)) { 0.0 } else { 1.0 };
        let spans = basis.spans();
        let values = |span: &Span| {
            let places = (0..=SAMPLES).map(|at| sample(span.start, span.end, at));
            places.map(|xi| basis.evaluate_in(span, xi)).collect::<Vec<_>>()
        };
        let weights = spans.iter().flat_map(values).flat_map(|at| at.values().to_vec()).collect();
        Self { basis: basis.clone(), spans, weights, growth }
    }
}

fn sample(low: f64, high: f64, at: usize) -> f64 {
    low + (high - low) * (at as f64 / SAMPLES as f64)
}

#[derive(Debug, Clone)]
pub(super) struct Shape {
    pub(super) body: usize,
    pub(super) radius: f64,
    axis: Axis,
    pub(super) sites: Vec<ContactSite>,
    pub(super) start: Configuration,
    pub(super) end: Configuration,
    /// Displacements of the control points in the present iterate [length].
    pub(super) movements: Vec<Vec2>,
    /// Velocities of the control points at the start of the step [length/time].
    pub(super) velocities: Vec<Vec2>,
    /// Rotations of the control points in the present iterate [rad].
    pub(super) rotations: Vec<f64>,
    /// Mass of each control point; infinite if it is supported [mass].
    masses: Vec<f64>,
    /// Rotary inertia of each control point; infinite if it is supported [mass·length²].
    rotary_inertias: Vec<f64>,
}

impl Shape {
    pub(super) fn of_beam(
        body: usize,
        basis: &Basis,
        radius: f64,
        sites: Vec<ContactSite>,
    ) -> Self {
        Self::new(body, radius, Axis::Curve(SampledCurve::new(basis)), sites)
    }

    pub(super) fn of_point(radius: f64, site: ContactSite) -> Self {
        let BodyPoint { body, first, .. } = site.place;
        let foot = Foot { xi: 0.0, span: 0, values: BasisValues::constant(first), is_free: false };
        Self::new(body, radius, Axis::Point(Box::new(foot)), vec![site])
    }

    fn new(body: usize, radius: f64, axis: Axis, sites: Vec<ContactSite>) -> Self {
        let [start, end] = [Configuration::default(), Configuration::default()];
        Self {
            body,
            radius,
            axis,
            sites,
            start,
            end,
            movements: Vec::new(),
            velocities: Vec::new(),
            rotations: Vec::new(),
            masses: Vec::new(),
            rotary_inertias: Vec::new(),
        }
    }

    pub(super) fn is_disc(&self) -> bool {
        matches!(self.axis, Axis::Point(_))
    }

    pub(super) fn set_masses(&mut self, inertias: impl Iterator<Item = [f64; 2]>) {
        (self.masses, self.rotary_inertias) = inertias.map(<(f64, f64)>::from).unzip();
    }

    /// Inverse of the effective mass at a combination of control points [1/mass].
    /// At a point of a rigid body that has no point mass, the inverse mass of the whole body is returned.
    pub(super) fn mobility(&self, weights: impl Iterator<Item = (usize, f64)>) -> f64 {
        let sum: f64 = weights.map(|(at, share)| square(share) / self.masses[at]).sum();
        if sum.is_finite() { sum } else { 1.0 / self.masses.iter().sum::<f64>() }
    }

    /// Inverse of the effective rotary inertia at a combination of control points [1/(mass·length²)]; zero for a body that does not rotate.
    pub(super) fn angular_mobility(&self, weights: impl Iterator<Item = (usize, f64)>) -> f64 {
        let sum: f64 = weights.map(|(at, share)| square(share) / self.rotary_inertias[at]).sum();
        if sum.is_finite() { sum } else { 0.0 }
    }

    pub(super) fn begin(&mut self, controls: &[Vec2]) {
        for configuration in [&mut self.start, &mut self.end] {
            configuration.points.clear();
            configuration.points.extend(controls);
            configuration.spans.clear();
            configuration.bounds = self.axis.bounds(controls);
        }
        self.movements.clear();
        self.movements.resize(controls.len(), Vec2::zeros());
        self.rotations.resize(controls.len(), 0.0);
    }

    pub(super) fn set_velocities(&mut self, rates: impl Iterator<Item = Movement>) {
        self.velocities.clear();
        self.velocities.extend(rates.map(|[x, y, _]| Vec2::new(x, y)));
    }

    pub(super) fn end_step(&mut self) {
        self.start.clone_from(&self.end);
        self.movements.fill(Vec2::zeros());
    }

    pub(super) fn move_by(&mut self, movements: impl Iterator<Item = Movement>) {
        for (at, [x, y, rotation]) in movements.enumerate() {
            self.movements[at] = Vec2::new(x, y);
            self.rotations[at] = rotation;
            self.end.points[at] = self.start.points[at] + self.movements[at];
        }
        self.end.spans.clear();
        self.end.bounds = self.axis.bounds(&self.end.points);
    }

    pub(super) fn prepare_search(&mut self) {
        self.axis.divide(&mut self.start);
        self.axis.divide(&mut self.end);
    }

    pub(super) fn configuration(&self, controls: &[Vec2]) -> Configuration {
        let bounds = self.axis.bounds(controls);
        let mut at = Configuration { points: controls.to_vec(), bounds, ..Default::default() };
        self.axis.divide(&mut at);
        at
    }

    /// Upper bound of the displacement of a point of the axis, as a multiple of the largest displacement of a control point [-].
    pub(super) fn amplification(&self) -> f64 {
        match &self.axis {
            Axis::Point(_) => 1.0,
            Axis::Curve(SampledCurve { growth, .. }) => 1.0 + 2.0 * growth,
        }
    }

    pub(super) fn vertices<'c>(&self, at: &'c Configuration) -> impl Iterator<Item = Vec2> + 'c {
        let last = match &self.axis {
            Axis::Point(foot) => at.points[foot.values.first],
            Axis::Curve(_) => at.samples[at.samples.len() - 1],
        };
        at.samples.iter().step_by(SAMPLES + 1).copied().chain(once(last))
    }

    pub(super) fn swept_bounds(&self) -> Bounds {
        self.start.bounds.joined(self.end.bounds)
    }

    /// Foot at a parameter of a span; `None` if the parameter is outside the span, or if the span does not exist.
    pub(super) fn foot_in(&self, span: usize, xi: f64) -> Option<Foot> {
        match &self.axis {
            Axis::Point(foot) => (span == 0).then_some(**foot),
            Axis::Curve(SampledCurve { basis, spans, .. }) => {
                let at = spans.get(span).filter(|at| (at.start..=at.end).contains(&xi))?;
                let values = basis.evaluate_in(at, xi);
                Some(Foot { xi, span, values, is_free: false })
            }
        }
    }

    /// Nearest point of the axis to the position of the search; `None` if the point is too far away or not in the searched parts.
    pub(super) fn nearest(&self, at: &Configuration, search: &NearestSearch) -> Option<Foot> {
        let NearestSearch { position, allowed, limit, hint } = *search;
        let (basis, spans) = match &self.axis {
            Axis::Curve(SampledCurve { basis, spans, .. }) => (basis, spans),
            Axis::Point(foot) => {
                let is_near = (foot.combine(0, &at.points) - position).norm() < limit;
                return is_near.then_some(**foot);
            }
        };
        let mut best: (f64, Option<(usize, f64)>) = (square(limit), None);
        let others = (0..spans.len()).filter(|index| *index != hint);
        for (index, span) in once(hint).chain(others).map(|index| (index, &spans[index])) {
            if at.spans[index].squared_distance_from(position) >= best.0 {
                continue;
            }
            let within = |&(low, high): &(f64, f64)| (span.start.max(low), span.end.min(high));
            for (low, high) in allowed.iter().map(within).filter(|(low, high)| low < high) {
                let search = SpanSearch { basis, span, at, index, position };
                let (squared, xi) = search.nearest_in(low, high);
                let is_end_of_part = allowed.iter().any(|(low, high)| xi == *low || xi == *high);
                if squared < best.0 && !is_end_of_part {
                    best = (squared, Some((index, xi)));
                }
            }
        }
        let (span, xi) = best.1?;
        let values = basis.evaluate_in(&spans[span], xi);
        let mut foot = Foot { xi, span, values, is_free: false };
        let apart = position - foot.combine(0, &at.points);
        let slope = foot.combine(1, &at.points);
        foot.is_free = apart.dot(&slope).abs() <= PERPENDICULAR * apart.norm() * slope.norm();
        Some(foot)
    }

    pub(super) fn is_crossed(&self, path: &CrossingPath) -> bool {
        let CrossingPath { from, to, allowed, radius } = *path;
        let (basis, spans) = match &self.axis {
            Axis::Curve(SampledCurve { basis, spans, .. }) => (basis, spans),
            Axis::Point(foot) => {
                let [before, after] = [(&self.start, from), (&self.end, to)]
                    .map(|(at, position)| position - foot.combine(0, &at.points));
                let is_closed = before.norm() < radius;
                let path = DiscPath { start: before, movement: after - before, radius, is_closed };
                return path.passes_through();
            }
        };
        let bounds = Bounds::of([from, to].into_iter());
        if self.swept_bounds().squared_distance(&bounds) > 0.0 {
            return false;
        }
        let is_near = |(index, span): &(usize, &Span)| {
            let swept = self.start.spans[*index].joined(self.end.spans[*index]);
            let is_within = |(low, high): &(f64, f64)| *low <= span.start && span.end <= *high;
            allowed.iter().any(is_within) && swept.squared_distance(&bounds) == 0.0
        };
        let near = spans.iter().enumerate().filter(is_near);
        let Some((hint, _)) = near.clone().next() else { return false };
        let mut search = NearestSearch { position: from, allowed, limit: f64::INFINITY, hint };
        let before = self.nearest(&self.start, &search);
        search.position = to;
        let after = self.nearest(&self.end, &search);
        let (Some(before), Some(after)) = (before, after) else { return false };
        let distance = (from - before.combine(0, &self.start.points)).norm()
            + (to - after.combine(0, &self.end.points)).norm();
        // A point that passes through the axis moves by at least the sum of its distances from the axis at the start and at the end.
        let moves = near.clone().flat_map(|(_, span)| {
            (span.first..=span.first + basis.degree()).map(|at| self.movements[at])
        });
        let longest = moves.map(|by| (to - from - by).norm()).fold(0.0, f64::max);
        if longest * (1.0 + ROUNDING) < distance {
            return false;
        }
        let side = |foot: &Foot, at: &Configuration, position: Vec2| {
            cross(foot.combine(1, &at.points), position - foot.combine(0, &at.points))
        };
        let changes_side = before.is_free
            && after.is_free
            && side(&before, &self.start, from) * side(&after, &self.end, to) < 0.0;
        let passes_chord = |(index, _): (usize, &Span)| {
            let vertex = |at: usize| {
                let sample = index * (SAMPLES + 1) + at;
                [from - self.start.samples[sample], to - self.end.samples[sample]]
            };
            (0..SAMPLES).any(|at| passes_between(vertex(at), vertex(at + 1)))
        };
        changes_side || near.into_iter().any(passes_chord)
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct CrossingPath {
    pub(super) from: Vec2,
    pub(super) to: Vec2,
    pub(super) allowed: AllowedParts,
    /// Sum of the radii of the contact point and of the touched body [length].
    pub(super) radius: f64,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct NearestSearch {
    pub(super) position: Vec2,
    pub(super) allowed: AllowedParts,
    pub(super) limit: f64,
    pub(super) hint: usize,
}

impl Axis {
    fn bounds(&self, points: &[Vec2]) -> Bounds {
        match self {
            Self::Point(foot) => Bounds::of([points[foot.values.first]].into_iter()),
            Self::Curve(SampledCurve { growth, .. }) => {
                Bounds::of(points.iter().copied()).grown(*growth)
            }
        }
    }

    fn divide(&self, at: &mut Configuration) {
        let Configuration { points, spans: bounds, samples, .. } = at;
        let Self::Curve(SampledCurve { basis, spans, weights, growth }) = self else { return };
        if !bounds.is_empty() {
            return;
        }
        samples.clear();
        let order = basis.degree() + 1;
        bounds.extend(spans.iter().map(|span| {
            let own = points[span.first..span.first + order].iter().copied();
            Bounds::of(own).grown(*growth)
        }));
        for (index, weights) in weights.chunks_exact(order).enumerate() {
            let first = spans[index / (SAMPLES + 1)].first;
            let own = points[first..first + order].iter().zip(weights);
            samples.push(own.fold(Vec2::zeros(), |sum, (at, by)| sum + at * *by));
        }
    }
}

struct SpanSearch<'a> {
    basis: &'a Basis,
    span: &'a Span,
    at: &'a Configuration,
    index: usize,
    position: Vec2,
}

impl SpanSearch<'_> {
    fn at(&self, xi: f64) -> [Vec2; 3] {
        let [place, slope, bend] = self.basis.curve_in(self.span, xi, &self.at.points);
        [place - self.position, slope, bend]
    }

    fn nearest_in(&self, low: f64, high: f64) -> (f64, f64) {
        let is_whole = (low, high) == (self.span.start, self.span.end);
        let squared = |at: usize| match is_whole {
            true => {
                let sample = self.at.samples[self.index * (SAMPLES + 1) + at];
                (sample - self.position).norm_squared()
            }
            false => self.at(sample(low, high, at))[0].norm_squared(),
        };
        let (mut best, mut nearest) = (0, squared(0));
        for at in 1..=SAMPLES {
            let here = squared(at);
            if here < nearest {
                (best, nearest) = (at, here);
            }
        }
        let xi = self.stationary(
            sample(low, high, best.saturating_sub(1)),
            sample(low, high, best),
            sample(low, high, (best + 1).min(SAMPLES)),
        );
        let squared = self.at(xi)[0].norm_squared();
        if squared < nearest { (squared, xi) } else { (nearest, sample(low, high, best)) }
    }

    /// Parameter between `low` and `high` at which the derivative of the distance is zero, by Newton's method with bisection.
    /// Returns `low` or `high` if the derivative of the distance has no zero between them.
    fn stationary(&self, mut low: f64, mut xi: f64, mut high: f64) -> f64 {
        for _ in 0..MOST_ITERATIONS {
            let [apart, slope, bend] = self.at(xi);
            let gradient = apart.dot(&slope);
            if gradient > 0.0 {
                high = xi
            } else {
                low = xi
            }
            let curvature = slope.norm_squared() + apart.dot(&bend);
            let next = xi - gradient / curvature;
            let is_inside = curvature > 0.0 && (low..=high).contains(&next);
            let next = if is_inside { next } else { 0.5 * (low + high) };
            if next == xi || low >= high {
                break;
            }
            xi = next;
        }
        xi
    }
}

/// Returns true if the segment between two points that move along straight lines passes over the origin.
fn passes_between([a, a_end]: [Vec2; 2], [b, b_end]: [Vec2; 2]) -> bool {
    let (da, db) = (a_end - a, b_end - b);
    // Twice the area of the triangle with corners at the origin and at the two points: c₀ + c₁ t + c₂ t² for t from 0 to 1.
    let (c0, c1, c2) = (cross(a, b), cross(da, b) + cross(a, db), cross(da, db));
    let root = (c1 * c1 - 4.0 * c2 * c0).sqrt();
    if root.is_nan() {
        return false;
    }
    let sum = -0.5 * (c1 + root.copysign(c1));
    [sum / c2, c0 / sum].into_iter().filter(|t| (0.0..=1.0).contains(t)).any(|t| {
        let (a, b) = (a + da * t, b + db * t);
        a.dot(&b) <= 0.0
    })
}
