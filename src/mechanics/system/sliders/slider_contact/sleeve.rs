//! Sleeve without length in statics: its direction, its couple, and its stiffness.

use super::SliderContact;
use crate::beams::SpanStiffness;
use crate::elementary::square;
use crate::geometry::{ContactPath, Vec2, cross, perpendicular};
use crate::joints::{CONTACT_UNKNOWNS, MasterAtSleeve, RestingSleeve, SleeveOffset};
use crate::linalg::Border;
use crate::system::bodies::Body;
use crate::system::sliders::{Connection, Sleeve};

impl SliderContact {
    pub fn set_sleeve(&mut self, sleeve: Sleeve) {
        self.sleeve = Some(Box::new(sleeve));
    }

    /// Returns true if the contact couples rotations of master and slave.
    pub fn couples_rotations(&self) -> bool {
        self.sleeve.is_some()
    }

    /// Path of zero length at the start of a slider, from which its sleeve is created.
    pub fn start_path(&self) -> &ContactPath {
        &self.start_path
    }

    /// Couple of a sleeve on its master [force·length]; zero for other sliders.
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
        let value = |at: usize| increments.get(at).copied().unwrap_or(0.0);
        let of_master = &bodies[self.connection.master].degrees_of_freedom[self.path.first()..];
        let turned = of_master.iter().map(|[.., at]| value(*at));
        let own = value(self.rotation(bodies));
        let master = sleeve.master_at_sleeve(&self.path, turned, own);
        Some(RestingSleeve { master, stop: self.distance_to_stop() })
    }

    /// Index of the rotation of each control point of the master on the path, value of its basis function, and derivative of the value.
    fn master_rotations<'a>(
        &'a self,
        bodies: &'a [Body],
    ) -> impl Iterator<Item = (usize, f64, f64)> + 'a {
        let degrees = &bodies[self.connection.master].degrees_of_freedom[self.path.first()..];
        let weights = self.path.end().iter().zip(self.path.slope());
        degrees.iter().zip(weights).map(|([.., at], (value, slope))| (*at, *value, *slope))
    }

    /// Adds the moments of a sleeve on its master and its slave.
    pub fn add_static_moments(&mut self, bodies: &[Body], unknowns: &[f64], out: &mut [f64]) {
        if self.sleeve.is_none() || !self.state.has_contact() {
            return;
        }
        self.set_static_path(unknowns);
        let couple = self.read(unknowns).couple * self.length;
        out[self.rotation(bodies)] += couple.x + couple.y;
        for (at, value, _) in self.master_rotations(bodies) {
            out[at] -= couple.x * value;
        }
    }

    /// Adds the derivatives of the moments of a sleeve, and of its equations with respect to rotations.
    pub fn add_static_rotations(
        &mut self,
        bodies: &[Body],
        (increments, movements): (&[f64], usize),
        unknowns: &[f64],
        border: &mut Border,
    ) {
        if self.sleeve.is_none() {
            return;
        }
        let (contact, Some(law)) = self.evaluate_static(bodies, increments, unknowns) else {
            return;
        };
        let (by_sleeve, couple, length) =
            (law.slopes_by_sleeve(&contact), contact.unknowns.couple.x, contact.length);
        let along = if law.stop.is_some() { 0.0 } else { couple };
        let first = CONTACT_UNKNOWNS * self.connection.index;
        let mut add = |at: usize, forces: [f64; CONTACT_UNKNOWNS], by: [f64; CONTACT_UNKNOWNS]| {
            if at < movements {
                border.add_couplings(at, first, &forces, &by);
            }
        };
        add(self.rotation(bodies), [0.0, 0.0, length, length, 0.0], by_sleeve);
        for (at, value, slope) in self.master_rotations(bodies) {
            let by = [0.0, 0.0, -length * value, 0.0, along * slope];
            add(at, [0.0, 0.0, -length * value, 0.0, -length * couple * slope], by);
        }
    }

    /// Adds the rotations of a static solution to the rotations of the sleeve and of its master since the start.
    /// `movements` are the increments of the unknown and prescribed degrees of freedom in the solution [length, rad].
    pub fn turn_sleeve(&mut self, bodies: &[Body], movements: &[f64]) {
        let value = |at: usize| movements.get(at).copied().unwrap_or(0.0);
        let Connection { master, .. } = self.connection;
        let own = value(self.rotation(bodies));
        let turned = bodies[master].degrees_of_freedom.iter().map(|[.., at]| value(*at));
        self.sleeve.iter_mut().for_each(|sleeve| sleeve.turn(turned.clone(), own));
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
        let (by_sleeve, rotated) = offset.turned;
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
            first: 0,
            twists: self.twists(slides, of_along.len()),
            strains: [of_normal, of_along, of_angle].concat(),
            stiffness: vec![
                normal,
                soft(axial[0], rigid),
                soft(rotation[0] - ratio * coupling[0], rigid_angle),
            ],
            kinds: Vec::new(),
            rounding_fractions: vec![0.0; 2],
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
        by_sleeve[2] = -0.5 * cross(offset.turned.0, force);
        by_sleeve[width + 2] = 1.0;
        twists
    }
}
