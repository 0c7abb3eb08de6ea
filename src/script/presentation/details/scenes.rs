//! Summaries of scenes and their objects.

use super::entries::{line, listed, number, pair};
use crate::beams::{BodyIndex, Section, Station};
use crate::geometry::Vec2;
use crate::joints::{EndAction, Slider, StartVelocities, TrackBeam, TrackDirection, TrackEnd};
use crate::script::bindings::kind::Details;
use crate::system::{BeamDefinition, Scene};

pub fn of_scene(scene: &Scene) -> Details {
    let beam = |beam: &BeamDefinition| format!("{} ({})", beam.name, number(beam.axis.length()));
    let loads: Vec<String> = scene.loads().map(|load| load.name.clone()).collect();
    let kinds = [
        ("beams (length)", listed(scene.beams.iter().map(beam))),
        ("particles", listed(scene.particles.iter().map(|particle| particle.name.clone()))),
        ("bodies", listed(scene.rigid_bodies.iter().map(|body| body.name.clone()))),
        ("joints", listed(scene.joints.iter().map(|joint| joint.name.clone()))),
        ("tracks", listed(scene.tracks.iter().map(|track| track.name.clone()))),
        ("sliders", listed(scene.sliders.iter().map(|slider| slider.name.clone()))),
        ("loads", listed(loads.into_iter())),
    ];
    let mut details = vec![line("mass", number(scene.mass()))];
    details
        .extend(kinds.into_iter().filter(|(_, all)| !all.is_empty()).map(|(l, all)| line(l, all)));
    if scene.gravity != Vec2::zeros() {
        details.push(line("gravity", pair(scene.gravity)));
    }
    let is_moving = |beam: &&BeamDefinition| beam.starts_in_motion();
    let moving = (scene.beams.iter().filter(is_moving).count(), scene.velocities.len());
    let bodies = scene.rigid_bodies.iter().filter(|body| body.starts_in_motion()).count();
    details.push(line(
        "at the start",
        match (moving, bodies) {
            ((0, 0), 0) => "at rest".to_owned(),
            ((beams, nodes), 0) => format!("beams that move: {beams}, single nodes: {nodes}"),
            ((beams, nodes), bodies) => {
                format!("beams that move: {beams}, bodies: {bodies}, single nodes: {nodes}")
            }
        },
    ));
    details
}

pub fn of_beam(scene: &Scene, index: usize) -> Details {
    let beam = &scene.beams[index];
    let BeamDefinition { axis, mesh, section, motion, .. } = beam;
    let (start, end) = axis.domain();
    let ends = axis.point(start).ok().zip(axis.point(end).ok());
    let ends = ends.map(|(start, end)| line("ends", format!("{} … {}", pair(start), pair(end))));
    let (tapers, section) = (section.places().len() > 1, section.mean());
    let [ea, ga, ei] =
        [section.axial_stiffness, section.shear_stiffness, section.bending_stiffness];
    let stiffness = format!("EA {}, GA {}, EI {}", number(ea), number(ga), number(ei));
    let held: Vec<String> = scene.joints_of(index).map(|joint| joint.name.clone()).collect();
    let moving = format!("velocity {}, spin {}", pair(motion.velocity), number(motion.spin));
    let lines = [
        ends,
        Some(line("control points", mesh.basis().functions().to_string())),
        Some(line(if tapers { "mean stiffness" } else { "stiffness" }, stiffness)),
        Some(line("mass", number(beam.mass()))),
        (!held.is_empty()).then(|| line("joints", listed(held.into_iter()))),
        beam.starts_in_motion().then(|| line("at the start", moving)),
    ];
    lines.into_iter().flatten().collect()
}

pub fn of_rigid_body(scene: &Scene, index: usize) -> Details {
    let body = &scene.rigid_bodies[index];
    let centre = Station::on_rigid_body(index, 0);
    let own = scene.masses().find(|mass| mass.station == centre);
    let (mass, inertia) = own.map_or((0.0, 0.0), |own| (own.mass, own.rotary_inertia));
    let points = body.points.iter().map(|(name, at)| format!("{name} {}", pair(*at)));
    let moving =
        format!("velocity {}, spin {}", pair(body.motion.velocity), number(body.motion.spin));
    let lines = [
        Some(line("centre", pair(body.position))),
        Some(line("angle", number(body.angle))),
        Some(line("mass", number(mass))),
        Some(line("inertia", number(inertia))),
        (!body.points.is_empty()).then(|| line("points", listed(points))),
        body.starts_in_motion().then(|| line("at the start", moving)),
    ];
    lines.into_iter().flatten().collect()
}

pub fn of_station(scene: &Scene, station: &Station) -> Details {
    let along = match station.body {
        BodyIndex::Beam(beam) => {
            let length = scene.beams[beam].axis.length();
            let part = number(station.arc_length / length);
            let s = number(station.arc_length);
            Some(line("arc length", format!("{s} of {}, {part} of it", number(length))))
        }
        BodyIndex::Particle(_) | BodyIndex::Rigid(..) => None,
    };
    let at = scene.drawn_at(station).ok().map(|at| line("drawn at", pair(at)));
    along.into_iter().chain(at).collect()
}

pub fn of_section(section: &Section) -> Details {
    let properties = [
        ("EA [force]", section.axial_stiffness),
        ("GA [force]", section.shear_stiffness),
        ("EI [force·length²]", section.bending_stiffness),
        ("rho_A [mass/length]", section.mass_per_length),
        ("rho_I [mass·length]", section.rotary_inertia),
    ];
    let speeds = [
        line("axial wave [length/time]", number(section.axial_wave_speed())),
        line("shear wave [length/time]", number(section.shear_wave_speed())),
    ];
    properties.into_iter().map(|(label, value)| line(label, number(value))).chain(speeds).collect()
}

pub fn guide_of(scene: &Scene, slider: &Slider) -> (String, f64) {
    let Slider { master, arc_length, track, .. } = *slider;
    match track {
        None => {
            let beam = &scene.beams[master];
            (format!("beam '{}'", beam.name), arc_length / beam.axis.length())
        }
        Some(track) => {
            let along = scene.length_along_track(track, master, arc_length);
            let name = format!("track '{}'", scene.tracks[track].name);
            (name, along / scene.track_length(track))
        }
    }
}

pub fn of_track(scene: &Scene, index: usize) -> Details {
    let track = &scene.tracks[index];
    let leg = |leg: &TrackBeam| {
        let name = &scene.beams[leg.beam].name;
        match leg.heading {
            TrackDirection::Forward => name.clone(),
            TrackDirection::Backward => format!("{name} (from its end to its start)"),
        }
    };
    let behind = match track.end {
        TrackEnd::Open => "the track ends",
        TrackEnd::Closed => "continues on the first beam",
    };
    vec![
        line("length", number(scene.track_length(index))),
        line("along", listed(track.beams.iter().map(leg))),
        line("behind the last beam", behind),
    ]
}

pub fn of_slider(scene: &Scene, index: usize) -> Details {
    let slider = &scene.sliders[index];
    let guide = guide_of(scene, slider);
    let ends = match slider.ends {
        EndAction::Stop => "the run stops".to_owned(),
        EndAction::Bounce if slider.restitution < 1.0 => {
            format!("bounces with {} of its speed", number(slider.restitution))
        }
        EndAction::Bounce => "bounces".to_owned(),
        EndAction::Contact => "stays in elastic contact".to_owned(),
        EndAction::Release => "is released".to_owned(),
    };
    let velocities = match slider.velocities {
        StartVelocities::Check => "must be compatible with the beam",
        StartVelocities::Project => "are projected to the beam",
    };
    let friction = (slider.friction > 0.0).then(|| line("friction", number(slider.friction)));
    let lines = vec![
        line("slides", scene.describe(&slider.slave)),
        line("on", format!("{}, from {} of its length", guide.0, number(guide.1))),
        line("rule", slider.rule.entry().name),
        line("at the ends", ends),
        line("start velocities", velocities),
    ];
    let side = slider.side().map(|side| {
        let restitution = number(slider.restitution);
        line("leaves on", format!("the {} side, lands with restitution {restitution}", side.name()))
    });
    let sleeve = slider.is_sleeve().then(|| line("restrains", "place and direction"));
    lines.into_iter().chain(friction).chain(side).chain(sleeve).collect()
}
