//! A body of the model: its dynamics, and where its movements stand among the degrees of freedom.

use std::iter::once;
use std::ops::Range;

use super::places::{Places, rows_of_parts};
use super::{DegreesOfFreedom, Momenta};
use crate::beams::{
    BlockSink, BodyDynamics, BodyPoint, Collocation, ForceSummary, Movement, RotationIncrement,
};
use crate::geometry::{Vec2, cross};
use crate::linalg::BandRows;
use crate::threads::at_once;

/// A beam or a particle with the places of its movements in the vectors of the mechanism.
pub struct Body {
    pub dynamics: Box<dyn BodyDynamics>,
    pub degrees_of_freedom: DegreesOfFreedom,
    /// For each span that moves consecutive unknowns only: the first of them.
    consecutive: Vec<Option<usize>>,
    /// For each control point whether all that share a span with it move consecutive unknowns.
    in_order: Vec<bool>,
    unknowns: usize,
    /// The first control point and the first row of each part that is worked on at the same time, but for the first part.
    parts: Vec<(usize, usize)>,
    moved: Vec<Movement>,
    /// What was added up, and not handed on yet.
    forces: Vec<Movement>,
    /// What was met meanwhile.
    met: ForceSummary,
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
            moved: zeros.clone(),
            forces: zeros,
            met: ForceSummary::default(),
        };
        body.renumber(degrees_of_freedom, unknowns);
        body
    }

    /// Gives the movements of the body's control points other places among the degrees of freedom, of which so many are unknown.
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

    /// Lets the body work in at most so many parts at once from here on, with the same results: in one, where it is not large, or the
    /// rows of its parts do not stand one part after another. Gives the number of parts.
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

    /// Whether the body works in several parts at once.
    pub fn is_divided(&self) -> bool {
        !self.parts.is_empty()
    }

    /// The number of control points of this body.
    pub fn points(&self) -> usize {
        self.degrees_of_freedom.len()
    }

    fn rows(&self) -> impl Iterator<Item = usize> {
        let rows = self.degrees_of_freedom.as_flattened().iter().copied();
        rows.filter(|row| *row < self.unknowns)
    }

    /// The first of the unknowns of this body.
    pub fn first_row(&self) -> Option<usize> {
        self.rows().min()
    }

    /// The last of the unknowns of this body.
    pub fn last_row(&self) -> Option<usize> {
        self.rows().max()
    }

    /// Gathers the values of the unknowns at this body, by control point; supported movements are zero.
    pub fn gather(&mut self, values: &[f64]) -> &[Movement] {
        self.degrees_of_freedom.gather(values, &mut self.moved);
        &self.moved
    }

    /// The values of the unknowns at the control points of this body; supported movements are zero.
    pub fn by_control_point(&self, values: &[f64]) -> impl Iterator<Item = Movement> {
        let value = |at: usize| values.get(at).copied().unwrap_or(0.0);
        self.degrees_of_freedom.iter().map(move |degrees| degrees.map(value))
    }

    /// The movement of a place of this body [length, length, rad], from values of the unknowns.
    pub fn at(&self, place: &BodyPoint, values: &[f64]) -> Movement {
        let mut sum = [0.0; 3];
        for (point, share) in place.weights() {
            for (sum, &at) in sum.iter_mut().zip(&self.degrees_of_freedom[point]) {
                *sum += share * values.get(at).copied().unwrap_or(0.0);
            }
        }
        sum
    }

    /// The x and y components of a control point of this body, from values of the unknowns.
    pub fn vector_at(&self, point: usize, values: &[f64]) -> Vec2 {
        let [x, y, _] = self.degrees_of_freedom[point];
        let value = |at: usize| values.get(at).copied().unwrap_or(0.0);
        Vec2::new(value(x), value(y))
    }

    /// The place of a control point of this body, and what rounding has cut off it so far [length].
    pub fn precise_point(&self, point: usize) -> (Vec2, Vec2) {
        (self.dynamics.control_points()[point], self.dynamics.remainders()[point])
    }

    /// The movements of the control points of this body that were gathered last.
    pub fn moved(&self) -> &[Movement] {
        &self.moved
    }

    /// Lets the body accept the movements that were gathered last.
    pub fn advance(&mut self, rotations: RotationIncrement) {
        self.dynamics.advance(&self.moved, rotations);
    }

    /// Hands the forces that were added up on to `out`, and what was met meanwhile.
    pub fn hand_on(&mut self, out: &mut [f64]) -> ForceSummary {
        self.degrees_of_freedom.hand_on(&mut self.forces, out);
        std::mem::take(&mut self.met)
    }

    /// Forgets the forces that were added up.
    pub fn forget_forces(&mut self) {
        self.forces.fill(Movement::default());
    }

    /// Adds up the internal forces of this body, to be handed on.
    pub fn meet_forces(&mut self, at: Collocation, increments: &[f64], weight: f64) {
        self.gather(increments);
        self.met = self.dynamics.add_forces(at, &self.moved, weight, &mut self.forces);
    }

    /// Adds up the condensed internal forces of this body, to be handed on, and adds their derivatives to the rows of the tangent that are at hand.
    pub fn linearise(
        &mut self,
        at: Collocation,
        increments: &[f64],
        weight: f64,
        mut rows: BandRows<'_>,
    ) {
        self.gather(increments);
        let Self {
            dynamics, degrees_of_freedom, consecutive, moved, forces, parts, unknowns, ..
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

    /// Adds up the forces that would close the strain mismatch of this body, to be handed on.
    pub fn meet_mismatch(&mut self, weight: f64) {
        self.dynamics.add_mismatch_forces(weight, &mut self.forces);
    }

    pub fn correct_section_forces(&mut self, correction: &[f64]) {
        self.gather(correction);
        self.dynamics.correct_section_forces(&self.moved);
    }

    /// Adds up `factor · M · rates` of this body, to be handed on.
    pub fn meet_inertia(&mut self, factor: f64, rates: &[f64]) {
        self.gather(rates);
        self.dynamics.add_inertia(factor, &self.moved, &mut self.forces);
    }

    /// Gives the entries of `factor · M` of this body to `add`: row, column and value; several of one place add up.
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

    /// Gives the entries of a row of control points in the inertia to `add`: row, column and value.
    fn entries_of(
        &self,
        point: usize,
        first: usize,
        inertia: &[Movement],
        add: &mut impl FnMut(usize, usize, f64),
    ) {
        let rows = &self.degrees_of_freedom[point];
        for (columns, inertia) in self.degrees_of_freedom[first..].iter().zip(inertia) {
            // Functions that share no span may stand far apart in the numbering of the tangent.
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

    /// Adds `factor · M` of this body to the rows of the tangent that are at hand.
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
        at_once(points.zip(rows_of_parts(&self.parts, rows)), |(points, rows)| {
            add(points, rows);
        });
    }

    /// Momenta and twice the kinetic energy of this body, from the rates of the unknowns.
    pub fn momenta(&mut self, rates: &[f64]) -> Momenta {
        self.gather(rates);
        self.dynamics.add_inertia(1.0, &self.moved, &mut self.forces);
        let mut sum = Momenta::default();
        let points = self.dynamics.control_points();
        for ((part, rate), point) in self.forces.iter_mut().zip(&self.moved).zip(points) {
            let [px, py, spin] = std::mem::take(part);
            let linear = Vec2::new(px, py);
            let twice_kinetic = px * rate[0] + py * rate[1] + spin * rate[2];
            sum += Momenta { twice_kinetic, linear, angular: cross(*point, linear) + spin };
        }
        sum
    }
}
