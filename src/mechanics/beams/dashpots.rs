//! Kelvin–Voigt dashpots parallel to the quadrature points of a beam, with relaxation times `τ` of axial, shear and bending deformation.
//!
//! ```text
//! N = C τ ΔΓ/Δt      ΔΓ = Λ̄ᵀ (Δx' - Δω J x̄')      M = EI τ Δκ/Δt      D = Σ w (N·ΔΓ + M Δκ) ≥ 0
//! ```
//!
//! The dashpots are separate from the points for `Γ` and `κ`, so undamped beams have no overhead. Their forces are independent unknowns, like section
//! forces.

use serde::{Deserialize, Serialize};

use super::dynamics::{ForceSummary, Movement};
use super::force_dashpot::ForceDashpot;
use super::moment_dashpot::MomentDashpot;
use super::present_rates::{RateMismatch, RateResolution};
use super::sections::SectionsOnAxis;
use super::{BeamError, Mesh, RotationIncrement, Section, SectionPlace, SectionVariation};
use crate::geometry::{Vec2, larger};

/// Relaxation times of a Kelvin–Voigt material: the section forces are `C (Γ + τ Γ̇)` and `EI (κ + τ κ̇)` [time].
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
    /// Description of allowed relaxation times.
    pub(crate) const ALLOWED: &'static str = "zero or a positive finite number [time]";

    /// Checks that all times are finite and not negative.
    ///
    /// # Errors
    /// Name and value of the first invalid time.
    pub fn validated(&self) -> Result<(), (&'static str, f64)> {
        let times = [("axial", self.axial), ("shear", self.shear), ("bending", self.bending)];
        match times.into_iter().find(|(_, time)| !(time.is_finite() && *time >= 0.0)) {
            Some(wrong) => Err(wrong),
            None => Ok(()),
        }
    }
}

/// Collocation of rates in a step: the rate of `q` is `by_change · Δq - by_last · q̇` with the rate `q̇` of the previous step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateCollocation {
    /// Fraction of the step at which directions are taken: `(1-s)(x0, Λ0) + s (x1, Λ1)` [-].
    pub fraction: f64,
    /// Factor of the change in the step [1/time].
    pub by_change: f64,
    /// Factor of the rate in the previous step [-].
    pub by_last: f64,
    /// Kind of rotation increments.
    pub rotations: RotationIncrement,
}

/// Basis functions at a point of a beam: values [-], derivatives with respect to arc length [1/length], and quadrature weight [length].
#[derive(Debug, Clone)]
pub(super) struct Functions {
    pub(super) shape: Vec<f64>,
    pub(super) slope: Vec<f64>,
    pub(super) weight: f64,
}

impl Functions {
    /// Values `(Δx', Δω, Δω')` for increments of the control points of the span.
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

/// Dashpots of a beam at its quadrature points. Increments, rates and forces are indexed by control point.
#[derive(Debug, Clone)]
pub struct Dashpots {
    order: usize,
    spans: Vec<SpanDashpots>,
    resolution: RateResolution,
    /// Derivative of the forces of a span, row by row.
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

    /// Prepares a step with the given rates of the control points. Forces start from their values in the last step.
    pub fn begin_step(&mut self, rates: &[Movement]) {
        for SpanDashpots { first, forces, moments } in &mut self.spans {
            let rates = &rates[*first..*first + self.order];
            forces.iter_mut().for_each(|dashpot| dashpot.begin_step(rates));
            moments.iter_mut().for_each(|dashpot| dashpot.begin_step(rates));
        }
    }

    /// Prepares an increment of zero duration without damping.
    pub(crate) fn rest_without_damping(&mut self) {
        for span in &mut self.spans {
            span.forces.iter_mut().for_each(ForceDashpot::rest_without_damping);
            span.moments.iter_mut().for_each(MomentDashpot::rest_without_damping);
        }
    }

    /// Discards the rate history after a jump of the rates.
    pub(crate) fn clear_rate_history(&mut self) {
        self.resolution = RateResolution::default();
    }

    /// Calls `give` with the current dashpot forces on control points. Returns the largest force and the mismatch.
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

    /// Calls `give` with the condensed forces on control points, and `tangent` with the first control point of each span and the derivatives of its
    /// forces by rows.
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

    /// Calls `give` with the corrections of the nodal forces that make the residual of the dashpot laws zero. The directions of the forces are those of
    /// the last linearisation.
    pub fn add_mismatch_forces(&self, give: &mut dyn FnMut(usize, Movement)) {
        for SpanDashpots { first, forces, moments } in &self.spans {
            forces.iter().for_each(|dashpot| dashpot.add_mismatch_forces(*first, give));
            moments.iter().for_each(|dashpot| dashpot.add_mismatch_forces(*first, give));
        }
    }

    /// Updates the forces after a correction of the increments.
    pub(crate) fn correct(&mut self, correction: &[Movement]) {
        for SpanDashpots { first, forces, moments } in &mut self.spans {
            let correction = &correction[*first..*first + self.order];
            forces.iter_mut().for_each(|dashpot| dashpot.correct(correction));
            moments.iter_mut().for_each(|dashpot| dashpot.correct(correction));
        }
    }

    /// Accepts the increments of a step of a duration [time], which is infinite without damping. Returns the dissipated energy [energy].
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

    /// Calls `give` with the dashpot forces for the given rates at the start of the step. Rates that the steps do not resolve are extrapolated from
    /// the means of the last two steps.
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

    /// Calls `take` with the rates of strain and curvature for the given rates of the control points at the start of the step, each with its damping
    /// coefficient times the quadrature weight. The sum of coefficient times squared rate is a power [energy/time].
    pub(crate) fn each_damped_rate(&self, rates: &[Movement], take: &mut dyn FnMut(f64, f64)) {
        for SpanDashpots { first, forces, moments } in &self.spans {
            let rates = &rates[*first..*first + self.order];
            forces.iter().for_each(|dashpot| dashpot.each_damped_rate(rates, take));
            moments.iter().for_each(|dashpot| dashpot.each_damped_rate(rates, take));
        }
    }

    /// Dashpot force in space [force] and moment [force·length] at a place at the start of the step, interpolated like section forces. Rates that the
    /// steps do not resolve are extrapolated from the means of the last two steps.
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

    /// Appends the state at the start of a step to `state`.
    pub fn save(&self, state: &mut Vec<f64>) {
        self.resolution.save(state);
        for span in &self.spans {
            span.forces.iter().for_each(|dashpot| dashpot.save(state));
            span.moments.iter().for_each(|dashpot| dashpot.save(state));
        }
    }

    /// Restores the state, in the order in which it was appended.
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.resolution.restore(next);
        for span in &mut self.spans {
            span.forces.iter_mut().for_each(|dashpot| dashpot.restore(next));
            span.moments.iter_mut().for_each(|dashpot| dashpot.restore(next));
        }
    }
}

/// Force mismatch divided by the derivative of the force; zero if the derivative is zero.
pub(super) fn strain_missing(force: f64, resistance: f64) -> f64 {
    if resistance > 0.0 { (force / resistance).abs() } else { 0.0 }
}

pub(super) fn larger_missing(missing: Vec2, resistance: Vec2) -> f64 {
    larger(strain_missing(missing.x, resistance.x), strain_missing(missing.y, resistance.y))
}
