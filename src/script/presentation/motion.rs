//! What a picture of a motion shows, found once for files and for terminals.

use super::symbols::{SceneAt, symbols, uncrowded};
use crate::beams::BodyPoint;
use crate::geometry::Vec2;
use crate::output::{
    AxisLimits, ConfigurationPicture, MotionFrame, MotionPicture, PictureMark, PlacedSymbol, Point,
    Symbol, TerminalStyle, format_number, significant,
};
use crate::script::messages::error::ScriptError;
use crate::simulation::{Configuration, Simulation};

/// Beams with more spans than this in all have no dots at their knots unless they are asked for.
const MOST_SPANS_WITH_DOTS: usize = 40;
/// Most snapshots of one picture.
const MOST_SNAPSHOTS: f64 = 2000.0;
/// Digits of numbers in words.
const DIGITS: usize = 6;

/// Which snapshots there are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    /// The first.
    pub from: f64,
    /// The last.
    pub to: f64,
    /// Between two.
    pub every: f64,
}

/// What is asked for.
pub struct MotionOptions {
    /// Which snapshots.
    pub times: Times,
    /// Places whose paths are drawn, with their names.
    pub traces: Vec<(String, BodyPoint)>,
    /// How many times displacements since the start are drawn; as they are where it is none.
    pub magnify: Option<f64>,
    /// Whether knots or nodes have dots; as many spans allow unless it is said.
    pub dots: Option<bool>,
    /// Which symbols there are.
    pub symbols: Visibility,
    /// The ends of the axes.
    pub limits: AxisLimits,
}

/// Whether something is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Visibility {
    /// It is.
    Yes,
    /// It is, but for what there is so much of that it would hide the rest.
    WhereThereIsRoom,
    /// It is not.
    No,
}

/// What is seen.
pub struct MotionView {
    beams: Vec<String>,
    snapshots: Vec<MotionFrame>,
    traces: Vec<(String, Vec<Point>)>,
    symbols: Vec<PlacedSymbol>,
    magnify: Option<f64>,
    limits: AxisLimits,
}

/// Magnifies displacements.
#[derive(Clone, Copy)]
struct Magnifier(f64);

impl Magnifier {
    fn see(self, start: &Vec2, now: &Vec2) -> Point {
        let seen = start + (now - start) * self.0;
        (seen.x, seen.y)
    }

    fn all(self, start: &[Vec2], now: &[Vec2]) -> Vec<Point> {
        start.iter().zip(now).map(|(start, now)| self.see(start, now)).collect()
    }
}

impl MotionView {
    /// What is wanted of a simulation; `expect` is asked about every snapshot, with the time that is wanted and the one that was recorded.
    ///
    /// # Errors
    /// When nothing lies between the times, too many snapshots do, or `expect` has one.
    pub fn of(
        simulation: &Simulation,
        wanted: MotionOptions,
        expect: impl Fn(f64, f64) -> Result<(), ScriptError>,
    ) -> Result<Self, ScriptError> {
        let Times { from, to, .. } = wanted.times;
        let has_dots = wanted.dots.unwrap_or_else(|| has_room_for_dots(simulation));
        let start = simulation.configuration_near(0.0)?;
        let mut snapshots = Vec::new();
        for time in times(simulation, &wanted.times)? {
            let Some(shown) = configuration(simulation, time)? else { continue };
            expect(time, shown.time)?;
            let mut snapshot = match (&start, wanted.magnify) {
                (Some(start), Some(factor)) => magnified(start, &shown, Magnifier(factor)),
                _ => snapshot(&shown),
            };
            if !has_dots {
                snapshot.marks.clear();
            }
            snapshots.push(snapshot);
        }
        let lens = Magnifier(wanted.magnify.unwrap_or(1.0));
        let path = |(name, place): &(String, BodyPoint)| {
            let path = simulation.path(place);
            let start = path.first().map(|(_, start)| *start);
            let see = |now: &Vec2| match (wanted.magnify, start) {
                (Some(_), Some(start)) => lens.see(&start, now),
                _ => (now.x, now.y),
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
        let symbols = match (wanted.symbols, snapshots.last()) {
            (Visibility::No, _) | (_, None) => Vec::new(),
            (shown, Some(last)) => {
                let all = placed(simulation, last.time, wanted.magnify)?;
                if shown == Visibility::Yes { all } else { uncrowded(all) }
            }
        };
        let beams = simulation.scene().beams.iter().map(|beam| beam.name.clone()).collect();
        let (magnify, limits) = (wanted.magnify, wanted.limits);
        Ok(Self { beams, snapshots, traces, symbols, magnify, limits })
    }

    /// For a file.
    pub fn picture(self, title: impl Into<String>) -> MotionPicture {
        let picture =
            MotionPicture::new(title).beams(self.beams).symbols(self.symbols).limits(self.limits);
        let picture = match self.magnify {
            Some(factor) => {
                let factor = significant(factor, DIGITS);
                picture.caption(format!("displacements since the start, {factor} times as large"))
            }
            None => picture,
        };
        let picture = self.snapshots.into_iter().fold(picture, MotionPicture::snapshot);
        self.traces.into_iter().fold(picture, |picture, (name, path)| picture.trace(name, path))
    }

    /// For a terminal: the last snapshot, and what was before it dotted.
    pub fn text(self, title: impl Into<String>, style: &TerminalStyle) -> String {
        let mut picture = ConfigurationPicture::new(title).limits(self.limits);
        let count = self.snapshots.len();
        for (index, snapshot) in self.snapshots.into_iter().enumerate() {
            let is_last = index + 1 == count;
            let MotionFrame { time, lines, particles, bodies, .. } = snapshot;
            for line in lines.into_iter().chain(bodies) {
                picture = if is_last { picture.line(line) } else { picture.ghost(line) };
            }
            if is_last {
                picture = particles.into_iter().fold(picture.time(time), |picture, at| {
                    picture.mark(PictureMark::Particle, at)
                });
            }
        }
        picture = self.traces.into_iter().fold(picture, |picture, (_, path)| picture.ghost(path));
        marked(picture, &self.symbols).text(style)
    }
}

/// A picture for a terminal with symbols: springs as lines, supports, joints and sliders as signs.
pub fn marked(picture: ConfigurationPicture, symbols: &[PlacedSymbol]) -> ConfigurationPicture {
    let links = symbols.iter().filter_map(PlacedSymbol::link);
    let picture = links.fold(picture, |picture, link| picture.ghost(link.to_vec()));
    let marks = symbols.iter().filter_map(|placed| Some((mark(placed)?, placed.at)));
    marks.fold(picture, |picture, (mark, at)| picture.mark(mark, at))
}

/// The sign of a symbol at a terminal.
fn mark(placed: &PlacedSymbol) -> Option<PictureMark> {
    match placed.symbol {
        Symbol::Hinge | Symbol::Roller => Some(PictureMark::Hinge),
        Symbol::Clamp | Symbol::Guided | Symbol::Carriage => Some(PictureMark::Clamp),
        Symbol::Slider => Some(PictureMark::Slider),
        Symbol::Joint | Symbol::RigidJoint => Some(PictureMark::Joint),
        // Springs are lines, loads are not drawn.
        _ => None,
    }
}

/// The times of the snapshots. The last is asked for by itself, whether or not `every` meets it.
fn times(simulation: &Simulation, times: &Times) -> Result<Vec<f64>, ScriptError> {
    let Times { from, to, every } = *times;
    let now = simulation.time();
    if to < from || from > now || to < 0.0 {
        let (from, to) = (format_number(from), format_number(to));
        return Err(ScriptError::new(format!("there is nothing from t = {from} to {to}"))
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

/// The configuration nearest to a time; at the present, whether or not it was recorded, that of the present.
fn configuration(simulation: &Simulation, time: f64) -> Result<Option<Configuration>, ScriptError> {
    Ok(match time >= simulation.time() {
        true => Some(simulation.configuration()?),
        false => simulation.configuration_near(time)?,
    })
}

/// Whether the beams have so few spans in all that dots at their knots do not hide them.
pub fn has_room_for_dots(simulation: &Simulation) -> bool {
    let meshes = simulation.model().meshes();
    let spans: usize = meshes.iter().map(|mesh| mesh.basis().breaks().len() - 1).sum();
    spans <= MOST_SPANS_WITH_DOTS
}

/// A configuration as it is drawn.
pub fn snapshot(configuration: &Configuration) -> MotionFrame {
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

fn magnified(start: &Configuration, now: &Configuration, lens: Magnifier) -> MotionFrame {
    let all = |start: &[Vec<Vec2>], now: &[Vec<Vec2>]| {
        start.iter().zip(now).map(|(start, now)| lens.all(start, now)).collect()
    };
    MotionFrame {
        time: now.time,
        lines: all(&start.lines, &now.lines),
        bodies: all(&start.bodies, &now.bodies),
        marks: lens.all(&start.marks, &now.marks),
        particles: lens.all(&start.particles, &now.particles),
    }
}

/// The symbols of a simulation in the configuration nearest to a time, displacements magnified where that is asked for.
///
/// # Errors
/// When a station lies outside its beam.
pub fn placed(
    simulation: &Simulation,
    time: f64,
    magnify: Option<f64>,
) -> Result<Vec<PlacedSymbol>, ScriptError> {
    let places = |stations: &[_]| {
        let now = match time >= simulation.time() {
            true => simulation.stations(stations)?,
            false => simulation.stations_near(stations, time)?,
        };
        let Some(factor) = magnify else { return Ok(now) };
        let start = simulation.stations_near(stations, 0.0)?;
        Ok(start.iter().zip(now).map(|(start, now)| start + (now - start) * factor).collect())
    };
    Ok(symbols(&SceneAt::of(simulation, time), places)?)
}
