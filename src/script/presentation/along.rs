//! Pictures of section forces and strains along beams, as strips beside the axis, charts, or colours of the axis.

use super::motion::Visibility;
use super::quantities::BeamQuantity;
use super::symbols::SceneAt;
use crate::geometry::Vec2;
use crate::output::{
    BeamStrip, FieldPicture, LineChart, MechanismOutline, Point, Series, StripPicture,
    TerminalStyle, significant,
};
use crate::simulation::{Outline, Simulation};
use crate::statics::Equilibrium;
use crate::system::{BeamPlaces, BeamSample, System, SystemError};

const DIGITS: usize = 6;

pub struct SectionForceProfile {
    /// First part of titles, before the name of the quantity.
    pub title: String,
    /// Time as text; may be empty.
    pub when: String,
    beams: Vec<BeamProfile>,
    outline: MechanismOutline,
}

struct BeamProfile {
    name: String,
    line: Vec<Point>,
    along: Vec<BeamSample>,
}

impl SectionForceProfile {
    /// Results of a simulation at the present time for the beams with the given indices; all beams if `beams` is empty.
    ///
    /// # Errors
    /// Fails if the axis of a beam has a point without a tangent.
    pub fn of_simulation(simulation: &Simulation, beams: &[usize]) -> Result<Self, SystemError> {
        let when = format!("t = {}", significant(simulation.time(), DIGITS));
        let at = SceneAt::of(simulation, simulation.time());
        Self::of_model(&at, simulation.model(), beams).map(|inside| Self { when, ..inside })
    }

    /// Results of an equilibrium under its full load for the beams with the given indices; all beams if `beams` is empty.
    ///
    /// # Errors
    /// Fails if the axis of a beam has a point without a tangent.
    pub fn of_equilibrium(rest: &Equilibrium, beams: &[usize]) -> Result<Self, SystemError> {
        Self::of_model(&SceneAt::at_rest(rest), rest.model(), beams)
    }

    fn of_model(at: &SceneAt, model: &System, beams: &[usize]) -> Result<Self, SystemError> {
        let SceneAt { scene, time, .. } = *at;
        let outlines = Outline::of_scene(scene, model.meshes())?;
        let points: Vec<&[Vec2]> = model.control_points().collect();
        let drawn = Outline::draw(&outlines, time, &points);
        let is_wanted = |index: &usize| beams.is_empty() || beams.contains(index);
        let beam = |index: usize| {
            let places = model.places_along(scene, index, BeamPlaces::WITHIN_A_SPAN)?;
            Ok(BeamProfile {
                name: scene.beams[index].name.clone(),
                line: drawn.lines[index].iter().map(plain).collect(),
                along: model.sample_along(&places),
            })
        };
        let beams = (0..scene.beams.len()).filter(is_wanted).map(beam);
        Ok(Self {
            title: scene.name.clone(),
            when: String::new(),
            beams: beams.collect::<Result<_, SystemError>>()?,
            outline: MechanismOutline {
                bodies: drawn.bodies.iter().map(|body| body.iter().map(plain).collect()).collect(),
                symbols: at.symbols(model)?,
            },
        })
    }

    pub fn with_symbols(mut self, shown: Visibility) -> Self {
        self.outline.symbols = shown.visible(self.outline.symbols);
        self
    }

    fn heading(&self, quantity: &BeamQuantity) -> String {
        let parts = [self.title.as_str(), quantity.words];
        let parts: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        match self.when.as_str() {
            "" => parts.join(": "),
            when => format!("{} at {when}", parts.join(": ")),
        }
    }

    pub fn strips(&self, quantity: &BeamQuantity) -> StripPicture {
        let caption = match quantity.name {
            "M" | "curvature" => "positive on the right of a beam from its start, the tension side",
            _ => "positive on the left of a beam from its start",
        };
        let of_beam = |beam: &BeamProfile| BeamStrip {
            line: beam.line.clone(),
            values: beam.along.iter().map(|at| (plain(&at.position), (quantity.of)(at))).collect(),
        };
        let picture = StripPicture::new(self.heading(quantity))
            .caption(format!("{}; {caption}", quantity.label()))
            .side(quantity.side)
            .outline(self.outline.clone());
        self.beams.iter().map(of_beam).fold(picture, StripPicture::strip)
    }

    pub fn chart(&self, quantity: &BeamQuantity) -> LineChart {
        let chart = LineChart::new("")
            .x_label("s, from the start of the beam [length]")
            .y_label(quantity.label());
        self.beams.iter().fold(chart, |chart, beam| {
            let points = beam.along.iter().map(|at| (at.arc_length, (quantity.of)(at)));
            let name = if self.beams.len() > 1 { beam.name.clone() } else { String::new() };
            chart.series(Series::new(name, points.collect()))
        })
    }

    pub fn field(&self, quantity: &BeamQuantity) -> FieldPicture {
        let label = match quantity.sign {
            sign if sign.len() == 1 => format!("|{sign}| [{}]", quantity.dimension),
            _ => format!("[{}]", quantity.dimension),
        };
        let picture =
            FieldPicture::new(self.heading(quantity), label).outline(self.outline.clone());
        self.beams.iter().fold(picture, |picture, beam| {
            let value = |at: &BeamSample| (plain(&at.position), (quantity.of)(at).abs());
            picture.beam(beam.along.iter().map(value).collect())
        })
    }

    pub fn text(&self, quantity: &BeamQuantity, style: &TerminalStyle) -> String {
        self.chart(quantity).title(self.heading(quantity)).x_label("s").text(style)
    }

    pub fn summary(&self, quantity: &BeamQuantity) -> String {
        let number = |value: f64| significant(value, DIGITS);
        let line = |beam: &BeamProfile| {
            let values = || beam.along.iter().map(quantity.of);
            let ends = |value: Option<f64>| value.map_or_else(String::new, number);
            let at = |value: f64| {
                let found = beam.along.iter().find(|at| (quantity.of)(at) == value);
                found.map_or_else(String::new, |at| format!(" at s = {}", number(at.arc_length)))
            };
            let extreme = |value: Option<f64>| {
                value.map_or_else(String::new, |value| format!("{}{}", number(value), at(value)))
            };
            format!(
                "{}: {} {} at the start, least {}, most {}, {} at the end",
                beam.name,
                quantity.label(),
                ends(values().next()),
                extreme(values().reduce(f64::min)),
                extreme(values().reduce(f64::max)),
                ends(values().next_back()),
            )
        };
        self.beams.iter().map(line).collect::<Vec<_>>().join("\n")
    }
}

fn plain(point: &Vec2) -> Point {
    (point.x, point.y)
}
