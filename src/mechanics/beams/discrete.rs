//! Discretised beam: quadrature points of all spans, control points and inertia.

use std::ops::Range;

use super::axis_point::BeamAxis;
use super::dynamics::{BlockSink, BodyDynamics, Collocation, ForceSummary, Movement};
use super::force_point::ForcePoint;
use super::inertia::InertiaMatrix;
use super::mesh::QuadratureSpan;
use super::moment_point::MomentPoint;
use super::sections::{MassIntegral, PerPoint, Sections, SectionsOnAxis, Uniform};
use super::span_loops::{
    Advance, ForceAssembly, ForceCorrection, ForcesFrom, Linearisation, MismatchForces, SpanInputs,
    SpanLoop,
};
use super::span_partition::{MOST_PARTS, SpanPartition};
use super::span_points::{SPANS_AT_ONCE, SpanGroup, SpanOfPoints};
use super::span_stiffness::SpanStiffness;
use super::{
    BeamError, Mesh, RotationIncrement, Section, SectionForces, SectionPlace, SectionVariation,
};
use crate::geometry::Vec2;

#[derive(Debug, Clone)]
struct DiscreteBeam<const N: usize, S: Sections = Uniform> {
    /// Section at all points of a uniform beam; for a tapered beam the mean section.
    section: Section,
    control_points: Vec<Vec2>,
    remainders: Vec<Vec2>,
    groups: Vec<SpanGroup<N, S>>,
    parts: SpanPartition,
    inertia: InertiaMatrix<N, S::MassIntegral>,
}

/// Creates a discretised beam whose stress-free axis is given by control points. `length` is the approximate length of the axis.
///
/// # Errors
/// Fails if the axis has a point without a tangent, or if the mesh has no quadrature.
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
        // The largest supported degree is 10. Knot vectors reject higher degrees.
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
        let axis = BeamAxis::new(mesh.basis(), &control_points, length);
        let inertia_rule = mesh.inertia_rule()?;
        let on_axis = SectionsOnAxis::new(variation, mesh, &control_points)?;
        let mut gram = vec![[S::MassIntegral::default(); N]; control_points.len()];
        let mut spans = Vec::new();
        for (index, quadrature) in mesh.quadrature_spans()?.into_iter().enumerate() {
            let moment_rule = quadrature.moment_rule()?;
            let QuadratureSpan { span, force_rule, .. } = quadrature;
            let section = |(xi, _): (f64, f64)| on_axis.at(index, &span, xi);
            let at_force: Vec<Section> = force_rule.iter().copied().map(section).collect();
            let at_moment = moment_rule.iter_on(span.start, span.end).map(section);
            let force_points = axis.points(span, force_rule)?.into_iter().map(ForcePoint::new);
            let of_moment = moment_rule.iter_on(span.start, span.end);
            let moment_points =
                axis.points(span, of_moment)?.into_iter().map(|(axis, _)| MomentPoint::new(axis));
            spans.push(SpanOfPoints {
                first: span.first,
                force_points: force_points.zip(at_force).collect(),
                moment_points: moment_points.zip(at_moment).collect(),
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
        let groups = spans.chunks(SPANS_AT_ONCE).map(SpanGroup::side_by_side).collect();
        let remainders = vec![Vec2::zeros(); control_points.len()];
        let parts = SpanPartition::default();
        let section = variation.mean();
        let inertia = InertiaMatrix::new(gram, section);
        Ok(Self { section, control_points, remainders, groups, parts, inertia })
    }
}

/// Displaces a point by x and y [length] with compensated summation (Kahan 1965). `remainder` contains the rounding error of the sum.
pub(super) fn move_compensated(point: &mut Vec2, remainder: &mut Vec2, [x, y, _]: &Movement) {
    let wanted = Vec2::new(*x, *y) + *remainder;
    let reached = *point + wanted;
    *remainder = wanted - (reached - *point);
    *point = reached;
}

impl<const N: usize, S: Sections> BodyDynamics for DiscreteBeam<N, S> {
    fn order(&self) -> usize {
        N
    }

    fn span_starts(&self) -> Vec<usize> {
        self.groups.iter().flat_map(|group| &group.spans).map(|span| span.first).collect()
    }

    fn control_points(&self) -> &[Vec2] {
        &self.control_points
    }

    fn remainders(&self) -> &[Vec2] {
        &self.remainders
    }

    fn divide(&mut self, most: usize) -> Vec<usize> {
        self.parts = SpanPartition::worthwhile(&self.groups, most);
        self.parts.first_points()
    }

    fn begin_step(&mut self) {
        self.parts.each(&mut self.groups, |groups| {
            groups.iter_mut().for_each(SpanGroup::begin_step);
        });
    }

    fn add_forces(
        &mut self,
        at: Collocation,
        moved: &[Movement],
        weight: f64,
        forces: &mut [Movement],
    ) -> ForceSummary {
        let Self { section, groups, parts, .. } = self;
        let iterate = SpanInputs { section, at, movements: moved, weight };
        let mut summaries = [ForceSummary::default(); MOST_PARTS];
        let summaries = &mut summaries[..parts.count()];
        parts.sum(groups, forces, summaries, |summary, groups, first, forces| {
            // Each thread writes to a local copy of its summary, because concurrent writes to adjacent summaries are slow (false sharing).
            let mut own = *summary;
            let forces = ForcesFrom { first, forces };
            ForceAssembly { iterate, forces, summary: &mut own }.over(groups);
            *summary = own;
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
        let Self { section, groups, parts, .. } = self;
        let iterate = SpanInputs { section, at, movements: moved, weight };
        parts.sum(groups, forces, tangents, |tangent, groups, first, forces| {
            Linearisation { iterate, forces: ForcesFrom { first, forces }, tangent }.over(groups);
        });
    }

    fn add_mismatch_forces(&mut self, weight: f64, forces: &mut [Movement]) {
        let Self { section, groups, parts, .. } = self;
        let section = &*section;
        parts.sum_lightly(groups, forces, |groups, first, forces| {
            MismatchForces { section, weight, forces: ForcesFrom { first, forces } }.over(groups);
        });
    }

    fn correct_section_forces(&mut self, correction: &[Movement]) {
        let Self { section, groups, parts, .. } = self;
        let correction = ForceCorrection { section, movements: correction };
        parts.each(groups, |groups| correction.over(groups));
    }

    fn advance(&mut self, moved: &[Movement], rotations: RotationIncrement) {
        for ((point, remainder), movement) in
            self.control_points.iter_mut().zip(&mut self.remainders).zip(moved)
        {
            move_compensated(point, remainder, movement);
        }
        let advance = Advance { movements: moved, rotations };
        self.parts.each(&mut self.groups, |groups| advance.over(groups));
    }

    fn add_inertia(&self, factor: f64, rates: &[Movement], forces: &mut [Movement]) {
        self.parts.each_point(forces, |points, forces| {
            self.inertia.add_product(points, factor, rates, forces);
        });
    }

    fn add_inertia_tangent(
        &self,
        factor: f64,
        points: Range<usize>,
        tangent: &mut dyn FnMut(usize, usize, &[Movement]),
    ) {
        self.inertia.each_row(factor, points, tangent);
    }

    fn each_inertia_diagonal(
        &self,
        factor: f64,
        points: Range<usize>,
        tangent: &mut dyn FnMut(usize, isize, &[f64]),
    ) {
        self.inertia.each_diagonal(factor, points, tangent);
    }

    fn for_each_static_span(&self, take: &mut dyn FnMut(&SpanStiffness)) {
        let mut rows = SpanStiffness::default();
        for group in &self.groups {
            group.for_each_static_span(&self.section, &mut rows, take);
        }
    }

    fn extent(&self) -> Option<(Section, f64)> {
        Some((self.section, self.lumped_lengths().iter().sum()))
    }

    fn write_normals(&self, normals: &mut Vec<Vec2>) {
        for group in &self.groups {
            group.write_normals(normals);
        }
    }

    fn strain_energy(&self) -> f64 {
        self.groups.iter().flat_map(|group| group.strain_energies_of_spans(&self.section)).sum()
    }

    fn strain_energies(&self) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for group in &self.groups {
            group.add_strain_energies(&self.section, &mut sums);
        }
        sums
    }

    fn section_forces(&self, place: &SectionPlace) -> SectionForces {
        place.sum_up(&self.section, &self.groups)
    }

    fn lumped_lengths(&self) -> Vec<f64> {
        self.inertia.lumped(|entry| entry.length())
    }

    fn lumped_masses(&self) -> Vec<f64> {
        let weighed = self.inertia.lumped(|entry| entry.inertia(1.0, &self.section)[0]);
        S::masses(&self.section, self.lumped_lengths(), weighed)
    }

    fn save(&self, state: &mut Vec<f64>) {
        for (point, remainder) in self.control_points.iter().zip(&self.remainders) {
            state.extend([point.x, point.y, remainder.x, remainder.y]);
        }
        self.groups.iter().for_each(|group| group.save(state));
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        for (point, remainder) in self.control_points.iter_mut().zip(&mut self.remainders) {
            *point = Vec2::new(next(), next());
            *remainder = Vec2::new(next(), next());
        }
        self.groups.iter_mut().for_each(|group| group.restore(next));
    }
}

#[cfg(test)]
mod tests;
