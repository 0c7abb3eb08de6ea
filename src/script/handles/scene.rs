//! Handle of a scene in a script.

use std::cell::{Cell, OnceCell, RefCell, RefMut};
use std::rc::Rc;

use super::station::StationHandle;
use crate::beams::Station;
use crate::geometry::ROUNDING_OF_PLACES;
use crate::loads::SampleClock;
use crate::script::bindings::kind::{Details, Scripted};
use crate::script::bindings::parameter_variants::{
    CurrentVariant, ParameterSet, VariantValue, present,
};
use crate::script::bindings::stored::StoredFunction;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::presentation::details;
use crate::simulation::Variation;
use crate::system::Scene;

const SHAPED: &str = "numbers of sections, loads, springs, masses and velocities may depend on \
    scene.parameter(…); use plain numbers for shapes and places, and central differences, as \
    fit does";

#[derive(Clone)]
pub struct SceneHandle {
    variants: Rc<Variants>,
    functions: Rc<RefCell<Vec<Rc<StoredFunction>>>>,
    controllers: Rc<RefCell<Vec<Rc<Controller>>>>,
    conditions: Rc<RefCell<Vec<Condition>>>,
    has_modes_note: Rc<Cell<bool>>,
}

struct Variants {
    scene: Rc<RefCell<Scene>>,
    declared: RefCell<Option<Rc<ParameterSet>>>,
    /// Perturbed variants of the scene, created by the first call with an argument that depends on a parameter.
    beside: OnceCell<PerturbedBuilds>,
    is_changed: Cell<bool>,
}

struct PerturbedBuilds {
    family: Rc<ParameterSet>,
    scenes: Vec<Rc<RefCell<Scene>>>,
}

#[derive(Clone)]
pub struct Condition {
    pub function: Rc<StoredFunction>,
    pub release: usize,
}

pub struct Controller {
    pub function: StoredFunction,
    pub value: Rc<Cell<f64>>,
    /// Sampling clock of the controller; `None` if the function is called at every step.
    pub beat: Option<SampleClock>,
}

impl SceneHandle {
    pub fn new(scene: Scene) -> Self {
        let scene = Rc::new(RefCell::new(scene));
        let variants = Variants {
            scene,
            declared: RefCell::default(),
            beside: OnceCell::default(),
            is_changed: Cell::default(),
        };
        Self {
            variants: Rc::new(variants),
            functions: Rc::default(),
            controllers: Rc::default(),
            conditions: Rc::default(),
            has_modes_note: Rc::default(),
        }
    }

    /// Returns true at the first call only, so that the note on modes is printed once per scene.
    pub fn take_modes_note(&self) -> bool {
        !self.has_modes_note.replace(true)
    }

    pub fn scene(&self) -> &RefCell<Scene> {
        self.of_present()
    }

    pub fn change(&self) -> RefMut<'_, Scene> {
        self.variants.is_changed.set(true);
        self.of_present().borrow_mut()
    }

    pub fn shared_for_change(&self) -> Rc<RefCell<Scene>> {
        self.variants.is_changed.set(true);
        Rc::clone(self.of_present())
    }

    pub fn take_change(&self) -> bool {
        self.variants.is_changed.replace(false)
    }

    fn of_present(&self) -> &Rc<RefCell<Scene>> {
        let Variants { scene, beside, .. } = &*self.variants;
        let Some(CurrentVariant { family, variant }) = present().filter(|of| of.variant > 0) else {
            return scene;
        };
        let beside = beside.get_or_init(|| {
            let copy = |_| Rc::new(RefCell::new(scene.borrow().clone()));
            PerturbedBuilds { scenes: (1..family.variants()).map(copy).collect(), family }
        });
        beside.scenes.get(variant - 1).unwrap_or(scene)
    }

    pub fn parameter_set(&self) -> Option<Rc<ParameterSet>> {
        self.variants.beside.get().map(|beside| Rc::clone(&beside.family))
    }

    /// Declares a parameter, and returns its value with all perturbed values.
    pub fn declare(
        &self,
        name: &str,
        value: f64,
        distance: Option<f64>,
    ) -> Result<VariantValue, ScriptError> {
        let family = self.parameter_set();
        let mut declared = self.variants.declared.borrow_mut();
        family
            .as_ref()
            .unwrap_or_else(|| declared.get_or_insert_with(ParameterSet::new))
            .declare(name, value, distance)
    }

    /// Scenes at the perturbed parameter values.
    pub fn variations(&self) -> Result<Vec<Variation>, ScriptError> {
        let Some(PerturbedBuilds { family, scenes }) = self.variants.beside.get() else {
            return Ok(Vec::new());
        };
        if !self.functions.borrow().is_empty() {
            let message = "columns of functions |q| … have no derivatives by parameters of a scene";
            let hint = "omit scene.record(name, |q| …), and read the simulation at the required time: \
                sim.position(…), sim.history.column(…)";
            return Err(ScriptError::new(message).hint(hint));
        }
        self.expect_no_callbacks_with()?;
        let own = self.variants.scene.borrow();
        for scene in scenes.iter().map(|scene| scene.borrow()) {
            let is_one = |(one, other): (&Station, &Station)| one.is_at(other, own.length_at(one));
            let mut pairs = own.stations.iter().zip(&scene.stations);
            if own.stations.len() != scene.stations.len() || !pairs.all(is_one) {
                let message = "a place on a beam depends on a parameter";
                return Err(ScriptError::new(message).hint(SHAPED));
            }
        }
        let mut pairs = scenes.chunks_exact(2);
        let variation = |(name, distance): (String, f64)| {
            let [plus, minus] = pairs.next()? else { return None };
            let scenes = [plus, minus].map(|scene| scene.borrow().clone());
            Some(Variation { name, distance, scenes })
        };
        Ok(family.parameters().into_iter().map_while(variation).collect())
    }

    pub fn expect_constant_length(&self, beam: usize) -> Result<(), ScriptError> {
        let Some(PerturbedBuilds { scenes, .. }) = self.variants.beside.get() else {
            return Ok(());
        };
        let own = self.variants.scene.borrow();
        let Some(own) = own.beams.get(beam) else { return Ok(()) };
        let length = own.axis.length();
        let is_other = |scene: &Rc<RefCell<Scene>>| {
            let scene = scene.borrow();
            let apart = scene.beams.get(beam).map_or(0.0, |of| (length - of.axis.length()).abs());
            apart > ROUNDING_OF_PLACES * length
        };
        if scenes.iter().any(is_other) {
            let message = format!("the length of beam '{}' depends on a parameter", own.name);
            return Err(ScriptError::new(message).hint(SHAPED));
        }
        Ok(())
    }

    /// Returns true in the unperturbed variant, the only one in which functions are stored.
    fn keeps(&self) -> bool {
        present().is_none_or(|present| present.variant == 0)
    }

    fn expect_no_callbacks_with(&self) -> Result<(), ScriptError> {
        if self.controllers.borrow().is_empty() && self.conditions.borrow().is_empty() {
            return Ok(());
        }
        let message = "functions of the simulation, |t, q| … of a controller or when: |q| … of a release, \
            have no derivatives by parameters of a scene";
        let hint = "use functions of time, |t| …, or plain numbers in place of scene.parameter(…) with \
            central differences, as fit does";
        Err(ScriptError::new(message).hint(hint))
    }

    pub fn store_function(&self, function: StoredFunction) {
        if self.keeps() {
            self.functions.borrow_mut().push(Rc::new(function));
        }
    }

    pub fn store_controller(
        &self,
        function: StoredFunction,
        beat: Option<SampleClock>,
    ) -> Rc<Cell<f64>> {
        let value = Rc::new(Cell::new(0.0));
        let controller = Controller { function, value: Rc::clone(&value), beat };
        if self.keeps() {
            self.controllers.borrow_mut().push(Rc::new(controller));
        }
        value
    }

    pub fn store_condition(&self, function: StoredFunction) {
        let release = self.scene().borrow().releases.len() - 1;
        let condition = Condition { function: Rc::new(function), release };
        if self.keeps() {
            self.conditions.borrow_mut().push(condition);
        }
    }

    pub fn conditions(&self) -> Vec<Condition> {
        self.conditions.borrow().clone()
    }

    /// Rejects a scene with functions that are called between steps, because a study runs the scene without its script.
    pub fn expect_no_callbacks(&self) -> Result<(), ScriptError> {
        if self.controllers.borrow().is_empty() && self.conditions.borrow().is_empty() {
            return Ok(());
        }
        let message = "functions of the simulation, |t, q| … of a controller or when: |q| … of a release, \
            are called between steps; a study does not support this";
        let hint = "use functions of time, |t| …, and a time for the release, or step the scene in a \
            loop of your own";
        Err(ScriptError::new(message).hint(hint).at(CallPart::Key("scene".into())))
    }

    pub fn controllers(&self) -> Vec<Rc<Controller>> {
        self.controllers.borrow().clone()
    }

    pub fn functions(&self, columns: usize) -> Vec<Rc<StoredFunction>> {
        self.functions.borrow().iter().take(columns).cloned().collect()
    }

    pub fn own_station(&self, handle: &StationHandle) -> Result<Station, ScriptError> {
        self.expect_same(&handle.scene, "station")?;
        Ok(handle.station)
    }

    pub fn expect_same(&self, other: &Self, what: &str) -> Result<(), ScriptError> {
        if Rc::ptr_eq(&self.variants, &other.variants) {
            return Ok(());
        }
        let (mine, other) = (&self.scene().borrow().name, &other.scene().borrow().name);
        let message = match mine == other {
            true => format!("the {what} belongs to another scene with the same name '{other}'"),
            false => format!("the {what} belongs to the scene '{other}', not to '{mine}'"),
        };
        Err(ScriptError::new(message).hint(format!("use a {what} of this scene")))
    }
}

impl Scripted for SceneHandle {
    const NAME: &'static str = "scene";
    const DOC: &'static str = "A description of beams, particles, joints, masses and loads.";

    fn show(&self) -> String {
        let scene = self.scene().borrow();
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
        details::of_scene(&self.scene().borrow())
    }

    fn parameter_set(&self) -> Option<Rc<ParameterSet>> {
        Self::parameter_set(self)
    }
}
