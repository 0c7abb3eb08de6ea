//! What the steps of a run do not resolve.

use std::f64::consts::TAU;

use super::Simulation;
use crate::integrators::Mechanism;
use crate::model::{Model, Part};
use crate::simulation::Note;
use crate::simulation::notes::{LARGEST_ROTATION, MOST_SPANS, short};
use crate::vibration::{Modes, VibrationError};

/// Steps that leave more than this part of the kinetic energy to vibration that they do not follow are too long: that of a single
/// vibration with 3.5 steps a period, which takes a fifth longer than it should.
const LARGEST_SHARE: f64 = 0.2;

/// Where motion as a whole is followed, a smaller part of its energy may be in vibration that is not,
const HIDDEN_SHARE: f64 = 0.05;

/// and that takes less than a step, by so many times [rad].
const HIDDEN_TURN: f64 = 2.0 * TAU;

/// Which part of a blow a step may be to resolve it.
const MOST_BLOWS: f64 = 0.125;

/// The modes about a scene as drawn are looked for where there are no more unknowns than this,
const MOST_UNKNOWNS: usize = 1200;

/// and so many of them at a time, until one is no free movement.
const MODES: [usize; 3] = [4, 8, 16];

/// The resolution of no more sliders is explained.
const SLIDERS: usize = 6;

impl Simulation {
    /// What the steps that led to the present do not resolve; empty when all is well. Steps that were taken back do not count.
    ///
    /// The lowest period of the scene is found the first time that there is something to tell of it.
    pub fn notes(&self) -> Vec<Note> {
        let (dt, resolution) = (self.dt(), self.model.resolution());
        let mut notes = Vec::new();
        let share = resolution.unresolved_share();
        let turn = resolution.angular_frequency() * dt;
        if share > LARGEST_SHARE || (share > HIDDEN_SHARE && turn > HIDDEN_TURN) {
            let period = TAU / resolution.angular_frequency();
            notes.push(Note::Motion { dt, share, period, lowest: self.lowest_period() });
        }
        if resolution.rotation() > LARGEST_ROTATION {
            notes.push(Note::Rotation { dt, angle: resolution.rotation() });
        }
        for (index, slider) in self.model.slider_names().enumerate() {
            let (slider, spans) = (slider.to_owned(), self.model.most_spans(index));
            if spans > MOST_SPANS {
                notes.push(Note::Way { slider: slider.clone(), dt, spans });
            }
            let blows = self.model.blows_in_a_step(index);
            if blows > MOST_BLOWS {
                notes.push(Note::Bounce { slider, dt, blows });
            }
        }
        notes
    }

    /// The lowest period of the scene as drawn; none where something slides, nothing vibrates, or the scene is large [time].
    fn lowest_period(&self) -> Option<f64> {
        self.drawn.lowest_period(|| {
            let slides = self.model.slider_names().next().is_some();
            if slides || self.model.unknowns() > MOST_UNKNOWNS {
                return None;
            }
            // Where modes are refused the note tells no period: it is about the steps, and not about the modes.
            let drawn = Model::assemble(&self.scene).ok()?;
            MODES.iter().find_map(|count| {
                let modes = match Modes::of(&drawn, *count, &mut || true) {
                    Err(VibrationError::Count { available, .. }) if available > 0 => {
                        Modes::of(&drawn, available, &mut || true)
                    }
                    found => found,
                };
                let modes = modes.ok()?;
                let vibrating = modes.all().iter().find(|mode| mode.square > 0.0)?;
                Some(vibrating.period())
            })
        })
    }

    /// How far the steps so far resolve the motion, in numbers, and what is to be told of it.
    pub(super) fn explain_resolution(&self) -> Vec<Part> {
        let resolution = self.model.resolution();
        let mut how = format!(
            "{} % of the kinetic energy in vibration that steps do not follow; sections turn by at most {} rad a step",
            short(100.0 * resolution.unresolved_share()),
            short(resolution.rotation())
        );
        for (index, slider) in self.model.slider_names().enumerate().take(SLIDERS) {
            how += &format!(
                "; '{slider}' passes at most {} spans",
                short(self.model.most_spans(index))
            );
        }
        let notes = self.notes().into_iter().map(|note| Part::used("note", note.to_string()));
        std::iter::once(Part::used("resolution", how)).chain(notes).collect()
    }
}
