//! A scene that a script holds.

use std::cell::{Cell, OnceCell, RefCell};
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

/// What to do where the shape of a scene depends on a parameter.
const SHAPED: &str = "numbers of sections, loads, springs, masses and velocities may depend on scene.parameter(…); for shapes and places give plain numbers and take central differences, as fit does";

/// A handle on a scene that a script holds.
#[derive(Clone)]
pub struct SceneHandle {
    variants: Rc<Variants>,
    /// Functions that fill columns, in the order of the columns.
    functions: Rc<RefCell<Vec<Rc<StoredFunction>>>>,
    /// Functions that loads and drives are told by at the start of every step.
    controllers: Rc<RefCell<Vec<Rc<Controller>>>>,
    /// Functions that say when something lets go, with the index of its release.
    conditions: Rc<RefCell<Vec<Condition>>>,
}

/// A scene, and those that it is beside the values of its parameters.
struct Variants {
    scene: Rc<RefCell<Scene>>,
    /// Parameters that were declared by the scene.
    declared: RefCell<Option<Rc<ParameterSet>>>,
    /// From the first call on in which something depends on a parameter.
    beside: OnceCell<Beside>,
}

/// The scenes beside one, at parameters plus and minus a distance.
struct Beside {
    family: Rc<ParameterSet>,
    /// In the order of the variants, from 1.
    scenes: Vec<Rc<RefCell<Scene>>>,
}

/// A function of the simulation that says whether something lets go.
#[derive(Clone)]
pub struct Condition {
    /// The function of a script, called with the simulation.
    pub function: Rc<StoredFunction>,
    /// The index of the release in the scene.
    pub release: usize,
}

/// A function of time and simulation whose value holds for a step, or from one sample to the next.
pub struct Controller {
    /// The function of a script, called with the time and the simulation.
    pub function: StoredFunction,
    /// The value of the controller for the present step.
    pub value: Rc<Cell<f64>>,
    /// When it is asked and acts; at every step where there is none.
    pub beat: Option<SampleClock>,
}

impl SceneHandle {
    /// A new handle on a scene.
    pub fn new(scene: Scene) -> Self {
        let scene = Rc::new(RefCell::new(scene));
        let variants =
            Variants { scene, declared: RefCell::default(), beside: OnceCell::default() };
        Self {
            variants: Rc::new(variants),
            functions: Rc::default(),
            controllers: Rc::default(),
            conditions: Rc::default(),
        }
    }

    /// The scene of the handle, to look at or to change it, in the variant that the present call is made for.
    pub fn scene(&self) -> &RefCell<Scene> {
        self.of_present()
    }

    /// The scene of the handle, shared with it, in the variant that the present call is made for.
    pub fn shared(&self) -> Rc<RefCell<Scene>> {
        Rc::clone(self.of_present())
    }

    fn of_present(&self) -> &Rc<RefCell<Scene>> {
        let Variants { scene, beside, .. } = &*self.variants;
        let Some(CurrentVariant { family, variant }) = present().filter(|of| of.variant > 0) else {
            return scene;
        };
        // It has not been changed by the present call yet, which is made for the scene itself last.
        let beside = beside.get_or_init(|| {
            let copy = |_| Rc::new(RefCell::new(scene.borrow().clone()));
            Beside { scenes: (1..family.variants()).map(copy).collect(), family }
        });
        beside.scenes.get(variant - 1).unwrap_or(scene)
    }

    /// The parameters that the scene depends on, if it does.
    pub fn family(&self) -> Option<Rc<ParameterSet>> {
        self.variants.beside.get().map(|beside| Rc::clone(&beside.family))
    }

    /// A parameter of the scene with its value, as a number that knows what depends on it, by values at a distance on both sides.
    ///
    /// # Errors
    /// When there is one of that name, or others are in use.
    pub fn declare(
        &self,
        name: &str,
        value: f64,
        distance: Option<f64>,
    ) -> Result<VariantValue, ScriptError> {
        let family = self.family();
        let mut declared = self.variants.declared.borrow_mut();
        family
            .as_ref()
            .unwrap_or_else(|| declared.get_or_insert_with(ParameterSet::new))
            .declare(name, value, distance)
    }

    /// How the scene varies with its parameters.
    ///
    /// # Errors
    /// When something depends on one that a run cannot take along.
    pub fn variations(&self) -> Result<Vec<Variation>, ScriptError> {
        let Some(Beside { family, scenes }) = self.variants.beside.get() else {
            return Ok(Vec::new());
        };
        if !self.functions.borrow().is_empty() {
            let told =
                "columns that functions |q| … fill have no derivatives by parameters of a scene";
            let hint = "leave scene.record(name, |q| …) out, and ask the simulation when it is there: sim.position(…), sim.history.column(…)";
            return Err(ScriptError::new(told).hint(hint));
        }
        self.expect_unasked_beside()?;
        let own = self.variants.scene.borrow();
        for scene in scenes.iter().map(|scene| scene.borrow()) {
            let is_one = |(one, other): (&Station, &Station)| one.is_at(other, own.length_at(one));
            let mut pairs = own.stations.iter().zip(&scene.stations);
            if own.stations.len() != scene.stations.len() || !pairs.all(is_one) {
                let told = "a place on a beam depends on a parameter";
                return Err(ScriptError::new(told).hint(SHAPED));
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

    /// Refuses a beam, by its index, whose length depends on a parameter, where the scenes beside have it.
    ///
    /// # Errors
    /// When it does.
    pub fn expect_length_beside(&self, beam: usize) -> Result<(), ScriptError> {
        let Some(Beside { scenes, .. }) = self.variants.beside.get() else { return Ok(()) };
        let own = self.variants.scene.borrow();
        // The call for the scene itself comes after those for the scenes beside it.
        let Some(own) = own.beams.get(beam) else { return Ok(()) };
        let length = own.axis.length();
        let is_other = |scene: &Rc<RefCell<Scene>>| {
            let scene = scene.borrow();
            // What is turned is as long but for rounding.
            let apart = scene.beams.get(beam).map_or(0.0, |of| (length - of.axis.length()).abs());
            apart > ROUNDING_OF_PLACES * length
        };
        if scenes.iter().any(is_other) {
            let told = format!("the length of beam '{}' depends on a parameter", own.name);
            return Err(ScriptError::new(told).hint(SHAPED));
        }
        Ok(())
    }

    /// Whether functions are to be kept in the present call: one that is made for many variants keeps them once.
    fn keeps(&self) -> bool {
        present().is_none_or(|present| present.variant == 0)
    }

    /// Refuses parameters in a scene of which functions are asked between steps.
    fn expect_unasked_beside(&self) -> Result<(), ScriptError> {
        if self.controllers.borrow().is_empty() && self.conditions.borrow().is_empty() {
            return Ok(());
        }
        let told = "what functions of the simulation do, |t, q| … of a controller or when: |q| … of a release, has no derivatives by parameters of a scene";
        let hint = "give functions of time, |t| …, or plain numbers in the place of scene.parameter(…) and take central differences, as fit does";
        Err(ScriptError::new(told).hint(hint))
    }

    /// Keeps a function that fills the last column that was described.
    pub fn keep_function(&self, function: StoredFunction) {
        if self.keeps() {
            self.functions.borrow_mut().push(Rc::new(function));
        }
    }

    /// Keeps a function that is asked at the start of every step, or at the samples of a beat; gives where its value will be.
    pub fn keep_controller(
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

    /// Keeps a function that says when the release that was described last happens.
    pub fn keep_condition(&self, function: StoredFunction) {
        let release = self.scene().borrow().releases.len() - 1;
        let condition = Condition { function: Rc::new(function), release };
        if self.keeps() {
            self.conditions.borrow_mut().push(condition);
        }
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
        Err(ScriptError::new(told).hint(hint).at(CallPart::Key("scene".into())))
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
        if Rc::ptr_eq(&self.variants, &other.variants) {
            return Ok(());
        }
        let (mine, other) = (&self.scene().borrow().name, &other.scene().borrow().name);
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

    fn family(&self) -> Option<Rc<ParameterSet>> {
        Self::family(self)
    }
}
