//! A simulation as a film for the viewer: its bodies, supports and loads in frames, and columns of its history.

use crate::beams::{self, Station};
use crate::geometry::{Vec2, perpendicular};
use crate::joints::{Joint, JointKind, Partner};
use crate::loads::{Frame, Load, LoadKind, Side};
use crate::output::viewer::{
    Arrow, ArrowKind, Beam, Column, Field, Film, Particle, Place, Symbol, SymbolKind, Trail,
};
use crate::script::words::error::ScriptError;
use crate::simulation::{Axes, AxisStation, Outline, Simulation};

/// Paths of free ends are drawn where there are at most so many.
const MOST_FREE_ENDS: usize = 8;
/// Arrows of a line load on a beam.
const ARROWS_A_BEAM: usize = 6;

/// What of a simulation a film shows.
pub struct Wishes<'a> {
    /// From when to when [time].
    pub span: (f64, f64),
    /// Most frames.
    pub frames: usize,
    /// What it is called.
    pub label: String,
    /// The places whose paths are drawn; where none are given, free ends.
    pub trails: Option<&'a [Station]>,
    /// Columns of its history.
    pub columns: &'a [String],
    /// Quantities along beams, of [`FIELDS`].
    pub fields: &'a [&'a str],
}

/// A quantity along beams by name, with its dimension.
type FieldEntry = (&'static str, &'static str);

/// What beams can be coloured by. Speed: from the configurations before and after [length/time]. Stretch: how much longer the axis is than as
/// drawn [-]. Curvature: how much more it bends than as drawn [1/length].
pub const FIELDS: [FieldEntry; 3] =
    [("speed", "length/time"), ("stretch", "-"), ("curvature", "1/length")];

/// A film of the frames that are recorded.
///
/// # Errors
/// When nothing is recorded in the span, a station lies outside its beam, or the function of a load fails.
pub fn film(simulation: &Simulation, wishes: &Wishes) -> Result<Film, ScriptError> {
    let (from, to) = wishes.span;
    let frames = simulation.frames_between(from, to, wishes.frames);
    let shown = Shown::of(simulation, &frames);
    let history = simulation.history().between(from, to);
    let column = |name: &String| Column {
        name: name.replace('_', " "),
        unit: history.dimension(name).unwrap_or_default().to_owned(),
        values: history.column(name).unwrap_or_default(),
    };
    Ok(Film {
        label: wishes.label.clone(),
        times: frames.iter().map(|&frame| simulation.trajectory().times()[frame]).collect(),
        points: shown.frames.iter().map(|bodies| plain(bodies.iter().flatten())).collect(),
        beams: beams(simulation, &shown)?,
        particles: particles(simulation, &shown)?,
        symbols: symbols(simulation, &shown)?,
        arrows: arrows(simulation, &shown)?,
        trails: trails(simulation, &shown, wishes.trails)?,
        fields: fields(simulation, &shown, wishes.fields)?,
        rows: history.samples().iter().map(|row| row.measures.time).collect(),
        columns: wishes.columns.iter().map(column).collect(),
    })
}

/// Points as a film has them.
fn plain<'a>(points: impl Iterator<Item = &'a Vec2>) -> Vec<(f64, f64)> {
    points.map(|point| (point.x, point.y)).collect()
}

/// The configurations that are shown.
struct Shown {
    /// By their index in the trajectory.
    indices: Vec<usize>,
    /// The control points of each body in each of them.
    frames: Vec<Vec<Vec<Vec2>>>,
    /// The first point of each body among all.
    first: Vec<usize>,
}

impl Shown {
    fn of(simulation: &Simulation, indices: &[usize]) -> Self {
        let points = simulation.model().control_points().map(<[Vec2]>::len);
        let first = points.scan(0, |sum, count| {
            let first = *sum;
            *sum += count;
            Some(first)
        });
        Self {
            indices: indices.to_vec(),
            frames: indices.iter().map(|&frame| simulation.control_points_at(frame)).collect(),
            first: first.collect(),
        }
    }

    fn place(&self, place: &beams::Place) -> Place {
        Place { first: self.first[place.body] + place.first, weights: place.shape().to_vec() }
    }

    /// The place of a station.
    fn station(&self, simulation: &Simulation, at: &Station) -> Result<Place, ScriptError> {
        Ok(self.place(&simulation.place(at)?))
    }
}

fn beams(simulation: &Simulation, shown: &Shown) -> Result<Vec<Beam>, ScriptError> {
    let outlines = simulation.outlines()?;
    let beam = |((definition, mesh), outline): ((&crate::model::BeamDefinition, _), &Outline)| {
        let degree = crate::beams::Mesh::basis(mesh).degree();
        let places = outline.line().len();
        let a_mark = (places - 1) / (outline.marks().len() - 1).max(1);
        Beam {
            name: definition.name.clone(),
            line: outline.line().iter().map(|at| shown.place(at)).collect(),
            marks: (0..places).step_by(a_mark.max(1)).collect(),
            stations: (0..places).step_by(Outline::places_a_station(degree)).collect(),
        }
    };
    let definitions = simulation.scene().beams.iter().zip(simulation.model().meshes());
    Ok(definitions.zip(outlines).map(beam).collect())
}

fn particles(simulation: &Simulation, shown: &Shown) -> Result<Vec<Particle>, ScriptError> {
    let particles = simulation.scene().particles.iter().enumerate();
    let particle = |(index, particle): (usize, &crate::model::ParticleDefinition)| {
        let at = shown.station(simulation, &Station::on_particle(index))?;
        Ok(Particle { name: particle.name.clone(), at })
    };
    particles.map(particle).collect()
}

fn symbols(simulation: &Simulation, shown: &Shown) -> Result<Vec<Symbol>, ScriptError> {
    let scene = simulation.scene();
    let of_joint = |joint: &Joint| {
        let kind = match (joint.kind, joint.partner) {
            (JointKind::Hinge, Partner::Ground) | (JointKind::Support(_), _) => SymbolKind::Support,
            (JointKind::Rigid, Partner::Ground) => SymbolKind::Clamp,
            (JointKind::Hinge, Partner::Station(_)) => SymbolKind::Hinge,
            (JointKind::Rigid, Partner::Station(_)) => SymbolKind::Rigid,
        };
        let place = simulation.place(&joint.station)?;
        // The hatching of a wall is behind the beam: it points from the wall along the beam.
        let is_end = joint.station.arc_length > 0.5 * scene.length_at(&joint.station);
        let angle = place.tangent_angle + if is_end { std::f64::consts::PI } else { 0.0 };
        Ok(Symbol { kind, name: joint.name.clone(), at: shown.place(&place), angle })
    };
    let of_slider = |slider: &crate::joints::Slider| {
        let at = shown.station(simulation, &slider.slave)?;
        Ok(Symbol { kind: SymbolKind::Slider, name: slider.name.clone(), at, angle: 0.0 })
    };
    scene.joints.iter().map(of_joint).chain(scene.sliders.iter().map(of_slider)).collect()
}

fn trails(
    simulation: &Simulation,
    shown: &Shown,
    given: Option<&[Station]>,
) -> Result<Vec<Trail>, ScriptError> {
    let stations = given.map_or_else(|| free_ends(simulation), <[Station]>::to_vec);
    let trail = |station: &Station| {
        let name = format!("path of {}", simulation.scene().describe(station));
        Ok(Trail { name, at: shown.station(simulation, station)? })
    };
    stations.iter().map(trail).collect()
}

/// Ends of beams that nothing holds at the ground, of those that are joined one, and particles; none where there are many.
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

fn fields(
    simulation: &Simulation,
    shown: &Shown,
    names: &[&str],
) -> Result<Vec<Field>, ScriptError> {
    let stations = Axes::of(simulation.scene())?.stations()?;
    // Each station, with the control points of its beam in a configuration.
    let over = |bodies: &[Vec<Vec2>], value: &dyn Fn(&AxisStation, &[Vec2]) -> f64| -> Vec<f64> {
        let of_beam = |(stations, points): (&Vec<AxisStation>, &Vec<Vec2>)| {
            stations.iter().map(|at| value(at, points)).collect::<Vec<_>>()
        };
        stations.iter().zip(bodies).flat_map(of_beam).collect()
    };
    let everywhere = |value: fn(&AxisStation, &[Vec2]) -> f64| {
        shown.frames.iter().map(|bodies| over(bodies, &value)).collect()
    };
    let field = |(name, unit): &FieldEntry| Field {
        name: (*name).to_owned(),
        unit: (*unit).to_owned(),
        values: match *name {
            "stretch" => everywhere(AxisStation::stretch),
            "curvature" => everywhere(AxisStation::curvature),
            _ => shown.indices.iter().map(|&index| speeds(simulation, &stations, index)).collect(),
        },
    };
    Ok(FIELDS.iter().filter(|(name, _)| names.contains(name)).map(field).collect())
}

/// How fast stations move in a configuration, from those recorded before and after it.
fn speeds(simulation: &Simulation, stations: &[Vec<AxisStation>], index: usize) -> Vec<f64> {
    let times = simulation.trajectory().times();
    let (before, after) = (index.saturating_sub(1), (index + 1).min(times.len() - 1));
    let duration = times[after] - times[before];
    let (start, end) = (simulation.control_points_at(before), simulation.control_points_at(after));
    let of_beam = |(stations, (start, end)): (&Vec<AxisStation>, (&Vec<Vec2>, &Vec<Vec2>))| {
        let speed = |at: &AxisStation| (at.position(end) - at.position(start)).norm() / duration;
        stations.iter().map(speed).collect::<Vec<_>>()
    };
    stations.iter().zip(start.iter().zip(&end)).flat_map(of_beam).collect()
}

fn arrows(simulation: &Simulation, shown: &Shown) -> Result<Vec<Arrow>, ScriptError> {
    let axes = Axes::of(simulation.scene())?;
    let stations = axes.stations()?;
    let mut arrows = Vec::new();
    for load in simulation.scene().loads() {
        let factors = factors(load, simulation, shown)?;
        let mut add = |kind, at: &beams::Place, force: &dyn Fn(&[Vec<Vec2>]) -> Vec2| {
            let values = shown.frames.iter().zip(&factors).map(|(bodies, factor)| {
                let value = force(bodies) * *factor;
                (value.x, value.y)
            });
            let (name, values) = (load.name.clone(), values.collect());
            arrows.push(Arrow { kind, name, at: shown.place(at), values });
        };
        match load.kind {
            LoadKind::Force { station, force, frame } => {
                let (at, axis) = (simulation.place(&station)?, axes.at(&station)?);
                add(ArrowKind::Force, &at, &|bodies| {
                    turned(force, frame, axis.as_ref(), &bodies[at.body])
                });
            }
            LoadKind::Moment { station, moment } => {
                let at = simulation.place(&station)?;
                add(ArrowKind::Moment, &at, &|_| Vec2::new(moment, 0.0));
            }
            LoadKind::Line { beam, force, frame } => {
                let (line, stations) = (simulation.outlines()?[beam].line(), &stations[beam]);
                let every = (line.len() - 1) / (stations.len() - 1);
                let mut chosen: Vec<usize> = (0..ARROWS_A_BEAM)
                    .map(|arrow| arrow * (stations.len() - 1) / (ARROWS_A_BEAM - 1))
                    .collect();
                chosen.dedup();
                for station in chosen {
                    add(ArrowKind::Line, &line[station * every], &|bodies| {
                        turned(force, frame, Some(&stations[station]), &bodies[beam])
                    });
                }
            }
        }
    }
    Ok(arrows)
}

/// A load in space; one that follows its section is drawn as if that stood across the axis.
fn turned(force: Vec2, frame: Frame, axis: Option<&AxisStation>, points: &[Vec2]) -> Vec2 {
    match (frame, axis) {
        (Frame::Follower, Some(axis)) => {
            let direction = axis.direction(points);
            direction * force.x + perpendicular(direction) * force.y
        }
        _ => force,
    }
}

/// The factors of a load in the configurations that are shown.
fn factors(load: &Load, simulation: &Simulation, shown: &Shown) -> Result<Vec<f64>, ScriptError> {
    let times = simulation.trajectory().times();
    let factors = shown.indices.iter().map(|&index| load.schedule.value(times[index], Side::After));
    factors
        .collect::<Result<_, _>>()
        .map_err(|error| ScriptError::new(format!("the load '{}': {error}", load.name)))
}
