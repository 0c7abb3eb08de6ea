//! Impacts at the ends of masters: simultaneous impacts, energy stored in stops, and release of sliders from stops.
//!
//! The stop acts like an elastic body: it stores the lost kinetic energy and returns this energy when the slider leaves.
//! With a coefficient of restitution below one, the lost kinetic energy counts as dissipated and is not returned.

use super::System;
use super::impact::{GIVES, ImpactDirection, ImpactLaw};
use super::rigidity::Deformation;
use super::seam_impact::{SeamCorner, deflect_at_corners};
use crate::elementary::square;
use crate::geometry::{Vec2, larger};
use crate::joints::EndAction;
use crate::linalg::LinearError;
use crate::system::SystemError;
use crate::system::sliders::{AxialImpact, MasterLimit, SliderState};

/// Largest distance from an end, as a fraction of the parameter range, at which sliders count as arriving simultaneously [-].
const TOGETHER: f64 = 1e-12;

/// Time of the [`Deformation`] in an impact, as a multiple of the step length, or of the impact duration if there is a coefficient of restitution.
/// Vibrations with much shorter periods are suppressed.
pub(super) const RIGID: f64 = 4.0;

/// Largest ratio of step length to impact duration for which the steps resolve the impact [-].
pub const RESOLVED_IMPACT: f64 = 0.125;

/// Largest speed across a contact that counts as zero, as a fraction of the speed of the fastest point of the model.
pub(super) const NEGLIGIBLE_SPEED: f64 = 1e-12;

#[derive(Debug, Clone, Copy)]
pub(super) struct ImpactContact {
    pub(super) direction: ImpactDirection,
    pub(super) law: ImpactLaw,
}

/// Sliders that reach an end of their master at the same time, grouped by their behaviour at the end.
/// A limit is a slider together with the end of its master that it reaches.
#[derive(Debug, Clone, Default)]
pub struct Arriving {
    /// Limits at which sliders bounce.
    pub strike: Vec<MasterLimit>,
    /// Limits that sliders strike without rebound: the restitution is zero, and the steps do not resolve the impact.
    pub plastic: Vec<MasterLimit>,
    /// Limits at which the stop holds sliders.
    pub held: Vec<MasterLimit>,
    /// Limits at which sliders continue to the next beam of their tracks.
    pub crossing: Vec<MasterLimit>,
}

impl Arriving {
    /// Returns true if no slider arrives at an end.
    pub fn is_empty(&self) -> bool {
        !self.has_impact_or_is_held() && self.crossing.is_empty()
    }

    fn has_impact_or_is_held(&self) -> bool {
        [&self.strike, &self.plastic, &self.held].into_iter().any(|limits| !limits.is_empty())
    }
}

impl System {
    pub(crate) fn simultaneous_arrivals(&self, limit: MasterLimit) -> Vec<MasterLimit> {
        let limits = (0..self.sliders.len()).flat_map(MasterLimit::both);
        let arrives = |other: &MasterLimit| {
            let slider = &self.sliders[other.slider];
            let is_there = slider.is_sliding() && slider.distance_to(other.end) <= TOGETHER;
            *other == limit || (is_there && self.leads_beyond(*other))
        };
        limits.filter(arrives).collect()
    }

    /// Returns true if a slider at an end of its master moves beyond the end, in a run with steps of length `dt` [time].
    /// The velocity of the slider contains no vibrations that steps of this length do not resolve.
    /// At a stop with a coefficient of restitution, the velocity also contains no axial waves and no vibrations faster than the impact.
    /// The velocity contains no component across the master, because that component changes its sign from step to step.
    pub(crate) fn approaches(&mut self, limit: MasterLimit, dt: f64) -> Result<bool, SystemError> {
        let speed = self.stop_velocity(limit, dt).map_err(|_| self.sliders.overdetermined())?;
        Ok(speed < -NEGLIGIBLE_SPEED * self.fastest_speed())
    }

    fn stop_velocity(&mut self, limit: MasterLimit, dt: f64) -> Result<f64, LinearError> {
        let deformation = self.deformation_at(&[limit], dt)?;
        let hits = self.impulse_directions(|_, other| (other == limit).then_some(ImpactLaw::Rest));
        let (directions, laws): (Vec<ImpactDirection>, Vec<ImpactLaw>) =
            hits.iter().map(|hit| (hit.direction, hit.law)).unzip();
        let problem = self.impact_problem(&[(&directions, deformation)], -2.0)?;
        let velocities = problem.stop_velocities(&laws)?;
        let own = laws.iter().position(|law| *law == ImpactLaw::Rest);
        Ok(own.map_or(0.0, |at| velocities[at]))
    }

    /// Returns true if steps of length `dt` [time] resolve the impact of a slider at a limit.
    /// The impact duration follows from the wave speeds of the deformable bodies. Bodies that the impulse hardly moves are ignored.
    /// The function also records the ratio of step length to impact duration.
    pub(crate) fn resolves_impact(
        &mut self,
        limit: MasterLimit,
        dt: f64,
    ) -> Result<bool, SystemError> {
        let lasts = self.impact_duration(limit).map_err(|_| self.sliders.overdetermined())?;
        self.sliders[limit.slider].record_impact_ratio(dt / lasts);
        Ok(lasts.is_finite() && dt <= RESOLVED_IMPACT * lasts)
    }

    /// Duration of the impact of a slider at a limit [time]; infinite if slave and master are rigid.
    fn impact_duration(&self, limit: MasterLimit) -> Result<f64, LinearError> {
        let direction = (limit.slider, self.stop_direction(limit).into());
        let mut inertia = self.banded_inertia();
        let answers = self.impulse_responses(&inertia.factorise()?, &[direction]);
        let [answer] = &answers[..] else { return Ok(f64::INFINITY) };
        let (slave, master) = self.speeds(direction, &answer.rates);
        let (slave, master) = (slave.abs(), master.abs());
        let least = GIVES * (slave + master);
        let [slave, master] = [slave, master].map(|speed| (speed > least).then(|| 1.0 / speed));
        Ok(self.sliders[limit.slider].impact_duration(&self.bodies, AxialImpact { slave, master }))
    }

    /// Selects the deformations whose rates may change in an impact at the given limits, for steps of length `dt` [time].
    /// The rates of all other deformations remain constant.
    /// In an impact with a coefficient of restitution, axial waves and vibrations faster than the impact are excluded.
    /// In an elastic contact, vibrations that the steps do not resolve are excluded.
    fn deformation_at(&self, limits: &[MasterLimit], dt: f64) -> Result<Deformation, LinearError> {
        let mut longest = None;
        for limit in limits.iter().filter(|at| self.end_action(at.slider) != EndAction::Contact) {
            let lasts = Some(self.impact_duration(*limit)?).filter(|lasts| lasts.is_finite());
            longest = Some(larger(longest.unwrap_or(dt), lasts.unwrap_or(dt)));
        }
        Ok(longest.map_or(Deformation::Resolved(RIGID * dt), |longest| {
            Deformation::Inextensible(RIGID * longest)
        }))
    }

    pub(crate) fn freeze_contacts(&mut self) -> bool {
        self.sliders.freeze_contacts()
    }

    pub(crate) fn unfreeze_contacts(&mut self) {
        self.sliders.unfreeze_contacts();
    }

    pub(crate) fn has_frozen_contacts(&self) -> bool {
        self.sliders.iter().any(|slider| slider.is_frozen())
    }

    /// Direction of the stop force on the slave at a limit [-].
    fn stop_direction(&self, limit: MasterLimit) -> Vec2 {
        self.sliders[limit.slider].along_contact(&self.bodies) * -limit.end.outward()
    }

    /// Computes the impact of all sliders that are at ends of masters or at seams, for steps of length `dt` [time].
    ///
    /// Stops have the law [`ImpactLaw::Restitution`] and do no positive work.
    /// A stop that holds a slider has no restitution. A corner at a seam rotates the velocity of the slider.
    /// A slider that is not at a limit transmits an impulse across its master that does no work.
    /// A unilateral contact may open instead. No impulse is transmitted if the axis of the master is compliant.
    ///
    /// After the impact, a slider that passes a seam is on the other side of the seam.
    ///
    /// # Errors
    /// Fails if the impulses of the impact are undetermined.
    pub fn solve_impact(&mut self, arriving: &Arriving, dt: f64) -> Result<(), SystemError> {
        self.sliders.iter_mut().for_each(|slider| slider.impulse = Vec2::zeros());
        let met = self.solve_simultaneous_impacts(arriving, dt);
        met.map_err(|_| self.sliders.overdetermined())?;
        self.choose_friction_modes();
        self.leave_tensile_stops()
    }

    fn solve_simultaneous_impacts(
        &mut self,
        arriving: &Arriving,
        dt: f64,
    ) -> Result<(), LinearError> {
        self.straighten_kinks(&[&arriving.strike[..], &arriving.plastic, &arriving.held].concat())?;
        let passages = self.passages(&arriving.crossing);
        let corners = passages.corners_of_sections();
        let struck = [&arriving.strike[..], &arriving.plastic].concat();
        if !struck.is_empty() || !corners.is_empty() {
            let at_stops = self.deformation_at(&struck, dt)?;
            let hits = self.impulse_directions(|model, limit| {
                let restitution = model.sliders[limit.slider].restitution;
                struck.contains(&limit).then_some(ImpactLaw::Restitution(restitution))
            });
            self.apply_impulses(&hits, corners, [Deformation::Resolved(RIGID * dt), at_stops])?;
        }
        // The impulses applied so far suppress some deformations of the struck body.
        // Additional impulses with all deformations stop the sliders that come to rest.
        let resting = [&arriving.plastic[..], &arriving.held].concat();
        if !resting.is_empty() {
            let hits = self
                .impulse_directions(|_, limit| resting.contains(&limit).then_some(ImpactLaw::Rest));
            self.apply_impulses(&hits, &[], [Deformation::All; 2])?;
        }
        resting.iter().for_each(|limit| self.hold_at_stop(*limit));
        self.pass_seams(&passages)
    }

    /// Applies impulses at several contacts simultaneously.
    /// The impulses rotate the velocity of a slider that passes a corner. All other contacts follow their impact laws.
    /// A slider with a unilateral contact takes off if the impulses move it away from its master.
    pub(super) fn apply_impulses(
        &mut self,
        hits: &[ImpactContact],
        corners: &[SeamCorner],
        [at_corners, at_stops]: [Deformation; 2],
    ) -> Result<(), LinearError> {
        let passes = |slider: usize| corners.iter().any(|corner| corner.slider == slider);
        let others = hits.iter().filter(|hit| !passes(hit.direction.0));
        let (directions, laws): (Vec<ImpactDirection>, Vec<ImpactLaw>) =
            others.map(|hit| (hit.direction, hit.law)).unzip();
        let turned = SeamCorner::directions(corners);
        let met = [(&turned[..], at_corners), (&directions, at_stops)];
        let problem = self.impact_problem(&met, -2.0)?;
        let Some(impulses) = deflect_at_corners(&problem, corners, &laws)? else {
            // If the rotation angles are not reached, the impacts at stops are applied before the impulses at corners.
            self.apply_impulses(hits, &[], [Deformation::All, at_stops])?;
            return self.deflect(corners, at_corners);
        };
        self.apply(problem, &impulses.values);
        let tolerance = NEGLIGIBLE_SPEED * self.fastest_speed();
        let of_impulses = impulses.values.iter().zip(&impulses.mean_velocities);
        let of_others = of_impulses.zip(impulses.works()).skip(turned.len());
        for ((direction, law), ((impulse, velocity), work)) in
            directions.iter().zip(&laws).zip(of_others)
        {
            let leaves = *law == ImpactLaw::Held && *impulse == 0.0 && *velocity > tolerance;
            let slider = &mut self.sliders[direction.0];
            slider.book_impact_work(work);
            slider.is_pulled = leaves && !slider.stop_may_pull;
            slider.crosses_seam = false;
        }
        let of_hits = impulses.without_first(turned.len());
        self.separate_after_impact(directions.into_iter().zip(laws), &of_hits);
        Ok(())
    }

    /// Impulse of a slider on its master in the last impact [mass·length/time].
    pub(crate) fn impulse_of(&self, slider: usize) -> Vec2 {
        self.sliders[slider].impulse
    }

    /// Releases all sliders whose stop force is tensile, and returns the energy stored in the stops to these sliders.
    ///
    /// # Errors
    /// Fails if the impulses of the released sliders are undetermined.
    pub fn leave_tensile_stops(&mut self) -> Result<(), SystemError> {
        let leaving = |slider: &usize| self.sliders[*slider].is_pulled_off();
        let leaving: Vec<usize> = (0..self.sliders.len()).filter(leaving).collect();
        if leaving.is_empty() {
            return Ok(());
        }
        for slider in &leaving {
            self.sliders[*slider].change_sides(&self.bodies);
        }
        if leaving.iter().any(|slider| self.sliders[*slider].stop_energy > 0.0) {
            self.return_stop_energy().map_err(|_| self.sliders.overdetermined())?;
        }
        let time = self.motion.time;
        for slider in leaving {
            self.sliders[slider].leave_stop(&self.bodies, time);
        }
        self.motion.accelerations.mark_unknown();
        Ok(())
    }

    /// Returns the stored energy of stops to the sliders that leave the stops.
    ///
    /// The speed of each leaving slider is proportional to the square root of the energy stored in its stop.
    /// A common factor of all speeds is chosen so that the kinetic energy increases by the returned energy.
    fn return_stop_energy(&mut self) -> Result<(), LinearError> {
        let hits = self.impulse_directions(|model, limit| {
            let slider = &model.sliders[limit.slider];
            let leaves = slider.is_pulled && slider.state == SliderState::Held(limit.end);
            (leaves && slider.stop_energy > 0.0).then_some(ImpactLaw::StoredEnergy(1.0))
        });
        let directions: Vec<ImpactDirection> = hits.iter().map(|hit| hit.direction).collect();
        let stored: Vec<f64> = hits
            .iter()
            .map(|hit| match hit.law {
                ImpactLaw::StoredEnergy(_) => self.sliders[hit.direction.0].stop_energy,
                _ => 0.0,
            })
            .collect();
        let problem = self.impact_problem(&[(&directions, Deformation::All)], -2.0)?;
        let laws = |scale: f64| -> Vec<ImpactLaw> {
            let speed = |at: usize| scale * (2.0 * stored[at] * problem.response[at][at]).sqrt();
            let own = hits.iter().enumerate();
            own.map(|(at, hit)| match hit.law {
                ImpactLaw::StoredEnergy(_) => ImpactLaw::StoredEnergy(speed(at)),
                law => law,
            })
            .collect()
        };
        let given = |scale: f64| -> Result<f64, LinearError> {
            Ok(problem.impulses(&laws(scale))?.works().sum())
        };
        let wanted: f64 = stored.iter().sum();
        let (none, one, two) = (given(0.0)?, given(1.0)?, given(2.0)?);
        let square = 0.5 * (two - 2.0 * one + none);
        let linear = one - none - square;
        let root = nonnegative_root(square, linear, none - wanted);
        if let Some(scale) = root {
            let impulses = problem.impulses(&laws(scale))?;
            for (ImpactContact { direction: (slider, _), .. }, work) in
                hits.iter().zip(impulses.works())
            {
                self.sliders[*slider].book_impact_work(work);
            }
            self.apply(problem, &impulses.values);
        }
        Ok(())
    }

    pub(super) fn impulse_directions(
        &self,
        law: impl Fn(&Self, MasterLimit) -> Option<ImpactLaw>,
    ) -> Vec<ImpactContact> {
        let mut hits = Vec::new();
        for (at, slider) in self.sliders.iter().enumerate() {
            let mut limits = MasterLimit::both(at).into_iter();
            let own = limits.find_map(|limit| law(self, limit).map(|law| (limit, law)));
            let stop = match slider.state {
                SliderState::Released | SliderState::Separated => continue,
                SliderState::Sliding => own,
                SliderState::Held(end) => {
                    own.or(Some((MasterLimit { slider: at, end }, ImpactLaw::Held)))
                }
            };
            if stop.is_some() || !slider.is_compliant() {
                let across = slider.normal_to(slider.along_contact(&self.bodies));
                hits.push(ImpactContact {
                    direction: (at, across.into()),
                    law: self.law_across(at),
                });
            }
            if let Some((limit, law)) = stop {
                hits.push(ImpactContact {
                    direction: (at, self.stop_direction(limit).into()),
                    law,
                });
            }
            let couple = slider.couple_direction(&self.bodies);
            hits.extend(
                couple.map(|couple| ImpactContact {
                    direction: (at, couple),
                    law: ImpactLaw::Elastic,
                }),
            );
        }
        hits
    }
}

/// Nonnegative root of `a x² + b x + c`; `None` if no root is nonnegative.
fn nonnegative_root(a: f64, b: f64, c: f64) -> Option<f64> {
    let root = (square(b) - 4.0 * a * c).sqrt();
    // The form of the quotient depends on the sign of `b`, so that no cancellation occurs.
    let x = if b > 0.0 { -2.0 * c / (b + root) } else { (root - b) / (2.0 * a) };
    (x.is_finite() && x >= 0.0).then_some(x)
}
