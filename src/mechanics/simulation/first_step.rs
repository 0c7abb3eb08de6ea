//! Length scale of a scene, and size of the first step.

use crate::elementary::square;
use crate::geometry::larger;
use crate::integrators::Mechanism;
use crate::system::{Scene, System, UnknownKind};

/// First step of a scene without beams, as a fraction of the time in which the scene moves by its length scale.
const PART: f64 = 1e-3;

/// Smallest distance `v²/g` that is used as length scale, as a fraction of the largest distance of a body from the origin.
/// The distance `v²/g` is computed from the start speed `v` and gravity `g`.
const SHORTEST_WAY: f64 = 1e-3;

/// Length scale of a scene: the [size](Scene::size) of the scene.
/// For isolated particles, the scale is the distance `v²/g`, in which gravity `g` generates the start speed `v`.
/// If the distance `v²/g` is very short, the length scale is the largest distance of a body from the origin.
///
/// For a scene without length scale, such as a particle that starts at the origin almost at rest, the function returns 1 [length].
pub(super) fn length_of(scene: &Scene) -> f64 {
    let is_length = |length: &f64| *length > 0.0 && length.is_finite();
    let places = scene.particles.iter().map(|particle| particle.position);
    let places = places.chain(scene.rigid_bodies.iter().map(|body| body.position));
    let farthest = places.map(|place| place.norm()).fold(0.0, larger);
    let of_particles = || {
        let way = Some(square(start_speed(scene)) / scene.gravity.norm()).filter(is_length);
        let least = SHORTEST_WAY * if farthest > 0.0 { farthest } else { 1.0 };
        let long = way.filter(|way| *way > least);
        long.or(Some(farthest).filter(is_length))
    };
    scene.size().or_else(of_particles).unwrap_or(1.0)
}

fn start_speed(scene: &Scene) -> f64 {
    let nodes = scene.velocities.iter().map(|start| start.velocity);
    let bodies = scene.rigid_bodies.iter().map(|body| body.motion.velocity);
    nodes.chain(bodies).map(|velocity| velocity.norm()).fold(0.0, larger)
}

/// Shortest time in which an axial wave passes a span [time]; `None` without beams.
pub(super) fn shortest_wave_time(scene: &Scene) -> Option<f64> {
    let waves = scene.beams.iter().map(|beam| {
        beam.axis.length() / (beam.mesh.spans() as f64 * beam.section.axial_wave_speed())
    });
    waves.reduce(f64::min)
}

/// Initial size of variable steps [time].
///
/// With beams, the first step is the [shortest wave time](shortest_wave_time).
/// Without beams, the first step is a fraction of the time in which start velocities or weight displace a body by the length scale.
/// Without start velocities and weight, the other forces determine the first step. If nothing moves, the time scale is 1 [time].
pub(super) fn first_step(scene: &Scene, model: &mut System) -> f64 {
    if let Some(shortest) = shortest_wave_time(scene) {
        return shortest;
    }
    let length = length_of(scene);
    let after_falling_as_far = (length * scene.gravity.norm()).sqrt();
    let speed = larger(fastest(model, model.rates(), length), after_falling_as_far);
    if speed > 0.0 {
        return PART * length / speed;
    }
    let pushed = model.instant().map_or(0.0, |now| fastest(model, now.accelerations(), length));
    PART * if pushed > 0.0 { (length / pushed).sqrt() } else { 1.0 }
}

/// Largest rate of a position, or of an angle multiplied by `length`.
/// Rates of prescribed degrees of freedom are at the end of `rates`. These rates are not multiplied by `length`, even for angles.
fn fastest(model: &System, rates: &[f64], length: f64) -> f64 {
    let kinds = model.unknown_kinds().iter().map(Some).chain(std::iter::repeat(None));
    let rates = rates.iter().zip(kinds).map(|(rate, kind)| match kind {
        Some(UnknownKind::Rotation) => length * rate.abs(),
        Some(UnknownKind::Force) => 0.0,
        _ => rate.abs(),
    });
    rates.fold(0.0, larger)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vec2;
    use crate::loads::{LoadFrame, LoadKind, Schedule};
    use crate::system::{ParticleDefinition, StationVelocity};

    const LENGTHS: [f64; 4] = [1e-9, 1e-3, 1.0, 1e6];

    fn particle(at: Vec2, velocity: Vec2, gravity: f64, force: f64, (a, t): (f64, f64)) -> Scene {
        let mut scene = Scene::new("isolated");
        let bead = ParticleDefinition { name: "bead".to_owned(), position: at * a };
        let station = scene.add_particle(bead, 1.0).unwrap();
        let velocity = velocity * (a / t);
        scene.velocities.push(StationVelocity { station, velocity, spin: None });
        scene.gravity = Vec2::new(0.0, -gravity) * (a / (t * t));
        let force = Vec2::new(force, 0.0) * (a / (t * t));
        let kind = LoadKind::Force { station, force, frame: LoadFrame::Dead };
        scene.add_load(kind, Schedule::constant(1.0).unwrap());
        scene
    }

    #[test]
    fn first_step_of_isolated_particles_scales_with_the_units() {
        let above = Vec2::new(0.0, 10.0);
        let (rest, fast, slow) = (Vec2::zeros(), Vec2::new(1.0, 0.0), Vec2::new(1e-3, 0.0));
        for (at, velocity, gravity, force) in [
            (above, fast, 9.81, 0.0),
            (above, slow, 9.81, 0.0),
            (above, rest, 9.81, 0.0),
            (above, rest, 0.0, 3.0),
        ] {
            let scales = |units| {
                let scene = particle(at, velocity, gravity, force, units);
                let mut model = System::assemble(&scene).unwrap();
                (length_of(&scene) / units.0, first_step(&scene, &mut model) / units.1)
            };
            let (length, step) = scales((1.0, 1.0));
            for units in LENGTHS.into_iter().flat_map(|a| [1e-6, 1.0, 1e4].map(|t| (a, t))) {
                let (other, own) = scales(units);
                assert!((other / length - 1.0).abs() < 1e-12, "{units:?}: {other} {length}");
                assert!((own / step - 1.0).abs() < 1e-12, "{units:?}: {own} {step}");
            }
        }
    }
}
