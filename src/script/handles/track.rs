//! Handle of a track in a script.

use std::rc::Rc;

use super::scene::SceneHandle;
use crate::joints::TrackEnd;
use crate::output::significant;
use crate::script::bindings::kind::{Details, Scripted};
use crate::script::bindings::parameter_variants::ParameterSet;
use crate::script::messages::error::ScriptError;
use crate::script::presentation::details;

#[derive(Clone)]
pub struct TrackHandle {
    pub scene: SceneHandle,
    /// Index of the track in its scene, counted from 0.
    pub index: usize,
}

impl TrackHandle {
    pub fn index_in(&self, scene: &SceneHandle) -> Result<usize, ScriptError> {
        scene.expect_same(&self.scene, "track")?;
        Ok(self.index)
    }

    /// Undeformed length of the track [length].
    pub fn length(&self) -> f64 {
        self.scene.scene().borrow().track_length(self.index)
    }

    pub fn is_closed(&self) -> bool {
        self.scene.scene().borrow().tracks[self.index].end == TrackEnd::Closed
    }

    pub fn name(&self) -> String {
        self.scene.scene().borrow().tracks[self.index].name.clone()
    }
}

impl Scripted for TrackHandle {
    const NAME: &'static str = "track";
    const DOC: &'static str = "A sequence of joined beams along which sliders pass.";

    fn show(&self) -> String {
        let scene = self.scene.scene().borrow();
        let track = &scene.tracks[self.index];
        let course = match track.end {
            TrackEnd::Open => "track",
            TrackEnd::Closed => "closed track",
        };
        let beams = track.beams.len();
        format!(
            "{course} '{}' of length {} along {beams} beam{}",
            track.name,
            significant(scene.track_length(self.index), 7),
            if beams == 1 { "" } else { "s" }
        )
    }

    fn details(&self) -> Details {
        details::of_track(&self.scene.scene().borrow(), self.index)
    }

    fn parameter_set(&self) -> Option<Rc<ParameterSet>> {
        self.scene.parameter_set()
    }
}
