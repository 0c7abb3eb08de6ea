//! Unilateral contact of a slider, which can leave its master: flight, landing and take-off.

use super::SliderContact;
use crate::geometry::{Vec2, cross};
use crate::joints::ContactUnknowns;
use crate::system::bodies::Body;
use crate::system::sliders::SliderState;
use crate::system::sliders::master_curve::END_TOLERANCE;

/// Largest number of take-offs, landings and passages of the axis since the last step without such an event.
const MOST_EVENTS: usize = 4;

const MOST_ITERATIONS: usize = 64;

/// Largest change of the parameter in an iteration of `nearest_point`, as a fraction of the parameter range.
const LARGEST_CHANGE: f64 = 0.125;

/// Smallest second derivative of the squared distance that `nearest_point` uses, as a fraction of the value for a straight master.
const SMALLEST_CURVATURE: f64 = 0.5;

/// Largest cosine of the angle between the axis and the vector to the slave for a slave that is not beyond an end of the master.
const BEYOND: f64 = 1e-9;

/// Event in which the state of a unilateral contact of a slider changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactChange {
    /// The slider left its master.
    TakeOff,
    /// The slider landed on its master, and is in contact with it.
    Landing,
    /// The slider struck its master and rebounded.
    Bounce,
    /// The slider crossed the extension of the axis of its master beyond an end, without contact.
    Passage,
}

/// State of a unilateral contact of a slider: its side of the master, the nearest point of the master, and recent events.
#[derive(Debug, Clone)]
pub struct UnilateralContact {
    /// Side of the master on which the slider can fly: 1 for the left side of the axis, -1 for the right side.
    pub sign: f64,
    nearest: NearestPoint,
    may_land: bool,
    events: usize,
    /// Number of attempted steps in which the slider stayed in contact because of too many take-offs and landings.
    pub kept_steps: usize,
    change: Option<ContactChange>,
}

#[derive(Debug, Clone, Copy, Default)]
pub struct NearestPoint {
    parameter: f64,
    /// Distance of the slave from the axis along the normal [length], positive on the side on which the slider can fly.
    pub gap: f64,
    /// True if the slave is not beyond an end of the master.
    pub is_inside: bool,
}

impl UnilateralContact {
    pub fn new(sign: f64) -> Self {
        let nearest = NearestPoint::default();
        Self { sign, nearest, may_land: true, events: 0, kept_steps: 0, change: None }
    }

    /// Numbers that `restore` reads: 1 if the slider may land and 0 otherwise, and the number of events.
    pub(super) fn numbers(&self) -> [f64; 2] {
        [f64::from(u8::from(self.may_land)), self.events as f64]
    }

    pub(super) fn restore(&mut self, [may_land, events]: [f64; 2]) {
        (self.may_land, self.events) = (may_land != 0.0, events as usize);
    }
}

impl SliderContact {
    pub fn is_separated(&self) -> bool {
        self.state == SliderState::Separated
    }

    /// Returns true if the contact of the slider is unilateral and closed.
    pub fn may_take_off(&self) -> bool {
        self.is_sliding() && self.unilateral.is_some()
    }

    /// Returns true if there were at least `MOST_EVENTS` take-offs, landings and passages since the last step without such an event.
    pub fn has_many_events(&self) -> bool {
        self.unilateral.as_ref().is_some_and(|contact| contact.events >= MOST_EVENTS)
    }

    pub fn clear_events(&mut self) {
        self.unilateral.iter_mut().for_each(|contact| contact.events = 0);
    }

    pub fn count_kept_step(&mut self) {
        self.unilateral.iter_mut().for_each(|contact| contact.kept_steps += 1);
    }

    /// Starts a flight of the slider and sets the contact force to zero.
    pub fn take_off(&mut self) {
        self.state = SliderState::Separated;
        self.unknowns = ContactUnknowns::zeros();
        if let Some(contact) = &mut self.unilateral {
            (contact.may_land, contact.events) = (true, contact.events + 1);
            contact.change = Some(ContactChange::TakeOff);
        }
    }

    /// Returns the take-off, landing or passage since the last call. A slider that is still in flight after a landing has bounced.
    pub fn take_contact_change(&mut self) -> Option<ContactChange> {
        let change = self.unilateral.as_mut()?.change.take()?;
        let has_bounced = change == ContactChange::Landing && self.is_separated();
        Some(if has_bounced { ContactChange::Bounce } else { change })
    }

    /// Ends a flight of the slider. The slider then slides along its master.
    pub fn start_contact(&mut self) {
        self.state = SliderState::Sliding;
    }

    pub fn record_landing(&mut self) {
        if let Some(contact) = &mut self.unilateral {
            (contact.may_land, contact.events) = (true, contact.events + 1);
            contact.change = Some(ContactChange::Landing);
        }
    }

    /// Records that the slave passed the axis of its master beyond an end. The slider then may not land from the other side.
    pub fn record_passage(&mut self) {
        if let Some(contact) = &mut self.unilateral {
            (contact.may_land, contact.events) = (false, contact.events + 1);
            contact.change = Some(ContactChange::Passage);
        }
    }

    /// Finds the point of the master that is nearest to the slave, after the given increments of all bodies.
    /// Newton's method starts at the present parameter of the slider. If `increments` is empty, the bodies are in their present configuration.
    /// A call of `nearest_point` overwrites the path of the slider.
    pub fn nearest_point(&mut self, bodies: &[Body], increments: &[f64]) -> NearestPoint {
        let sign = self.unilateral.as_ref().map_or(1.0, |contact| contact.sign);
        let (first, last) = self.master.domain();
        let range = last - first;
        let mut parameter = self.parameter.clamp(first, last);
        let mut at = self.offset_and_derivatives(bodies, increments, parameter);
        for _ in 0..MOST_ITERATIONS {
            let [to_axis, tangent, bend] = at;
            let straight = tangent.norm_squared();
            let curvature = straight + to_axis.dot(&bend);
            let change = -to_axis.dot(&tangent) / curvature.max(SMALLEST_CURVATURE * straight);
            let most = LARGEST_CHANGE * range;
            let next = (parameter + change.clamp(-most, most)).clamp(first, last);
            let is_found = (next - parameter).abs() <= END_TOLERANCE * range;
            parameter = next;
            at = self.offset_and_derivatives(bodies, increments, parameter);
            if is_found {
                break;
            }
        }
        let [to_axis, tangent, _] = at;
        let is_at_end = parameter == first || parameter == last;
        let is_beyond = to_axis.dot(&tangent).abs() > BEYOND * to_axis.norm() * tangent.norm();
        NearestPoint {
            parameter,
            gap: -sign * cross(tangent.normalize(), to_axis),
            is_inside: !(is_at_end && is_beyond),
        }
    }

    /// Vector from the slave to a point of the master, and its first and second derivative with respect to the parameter [length].
    fn offset_and_derivatives(
        &mut self,
        bodies: &[Body],
        increments: &[f64],
        parameter: f64,
    ) -> [Vec2; 3] {
        self.path.set_interval(parameter, parameter);
        let (body, point) = self.connection.slave;
        let (slave, master) = (&bodies[body], &bodies[self.connection.master]);
        let (origin, cut_off) = slave.precise_point(point);
        let moved = slave.vector_at(point, increments);
        let from_slave = |index: usize| {
            let (position, remainder) = master.precise_point(index);
            let movement = master.vector_at(index, increments) - moved;
            (position - origin) + (remainder - cut_off) + movement
        };
        let path = &self.path;
        let sum = |weights: &[f64]| -> Vec2 {
            weights.iter().zip(path.first()..).map(|(by, at)| from_slave(at) * *by).sum()
        };
        [sum(path.end()), sum(path.slope()), sum(path.change()) * 2.0]
    }

    pub(super) fn follow_master(&mut self, bodies: &[Body], increments: &[f64]) {
        if !self.is_separated() {
            return;
        }
        let nearest = self.nearest_point(bodies, increments);
        self.unilateral.iter_mut().for_each(|contact| contact.nearest = nearest);
    }

    /// Moves a slider in flight to the nearest point of its master in the present configuration.
    pub fn move_to_nearest_point(&mut self, bodies: &[Body]) {
        self.follow_master(bodies, &[]);
        self.accept_flight();
    }

    pub(super) fn accept_flight(&mut self) {
        let tolerance = self.touching_distance();
        if let Some(contact) =
            self.unilateral.as_mut().filter(|_| self.state == SliderState::Separated)
        {
            contact.may_land = contact.nearest.gap >= -tolerance;
            let parameter = contact.nearest.parameter;
            self.set_parameter(parameter);
        }
    }

    /// Largest distance of the slave from the axis that counts as zero [length].
    fn touching_distance(&self) -> f64 {
        END_TOLERANCE * self.size
    }

    /// Distance of a landing slave beyond the axis, as a fraction of the contact's length scale [-]; `None` without a landing.
    pub fn depth_at_landing(&self) -> Option<f64> {
        let contact = self.unilateral.as_deref().filter(|_| self.is_separated())?;
        let NearestPoint { gap, is_inside, .. } = contact.nearest;
        let lands = contact.may_land && is_inside && gap < -self.touching_distance();
        lands.then_some(-gap / self.size)
    }

    /// Distance of a slave in flight beyond the axis at the end of the attempted step, as a fraction of the contact's length scale [-].
    /// Before the slave reaches the axis, the distance is negative. On the axis within rounding, the distance is `None`.
    pub fn signed_depth(&self) -> Option<f64> {
        let contact = self.unilateral.as_deref().filter(|_| self.is_separated())?;
        let gap = contact.nearest.gap;
        (gap.abs() > self.touching_distance()).then_some(-gap / self.size)
    }

    /// Present distance of the slave from the axis, as a fraction of the length scale of the contact [-].
    pub fn relative_gap(&mut self, bodies: &[Body]) -> f64 {
        self.nearest_point(bodies, &[]).gap / self.size
    }

    /// Distance of the slave from the axis at the end of the last step [length]; `None` for a slider that never leaves its master.
    pub fn flight_gap(&self, bodies: &[Body]) -> Option<f64> {
        let contact = self.unilateral.as_deref()?;
        let to_axis = self.to_axis(bodies);
        let distance = -contact.sign * cross(self.along(bodies), to_axis);
        Some(if self.is_separated() { distance.signum() * to_axis.norm() } else { 0.0 })
    }
}
