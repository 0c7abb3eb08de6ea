//! Warnings about motion that the steps do not resolve.

use std::f64::consts::TAU;

use super::Simulation;
use crate::elementary::power;
use crate::geometry::larger;
use crate::integrators::{EnergyClaim, INTEGRATORS, Mechanism, Method};
use crate::joints::Component;
use crate::simulation::adaptive::Adaptive;
use crate::simulation::warning::{LARGEST_ROTATION, MOST_SPANS, RateChangeCause, short};
use crate::simulation::{Invariant, Sample, StepSize, Warning};
use crate::system::{
    Drive, LawArgument, Penetration, RESOLVED_IMPACT, Resolution, SpringLaw, StartImpact, System,
    SystemFeature,
};
use crate::vibration::{Modes, VibrationError};

/// Largest unresolved fraction of the kinetic energy without a warning that the steps are too long [-].
/// A single vibration with 3.5 steps per period has an unresolved fraction of 0.2. Its computed period is 20 % too long.
const LARGEST_SHARE: f64 = 0.2;

/// Largest unresolved fraction of the kinetic energy without a warning [-]. This limit replaces [`LARGEST_SHARE`] if a step contains several periods.
const HIDDEN_SHARE: f64 = 0.05;

/// Phase of the vibration per step above which [`HIDDEN_SHARE`] replaces [`LARGEST_SHARE`] [rad].
const HIDDEN_TURN: f64 = 2.0 * TAU;

/// Smallest kinetic energy of the damped beams that are checked, as a fraction of the total kinetic energy.
const NOTHING: f64 = 1e-8;

/// Largest relative energy drift without a warning [-]. Rounding errors of about ten thousand steps are smaller, for any stiffness.
const LARGEST_DRIFT: f64 = 1e-7;

/// Rounding error of dissipated energies, as a fraction of these energies.
const DISSIPATION_ROUNDING: f64 = 1e-7;

/// Smallest dissipated energy for which a damper is reported as a possible cause, as a fraction of dissipated plus largest kinetic energy.
const MUCH: f64 = 0.3;

/// Largest number of unknowns for which modes of the initial configuration are computed.
const MOST_UNKNOWNS: usize = 1200;

/// Numbers of modes that are computed in successive attempts, until one of the modes is a vibration.
const MODES: [usize; 3] = [4, 8, 16];

/// Largest strain of the elastic wave of an impact that counts as zero [-].
/// A strain below this limit may be an error of the rates of prescribed motions, which are computed by finite differences.
const NEGLIGIBLE_STRAIN: f64 = 1e-8;

const RECENT_STEPS: usize = 200;

/// Smallest relative change of the step length from one step to the next that counts as an alternation.
const ALTERNATION: f64 = 0.1;

/// Smallest number of alternations of the step length among the recent steps that causes a warning.
const MOST_TURNS: usize = 20;

/// Smallest number of adaptive steps for which a warning about many steps is given.
const MANY_STEPS: usize = 5000;

/// Largest factor, without a warning, by which the mean step is shorter than a step that resolves the motion of the whole scene [-].
/// Steps that are shorter by this factor resolve a vibration whose amplitude is below a thousandth of the length of the scene.
const MUCH_SHORTER: f64 = 50.0;

const SLIDERS: usize = 6;

impl Simulation {
    /// Warnings about motion that the steps so far do not resolve. Steps that were undone by a rewind are ignored.
    pub fn warnings(&self) -> Vec<Warning> {
        let (dt, resolution) = (self.longest_step(), self.model.resolution());
        let mut notes = Vec::new();
        if self.is_unresolved(resolution) {
            let unresolved_fraction = resolution.unresolved_share();
            let period = TAU / resolution.angular_frequency();
            let (lowest, causes) = (self.lowest_period(), self.possible_causes());
            let damping = self.damping_method();
            notes.push(Warning::Motion {
                dt,
                unresolved_fraction,
                period,
                lowest,
                causes,
                damping,
            });
        }
        if notes.is_empty() {
            notes.extend(self.unresolved_beams(dt));
        }
        if notes.is_empty() {
            notes.extend(self.phase_error());
        }
        notes.extend(self.uneven_steps());
        notes.extend(self.many_steps());
        if resolution.rotation() > LARGEST_ROTATION {
            let dt = self.settings.method.step_with_part(resolution.turned_in());
            notes.push(Warning::Rotation { dt, angle: resolution.rotation() });
        }
        for (index, slider) in self.model.slider_names().enumerate() {
            let (slider, spans) = (slider.to_owned(), self.model.most_spans(index));
            if spans > MOST_SPANS {
                notes.push(Warning::SpansPerStep { slider: slider.clone(), dt, spans });
            }
            let steps = self.model.steps_with_fixed_friction(index);
            if steps > 0 {
                notes.push(Warning::Friction { slider: slider.clone(), steps });
            }
            let steps = self.model.steps_with_kept_contact(index);
            if steps > 0 {
                notes.push(Warning::KeptContact { slider: slider.clone(), steps });
            }
            if let Some(limit) = self.model.kink_speed_limit(index) {
                let speeds = self.history().column(&format!("{slider}.speed"));
                let fastest = |speeds: Vec<f64>| speeds.into_iter().map(f64::abs).fold(0.0, larger);
                let speed = speeds.map_or(0.0, fastest);
                if speed > limit {
                    notes.push(Warning::WaveSpeed { slider: slider.clone(), speed, limit });
                }
            }
            let impacts_per_step = self.model.impacts_per_step(index);
            if impacts_per_step > RESOLVED_IMPACT {
                notes.push(Warning::Bounce { slider, dt, impacts_per_step });
            }
        }
        if let Some(drift) = self.excess_energy_drift() {
            let stiffest = self.model.stiffest_spring();
            let stiffest = stiffest.map(|(name, stiffness)| (name.to_owned(), stiffness));
            notes.push(Warning::Drift { drift, stiffest });
        }
        notes.extend(self.energy_gain());
        let bends = self.model.bends();
        notes.extend(
            bends.map(|(drive, bend)| Warning::Bend { drive: drive.to_owned(), curvature: bend }),
        );
        let warning = |(name, change)| {
            let owner = self.scene.source_of_schedule(name);
            Warning::Schedule { owner: owner.trim_end_matches(',').to_owned(), dt, change }
        };
        notes.extend(self.model.missed_changes().map(warning));
        notes.extend(self.model.outside_laws().into_iter().filter_map(|(index, outside)| {
            let spring = self.scene.springs().nth(index)?.object();
            let kind = match outside.argument {
                LawArgument::Rate => "damping law",
                LawArgument::Elongation => "law",
            };
            Some(Warning::Range { law: format!("the {kind} of {spring}"), outside })
        }));
        let bounces = self.model.short_bounces();
        let tolerance = self.adaptive.as_ref().map(|adaptive| adaptive.tolerance);
        let object = |name: &str| {
            let object = self.scene.contact_object(name);
            object.unwrap_or_else(|| format!("spring '{name}'"))
        };
        let warning = |(name, bounce): (&str, _)| Warning::Contact {
            object: object(name),
            tolerance,
            bounce,
        };
        notes.extend(bounces.map(warning));
        notes.extend_from_slice(&self.initial_geometry.warnings);
        notes
    }

    /// Adds a warning for each obstacle or contact between bodies, about the body whose contact stores the largest energy.
    /// The penetrations must be sorted by decreasing energy.
    pub(super) fn warn_of_penetrations(&mut self, penetrations: Vec<(String, Penetration)>) {
        for (obstacle, Penetration { body, depth, energy, .. }) in penetrations {
            let obstacle = self.scene.contact_object(&obstacle).unwrap_or(obstacle);
            let body = self.scene.name_of_body_at(body);
            let warning = Warning::StartInside { obstacle, body, depth, energy };
            if warning.is_new_or_worse(&self.initial_geometry.warnings) {
                self.initial_geometry.warnings.push(warning);
            }
        }
    }

    pub(super) fn warn_of_start_impacts(&mut self) {
        let impacts = self.model.start_impacts(NEGLIGIBLE_STRAIN * self.scene.fastest_wave());
        for StartImpact { drive, beam, component, rate } in impacts {
            let Drive { kind, name, .. } = &self.scene.drives[drive];
            let quantity = match component {
                Component::Rotation => "the angular velocity",
                Component::X | Component::Y => "the velocity",
            };
            let warning = Warning::StartImpact {
                drive: format!("{} '{name}'", kind.name()),
                beam: self.scene.beams[beam].name.clone(),
                rate: format!("{quantity} {}", short(rate)),
            };
            if warning.is_new_or_worse(&self.initial_geometry.warnings) {
                self.initial_geometry.warnings.push(warning);
            }
        }
    }

    fn is_unresolved(&self, resolution: &Resolution) -> bool {
        let unresolved_fraction = resolution.unresolved_share();
        let turn = resolution.angular_frequency() * self.dt();
        unresolved_fraction > LARGEST_SHARE
            || (unresolved_fraction > HIDDEN_SHARE && turn > HIDDEN_TURN)
    }

    /// Warnings about damped beams whose motion is not resolved by steps of the length `dt` [time].
    /// These warnings are needed because the motion of the whole scene may be resolved nevertheless.
    fn unresolved_beams(&self, dt: f64) -> impl Iterator<Item = Warning> {
        let least = NOTHING * self.model.resolution().kinetic();
        let beams = self.model.resolution_by_beam();
        let shaken = beams.filter(move |(_, own)| self.is_unresolved(own) && own.kinetic() > least);
        shaken.map(move |(beam, own)| Warning::Beam {
            beam: self.scene.beams[beam].name.clone(),
            dt,
            unresolved_fraction: own.unresolved_share(),
            period: TAU / own.angular_frequency(),
        })
    }

    /// Warning about alternating long and short steps in scenes with rigid links or dissipation, whose velocity errors persist.
    /// In steps of different lengths, position errors due to velocity errors of alternating sign do not cancel.
    fn uneven_steps(&self) -> Option<Warning> {
        let keeps = self.model.has_rigid_links() || self.scene.dissipating().next().is_some();
        if !keeps || !matches!(self.settings.dt, StepSize::Fixed(_)) {
            return None;
        }
        let lengths = self.recent_grid_steps();
        let (mut turns, mut shortest, mut longest) = (0, f64::INFINITY, 0.0);
        for pair in lengths.windows(2) {
            let [before, now] = [pair[0], pair[1]];
            if before > 0.0 && (now - before).abs() > ALTERNATION * larger(now, before) {
                turns += 1;
                shortest = before.min(now).min(shortest);
                longest = larger(longest, larger(before, now));
            }
        }
        (turns >= MOST_TURNS).then_some(Warning::Uneven { shortest, longest })
    }

    /// Lengths of the recent steps of the time grid [time]. The parts of a divided step are added.
    fn recent_grid_steps(&self) -> Vec<f64> {
        let rows = self.history().samples();
        let last = &rows[rows.len().saturating_sub(RECENT_STEPS)..];
        let is_event = |time: f64| {
            let first = self.arrivals().partition_point(|arrival| arrival.time < time);
            self.arrivals().get(first).is_some_and(|arrival| arrival.time == time)
        };
        let (mut lengths, mut covered, mut planned_end) = (Vec::new(), 0.0, f64::NEG_INFINITY);
        for row in last {
            let end = row.measures.time;
            if row.retries > 0 || is_event(end) {
                planned_end = larger(planned_end, self.clock.grid.end_of_step(end - row.dt));
            }
            covered += row.dt;
            if self.clock.grid.has_reached(end, planned_end) {
                lengths.push(std::mem::take(&mut covered));
            }
        }
        lengths
    }

    fn many_steps(&self) -> Option<Warning> {
        let Adaptive { tolerance, length, order, .. } = **self.adaptive.as_ref()?;
        let (steps, rows) = (self.counts().steps, self.history().samples());
        if steps < MANY_STEPS {
            return None;
        }
        let kinetic = rows.iter().map(|row| row.measures.energy.kinetic).sum::<f64>();
        let speed = (2.0 * kinetic / (rows.len() as f64 * self.model.total_mass())).sqrt();
        let (dt, travel_time) = (self.time() / steps as f64, length / speed);
        let times = travel_time * power(tolerance, 1.0 / f64::from(order)) / dt;
        let method = (order == 1).then(|| self.settings.method.entry().name);
        (method.is_some() || (times > MUCH_SHORTER && times.is_finite()))
            .then_some(Warning::ManySteps { steps, dt, tolerance, method, travel_time, times })
    }

    /// Longest step taken so far [time]. The requested step size may be longer.
    pub(super) fn longest_step(&self) -> f64 {
        let rows = self.history().samples();
        let longest = rows.iter().map(|row| row.dt).fold(0.0, larger);
        if longest > 0.0 { longest.min(self.dt()) } else { self.dt() }
    }

    /// Energy drift above rounding, with a method that conserves energy.
    /// Scenes with sliders are excluded, because sliding rules have separate conservation properties.
    fn excess_energy_drift(&self) -> Option<f64> {
        let keeps = self.settings.method.entry().claims.energy == EnergyClaim::Conserved;
        let rows = self.history().samples();
        let (first, last) = (rows.first()?.measures, rows.last()?.measures);
        if !keeps || !self.scene.sliders.is_empty() {
            return None;
        }
        let apart = Invariant::Energy.value(&last) - Invariant::Energy.value(&first);
        let now = last.energy.kinetic + last.energy.strain + last.energy.stored;
        if apart.norm() <= LARGEST_DRIFT * now {
            return None;
        }
        let drift = self.history().drift(Invariant::Energy);
        (drift > LARGEST_DRIFT).then_some(drift)
    }

    /// Name of a method with numerical damping; `None` if such a method is already used or would have no effect.
    fn damping_method(&self) -> Option<&'static str> {
        let entries = INTEGRATORS.iter();
        let damping = entries.filter(|entry| entry.claims.energy == EnergyClaim::NonIncreasing);
        let is_line = |law: &SpringLaw| matches!(law, SpringLaw::Linear { .. });
        let mut springs = self.scene.springs().filter_map(|spring| spring.law.as_ref());
        let strains = !self.scene.beams.is_empty() || springs.any(is_line);
        let mut others = damping.filter(|_| strains).map(|entry| entry.name);
        others.find(|name| *name != self.settings.method.entry().name)
    }

    /// Warning that dampers added energy with the method `fourth_order`, whose backward substeps return energy.
    /// The warning is given if dampers added energy in a step, or if backward substeps returned more energy than dampers dissipated.
    fn energy_gain(&self) -> Option<Warning> {
        if self.settings.method != Method::FourthOrder {
            return None;
        }
        let rows = self.history().samples();
        rows.last().filter(|row| row.measures.dissipated != 0.0)?;
        let (mut all_returned, mut all_taken, mut rounding) = (0.0, 0.0, 0.0);
        let mut worst: Option<(f64, f64, &Sample)> = None;
        let mut has_grown = false;
        for pair in rows.windows(2) {
            let [before, now] = [pair[0].measures, pair[1].measures];
            let held = now.energy.kinetic + now.energy.strain + now.energy.stored;
            let doubt = DISSIPATION_ROUNDING * larger(held, now.dissipated.abs());
            let (returned, taken) = (pair[1].returned, now.dissipated - before.dissipated);
            has_grown |= -taken > doubt;
            all_returned += returned;
            all_taken += taken;
            rounding = larger(rounding, doubt);
            if worst.is_none_or(|(energy, less, _)| returned - taken > energy - less) {
                worst = Some((returned, taken, &pair[1]));
            }
        }
        let is_slow = all_returned > all_taken + rounding;
        let (returned, taken, row) = worst.filter(|_| has_grown || is_slow)?;
        Some(Warning::EnergyGain {
            time: row.measures.time,
            dt: row.dt,
            returned,
            dissipated: taken,
        })
    }

    fn possible_causes(&self) -> Vec<RateChangeCause> {
        let rows = self.history().samples();
        let others = rows.last().map(|row| row.measures).unwrap_or_default().dissipated;
        // The dissipated energy is compared with the kinetic energy alone, because a damper may dissipate stored energy arbitrarily slowly.
        let left = rows.iter().map(|row| row.measures.energy.kinetic).fold(0.0, larger);
        let most = self.model.most_damping();
        let is_much = |energy: f64| larger(energy, others) > MUCH * (larger(energy, others) + left);
        let most = most.filter(|(_, energy)| is_much(*energy));
        let dampers = most.map(|(name, _)| RateChangeCause::Damping(name.to_owned()));
        let sampled =
            self.scene.schedules().filter(|(_, schedule)| schedule.is_sampled_every_step());
        let controllers = sampled
            .map(|(name, _)| RateChangeCause::Controller(self.scene.source_of_schedule(name)));
        dampers.into_iter().chain(controllers.take(1)).collect()
    }

    /// Period of the lowest natural mode of the initial configuration [time].
    /// The period is `None` for scenes with sliders, without vibration, or with many unknowns.
    fn lowest_period(&self) -> Option<f64> {
        self.initial_geometry.lowest_period(|| {
            let slides = self.model.slider_names().next().is_some();
            if slides || self.model.unknowns() > MOST_UNKNOWNS {
                return None;
            }
            // If the modes cannot be computed, the warning does not contain a period.
            let drawn = System::assemble(&self.scene).ok()?;
            MODES.iter().find_map(|count| {
                let modes = match Modes::of(&drawn, *count, &mut || true) {
                    Err(VibrationError::Count { available, .. }) if available > 0 => {
                        Modes::of(&drawn, available, &mut || true)
                    }
                    found => found,
                };
                let modes = modes.ok()?;
                let vibrating = modes.all().iter().find(|mode| mode.square > 0.0)?;
                Some(vibrating.period())
            })
        })
    }

    pub(super) fn explain_resolution(&self) -> Vec<SystemFeature> {
        let resolution = self.model.resolution();
        let mut how = format!(
            "{} % of the kinetic energy in vibration that steps do not resolve; sections rotate by at most {} rad per step",
            short(100.0 * resolution.unresolved_share()),
            short(resolution.rotation())
        );
        for (index, slider) in self.model.slider_names().enumerate().take(SLIDERS) {
            how += &format!(
                "; slider '{slider}' crosses at most {} spans per step",
                short(self.model.most_spans(index))
            );
        }
        let notes =
            self.warnings().into_iter().map(|note| SystemFeature::used("note", note.to_string()));
        std::iter::once(SystemFeature::used("resolution", how)).chain(notes).collect()
    }
}
