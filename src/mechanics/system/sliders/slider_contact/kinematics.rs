//! Kinematics of a slider on its master.

use super::SliderContact;
use crate::geometry::{Vec2, perpendicular};
use crate::joints::Wrench;
use crate::system::bodies::Body;
use crate::system::sliders::{Connection, KinkedAxis, MasterEnd, SliderState};

impl SliderContact {
    fn weights(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        (self.start_path.first()..).zip(self.start_path.end().iter().copied())
    }

    pub(super) fn tangent(&self, bodies: &[Body]) -> Vec2 {
        slope_of(self.start_path.slope(), self.window(bodies))
    }

    /// Second derivative of the contact point on the master with respect to the parameter [length].
    pub(super) fn bend(&self, bodies: &[Body]) -> Vec2 {
        slope_of(self.start_path.change(), self.window(bodies)) * 2.0
    }

    fn window<'a>(&self, bodies: &'a [Body]) -> &'a [Vec2] {
        &bodies[self.connection.master].dynamics.control_points()[self.start_path.first()..]
    }

    /// Unit tangent of the master at the slider [-].
    pub fn along(&self, bodies: &[Body]) -> Vec2 {
        self.tangent(bodies).normalize()
    }

    /// Unit tangent of the kinked axis at the slider, for a slider at an end of its master [-].
    pub fn along_contact(&self, bodies: &[Body]) -> Vec2 {
        let kink = self.kinked_axis.as_ref().filter(|_| self.is_sliding());
        let slope = kink.map_or(Vec2::zeros(), |axis| axis.slopes().0);
        (self.tangent(bodies) + slope).normalize()
    }

    pub fn off_kink(&self, bodies: &[Body], rates: &[f64], end: MasterEnd) -> Option<[Vec2; 2]> {
        let axis =
            self.kinked_axis.as_ref().filter(|axis| self.is_sliding() && !axis.is_compliant())?;
        let velocity = self.relative_velocity(bodies, rates);
        let is_straight = axis.force() == Vec2::zeros() || velocity == Vec2::zeros();
        let axis = self.along(bodies) * end.outward();
        (!is_straight).then(|| [velocity.normalize(), axis])
    }

    /// Returns true if the slider slides on a master with a kink.
    pub fn has_kink(&self) -> bool {
        self.is_sliding() && self.kinked_axis.is_some()
    }

    /// Returns true if the slider is slow enough that the contact force may determine a new kink.
    pub fn is_slow(&self, bodies: &[Body], rates: &[f64]) -> bool {
        let rate = self.rate(bodies, rates);
        self.kinked_axis.as_ref().is_some_and(|axis| axis.is_slow(axis.speed_of(rate)))
    }

    pub fn is_straight_at_end(&self, bodies: &[Body], rates: &[f64]) -> bool {
        let axis = self.kinked_axis.as_ref().filter(|_| self.is_sliding());
        axis.is_some_and(|axis| {
            let is_straight = !axis.is_compliant() && axis.force() == Vec2::zeros();
            is_straight && axis.is_slow(axis.speed_of(self.rate(bodies, rates)))
        })
    }

    /// Initialises the kink of the master with the jump that a contact force causes [force].
    pub fn load_kink(&mut self, bodies: &[Body], force: Vec2) {
        let tangent = self.tangent(bodies);
        self.unknowns.force = force;
        self.kinked_axis.iter_mut().for_each(|axis| axis.load(force, tangent));
    }

    pub fn start_kink_speed(&mut self, bodies: &[Body], rates: &[f64]) {
        let rate = self.rate(bodies, rates);
        self.kinked_axis.iter_mut().for_each(|axis| axis.start_speed(rate));
    }

    /// Removes the kink of the master.
    pub fn straighten(&mut self) {
        self.kinked_axis.iter_mut().for_each(KinkedAxis::straighten);
    }

    pub fn across(&self, bodies: &[Body]) -> Vec2 {
        self.normal_to(self.along(bodies))
    }

    pub fn normal_to(&self, along: Vec2) -> Vec2 {
        let normal = perpendicular(along);
        self.unilateral.as_ref().map_or(normal, |contact| normal * contact.sign)
    }

    /// Adds the generalised forces of a contact impulse or a contact force on slave and master to `out`.
    /// The slave receives the impulse, and the master the opposite impulse.
    pub fn transmit(&self, bodies: &[Body], wrench: Wrench, out: &mut [f64]) {
        let Wrench { force: impulse, couple } = wrench;
        if self.couples_rotations() {
            self.transmit_couple(bodies, couple, out);
        }
        let on_master = self.start_path.end().iter().map(|weight| impulse * -*weight);
        self.connection.add_forces(bodies, impulse, self.start_path.first(), on_master, out);
    }

    /// Vector from the slave to the contact point on the master [length]; zero for a slider without contact.
    pub fn gap(&self, bodies: &[Body]) -> Vec2 {
        if !self.state.has_contact() {
            return Vec2::zeros();
        }
        self.to_axis(bodies) + self.kinked_axis.as_ref().map_or(Vec2::zeros(), KinkedAxis::offset)
    }

    /// Vector from the slave to the point of the smooth master axis at the parameter of the slider [length].
    pub(super) fn to_axis(&self, bodies: &[Body]) -> Vec2 {
        let (body, point) = self.connection.slave;
        let slave = bodies[body].dynamics.control_points()[point];
        let master = bodies[self.connection.master].dynamics.control_points();
        self.weights().map(|(index, weight)| (master[index] - slave) * weight).sum()
    }

    /// Velocity of the slave relative to the contact point on the master [length/time].
    pub fn relative_velocity(&self, bodies: &[Body], rates: &[f64]) -> Vec2 {
        let Connection { master, slave: (body, point), .. } = self.connection;
        let on_master = |(index, weight)| bodies[master].vector_at(index, rates) * weight;
        bodies[body].vector_at(point, rates) - self.weights().map(on_master).sum::<Vec2>()
    }

    /// Velocity of the slave [length/time].
    pub fn slave_velocity(&self, bodies: &[Body], rates: &[f64]) -> Vec2 {
        let (body, point) = self.connection.slave;
        bodies[body].vector_at(point, rates)
    }

    /// Acceleration and angular acceleration of the contact point on the master due to sliding [length/time², 1/time²].
    pub fn carried(&self, bodies: &[Body], rates: &[f64]) -> Wrench {
        let rate = self.rate(bodies, rates);
        let master = &bodies[self.connection.master];
        let points = master.dynamics.control_points();
        // At an end of the master, rounding errors may have moved the slider out of the parameter range of the basis.
        let (first, last) = self.master.domain();
        let within = self.parameter.clamp(first, last);
        let Ok(values) = self.start_path.basis().evaluate(within) else {
            return Wrench::default();
        };
        let turning = values.slopes().iter().zip(values.first..);
        let turning: Vec2 = turning.map(|(by, at)| master.vector_at(at, rates) * *by).sum();
        Wrench {
            force: turning * (2.0 * rate) + values.combine(2, points) * (rate * rate),
            couple: self.carried_angular_acceleration(bodies, rates, rate),
        }
    }

    /// Rate of the parameter of the slider on its master at the present velocities [1/time].
    pub fn rate(&self, bodies: &[Body], rates: &[f64]) -> f64 {
        match (self.state, &self.kinked_axis) {
            (SliderState::Sliding, Some(axis)) => {
                self.rate_at_offset(axis.offset(), axis.slopes(), bodies, rates)
            }
            (SliderState::Separated, _) => {
                let offset = -self.to_axis(bodies);
                self.rate_at_offset(offset, (Vec2::zeros(), 0.0), bodies, rates)
            }
            (SliderState::Sliding, None) => {
                let tangent = self.tangent(bodies);
                self.relative_velocity(bodies, rates).dot(&tangent) / tangent.norm_squared()
            }
            (SliderState::Held(_) | SliderState::Released, _) => 0.0,
        }
    }

    /// Rate of the parameter of the slider [1/time], from the time derivative of the contact condition.
    /// `offset` is the vector from the smooth axis of the master to the slave [length]. `slope` and `bend` contain its derivatives.
    fn rate_at_offset(
        &self,
        offset: Vec2,
        (slope, bend): (Vec2, f64),
        bodies: &[Body],
        rates: &[f64],
    ) -> f64 {
        let (points, master) = (self.window(bodies), &bodies[self.connection.master]);
        let bent = self.bend(bodies);
        let turning = self.start_path.slope().iter().zip(self.start_path.first()..);
        let turning: Vec2 = turning.map(|(by, at)| master.vector_at(at, rates) * *by).sum();
        let tangent = slope_of(self.start_path.slope(), points);
        let moved = self.relative_velocity(bodies, rates);
        let stretch = tangent.norm_squared() - offset.dot(&bent) - bend;
        (moved.dot(&(tangent + slope)) + offset.dot(&turning)) / stretch
    }
}

fn slope_of(slopes: &[f64], points: &[Vec2]) -> Vec2 {
    // The derivatives `B_i'` sum to zero, so the choice of the origin affects rounding errors only. These errors are smallest for a near origin.
    slopes.iter().zip(points).map(|(slope, point)| (point - points[0]) * *slope).sum()
}
