//! Whether sliders are where they should be.

use super::Scene;
use super::ties::same_place;
use crate::beams::Station;
use crate::geometry::nearest;
use crate::joints::Slider;
use crate::model::ModelError;
use crate::model::words::{Approach, SliderError, SliderParts, written};

/// Largest distance of a slave from its master when the scene starts, relative to the length of the master and the distance
/// from the origin: a scene may be drawn in six digits, and the slave is moved onto its master exactly.
const CLOSED: f64 = 1e-6;

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
        if !(0.0..=1.0).contains(&slider.restitution) {
            let (slider, restitution) = (slider.name.clone(), slider.restitution);
            return Err(SliderError::Restitution { slider, restitution }.into());
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
        let nearest = match distance <= tolerance {
            true => Approach::On { place },
            false => Approach::Apart { place, distance },
        };
        Err(SliderError::Open { parts, from: written(from), to: written(to), gap, nearest }.into())
    }

    pub(in crate::model) fn parts(&self, slider: &Slider) -> SliderParts {
        SliderParts {
            slider: slider.name.clone(),
            slave: self.describe(&slider.slave),
            beam: self.beams[slider.master].name.clone(),
        }
    }
}
