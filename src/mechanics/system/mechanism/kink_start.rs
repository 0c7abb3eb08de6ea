//! Consistent starts of kinks: a kink begins with the contact force that a rigid contact transmits at that moment.
//!
//! A kink is an undamped spring `GA/g` under the slider.
//! If it began without load while the contact force acts at once, it would oscillate between zero and twice that force.
//! Derived in docs/theory.md, section 10.1.

use super::System;
use super::impact::ImpactDirection;
use super::rigidity::Deformation;
use super::seam_impact::SeamCorner;
use crate::beams::RotationIncrement;
use crate::geometry::Vec2;
use crate::linalg::BandedMatrix;
use crate::system::SystemError;
use crate::system::sliders::{KinkedAxis, SliderContact};

impl System {
    /// Starts all kinks of a scene as drawn, with the contact forces of rigid contacts at the start.
    /// Slaves and masters amid spans are moved apart by `g a`. Velocities at ends are rotated from the axis onto the kinked axis.
    ///
    /// Kinks begin without load if the contact forces are unknown, for example because a load has no value; the first step reports the reason.
    ///
    /// # Errors
    /// Fails if velocities after the rotation are not determined.
    pub(in crate::system) fn start_kinks(&mut self) -> Result<(), SystemError> {
        let (bodies, rates) = (&self.bodies, &self.motion.rates);
        let slow = |slider: &SliderContact| slider.has_kink() && slider.is_slow(bodies, rates);
        let starting: Vec<usize> =
            (0..self.sliders.len()).filter(|at| slow(&self.sliders[*at])).collect();
        if starting.is_empty() {
            return Ok(());
        }
        // Without its kink, a contact is rigid.
        let axes: Vec<Option<KinkedAxis>> =
            starting.iter().map(|at| self.sliders[*at].exchange_kinked_axis(None)).collect();
        let now = self.instant();
        for (at, axis) in starting.iter().zip(axes) {
            self.sliders[*at].exchange_kinked_axis(axis);
        }
        let Ok(now) = now else { return Ok(()) };
        for at in &starting {
            self.sliders[*at].load_kink(&self.bodies, now.contact(*at));
        }
        if self.open_gaps().is_none() {
            let compliant = starting.iter().filter(|at| self.sliders[**at].is_compliant());
            let compliant: Vec<usize> = compliant.copied().collect();
            compliant.iter().for_each(|at| self.sliders[*at].straighten());
        }
        self.rotate_onto_kinks(&starting)
    }

    /// Starts the kinks of sliders that begin to slide at an end of their masters, where kinks have no energy.
    ///
    /// # Errors
    /// Fails if velocities after the rotation are not determined.
    pub fn restart_kinks_at_ends(&mut self) -> Result<(), SystemError> {
        let (bodies, rates) = (&self.bodies, &self.motion.rates);
        let starting = |at: &usize| self.sliders[*at].is_straight_at_end(bodies, rates);
        let starting: Vec<usize> = (0..self.sliders.len()).filter(starting).collect();
        if starting.is_empty() {
            return Ok(());
        }
        let Ok(now) = self.instant() else { return Ok(()) };
        for at in &starting {
            self.sliders[*at].load_kink(&self.bodies, now.contact(*at));
        }
        self.rotate_onto_kinks(&starting)
    }

    /// Rotates the relative velocities of sliders at ends from the axis onto the kinked axis, without work. Kinks get the speeds of their sliders.
    fn rotate_onto_kinks(&mut self, starting: &[usize]) -> Result<(), SystemError> {
        let at_ends = starting.iter().filter(|at| !self.sliders[**at].is_compliant());
        let corners = at_ends.map(|&at| {
            let slider = &self.sliders[at];
            SeamCorner::new(at, slider.along(&self.bodies), slider.along_contact(&self.bodies))
        });
        let corners: Vec<SeamCorner> = corners.collect();
        self.deflect(&corners, Deformation::All).map_err(|_| self.sliders.overdetermined())?;
        for at in starting {
            self.sliders[*at].start_kink_speed(&self.bodies, &self.motion.rates);
        }
        self.motion.accelerations.mark_unknown();
        Ok(())
    }

    /// Moves slaves and masters apart by the offsets of their kinks with the smallest `Δq·M Δq`: `Δq = M⁻¹ Gᵀ P`, `G Δq = g a`.
    /// This is the mean position of an oscillation from an unloaded kink, so it does not change the later motion in the mean.
    ///
    /// `None` if contacts cannot be opened independently of each other, or if points of rigid bodies would have to follow nonlinear constraints.
    fn open_gaps(&mut self) -> Option<()> {
        if !self.sliders.iter().any(|slider| slider.is_compliant()) {
            return Some(());
        }
        if self.links.count() > 0 {
            return None;
        }
        let directions: Vec<ImpactDirection> =
            (0..self.sliders.len()).flat_map(|at| [(at, Vec2::x()), (at, Vec2::y())]).collect();
        let mut inertia = self.banded_inertia();
        let responses = self.impulse_responses(&inertia.factorise().ok()?, &directions);
        let count = responses.len();
        let mut matrix = BandedMatrix::zeros(count, count - 1);
        for (row, response) in responses.iter().enumerate() {
            for (column, other) in responses.iter().enumerate() {
                matrix.add(row, column, response.velocity(&other.rates));
            }
        }
        let gap = |(at, unit): &ImpactDirection| self.sliders[*at].gap(&self.bodies).dot(unit);
        let mut impulses: Vec<f64> = directions.iter().map(gap).collect();
        matrix.factorise().ok()?.solve(&mut impulses);
        let mut movements = vec![0.0; self.motion.rates.len()];
        for (impulse, response) in impulses.iter().zip(&responses) {
            let all = movements.iter_mut().zip(&response.rates);
            all.for_each(|(movement, rate)| *movement += impulse * rate);
        }
        self.begin_movement();
        self.bodies.gather(&movements);
        self.elements.advance(&self.bodies, RotationIncrement::Angle);
        self.bodies.advance(RotationIncrement::Angle);
        Some(())
    }
}
