//! Waves that run through beams from where something strikes: how long a blow lasts, which bounces must resolve.

use crate::elementary::square;
use crate::geometry::Vec2;
use crate::model::mechanism::Blow;
use crate::model::{Model, Scene};

impl Scene {
    /// The speed of the fastest axial wave; zero where there are no beams [length/time].
    pub(in crate::model) fn fastest_wave(&self) -> f64 {
        let squares = self
            .beams
            .iter()
            .map(|beam| beam.section.axial_stiffness / beam.section.mass_per_length);
        squares.fold(0.0, f64::max).sqrt()
    }

    /// The time that a wave takes through a beam from a blow at such an angle to its axis [time], of which the cosine is given, if
    /// what strikes it does not come to rest sooner: with its mass, where it has one, in the time `m/(c ρA)`.
    ///
    /// Along the axis it is an axial wave, across it one of shear: `c² ρA = EA cos²α + GA sin²α`.
    fn answer_time(&self, beam: usize, cosine: f64, mass: Option<f64>) -> f64 {
        let (length, section) = (self.beams[beam].axis.length(), &self.beams[beam].section);
        let along = square(cosine).min(1.0);
        let stiffness = section.axial_stiffness * along + section.shear_stiffness * (1.0 - along);
        let speed = (stiffness / section.mass_per_length).sqrt();
        mass.map_or(length, |mass| length.min(mass / section.mass_per_length)) / speed
    }
}

impl Model {
    /// Takes down how many times as long as a blow at the end of a master the steps are [time].
    ///
    /// A blow on a beam lasts at least until its wave has come back, twice the length over `c` (Saint-Venant 1883), or, on a light
    /// slave, until that has come to rest, which takes some `m/(c ρA)`. Where nothing gives way, there is no wave to resolve.
    pub fn note_blow(&mut self, scene: &Scene, slider: usize, blow: Blow, dt: f64) {
        let sliding = &self.sliders[slider];
        let (body, point) = sliding.connection.slave;
        let is_beam = body < scene.beams.len();
        let on_master = blow.master.is_some().then(|| {
            // A beam that strikes is no heavier than its waves let it be at once.
            let mass = blow.slave.filter(|_| !is_beam);
            scene.answer_time(sliding.connection.master, 1.0, mass)
        });
        let on_slave = (blow.slave.is_some() && is_beam).then(|| {
            let points = self.bodies[body].dynamics.control_points();
            let axis = points[(point + 1).min(points.len() - 1)] - points[point.saturating_sub(1)];
            scene.answer_time(body, cosine(axis, sliding.tangent(&self.bodies)), None)
        });
        let lasts = 2.0 * on_master.into_iter().chain(on_slave).fold(f64::INFINITY, f64::min);
        let kept = &mut self.sliders[slider].blows_in_a_step;
        *kept = kept.max(dt / lasts);
    }
}

fn cosine(a: Vec2, b: Vec2) -> f64 {
    a.dot(&b) / (a.norm() * b.norm())
}
