//! How large a scene is, and how fast it may begin to move.

use crate::integrators::Mechanism;
use crate::model::{Model, Scene};

/// The part of the time in which a scene without beams moves as far as it is large.
const PART: f64 = 1e-3;

/// The size of a scene: its longest beam; without beams the largest distance of a particle from the origin, or 1 [length].
pub(super) fn length_of(scene: &Scene, model: &Model) -> f64 {
    let distances = model.control_points().flatten().map(|point| point.norm());
    let largest = scene.longest_beam().or_else(|| distances.reduce(f64::max));
    largest.filter(|length| *length > 0.0).unwrap_or(1.0)
}

/// A step that is short enough to begin with; the next ones grow as they can [time].
///
/// The time in which an axial wave passes a span, the shortest of all beams. Without beams, a part of that in which the start
/// velocities or the weight move a particle as far as the scene is large.
pub(super) fn first_step(scene: &Scene, model: &Model) -> f64 {
    let waves = scene.beams.iter().map(|beam| {
        beam.axis.length() / (beam.mesh.spans() as f64 * beam.section.axial_wave_speed())
    });
    if let Some(shortest) = waves.reduce(f64::min) {
        return shortest;
    }
    let length = length_of(scene, model);
    let speed = model.rates().iter().fold(0.0, |largest: f64, rate| largest.max(rate.abs()));
    let after_falling_as_far = (length * scene.gravity.norm()).sqrt();
    let speed = speed.max(after_falling_as_far);
    PART * if speed > 0.0 { length / speed } else { 1.0 }
}
