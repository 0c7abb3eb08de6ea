//! Consistent initial kinks: the initial kink is computed from the contact force of a rigid contact (docs/theory.md, section 10.1).
//!
//! If the kink began without load, its force would oscillate between zero and twice the contact force.

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
    /// Initialises the kinks of all slow sliders in the initial configuration. A kink is a jump of the tangent of a master under the force of a slider.
    /// The contact forces are those of rigid contacts.
    ///
    /// Each slave and its master are moved apart by the deflection that the kink adds at the contact point. If this is impossible, the kink is removed.
    /// The relative velocity of a slider at an end of its master is rotated from the smooth axis onto the kinked axis.
    /// If the contact forces cannot be computed, all kinks start without load, and the first step reports this failure.
    pub(in crate::system) fn start_kinks(&mut self) -> Result<(), SystemError> {
        let (bodies, rates) = (&self.bodies, &self.motion.rates);
        let slow = |slider: &SliderContact| slider.has_kink() && slider.is_slow(bodies, rates);
        let starting: Vec<usize> =
            (0..self.sliders.len()).filter(|at| slow(&self.sliders[*at])).collect();
        if starting.is_empty() {
            return Ok(());
        }
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

    /// Starts the kinks of sliders that begin to slide at an end of their masters. Kinks have no energy at the ends of a master.
    /// The velocity of each slider relative to its master is rotated from the smooth axis onto the kinked axis, without work.
    ///
    /// # Errors
    /// Fails if the constraints do not determine the rotated velocities.
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

    /// Rotates the relative velocities of sliders at ends of masters from the smooth axis onto the kinked axis, without work.
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

    /// Moves each slave and its master apart by the deflection of the kink at the contact point.
    /// The displacement is the smallest in the norm of the inertia matrix.
    /// The result is `None` if the constraints of the contacts are linearly dependent, or if rigid links would make them nonlinear.
    fn open_gaps(&mut self) -> Option<()> {
        if !self.sliders.iter().any(|slider| slider.is_compliant()) {
            return Some(());
        }
        if self.links.count() > 0 {
            return None;
        }
        let directions: Vec<ImpactDirection> = (0..self.sliders.len())
            .flat_map(|at| [Vec2::x(), Vec2::y()].map(|unit| (at, unit.into())))
            .collect();
        let mut inertia = self.banded_inertia();
        let responses = self.impulse_responses(&inertia.factorise().ok()?, &directions);
        let count = responses.len();
        let mut matrix = BandedMatrix::zeros(count, count - 1);
        for (row, response) in responses.iter().enumerate() {
            for (column, other) in responses.iter().enumerate() {
                matrix.add(row, column, response.velocity(&other.rates));
            }
        }
        let gap =
            |(at, unit): &ImpactDirection| self.sliders[*at].gap(&self.bodies).dot(&unit.force);
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
