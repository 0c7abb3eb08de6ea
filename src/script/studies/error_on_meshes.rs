//! Estimated error of a computation without steps, from its results on other meshes.

use super::error_estimate::{ErrorEstimate, Plan, QuantityError, no_meshes};
use crate::analysis::{ExpectedOrder, RefinementLevels, Trace};
use crate::geometry::{Vec2, larger};
use crate::script::messages::error::ScriptError;
use crate::system::Scene;

/// Result of a computation on a mesh. The value of a scalar is the first component.
#[derive(Clone)]
pub struct MeshResult {
    pub name: String,
    pub dimension: &'static str,
    pub value: Vec2,
    /// Value by which the error is divided to obtain a relative error. If it is zero, the size of the scene is used instead.
    pub scale: f64,
}

impl MeshResult {
    pub fn scalar(name: String, dimension: &'static str, value: f64) -> Self {
        Self { name, dimension, value: Vec2::new(value, 0.0), scale: value.abs() }
    }
}

/// Largest error of several results in one row.
pub struct Together {
    pub name: &'static str,
    /// Number of results, from the first one.
    pub count: usize,
}

impl ErrorEstimate {
    /// Estimates the errors in space of a computation from its results on the mesh of the scene and on two other meshes.
    ///
    /// # Errors
    /// Fails if the script is stopped or a mesh cannot be scaled.
    pub fn on_meshes(
        scene: &Scene,
        moment: String,
        together: Together,
        own: Vec<MeshResult>,
        compute: impl Fn(Scene) -> Result<Vec<MeshResult>, ScriptError>,
    ) -> Result<Self, ScriptError> {
        let (quantities, missing) = (Vec::new(), Vec::new());
        let mut estimate = Self { name: scene.name.clone(), moment, quantities, missing };
        let plan = Plan::of(scene)?;
        let Some(meshes) = plan.meshes else {
            estimate.missing.push(no_meshes(scene).to_owned());
            return Ok(estimate);
        };
        let mut levels = Vec::new();
        for (level, run) in meshes.into_iter().enumerate() {
            let ratio = plan.companions[run].span_ratio;
            let found = match level == plan.level {
                true => Ok(own.clone()),
                false => compute(scene.with_span_ratio(ratio)?),
            };
            match found {
                Ok(found) => levels.push(found),
                Err(ScriptError::Failure(failure)) => {
                    let message = failure.message;
                    estimate.missing.push(format!("with {ratio} times the spans: {message}"));
                    return Ok(estimate);
                }
                Err(error) => return Err(error),
            }
        }
        let order = ExpectedOrder::AtMost(scene.mesh_order());
        let size = scene.size().unwrap_or(1.0);
        estimate.quantities = compare(&plan, &levels, order, size);
        let all = estimate.quantities.iter().take(together.count);
        if let Some(worst) = all.clone().max_by(|a, b| a.total().1.total_cmp(&b.total().1)) {
            let scale = all.map(|of| of.scale).fold(0.0, larger);
            let worst = QuantityError { name: together.name.to_owned(), scale, ..worst.clone() };
            estimate.quantities.insert(0, worst);
        }
        Ok(estimate)
    }
}

/// Errors of the results on the mesh of the scene, from the results on all levels.
fn compare(
    plan: &Plan,
    levels: &[Vec<MeshResult>],
    order: ExpectedOrder,
    size: f64,
) -> Vec<QuantityError> {
    let own = &levels[plan.level];
    let errors = own.iter().enumerate().map(|(index, result)| {
        let traces: [Option<Trace>; 3] = std::array::from_fn(|level| {
            levels[level].get(index).map(|result| Trace::at_one_time(result.value))
        });
        let scale = if result.scale > 0.0 { result.scale } else { size };
        let levels = RefinementLevels {
            sizes: plan.mesh_sizes,
            traces: traces.each_ref().map(Option::as_ref),
            level: plan.level,
            order,
            scale,
        };
        let (name, dimension) = (result.name.clone(), result.dimension);
        QuantityError { name, dimension, scale, in_time: None, in_space: levels.error() }
    });
    errors.collect()
}
