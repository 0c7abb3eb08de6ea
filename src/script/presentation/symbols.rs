//! Symbols of a scene at a time: supports, joints, sliders, springs, loads and obstacles.

use crate::beams::Station;
use crate::elementary::atan2;
use crate::geometry::{Vec2, perpendicular};
use crate::joints::{Component, Components, Joint, JointKind, Partner, Releasable};
use crate::loads::{LimitSide, Load, LoadFrame, LoadKind, Schedule};
use crate::output::{PlacedSymbol, Symbol};
use crate::simulation::Simulation;
use crate::statics::Equilibrium;
use crate::system::{Anchor, Drive, ObstacleShape, Scene, Spring, SpringKind, System, SystemError};

const ARROWS: usize = 5;
/// Distance from a station to the points from which its tangent is computed, as a fraction of the beam length.
const AROUND: f64 = 1e-3;

pub struct StationSymbol<'a> {
    pub symbol: Symbol,
    pub name: &'a str,
    pub at: Station,
    pub pointing: Pointing,
    pub hold: Option<Releasable>,
}

pub enum Pointing {
    /// Direction in space, independent of the beam.
    To(Vec2),
    /// Direction relative to the beam, with components along the beam and to its left.
    WithBeam(Vec2),
}

impl Pointing {
    fn direction(&self, along: Vec2) -> Vec2 {
        match self {
            Self::To(direction) => *direction,
            Self::WithBeam(part) => {
                let along = if along.norm() > 0.0 { along.normalize() } else { Vec2::x() };
                along * part.x + Vec2::new(-along.y, along.x) * part.y
            }
        }
    }

    /// Angle in space [rad] of the direction, for a beam with the angle `along` [rad].
    pub fn angle(&self, along: f64) -> f64 {
        match self {
            Self::To(direction) => atan2(direction.y, direction.x),
            Self::WithBeam(part) => along + atan2(part.y, part.x),
        }
    }
}

pub struct SceneAt<'a> {
    pub scene: &'a Scene,
    pub time: f64,
    pub released: Vec<Releasable>,
}

impl<'a> SceneAt<'a> {
    pub fn of(simulation: &'a Simulation, time: f64) -> Self {
        let scene = simulation.scene();
        let holds = scene.releasables().into_iter().map(|(_, hold)| hold);
        let is_gone = |hold: &Releasable| simulation.release_of(*hold).is_some_and(|at| at < time);
        Self { scene, time, released: holds.filter(is_gone).collect() }
    }

    pub fn at_rest(rest: &'a Equilibrium) -> Self {
        Self { scene: rest.scene(), time: 0.0, released: Vec::new() }
    }

    /// Symbols in the present configuration of a model.
    ///
    /// # Errors
    /// Fails if a station lies outside its beam.
    pub fn symbols(&self, model: &System) -> Result<Vec<PlacedSymbol>, SystemError> {
        let place = |at: &_| Ok(model.position(&self.scene.place(at, model.meshes())?));
        symbols(self, |stations| stations.iter().map(place).collect())
    }
}

/// Symbols of a scene at a time, without zero loads and without released joints, sliders and springs.
/// `places` returns the positions of stations.
pub fn symbols(
    at: &SceneAt,
    places: impl FnOnce(&[Station]) -> Result<Vec<Vec2>, SystemError>,
) -> Result<Vec<PlacedSymbol>, SystemError> {
    let SceneAt { scene, time, .. } = *at;
    let is_there = |sign: &StationSymbol| sign.hold.is_none_or(|hold| !at.released.contains(&hold));
    let held = of_supports(scene).chain(of_sliders(scene)).filter(is_there);
    let unplaced: Vec<StationSymbol> = held.chain(of_loads(scene, time)).collect();
    let around = unplaced.iter().flat_map(|symbol| around(scene, &symbol.at));
    let springs = scene.springs().enumerate();
    let springs = springs.filter(|(index, _)| !at.released.contains(&Releasable::Spring(*index)));
    let springs = springs.map(|(_, spring)| spring);
    let of_springs = springs.clone().flat_map(|spring| spring.stations()).copied();
    let found = places(&around.chain(of_springs).collect::<Vec<_>>())?;
    let (found, of_springs) = found.split_at(3 * unplaced.len());
    let placed = unplaced.iter().zip(found.chunks_exact(3)).map(|(symbol, found)| {
        let direction = symbol.pointing.direction(found[2] - found[1]);
        let plain = |vector: Vec2| (vector.x, vector.y);
        PlacedSymbol { symbol: symbol.symbol, at: plain(found[0]), direction: plain(direction) }
    });
    let mut ends = of_springs.iter().copied();
    let springs = springs.flat_map(|spring| of_spring(spring, &mut ends));
    Ok(placed.chain(springs).chain(of_obstacles(scene).map(|(_, placed)| placed)).collect())
}

pub fn of_obstacles(scene: &Scene) -> impl Iterator<Item = (&str, PlacedSymbol)> {
    scene.obstacles().map(|obstacle| {
        let (symbol, at, direction) = match obstacle.shape {
            ObstacleShape::HalfPlane { point, normal } => (Symbol::Wall, point, normal),
            ObstacleShape::Disc { centre, radius } => (Symbol::Disc, centre, Vec2::x() * radius),
        };
        let plain = |vector: Vec2| (vector.x, vector.y);
        let placed = PlacedSymbol { symbol, at: plain(at), direction: plain(direction) };
        (obstacle.name.as_str(), placed)
    })
}

const MOST_CONSTRAINTS: usize = 60;

/// Removes the symbols of supports, joints and sliders if there are too many of them.
pub fn uncrowded(symbols: Vec<PlacedSymbol>) -> Vec<PlacedSymbol> {
    let holds = |placed: &PlacedSymbol| placed.symbol.is_constraint();
    match symbols.iter().filter(|placed| holds(placed)).count() > MOST_CONSTRAINTS {
        true => symbols.into_iter().filter(|placed| !holds(placed)).collect(),
        false => symbols,
    }
}

fn of_spring(spring: &Spring, found: &mut impl Iterator<Item = Vec2>) -> Vec<PlacedSymbol> {
    let place = |anchor: &Anchor| match anchor {
        Anchor::Station(_) => found.next(),
        Anchor::Ground(at) => Some(*at),
    };
    let path: Vec<Vec2> = spring.anchors().iter().filter_map(place).collect();
    let plain = |vector: Vec2| (vector.x, vector.y);
    let placed = |symbol, at: Vec2, direction: Vec2| PlacedSymbol {
        symbol,
        at: plain(at),
        direction: plain(direction),
    };
    let symbol = of_spring_kind(spring);
    if spring.kind.is_angle() {
        let moving =
            spring.anchors().iter().rposition(|anchor| matches!(anchor, Anchor::Station(_)));
        let at = moving.and_then(|index| path.get(index));
        return at.map(|at| placed(symbol, *at, Vec2::zeros())).into_iter().collect();
    }
    let parts = path.windows(2).map(|part| placed(symbol, part[0], part[1] - part[0]));
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

pub fn of_spring_kind(spring: &Spring) -> Symbol {
    match (&spring.kind, &spring.law) {
        (SpringKind::Torsion(_) | SpringKind::Brake { .. }, _) => Symbol::TorsionSpring,
        (SpringKind::Length(path), _) if path.len() > 2 => Symbol::Tendon,
        (SpringKind::Length(_), None) => Symbol::Damper,
        (SpringKind::Length(_), Some(_)) => Symbol::Spring,
    }
}

pub fn of_supports(scene: &Scene) -> impl Iterator<Item = StationSymbol<'_>> {
    let joints = scene.joints.iter().enumerate();
    let joints = joints.map(|(index, joint)| of_joint(scene, joint, Releasable::Joint(index)));
    joints.chain(scene.drives.iter().flat_map(|drive| of_drive(scene, drive)))
}

pub fn of_sliders(scene: &Scene) -> impl Iterator<Item = StationSymbol<'_>> {
    scene.sliders.iter().enumerate().map(|(index, slider)| StationSymbol {
        hold: Some(Releasable::Slider(index)),
        symbol: Symbol::Slider,
        name: &slider.name,
        at: slider.slave,
        pointing: Pointing::To(Vec2::zeros()),
    })
}

fn of_joint<'a>(scene: &Scene, joint: &'a Joint, hold: Releasable) -> StationSymbol<'a> {
    let at = joint.station;
    let (symbol, pointing) = match (joint.kind, joint.partner) {
        (JointKind::Hinge, Partner::Ground) => of_held(scene, &at, Components::Position),
        (JointKind::Rigid, Partner::Ground) => of_held(scene, &at, Components::All),
        (JointKind::Support(components), _) => of_held(scene, &at, components),
        (JointKind::InclinedRoller(along), _) => (Symbol::Roller, across(along)),
        (JointKind::InclinedGuide(along), _) => (Symbol::Guided, across(along)),
        (JointKind::Hinge, Partner::Station(_)) => (Symbol::Joint, away(scene, &at)),
        (JointKind::Rigid, Partner::Station(_)) => (Symbol::RigidJoint, away(scene, &at)),
    };
    StationSymbol { symbol, name: &joint.name, at, pointing, hold: Some(hold) }
}

fn of_held(scene: &Scene, at: &Station, held: Components) -> (Symbol, Pointing) {
    match held {
        Components::X => (Symbol::Roller, Pointing::To(Vec2::x())),
        Components::Y => (Symbol::Roller, Pointing::To(Vec2::y())),
        Components::XRotation => (Symbol::Guided, Pointing::To(Vec2::x())),
        Components::YRotation => (Symbol::Guided, Pointing::To(Vec2::y())),
        Components::Rotation => (Symbol::HeldAngle, Pointing::To(Vec2::x())),
        Components::Position => (Symbol::Hinge, Pointing::To(Vec2::y())),
        Components::All => (Symbol::Clamp, away(scene, at)),
    }
}

/// Normal direction of an inclined roller, upwards, so that the support is below the beam.
fn across(along: Vec2) -> Pointing {
    let across = perpendicular(along);
    Pointing::To(if across.y < 0.0 { -across } else { across })
}

fn away(scene: &Scene, at: &Station) -> Pointing {
    let is_end = at.beam().is_some() && at.arc_length > 0.5 * scene.length_at(at);
    Pointing::WithBeam(if is_end { -Vec2::x() } else { Vec2::x() })
}

fn of_drive<'a>(scene: &Scene, drive: &'a Drive) -> Vec<StationSymbol<'a>> {
    let is_moved = |component: Component| {
        let motion = drive.motions[component as usize].as_ref();
        motion.is_some_and(
            |motion| !matches!(motion.schedule(), Schedule::Constant(to) if *to == 0.0),
        )
    };
    let (name, at) = (drive.name.as_str(), drive.station);
    let sign = |(symbol, pointing)| StationSymbol { symbol, name, at, pointing, hold: None };
    let along = [(Component::X, Vec2::x()), (Component::Y, Vec2::y())];
    let carried = along.into_iter().filter(|(component, _)| is_moved(*component));
    let mut signs: Vec<StationSymbol> =
        carried.map(|(_, direction)| sign((Symbol::Carriage, Pointing::To(direction)))).collect();
    if signs.is_empty() {
        let held = Components::among(|component| drive.drives(component) && !is_moved(component));
        signs.extend(held.map(|held| sign(of_held(scene, &drive.station, held))));
    }
    if is_moved(Component::Rotation) {
        signs.push(sign((Symbol::Motor, Pointing::To(Vec2::x()))));
    }
    signs
}

fn of_loads(scene: &Scene, time: f64) -> impl Iterator<Item = StationSymbol<'_>> {
    let pointing = |force: Vec2, frame: LoadFrame| match frame {
        LoadFrame::Dead => Pointing::To(force),
        LoadFrame::Follower => Pointing::WithBeam(force),
    };
    scene.loads().flat_map(move |load| {
        let (factor, name) = (factor(load, time), load.name.as_str());
        let symbols = match load.kind {
            _ if factor == 0.0 => Vec::new(),
            LoadKind::Force { station, force, frame } => {
                let pointing = pointing(force * factor, frame);
                vec![StationSymbol {
                    symbol: Symbol::Force,
                    name,
                    at: station,
                    pointing,
                    hold: None,
                }]
            }
            LoadKind::Moment { station, moment } => {
                let pointing = Pointing::To(Vec2::x() * (moment * factor));
                vec![StationSymbol {
                    symbol: Symbol::Moment,
                    name,
                    at: station,
                    pointing,
                    hold: None,
                }]
            }
            LoadKind::Line { beam, force, frame } => {
                let length = scene.beams[beam].axis.length();
                let arrow = |index: usize| StationSymbol {
                    symbol: Symbol::LineForce,
                    name,
                    at: Station::on_beam(beam, length * (index as f64 + 0.5) / ARROWS as f64),
                    pointing: pointing(force * factor, frame),
                    hold: None,
                };
                (0..ARROWS).map(arrow).collect()
            }
        };
        symbols.into_iter()
    })
}

/// Value of the schedule of a load at a time; at a jump, the value before it, except at time zero.
/// A schedule with a script function has the value 1, because script functions are not called here.
fn factor(load: &Load, time: f64) -> f64 {
    if load.schedule.functions() > 0 {
        return 1.0;
    }
    let side = if time > 0.0 { LimitSide::Before } else { LimitSide::After };
    load.schedule.value(time, side).unwrap_or(1.0)
}
