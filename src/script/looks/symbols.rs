//! The symbols of a scene: supports, joints, sliders and loads where they are at some time.

use crate::beams::Station;
use crate::geometry::Vec2;
use crate::joints::{JointKind, Partner};
use crate::loads::{Frame, Load, LoadKind, Side};
use crate::model::{ModelError, Scene};
use crate::output::{PlacedSymbol, Symbol};

/// The arrows of a load that is spread along a beam.
const ARROWS: usize = 5;
/// The direction of a beam is looked for so far around a place, as a part of its length.
const AROUND: f64 = 1e-3;

/// A symbol that has not been placed yet.
struct Unplaced {
    symbol: Symbol,
    at: Station,
    pointing: Pointing,
}

/// Where a symbol points.
enum Pointing {
    /// In space.
    To(Vec2),
    /// With the beam: components along it and to its left.
    WithBeam(Vec2),
}

/// The symbols of a scene at a time. `places` finds stations; loads that are zero then have none.
///
/// # Errors
/// Those of `places`.
pub fn symbols(
    scene: &Scene,
    time: f64,
    places: impl FnOnce(&[Station]) -> Result<Vec<Vec2>, ModelError>,
) -> Result<Vec<PlacedSymbol>, ModelError> {
    let unplaced: Vec<Unplaced> =
        of_joints(scene).chain(of_sliders(scene)).chain(of_loads(scene, time)).collect();
    // For each its place, and one before and one behind it on its beam.
    let around = unplaced.iter().flat_map(|symbol| around(scene, &symbol.at));
    let found = places(&around.collect::<Vec<_>>())?;
    let placed = unplaced.iter().zip(found.chunks_exact(3)).map(|(symbol, found)| {
        let along = found[2] - found[1];
        let direction = match symbol.pointing {
            Pointing::To(direction) => direction,
            Pointing::WithBeam(part) => {
                let along = if along.norm() > 0.0 { along.normalize() } else { Vec2::x() };
                along * part.x + Vec2::new(-along.y, along.x) * part.y
            }
        };
        let plain = |vector: Vec2| (vector.x, vector.y);
        PlacedSymbol { symbol: symbol.symbol, at: plain(found[0]), direction: plain(direction) }
    });
    Ok(placed.collect())
}

fn around(scene: &Scene, at: &Station) -> [Station; 3] {
    let Some(beam) = at.beam() else { return [*at; 3] };
    let length = scene.beams[beam].axis.length();
    let moved = |by: f64| Station::on_beam(beam, (at.arc_length + by * length).clamp(0.0, length));
    [*at, moved(-AROUND), moved(AROUND)]
}

fn of_joints(scene: &Scene) -> impl Iterator<Item = Unplaced> + '_ {
    scene.joints.iter().map(|joint| {
        let symbol = match (joint.kind, joint.partner) {
            (JointKind::Hinge, Partner::Ground) | (JointKind::Support(_), _) => Symbol::Hinge,
            (JointKind::Rigid, Partner::Ground) => Symbol::Clamp,
            (JointKind::Hinge, Partner::Station(_)) => Symbol::Joint,
            (JointKind::Rigid, Partner::Station(_)) => Symbol::RigidJoint,
        };
        let length = joint.station.beam().map(|beam| scene.beams[beam].axis.length());
        // Away from a support that stands at the end of a beam the beam runs backwards.
        let leaves = if length == Some(joint.station.arc_length) { -Vec2::x() } else { Vec2::x() };
        Unplaced { symbol, at: joint.station, pointing: Pointing::WithBeam(leaves) }
    })
}

fn of_sliders(scene: &Scene) -> impl Iterator<Item = Unplaced> + '_ {
    scene.sliders.iter().map(|slider| Unplaced {
        symbol: Symbol::Slider,
        at: slider.slave,
        pointing: Pointing::To(Vec2::zeros()),
    })
}

fn of_loads(scene: &Scene, time: f64) -> impl Iterator<Item = Unplaced> + '_ {
    let pointing = |force: Vec2, frame: Frame| match frame {
        Frame::Dead => Pointing::To(force),
        Frame::Follower => Pointing::WithBeam(force),
    };
    scene.loads().flat_map(move |load| {
        let factor = factor(load, time);
        let symbols = match load.kind {
            _ if factor == 0.0 => Vec::new(),
            LoadKind::Force { station, force, frame } => {
                let pointing = pointing(force * factor, frame);
                vec![Unplaced { symbol: Symbol::Force, at: station, pointing }]
            }
            LoadKind::Moment { station, moment } => {
                let pointing = Pointing::To(Vec2::x() * (moment * factor));
                vec![Unplaced { symbol: Symbol::Moment, at: station, pointing }]
            }
            LoadKind::Line { beam, force, frame } => {
                let length = scene.beams[beam].axis.length();
                let arrow = |index: usize| Unplaced {
                    symbol: Symbol::LineForce,
                    at: Station::on_beam(beam, length * (index as f64 + 0.5) / ARROWS as f64),
                    pointing: pointing(force * factor, frame),
                };
                (0..ARROWS).map(arrow).collect()
            }
        };
        symbols.into_iter()
    })
}

/// The sign with which a load acts just before a time, at the start just after it. Functions of a script are not asked for a picture.
fn factor(load: &Load, time: f64) -> f64 {
    if load.schedule.functions() > 0 {
        return 1.0;
    }
    let side = if time > 0.0 { Side::Before } else { Side::After };
    load.schedule.value(time, side).unwrap_or(1.0)
}
