//! A beam of a scene that a script holds.

use std::rc::Rc;

use super::scene::SceneHandle;
use crate::output::significant;
use crate::script::bindings::kind::{Details, Scripted};
use crate::script::bindings::parameter_variants::ParameterSet;
use crate::script::messages::error::ScriptError;
use crate::script::presentation::details;

/// A handle on a beam of a scene.
#[derive(Clone)]
pub struct BeamHandle {
    /// The scene that the beam is in.
    pub scene: SceneHandle,
    /// The index of the beam among those of its scene, from 0.
    pub index: usize,
}

impl BeamHandle {
    /// The index of the beam, if it is one of the given scene.
    pub fn own(&self, scene: &SceneHandle) -> Result<usize, ScriptError> {
        scene.expect_same(&self.scene, "beam")?;
        Ok(self.index)
    }

    /// The length of the beam as drawn [length].
    pub fn length(&self) -> f64 {
        self.scene.scene().borrow().beams[self.index].axis.length()
    }

    /// The name of the beam.
    pub fn name(&self) -> String {
        self.scene.scene().borrow().beams[self.index].name.clone()
    }
}

impl Scripted for BeamHandle {
    const NAME: &'static str = "beam";
    const DOC: &'static str = "A flexible beam of a scene.";

    fn show(&self) -> String {
        let scene = self.scene.scene().borrow();
        let beam = &scene.beams[self.index];
        format!(
            "beam '{}' of length {}, {}",
            beam.name,
            significant(beam.axis.length(), 7),
            beam.mesh.describe()
        )
    }

    fn details(&self) -> Details {
        details::of_beam(&self.scene.scene().borrow(), self.index)
    }

    fn family(&self) -> Option<Rc<ParameterSet>> {
        self.scene.family()
    }
}
