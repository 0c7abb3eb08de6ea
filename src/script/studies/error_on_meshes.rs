//! Estimated error of a computation without steps, from its results on other meshes.

use super::error_estimate::{ErrorEstimate, Plan, QuantityError};
use crate::analysis::{RefinementLevels, Trace};
use crate::geometry::{Vec2, larger};
use crate::script::messages::error::ScriptError;
use crate::system::Scene;

/// Result of a computation on a mesh. The value of a scalar is the first component.
#[derive(Clone)]
pub struct MeshResult {
    pub name: String,
    pub dimension: &'static str,
    pub value: Vec2,
    /// Size with which the error is compared; zero for the size of the scene.
    pub scale: f64,
}

impl MeshResult {
    pub fn scalar(name: String, dimension: &'static str, value: f64) -> Self {
        Self { name, dimension, value: Vec2::new(value, 0.0), scale: value.abs() }
    }
}

impl ErrorEstimate {
    /// Estimates the errors in space of a computation, which is repeated on two other meshes.
    /// The first row, with the given name, has the largest error of the first `together` results.
    ///
    /// # Errors
    /// Fails if the computation fails on the mesh of the scene, or a mesh cannot be scaled.
    pub fn on_meshes(
        scene: &Scene,
        moment: String,
        (name, together): (&str, usize),
        compute: impl Fn(Scene) -> Result<Vec<MeshResult>, ScriptError>,
    ) -> Result<Self, ScriptError> {
        let size = scene.size().unwrap_or(1.0);
        let (quantities, missing) = (Vec::new(), Vec::new());
        let mut estimate =
            Self { name: scene.name.clone(), moment, length: size, quantities, missing };
        let own = compute(scene.clone())?;
        let plan = Plan::of(scene)?;
        let Some(meshes) = plan.meshes else {
            estimate.missing.push("the scene has no beams".to_owned());
            return Ok(estimate);
        };
        let mut levels = Vec::new();
        for (level, run) in meshes.into_iter().enumerate() {
            let found = match level == plan.level {
                true => Ok(own.clone()),
                false => compute(scene.with_span_ratio(plan.companions[run].span_ratio)?),
            };
            match found {
                Ok(found) => levels.push(found),
                Err(ScriptError::Failure(failure)) => {
                    estimate.missing.push(failure.message);
                    return Ok(estimate);
                }
                Err(error) => return Err(error),
            }
        }
        for (index, MeshResult { name, dimension, scale, .. }) in own.into_iter().enumerate() {
            let traces = [0, 1, 2].map(|level| {
                let level: &Vec<MeshResult> = &levels[level];
                level.get(index).map(|result| Trace::at_one_time(result.value))
            });
            let scale = if scale > 0.0 { scale } else { size };
            let levels = RefinementLevels {
                sizes: plan.mesh_sizes,
                traces: traces.each_ref().map(Option::as_ref),
                level: plan.level,
                order: None,
                scale,
            };
            let in_space = levels.error();
            let error = QuantityError { name, dimension, scale, in_time: None, in_space };
            estimate.quantities.push(error);
        }
        let worst = estimate
            .quantities
            .iter()
            .take(together)
            .max_by(|a, b| a.total().1.total_cmp(&b.total().1));
        if let Some(worst) = worst.cloned() {
            let scale = estimate.quantities.iter().take(together).map(|of| of.scale);
            let scale = scale.fold(0.0, larger);
            estimate.quantities.insert(0, QuantityError { name: name.to_owned(), scale, ..worst });
        }
        Ok(estimate)
    }
}
