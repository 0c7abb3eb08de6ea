//! The symbols of a scene: supports, joints, sliders and loads where they are at some time.

use crate::beams::Station;
use crate::geometry::Vec2;
use crate::joints::{Hold, JointKind, Partner};
use crate::loads::{Frame, Load, LoadKind, Side};
use crate::model::{Anchor, ModelError, Scene, Spring, SpringKind};
use crate::output::{PlacedSymbol, Symbol};
use crate::simulation::Simulation;

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

/// A scene at a time.
pub struct SceneAt<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The time.
    pub time: f64,
    /// What has let go.
    pub released: Vec<Hold>,
}

impl<'a> SceneAt<'a> {
    /// That of a simulation.
    pub fn of(simulation: &'a Simulation, time: f64) -> Self {
        let scene = simulation.scene();
        let holds = scene.holds().into_iter().map(|(_, hold)| hold);
        let is_gone = |hold: &Hold| simulation.release_of(*hold).is_some_and(|at| at < time);
        Self { scene, time, released: holds.filter(is_gone).collect() }
    }
}

/// The symbols of a scene at a time. `places` finds stations; loads that are zero then have none.
///
/// # Errors
/// Those of `places`.
pub fn symbols(
    at: &SceneAt,
    places: impl FnOnce(&[Station]) -> Result<Vec<Vec2>, ModelError>,
) -> Result<Vec<PlacedSymbol>, ModelError> {
    let SceneAt { scene, time, .. } = *at;
    let unplaced: Vec<Unplaced> =
        of_joints(at).chain(of_sliders(at)).chain(of_loads(scene, time)).collect();
    // For each its place, and one before and one behind it on its beam; then those of springs.
    let around = unplaced.iter().flat_map(|symbol| around(scene, &symbol.at));
    let springs = scene.springs().enumerate();
    let springs = springs.filter(|(index, _)| !at.released.contains(&Hold::Spring(*index)));
    let springs = springs.map(|(_, spring)| spring);
    let of_springs = springs.clone().flat_map(|spring| spring.stations()).copied();
    let found = places(&around.chain(of_springs).collect::<Vec<_>>())?;
    let (found, of_springs) = found.split_at(3 * unplaced.len());
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
    let mut ends = of_springs.iter().copied();
    Ok(placed.chain(springs.flat_map(|spring| of_spring(spring, &mut ends))).collect())
}

/// The symbols of a spring, whose stations come next among the places found: a tendon has one for each part of its way.
fn of_spring(spring: &Spring, found: &mut impl Iterator<Item = Vec2>) -> Vec<PlacedSymbol> {
    let place = |anchor: &Anchor| match anchor {
        Anchor::Station(_) => found.next(),
        Anchor::Ground(at) => Some(*at),
    };
    let way: Vec<Vec2> = spring.anchors().iter().filter_map(place).collect();
    let plain = |vector: Vec2| (vector.x, vector.y);
    let placed = |symbol, at: Vec2, direction: Vec2| PlacedSymbol {
        symbol,
        at: plain(at),
        direction: plain(direction),
    };
    if let SpringKind::Torsion(anchors) = &spring.kind {
        let moving = anchors.iter().rposition(|anchor| matches!(anchor, Anchor::Station(_)));
        let at = moving.and_then(|index| way.get(index));
        return at
            .map(|at| placed(Symbol::TorsionSpring, *at, Vec2::zeros()))
            .into_iter()
            .collect();
    }
    let symbol = match spring.law {
        _ if way.len() > 2 => Symbol::Tendon,
        None => Symbol::Damper,
        Some(_) => Symbol::Spring,
    };
    let parts = way.windows(2).map(|part| placed(symbol, part[0], part[1] - part[0]));
    let on_ground = spring.anchors().iter().filter_map(|anchor| match anchor {
        Anchor::Ground(at) => Some(placed(Symbol::Joint, *at, Vec2::zeros())),
        Anchor::Station(_) => None,
    });
    parts.chain(on_ground).collect()
}

fn around(scene: &Scene, at: &Station) -> [Station; 3] {
    let Some(beam) = at.beam() else { return [*at; 3] };
    let length = scene.beams[beam].axis.length();
    let moved = |by: f64| Station::on_beam(beam, (at.arc_length + by * length).clamp(0.0, length));
    [*at, moved(-AROUND), moved(AROUND)]
}

fn of_joints<'a>(at: &'a SceneAt) -> impl Iterator<Item = Unplaced> + 'a {
    let scene = at.scene;
    let holding = |(index, _): &(usize, _)| !at.released.contains(&Hold::Joint(*index));
    scene.joints.iter().enumerate().filter(holding).map(|(_, joint)| {
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

fn of_sliders<'a>(at: &'a SceneAt) -> impl Iterator<Item = Unplaced> + 'a {
    let holding = |(index, _): &(usize, _)| !at.released.contains(&Hold::Slider(*index));
    at.scene.sliders.iter().enumerate().filter(holding).map(|(_, slider)| Unplaced {
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
