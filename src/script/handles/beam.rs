//! Handle of a beam in a script.

use std::rc::Rc;

use super::scene::SceneHandle;
use crate::output::significant;
use crate::script::bindings::kind::{Details, Scripted};
use crate::script::bindings::parameter_variants::ParameterSet;
use crate::script::messages::error::ScriptError;
use crate::script::presentation::details;

#[derive(Clone)]
pub struct BeamHandle {
    pub scene: SceneHandle,
    /// Index of the beam in its scene, counted from 0.
    pub index: usize,
}

impl BeamHandle {
    pub fn index_in(&self, scene: &SceneHandle) -> Result<usize, ScriptError> {
        scene.expect_same(&self.scene, "beam")?;
        Ok(self.index)
    }

    /// Undeformed length of the beam [length].
    pub fn length(&self) -> f64 {
        self.scene.scene().borrow().beams[self.index].axis.length()
    }

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
        let chosen = if beam.mesh.is_automatic() { " (chosen from the scene)" } else { "" };
        format!(
            "beam '{}' of length {}, {}{chosen}",
            beam.name,
            significant(beam.axis.length(), 7),
            beam.mesh.describe()
        )
    }

    fn details(&self) -> Details {
        details::of_beam(&self.scene.scene().borrow(), self.index)
    }

    fn parameter_set(&self) -> Option<Rc<ParameterSet>> {
        self.scene.parameter_set()
    }
}
