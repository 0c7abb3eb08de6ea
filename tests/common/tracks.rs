//! Tracks of straight and curved beams, and beads on them.

use super::scenes::end_of;
use super::sliding::{particle, slider};
use withy::beams::{Section, Station};
use withy::geometry::Vec2;
use withy::joints::{
    EndAction, Joint, JointKind, Partner, Slider, SlidingRule, StartVelocities, TrackEnd,
};
use withy::system::{Scene, StationVelocity};

/// Section of mass per length 1 with equal axial and shear stiffness.
pub fn section(stiffness: f64, bending: f64) -> Section {
    Section {
        axial_stiffness: stiffness,
        shear_stiffness: stiffness,
        bending_stiffness: bending,
        mass_per_length: 1.0,
        rotary_inertia: 0.01,
    }
}

pub fn ends(scene: &mut Scene, beam: usize) -> [Station; 2] {
    [scene.station(beam, 0.0).unwrap(), end_of(scene, beam)]
}

pub fn hold(scene: &mut Scene, kind: JointKind, stations: &[Station]) {
    stations.iter().for_each(|at| scene.join(kind, *at, Partner::Ground).unwrap());
}

/// Makes a track of beams. Each beam is joined to the next one at their common end point.
pub fn track(scene: &mut Scene, beams: &[usize], course: TrackEnd) -> usize {
    let closing = (course == TrackEnd::Closed).then(|| [beams[beams.len() - 1], beams[0]]);
    let pairs: Vec<[usize; 2]> =
        beams.windows(2).map(|pair| [pair[0], pair[1]]).chain(closing).collect();
    for [one, other] in pairs {
        let (ours, theirs) = (ends(scene, one), ends(scene, other));
        let meets = |a: &Station, b: &Station| {
            a != b && (scene.drawn_at(a).unwrap() - scene.drawn_at(b).unwrap()).norm() < 1e-12
        };
        let pair = ours.iter().flat_map(|a| theirs.iter().map(move |b| (*a, *b)));
        let is_joined = |at: &Station| {
            let ties = |joint: &Joint| match joint.partner {
                Partner::Station(other) => joint.station == *at || other == *at,
                Partner::Ground => false,
            };
            scene.joints.iter().any(ties)
        };
        let mut pairs = pair.into_iter().filter(|(a, b)| meets(a, b) && !is_joined(a));
        let (a, b) = pairs.next().unwrap();
        scene.join(JointKind::Rigid, a, Partner::Station(b)).unwrap();
    }
    scene.add_track(scene.free_name("track"), beams, course).unwrap()
}

/// Adds a bead to a track at an arc length along the track. Returns the index of its slider.
pub fn bead(scene: &mut Scene, track: usize, along: f64, mass: f64, velocity: Vec2) -> usize {
    let (master, arc_length) = scene.place_on_track(track, along);
    let place = scene.drawn_at(&Station::on_beam(master, arc_length)).unwrap();
    let station = particle(scene, place, mass);
    scene.velocities.push(StationVelocity { station, velocity, spin: None });
    let (name, velocities) = (scene.free_name("slider"), StartVelocities::Project);
    let on_beam = slider(station, master, arc_length, SlidingRule::Conserving);
    let ends = EndAction::Bounce;
    scene.add_slider(Slider { name, ends, velocities, track: Some(track), ..on_beam }).unwrap()
}
