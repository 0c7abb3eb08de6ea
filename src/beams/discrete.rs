//! A beam on its mesh: the quadrature points of all spans, the control points and the inertia.

use pulp::{Arch, Simd, WithSimd};

use super::axis_point::AxisPoint;
use super::block::Block;
use super::dynamics::{BodyDynamics, Collocation, ForceSummary, Movement};
use super::force_point::ForcePoint;
use super::moment_point::MomentPoint;
use super::{BeamError, Mesh, RotationIncrement, Section};
use crate::geometry::{Basis, GaussRule, Span, Vec2};

/// The slowest an axis may run along its parameter, relative to its mean.
const STANDSTILL: f64 = 1e-9;

/// A beam whose basis has `N` non-zero functions on a span.
#[derive(Debug, Clone)]
struct DiscreteBeam<const N: usize> {
    section: Section,
    control_points: Vec<Vec2>,
    remainders: Vec<Vec2>,
    spans: Vec<SpanPoints<N>>,
    /// `∫ N_a N_{a+k} dX` for k = 0 … N-1 [length].
    gram: Vec<[f64; N]>,
}

#[derive(Debug, Clone)]
struct SpanPoints<const N: usize> {
    first: usize,
    force_points: Vec<ForcePoint<N>>,
    moment_points: Vec<MomentPoint<N>>,
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
    section: Section,
) -> Result<Box<dyn BodyDynamics>, BeamError> {
    Ok(match mesh.basis().degree() {
        1 => Box::new(DiscreteBeam::<2>::new(mesh, section, length, control_points)?),
        2 => Box::new(DiscreteBeam::<3>::new(mesh, section, length, control_points)?),
        3 => Box::new(DiscreteBeam::<4>::new(mesh, section, length, control_points)?),
        4 => Box::new(DiscreteBeam::<5>::new(mesh, section, length, control_points)?),
        5 => Box::new(DiscreteBeam::<6>::new(mesh, section, length, control_points)?),
        6 => Box::new(DiscreteBeam::<7>::new(mesh, section, length, control_points)?),
        7 => Box::new(DiscreteBeam::<8>::new(mesh, section, length, control_points)?),
        8 => Box::new(DiscreteBeam::<9>::new(mesh, section, length, control_points)?),
        9 => Box::new(DiscreteBeam::<10>::new(mesh, section, length, control_points)?),
        // Knot vectors refuse degrees above 10.
        _ => Box::new(DiscreteBeam::<11>::new(mesh, section, length, control_points)?),
    })
}

struct Axis<'a> {
    basis: &'a Basis,
    control_points: &'a [Vec2],
    /// Derivatives by the parameter below this are rounding, not a direction.
    standstill: f64,
}

impl Axis<'_> {
    /// The points of a rule on a span, with the unit tangents there.
    fn points<const N: usize>(
        &self,
        span: Span,
        rule: impl IntoIterator<Item = (f64, f64)>,
    ) -> Result<Vec<(AxisPoint<N>, Vec2)>, BeamError> {
        let place = |(xi, weight): (f64, f64)| {
            let values = self.basis.evaluate_in(&span, xi);
            let derivative = values.combine(1, self.control_points);
            let speed = derivative.norm();
            if speed.is_nan() || speed <= self.standstill {
                return Err(BeamError::NoTangent { parameter: xi });
            }
            let (mut shape, mut slope) = ([0.0; N], [0.0; N]);
            shape.copy_from_slice(values.values());
            slope.iter_mut().zip(values.slopes()).for_each(|(to, from)| *to = from / speed);
            Ok((AxisPoint { shape, slope, weight: weight * speed }, derivative / speed))
        };
        rule.into_iter().map(place).collect()
    }
}

impl<const N: usize> DiscreteBeam<N> {
    fn new(
        mesh: &Mesh,
        section: Section,
        length: f64,
        control_points: Vec<Vec2>,
    ) -> Result<Self, BeamError> {
        let (start, end) = mesh.basis().domain();
        let standstill = STANDSTILL * length / (end - start);
        let axis = Axis { basis: mesh.basis(), control_points: &control_points, standstill };
        let inertia_rule = mesh.inertia_rule()?;
        let mut gram = vec![[0.0; N]; control_points.len()];
        let mut spans = Vec::new();
        for (quadrature, force_rule) in mesh.quadrature_spans().into_iter().zip(mesh.force_rules()?)
        {
            let span = quadrature.span;
            let moment_rule = GaussRule::new(quadrature.moment_points)?;
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
            });
            for (at, _) in axis.points::<N>(span, inertia_rule.iter_on(span.start, span.end))? {
                for (a, row) in gram[span.first..span.first + N].iter_mut().enumerate() {
                    for (k, entry) in row[..N - a].iter_mut().enumerate() {
                        *entry += at.weight * at.shape[a] * at.shape[a + k];
                    }
                }
            }
        }
        let remainders = vec![Vec2::zeros(); control_points.len()];
        Ok(Self { section, control_points, remainders, spans, gram })
    }

    fn inertia_of(&self, entry: f64) -> Movement {
        let (mass, rotary) =
            (entry * self.section.mass_per_length, entry * self.section.rotary_inertia);
        [mass, mass, rotary]
    }
}

/// Moves a point, and keeps what rounding cuts off for the next time (compensated summation, Kahan 1965).
pub(super) fn move_compensated(point: &mut Vec2, remainder: &mut Vec2, [x, y, _]: &Movement) {
    let wanted = Vec2::new(*x, *y) + *remainder;
    let reached = *point + wanted;
    *remainder = wanted - (reached - *point);
    *point = reached;
}

/// The movements of the `N` control points from `first` on.
#[inline]
fn window<const N: usize>(movements: &[Movement], first: usize) -> &[Movement; N] {
    movements[first..]
        .first_chunk()
        .expect("a span has as many control points as its basis has functions")
}

#[inline]
fn window_mut<const N: usize>(movements: &mut [Movement], first: usize) -> &mut [Movement; N] {
    movements[first..]
        .first_chunk_mut()
        .expect("a span has as many control points as its basis has functions")
}

/// The work of [`add_linearised_forces`](BodyDynamics::add_linearised_forces).
struct Linearisation<'a, const N: usize> {
    beam: &'a mut DiscreteBeam<N>,
    at: Collocation,
    moved: &'a [Movement],
    weight: f64,
    forces: &'a mut [Movement],
    tangent: &'a mut dyn FnMut(usize, &[f64]),
}

impl<const N: usize> WithSimd for Linearisation<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { beam, at, moved, weight, forces, tangent } = self;
        let section = &beam.section;
        for span in &mut beam.spans {
            let (moved, forces) = (window(moved, span.first), window_mut(forces, span.first));
            let mut block = Block::zeros(simd);
            for point in &mut span.force_points {
                point.add_linearised_forces(section, at, moved, weight, forces, &mut block);
            }
            for point in &span.moment_points {
                point.add_linearised_forces(section, at, moved, weight, forces, &mut block);
            }
            tangent(span.first, block.entries());
        }
    }
}

impl<const N: usize> BodyDynamics for DiscreteBeam<N> {
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

    fn begin_step(&mut self) {
        for span in &mut self.spans {
            span.force_points.iter_mut().for_each(ForcePoint::begin_step);
        }
    }

    fn add_forces(
        &mut self,
        at: Collocation,
        moved: &[Movement],
        weight: f64,
        forces: &mut [Movement],
    ) -> ForceSummary {
        let mut summary = ForceSummary::default();
        for span in &mut self.spans {
            let (moved, forces) = (window(moved, span.first), window_mut(forces, span.first));
            for point in &mut span.force_points {
                point.add_forces(&self.section, at, moved, weight, forces, &mut summary);
            }
            for point in &span.moment_points {
                point.add_forces(&self.section, at, moved, weight, forces, &mut summary);
            }
        }
        summary
    }

    fn add_linearised_forces(
        &mut self,
        at: Collocation,
        moved: &[Movement],
        weight: f64,
        forces: &mut [Movement],
        tangent: &mut dyn FnMut(usize, &[f64]),
    ) {
        Arch::new().dispatch(Linearisation { beam: self, at, moved, weight, forces, tangent });
    }

    fn add_mismatch_forces(&self, weight: f64, forces: &mut [Movement]) {
        for span in &self.spans {
            let forces = window_mut(forces, span.first);
            span.force_points
                .iter()
                .for_each(|point| point.add_mismatch_forces(&self.section, weight, forces));
        }
    }

    fn correct_section_forces(&mut self, correction: &[Movement]) {
        for span in &mut self.spans {
            let correction = window(correction, span.first);
            span.force_points
                .iter_mut()
                .for_each(|point| point.correct_section_force(&self.section, correction));
        }
    }

    fn advance(&mut self, moved: &[Movement], rotations: RotationIncrement) {
        for ((point, remainder), movement) in
            self.control_points.iter_mut().zip(&mut self.remainders).zip(moved)
        {
            move_compensated(point, remainder, movement);
        }
        for span in &mut self.spans {
            let moved = window(moved, span.first);
            span.force_points.iter_mut().for_each(|point| point.advance(moved, rotations));
            span.moment_points.iter_mut().for_each(|point| point.advance(moved, rotations));
        }
    }

    fn add_inertia(&self, factor: f64, rates: &[Movement], forces: &mut [Movement]) {
        for (a, row) in self.gram.iter().enumerate() {
            for (b, entry) in (a..rates.len()).zip(row) {
                let inertia = self.inertia_of(factor * entry);
                for (component, inertia) in inertia.iter().enumerate() {
                    forces[a][component] += inertia * rates[b][component];
                    if b > a {
                        forces[b][component] += inertia * rates[a][component];
                    }
                }
            }
        }
    }

    fn add_inertia_tangent(&self, factor: f64, tangent: &mut dyn FnMut(usize, usize, Movement)) {
        for (a, row) in self.gram.iter().enumerate() {
            // Functions that share no span may stand far apart in the numbering of the tangent.
            let coupled = (a..self.gram.len()).zip(row).filter(|(_, entry)| **entry != 0.0);
            for (b, entry) in coupled {
                let inertia = self.inertia_of(factor * entry);
                tangent(a, b, inertia);
                if b > a {
                    tangent(b, a, inertia);
                }
            }
        }
    }

    fn write_normals(&self, normals: &mut Vec<Vec2>) {
        let points = self.spans.iter().flat_map(|span| &span.force_points);
        normals.extend(points.map(ForcePoint::normal));
    }

    fn strain_energy(&self) -> f64 {
        let of_span = |span: &SpanPoints<N>| -> f64 {
            let force = span
                .force_points
                .iter()
                .map(|point| point.strain_energy(&self.section))
                .sum::<f64>();
            let moment = span
                .moment_points
                .iter()
                .map(|point| point.strain_energy(&self.section))
                .sum::<f64>();
            force + moment
        };
        self.spans.iter().map(of_span).sum()
    }

    fn lumped_lengths(&self) -> Vec<f64> {
        let mut lengths = vec![0.0; self.gram.len()];
        for (a, row) in self.gram.iter().enumerate() {
            for (b, entry) in (a..self.gram.len()).zip(row) {
                lengths[a] += entry;
                if b > a {
                    lengths[b] += entry;
                }
            }
        }
        lengths
    }

    fn save(&self, state: &mut Vec<f64>) {
        for (point, remainder) in self.control_points.iter().zip(&self.remainders) {
            state.extend([point.x, point.y, remainder.x, remainder.y]);
        }
        for span in &self.spans {
            span.force_points.iter().for_each(|point| point.save(state));
            state.extend(span.moment_points.iter().map(MomentPoint::curvature));
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
            span.moment_points.iter_mut().for_each(|point| point.set_curvature(next()));
        }
    }
}
