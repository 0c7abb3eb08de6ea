//! Handle of a rigid body in a script.

use std::rc::Rc;

use super::scene::SceneHandle;
use super::station::StationHandle;
use crate::beams::Station;
use crate::script::bindings::kind::{Details, Scripted};
use crate::script::bindings::parameter_variants::ParameterSet;
use crate::script::messages::error::ScriptError;
use crate::script::presentation::details;

#[derive(Clone)]
pub struct RigidBodyHandle {
    pub scene: SceneHandle,
    /// Index of the body among the rigid bodies of its scene, counted from 0.
    pub index: usize,
}

impl RigidBodyHandle {
    pub fn name(&self) -> String {
        self.scene.scene().borrow().rigid_bodies[self.index].name.clone()
    }

    pub fn centre(&self) -> StationHandle {
        StationHandle { scene: self.scene.clone(), station: Station::on_rigid_body(self.index, 0) }
    }

    pub fn point(&self, name: &str) -> Result<StationHandle, ScriptError> {
        let station = self.scene.scene().borrow().point_of_body(self.index, name)?;
        Ok(StationHandle { scene: self.scene.clone(), station })
    }
}

impl Scripted for RigidBodyHandle {
    const NAME: &'static str = "body";
    const DOC: &'static str = "A rigid body of a scene.";

    fn show(&self) -> String {
        let scene = self.scene.scene().borrow();
        let body = &scene.rigid_bodies[self.index];
        let points = body.points.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>();
        match points.is_empty() {
            true => format!("body '{}'", body.name),
            false => format!("body '{}' with points {}", body.name, points.join(", ")),
        }
    }

    fn details(&self) -> Details {
        details::of_rigid_body(&self.scene.scene().borrow(), self.index)
    }

    fn parameter_set(&self) -> Option<Rc<ParameterSet>> {
        self.scene.parameter_set()
    }
}
