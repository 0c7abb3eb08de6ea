//! Length scale and first step size of a scene.

use crate::elementary::square;
use crate::geometry::larger;
use crate::integrators::Mechanism;
use crate::system::{Scene, System};

/// First step of a scene without beams, as a fraction of the time in which it moves by its own size.
const PART: f64 = 1e-3;

/// Distance in which gravity generates the start speed, below which it is no length scale [length].
const SHORTEST_WAY: f64 = 1e-3;

/// Length scale of a scene: its longest beam. Without beams it is the [extent](Scene::extent). For isolated particles it is the distance in which
/// gravity generates the start speed, or 1 [length].
pub(super) fn length_of(scene: &Scene) -> f64 {
    let is_length = |length: &f64| *length > 0.0 && length.is_finite();
    let extent = || Some(scene.extent()).filter(is_length);
    let on_the_way = || {
        let distance = square(start_speed(scene)) / scene.gravity.norm();
        Some(distance).filter(is_length).filter(|distance| *distance > SHORTEST_WAY)
    };
    scene.longest_beam().or_else(extent).or_else(on_the_way).unwrap_or(1.0)
}

/// Largest start speed of particles and rigid bodies [length/time].
fn start_speed(scene: &Scene) -> f64 {
    let nodes = scene.velocities.iter().map(|start| start.velocity);
    let bodies = scene.rigid_bodies.iter().map(|body| body.motion.velocity);
    nodes.chain(bodies).map(|velocity| velocity.norm()).fold(0.0, larger)
}

/// Initial size of variable steps [time].
///
/// It is the shortest time in which an axial wave passes a span. Without beams it is a fraction of the time in which start velocities or weight
/// displace a particle by the length scale.
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
