//! Section forces at any position along a beam (docs/theory.md, section 13.4).
//!
//! Near the ends of a beam, the forces at quadrature points have an error of first order.
//! Section forces at other positions are therefore weighted sums of the forces at the quadrature points.
//! The weights make integrals of the section forces equal to those of the quadrature, which balance loads and inertia.
//!
//! The spans between two joints or nodes of the beam are smoothly joined. In this file, a run is such a sequence of smoothly joined spans.
//! At a joint or node, each of the two adjoining runs has its own section force.

use super::sections::{Interpolation, Sections};
use super::span_points::{SpanGroup, group_of};
use super::{BeamError, Mesh, Section};
use crate::geometry::{LowerSplines, Reproduction, Span, Vec2, cross, larger};

/// Largest weight of a quadrature point that counts as zero, as a fraction of the largest weight at the same position.
const NO_WEIGHT: f64 = 1e-14;

/// Section forces and strains at a cross section.
///
/// Section forces are the forces that the following part of the beam exerts on the preceding part.
/// Components of section forces refer to the section frame, whose first axis is the section normal.
/// With material damping, section forces include viscous forces.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SectionForces {
    /// Unit normal of the section [-]; zero on particles and rigid bodies, which have no section.
    pub normal: Vec2,
    /// Axial force `N`, positive in tension [force].
    pub axial: f64,
    /// Shear force `Q`, positive in the direction of the normal rotated by 90° counter-clockwise [force].
    pub shear: f64,
    /// Bending moment `M`, positive counter-clockwise [force·length].
    pub moment: f64,
    /// Axial strain `Γ1` [-], which is `N/EA` without damping.
    pub axial_strain: f64,
    /// Shear strain `Γ2` [-], which is `Q/GA` without damping.
    pub shear_strain: f64,
    /// Bending strain `κ` [1/length]: curvature minus initial curvature, which is `M/EI` without damping.
    pub curvature: f64,
}

impl SectionForces {
    pub(super) fn of(section: &Section, normal: Vec2, force: Vec2, moment: f64) -> Self {
        let normal = normal.normalize();
        let (axial, shear) = (normal.dot(&force), cross(normal, force));
        Self {
            normal,
            axial,
            shear,
            moment,
            axial_strain: axial / section.axial_stiffness,
            shear_strain: shear / section.shear_stiffness,
            curvature: moment / section.bending_stiffness,
        }
    }

    pub(crate) fn with_viscous(self, (force, moment): (Vec2, f64)) -> Self {
        Self {
            axial: self.axial + self.normal.dot(&force),
            shear: self.shear + cross(self.normal, force),
            moment: self.moment + moment,
            ..self
        }
    }

    /// Strain energy per initial length, `(N Γ1 + Q Γ2 + M κ)/2` [energy/length].
    /// The section forces must not contain viscous forces.
    pub fn strain_energy(&self) -> f64 {
        let Self { axial, shear, moment, axial_strain, shear_strain, curvature, .. } = *self;
        0.5 * (axial * axial_strain + shear * shear_strain + moment * curvature)
    }
}

/// Position along a beam, with the weights of the quadrature points in the sums for the section forces.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SectionPlace {
    pub(super) force_shares: Vec<ForceShare>,
    pub(super) moment_shares: Vec<MomentShare>,
}

impl SectionPlace {
    pub(super) fn sum_up<const N: usize, S: Sections>(
        &self,
        section: &Section,
        groups: &[SpanGroup<N, S>],
    ) -> SectionForces {
        let (mut normal, mut force, mut moment) = (Vec2::zeros(), Vec2::zeros(), 0.0);
        let mut here = S::Interpolation::default();
        for share in &self.force_shares {
            let (group, span) = group_of(groups, share.span);
            let (point, of_point) = group.force_point_of(section, span, share.point);
            let (at_point, couple) = point.transmitted(of_point);
            here.add(of_point, share.of_normal);
            normal += point.normal() * share.of_normal;
            force += at_point * share.of_force;
            moment += couple * share.of_couple;
        }
        for share in &self.moment_shares {
            let (group, span) = group_of(groups, share.span);
            let (point, of_point) = group.moment_point_of(section, span, share.point);
            moment += point.transmitted(of_point) * share.of_moment;
        }
        SectionForces::of(here.section(section), normal, force, moment)
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ForceShare {
    pub(super) span: usize,
    pub(super) point: usize,
    pub(super) of_normal: f64,
    pub(super) of_force: f64,
    pub(super) of_couple: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MomentShare {
    pub(super) span: usize,
    pub(super) point: usize,
    pub(super) of_moment: f64,
}

/// Quadrature points of a beam in the order of the parameter, grouped into runs of smoothly joined spans.
#[derive(Debug, Clone)]
pub struct SectionPoints {
    runs: Vec<SmoothRun>,
    most: usize,
}

#[derive(Debug, Clone)]
struct SmoothRun {
    splines: LowerSplines,
    spans: Vec<Span>,
    of_force: Vec<PointAt>,
    of_moment: Vec<PointAt>,
}

#[derive(Debug, Clone, Copy)]
struct PointAt {
    xi: f64,
    weight: f64,
    of_run: usize,
    span: usize,
    point: usize,
}

impl SectionPoints {
    /// Collects the quadrature points of a beam on a mesh.
    ///
    /// # Errors
    /// Fails if the mesh has no quadrature.
    pub fn of(mesh: &Mesh) -> Result<Self, BeamError> {
        let numbered: Vec<_> = mesh.quadrature_spans()?.into_iter().enumerate().collect();
        let mut runs = Vec::new();
        for run in numbered.chunk_by(|(_, a), (_, b)| mesh.is_smooth(&a.span, &b.span)) {
            let (mut of_force, mut of_moment) = (Vec::new(), Vec::new());
            for (of_run, (index, quadrature)) in run.iter().enumerate() {
                let at =
                    |(point, (xi, weight))| PointAt { xi, weight, of_run, span: *index, point };
                of_force.extend(quadrature.force_rule.iter().copied().enumerate().map(at));
                let rule = quadrature.moment_rule()?;
                let span = quadrature.span;
                of_moment.extend(rule.iter_on(span.start, span.end).enumerate().map(at));
            }
            let spans: Vec<Span> = run.iter().map(|(_, quadrature)| quadrature.span).collect();
            let splines = LowerSplines::of(mesh.basis(), &spans)?;
            runs.push(SmoothRun { splines, spans, of_force, of_moment });
        }
        Ok(Self { runs, most: (mesh.basis().degree() + 1).next_multiple_of(2) })
    }

    /// Position at a parameter of the mesh. Where two runs of smoothly joined spans meet, the position belongs to the second run.
    ///
    /// # Errors
    /// Fails in the same cases as [`of`](Self::of).
    pub fn at(&self, xi: f64) -> Result<SectionPlace, BeamError> {
        let run = self.runs.partition_point(|run| run.end() <= xi).min(self.runs.len() - 1);
        self.runs[run].place(xi, self.most)
    }

    /// Positions along the whole beam with their parameters: the knots, and `within` positions in each span.
    /// A knot between two runs of smoothly joined spans has two positions: the end of the first run and the start of the second run.
    ///
    /// # Errors
    /// Fails in the same cases as [`of`](Self::of).
    pub fn along(&self, within: usize) -> Result<Vec<(f64, SectionPlace)>, BeamError> {
        let pieces = (within + 1) as f64;
        let of_run = |run: &SmoothRun| {
            let inside = |span: &Span| {
                let (start, length) = (span.start, span.end - span.start);
                (0..=within).map(move |i| start + length * i as f64 / pieces)
            };
            let parameters = run.spans.iter().flat_map(inside).chain([run.end()]);
            let places = parameters.map(|xi| Ok((xi, run.place(xi, self.most)?)));
            places.collect::<Vec<Result<_, BeamError>>>()
        };
        self.runs.iter().flat_map(of_run).collect()
    }
}

impl SmoothRun {
    fn end(&self) -> f64 {
        self.spans[self.spans.len() - 1].end
    }

    fn place(&self, xi: f64, most: usize) -> Result<SectionPlace, BeamError> {
        let span = self.spans.partition_point(|span| span.end <= xi).min(self.spans.len() - 1);
        let here = self.splines.at(&self.spans[span], xi)?;
        let nearest = nearest(&self.of_force, most, xi);
        let share = |(index, at): (usize, &PointAt)| {
            let on = &self.spans[at.of_run];
            let is_near = nearest.contains(&index);
            ForceShare {
                span: at.span,
                point: at.point,
                of_normal: if is_near {
                    lagrange(&self.of_force[nearest.clone()], at, xi)
                } else {
                    0.0
                },
                of_force: at.weight * here.kernel(on, at.xi),
                of_couple: here.projection_error(on, at.xi),
            }
        };
        let mut force_shares: Vec<ForceShare> =
            self.of_force.iter().enumerate().map(share).collect();
        let largest = |of: fn(&ForceShare) -> f64, shares: &[ForceShare]| {
            NO_WEIGHT * shares.iter().map(|share| of(share).abs()).fold(0.0, larger)
        };
        let least_force = largest(|share| share.of_force, &force_shares);
        let least_couple = largest(|share| share.of_couple, &force_shares);
        force_shares.retain(|share| {
            share.of_normal != 0.0
                || share.of_force.abs() > least_force
                || share.of_couple.abs() > least_couple
        });
        Ok(SectionPlace { force_shares, moment_shares: self.moment_shares(&here) })
    }

    fn moment_shares(&self, here: &Reproduction<'_>) -> Vec<MomentShare> {
        let share = |at: &PointAt| MomentShare {
            span: at.span,
            point: at.point,
            of_moment: at.weight * here.kernel(&self.spans[at.of_run], at.xi),
        };
        let mut shares: Vec<MomentShare> = self.of_moment.iter().map(share).collect();
        let largest = shares.iter().map(|share| share.of_moment.abs()).fold(0.0, larger);
        shares.retain(|share| share.of_moment.abs() > NO_WEIGHT * largest);
        shares
    }
}

fn nearest(points: &[PointAt], most: usize, xi: f64) -> std::ops::Range<usize> {
    let count = most.min(points.len());
    let next = points.partition_point(|point| point.xi <= xi);
    let first = next.saturating_sub(count / 2).min(points.len() - count);
    first..first + count
}

fn lagrange(points: &[PointAt], of: &PointAt, xi: f64) -> f64 {
    let others = points.iter().filter(|other| other.xi != of.xi);
    others.map(|other| (xi - other.xi) / (of.xi - other.xi)).product()
}
