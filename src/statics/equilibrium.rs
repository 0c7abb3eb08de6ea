//! A scene at rest under its loads.

use super::tracer::Tracer;
use super::{Control, Loading, Path, StaticsError};
use crate::beams::Place;
use crate::geometry::Vec2;
use crate::integrators::Mechanism;
use crate::model::{Model, Scene};

/// A scene at rest under its loads, and the path that led there.
///
/// Start velocities of the scene play no part. Loads are put on together, in proportion.
pub struct Equilibrium {
    scene: Scene,
    loading: Loading,
    model: Model,
    path: Path,
}

impl Equilibrium {
    /// Finds the equilibrium of a scene; `goes_on` is asked after every step, with its load factor.
    ///
    /// # Errors
    /// When the scene cannot be built or slides, a load has no value or none acts, no equilibrium is found, or it is stopped.
    pub fn find(
        scene: Scene,
        loading: Loading,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Self, StaticsError> {
        loading.check()?;
        if let Some(slider) = scene.sliders.first() {
            return Err(StaticsError::Slider { slider: slider.name.clone() });
        }
        let mut model = Model::assemble(&scene)?;
        model
            .hold_loads_at(loading.time)
            .map_err(|(load, source)| StaticsError::Load { load, source })?;
        let mut loads = vec![0.0; model.degrees_of_freedom()];
        model.subtract_static_loads(&vec![0.0; model.unknowns()], 1.0, &mut loads);
        if loads.iter().all(|load| *load == 0.0) {
            return Err(StaticsError::NoLoad { time: loading.time });
        }
        let mut tracer = Tracer::new(&scene, model, loading);
        match loading.control {
            Control::Load => tracer.load_up(goes_on)?,
            Control::ArcLength(arc) => tracer.follow(arc, goes_on)?,
        }
        let Tracer { model, path, .. } = tracer;
        Ok(Self { scene, loading, model, path })
    }

    /// What is at rest.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// How the loads were put on.
    pub fn loading(&self) -> &Loading {
        &self.loading
    }

    /// The model in its equilibrium.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// How it got there.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The same scene at another point of the path.
    ///
    /// # Panics
    /// When there is no such point.
    pub fn model_at(&self, point: usize) -> Result<Model, StaticsError> {
        let mut model = Model::assemble(&self.scene)?;
        model.restore(&self.path.points()[point].state);
        Ok(model)
    }

    /// Where a place is at every point of the path [length].
    ///
    /// # Errors
    /// None that the scene did not have when the equilibrium was found.
    pub fn positions(&self, place: &Place) -> Result<Vec<Vec2>, StaticsError> {
        let mut model = Model::assemble(&self.scene)?;
        let at = |point: &super::PathPoint| {
            model.restore(&point.state);
            model.position(place)
        };
        Ok(self.path.points().iter().map(at).collect())
    }
}
