//! A scene that a script holds.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use super::station::StationHandle;
use crate::beams::Station;
use crate::model::Scene;
use crate::script::looks::details;
use crate::script::rows::kind::{Details, Scripted};
use crate::script::rows::stored::StoredFunction;
use crate::script::words::error::{Place, ScriptError};

/// A handle on a scene that a script holds.
#[derive(Clone)]
pub struct SceneHandle {
    scene: Rc<RefCell<Scene>>,
    /// Functions that fill columns, in the order of the columns.
    functions: Rc<RefCell<Vec<Rc<StoredFunction>>>>,
    /// Functions that loads and drives are told by at the start of every step.
    controllers: Rc<RefCell<Vec<Rc<Controller>>>>,
    /// Functions that say when something lets go, with the index of its release.
    conditions: Rc<RefCell<Vec<Condition>>>,
}

/// A function of the simulation that says whether something lets go.
#[derive(Clone)]
pub struct Condition {
    /// The function of a script, called with the simulation.
    pub function: Rc<StoredFunction>,
    /// The index of the release in the scene.
    pub release: usize,
}

/// A function of time and simulation whose value holds for a step.
pub struct Controller {
    /// The function of a script, called with the time and the simulation.
    pub function: StoredFunction,
    /// The value of the controller for the present step.
    pub value: Rc<Cell<f64>>,
}

impl SceneHandle {
    /// A new handle on a scene.
    pub fn new(scene: Scene) -> Self {
        let scene = Rc::new(RefCell::new(scene));
        Self {
            scene,
            functions: Rc::default(),
            controllers: Rc::default(),
            conditions: Rc::default(),
        }
    }

    /// The scene of the handle, to look at or to change it.
    pub fn scene(&self) -> &RefCell<Scene> {
        &self.scene
    }

    /// The scene of the handle, shared with it.
    pub fn shared(&self) -> Rc<RefCell<Scene>> {
        Rc::clone(&self.scene)
    }

    /// Keeps a function that fills the last column that was described.
    pub fn keep_function(&self, function: StoredFunction) {
        self.functions.borrow_mut().push(Rc::new(function));
    }

    /// Keeps a function that is asked at the start of every step; gives where its value will be.
    pub fn keep_controller(&self, function: StoredFunction) -> Rc<Cell<f64>> {
        let value = Rc::new(Cell::new(0.0));
        let controller = Controller { function, value: Rc::clone(&value) };
        self.controllers.borrow_mut().push(Rc::new(controller));
        value
    }

    /// Keeps a function that says when the release that was described last happens.
    pub fn keep_condition(&self, function: StoredFunction) {
        let release = self.scene.borrow().releases.len() - 1;
        let condition = Condition { function: Rc::new(function), release };
        self.conditions.borrow_mut().push(condition);
    }

    /// The functions that say when something lets go.
    pub fn conditions(&self) -> Vec<Condition> {
        self.conditions.borrow().clone()
    }

    /// Refuses a scene of which functions are asked between steps: a study runs it without its script.
    ///
    /// # Errors
    /// When a load or a drive has a controller, or a release a condition.
    pub fn expect_unasked(&self) -> Result<(), ScriptError> {
        if self.controllers.borrow().is_empty() && self.conditions.borrow().is_empty() {
            return Ok(());
        }
        let told = "functions of the simulation, |t, q| … of a controller or when: |q| … of a release, are asked between steps, which a study does not do";
        let hint = "give functions of time, |t| …, and the time of a release, or step the scene in a loop of your own";
        Err(ScriptError::new(told).hint(hint).at(Place::Key("scene".into())))
    }

    /// The functions that are asked at the start of every step.
    pub fn controllers(&self) -> Vec<Rc<Controller>> {
        self.controllers.borrow().clone()
    }

    /// The functions that fill the first columns of those that somebody outside fills.
    pub fn functions(&self, columns: usize) -> Vec<Rc<StoredFunction>> {
        self.functions.borrow().iter().take(columns).cloned().collect()
    }

    /// The station of another handle, if it is one of this scene.
    pub fn own(&self, handle: &StationHandle) -> Result<Station, ScriptError> {
        self.expect_same(&handle.scene, "station")?;
        Ok(handle.station)
    }

    /// Refuses a thing of another scene than this; `what` is the kind of the thing.
    pub fn expect_same(&self, other: &Self, what: &str) -> Result<(), ScriptError> {
        if Rc::ptr_eq(&self.scene, &other.scene) {
            return Ok(());
        }
        let (mine, other) = (&self.scene.borrow().name, &other.scene.borrow().name);
        let told = match mine == other {
            true => format!("the {what} belongs to another scene that is called '{other}' too"),
            false => format!("the {what} belongs to the scene '{other}', not to '{mine}'"),
        };
        Err(ScriptError::new(told).hint(format!("use a {what} of this scene")))
    }
}

impl Scripted for SceneHandle {
    const NAME: &'static str = "scene";
    const DOC: &'static str = "A description of beams, particles, joints, masses and loads.";

    fn show(&self) -> String {
        let scene = self.scene.borrow();
        let count = |(number, what): (usize, &str)| {
            format!("{number} {what}{}", if number == 1 { "" } else { "s" })
        };
        let always = [(scene.beams.len(), "beam")];
        let bodies = scene.rigid_bodies.len();
        let bodies = (bodies, if bodies == 1 { "body" } else { "bodie" });
        let if_any = [(scene.particles.len(), "particle"), bodies, (scene.sliders.len(), "slider")];
        let last = [(scene.joints.len(), "joint"), (scene.loads().count(), "load")];
        let some = if_any.into_iter().filter(|(number, _)| *number > 0);
        let parts: Vec<String> = always.into_iter().chain(some).chain(last).map(count).collect();
        format!("scene '{}' with {}", scene.name, parts.join(", "))
    }

    fn details(&self) -> Details {
        details::of_scene(&self.scene.borrow())
    }
}
