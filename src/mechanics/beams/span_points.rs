//! Quadrature points of a group of consecutive spans.

use std::ops::Range;

use pulp::Simd;

use super::RotationIncrement;
use super::Section;
use super::dynamics::Movement;
use super::force_point::ForcePoint;
use super::force_points::ForcePoints;
use super::moment_point::MomentPoint;
use super::moment_points::MomentPoints;
use super::sections::{Sections, Uniform};
use super::simd::{LANES, LaneChunk};
use super::span_stiffness::SpanStiffness;
use crate::geometry::Vec2;

pub(super) const SPANS_AT_ONCE: usize = 16;

#[derive(Debug, Clone)]
pub(super) struct SpanPlace {
    pub(super) first: usize,
    pub(super) force_points: Range<usize>,
    pub(super) moment_points: Range<usize>,
}

pub(super) struct SpanOfPoints<const N: usize> {
    pub(super) first: usize,
    pub(super) force_points: Vec<(ForcePoint<N>, Section)>,
    pub(super) moment_points: Vec<(MomentPoint<N>, Section)>,
}

#[derive(Debug, Clone)]
pub(super) struct SpanGroup<const N: usize, S = Uniform> {
    pub(super) spans: Vec<SpanPlace>,
    pub(super) force_points: Vec<ForcePoints<N>>,
    pub(super) moment_points: Vec<MomentPoints<N>>,
    pub(super) sections: S,
}

#[inline(always)]
pub(super) fn window<const N: usize>(movements: &[Movement], first: usize) -> &[Movement; N] {
    movements[first..]
        .first_chunk()
        .expect("a span has as many control points as its basis has functions")
}

#[inline(always)]
pub(super) fn window_mut<const N: usize>(
    movements: &mut [Movement],
    first: usize,
) -> &mut [Movement; N] {
    movements[first..]
        .first_chunk_mut()
        .expect("a span has as many control points as its basis has functions")
}

pub(super) fn group_of<const N: usize, S>(
    groups: &[SpanGroup<N, S>],
    span: usize,
) -> (&SpanGroup<N, S>, &SpanPlace) {
    let group = &groups[span / SPANS_AT_ONCE];
    (group, &group.spans[span % SPANS_AT_ONCE])
}

impl<const N: usize, S: Sections> SpanGroup<N, S> {
    pub(super) fn side_by_side(spans: &[SpanOfPoints<N>]) -> Self {
        let (mut places, mut of_force, mut of_moment) = (Vec::new(), 0, 0);
        for span in spans {
            let force_points = of_force..of_force + span.force_points.len();
            let moment_points = of_moment..of_moment + span.moment_points.len();
            (of_force, of_moment) = (force_points.end, moment_points.end);
            places.push(SpanPlace { first: span.first, force_points, moment_points });
        }
        let force_points: Vec<(usize, &(ForcePoint<N>, Section))> = spans
            .iter()
            .flat_map(|span| span.force_points.iter().map(|point| (span.first, point)))
            .collect();
        let moment_points: Vec<(usize, &(MomentPoint<N>, Section))> = spans
            .iter()
            .flat_map(|span| span.moment_points.iter().map(|point| (span.first, point)))
            .collect();
        Self {
            spans: places,
            sections: S::new(
                force_points.iter().map(|(_, (_, section))| *section).collect(),
                moment_points.iter().map(|(_, (_, section))| *section).collect(),
            ),
            force_points: in_lanes(&force_points, &ForcePoint::EMPTY)
                .map(|(points, first)| ForcePoints::side_by_side(points, first))
                .collect(),
            moment_points: in_lanes(&moment_points, &MomentPoint::EMPTY)
                .map(|(points, first)| MomentPoints::side_by_side(points, first))
                .collect(),
        }
    }

    pub(super) fn control_points(&self) -> Range<usize> {
        self.spans[0].first..self.spans[self.spans.len() - 1].first + N
    }

    pub(super) fn begin_step(&mut self) {
        self.force_points.iter_mut().for_each(ForcePoints::begin_step);
        self.moment_points.iter_mut().for_each(MomentPoints::begin_step);
    }

    #[inline(always)]
    pub(super) fn correct_section_forces<V: Simd>(
        &mut self,
        simd: V,
        section: &Section,
        correction: &[Movement],
    ) {
        for (index, points) in self.force_points.iter_mut().enumerate() {
            let windows = points.windows(correction);
            for part in 0..LaneChunk::<V>::COUNT {
                let part = LaneChunk::new(simd, part);
                let stiffness = self.sections.force_stiffness(section, index, part);
                points.correct_section_forces(part, stiffness, &windows);
            }
        }
        for (index, points) in self.moment_points.iter_mut().enumerate() {
            let windows = points.windows(correction);
            for part in 0..LaneChunk::<V>::COUNT {
                let part = LaneChunk::new(simd, part);
                let stiffness = self.sections.bending_stiffness(section, index, part);
                points.correct_moments(part, stiffness, &windows);
            }
        }
    }

    #[inline(always)]
    pub(super) fn advance<V: Simd>(
        &mut self,
        simd: V,
        moved: &[Movement],
        rotations: RotationIncrement,
    ) {
        for points in &mut self.force_points {
            let windows = points.windows(moved);
            for part in 0..LaneChunk::<V>::COUNT {
                points.advance(LaneChunk::new(simd, part), &windows, rotations);
            }
        }
        for points in &mut self.moment_points {
            let windows = points.windows(moved);
            for part in 0..LaneChunk::<V>::COUNT {
                points.advance(LaneChunk::new(simd, part), &windows, rotations);
            }
        }
    }

    pub(super) fn force_points_of<'a>(
        &'a self,
        uniform: &'a Section,
        span: &SpanPlace,
    ) -> impl Iterator<Item = (ForcePoint<N>, &'a Section)> {
        (0..span.force_points.len()).map({
            let span = span.clone();
            move |point| self.force_point_of(uniform, &span, point)
        })
    }

    pub(super) fn moment_points_of<'a>(
        &'a self,
        uniform: &'a Section,
        span: &SpanPlace,
    ) -> impl Iterator<Item = (MomentPoint<N>, &'a Section)> {
        (0..span.moment_points.len()).map({
            let span = span.clone();
            move |point| self.moment_point_of(uniform, &span, point)
        })
    }

    pub(super) fn force_point_of<'a>(
        &'a self,
        uniform: &'a Section,
        span: &SpanPlace,
        point: usize,
    ) -> (ForcePoint<N>, &'a Section) {
        let index = span.force_points.start + point;
        (self.force_point(index), self.sections.of_force(uniform, index))
    }

    pub(super) fn moment_point_of<'a>(
        &'a self,
        uniform: &'a Section,
        span: &SpanPlace,
        point: usize,
    ) -> (MomentPoint<N>, &'a Section) {
        let index = span.moment_points.start + point;
        (self.moment_point(index), self.sections.of_moment(uniform, index))
    }

    fn force_point(&self, index: usize) -> ForcePoint<N> {
        self.force_points[index / LANES].point(index % LANES)
    }

    fn moment_point(&self, index: usize) -> MomentPoint<N> {
        self.moment_points[index / LANES].point(index % LANES)
    }

    pub(super) fn for_each_static_span(
        &self,
        section: &Section,
        rows: &mut SpanStiffness,
        take: &mut dyn FnMut(&SpanStiffness),
    ) {
        for span in &self.spans {
            rows.begin(span.first);
            for (point, section) in self.force_points_of(section, span) {
                point.write_static_rows(section, rows);
            }
            for (point, section) in self.moment_points_of(section, span) {
                point.write_static_rows(section, rows);
            }
            take(rows);
        }
    }

    pub(super) fn strain_energies_of_spans(&self, section: &Section) -> impl Iterator<Item = f64> {
        self.spans.iter().map(move |span| {
            let points = self.force_points_of(section, span);
            let force = points.map(|(point, section)| point.strain_energy(section)).sum::<f64>();
            force + self.bending_energy(section, span)
        })
    }

    fn bending_energy(&self, section: &Section, span: &SpanPlace) -> f64 {
        let points = self.moment_points_of(section, span);
        points.map(|(point, section)| point.strain_energy(section)).sum::<f64>()
    }

    pub(super) fn add_strain_energies(&self, section: &Section, sums: &mut [f64; 3]) {
        for span in &self.spans {
            for (point, section) in self.force_points_of(section, span) {
                let [axial, shear] = point.strain_energies(section);
                sums[0] += axial;
                sums[1] += shear;
            }
            sums[2] += self.bending_energy(section, span);
        }
    }

    pub(super) fn write_normals(&self, normals: &mut Vec<Vec2>) {
        let count = self.spans[self.spans.len() - 1].force_points.end;
        normals.extend((0..count).map(|index| self.force_point(index).normal()));
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        for span in &self.spans {
            span.force_points.clone().for_each(|index| self.force_point(index).save(state));
            span.moment_points.clone().for_each(|index| self.moment_point(index).save(state));
        }
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        for place in 0..self.spans.len() {
            let SpanPlace { force_points, moment_points, .. } = self.spans[place].clone();
            for index in force_points {
                let mut point = self.force_point(index);
                point.restore(std::array::from_fn(|_| next()));
                self.force_points[index / LANES].set(index % LANES, &point);
            }
            for index in moment_points {
                let mut point = self.moment_point(index);
                point.restore(std::array::from_fn(|_| next()));
                self.moment_points[index / LANES].set(index % LANES, &point);
            }
        }
    }
}

fn in_lanes<'a, P>(
    points: &'a [(usize, &'a (P, Section))],
    nowhere: &'a P,
) -> impl Iterator<Item = ([&'a P; LANES], [usize; LANES])> {
    points.chunks(LANES).map(move |points| {
        let (mut of_lanes, mut first) = ([nowhere; LANES], [points[0].0; LANES]);
        for (lane, (of_span, (point, _))) in points.iter().enumerate() {
            (of_lanes[lane], first[lane]) = (point, *of_span);
        }
        (of_lanes, first)
    })
}
