//! Sliders from description to model: checks, contacts, and what a simulation may ask of them and do to them.

use serde::{Deserialize, Serialize};

use crate::beams::Station;
use crate::geometry::{Passage, Vec2, corresponding, nearest};
use crate::joints::{CONTACT_UNKNOWNS, EndAction, Slider};
use crate::model::assembly::Assembly;
use crate::model::assembly::{Numbering, same_place, written};
use crate::model::mechanism::Model;
use crate::model::scene::Scene;
use crate::model::sliders::Connection;
use crate::model::sliders::{SliderState, Sliding, TrackEnd};
use crate::model::words::ModelError;
use crate::model::words::{SliderError, SliderParts};

/// Largest distance of a slave from its master when the scene starts, relative to the length of the master and the distance
/// from the origin: a scene may be drawn in six digits, and the slave is moved onto its master exactly.
const CLOSED: f64 = 1e-6;

/// The end of a master at which a slider may arrive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct TrackLimit {
    /// The slider.
    pub slider: usize,
    /// The end of its master.
    pub end: TrackEnd,
}

impl TrackLimit {
    /// The ends of the master of a slider, in the order of their numbers.
    pub(in crate::model) fn both(slider: usize) -> [Self; 2] {
        [TrackEnd::Start, TrackEnd::End].map(|end| Self { slider, end })
    }

    /// Its number among those of all sliders.
    pub fn number(self) -> usize {
        2 * self.slider + self.end as usize
    }

    /// The limit of that number.
    pub fn of(number: usize) -> Self {
        Self::both(number / 2)[number % 2]
    }
}

impl Scene {
    /// The arc length at which a beam comes nearest to a station, both as drawn [length].
    ///
    /// # Errors
    /// When the station lies outside its beam.
    pub fn nearest_arc_length(&self, beam: usize, station: &Station) -> Result<f64, ModelError> {
        let definition = &self.beams[beam];
        let point = self.drawn_at(station)?;
        nearest(&definition.axis, point)
            .and_then(|xi| definition.axis.length_to(xi))
            .map_err(ModelError::geometry(&definition.name))
    }

    pub(in crate::model) fn check_slider(&self, slider: &Slider) -> Result<(), ModelError> {
        let parts = self.parts(slider);
        if slider.slave.beam() == Some(slider.master) {
            return Err(SliderError::OnItself(parts).into());
        }
        let is_same = |other: &Slider| {
            other.master == slider.master && same_place(&other.slave, &slider.slave, self)
        };
        if self.sliders.iter().any(is_same) {
            return Err(SliderError::Twice(parts).into());
        }
        let on_master = Station::on_beam(slider.master, slider.arc_length);
        let (from, to) = (self.drawn_at(&slider.slave)?, self.drawn_at(&on_master)?);
        let length = self.beams[slider.master].axis.length();
        let (gap, tolerance) = ((from - to).norm(), CLOSED * (length + from.norm()));
        if gap <= tolerance {
            return Ok(());
        }
        let best = self.nearest_arc_length(slider.master, &slider.slave)?;
        let distance = (from - self.drawn_at(&Station::on_beam(slider.master, best))?).norm();
        let place = best / length;
        let advice = if distance <= tolerance {
            format!(
                "it lies on that beam at {place} of its length: give that as `at`, or leave `at` out"
            )
        } else {
            format!(
                "move one of them: the beam comes no nearer than {distance:.3e}, at {place} of its length"
            )
        };
        Err(SliderError::Open { parts, from: written(from), to: written(to), gap, advice }.into())
    }

    pub(in crate::model) fn parts(&self, slider: &Slider) -> SliderParts {
        SliderParts {
            slider: slider.name.clone(),
            slave: self.describe(&slider.slave),
            beam: self.beams[slider.master].name.clone(),
        }
    }
}

impl Assembly<'_> {
    /// The contact of every slider.
    pub(in crate::model) fn sliders(
        &self,
        numbering: &Numbering,
    ) -> Result<Vec<Sliding>, ModelError> {
        let mut sliders: Vec<Sliding> = Vec::new();
        for (index, slider) in self.scene.sliders.iter().enumerate() {
            let place = self.place(&slider.slave)?;
            let slave = (place.body, place.nearest_control_point());
            let [x, ..] = numbering.degrees_of_freedom[slave.0][slave.1];
            let of_master = &numbering.degrees_of_freedom[slider.master];
            let is_unknown = x < numbering.unknowns;
            if is_unknown && of_master.iter().any(|degrees| degrees[0] == x) {
                return Err(SliderError::Tied(self.scene.parts(slider)).into());
            }
            let is_twice = |other: &Sliding| {
                let Connection { master, slave: (body, point), .. } = other.connection;
                master == slider.master && numbering.degrees_of_freedom[body][point][0] == x
            };
            if is_unknown && sliders.iter().any(is_twice) {
                return Err(SliderError::Twice(self.scene.parts(slider)).into());
            }
            let connection = Connection { master: slider.master, slave, index };
            let basis = self.meshes[slider.master].basis();
            let parameter = self.slider_parameter(slider)?;
            let passage = Passage::new(basis.clone());
            let length = self.scene.beams[slider.master].axis.length();
            sliders.push(Sliding::new(slider, connection, passage, parameter, length));
        }
        Ok(sliders)
    }

    /// The parameter of the mesh of its master at which a slider starts.
    pub(in crate::model) fn slider_parameter(&self, slider: &Slider) -> Result<f64, ModelError> {
        let beam = &self.scene.beams[slider.master];
        Station::on_beam(slider.master, slider.arc_length)
            .parameter(&beam.axis, &self.meshes[slider.master])
            .map_err(ModelError::geometry(&beam.name))
    }
}

/// The number of unknowns that the sliders of a scene add.
pub(in crate::model) fn contact_unknowns(scene: &Scene) -> usize {
    CONTACT_UNKNOWNS * scene.sliders.len()
}

impl Model {
    /// The names of the sliders, in the order of the scene.
    pub fn slider_names(&self) -> impl Iterator<Item = &str> {
        self.sliders.iter().map(|slider| slider.name.as_str())
    }

    /// What a slider does.
    pub fn slider_state(&self, slider: usize) -> SliderState {
        self.sliders[slider].state
    }

    /// The most spans of its master that a slider passed in a step so far [-].
    pub fn most_spans(&self, slider: usize) -> f64 {
        self.sliders[slider].most_spans
    }

    /// How many times as long as its blow a step was, at the bounce of a slider where that is most; zero where nothing gave way [-].
    pub fn blows_in_a_step(&self, slider: usize) -> f64 {
        self.sliders[slider].blows_in_a_step
    }

    /// The force that a slider put on its master in the last step, the mean of the step [force]; the slave got the opposite.
    ///
    /// Zero before the first step and after a release.
    pub fn contact_force(&self, slider: usize) -> Vec2 {
        self.sliders[slider].unknowns.force
    }

    /// The place of a slider along its master as drawn: 0 at its start, 1 at its end [-].
    pub fn slider_position(&self, scene: &Scene, slider: usize) -> f64 {
        let sliding = &self.sliders[slider];
        // Arrivals are a few digits short of the end, or beyond it.
        if sliding.is_at(TrackEnd::Start) {
            return 0.0;
        }
        if sliding.is_at(TrackEnd::End) {
            return 1.0;
        }
        let axis = &scene.beams[sliding.connection.master].axis;
        let along = axis.length_to(self.drawn_parameter(scene, slider));
        along.map_or(f64::NAN, |along| along / axis.length())
    }

    /// How much of its master, as drawn, a slider passes in a unit of time, positive towards its end [length/time].
    ///
    /// That of the present velocities; zero for one that is held or released.
    pub fn slider_speed(&self, scene: &Scene, slider: usize) -> f64 {
        let sliding = &self.sliders[slider];
        let axis = &scene.beams[sliding.connection.master].axis;
        let (start, end) = axis.domain();
        let (first, last) = sliding.domain();
        let drawn = axis.derivative(self.drawn_parameter(scene, slider), 1);
        let scale = drawn.map_or(f64::NAN, |drawn| drawn.norm()) * (end - start) / (last - first);
        scale * sliding.rate(&self.bodies, &self.rates)
    }

    fn drawn_parameter(&self, scene: &Scene, slider: usize) -> f64 {
        let sliding = &self.sliders[slider];
        let axis = &scene.beams[sliding.connection.master].axis;
        corresponding(sliding.parameter, sliding.domain(), axis.domain())
    }

    /// Makes steps end at a limit, or lets them go where they lead again.
    pub fn aim_at(&mut self, limit: Option<TrackLimit>) {
        self.aim = limit;
    }

    /// How far a slider is from a limit, as a part of the parameters of its master [-].
    pub fn distance_to(&self, limit: TrackLimit) -> f64 {
        self.sliders[limit.slider].distance_to(limit.end)
    }

    /// Whether a slider is at a limit.
    pub fn is_at(&self, limit: TrackLimit) -> bool {
        self.sliders[limit.slider].is_at(limit.end)
    }

    /// Whether the present velocities lead beyond a limit at which a slider is.
    pub fn leads_beyond(&self, limit: TrackLimit) -> bool {
        self.sliders[limit.slider].rate(&self.bodies, &self.rates) * limit.end.outward() > 0.0
    }

    /// What a slider is to do at the ends of its master.
    pub fn end_action(&self, slider: usize) -> EndAction {
        self.sliders[slider].ends
    }

    /// Lets a slider leave its master.
    pub fn release(&mut self, slider: usize) {
        self.sliders[slider].release();
        self.accelerations.forget();
    }

    /// Lets a slider rest against the stop at a limit, until the stop would have to pull.
    pub fn hold(&mut self, limit: TrackLimit) {
        self.sliders[limit.slider].state = SliderState::Held(limit.end);
        self.accelerations.forget();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_numbered_in_their_order() {
        let limits: Vec<TrackLimit> = (0..3).flat_map(TrackLimit::both).collect();
        for (number, limit) in limits.into_iter().enumerate() {
            assert_eq!((limit.number(), TrackLimit::of(number)), (number, limit));
        }
    }
}
