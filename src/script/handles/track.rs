//! A track of a scene that a script holds.

use std::rc::Rc;

use super::scene::SceneHandle;
use crate::joints::TrackEnd;
use crate::output::significant;
use crate::script::bindings::kind::{Details, Scripted};
use crate::script::bindings::parameter_variants::ParameterSet;
use crate::script::messages::error::ScriptError;
use crate::script::presentation::details;

/// A handle on a track of a scene.
#[derive(Clone)]
pub struct TrackHandle {
    /// The scene that the track is in.
    pub scene: SceneHandle,
    /// The index of the track among those of its scene, from 0.
    pub index: usize,
}

impl TrackHandle {
    /// The index of the track, if it is one of the given scene.
    pub fn own(&self, scene: &SceneHandle) -> Result<usize, ScriptError> {
        scene.expect_same(&self.scene, "track")?;
        Ok(self.index)
    }

    /// The length of the track as drawn [length].
    pub fn length(&self) -> f64 {
        self.scene.scene().borrow().track_length(self.index)
    }

    /// Whether the track goes on along its first beam behind its last one.
    pub fn is_closed(&self) -> bool {
        self.scene.scene().borrow().tracks[self.index].course == TrackEnd::Closed
    }

    /// The name of the track.
    pub fn name(&self) -> String {
        self.scene.scene().borrow().tracks[self.index].name.clone()
    }
}

impl Scripted for TrackHandle {
    const NAME: &'static str = "track";
    const DOC: &'static str = "Beams of a scene, one after the other, along which sliders pass.";

    fn show(&self) -> String {
        let scene = self.scene.scene().borrow();
        let track = &scene.tracks[self.index];
        let course = match track.course {
            TrackEnd::Open => "track",
            TrackEnd::Closed => "closed track",
        };
        let beams = track.legs.len();
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

    fn family(&self) -> Option<Rc<ParameterSet>> {
        self.scene.family()
    }
}
