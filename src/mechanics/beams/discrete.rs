//! A beam on its mesh: the quadrature points of all spans, the control points and the inertia.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};

use super::at_rest::SpanAtRest;
use super::axis_point::Axis;
use super::block::Block;
use super::dynamics::{BlockSink, BodyDynamics, Collocation, ForceSummary, Movement};
use super::force_point::ForcePoint;
use super::mesh::QuadratureSpan;
use super::moment_point::MomentPoint;
use super::parts::{MOST_PARTS, Parts};
use super::sections::{MassIntegral, PerPoint, Sections, SectionsOnAxis, Uniform};
use super::span_points::{SpanPoints, window_mut};
use super::{
    BeamError, Mesh, RotationIncrement, Section, SectionForces, SectionPlace, SectionVariation,
};
use crate::geometry::Vec2;

/// A beam whose basis has `N` non-zero functions on a span.
#[derive(Debug, Clone)]
struct DiscreteBeam<const N: usize, S: Sections = Uniform> {
    /// That of all points, or of a beam that tapers the mean.
    section: Section,
    control_points: Vec<Vec2>,
    remainders: Vec<Vec2>,
    spans: Vec<SpanPoints<N, S>>,
    parts: Parts,
    /// `∫ N_a N_{a+k} dX` for k = 0 … N-1 [length], with the inertia where it varies.
    gram: Vec<[S::MassIntegral; N]>,
}

/// A beam with the axis that the control points draw on a mesh, where it is free of stress; `length` is about that of the
/// axis.
///
/// # Errors
/// When the axis has a point without a tangent.
pub fn discretise(
    control_points: Vec<Vec2>,
    length: f64,
    mesh: &Mesh,
    variation: &SectionVariation,
) -> Result<Box<dyn BodyDynamics>, BeamError> {
    match variation {
        SectionVariation::Uniform(_) => {
            with_sections::<Uniform>(control_points, length, mesh, variation)
        }
        SectionVariation::Numbers(_) | SectionVariation::Dimensions(_) => {
            with_sections::<PerPoint>(control_points, length, mesh, variation)
        }
    }
}

fn with_sections<S: Sections + 'static>(
    points: Vec<Vec2>,
    length: f64,
    mesh: &Mesh,
    variation: &SectionVariation,
) -> Result<Box<dyn BodyDynamics>, BeamError> {
    Ok(match mesh.basis().degree() {
        1 => Box::new(DiscreteBeam::<2, S>::new(mesh, variation, length, points)?),
        2 => Box::new(DiscreteBeam::<3, S>::new(mesh, variation, length, points)?),
        3 => Box::new(DiscreteBeam::<4, S>::new(mesh, variation, length, points)?),
        4 => Box::new(DiscreteBeam::<5, S>::new(mesh, variation, length, points)?),
        5 => Box::new(DiscreteBeam::<6, S>::new(mesh, variation, length, points)?),
        6 => Box::new(DiscreteBeam::<7, S>::new(mesh, variation, length, points)?),
        7 => Box::new(DiscreteBeam::<8, S>::new(mesh, variation, length, points)?),
        8 => Box::new(DiscreteBeam::<9, S>::new(mesh, variation, length, points)?),
        9 => Box::new(DiscreteBeam::<10, S>::new(mesh, variation, length, points)?),
        // Knot vectors refuse degrees above 10.
        _ => Box::new(DiscreteBeam::<11, S>::new(mesh, variation, length, points)?),
    })
}

impl<const N: usize, S: Sections> DiscreteBeam<N, S> {
    fn new(
        mesh: &Mesh,
        variation: &SectionVariation,
        length: f64,
        control_points: Vec<Vec2>,
    ) -> Result<Self, BeamError> {
        let axis = Axis::new(mesh.basis(), &control_points, length);
        let inertia_rule = mesh.inertia_rule()?;
        let on_axis = SectionsOnAxis::new(variation, mesh, &control_points)?;
        let mut gram = vec![[S::MassIntegral::default(); N]; control_points.len()];
        let mut spans = Vec::new();
        for (index, quadrature) in mesh.quadrature_spans()?.into_iter().enumerate() {
            let moment_rule = quadrature.moment_rule()?;
            let QuadratureSpan { span, force_rule, .. } = quadrature;
            let section = |(xi, _): (f64, f64)| on_axis.at(index, &span, xi);
            let at_force = force_rule.iter().copied().map(section).collect();
            let at_moment = moment_rule.iter_on(span.start, span.end).map(section).collect();
            spans.push(SpanPoints {
                first: span.first,
                force_points: axis
                    .points(span, force_rule)?
                    .into_iter()
                    .map(ForcePoint::new)
                    .collect(),
                moment_points: axis
                    .points(span, moment_rule.iter_on(span.start, span.end))?
                    .into_iter()
                    .map(|(axis, _)| MomentPoint::new(axis))
                    .collect(),
                sections: S::new(at_force, at_moment),
            });
            let of_inertia = || inertia_rule.iter_on(span.start, span.end);
            let points = axis.points::<N>(span, of_inertia())?;
            for ((at, _), place) in points.into_iter().zip(of_inertia()) {
                let section = section(place);
                for (a, row) in gram[span.first..span.first + N].iter_mut().enumerate() {
                    for (k, entry) in row[..N - a].iter_mut().enumerate() {
                        entry.add(at.weight * at.shape[a] * at.shape[a + k], &section);
                    }
                }
            }
        }
        let remainders = vec![Vec2::zeros(); control_points.len()];
        let parts = Parts::default();
        let section = variation.mean();
        Ok(Self { section, control_points, remainders, spans, parts, gram })
    }

    /// The sum over the functions of what belongs to their products with that of every control point.
    fn lumped(&self, of: impl Fn(S::MassIntegral) -> f64) -> Vec<f64> {
        let mut sums = vec![0.0; self.gram.len()];
        for (a, row) in self.gram.iter().enumerate() {
            for (b, entry) in (a..self.gram.len()).zip(row) {
                sums[a] += of(*entry);
                if b > a {
                    sums[b] += of(*entry);
                }
            }
        }
        sums
    }

    /// Adds `factor · M · rates` to the forces on the control points of a range.
    fn add_inertia_at(
        &self,
        points: Range<usize>,
        factor: f64,
        rates: &[Movement],
        forces: &mut [Movement],
    ) {
        for (point, force) in points.zip(forces) {
            let mut add = |entry: S::MassIntegral, rate: &Movement| {
                let inertia = entry.inertia(factor, &self.section);
                for ((force, inertia), rate) in force.iter_mut().zip(inertia).zip(rate) {
                    *force += inertia * rate;
                }
            };
            // Where all neighbours are there, the compiler knows how many.
            if let Some(first) = (point + 1).checked_sub(N)
                && let Some(gram) = self.gram[first..].first_chunk::<N>()
                && let Some(before) = rates[first..].first_chunk::<N>()
                && let Some(behind) = rates[point..].first_chunk::<N>()
            {
                (0..N - 1).for_each(|other| add(gram[other][N - 1 - other], &before[other]));
                (0..N).for_each(|other| add(gram[N - 1][other], &behind[other]));
            } else {
                let before = point.saturating_sub(N - 1)..point;
                before.for_each(|other| add(self.gram[other][point - other], &rates[other]));
                let behind = self.gram[point].iter().zip(&rates[point..]);
                behind.for_each(|(entry, rate)| add(*entry, rate));
            }
        }
    }
}

/// Moves a point by x and y [length], and keeps in `remainder` what rounding cuts off for the next time (compensated summation, Kahan 1965).
pub(super) fn move_compensated(point: &mut Vec2, remainder: &mut Vec2, [x, y, _]: &Movement) {
    let wanted = Vec2::new(*x, *y) + *remainder;
    let reached = *point + wanted;
    *remainder = wanted - (reached - *point);
    *point = reached;
}

/// The work of [`add_linearised_forces`](BodyDynamics::add_linearised_forces) on some spans.
struct Linearisation<'a, const N: usize, S> {
    section: &'a Section,
    spans: &'a mut [SpanPoints<N, S>],
    at: Collocation,
    moved: &'a [Movement],
    weight: f64,
    /// Of the control points from this one on.
    first: usize,
    forces: &'a mut [Movement],
    tangent: &'a mut dyn FnMut(usize, &[f64]),
}

impl<const N: usize, S: Sections> WithSimd for Linearisation<'_, N, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: Simd>(self, simd: V) {
        let Self { section, spans, at, moved, weight, first, forces, tangent } = self;
        for span in spans {
            let forces = window_mut(forces, span.first - first);
            let mut block = Block::zeros(simd);
            span.add_linearised_forces(section, at, moved, weight, forces, &mut block);
            tangent(span.first, block.entries());
        }
    }
}

impl<const N: usize, S: Sections> BodyDynamics for DiscreteBeam<N, S> {
    fn order(&self) -> usize {
        N
    }

    fn span_starts(&self) -> Vec<usize> {
        self.spans.iter().map(|span| span.first).collect()
    }

    fn control_points(&self) -> &[Vec2] {
        &self.control_points
    }

    fn remainders(&self) -> &[Vec2] {
        &self.remainders
    }

    fn divide(&mut self, most: usize) -> Vec<usize> {
        self.parts = Parts::worthwhile(&self.spans, most);
        self.parts.first_points()
    }

    fn begin_step(&mut self) {
        self.parts.each(&mut self.spans, |span| {
            span.force_points.iter_mut().for_each(ForcePoint::begin_step);
            span.moment_points.iter_mut().for_each(MomentPoint::begin_step);
        });
    }

    fn add_forces(
        &mut self,
        at: Collocation,
        moved: &[Movement],
        weight: f64,
        forces: &mut [Movement],
    ) -> ForceSummary {
        let Self { section, spans, parts, .. } = self;
        let mut summaries = [ForceSummary::default(); MOST_PARTS];
        let summaries = &mut summaries[..parts.count()];
        parts.sum(spans, forces, summaries, |summary, spans, first, forces| {
            for span in spans {
                let forces = window_mut(forces, span.first - first);
                span.add_forces(section, at, moved, weight, forces, summary);
            }
        });
        let mut summary = ForceSummary::default();
        summaries.iter().for_each(|part| summary.join(part));
        summary
    }

    fn add_linearised_forces(
        &mut self,
        at: Collocation,
        moved: &[Movement],
        weight: f64,
        forces: &mut [Movement],
        tangents: &mut [BlockSink<'_>],
    ) {
        let Self { section, spans, parts, .. } = self;
        parts.sum(spans, forces, tangents, |tangent, spans, first, forces| {
            let section = &*section;
            let some = Linearisation { section, spans, at, moved, weight, first, forces, tangent };
            Arch::new().dispatch(some);
        });
    }

    fn add_mismatch_forces(&mut self, weight: f64, forces: &mut [Movement]) {
        let Self { section, spans, parts, .. } = self;
        parts.sum_lightly(spans, forces, |spans, first, forces| {
            for span in spans {
                let forces = window_mut(forces, span.first - first);
                span.add_mismatch_forces(section, weight, forces);
            }
        });
    }

    fn correct_section_forces(&mut self, correction: &[Movement]) {
        let Self { section, spans, parts, .. } = self;
        parts.each(spans, |span| span.correct_section_forces(section, correction));
    }

    fn advance(&mut self, moved: &[Movement], rotations: RotationIncrement) {
        for ((point, remainder), movement) in
            self.control_points.iter_mut().zip(&mut self.remainders).zip(moved)
        {
            move_compensated(point, remainder, movement);
        }
        self.parts.each(&mut self.spans, |span| span.advance(moved, rotations));
    }

    fn add_inertia(&self, factor: f64, rates: &[Movement], forces: &mut [Movement]) {
        self.parts.each_point(forces, |points, forces| {
            self.add_inertia_at(points, factor, rates, forces);
        });
    }

    fn add_inertia_tangent(
        &self,
        factor: f64,
        points: Range<usize>,
        tangent: &mut dyn FnMut(usize, usize, &[Movement]),
    ) {
        for point in points {
            let first = point.saturating_sub(N - 1);
            let mut row = [Movement::default(); N];
            for (inertia, other) in row.iter_mut().zip(first..point) {
                *inertia = self.gram[other][point - other].inertia(factor, &self.section);
            }
            tangent(point, first, &row[..point - first]);
            row = self.gram[point].map(|entry| entry.inertia(factor, &self.section));
            tangent(point, point, &row[..N.min(self.gram.len() - point)]);
        }
    }

    fn each_span_at_rest(&self, take: &mut dyn FnMut(&SpanAtRest)) {
        let mut rows = SpanAtRest::default();
        for span in &self.spans {
            span.write_at_rest(&self.section, &mut rows);
            take(&rows);
        }
    }

    fn extent(&self) -> Option<(Section, f64)> {
        Some((self.section, self.lumped_lengths().iter().sum()))
    }

    fn write_normals(&self, normals: &mut Vec<Vec2>) {
        let points = self.spans.iter().flat_map(|span| &span.force_points);
        normals.extend(points.map(ForcePoint::normal));
    }

    fn strain_energy(&self) -> f64 {
        self.spans.iter().map(|span| span.strain_energy(&self.section)).sum()
    }

    fn strain_energies(&self) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for span in &self.spans {
            span.add_strain_energies(&self.section, &mut sums);
        }
        sums
    }

    fn section_forces(&self, place: &SectionPlace) -> SectionForces {
        place.sum_up(&self.section, &self.spans)
    }

    fn lumped_lengths(&self) -> Vec<f64> {
        self.lumped(|entry| entry.length())
    }

    fn lumped_masses(&self) -> Vec<f64> {
        let weighed = self.lumped(|entry| entry.inertia(1.0, &self.section)[0]);
        S::masses(&self.section, self.lumped_lengths(), weighed)
    }

    fn save(&self, state: &mut Vec<f64>) {
        for (point, remainder) in self.control_points.iter().zip(&self.remainders) {
            state.extend([point.x, point.y, remainder.x, remainder.y]);
        }
        for span in &self.spans {
            span.force_points.iter().for_each(|point| point.save(state));
            span.moment_points.iter().for_each(|point| point.save(state));
        }
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        for (point, remainder) in self.control_points.iter_mut().zip(&mut self.remainders) {
            *point = Vec2::new(next(), next());
            *remainder = Vec2::new(next(), next());
        }
        for span in &mut self.spans {
            span.force_points
                .iter_mut()
                .for_each(|point| point.restore(std::array::from_fn(|_| next())));
            span.moment_points
                .iter_mut()
                .for_each(|point| point.restore(std::array::from_fn(|_| next())));
        }
    }
}

#[cfg(test)]
mod tests;
