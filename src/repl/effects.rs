//! Side effects of inputs, other than changes of variables. An input with such effects must not be evaluated repeatedly.

use rhai::{Array, Dynamic, FnPtr, Map};

use super::session::Session;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::SimulationHandle;

const DEEPEST: usize = 8;

pub struct SideEffects {
    simulations: Vec<(SimulationHandle, SimulationPosition)>,
    scenes: Vec<(SceneHandle, String)>,
    shared: Vec<(Dynamic, String)>,
    files: usize,
}

type SimulationPosition = (usize, u64, usize, usize);

impl SideEffects {
    pub fn of(session: &Session) -> Self {
        let files = session.context().output().written().len();
        let mut print =
            Self { simulations: Vec::new(), scenes: Vec::new(), shared: Vec::new(), files };
        for (_, _, value) in session.variables().iter_raw() {
            print.add(value, 0);
        }
        if let Some(latest) = session.context().latest_simulation() {
            print.add(&latest, 0);
        }
        print
    }

    fn add(&mut self, value: &Dynamic, depth: usize) {
        if depth > DEEPEST {
            return;
        }
        if value.is_shared() {
            self.shared.push((value.clone(), format!("{value:?}")));
        }
        if let Some(handle) = value.read_lock::<SimulationHandle>() {
            self.simulations.push((handle.clone(), place(&handle)));
            self.scenes.push((handle.scene().clone(), content(handle.scene())));
        } else if let Some(scene) = value.read_lock::<SceneHandle>() {
            self.scenes.push((scene.clone(), content(&scene)));
        } else if let Some(array) = value.read_lock::<Array>() {
            array.iter().for_each(|item| self.add(item, depth + 1));
        } else if let Some(map) = value.read_lock::<Map>() {
            map.values().for_each(|item| self.add(item, depth + 1));
        } else if let Some(function) = value.read_lock::<FnPtr>() {
            function.curry().iter().for_each(|captured| self.add(captured, depth + 1));
        }
    }

    /// First change since the state was recorded, as the predicate of a sentence such as "it … "; `None` without a change.
    pub fn change(&self, session: &Session) -> Option<String> {
        let moved = self.simulations.iter().find(|(handle, was)| place(handle) != *was);
        if let Some((handle, _)) = moved {
            return Some(format!("advances simulation '{}'", handle.name()));
        }
        if let Some((scene, _)) = self.scenes.iter().find(|(scene, was)| content(scene) != *was) {
            return Some(format!("changes scene '{}'", scene.scene().borrow().name));
        }
        if session.context().output().written().len() > self.files {
            return Some("writes files".into());
        }
        let shared = self.shared.iter().any(|(value, was)| format!("{value:?}") != *was);
        shared.then(|| "changes a variable shared by functions".into())
    }
}

fn place(handle: &SimulationHandle) -> SimulationPosition {
    let simulation = handle.simulation();
    let (steps, time) = (simulation.counts().steps, simulation.time().to_bits());
    (steps, time, handle.events_waiting(), simulation.snapshot_limit())
}

fn content(scene: &SceneHandle) -> String {
    format!("{:?}", scene.scene().borrow())
}
