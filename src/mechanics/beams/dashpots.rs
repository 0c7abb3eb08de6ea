//! Dashpots beside the quadrature points of a beam: Kelvin–Voigt damping, with relaxation times `τ` of stretching, shear and bending.
//!
//! ```text
//! N = C τ ΔΓ/Δt      ΔΓ = Λ̄ᵀ (Δx' - Δω J x̄')      M = EI τ Δκ/Δt      D = Σ w (N·ΔΓ + M Δκ) ≥ 0
//! ```
//!
//! They stand beside the points for `Γ` and `κ` and not in them: a beam without damping knows nothing of them. Their forces are unknowns
//! of their own, as section forces are.

use serde::{Deserialize, Serialize};

use super::dynamics::{ForceSummary, Movement};
use super::force_dashpot::ForceDashpot;
use super::moment_dashpot::MomentDashpot;
use super::present_rates::{RateMismatch, RateResolution};
use super::sections::SectionsOnAxis;
use super::{BeamError, Mesh, RotationIncrement, Section, SectionPlace, SectionVariation};
use crate::geometry::{Vec2, larger};

/// The relaxation times of a Kelvin–Voigt material: a section resists with `C (Γ + τ Γ̇)` and `EI (κ + τ κ̇)` [time].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Relaxation {
    /// The relaxation time of stretching [time].
    pub axial: f64,
    /// The relaxation time of shear [time].
    pub shear: f64,
    /// The relaxation time of bending [time].
    pub bending: f64,
}

impl Relaxation {
    /// What a relaxation time may be, in words.
    pub const ALLOWED: &'static str = "zero or a positive finite number [time]";

    /// Checks that no time is negative and all are finite.
    ///
    /// # Errors
    /// Names the first that is not allowed, with its value.
    pub fn validated(&self) -> Result<(), (&'static str, f64)> {
        let times = [("axial", self.axial), ("shear", self.shear), ("bending", self.bending)];
        match times.into_iter().find(|(_, time)| !(time.is_finite() && *time >= 0.0)) {
            Some(wrong) => Err(wrong),
            None => Ok(()),
        }
    }
}

/// Where in a step rates are taken, and how they follow from movements: the rate of `q` is `by_change · Δq - by_last · q̇`, `q̇` that of the step before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateCollocation {
    /// The share of the step at which directions are taken: `(1-s)(x0, Λ0) + s (x1, Λ1)` [-].
    pub share: f64,
    /// The factor of the change in the step [1/time].
    pub by_change: f64,
    /// The factor of the rate in the step before [-].
    pub by_last: f64,
    /// What rotation increments of the step stand for.
    pub rotations: RotationIncrement,
}

/// The functions of a beam at one of its points: values [-] and derivatives by arc length [1/length], and the weight of the point [length].
#[derive(Debug, Clone)]
pub(super) struct Functions {
    pub(super) shape: Vec<f64>,
    pub(super) slope: Vec<f64>,
    pub(super) weight: f64,
}

impl Functions {
    /// `(Δx', Δω, Δω')` of movements of the control points of the span.
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

/// The dashpots of one span.
#[derive(Debug, Clone)]
struct SpanDashpots {
    first: usize,
    forces: Vec<ForceDashpot>,
    moments: Vec<MomentDashpot>,
}

/// The dashpots of a beam: what its material dissipates, at its quadrature points.
///
/// Movements, rates and forces are indexed by control point.
#[derive(Debug, Clone)]
pub struct Dashpots {
    order: usize,
    spans: Vec<SpanDashpots>,
    watch: RateResolution,
    /// The derivative of the forces of a span, row after row.
    block: Vec<f64>,
}

impl Dashpots {
    /// The dashpots of a beam that is drawn by control points on a mesh, at rest.
    ///
    /// # Errors
    /// When the mesh has no quadrature.
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
        Ok(Self { order, spans, watch, block: vec![0.0; 9 * order * order] })
    }

    /// The number of control points of a span.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Begins a step with the forces of the last one, in which control points have such rates at its start.
    pub fn begin_step(&mut self, rates: &[Movement]) {
        for SpanDashpots { first, forces, moments } in &mut self.spans {
            let rates = &rates[*first..*first + self.order];
            forces.iter_mut().for_each(|dashpot| dashpot.begin_step(rates));
            moments.iter_mut().for_each(|dashpot| dashpot.begin_step(rates));
        }
    }

    /// Begins a movement that takes no time, in which nothing is damped.
    pub fn rest(&mut self) {
        for span in &mut self.spans {
            span.forces.iter_mut().for_each(ForceDashpot::rest);
            span.moments.iter_mut().for_each(MomentDashpot::rest);
        }
    }

    /// Takes nothing that was seen of rates for true any more: they have jumped.
    pub fn forget_rates(&mut self) {
        self.watch = RateResolution::default();
    }

    /// Gives the forces of the dashpots, as they are, to control points; the largest of them, and how far they are from those of the rates.
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

    /// Gives the forces that the rates ask for to control points, and their derivative, span by span, to a sink: its first control point and the rows.
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

    /// Gives the forces that would close the mismatch met by the last forces, in the directions of the last linearisation.
    pub fn add_mismatch_forces(&self, give: &mut dyn FnMut(usize, Movement)) {
        for SpanDashpots { first, forces, moments } in &self.spans {
            forces.iter().for_each(|dashpot| dashpot.add_mismatch_forces(*first, give));
            moments.iter().for_each(|dashpot| dashpot.add_mismatch_forces(*first, give));
        }
    }

    /// Carries a correction of the movements over to the forces.
    pub fn correct(&mut self, correction: &[Movement]) {
        for SpanDashpots { first, forces, moments } in &mut self.spans {
            let correction = &correction[*first..*first + self.order];
            forces.iter_mut().for_each(|dashpot| dashpot.correct(correction));
            moments.iter_mut().for_each(|dashpot| dashpot.correct(correction));
        }
    }

    /// Accepts the movements of a step of a duration [time], infinite where nothing is damped; what the dashpots dissipated in it [energy].
    pub fn advance(
        &mut self,
        moved: &[Movement],
        rotations: RotationIncrement,
        duration: f64,
    ) -> f64 {
        let (mut sum, mut all) = (0.0, [RateMismatch::default(); 3]);
        let share = self.watch.share(duration);
        for SpanDashpots { first, forces, moments } in &mut self.spans {
            let moved = &moved[*first..*first + self.order];
            for dashpot in forces {
                sum += dashpot.advance(moved, rotations, duration);
                let seen = share.map(|share| dashpot.seen(share)).unwrap_or_default();
                all.iter_mut().zip(seen).for_each(|(all, seen)| all.join(seen));
            }
            for dashpot in moments {
                sum += dashpot.advance(moved, rotations, duration);
                all[2].join(share.map(|share| dashpot.seen(share)).unwrap_or_default());
            }
        }
        self.watch.add(duration, all);
        sum
    }

    /// Gives the forces that such rates of the control points ask for at the start of the step; where steps do not resolve them, those of the means of the
    /// last two steps, carried on.
    pub fn resist(&self, rates: &[Movement], give: &mut dyn FnMut(usize, Movement)) {
        for SpanDashpots { first, forces, moments } in &self.spans {
            let rates = self.watch.told(&rates[*first..*first + self.order]);
            forces.iter().for_each(|dashpot| dashpot.resist(rates, *first, give));
            moments.iter().for_each(|dashpot| dashpot.resist(rates, *first, give));
        }
    }

    /// Gives the rates of strain and curvature at such rates of the control points, at the start of the step, each behind what damps it over the length that its
    /// point stands for: products of it with squares of rates are powers [energy/time].
    pub fn each_damped_rate(&self, rates: &[Movement], take: &mut dyn FnMut(f64, f64)) {
        for SpanDashpots { first, forces, moments } in &self.spans {
            let rates = &rates[*first..*first + self.order];
            forces.iter().for_each(|dashpot| dashpot.each_damped_rate(rates, take));
            moments.iter().for_each(|dashpot| dashpot.each_damped_rate(rates, take));
        }
    }

    /// What such rates of the control points let the dashpots transmit at a place at the start of the step, by the weights with which the
    /// quadrature points that they stand beside add up there: a force in space [force] and a moment [force·length]. Where steps do not resolve
    /// the rates, the means of the last two steps are carried on instead.
    pub fn transmitted(&self, place: &SectionPlace, rates: &[Movement]) -> (Vec2, f64) {
        let of_span = |span: usize| {
            let span = &self.spans[span];
            (span, self.watch.told(&rates[span.first..span.first + self.order]))
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

    /// Appends the state of the dashpots at the start of a step to `state`.
    pub fn save(&self, state: &mut Vec<f64>) {
        self.watch.save(state);
        for span in &self.spans {
            span.forces.iter().for_each(|dashpot| dashpot.save(state));
            span.moments.iter().for_each(|dashpot| dashpot.save(state));
        }
    }

    /// Takes the state of the dashpots back, in the order in which it was appended.
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.watch.restore(next);
        for span in &mut self.spans {
            span.forces.iter_mut().for_each(|dashpot| dashpot.restore(next));
            span.moments.iter_mut().for_each(|dashpot| dashpot.restore(next));
        }
    }
}

/// How far a force is from the one that is asked for, as a strain; none where nothing resists.
pub(super) fn strain_missing(force: f64, resistance: f64) -> f64 {
    if resistance > 0.0 { (force / resistance).abs() } else { 0.0 }
}

/// The larger of two strains that are missing.
pub(super) fn larger_missing(missing: Vec2, resistance: Vec2) -> f64 {
    larger(strain_missing(missing.x, resistance.x), strain_missing(missing.y, resistance.y))
}
