//! Springs of zero natural length, whose ends may coincide.
//!
//! A linear spring of zero natural length is a pair of springs along x and y.
//! A single force along the connecting vector would change its direction infinitely fast where the ends meet.

use super::damping_law::DampingLaw;
use super::elongation::{Elongation, ElongationEnd};
use super::internal_force::{InternalForce, SpringTrialState};
use super::point_damper::PointDamper;
use super::spring_damper::SpringDamper;
use super::spring_law::SpringLaw;
use super::{Branch, OutsideLaw, ShortBounce, TrialState, WorkAndImpulse};
use crate::beams::{ForceSummary, Movement, SpanStiffness};
use crate::geometry::Vec2;
use crate::integrators::Interval;
use crate::linalg::BandedMatrix;
use crate::loads::LoadError;
use crate::system::bodies::Body;

pub struct ZeroLengthSpring {
    along: Vec<SpringDamper>,
    damper: Option<PointDamper>,
}

impl ZeroLengthSpring {
    pub fn new(
        name: &str,
        terminals: [ElongationEnd; 2],
        at: [Vec2; 2],
        grounds: &[Option<Vec2>],
        stiffness: f64,
        damping: DampingLaw,
    ) -> Self {
        let law = SpringLaw::Linear { stiffness, natural: 0.0 };
        let component = |component| {
            let elongation = Elongation::component(terminals.clone(), at, component);
            let (law, none) = ((law.clone(), 0.0), DampingLaw::default());
            SpringDamper::new(name.to_owned(), elongation, grounds.to_vec(), Some(law), none)
        };
        let along = [0, 1].map(component).into();
        Self::beside(name, along, terminals, at, grounds, damping)
    }

    /// Creates a spring between two terminals with given initial positions [length], and a damper in parallel. The spring force follows a law of the length.
    pub fn of_law(
        name: &str,
        terminals: [ElongationEnd; 2],
        at: [Vec2; 2],
        grounds: &[Option<Vec2>],
        law: (SpringLaw, f64),
        damping: DampingLaw,
    ) -> Self {
        let (elongation, none) =
            (Elongation::path_length(terminals.to_vec(), &at), DampingLaw::default());
        let along =
            SpringDamper::new(name.to_owned(), elongation, grounds.to_vec(), Some(law), none);
        Self::beside(name, vec![along], terminals, at, grounds, damping)
    }

    fn beside(
        name: &str,
        along: Vec<SpringDamper>,
        terminals: [ElongationEnd; 2],
        at: [Vec2; 2],
        grounds: &[Option<Vec2>],
        damping: DampingLaw,
    ) -> Self {
        let damper = damping
            .is_active()
            .then(|| PointDamper::new(name.to_owned(), terminals, at, grounds, damping));
        Self { along, damper }
    }

    fn parts(&self) -> impl Iterator<Item = &dyn InternalForce> {
        let along = self.along.iter().map(|part| part as &dyn InternalForce);
        along.chain(self.damper.iter().map(|part| part as &dyn InternalForce))
    }

    fn parts_mut(&mut self) -> impl Iterator<Item = &mut dyn InternalForce> {
        let along = self.along.iter_mut().map(|part| part as &mut dyn InternalForce);
        along.chain(self.damper.iter_mut().map(|part| part as &mut dyn InternalForce))
    }

    fn magnitudes(&self) -> Option<SpringTrialState> {
        let [x, y] = self.along.as_slice() else { return self.along[0].stretched() };
        let (x, y) = (x.stretched()?, y.stretched()?);
        let elongation = Vec2::new(x.elongation, y.elongation).norm();
        Some(SpringTrialState { elongation, force: Vec2::new(x.force, y.force).norm(), ..x })
    }
}

impl InternalForce for ZeroLengthSpring {
    fn name(&self) -> &str {
        self.along[0].name()
    }

    fn begin_step(
        &mut self,
        interval: Interval,
        bodies: &[Body],
        rates: &[f64],
    ) -> Result<(), LoadError> {
        self.parts_mut().try_for_each(|part| part.begin_step(interval, bodies, rates))
    }

    fn begin_movement(&mut self, bodies: &[Body]) {
        self.parts_mut().for_each(|part| part.begin_movement(bodies));
    }

    fn add_forces(&mut self, at: TrialState<'_>, out: &mut [f64]) -> ForceSummary {
        let mut summary = ForceSummary::default();
        self.parts_mut().for_each(|part| summary.join(&part.add_forces(at, out)));
        summary
    }

    fn add_linearised_forces(
        &mut self,
        at: TrialState<'_>,
        out: &mut [f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        self.parts_mut().for_each(|part| part.add_linearised_forces(at, out, unknowns, tangent));
    }

    fn add_mismatch_forces(&self, bodies: &[Body], weight: f64, out: &mut [f64]) {
        self.parts().for_each(|part| part.add_mismatch_forces(bodies, weight, out));
    }

    fn correct(&mut self, bodies: &[Body], correction: &[f64]) {
        self.parts_mut().for_each(|part| part.correct(bodies, correction));
    }

    fn exchange(&self, bodies: &[Body], duration: f64) -> WorkAndImpulse {
        let mut sum = WorkAndImpulse::default();
        self.parts().for_each(|part| sum += part.exchange(bodies, duration));
        sum
    }

    fn advance(&mut self, bodies: &[Body]) {
        self.parts_mut().for_each(|part| part.advance(bodies));
    }

    fn each_outside_law(&self, take: &mut dyn FnMut(OutsideLaw)) {
        self.parts().for_each(|part| part.each_outside_law(take));
    }

    fn stored(&self) -> f64 {
        self.parts().map(|part| part.stored()).sum()
    }

    fn dissipated(&self) -> f64 {
        self.parts().map(|part| part.dissipated()).sum()
    }

    fn stretched(&self) -> Option<SpringTrialState> {
        let of_damper = self.damper.as_ref().and_then(InternalForce::stretched);
        let spring = self.magnitudes()?;
        Some(SpringTrialState {
            force: spring.force + of_damper.map_or(0.0, |part| part.force),
            ..spring
        })
    }

    fn branch(&self, bodies: &[Body], rates: &[f64]) -> Option<Branch> {
        self.along.iter().find_map(|part| part.branch(bodies, rates))
    }

    fn short_bounce(&self) -> Option<ShortBounce> {
        self.along.iter().find_map(InternalForce::short_bounce)
    }

    fn add_forces_at_start(&self, bodies: &[Body], rates: &[Vec<Movement>], out: &mut [f64]) {
        self.parts().for_each(|part| part.add_forces_at_start(bodies, rates, out));
    }

    fn each_damped_rate(&self, bodies: &[Body], rates: &[f64], take: &mut dyn FnMut(f64, f64)) {
        self.parts().for_each(|part| part.each_damped_rate(bodies, rates, take));
    }

    fn static_stiffness(&self, bodies: &[Body], take: &mut dyn FnMut(&[usize], &SpanStiffness)) {
        self.parts().for_each(|part| part.static_stiffness(bodies, take));
    }

    fn release(&mut self) {
        self.parts_mut().for_each(|part| part.release());
    }

    fn detach(&mut self) {
        self.parts_mut().for_each(|part| part.detach());
    }

    fn attach(&mut self) {
        self.parts_mut().for_each(|part| part.attach());
    }

    fn save(&self, state: &mut Vec<f64>) {
        self.parts().for_each(|part| part.save(state));
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.parts_mut().for_each(|part| part.restore(next));
    }

    fn explain(&self) -> String {
        let damper = self.damper.as_ref().map(|damper| format!("; {}", damper.explain()));
        let by = match self.along.len() {
            1 => "",
            _ => "by components, because its natural length is 0: ",
        };
        format!("{by}{}{}", self.along[0].explain(), damper.unwrap_or_default())
    }
}
