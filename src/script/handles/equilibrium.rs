//! Handle of an equilibrium in a script.

use std::cell::{Ref, RefCell, RefMut};
use std::rc::Rc;

use super::scene::SceneHandle;
use super::station::StationHandle;
use crate::beams::BodyPoint;
use crate::output::significant;
use crate::script::bindings::kind::{Details, Scripted};
use crate::script::messages::error::ScriptError;
use crate::statics::Equilibrium;

#[derive(Clone)]
pub struct EquilibriumHandle(Rc<EquilibriumData>);

struct EquilibriumData {
    scene: SceneHandle,
    rest: RefCell<Equilibrium>,
}

impl EquilibriumHandle {
    pub fn new(scene: SceneHandle, rest: Equilibrium) -> Self {
        Self(Rc::new(EquilibriumData { scene, rest: RefCell::new(rest) }))
    }

    pub fn scene(&self) -> &SceneHandle {
        &self.0.scene
    }

    pub fn equilibrium(&self) -> Ref<'_, Equilibrium> {
        self.0.rest.borrow()
    }

    pub fn equilibrium_mut(&self) -> RefMut<'_, Equilibrium> {
        self.0.rest.borrow_mut()
    }

    pub fn place(&self, station: &StationHandle) -> Result<BodyPoint, ScriptError> {
        let rest = self.equilibrium();
        station.within(&self.0.scene, rest.scene(), rest.model().meshes())
    }
}

impl Scripted for EquilibriumHandle {
    const NAME: &'static str = "equilibrium";
    const DOC: &'static str = "A scene in static equilibrium, with its load path.";

    fn show(&self) -> String {
        let rest = self.equilibrium();
        let points = rest.path().points();
        format!(
            "equilibrium of '{}' at load factor {}, {} points, strain energy {}",
            rest.scene().name,
            significant(rest.path().load_factor(), 6),
            points.len(),
            significant(points.last().map_or(0.0, |point| point.strain_energy), 6),
        )
    }

    fn details(&self) -> Details {
        let rest = self.equilibrium();
        let limits = rest.path().limit_points();
        let shown = |value: &f64| significant(*value, 6);
        let line = |label: &str, value: String| (label.to_owned(), value);
        let most = rest.path().points().iter().map(|point| point.iterations).max();
        let mut details = vec![
            line("taken at", format!("t = {}", significant(rest.loading().time, 6))),
            line("Newton iterations", format!("at most {} a step", most.unwrap_or(0))),
        ];
        if !limits.is_empty() {
            let limits: Vec<String> = limits.iter().map(shown).collect();
            details.push(line("limit points", limits.join(", ")));
        }
        details
    }
}
