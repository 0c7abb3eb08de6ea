//! Conversion of a simulation to data for the viewer.

mod fields;

pub(crate) use fields::FIELDS;
pub use fields::FieldReader;
use fields::fields;

use super::symbols::{of_obstacles, of_sliders, of_spring_kind, of_supports};
use crate::beams::{self, Station};
use crate::geometry::{Vec2, perpendicular};
use crate::joints::{Joint, Releasable};
use crate::loads::{LimitSide, Load, LoadFrame, LoadKind};
use crate::output::Symbol;
use crate::output::viewer::{
    Arrow, BeamShape, BodyShape, ColourField, ParticleShape, PointCombination, SpringEnd,
    SpringShape, SymbolMark, TimeCurve, Trail, ViewerData,
};
use crate::script::messages::error::ScriptError;
use crate::simulation::{Axes, AxisStation, Outline, Simulation};
use crate::system;

const MOST_FREE_ENDS: usize = 8;
const ARROWS_A_BEAM: usize = 6;

/// Options of the viewer data.
pub struct ViewerOptions<'a> {
    /// Time interval [time].
    pub span: (f64, f64),
    /// Displayed configurations, as indices in the trajectory.
    pub frames: Vec<usize>,
    /// Label of the motion.
    pub label: String,
    /// Stations whose paths are drawn; if `None`, the free ends of beams and the point masses.
    pub trails: Option<&'a [Station]>,
    /// Columns of the history.
    pub columns: &'a [String],
    /// Quantities along beams, from [`FIELDS`].
    pub fields: &'a [&'a str],
    /// Fields computed from states of the simulation.
    pub inside: Vec<ColourField>,
}

/// Creates the viewer data of the recorded frames.
///
/// # Errors
/// Fails if a station lies outside its beam, the axis of a beam has no tangent at a point, or the function of a load fails.
pub fn viewer_data(
    simulation: &Simulation,
    options: ViewerOptions,
) -> Result<ViewerData, ScriptError> {
    let (from, to) = options.span;
    let shown = FrameSelection::of(simulation, options.frames);
    let history = simulation.history().between(from, to);
    let column = |name: &String| TimeCurve {
        name: name.replace('_', " "),
        unit: history.dimension(name).unwrap_or_default().to_owned(),
        values: history.column(name).unwrap_or_default(),
    };
    Ok(ViewerData {
        label: options.label,
        times: shown.indices.iter().map(|&at| simulation.trajectory().times()[at]).collect(),
        points: shown.frames.iter().map(|bodies| plain(bodies.iter().flatten())).collect(),
        beams: beams(simulation, &shown)?,
        particles: particles(simulation, &shown)?,
        bodies: bodies(simulation, &shown)?,
        signs: signs(simulation, &shown)?,
        springs: springs(simulation, &shown)?,
        obstacles: of_obstacles(simulation.scene())
            .map(|(name, placed)| (name.to_owned(), placed))
            .collect(),
        arrows: arrows(simulation, &shown)?,
        trails: trails(simulation, &shown, options.trails)?,
        fields: fields(simulation, &shown, options.fields, options.inside)?,
        rows: history.samples().iter().map(|row| row.measures.time).collect(),
        columns: options.columns.iter().map(column).collect(),
    })
}

fn plain<'a>(points: impl Iterator<Item = &'a Vec2>) -> Vec<(f64, f64)> {
    points.map(|point| (point.x, point.y)).collect()
}

struct FrameSelection {
    indices: Vec<usize>,
    frames: Vec<Vec<Vec<Vec2>>>,
    first: Vec<usize>,
}

impl FrameSelection {
    fn of(simulation: &Simulation, indices: Vec<usize>) -> Self {
        let points = simulation.model().control_points().map(<[Vec2]>::len);
        let first = points.scan(0, |sum, count| {
            let first = *sum;
            *sum += count;
            Some(first)
        });
        Self {
            first: first.collect(),
            frames: indices.iter().map(|&frame| simulation.control_points_at(frame)).collect(),
            indices,
        }
    }

    fn place(&self, place: &beams::BodyPoint) -> PointCombination {
        PointCombination {
            first: self.first[place.body] + place.first,
            weights: place.shape().to_vec(),
        }
    }

    fn station(
        &self,
        simulation: &Simulation,
        at: &Station,
    ) -> Result<PointCombination, ScriptError> {
        Ok(self.place(&simulation.place(at)?))
    }
}

fn beams(simulation: &Simulation, shown: &FrameSelection) -> Result<Vec<BeamShape>, ScriptError> {
    let outlines = simulation.outlines()?;
    let beam = |((definition, mesh), outline): ((&system::BeamDefinition, _), &Outline)| {
        let degree = crate::beams::Mesh::basis(mesh).degree();
        let places = outline.line().len();
        let a_mark = (places - 1) / (outline.marks().len() - 1).max(1);
        BeamShape {
            name: definition.name.clone(),
            line: outline.line().iter().map(|at| shown.place(at)).collect(),
            marks: (0..places).step_by(a_mark.max(1)).collect(),
            stations: (0..places).step_by(Outline::places_a_station(degree)).collect(),
        }
    };
    let definitions = simulation.scene().beams.iter().zip(simulation.model().meshes());
    Ok(definitions.zip(outlines).map(beam).collect())
}

fn particles(
    simulation: &Simulation,
    shown: &FrameSelection,
) -> Result<Vec<ParticleShape>, ScriptError> {
    let particles = simulation.scene().particles.iter().enumerate();
    let particle = |(index, particle): (usize, &system::ParticleDefinition)| {
        let at = shown.station(simulation, &Station::on_particle(index))?;
        Ok(ParticleShape { name: particle.name.clone(), at })
    };
    particles.map(particle).collect()
}

fn bodies(simulation: &Simulation, shown: &FrameSelection) -> Result<Vec<BodyShape>, ScriptError> {
    let scene = simulation.scene();
    let mut outlines = simulation.outlines()?.iter().skip(scene.beams.len());
    let body = |(index, body): (usize, &system::RigidBodyDefinition)| {
        let place = |point: usize| shown.station(simulation, &Station::on_rigid_body(index, point));
        let point =
            |at: usize| Ok((format!("{}.{}", body.name, body.points[at - 1].0), place(at)?));
        let points: Vec<_> = body.links().map(point).collect::<Result<_, ScriptError>>()?;
        let outline = if points.is_empty() { None } else { outlines.next() };
        let corners = outline.map_or(&[][..], Outline::corners);
        let outline = outline.into_iter().flat_map(Outline::line);
        Ok(BodyShape {
            name: body.name.clone(),
            centre: place(0)?,
            points,
            outline: outline.map(|at| shown.place(at)).collect(),
            corners: plain(corners.iter()),
        })
    };
    scene.rigid_bodies.iter().enumerate().map(body).collect()
}

fn signs(simulation: &Simulation, shown: &FrameSelection) -> Result<Vec<SymbolMark>, ScriptError> {
    let scene = simulation.scene();
    of_supports(scene)
        .chain(of_sliders(scene))
        .map(|sign| {
            let place = simulation.place(&sign.at)?;
            Ok(SymbolMark {
                symbol: sign.symbol,
                name: sign.name.to_owned(),
                at: shown.place(&place),
                angle: sign.pointing.angle(place.tangent_angle),
                until: sign.hold.and_then(|hold| simulation.release_of(hold)),
            })
        })
        .collect()
}

fn springs(
    simulation: &Simulation,
    shown: &FrameSelection,
) -> Result<Vec<SpringShape>, ScriptError> {
    let spring = |(index, spring): (usize, &system::Spring)| {
        let anchor = |anchor: &system::Anchor| {
            Ok(match anchor {
                system::Anchor::Station(at) => SpringEnd::Moving(shown.station(simulation, at)?),
                system::Anchor::Ground(at) => SpringEnd::Ground((at.x, at.y)),
            })
        };
        let anchors = spring.anchors().iter().map(anchor).collect::<Result<_, ScriptError>>()?;
        let until = simulation.release_of(Releasable::Spring(index));
        let (symbol, name) = (of_spring_kind(spring), spring.name.clone());
        Ok(SpringShape { symbol, name, anchors, until })
    };
    simulation.scene().springs().enumerate().map(spring).collect()
}

fn trails(
    simulation: &Simulation,
    shown: &FrameSelection,
    given: Option<&[Station]>,
) -> Result<Vec<Trail>, ScriptError> {
    let stations = given.map_or_else(|| free_ends(simulation), <[Station]>::to_vec);
    let trail = |station: &Station| {
        let name = format!("path of {}", simulation.scene().describe(station));
        Ok(Trail { name, at: shown.station(simulation, station)? })
    };
    stations.iter().map(trail).collect()
}

/// Stations whose paths are drawn by default: point masses, and ends of beams without a support. If ends are joined, only one of them is included.
/// No paths are drawn for more than `MOST_FREE_ENDS` stations.
fn free_ends(simulation: &Simulation) -> Vec<Station> {
    let scene = simulation.scene();
    let of_beam = |beam: usize| {
        let length = scene.beams[beam].axis.length();
        [0.0, length].map(|at| Station::on_beam(beam, at))
    };
    let is_left = |station: &Station| {
        let holds = |joint: &&Joint| joint.station == *station;
        !scene.joints.iter().any(|joint| holds(&joint))
    };
    let ends: Vec<Station> = (0..scene.beams.len())
        .flat_map(of_beam)
        .filter(is_left)
        .chain((0..scene.particles.len()).map(Station::on_particle))
        .collect();
    if ends.len() <= MOST_FREE_ENDS { ends } else { Vec::new() }
}

fn arrows(simulation: &Simulation, shown: &FrameSelection) -> Result<Vec<Arrow>, ScriptError> {
    let axes = Axes::of(simulation.scene())?;
    let stations = axes.stations()?;
    let mut arrows = Vec::new();
    for load in simulation.scene().loads() {
        let factors = factors(load, simulation, shown)?;
        let mut add = |symbol, at: &beams::BodyPoint, force: &dyn Fn(&[Vec<Vec2>]) -> Vec2| {
            let values = shown.frames.iter().zip(&factors).map(|(bodies, factor)| {
                let value = force(bodies) * *factor;
                (value.x, value.y)
            });
            let (name, values) = (load.name.clone(), values.collect());
            arrows.push(Arrow { symbol, name, at: shown.place(at), values });
        };
        match load.kind {
            LoadKind::Force { station, force, frame } => {
                let (at, axis) = (simulation.place(&station)?, axes.at(&station)?);
                add(Symbol::Force, &at, &|bodies| {
                    turned(force, frame, axis.as_ref(), &bodies[at.body])
                });
            }
            LoadKind::Moment { station, moment } => {
                let at = simulation.place(&station)?;
                add(Symbol::Moment, &at, &|_| Vec2::new(moment, 0.0));
            }
            LoadKind::Line { beam, force, frame } => {
                let (line, stations) = (simulation.outlines()?[beam].line(), &stations[beam]);
                let every = (line.len() - 1) / (stations.len() - 1);
                let mut chosen: Vec<usize> = (0..ARROWS_A_BEAM)
                    .map(|arrow| arrow * (stations.len() - 1) / (ARROWS_A_BEAM - 1))
                    .collect();
                chosen.dedup();
                for station in chosen {
                    add(Symbol::LineForce, &line[station * every], &|bodies| {
                        turned(force, frame, Some(&stations[station]), &bodies[beam])
                    });
                }
            }
        }
    }
    Ok(arrows)
}

fn turned(force: Vec2, frame: LoadFrame, axis: Option<&AxisStation>, points: &[Vec2]) -> Vec2 {
    match (frame, axis) {
        (LoadFrame::Follower, Some(axis)) => {
            let direction = axis.direction(points);
            direction * force.x + perpendicular(direction) * force.y
        }
        _ => force,
    }
}

fn factors(
    load: &Load,
    simulation: &Simulation,
    shown: &FrameSelection,
) -> Result<Vec<f64>, ScriptError> {
    let times = simulation.trajectory().times();
    let factors =
        shown.indices.iter().map(|&index| load.schedule.value(times[index], LimitSide::After));
    factors
        .collect::<Result<_, _>>()
        .map_err(|error| ScriptError::new(format!("the load '{}': {error}", load.name)))
}
