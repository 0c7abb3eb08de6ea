//! How large a scene is, and how fast it may begin to move.

use crate::elementary::square;
use crate::geometry::larger;
use crate::integrators::Mechanism;
use crate::system::{Scene, System};

/// The part of the time in which a scene without beams moves as far as it is large.
const PART: f64 = 1e-3;

/// A way that is shorter says nothing of how far something goes that hardly moves at the start [length].
const SHORTEST_WAY: f64 = 1e-3;

/// The size of a scene: its longest beam; without beams its [extent](Scene::extent), or where each particle is by itself the way on which gravity makes
/// as much speed as there is at the start, or 1 [length].
pub(super) fn length_of(scene: &Scene) -> f64 {
    let is_length = |length: &f64| *length > 0.0 && length.is_finite();
    let extent = || Some(scene.extent()).filter(is_length);
    let on_the_way = || {
        let way = square(start_speed(scene)) / scene.gravity.norm();
        Some(way).filter(is_length).filter(|way| *way > SHORTEST_WAY)
    };
    scene.longest_beam().or_else(extent).or_else(on_the_way).unwrap_or(1.0)
}

/// The largest velocity with which a particle or a rigid body starts [length/time].
fn start_speed(scene: &Scene) -> f64 {
    let nodes = scene.velocities.iter().map(|start| start.velocity);
    let bodies = scene.rigid_bodies.iter().map(|body| body.motion.velocity);
    nodes.chain(bodies).map(|velocity| velocity.norm()).fold(0.0, larger)
}

/// A step that is short enough to begin with; the next ones grow as they can [time].
///
/// The time in which an axial wave passes a span, the shortest of all beams. Without beams, a part of that in which the start
/// velocities or the weight move a particle as far as the scene is large.
pub(super) fn first_step(scene: &Scene, model: &System) -> f64 {
    let waves = scene.beams.iter().map(|beam| {
        beam.axis.length() / (beam.mesh.spans() as f64 * beam.section.axial_wave_speed())
    });
    if let Some(shortest) = waves.reduce(f64::min) {
        return shortest;
    }
    let length = length_of(scene);
    let speed = model.rates().iter().fold(0.0, |largest: f64, rate| largest.max(rate.abs()));
    let after_falling_as_far = (length * scene.gravity.norm()).sqrt();
    let speed = speed.max(after_falling_as_far);
    PART * if speed > 0.0 { length / speed } else { 1.0 }
}
