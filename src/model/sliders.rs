//! Sliders from description to model: checks, contacts, and what a simulation may ask of them and do to them.

use super::assemble::Assembly;
use super::connection::Connection;
use super::error::ModelError;
use super::mechanism::Model;
use super::numbering::{Numbering, same_place, written};
use super::scene::Scene;
use super::sliding::{SliderState, Sliding, TrackEnd};
use crate::beams::Station;
use crate::geometry::{Passage, Vec2, corresponding, nearest};
use crate::joints::{CONTACT_UNKNOWNS, EndAction, Slider};

/// Largest distance of a slave from its master when the scene starts, relative to the length of the master and the distance
/// from the origin.
const CLOSED: f64 = 1e-9;

/// The end of a master at which a slider may arrive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TrackLimit {
    /// The slider.
    pub slider: usize,
    /// The end of its master.
    pub end: TrackEnd,
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

    pub(super) fn check_slider(&self, slider: &Slider) -> Result<(), ModelError> {
        let beam = || self.beams[slider.master].name.clone();
        let (name, slave) = (|| slider.name.clone(), || self.describe(&slider.slave));
        if slider.slave.beam() == Some(slider.master) {
            return Err(ModelError::SlidesOnItself {
                slider: name(),
                slave: slave(),
                beam: beam(),
            });
        }
        let same = |other: &&Slider| {
            other.master == slider.master && same_place(&other.slave, &slider.slave, self)
        };
        if self.sliders.iter().any(|other| same(&other)) {
            return Err(ModelError::SliderTwice { slider: name(), slave: slave(), beam: beam() });
        }
        let on_master = Station::on_beam(slider.master, slider.arc_length);
        let (from, to) = (self.drawn_at(&slider.slave)?, self.drawn_at(&on_master)?);
        let (gap, length) = ((from - to).norm(), self.beams[slider.master].axis.length());
        if gap <= CLOSED * (length + from.norm()) {
            return Ok(());
        }
        let best = self.nearest_arc_length(slider.master, &slider.slave)?;
        let nearest_point = self.drawn_at(&Station::on_beam(slider.master, best))?;
        let distance = (from - nearest_point).norm();
        let advice = if distance <= CLOSED * (length + from.norm()) {
            format!(
                "it lies on that beam at {} of its length: give that as `at`, or leave `at` out",
                best / length
            )
        } else {
            format!(
                "move one of them: the beam comes no nearer than {distance:.3e}, at {} of its length",
                best / length
            )
        };
        let where_it_is = format!(
            "is at {}, {gap:.3e} from its place {} on the beam '{}'",
            written(from),
            written(to),
            beam()
        );
        Err(ModelError::OpenSlider { slider: name(), slave: slave(), where_it_is, advice })
    }
}

impl Assembly<'_> {
    /// The contact of every slider.
    pub(super) fn sliders(&self, numbering: &Numbering) -> Result<Vec<Sliding>, ModelError> {
        let mut sliders: Vec<Sliding> = Vec::new();
        for (index, slider) in self.scene.sliders.iter().enumerate() {
            let place = self.place(&slider.slave)?;
            let slave = (place.body, place.nearest_control_point());
            let [x, ..] = numbering.degrees_of_freedom[slave.0][slave.1];
            let describe = || (slider.name.clone(), self.scene.describe(&slider.slave));
            let beam = &self.scene.beams[slider.master];
            let of_master = &numbering.degrees_of_freedom[slider.master];
            let is_unknown = x < numbering.unknowns;
            if is_unknown && of_master.iter().any(|degrees| degrees[0] == x) {
                let (slider, slave) = describe();
                return Err(ModelError::SliderTied { slider, slave, beam: beam.name.clone() });
            }
            let twice = sliders.iter().any(|other| {
                let Connection { master, slave: (body, point), .. } = other.connection;
                is_unknown
                    && master == slider.master
                    && numbering.degrees_of_freedom[body][point][0] == x
            });
            if twice {
                let (slider, slave) = describe();
                return Err(ModelError::SliderTwice { slider, slave, beam: beam.name.clone() });
            }
            let connection = Connection { master: slider.master, slave, index };
            let basis = self.meshes[slider.master].basis();
            let parameter = self.slider_parameter(slider)?;
            let passage = Passage::new(basis.clone());
            sliders.push(Sliding::new(slider, connection, passage, parameter, beam.axis.length()));
        }
        Ok(sliders)
    }

    /// The parameter of the mesh of its master at which a slider starts.
    pub(super) fn slider_parameter(&self, slider: &Slider) -> Result<f64, ModelError> {
        let beam = &self.scene.beams[slider.master];
        Station::on_beam(slider.master, slider.arc_length)
            .parameter(&beam.axis, &self.meshes[slider.master])
            .map_err(ModelError::geometry(&beam.name))
    }
}

/// The number of unknowns that the sliders of a scene add.
pub(super) fn contact_unknowns(scene: &Scene) -> usize {
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

    /// The force that a slider put on its master in the last step, the mean of the step [force]; the slave got the opposite.
    ///
    /// Zero before the first step and after a release.
    pub fn contact_force(&self, slider: usize) -> Vec2 {
        self.sliders[slider].unknowns.force
    }

    /// The place of a slider along its master as drawn: 0 at its start, 1 at its end [-].
    pub fn slider_position(&self, scene: &Scene, slider: usize) -> f64 {
        let axis = &scene.beams[self.sliders[slider].connection.master].axis;
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
        self.aim = limit.map(|limit| self.number(limit));
    }

    /// The number of a limit.
    pub fn number(&self, TrackLimit { slider, end }: TrackLimit) -> usize {
        match end {
            TrackEnd::Start => 2 * slider,
            TrackEnd::End => 2 * slider + 1,
        }
    }

    /// How far a slider is from a limit, as a part of the parameters of its master [-].
    pub fn distance_to(&self, limit: TrackLimit) -> f64 {
        let slider = &self.sliders[limit.slider];
        let (first, last) = slider.domain();
        (slider.end_parameter(limit.end) - slider.parameter).abs() / (last - first)
    }

    /// The limit of that number.
    pub fn limit(&self, number: usize) -> TrackLimit {
        let end = if number.is_multiple_of(2) { TrackEnd::Start } else { TrackEnd::End };
        TrackLimit { slider: number / 2, end }
    }

    /// Whether a slider is at a limit.
    pub fn is_at(&self, limit: TrackLimit) -> bool {
        self.sliders[limit.slider].at_end() == Some(limit.end)
    }

    /// Whether the present velocities lead beyond a limit at which a slider is.
    pub fn leads_beyond(&self, limit: TrackLimit) -> bool {
        self.sliders[limit.slider].rate(&self.bodies, &self.rates) * limit.end.outward() > 0.0
    }

    /// What a slider is to do at the ends of its master.
    pub fn end_action(&self, slider: usize) -> EndAction {
        self.sliders[slider].ends
    }

    /// Reverses the velocity of a slider along its master, as an elastic stop does: energy and momenta are kept.
    ///
    /// # Errors
    /// When the impulse is not determined.
    pub fn bounce(&mut self, slider: usize) -> Result<(), ModelError> {
        self.bounce_off(slider)
    }

    /// Lets a slider leave its master.
    pub fn release(&mut self, slider: usize) {
        self.sliders[slider].release();
    }

    /// Lets a slider rest against the stop at a limit, until the stop would have to pull.
    pub fn hold(&mut self, limit: TrackLimit) {
        self.sliders[limit.slider].state = SliderState::Held(limit.end);
    }
}
