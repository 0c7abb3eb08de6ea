//! Handle of a joint in a script.

use std::rc::Rc;

use super::scene::SceneHandle;
use crate::script::bindings::kind::{Details, Scripted};
use crate::script::bindings::parameter_variants::ParameterSet;

#[derive(Clone)]
pub struct JointHandle {
    pub scene: SceneHandle,
    /// Index of the joint in its scene, counted from 0.
    pub index: usize,
}

impl JointHandle {
    pub fn name(&self) -> String {
        let names = self.scene.scene().borrow().joint_names();
        names.into_iter().nth(self.index).unwrap_or_default()
    }
}

impl Scripted for JointHandle {
    const NAME: &'static str = "joint";
    const DOC: &'static str = "A hinge, a rigid joint, a clamp or a support of a scene.";

    fn show(&self) -> String {
        let name = self.name();
        let scene = self.scene.scene().borrow();
        scene
            .joints
            .get(self.index)
            .map_or_else(String::new, |joint| format!("{name}: {}", joint.name))
    }

    fn details(&self) -> Details {
        Vec::new()
    }

    fn parameter_set(&self) -> Option<Rc<ParameterSet>> {
        self.scene.parameter_set()
    }
}
