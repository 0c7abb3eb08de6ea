//! A linear spring without length at ease: its force is `k` times the way between its ends, a linear law of both its components.
//!
//! Along the way it would be `k ℓ` in a direction that changes without bound where the ends meet. By components there is no direction: `U = ½ k (x² + y²)`.

use super::damping_law::DampingLaw;
use super::elongation::{Elongation, Terminal};
use super::radial_damper::RadialDamper;
use super::resistance::{Resistance, Stretched};
use super::restoring::RestoringLaw;
use super::spring_damper::SpringDamper;
use super::{Exchange, Iterate};
use crate::beams::{ForceSummary, Movement, SpanAtRest};
use crate::geometry::Vec2;
use crate::integrators::Interval;
use crate::linalg::BandedMatrix;
use crate::model::bodies::Body;

/// A spring along x and one along y, which are one; and a damper along the way, if there is one.
pub struct CentralSpring {
    along: [SpringDamper; 2],
    damper: Option<RadialDamper>,
}

impl CentralSpring {
    /// A spring of a stiffness [force/length] with a damper between two terminals, which are at these places at the start.
    pub fn new(
        name: &str,
        terminals: [Terminal; 2],
        at: [Vec2; 2],
        grounds: &[Option<Vec2>],
        stiffness: f64,
        damping: DampingLaw,
    ) -> Self {
        let law = RestoringLaw::Linear { stiffness, natural: 0.0 };
        let along = [0, 1].map(|component| {
            let elongation = Elongation::component(terminals.clone(), at, component);
            let (law, none) = ((law.clone(), 0.0), DampingLaw::default());
            SpringDamper::new(name.to_owned(), elongation, grounds.to_vec(), Some(law), none)
        });
        let damper = damping
            .acts()
            .then(|| RadialDamper::new(name.to_owned(), terminals, at, grounds, damping));
        Self { along, damper }
    }

    fn parts(&self) -> impl Iterator<Item = &dyn Resistance> {
        let along = self.along.iter().map(|part| part as &dyn Resistance);
        along.chain(self.damper.iter().map(|part| part as &dyn Resistance))
    }

    fn parts_mut(&mut self) -> impl Iterator<Item = &mut dyn Resistance> {
        let along = self.along.iter_mut().map(|part| part as &mut dyn Resistance);
        along.chain(self.damper.iter_mut().map(|part| part as &mut dyn Resistance))
    }

    fn both(&self, number: impl Fn(Stretched) -> f64) -> f64 {
        let [x, y] = [0, 1].map(|at: usize| self.along[at].stretched().map_or(0.0, &number));
        Vec2::new(x, y).norm()
    }
}

impl Resistance for CentralSpring {
    fn name(&self) -> &str {
        self.along[0].name()
    }

    fn begin_step(&mut self, interval: Interval, bodies: &[Body], rates: &[f64]) {
        self.parts_mut().for_each(|part| part.begin_step(interval, bodies, rates));
    }

    fn begin_movement(&mut self) {
        self.parts_mut().for_each(|part| part.begin_movement());
    }

    fn add_forces(&mut self, at: Iterate<'_>, out: &mut [f64]) -> ForceSummary {
        let mut summary = ForceSummary::default();
        self.parts_mut().for_each(|part| summary.join(&part.add_forces(at, out)));
        summary
    }

    fn add_linearised_forces(
        &mut self,
        at: Iterate<'_>,
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

    fn exchange(&self, bodies: &[Body], duration: f64) -> Exchange {
        let mut sum = Exchange::default();
        self.parts().for_each(|part| sum += part.exchange(bodies, duration));
        sum
    }

    fn advance(&mut self, bodies: &[Body]) {
        self.parts_mut().for_each(|part| part.advance(bodies));
    }

    fn stored(&self) -> f64 {
        self.parts().map(|part| part.stored()).sum()
    }

    fn dissipated(&self) -> f64 {
        self.parts().map(|part| part.dissipated()).sum()
    }

    fn stretched(&self) -> Option<Stretched> {
        let of_damper = self.damper.as_ref().and_then(Resistance::stretched);
        let force = self.both(|part| part.force) + of_damper.map_or(0.0, |part| part.force);
        let stiffness = self.along[0].stretched()?.stiffness;
        Some(Stretched { elongation: self.both(|part| part.elongation), force, stiffness })
    }

    fn add_forces_now(&self, bodies: &[Body], rates: &[Vec<Movement>], out: &mut [f64]) {
        self.parts().for_each(|part| part.add_forces_now(bodies, rates, out));
    }

    fn dissipation(&self, bodies: &[Body], rates: &[f64]) -> f64 {
        self.parts().map(|part| part.dissipation(bodies, rates)).sum()
    }

    fn at_rest(&self, bodies: &[Body], take: &mut dyn FnMut(&[usize], &SpanAtRest)) {
        self.parts().for_each(|part| part.at_rest(bodies, take));
    }

    fn let_go(&mut self) {
        self.parts_mut().for_each(|part| part.let_go());
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
        format!(
            "by components, as it has no length at ease: {}{}",
            self.along[0].explain(),
            damper.unwrap_or_default()
        )
    }
}
