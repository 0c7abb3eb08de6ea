//! Sleeve without length: its moments, its direction of couples, and its stiffness in statics.

use super::SliderContact;
use crate::beams::SpanStiffness;
use crate::elementary::square;
use crate::geometry::{ContactPath, Vec2, cross, perpendicular};
use crate::joints::{
    CONTACT_UNKNOWNS, MasterAtSleeve, RestingSleeve, RotationSlopes, SleeveOffset, SleeveRotations,
    Wrench,
};
use crate::linalg::Border;
use crate::system::bodies::Body;
use crate::system::sliders::Sleeve;

/// Entry of an array of increments or rates; zero for a fixed degree of freedom, which has no entry.
fn value(values: &[f64], at: usize) -> f64 {
    values.get(at).copied().unwrap_or(0.0)
}

impl SliderContact {
    pub fn set_sleeve(&mut self, sleeve: Sleeve) {
        self.sleeve = Some(Box::new(sleeve));
    }

    /// Returns true if the contact couples rotations of master and slave.
    pub fn couples_rotations(&self) -> bool {
        self.sleeve.is_some()
    }

    /// Path of zero length at the position of the slider at the start of a step. The assembly creates the sleeve from this path.
    pub fn start_path(&self) -> &ContactPath {
        &self.start_path
    }

    /// Couple of a sleeve on its master in the last substep [force·length]; zero for other sliders.
    pub fn couple(&self) -> f64 {
        if self.sleeve.is_some() { self.unknowns.couple.x * self.length } else { 0.0 }
    }

    fn rotation(&self, bodies: &[Body]) -> usize {
        let (body, point) = self.connection.slave;
        bodies[body].degrees_of_freedom[point][2]
    }

    /// Law of the sleeve on the present path; `None` for sliders that are not sleeves, and for released ones.
    pub(super) fn resting_sleeve(
        &self,
        bodies: &[Body],
        increments: &[f64],
    ) -> Option<RestingSleeve> {
        let sleeve = self.sleeve.as_ref().filter(|_| self.state.has_contact())?;
        let turned = self.master_rotations(bodies, &self.path).map(|at| value(increments, at));
        let own = value(increments, self.rotation(bodies));
        let master = sleeve.master_at_sleeve(&self.path, turned, own);
        Some(RestingSleeve { master, stop: self.distance_to_stop() })
    }

    /// Rotations of a sleeve and its master for trial values, on the present path; `None` for sliders that are not sleeves.
    pub(super) fn sleeve_rotations(
        &self,
        bodies: &[Body],
        increments: &[f64],
    ) -> Option<SleeveRotations> {
        let sleeve = self.sleeve.as_ref()?;
        let turned = self.master_rotations(bodies, &self.path).map(|at| value(increments, at));
        Some(sleeve.in_step(&self.path, turned, value(increments, self.rotation(bodies))))
    }

    /// Index of the rotation of each control point of the master on a path, and of the control points behind it.
    fn master_rotations<'a>(
        &self,
        bodies: &'a [Body],
        path: &ContactPath,
    ) -> impl Iterator<Item = usize> + use<'a> {
        let of_master = &bodies[self.connection.master].degrees_of_freedom[path.first()..];
        of_master.iter().map(|[.., at]| *at)
    }

    /// Adds the moments of a sleeve on its master and its slave, for given moments divided by the length of the contact [force].
    pub(super) fn add_moments(&self, bodies: &[Body], couple: Vec2, out: &mut [f64]) {
        if self.sleeve.is_none() || !self.state.has_contact() {
            return;
        }
        let couple = couple * self.length;
        out[self.rotation(bodies)] += couple.x + couple.y;
        for (at, weight) in self.master_rotations(bodies, &self.path).zip(self.path.mean()) {
            out[at] -= couple.x * weight;
        }
    }

    /// Adds the derivatives of the moments of a sleeve, and of its equations with respect to rotations.
    /// `by_slope` is the derivative of a moment on the master by the slope of its weight, divided by the length of the contact [force].
    pub(super) fn add_rotations(
        &self,
        bodies: &[Body],
        slopes: Option<RotationSlopes>,
        (by_slope, movements): (f64, usize),
        border: &mut Border,
    ) {
        let Some(RotationSlopes { by_slave, by_end, by_increment_slope }) = slopes else { return };
        let (first, length) = (CONTACT_UNKNOWNS * self.connection.index, self.length);
        let mut add = |at: usize, forces: [f64; CONTACT_UNKNOWNS], by: [f64; CONTACT_UNKNOWNS]| {
            if at < movements {
                border.add_couplings(at, first, &forces, &by);
            }
        };
        add(self.rotation(bodies), [0.0, 0.0, length, length, 0.0], by_slave);
        let weights = self.path.mean().iter().zip(self.path.slope());
        let weights = weights.zip(self.path.end().iter().zip(self.path.difference()));
        let of_master = self.master_rotations(bodies, &self.path);
        for (at, ((mean, slope), (end, difference))) in of_master.zip(weights) {
            let forces = [0.0, 0.0, -length * mean, 0.0, -length * by_slope * slope];
            let by =
                std::array::from_fn(|row| by_end[row] * end + by_increment_slope[row] * difference);
            add(at, forces, by);
        }
    }

    /// Adds the rotations of a step or a static solution to the rotations of the sleeve and of its master since the start.
    /// `movements` are the increments of the unknown and prescribed degrees of freedom [length, rad].
    pub fn rotate_sleeve(&mut self, bodies: &[Body], movements: &[f64]) {
        if self.sleeve.is_none() {
            return;
        }
        let own = value(movements, self.rotation(bodies));
        let of_master = bodies[self.connection.master].degrees_of_freedom.iter();
        let turned = of_master.map(|[.., at]| value(movements, *at));
        self.sleeve.iter_mut().for_each(|sleeve| sleeve.rotate(turned.clone(), own));
    }

    /// Couple and force of a unit impulse of a sleeve against a difference of rotations; `None` for other sliders and released sleeves.
    /// The wrench is that of a force with the length of the master as its arm, so that it has the unit of a force [-, length].
    pub fn couple_direction(&self, bodies: &[Body]) -> Option<Wrench> {
        let sleeve = self.sleeve.as_ref().filter(|_| self.state.has_contact())?;
        let arm = self.master.length();
        if !self.is_sliding() {
            return Some(Wrench { force: Vec2::zeros(), couple: arm });
        }
        let (tangent, [slope, _]) = (self.tangent(bodies), sleeve.slopes(&self.start_path));
        let force = tangent * (-arm * slope / tangent.norm_squared());
        Some(Wrench { force, couple: arm })
    }

    /// Angular acceleration of the section of the master at the sleeve due to sliding at a rate of the parameter [1/time].
    pub(super) fn carried_angular_acceleration(
        &self,
        bodies: &[Body],
        rates: &[f64],
        rate: f64,
    ) -> f64 {
        let Some(sleeve) = &self.sleeve else { return 0.0 };
        let of_master = self.master_rotations(bodies, &self.start_path);
        let slopes = self.start_path.slope().iter().zip(of_master);
        let turning: f64 = slopes.map(|(slope, at)| slope * value(rates, at)).sum();
        let [_, change] = sleeve.slopes(&self.start_path);
        2.0 * rate * turning + square(rate) * change
    }

    /// Angle of a sleeve minus that of its master, relative to the initial difference [rad]; zero for other sliders.
    pub fn rotation_gap(&self) -> f64 {
        let sleeve = self.sleeve.as_ref().filter(|_| self.state.has_contact());
        sleeve.map_or(0.0, |sleeve| sleeve.gap(&self.start_path))
    }

    /// Removes the compliance that the mesh of the master of a sleeve does not represent.
    pub fn neglect_compliance(&mut self) {
        self.sleeve.iter_mut().for_each(|sleeve| sleeve.neglect_compliance());
    }

    /// Adds a couple on the slave, and the opposite couple on the master.
    pub(super) fn transmit_couple(&self, bodies: &[Body], couple: f64, out: &mut [f64]) {
        out[self.rotation(bodies)] += couple;
        let of_master = self.master_rotations(bodies, &self.start_path);
        for (at, weight) in of_master.zip(self.start_path.end()) {
            out[at] -= couple * weight;
        }
    }

    /// Passes the stiffness of the contact of a sleeve, with its forces eliminated, to `take`.
    pub(super) fn sleeve_stiffness(
        &self,
        bodies: &[Body],
        own: usize,
        rigid: f64,
        take: &mut dyn FnMut(&[usize], &SpanStiffness),
    ) {
        let Some(sleeve) = &self.sleeve else { return };
        let turned = std::iter::repeat(0.0);
        let master = sleeve.master_at_sleeve(&self.start_path, turned, 0.0);
        let rows = StiffnessRows { slider: self, bodies, master };
        take(&self.static_coupling(bodies, own), &rows.stiffness(rigid));
    }
}

/// Rows of the stiffness of a sleeve. The entries of a row belong to x, y and rotation of the slave,
/// then of the control points of the master, and to the sliding increment.
struct StiffnessRows<'a> {
    slider: &'a SliderContact,
    bodies: &'a [Body],
    master: MasterAtSleeve,
}

impl StiffnessRows<'_> {
    /// Row of a component of the gap: of the displacement along `axis`, or of the rotation if `turns` is one.
    fn row(&self, axis: Vec2, turns: f64, [by_sleeve, by_way]: [f64; 2]) -> Vec<f64> {
        let mut row = vec![axis.x, axis.y, turns - by_sleeve];
        let values = self.slider.start_path.end();
        row.extend(values.iter().flat_map(|n| [-n * axis.x, -n * axis.y, -n * turns]));
        row.push(-by_way);
        row
    }

    fn stiffness(&self, rigid: f64) -> SpanStiffness {
        let MasterAtSleeve { along, transverse, coupling, rotation, axial, slopes, .. } =
            self.master;
        let slides = if self.slider.is_sliding() { 1.0 } else { 0.0 };
        let [offset, change] = [0, 1].map(|order| self.offset(order));
        let by_way = (self.slider.tangent(self.bodies) + change.displacement) * slides;
        let (by_sleeve, rotated) = offset.by_angle;
        let of_axis = |axis: Vec2| self.row(axis, 0.0, [by_sleeve.dot(&axis), by_way.dot(&axis)]);
        let [of_normal, of_along] = [perpendicular(along), along].map(of_axis);
        let soft = |compliance: f64, rigid: f64| 1.0 / (compliance.max(0.0) + 1.0 / rigid);
        let normal = soft(transverse[0], rigid);
        let ratio = if transverse[0] > 0.0 { coupling[0] * normal } else { 0.0 };
        let by_angle = [rotated, slides * (slopes[0] + change.rotation)];
        let of_angle = self.row(Vec2::zeros(), 1.0, by_angle);
        let of_angle = of_angle.iter().zip(&of_normal).map(|(a, n)| a - ratio * n).collect();
        let rigid_angle = rigid * square(self.slider.size);
        SpanStiffness {
            twists: self.twists(slides, of_along.len()),
            strains: [of_normal, of_along, of_angle].concat(),
            stiffness: vec![
                normal,
                soft(axial[0], rigid),
                soft(rotation[0] - ratio * coupling[0], rigid_angle),
            ],
            rounding_fractions: vec![0.0; 2],
            ..SpanStiffness::default()
        }
    }

    fn offset(&self, order: usize) -> SleeveOffset {
        self.master.offset((self.slider.force_of_state(), self.slider.couple()), order)
    }

    /// Pairs of rows `p` and `q` of the geometric stiffness `p qᵀ + q pᵀ`. The rows `q` select the sliding increment and the rotation of the slave.
    fn twists(&self, slides: f64, width: usize) -> Vec<f64> {
        let (force, moment) = (self.slider.force_of_state(), self.slider.couple());
        let [offset, change, second] = [0, 1, 2].map(|order| self.offset(order));
        let bent = force.dot(&self.slider.bend(self.bodies)) + moment * self.master.slopes[1];
        let energy = 0.5 * (force.dot(&second.displacement) + moment * second.rotation);
        let mut twists = vec![0.0; 4 * width];
        let (by_way, by_sleeve) = twists.split_at_mut(2 * width);
        for (at, slope) in self.slider.start_path.slope().iter().enumerate() {
            by_way[3 + 3 * at..][..3]
                .copy_from_slice(&[force.x, force.y, moment].map(|f| -slope * f));
        }
        by_way[2] = -cross(change.displacement, force);
        by_way[width - 1] = -0.5 * (bent + energy);
        by_way[2 * width - 1] = slides;
        by_sleeve[2] = -0.5 * cross(offset.by_angle.0, force);
        by_sleeve[width + 2] = 1.0;
        twists
    }
}
