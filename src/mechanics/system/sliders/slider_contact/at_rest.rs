//! Slider in statics: contact equations for a displacement between two equilibria, contact with stops, and stiffness.

use super::passing::{AtRest, Passing};
use super::{SliderContact, is_tensile};
use crate::beams::SpanStiffness;
use crate::geometry::Vec2;
use crate::joints::{
    AtStop, CONTACT_UNKNOWNS, Contact, ContactUnknowns, Equation, Released, Resting, RestingSleeve,
    RotationSlopes, SlidingLaw, Wrench,
};
use crate::system::bodies::Body;
use crate::system::sliders::master_curve::END_TOLERANCE;
use crate::system::sliders::{KinkedAxis, MasterEnd, SliderState};

impl Passing for AtRest {
    fn iterate<'s>(
        slider: &'s mut SliderContact,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
    ) -> (Contact<'s>, [Equation; CONTACT_UNKNOWNS]) {
        let (state, way) = (slider.state, slider.distance_to_stop());
        let (contact, sleeve) = slider.evaluate_static(bodies, increments, unknowns);
        let equations = match sleeve {
            Some(sleeve) => sleeve.equations(&contact),
            None => SliderContact::static_equations(state, way, &contact),
        };
        (contact, equations)
    }

    fn forces<'c>(contact: &'c Contact<'_>) -> impl Iterator<Item = Vec2> + 'c {
        contact.master_forces_at_rest()
    }

    fn slopes<'c>(contact: &'c Contact<'_>) -> impl Iterator<Item = (f64, f64, Vec2)> + 'c {
        contact.master_force_slopes_at_rest()
    }

    fn rotation_slopes(
        slider: &mut SliderContact,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
    ) -> Option<RotationSlopes> {
        let (contact, sleeve) = slider.evaluate_static(bodies, increments, unknowns);
        sleeve.map(|sleeve| sleeve.rotation_slopes(&contact))
    }

    const MOMENT_SLOPE: f64 = 1.0;

    fn chord(_contact: &Contact<'_>) -> f64 {
        1.0
    }
}

impl SliderContact {
    pub fn predict_unchanged(&self, unknowns: &mut [f64]) {
        let couple = if self.sleeve.is_some() { self.unknowns.couple } else { Vec2::zeros() };
        let guess = ContactUnknowns { force: self.force_of_state(), couple, increment: 0.0 };
        unknowns[self.connection.places()].copy_from_slice(&guess.to_array());
    }

    /// Sets a path of zero length at the position of the slider for trial values of the unknowns.
    pub(super) fn set_static_path(&mut self, unknowns: &[f64]) {
        let place = self.parameter + self.read(unknowns).increment;
        self.path.set_interval(place, place);
    }

    /// Evaluates the contact and the law of its sleeve for trial values. The law is `None` for released sliders, and for sliders that are not sleeves.
    pub(super) fn evaluate_static(
        &mut self,
        bodies: &[Body],
        movements: &[f64],
        unknowns: &[f64],
    ) -> (Contact<'_>, Option<RestingSleeve>) {
        self.set_static_path(unknowns);
        let sleeve = self.resting_sleeve(bodies, movements);
        self.before.clear();
        let unknowns = self.read(unknowns);
        (self.contact(bodies, movements, unknowns), sleeve)
    }

    pub(super) fn distance_to_stop(&self) -> Option<f64> {
        match self.state {
            SliderState::Held(end) => Some(self.master.end(end) - self.parameter),
            SliderState::Sliding | SliderState::Separated | SliderState::Released => None,
        }
    }

    fn static_equations(
        state: SliderState,
        way: Option<f64>,
        contact: &Contact<'_>,
    ) -> [Equation; CONTACT_UNKNOWNS] {
        match (state, way) {
            (SliderState::Released | SliderState::Separated, _) => Released.equations(contact),
            (_, Some(way)) => AtStop { increment: way }.equations(contact),
            (_, None) => Resting.equations(contact),
        }
    }

    pub fn passed_end(&self, unknowns: &[f64]) -> Option<MasterEnd> {
        let ends = [MasterEnd::Start, MasterEnd::End].into_iter();
        let mut beyond = ends.filter(|end| self.overshoot(unknowns, *end) > END_TOLERANCE);
        if self.is_sliding() { beyond.next() } else { None }
    }

    /// Returns true if the force of the stop is tensile beyond rounding for the given trial values.
    pub fn is_pulled(&mut self, bodies: &[Body], movements: &[f64], unknowns: &[f64]) -> bool {
        let SliderState::Held(end) = self.state else { return false };
        let (contact, sleeve) = self.evaluate_static(bodies, movements, unknowns);
        let force = contact.unknowns.force;
        let push = match sleeve {
            Some(sleeve) => sleeve.outward_push(&contact, end.outward()),
            None => contact.outward_push(end.outward()),
        };
        let push_beyond = self.seam_push(bodies, movements, force);
        self.crosses_seam = self.is_pulled_across([push, push_beyond], force.norm());
        self.crosses_seam || is_tensile(push, force.norm(), self.length)
    }

    pub fn accept_static_position(&mut self, unknowns: &[f64]) {
        let found = self.read(unknowns);
        let place = self.distance_to_stop().map_or(found.increment, |way| way);
        self.set_parameter(self.parameter + place);
        self.unknowns = ContactUnknowns { increment: 0.0, ..found };
        self.start_mean_force(Wrench { force: found.force, couple: self.couple() });
        self.kinked_axis.iter_mut().for_each(|axis| axis.set_static_kink(found.force));
    }

    pub fn movements_held(&self) -> usize {
        match (self.state, &self.sleeve) {
            (SliderState::Released | SliderState::Separated, _) => 0,
            (SliderState::Held(_), None) => 2,
            (SliderState::Held(_), Some(_)) => 3,
            (SliderState::Sliding, None) => usize::from(!self.is_compliant()),
            (SliderState::Sliding, Some(sleeve)) if sleeve.is_compliant() => 0,
            (SliderState::Sliding, Some(_)) => 2,
        }
    }

    pub fn static_coupling(&self, bodies: &[Body], own: usize) -> Vec<usize> {
        let (body, point) = self.connection.slave;
        let window = self.start_path.first()..self.start_path.first() + self.start_path.end().len();
        let of_master = &bodies[self.connection.master].degrees_of_freedom[window];
        let points = std::iter::once(&bodies[body].degrees_of_freedom[point]).chain(of_master);
        points.flat_map(|point| &point[..self.components()]).copied().chain([own]).collect()
    }

    pub fn static_stiffness(
        &self,
        bodies: &[Body],
        own: usize,
        rigid: f64,
        take: &mut dyn FnMut(&[usize], &SpanStiffness),
    ) {
        let still = SpanStiffness {
            strains: vec![1.0],
            stiffness: vec![rigid],
            ..SpanStiffness::default()
        };
        if !self.is_sliding() {
            take(&[own], &still);
        }
        if !self.state.has_contact() {
            return;
        }
        if self.sleeve.is_some() {
            return self.sleeve_stiffness(bodies, own, rigid, take);
        }
        let degrees = self.static_coupling(bodies, own);
        take(&degrees, &self.sliding_stiffness(bodies, degrees.len(), rigid));
    }

    fn sliding_stiffness(&self, bodies: &[Body], width: usize, rigid: f64) -> SpanStiffness {
        let last = width - 1;
        let force = self.force_of_state();
        let slides = if self.is_sliding() { 1.0 } else { 0.0 };
        let (compliance, slope, curvature) = self
            .kinked_axis
            .as_ref()
            .map_or((0.0, Vec2::zeros(), 0.0), KinkedAxis::static_compliance);
        let tangent = (self.tangent(bodies) + slope) * slides;
        let mut strains = vec![0.0; 2 * width];
        let (row_x, row_y) = strains.split_at_mut(width);
        for (row, (axis, component)) in
            [row_x, row_y].into_iter().zip([(0, tangent.x), (1, tangent.y)])
        {
            row[axis] = 1.0;
            for (at, value) in self.start_path.end().iter().enumerate() {
                row[2 + 2 * at + axis] = -value;
            }
            row[last] = -component;
        }
        let slope_row = |force: Vec2, curvature: f64| {
            let mut row = vec![0.0; width];
            for (at, slope) in self.start_path.slope().iter().enumerate() {
                (row[2 + 2 * at], row[3 + 2 * at]) = (-slope * force.x, -slope * force.y);
            }
            row[last] = -0.5 * (force.dot(&self.bend(bodies)) + curvature);
            row
        };
        let mut slide_row = vec![0.0; width];
        slide_row[last] = slides;
        let mut span = SpanStiffness {
            strains,
            stiffness: vec![1.0 / (compliance + 1.0 / rigid); 2],
            twists: [slope_row(force, curvature), slide_row.clone()].concat(),
            rounding_fractions: vec![0.0],
            ..SpanStiffness::default()
        };
        for (strain, axis) in [Vec2::x(), Vec2::y()].into_iter().enumerate() {
            span.add_second_derivative(strain, &slope_row(axis, 0.0), &slide_row);
        }
        span
    }
}
