//! Content of motion pictures, for files and terminals.

use super::magnifier::{Magnifier, positions};
use super::symbols::{SceneAt, symbols, uncrowded};
use crate::beams::{BodyPoint, Station};
use crate::geometry::Vec2;
use crate::output::{
    AxisLimits, ConfigurationPicture, MotionFrame, MotionPicture, PictureMark, PlacedSymbol, Point,
    Symbol, TerminalStyle, format_number, significant,
};
use crate::script::messages::error::ScriptError;
use crate::simulation::{DrawnConfiguration, Simulation};
use crate::system::SystemError;

const MOST_SPANS_WITH_DOTS: usize = 40;
const MOST_SNAPSHOTS: f64 = 2000.0;
const DIGITS: usize = 6;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    pub from: f64,
    pub to: f64,
    pub every: f64,
}

pub struct MotionOptions {
    pub times: Times,
    pub traces: Vec<(String, BodyPoint)>,
    /// Magnification of deformations since the start; `None` for no magnification.
    pub magnify: Option<f64>,
    /// Marks at knots or nodes. If `None`, they are drawn only for few spans.
    pub dots: Option<bool>,
    pub symbols: Visibility,
    pub limits: AxisLimits,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Visibility {
    Yes,
    /// All symbols, but no supports, joints and sliders if there are too many of them (see [`uncrowded`]).
    IfFew,
    None,
}

impl Visibility {
    pub fn visible(self, symbols: Vec<PlacedSymbol>) -> Vec<PlacedSymbol> {
        match self {
            Self::Yes => symbols,
            Self::IfFew => uncrowded(symbols),
            Self::None => symbols.into_iter().filter(|at| at.symbol.is_obstacle()).collect(),
        }
    }
}

pub struct MotionView {
    beams: Vec<String>,
    snapshots: Vec<MotionFrame>,
    traces: Vec<(String, Vec<Point>)>,
    symbols: Vec<PlacedSymbol>,
    magnify: Option<f64>,
    limits: AxisLimits,
}

impl MotionView {
    /// Collects the content from a simulation. `expect` checks each snapshot by its requested and recorded time.
    ///
    /// # Errors
    /// Fails if there are no or too many snapshots in the interval, or if `expect` fails.
    pub fn of(
        simulation: &Simulation,
        wanted: MotionOptions,
        expect: impl Fn(f64, f64) -> Result<(), ScriptError>,
    ) -> Result<Self, ScriptError> {
        let Times { from, to, .. } = wanted.times;
        let has_dots = wanted.dots.unwrap_or_else(|| has_room_for_dots(simulation));
        let magnifier = magnifier(simulation, wanted.magnify)?;
        let mut snapshots = Vec::new();
        for time in times(simulation, &wanted.times)? {
            let Some(shown) = configuration(simulation, time)? else { continue };
            expect(time, shown.time)?;
            let mut snapshot = match &magnifier {
                Some(magnifier) => snapshot(&magnifier.configuration(&shown)?),
                None => snapshot(&shown),
            };
            if !has_dots {
                snapshot.marks.clear();
            }
            snapshots.push(snapshot);
        }
        let path = |(name, place): &(String, BodyPoint)| {
            let path = simulation.path(place);
            let start = path.first().map(|(_, start)| *start);
            let factor = match &magnifier {
                Some(of) if !of.travels(place.body) => wanted.magnify.unwrap_or(1.0),
                _ => 1.0,
            };
            let see = |now: &Vec2| {
                let seen = start.map_or(*now, |start| start + (now - start) * factor);
                (seen.x, seen.y)
            };
            let mut seen: Vec<Point> = path
                .iter()
                .filter(|(time, _)| (from..=to).contains(time))
                .map(|(_, point)| see(point))
                .collect();
            let is_behind = path.last().is_some_and(|(last, _)| *last < simulation.time());
            if is_behind && to >= simulation.time() {
                seen.push(see(&simulation.model().position(place)));
            }
            (format!("path of {name}"), seen)
        };
        let traces = wanted.traces.iter().map(path).collect();
        let symbols = match snapshots.last() {
            None => Vec::new(),
            Some(last) => wanted.symbols.visible(placed(simulation, last.time, wanted.magnify)?),
        };
        let beams = simulation.scene().beams.iter().map(|beam| beam.name.clone()).collect();
        let (magnify, limits) = (wanted.magnify, wanted.limits);
        Ok(Self { beams, snapshots, traces, symbols, magnify, limits })
    }

    pub fn picture(self, title: impl Into<String>) -> MotionPicture {
        let picture =
            MotionPicture::new(title).beams(self.beams).symbols(self.symbols).limits(self.limits);
        let picture = match self.magnify {
            Some(factor) => {
                let factor = significant(factor, DIGITS);
                picture.caption(format!("deformations since the start, magnified {factor} times"))
            }
            None => picture,
        };
        let picture = self.snapshots.into_iter().fold(picture, MotionPicture::snapshot);
        self.traces.into_iter().fold(picture, |picture, (name, path)| picture.trace(name, path))
    }

    /// Picture as text for a terminal, with the last snapshot as solid and earlier ones as dotted lines.
    pub fn text(self, title: impl Into<String>, style: &TerminalStyle) -> String {
        let mut picture = ConfigurationPicture::new(title).limits(self.limits);
        let count = self.snapshots.len();
        for (index, snapshot) in self.snapshots.into_iter().enumerate() {
            let is_last = index + 1 == count;
            let MotionFrame { time, lines, particles, bodies, .. } = snapshot;
            for line in lines.into_iter().chain(bodies) {
                picture = if is_last { picture.line(line) } else { picture.reference_beam(line) };
            }
            if is_last {
                picture = particles.into_iter().fold(picture.time(time), |picture, at| {
                    picture.mark(PictureMark::Particle, at)
                });
            }
        }
        picture = self
            .traces
            .into_iter()
            .fold(picture, |picture, (_, path)| picture.reference_beam(path));
        marked(picture, &self.symbols).text(style)
    }
}

/// Adds symbols to a picture for a terminal: springs and obstacles as lines; supports, joints and sliders as marks.
pub fn marked(picture: ConfigurationPicture, symbols: &[PlacedSymbol]) -> ConfigurationPicture {
    let links = symbols.iter().filter_map(PlacedSymbol::link);
    let picture = links.fold(picture, |picture, link| picture.reference_beam(link.to_vec()));
    let obstacles = symbols.iter().filter(|placed| placed.symbol.is_obstacle()).copied();
    let picture = obstacles.fold(picture, ConfigurationPicture::obstacle);
    let marks = symbols.iter().filter_map(|placed| Some((mark(placed)?, placed.at)));
    marks.fold(picture, |picture, (mark, at)| picture.mark(mark, at))
}

fn mark(placed: &PlacedSymbol) -> Option<PictureMark> {
    match placed.symbol {
        Symbol::Hinge | Symbol::Roller => Some(PictureMark::Hinge),
        Symbol::Clamp | Symbol::Guided | Symbol::Carriage => Some(PictureMark::Clamp),
        Symbol::Slider => Some(PictureMark::Slider),
        Symbol::Joint | Symbol::RigidJoint => Some(PictureMark::Joint),
        _ => None,
    }
}

fn times(simulation: &Simulation, times: &Times) -> Result<Vec<f64>, ScriptError> {
    let Times { from, to, every } = *times;
    let now = simulation.time();
    if to < from || from > now || to < 0.0 {
        let (from, to) = (format_number(from), format_number(to));
        return Err(ScriptError::new(format!("there is no snapshot from t = {from} to {to}"))
            .hint(format!("the simulation has run from t = 0 to {}", format_number(now))));
    }
    let last = to.min(now);
    let count = ((last - from) / every + 1e-9).floor().max(0.0);
    if count > MOST_SNAPSHOTS {
        return Err(ScriptError::new(format!("{count} snapshots are too many for a picture"))
            .hint("choose a larger `every`"));
    }
    let is_met = last - (from + count * every) <= 1e-9 * every;
    let met = (0..=count as usize).map(|index| from + index as f64 * every);
    Ok(met.chain((!is_met).then_some(last)).collect())
}

/// Recorded configuration nearest to a time, or the present configuration for the present time, even if it is not recorded.
fn configuration(
    simulation: &Simulation,
    time: f64,
) -> Result<Option<DrawnConfiguration>, SystemError> {
    Ok(match time >= simulation.time() {
        true => Some(simulation.configuration()?),
        false => simulation.configuration_near(time)?,
    })
}

pub fn has_room_for_dots(simulation: &Simulation) -> bool {
    let meshes = simulation.model().meshes();
    let spans: usize = meshes.iter().map(|mesh| mesh.basis().breaks().len() - 1).sum();
    spans <= MOST_SPANS_WITH_DOTS
}

pub fn snapshot(configuration: &DrawnConfiguration) -> MotionFrame {
    let plain = |point: &Vec2| (point.x, point.y);
    let plain_line = |line: &Vec<Vec2>| line.iter().map(plain).collect();
    MotionFrame {
        time: configuration.time,
        lines: configuration.lines.iter().map(plain_line).collect(),
        marks: configuration.marks.iter().map(plain).collect(),
        particles: configuration.particles.iter().map(plain).collect(),
        bodies: configuration.bodies.iter().map(plain_line).collect(),
    }
}

fn magnifier(
    simulation: &Simulation,
    factor: Option<f64>,
) -> Result<Option<Magnifier<'_>>, ScriptError> {
    Ok(factor.map(|factor| Magnifier::new(simulation, factor)).transpose()?.flatten())
}

/// Symbols in the recorded configuration nearest to a time, with magnified deformations.
///
/// # Errors
/// Fails if a station lies outside its beam.
pub fn placed(
    simulation: &Simulation,
    time: f64,
    magnify: Option<f64>,
) -> Result<Vec<PlacedSymbol>, ScriptError> {
    let magnifier = magnifier(simulation, magnify)?;
    let places = |stations: &[Station]| {
        let now = positions(simulation, stations, time)?;
        let shown = configuration(simulation, time)?;
        let (Some(magnifier), Some(shown)) = (magnifier, shown) else { return Ok(now) };
        let bodies = magnifier.rigid_motions(&shown)?;
        let start = positions(simulation, stations, 0.0)?;
        let pairs = stations.iter().zip(start.iter().zip(&now));
        let see = |(station, (start, now)): (&Station, (&Vec2, &Vec2))| {
            bodies.magnified_position(simulation.scene().index_of_body(station), *start, *now)
        };
        Ok(pairs.map(see).collect())
    };
    Ok(symbols(&SceneAt::of(simulation, time), places)?)
}
