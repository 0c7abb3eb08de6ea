//! Body of a model: its dynamics and its degrees of freedom.

use std::iter::once;
use std::ops::Range;

use super::places::{Places, rows_of_parts};
use super::{DegreesOfFreedom, Momenta};
use crate::beams::{
    BlockSink, BodyDynamics, BodyPoint, Collocation, ForceSummary, Movement, RotationIncrement,
};
use crate::geometry::{Vec2, cross};
use crate::linalg::BandRows;
use crate::threads::run_concurrently;

pub struct Body {
    pub dynamics: Box<dyn BodyDynamics>,
    pub degrees_of_freedom: DegreesOfFreedom,
    consecutive: Vec<Option<usize>>,
    in_order: Vec<bool>,
    unknowns: usize,
    parts: Vec<(usize, usize)>,
    movements: Vec<Movement>,
    forces: Vec<Movement>,
    summary: ForceSummary,
}

impl Body {
    pub fn new(
        dynamics: Box<dyn BodyDynamics>,
        degrees_of_freedom: Vec<[usize; 3]>,
        unknowns: usize,
    ) -> Self {
        let zeros = vec![[0.0; 3]; degrees_of_freedom.len()];
        let mut body = Self {
            dynamics,
            degrees_of_freedom: DegreesOfFreedom::default(),
            consecutive: Vec::new(),
            in_order: Vec::new(),
            unknowns,
            parts: Vec::new(),
            movements: zeros.clone(),
            forces: zeros,
            summary: ForceSummary::default(),
        };
        body.renumber(degrees_of_freedom, unknowns);
        body
    }

    pub fn renumber(&mut self, degrees_of_freedom: Vec<[usize; 3]>, unknowns: usize) {
        let order = self.dynamics.order();
        let are_consecutive = |points: Range<usize>| {
            let points = degrees_of_freedom[points].as_flattened();
            let steps = points.windows(2).all(|pair| pair[1] == pair[0] + 1);
            (steps && points.iter().all(|&at| at < unknowns)).then(|| points[0])
        };
        let count = degrees_of_freedom.len();
        let mut consecutive = vec![None; count];
        for first in self.dynamics.span_starts() {
            consecutive[first] = are_consecutive(first..first + order);
        }
        let neighbours = |point: usize| (point + 1).saturating_sub(order)..count.min(point + order);
        let in_order = (0..count).map(|point| are_consecutive(neighbours(point)).is_some());
        self.in_order = in_order.collect();
        (self.degrees_of_freedom, self.unknowns) = (degrees_of_freedom.into(), unknowns);
        self.consecutive = consecutive;
        if !self.parts.is_empty() {
            self.divide(self.parts.len() + 1);
        }
    }

    pub fn divide(&mut self, most: usize) -> usize {
        let points = self.dynamics.divide(most);
        let rows_of = |points: &[[usize; 3]]| {
            let rows = points.as_flattened().iter().filter(|row| **row < self.unknowns);
            Some((*rows.clone().min()?, *rows.max()?))
        };
        let first_row = |&point: &usize| {
            let (before, behind) = self.degrees_of_freedom.split_at(point);
            let ((_, last), (first, _)) = (rows_of(before)?, rows_of(behind)?);
            (last < first).then_some((point, first))
        };
        self.parts = points.iter().map(first_row).collect::<Option<_>>().unwrap_or_else(|| {
            self.dynamics.divide(1);
            Vec::new()
        });
        self.parts.len() + 1
    }

    pub fn is_divided(&self) -> bool {
        !self.parts.is_empty()
    }

    pub fn points(&self) -> usize {
        self.degrees_of_freedom.len()
    }

    fn rows(&self) -> impl Iterator<Item = usize> {
        let rows = self.degrees_of_freedom.as_flattened().iter().copied();
        rows.filter(|row| *row < self.unknowns)
    }

    pub fn first_row(&self) -> Option<usize> {
        self.rows().min()
    }

    pub fn last_row(&self) -> Option<usize> {
        self.rows().max()
    }

    pub fn gather(&mut self, values: &[f64]) -> &[Movement] {
        self.degrees_of_freedom.gather(values, &mut self.movements);
        &self.movements
    }

    /// Returns values of the degrees of freedom by control point; zero for degrees of freedom that `values` does not contain.
    pub fn by_control_point(&self, values: &[f64]) -> impl Iterator<Item = Movement> {
        let value = |at: usize| values.get(at).copied().unwrap_or(0.0);
        self.degrees_of_freedom.iter().map(move |degrees| degrees.map(value))
    }

    pub fn at(&self, place: &BodyPoint, values: &[f64]) -> Movement {
        let mut sum = [0.0; 3];
        for (point, weight) in place.weights() {
            for (sum, &at) in sum.iter_mut().zip(&self.degrees_of_freedom[point]) {
                *sum += weight * values.get(at).copied().unwrap_or(0.0);
            }
        }
        sum
    }

    pub fn vector_at(&self, point: usize, values: &[f64]) -> Vec2 {
        let [x, y, _] = self.degrees_of_freedom[point];
        let value = |at: usize| values.get(at).copied().unwrap_or(0.0);
        Vec2::new(value(x), value(y))
    }

    pub fn precise_point(&self, point: usize) -> (Vec2, Vec2) {
        (self.dynamics.control_points()[point], self.dynamics.remainders()[point])
    }

    pub fn moved(&self) -> &[Movement] {
        &self.movements
    }

    pub fn advance(&mut self, rotations: RotationIncrement) {
        self.dynamics.advance(&self.movements, rotations);
    }

    pub fn scatter(&mut self, out: &mut [f64]) -> ForceSummary {
        self.degrees_of_freedom.scatter(&mut self.forces, out);
        std::mem::take(&mut self.summary)
    }

    pub fn clear_forces(&mut self) {
        self.forces.fill(Movement::default());
    }

    pub fn add_section_forces(&mut self, at: Collocation, increments: &[f64], weight: f64) {
        self.gather(increments);
        self.summary = self.dynamics.add_forces(at, &self.movements, weight, &mut self.forces);
    }

    pub fn linearise(
        &mut self,
        at: Collocation,
        increments: &[f64],
        weight: f64,
        mut rows: BandRows<'_>,
    ) {
        self.gather(increments);
        let Self {
            dynamics,
            degrees_of_freedom,
            consecutive,
            movements: moved,
            forces,
            parts,
            unknowns,
            ..
        } = self;
        let (order, unknowns) = (dynamics.order(), *unknowns);
        let places = Places { degrees_of_freedom, consecutive, order, unknowns };
        let mut add = |tangents: &mut [BlockSink<'_>]| {
            dynamics.add_linearised_forces(at, moved, weight, forces, tangents);
        };
        if parts.is_empty() {
            add(&mut [&mut |first, block| places.add_block(&mut rows, first, block)]);
        } else {
            let mut sinks: Vec<_> = rows_of_parts(parts, rows)
                .map(|mut rows| {
                    let places = &places;
                    move |first: usize, block: &[f64]| places.add_block(&mut rows, first, block)
                })
                .collect();
            let mut sinks: Vec<BlockSink<'_>> = sinks.iter_mut().map(|sink| sink as _).collect();
            add(&mut sinks);
        }
    }

    pub fn add_mismatch_forces(&mut self, weight: f64) {
        self.dynamics.add_mismatch_forces(weight, &mut self.forces);
    }

    pub fn correct_section_forces(&mut self, correction: &[f64]) {
        self.gather(correction);
        self.dynamics.correct_section_forces(&self.movements);
    }

    pub fn add_inertia_forces(&mut self, factor: f64, rates: &[f64]) {
        self.gather(rates);
        self.dynamics.add_inertia(factor, &self.movements, &mut self.forces);
    }

    /// Calls `add` with the row, column and value of each entry of `factor · M`, where `M` is the mass matrix of the body.
    /// The caller must add up values for the same row and column.
    pub fn inertia_entries(&self, factor: f64, add: &mut impl FnMut(usize, usize, f64)) {
        self.inertia_entries_of(0..self.degrees_of_freedom.len(), factor, add);
    }

    fn inertia_entries_of(
        &self,
        points: Range<usize>,
        factor: f64,
        add: &mut impl FnMut(usize, usize, f64),
    ) {
        self.dynamics.add_inertia_tangent(factor, points, &mut |point, first, inertia| {
            self.entries_of(point, first, inertia, add);
        });
    }

    fn entries_of(
        &self,
        point: usize,
        first: usize,
        inertia: &[Movement],
        add: &mut impl FnMut(usize, usize, f64),
    ) {
        let rows = &self.degrees_of_freedom[point];
        for (columns, inertia) in self.degrees_of_freedom[first..].iter().zip(inertia) {
            // Zero entries are omitted. If two control points have no common span, the entry may lie outside the band of the tangent.
            if *inertia == Movement::default() {
                continue;
            }
            for ((&row, &column), value) in rows.iter().zip(columns).zip(inertia) {
                if row < self.unknowns && column < self.unknowns {
                    add(row, column, *value);
                }
            }
        }
    }

    pub fn add_inertia_tangent(&self, factor: f64, rows: BandRows<'_>) {
        let add = |points: Range<usize>, mut rows: BandRows<'_>| {
            let at_hand = rows.rows();
            let mut end = points.start;
            for run in self.in_order[points].chunk_by(|a, b| a == b) {
                let points = end..end + run.len();
                end = points.end;
                let place = |point: usize| self.degrees_of_freedom[point][0];
                let (first, last) = (place(points.start), place(points.end - 1) + 3);
                if run[0] && at_hand.start <= first && last <= at_hand.end {
                    let mut add = |point: usize, offset: isize, entries: &[f64]| {
                        rows.add_to_diagonal(
                            first + 3 * (point - points.start),
                            3 * offset,
                            entries,
                        );
                    };
                    self.dynamics.each_inertia_diagonal(factor, points.clone(), &mut add);
                } else {
                    self.inertia_entries_of(points, factor, &mut |row, column, value| {
                        if at_hand.contains(&row) {
                            rows.add(row, column, value);
                        }
                    });
                }
            }
        };
        let points = self.degrees_of_freedom.len();
        if self.parts.is_empty() {
            return add(0..points, rows);
        }
        let starts = once(0).chain(self.parts.iter().map(|(point, _)| *point));
        let ends = self.parts.iter().map(|(point, _)| *point).chain(once(points));
        let points = starts.zip(ends).map(|(start, end)| start..end);
        run_concurrently(points.zip(rows_of_parts(&self.parts, rows)), |(points, rows)| {
            add(points, rows);
        });
    }

    pub fn momenta(&mut self, rates: &[f64]) -> Momenta {
        self.gather(rates);
        self.dynamics.add_inertia(1.0, &self.movements, &mut self.forces);
        let mut sum = Momenta::default();
        let points = self.dynamics.control_points();
        for ((part, rate), point) in self.forces.iter_mut().zip(&self.movements).zip(points) {
            let [px, py, spin] = std::mem::take(part);
            let linear = Vec2::new(px, py);
            let twice_kinetic = px * rate[0] + py * rate[1] + spin * rate[2];
            sum += Momenta { twice_kinetic, linear, angular: cross(*point, linear) + spin };
        }
        sum
    }
}
