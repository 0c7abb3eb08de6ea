//! Kelvin–Voigt dashpots at the quadrature points of a beam, parallel to its elasticity (docs/theory.md, section 9.2).

use serde::{Deserialize, Serialize};

use super::dynamics::{ForceSummary, Movement};
use super::force_dashpot::ForceDashpot;
use super::moment_dashpot::MomentDashpot;
use super::present_rates::{RateMismatch, RateResolution};
use super::sections::SectionsOnAxis;
use super::{BeamError, Mesh, RotationIncrement, Section, SectionPlace, SectionVariation};
use crate::geometry::{Vec2, larger};

/// Relaxation times of a Kelvin–Voigt material. A viscous section force is relaxation time times stiffness times strain rate.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Relaxation {
    /// Relaxation time of axial deformation [time].
    pub axial: f64,
    /// Relaxation time of shear [time].
    pub shear: f64,
    /// Relaxation time of bending [time].
    pub bending: f64,
}

impl Relaxation {
    pub(crate) const ALLOWED: &'static str = "zero or a positive finite number [time]";

    /// Checks that all relaxation times are finite and not negative.
    ///
    /// # Errors
    /// Returns the name and the value of the first invalid relaxation time.
    pub fn validated(&self) -> Result<(), (&'static str, f64)> {
        let times = [("axial", self.axial), ("shear", self.shear), ("bending", self.bending)];
        match times.into_iter().find(|(_, time)| !(time.is_finite() && *time >= 0.0)) {
            Some(wrong) => Err(wrong),
            None => Ok(()),
        }
    }
}

/// Rule for the time derivative (rate) of a quantity in a step: `by_change` times its change in the step, minus `by_last` times its rate in the last step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateCollocation {
    /// Fraction of the step, from its start, at which the directions and lever arms of the dashpot forces are evaluated [-].
    pub fraction: f64,
    /// Factor of the change in the step, in the formula for the rate of the step [1/time].
    pub by_change: f64,
    /// Factor of the rate of the last step, in the formula for the rate of the step [-].
    pub by_last: f64,
    /// Type of rotation increments.
    pub rotations: RotationIncrement,
}

#[derive(Debug, Clone)]
pub(super) struct Functions {
    pub(super) shape: Vec<f64>,
    pub(super) slope: Vec<f64>,
    pub(super) weight: f64,
}

impl Functions {
    pub(super) fn interpolate(&self, moved: &[Movement]) -> (Vec2, f64, f64) {
        let (mut gradient, mut rotation, mut bend) = (Vec2::zeros(), 0.0, 0.0);
        for ((shape, slope), [x, y, omega]) in self.shape.iter().zip(&self.slope).zip(moved) {
            gradient += Vec2::new(slope * x, slope * y);
            rotation += shape * omega;
            bend += slope * omega;
        }
        (gradient, rotation, bend)
    }
}

#[derive(Debug, Clone)]
struct SpanDashpots {
    first: usize,
    forces: Vec<ForceDashpot>,
    moments: Vec<MomentDashpot>,
}

/// Dashpots of a beam at its quadrature points.
#[derive(Debug, Clone)]
pub struct Dashpots {
    order: usize,
    spans: Vec<SpanDashpots>,
    resolution: RateResolution,
    block: Vec<f64>,
}

impl Dashpots {
    /// Creates the dashpots of a beam with the given control points and zero rates.
    ///
    /// # Errors
    /// Fails if the mesh has no quadrature.
    pub fn new(
        mesh: &Mesh,
        control_points: &[Vec2],
        variation: &SectionVariation,
        relaxation: Relaxation,
    ) -> Result<Self, BeamError> {
        let order = mesh.basis().degree() + 1;
        let on_axis = SectionsOnAxis::new(variation, mesh, control_points)?;
        let mut spans = Vec::new();
        for (index, quadrature) in mesh.quadrature_spans()?.into_iter().enumerate() {
            let span = quadrature.span;
            let point = |(xi, weight): (f64, f64)| {
                let values = mesh.basis().evaluate_in(&span, xi);
                let derivative = values.combine(1, control_points);
                let speed = derivative.norm();
                let slope = values.slopes().iter().map(|slope| slope / speed).collect();
                let shape = values.values().to_vec();
                let functions = Functions { shape, slope, weight: weight * speed };
                (functions, derivative / speed, on_axis.at(index, &span, xi))
            };
            let force = |(functions, tangent, section): (_, _, Section)| {
                let stiffness = Vec2::new(section.axial_stiffness, section.shear_stiffness);
                let times = Vec2::new(relaxation.axial, relaxation.shear);
                ForceDashpot::new(functions, tangent, stiffness.component_mul(&times))
            };
            let moment = |(functions, _, section): (_, Vec2, Section)| {
                MomentDashpot::new(functions, section.bending_stiffness * relaxation.bending)
            };
            let rule = quadrature.moment_rule()?;
            let moments = rule.iter_on(span.start, span.end).map(point).map(moment);
            spans.push(SpanDashpots {
                first: span.first,
                moments: moments.collect(),
                forces: quadrature.force_rule.iter().copied().map(point).map(force).collect(),
            });
        }
        let watch = RateResolution::default();
        Ok(Self { order, spans, resolution: watch, block: vec![0.0; 9 * order * order] })
    }

    /// Number of control points per span.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Prepares a step that starts with the given rates of the control points. Iterations start with the dashpot forces of the last step.
    pub fn begin_step(&mut self, rates: &[Movement]) {
        for SpanDashpots { first, forces, moments } in &mut self.spans {
            let rates = &rates[*first..*first + self.order];
            forces.iter_mut().for_each(|dashpot| dashpot.begin_step(rates));
            moments.iter_mut().for_each(|dashpot| dashpot.begin_step(rates));
        }
    }

    pub(crate) fn rest_without_damping(&mut self) {
        for span in &mut self.spans {
            span.forces.iter_mut().for_each(ForceDashpot::rest_without_damping);
            span.moments.iter_mut().for_each(MomentDashpot::rest_without_damping);
        }
    }

    pub(crate) fn clear_rate_history(&mut self) {
        self.resolution = RateResolution::default();
    }

    /// Calls `give` with the dashpot forces on control points in the present iterate.
    /// Returns the largest dashpot force and the largest residual of the damping laws, which is converted to a strain.
    pub fn add_forces(
        &mut self,
        at: RateCollocation,
        moved: &[Movement],
        give: &mut dyn FnMut(usize, Movement),
    ) -> ForceSummary {
        let mut summary = ForceSummary::default();
        for SpanDashpots { first, forces, moments } in &mut self.spans {
            let moved = &moved[*first..*first + self.order];
            for dashpot in forces {
                dashpot.add_forces(at, moved, *first, give, &mut summary);
            }
            for dashpot in moments {
                dashpot.add_forces(at, moved, *first, give, &mut summary);
            }
        }
        summary
    }

    /// Calls `give` with the dashpot forces on control points after elimination of the dashpot unknowns.
    /// Calls `tangent` with the first control point of each span and the derivatives of the dashpot forces, row by row.
    pub fn add_linearised_forces(
        &mut self,
        at: RateCollocation,
        moved: &[Movement],
        give: &mut dyn FnMut(usize, Movement),
        tangent: &mut dyn FnMut(usize, &[f64]),
    ) {
        for SpanDashpots { first, forces, moments } in &mut self.spans {
            let moved = &moved[*first..*first + self.order];
            self.block.fill(0.0);
            for dashpot in forces {
                dashpot.add_linearised_forces(at, moved, *first, give, &mut self.block);
            }
            for dashpot in moments {
                dashpot.add_linearised_forces(at, moved, *first, give, &mut self.block);
            }
            tangent(*first, &self.block);
        }
    }

    /// Calls `give` with the force changes on control points that would make all dashpot forces satisfy their damping laws.
    pub fn add_mismatch_forces(&self, give: &mut dyn FnMut(usize, Movement)) {
        for SpanDashpots { first, forces, moments } in &self.spans {
            forces.iter().for_each(|dashpot| dashpot.add_mismatch_forces(*first, give));
            moments.iter().for_each(|dashpot| dashpot.add_mismatch_forces(*first, give));
        }
    }

    pub(crate) fn correct(&mut self, correction: &[Movement]) {
        for SpanDashpots { first, forces, moments } in &mut self.spans {
            let correction = &correction[*first..*first + self.order];
            forces.iter_mut().for_each(|dashpot| dashpot.correct(correction));
            moments.iter_mut().for_each(|dashpot| dashpot.correct(correction));
        }
    }

    /// Ends a step, and returns the energy that the dashpots dissipate in the step [energy].
    /// For a static increment, the duration [time] must be infinite, so that the rates of the dashpots are zero.
    pub fn advance(
        &mut self,
        moved: &[Movement],
        rotations: RotationIncrement,
        duration: f64,
    ) -> f64 {
        let (mut sum, mut all) = (0.0, [RateMismatch::default(); 3]);
        let fraction = self.resolution.fraction(duration);
        for SpanDashpots { first, forces, moments } in &mut self.spans {
            let moved = &moved[*first..*first + self.order];
            for dashpot in forces {
                sum += dashpot.advance(moved, rotations, duration);
                let seen = fraction
                    .map(|fraction| dashpot.last_rate_mismatch(fraction))
                    .unwrap_or_default();
                all.iter_mut().zip(seen).for_each(|(all, seen)| all.join(seen));
            }
            for dashpot in moments {
                sum += dashpot.advance(moved, rotations, duration);
                all[2].join(
                    fraction
                        .map(|fraction| dashpot.last_rate_mismatch(fraction))
                        .unwrap_or_default(),
                );
            }
        }
        self.resolution.add(duration, all);
        sum
    }

    pub(crate) fn emit_dashpot_forces(
        &self,
        rates: &[Movement],
        give: &mut dyn FnMut(usize, Movement),
    ) {
        for SpanDashpots { first, forces, moments } in &self.spans {
            let rates = self.resolution.selected(&rates[*first..*first + self.order]);
            forces.iter().for_each(|dashpot| dashpot.emit_dashpot_forces(rates, *first, give));
            moments.iter().for_each(|dashpot| dashpot.emit_dashpot_forces(rates, *first, give));
        }
    }

    pub(crate) fn each_damped_rate(&self, rates: &[Movement], take: &mut dyn FnMut(f64, f64)) {
        for SpanDashpots { first, forces, moments } in &self.spans {
            let rates = &rates[*first..*first + self.order];
            forces.iter().for_each(|dashpot| dashpot.each_damped_rate(rates, take));
            moments.iter().for_each(|dashpot| dashpot.each_damped_rate(rates, take));
        }
    }

    pub(crate) fn transmitted(&self, place: &SectionPlace, rates: &[Movement]) -> (Vec2, f64) {
        let of_span = |span: usize| {
            let span = &self.spans[span];
            (span, self.resolution.selected(&rates[span.first..span.first + self.order]))
        };
        let (mut force, mut moment) = (Vec2::zeros(), 0.0);
        for share in &place.force_shares {
            let (span, rates) = of_span(share.span);
            let (at_point, couple) = span.forces[share.point].transmitted(rates);
            force += at_point * share.of_force;
            moment += couple * share.of_couple;
        }
        for share in &place.moment_shares {
            let (span, rates) = of_span(share.span);
            moment += span.moments[share.point].transmitted(rates) * share.of_moment;
        }
        (force, moment)
    }

    /// Appends the present state of the dashpots to `state`.
    pub fn save(&self, state: &mut Vec<f64>) {
        self.resolution.save(state);
        for span in &self.spans {
            span.forces.iter().for_each(|dashpot| dashpot.save(state));
            span.moments.iter().for_each(|dashpot| dashpot.save(state));
        }
    }

    /// Restores the state of the dashpots from numbers in the order of [`save`](Self::save).
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.resolution.restore(next);
        for span in &mut self.spans {
            span.forces.iter_mut().for_each(|dashpot| dashpot.restore(next));
            span.moments.iter_mut().for_each(|dashpot| dashpot.restore(next));
        }
    }
}

pub(super) fn strain_missing(force: f64, resistance: f64) -> f64 {
    if resistance > 0.0 { (force / resistance).abs() } else { 0.0 }
}

pub(super) fn larger_missing(missing: Vec2, resistance: Vec2) -> f64 {
    larger(strain_missing(missing.x, resistance.x), strain_missing(missing.y, resistance.y))
}
