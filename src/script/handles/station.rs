//! Handle of a station in a script: a point of a beam, point mass or rigid body.

use std::cell::RefCell;
use std::rc::Rc;

use rhai::Dynamic;

use super::rigid_body::RigidBodyHandle;
use super::scene::SceneHandle;
use super::simulation::SimulationHandle;
use crate::beams::{self, BodyIndex, Mesh, Station};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Scripted};
use crate::script::bindings::parameter_variants::ParameterSet;
use crate::script::messages::error::ScriptError;
use crate::script::presentation::details;
use crate::system::Scene;

#[derive(Clone)]
pub struct StationHandle {
    pub scene: SceneHandle,
    pub station: Station,
}

impl StationHandle {
    pub fn place_in(&self, handle: &SimulationHandle) -> Result<beams::BodyPoint, ScriptError> {
        let simulation = handle.simulation();
        self.within(handle.scene(), simulation.scene(), simulation.model().meshes())
    }

    pub fn within(
        &self,
        of: &SceneHandle,
        built: &Scene,
        meshes: &[Mesh],
    ) -> Result<beams::BodyPoint, ScriptError> {
        of.own_station(self)?;
        let known = match self.station.body {
            BodyIndex::Beam(beam) => beam < built.beams.len(),
            BodyIndex::Particle(particle) => particle < built.particles.len(),
            BodyIndex::Rigid(body, _) => body < built.rigid_bodies.len(),
        };
        if !known {
            let message = format!("{} was added after the scene was started", self.show());
            return Err(ScriptError::new(message)
                .hint("add everything before scene.start(…), or start the scene again"));
        }
        Ok(built.place(&self.station, meshes)?)
    }
}

impl Scripted for StationHandle {
    const NAME: &'static str = "station";
    const DOC: &'static str = "A place on a beam, a particle, or a point of a rigid body.";

    fn show(&self) -> String {
        self.scene.scene().borrow().describe(&self.station)
    }

    fn meant_by(value: &Dynamic) -> Option<Self> {
        Some(value.read_lock::<RigidBodyHandle>()?.centre())
    }

    fn details(&self) -> Details {
        details::of_station(&self.scene.scene().borrow(), &self.station)
    }

    fn parameter_set(&self) -> Option<Rc<ParameterSet>> {
        self.scene.parameter_set()
    }
}

pub fn here(call: &Call, name: &str) -> Result<(Station, Rc<RefCell<Scene>>), ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let station = scene.own_station(&call.get::<StationHandle>(name)?)?;
    Ok((station, scene.shared_for_change()))
}
