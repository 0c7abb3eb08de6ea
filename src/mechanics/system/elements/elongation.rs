//! Elongations: the length of a polygonal path over several points, the angle between two sections, or a component of the vector between two points
//! (docs/theory.md, section 9.1).
//!
//! Forces act along secants, so the work of a step is exactly the force times the elongation change.
//! Positions are updated by increments, so their rounding error does not depend on the distance from the origin.
//! The growth of a length since the start is stored instead of the length. The growth may be smaller than the rounding error of the length.

mod shares;
mod term;

use std::ops::Range;

use self::shares::CoordinateShare;
pub(super) use self::term::ElongationTerm;
use self::term::RelativeTurn;
use super::coordinate::{Coordinate, rounding_error};
use super::rest_motion::RestMotion;
use super::{TrialState, collocation};
use crate::beams::{BodyPoint, Movement, RotationIncrement};
use crate::geometry::{Vec2, larger};
use crate::loads::LoadError;
use crate::system::bodies::Body;

/// End of an elongation: a point of a body, or the ground.
#[derive(Debug, Clone)]
pub enum ElongationEnd {
    Moving(BodyPoint),
    Ground,
}

impl ElongationEnd {
    fn order(&self) -> usize {
        match self {
            Self::Moving(place) => place.shape().len(),
            Self::Ground => 0,
        }
    }

    /// Interpolates a vector field that is given at control points; zero on the ground.
    pub fn combine(&self, of_point: impl Fn(usize, usize) -> Vec2) -> Vec2 {
        let Self::Moving(place) = self else { return Vec2::zeros() };
        place
            .weights()
            .fold(Vec2::zeros(), |sum, (point, share)| sum + of_point(place.body, point) * share)
    }
}

#[derive(Debug, Clone)]
enum Measure {
    Length(Vec<Vec2>),
    Angle,
    /// Component of the vector between two terminals: 0 for x, 1 for y.
    Component(usize),
}

/// Length, angle or component of the vector between the ends of a spring: its value at the start of a step, and its change in an iterate.
/// The increments on which an elongation depends are called its coordinates.
#[derive(Debug, Clone)]
pub struct Elongation {
    measure: Measure,
    terminals: Vec<ElongationEnd>,
    shares: Vec<CoordinateShare>,
    /// Elongation in the initial configuration of the meshed bodies [length, rad].
    initial: f64,
    growth: Coordinate,
    movements: Vec<f64>,
    corrected: Vec<f64>,
    /// Change of the elongation in the step, minus the change of a prescribed rest length [length, rad].
    pub change: f64,
    /// Prescribed rest length or rest angle; `None` if it is constant.
    pub rest: Option<Box<RestMotion>>,
    settled: (f64, f64),
    /// Secant [-]: vector whose scalar product with the increments of the ends in the step equals the elongation change.
    /// For methods with forces at the end of a step, `secant` is instead the derivative of the elongation at the end of the step.
    pub secant: Vec<f64>,
    /// Derivative of the elongation change with respect to the coordinates [-].
    pub slope: Vec<f64>,
    /// Derivative of the secant with respect to the coordinates, row by row [1/length, 1/rad].
    pub secant_slope: Vec<f64>,
    pub lag: Vec<f64>,
    pub lag_slope: Vec<f64>,
}

impl Elongation {
    pub fn path_length(terminals: Vec<ElongationEnd>, at: &[Vec2]) -> Self {
        let parts: Vec<Vec2> = at.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let length = parts.iter().map(Vec2::norm).sum();
        Self::new(Measure::Length(parts), length, terminals, 2)
    }

    pub fn component(
        terminals: [ElongationEnd; 2],
        [from, to]: [Vec2; 2],
        component: usize,
    ) -> Self {
        let start = (to - from)[component];
        Self::new(Measure::Component(component), start, terminals.into(), 2)
    }

    /// Creates the angle from the first terminal to the second terminal, with its initial value [rad].
    pub fn angle(terminals: [ElongationEnd; 2], angle: f64) -> Self {
        Self::new(Measure::Angle, angle, terminals.into(), 1)
    }

    fn new(
        measure: Measure,
        initial: f64,
        terminals: Vec<ElongationEnd>,
        components: usize,
    ) -> Self {
        let coordinates = components * terminals.len();
        Self {
            measure,
            shares: Vec::with_capacity(terminals.iter().map(|of| components * of.order()).sum()),
            terminals,
            initial,
            growth: Coordinate::default(),
            movements: vec![0.0; coordinates],
            corrected: vec![0.0; coordinates],
            change: 0.0,
            rest: None,
            settled: (0.0, 0.0),
            secant: vec![0.0; coordinates],
            slope: vec![0.0; coordinates],
            secant_slope: vec![0.0; coordinates * coordinates],
            lag: vec![0.0; coordinates],
            lag_slope: vec![0.0; coordinates * coordinates],
        }
    }

    pub fn is_angle(&self) -> bool {
        matches!(self.measure, Measure::Angle)
    }

    /// Elongation at the start of the step [length, rad].
    pub fn value(&self) -> f64 {
        let rest = self.rest.as_ref().map_or(0.0, |rest| rest.growth().value);
        self.initial + self.growth.value + rest
    }

    /// Elongation in the initial configuration of the meshed bodies [length, rad].
    pub fn drawn(&self) -> f64 {
        self.initial
    }

    /// Change of the elongation since the start, minus the change of a prescribed rest length [length, rad].
    pub fn grown(&self) -> Coordinate {
        self.growth
    }

    pub fn extent(&self) -> f64 {
        let after = (self.value() + self.change).abs();
        match self.measure {
            Measure::Length(_) => after,
            Measure::Angle => larger(1.0, after),
            Measure::Component(..) => {
                self.movements.iter().fold(after, |size, by| size.max(by.abs()))
            }
        }
    }

    /// Largest magnitude of the increments from which the elongation change is computed [length, rad].
    pub fn moved(&self) -> f64 {
        let rest = self.rest.as_ref().map_or(0.0, |rest| rest.increment().abs());
        self.movements.iter().fold(rest, |most, by| larger(most, by.abs()))
    }

    /// Largest rounding error of the elongation change [length, rad].
    fn rounding(&self) -> f64 {
        rounding_error(self.moved())
    }

    pub fn absorb_rounding(&mut self, missing: f64) -> bool {
        let is_rounding = missing.abs() <= self.rounding();
        self.settled = (self.change, if is_rounding { missing } else { 0.0 });
        is_rounding
    }

    pub fn is_component(&self) -> bool {
        matches!(self.measure, Measure::Component(..))
    }

    pub fn components(&self) -> Range<usize> {
        match self.measure {
            Measure::Length(_) | Measure::Component(..) => 0..2,
            Measure::Angle => 2..3,
        }
    }

    pub fn moving(&self) -> impl Iterator<Item = (&BodyPoint, Range<usize>)> {
        let count = self.components().len();
        self.terminals.iter().enumerate().filter_map(move |(at, terminal)| match terminal {
            ElongationEnd::Moving(place) => Some((place, at * count..(at + 1) * count)),
            ElongationEnd::Ground => None,
        })
    }

    pub fn evaluate(&mut self, at: TrialState<'_>) {
        self.locate(at.bodies);
        self.gather(at.increments);
        let collocation = collocation(at.stage);
        self.compare(collocation.rotations);
    }

    pub fn balance(&mut self, share: Option<f64>) {
        let Self { measure, movements: moved, lag, lag_slope: lag_bend, .. } = self;
        [&mut *lag, lag_bend].into_iter().for_each(|all| all.fill(0.0));
        let (Measure::Length(parts), Some(share)) = (measure, share) else { return };
        let width = moved.len();
        for (part, start) in parts.iter().enumerate() {
            let ends = [2 * part, 2 * part + 2];
            let [from, to] = ends.map(|at| Vec2::new(moved[at], moved[at + 1]));
            let at_end = ElongationTerm::new(*start, to - from, RotationIncrement::Angle);
            let within = ElongationTerm::new(*start, (to - from) * share, RotationIncrement::Angle);
            for (row, sign) in ends.into_iter().zip([-1.0, 1.0]) {
                for component in 0..2 {
                    lag[row + component] +=
                        sign * (within.secant[component] - at_end.secant[component]);
                    for (column, other) in ends.into_iter().zip([-1.0, 1.0]) {
                        let at = (row + component) * width + column;
                        for by in 0..2 {
                            let bend =
                                share * within.bend(component, by) - at_end.bend(component, by);
                            lag_bend[at + by] += sign * other * bend;
                        }
                    }
                }
            }
        }
    }

    /// Rate of the prescribed rest length or rest angle at the start of the step; zero without one [length/time, rad/time].
    fn rest_rate(&self) -> f64 {
        self.rest.as_ref().map_or(0.0, |rest| rest.rate())
    }

    /// Sets a prescribed rest length or rest angle to its value at a time, without work.
    ///
    /// # Errors
    /// Fails if the function of time has no finite value.
    pub fn set_rest_at(&mut self, time: f64) -> Result<(), LoadError> {
        let Some(rest) = &mut self.rest else { return Ok(()) };
        let before = rest.growth().value;
        rest.set_at(time)?;
        self.growth = self.growth.after(before - rest.growth().value);
        Ok(())
    }

    pub fn rate(&self, rates: &[Vec<Movement>]) -> f64 {
        let mut sum = -self.rest_rate();
        for (place, coordinates) in self.moving() {
            let rates = &rates[place.body];
            for (component, slope) in self.components().zip(&self.slope[coordinates]) {
                let shares = place.weights().map(|(point, share)| share * rates[point][component]);
                sum += slope * shares.fold(0.0, |sum, rate| sum + rate);
            }
        }
        sum
    }

    pub fn rate_at_last_end(&self, bodies: &[Body], rates: &[f64]) -> f64 {
        self.moving().fold(-self.rest_rate(), |sum, (place, coordinates)| {
            let [x, y, spin] = bodies[place.body].at(place, rates);
            match (self.is_angle(), &self.slope[coordinates]) {
                (true, slope) => sum + slope[0].signum() * spin,
                (false, slope) => sum + (slope[0] * x + slope[1] * y),
            }
        })
    }

    fn compare(&mut self, rotations: RotationIncrement) {
        let Self { measure, movements: moved, change, secant, slope, secant_slope: bend, .. } =
            self;
        match measure {
            Measure::Length(parts) => {
                *change = 0.0;
                [&mut *secant, slope].into_iter().for_each(|all| all.fill(0.0));
                let (secants, _) = secant.as_chunks_mut::<2>();
                let (slopes, _) = slope.as_chunks_mut::<2>();
                let ways = moved.as_chunks().0.windows(2).map(path_length);
                for (at, (start, way)) in parts.iter().zip(ways).enumerate() {
                    let part = ElongationTerm::new(*start, way, rotations);
                    *change += part.change;
                    for component in 0..2 {
                        secants[at][component] -= part.secant[component];
                        secants[at + 1][component] += part.secant[component];
                        slopes[at][component] -= part.slope[component];
                        slopes[at + 1][component] += part.slope[component];
                    }
                }
            }
            Measure::Component(component) => {
                let [from, to] = [*component, 2 + *component];
                *change = moved[to] - moved[from];
                for row in [secant, slope] {
                    row.fill(0.0);
                    [row[from], row[to]] = [-1.0, 1.0];
                }
            }
            Measure::Angle => {
                let [a, b] = [moved[0], moved[1]];
                let turn = RelativeTurn::new(a, b, rotations);
                *change = turn.ratio * (b - a);
                secant.copy_from_slice(&[-turn.ratio, turn.ratio]);
                slope.copy_from_slice(&[-rotations.rate(a), rotations.rate(b)]);
                let [by_a, by_b] = turn.derivatives;
                bend.copy_from_slice(&[-by_a, -by_b, by_a, by_b]);
            }
        }
        if let Some(rest) = &self.rest {
            self.change -= rest.increment();
        }
    }

    pub fn find_bend(&mut self, rotations: RotationIncrement) {
        let Self { measure, movements: moved, secant_slope: bend, .. } = self;
        let Measure::Length(parts) = measure else { return };
        let width = moved.len();
        bend.fill(0.0);
        let ways = moved.as_chunks().0.windows(2).map(path_length);
        for (at, (start, way)) in parts.iter().zip(ways).enumerate() {
            let (part, ends) = (ElongationTerm::new(*start, way, rotations), [2 * at, 2 * at + 2]);
            for component in 0..2 {
                let bends = [part.bend(component, 0), part.bend(component, 1)];
                for (row, sign) in ends.into_iter().zip([-1.0, 1.0]) {
                    for (column, other) in ends.into_iter().zip([-1.0, 1.0]) {
                        let at = (row + component) * width + column;
                        let entries = bend[at..at + 2].iter_mut().zip(bends);
                        entries.for_each(|(entry, by)| *entry += sign * other * by);
                    }
                }
            }
        }
    }

    /// Writes the derivative of a force along the elongation with respect to the coordinates, row by row.
    /// The force has the given value and the given derivative with respect to the elongation change.
    pub fn write_tangent(&self, force: f64, stiffness: f64, out: &mut [f64]) {
        let width = self.slope.len();
        let rows = out.chunks_exact_mut(width).zip(&self.secant);
        for ((row, secant), bend) in rows.zip(self.secant_slope.chunks_exact(width)) {
            for ((entry, slope), bend) in row.iter_mut().zip(&self.slope).zip(bend) {
                *entry = stiffness * secant * slope + force * bend;
            }
        }
    }

    pub fn advance(&mut self, bodies: &[Body], rotations: RotationIncrement) {
        let components = self.components();
        let terminals = self.movements.chunks_exact_mut(components.len()).zip(&self.terminals);
        for (own, terminal) in terminals {
            own.fill(0.0);
            let ElongationEnd::Moving(place) = terminal else { continue };
            for (point, share) in place.weights() {
                let moved = &bodies[place.body].moved()[point][components.clone()];
                own.iter_mut().zip(moved).for_each(|(sum, moved)| *sum += share * moved);
            }
        }
        self.compare(rotations);
        let (change, missing) = self.settled;
        let is_settled = (change - self.change).abs() <= self.rounding();
        self.growth = match is_settled {
            true => self.growth.after(change).after(missing),
            false => self.growth.after(self.change),
        };
        if let Measure::Length(parts) = &mut self.measure {
            for (part, ends) in parts.iter_mut().zip(self.movements.windows(4).step_by(2)) {
                *part += Vec2::new(ends[2] - ends[0], ends[3] - ends[1]);
            }
        }
    }

    pub fn turned(&self) -> Vec<(f64, Vec<f64>)> {
        let Measure::Length(parts) = &self.measure else { return Vec::new() };
        let of_part = |(index, part): (usize, &Vec2)| {
            let length = part.norm();
            let normal = Vec2::new(-part.y, part.x) / length;
            let mut row = vec![0.0; self.movements.len()];
            row[2 * index..2 * index + 4]
                .copy_from_slice(&[-normal.x, -normal.y, normal.x, normal.y]);
            (length, row)
        };
        parts.iter().enumerate().filter(|(_, part)| part.norm() > 0.0).map(of_part).collect()
    }

    pub fn evaluate_at_start(&mut self, bodies: &[Body]) {
        self.locate(bodies);
        self.movements.fill(0.0);
        self.compare(RotationIncrement::Angle);
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.growth.value, self.growth.rest]);
        self.rest.iter().for_each(|rest| rest.save(state));
        if let Measure::Length(parts) = &self.measure {
            state.extend(parts.iter().flat_map(|part| [part.x, part.y]));
        }
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.growth = Coordinate { value: next(), rest: next() };
        self.rest.iter_mut().for_each(|rest| rest.restore(next));
        if let Measure::Length(parts) = &mut self.measure {
            parts.iter_mut().for_each(|part| *part = Vec2::new(next(), next()));
        }
    }
}

fn path_length(ends: &[[f64; 2]]) -> Vec2 {
    Vec2::new(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1])
}
