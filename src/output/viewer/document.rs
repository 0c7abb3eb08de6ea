//! HTML page of the viewer: a template with style, scripts, and motions as data.

use serde_json::{Value, json};

use super::data::{
    Arrow, BeamShape, BodyShape, ColourField, PointCombination, SpringEnd, SpringShape, SymbolMark,
    TimeCurve, ViewerData,
};
use super::packing::{FINEST, Quantisation, pack};
use super::thinning::rows_to_keep;
use crate::output::OutputError;
use crate::output::canvas::Point;
use crate::output::colour::{Colour, HUE_COUNT, hue};
use crate::output::plane::{AxisLimits, View};
use crate::output::symbol::{PlacedSymbol, Symbol};

const TEMPLATE: &str = include_str!("page/template.html");
const STYLE: &str = include_str!("page/style.css");
const PROGRAMS: [&str; 9] = [
    include_str!("page/reading.js"),
    include_str!("page/film.js"),
    include_str!("page/colours.js"),
    include_str!("page/view.js"),
    include_str!("page/stage.js"),
    include_str!("page/chart.js"),
    include_str!("page/clock.js"),
    include_str!("page/viewer.js"),
    include_str!("page/controls.js"),
];

/// Number of rounding steps between the smallest and largest value of a field, more than the shades that a screen distinguishes.
const SHADES: u16 = 255;
/// Number of values to which a load component between -1 and 1 is rounded; odd, so that zero is one of them.
const LOAD_STEPS: u16 = 4095;
/// Number of rounding steps of weights between 0 and 1, whose error is far below the resolution of the points.
const WEIGHT_PARTS: f64 = 1e7;

/// HTML page with one motion, or several motions side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Viewer {
    /// Title of the page.
    pub title: String,
    /// Motions that the page shows.
    pub motions: Vec<ViewerData>,
}

impl Viewer {
    /// Text of the page. Equal data give equal bytes.
    ///
    /// # Errors
    /// Fails if the data cannot be compressed.
    pub fn to_html(&self) -> Result<String, OutputError> {
        let motions = self.motions.iter().map(packed_motion).collect::<Result<Vec<_>, _>>()?;
        let hues: Vec<[u8; 3]> = (0..HUE_COUNT)
            .map(|index| {
                let Colour(red, green, blue) = hue(index);
                [red, green, blue]
            })
            .collect();
        let data = json!({ "title": self.title, "hues": hues, "films": motions });
        // Only the character `<` could end the script element that contains the data.
        let data = data.to_string().replace('<', "\\u003c");
        let title = escaped(&self.title);
        Ok(filled(
            TEMPLATE,
            &[
                ("{{title}}", &title),
                ("{{style}}", STYLE.trim_end()),
                ("{{title}}", &title),
                ("{{data}}", &data),
                ("{{program}}", PROGRAMS.join("\n").trim_end()),
            ],
        ))
    }
}

fn filled(template: &str, texts: &[(&str, &str)]) -> String {
    let mut page = String::new();
    let mut rest = template;
    for (mark, text) in texts {
        if let Some((before, after)) = rest.split_once(mark) {
            page += before;
            page += text;
            rest = after;
        }
    }
    page + rest
}

fn escaped(text: &str) -> String {
    let escape = |letter| match letter {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        '\'' => "&#39;".to_owned(),
        other => other.to_string(),
    };
    text.chars().map(escape).collect()
}

fn packed_motion(viewer_data: &ViewerData) -> Result<Value, OutputError> {
    let mut shapes: Vec<Value> = Vec::new();
    let beams: Vec<Value> =
        viewer_data.beams.iter().map(|beam| packed_beam(beam, &mut shapes)).collect();
    let particle = |particle: &super::ParticleShape| json!({ "name": particle.name, "at": place(&particle.at, 0) });
    let trail = |trail: &super::Trail| json!({ "name": trail.name, "at": place(&trail.at, 0) });
    let bodies = View::of(viewer_data.points.iter().flatten().copied(), &AxisLimits::default());
    let obstacle = |(name, placed): &(String, PlacedSymbol)| {
        let PlacedSymbol { symbol, at, direction } = placed;
        json!({ "kind": symbol.name(), "name": name, "at": at, "direction": direction, "shown": placed.shown_points(&bodies) })
    };
    let (x, y) = packed_points(viewer_data)?;
    Ok(json!({
        "label": viewer_data.label,
        "times": viewer_data.times,
        "x": x,
        "y": y,
        "shapes": shapes,
        "beams": beams,
        "particles": viewer_data.particles.iter().map(particle).collect::<Vec<_>>(),
        "bodies": viewer_data.bodies.iter().map(packed_body).collect::<Vec<_>>(),
        "symbols": viewer_data.signs.iter().map(packed_sign).collect::<Vec<_>>(),
        "obstacles": viewer_data.obstacles.iter().map(obstacle).collect::<Vec<_>>(),
        "springs": viewer_data.springs.iter().map(packed_spring).collect::<Vec<_>>(),
        "trails": viewer_data.trails.iter().map(trail).collect::<Vec<_>>(),
        "arrows": packed_arrows(&viewer_data.arrows, viewer_data.times.len())?,
        "fields": viewer_data.fields.iter().map(packed_field).collect::<Result<Vec<_>, _>>()?,
        "history": packed_history(viewer_data)?,
    }))
}

fn packed_body(body: &BodyShape) -> Value {
    let point =
        |(name, at): &(String, PointCombination)| json!({ "name": name, "at": place(at, 0) });
    json!({
        "name": body.name,
        "at": place(&body.centre, 0),
        "points": body.points.iter().map(point).collect::<Vec<_>>(),
        "outline": body.outline.iter().map(|at| place(at, 0)).collect::<Vec<_>>(),
        "corners": body.corners,
    })
}

fn packed_sign(sign: &SymbolMark) -> Value {
    json!({
        "kind": sign.symbol.name(), "name": sign.name, "at": place(&sign.at, 0), "angle": sign.angle, "until": sign.until,
    })
}

fn packed_spring(spring: &SpringShape) -> Value {
    let anchor = |anchor: &SpringEnd| match anchor {
        SpringEnd::Moving(at) => place(at, 0),
        SpringEnd::Ground((x, y)) => json!({ "x": x, "y": y }),
    };
    let anchors = spring.anchors.iter().map(anchor).collect::<Vec<_>>();
    json!({ "kind": spring.symbol.name(), "name": spring.name, "anchors": anchors, "until": spring.until })
}

fn packed_beam(beam: &BeamShape, shapes: &mut Vec<Value>) -> Value {
    let first = beam.line.iter().map(|place| place.first).min().unwrap_or(0);
    let shape = json!({
        "line": beam.line.iter().map(|at| place(at, first)).collect::<Vec<_>>(),
        "marks": beam.marks,
        "stations": beam.stations,
    });
    let known = shapes.iter().position(|other| *other == shape);
    let shape = known.unwrap_or_else(|| {
        shapes.push(shape);
        shapes.len() - 1
    });
    json!({ "name": beam.name, "first": first, "shape": shape })
}

/// Packs a point as its weights and the index of its first control point, counted from `from`.
fn place(place: &PointCombination, from: usize) -> Value {
    let rounded = |weight: &f64| (weight * WEIGHT_PARTS).round() / WEIGHT_PARTS;
    let weights: Vec<f64> = place.weights.iter().map(rounded).collect();
    json!([place.first - from, weights])
}

fn packed_points(viewer_data: &ViewerData) -> Result<(Value, Value), OutputError> {
    let along = |pick: fn(&Point) -> f64| {
        Quantisation::over(viewer_data.points.iter().flatten().map(pick), FINEST)
    };
    let (x, y) = (along(|point| point.0), along(|point| point.1));
    let step = x.step.max(y.step);
    let shape = (viewer_data.points.first().map_or(0, Vec::len), viewer_data.points.len());
    let packed = |scale: Quantisation, pick: fn(&Point) -> f64| {
        pack(Quantisation { step, ..scale }, shape, |point, frame| {
            pick(&viewer_data.points[frame][point])
        })
    };
    Ok((packed(x, |point| point.0)?, packed(y, |point| point.1)?))
}

fn packed_arrows(arrows: &[Arrow], frames: usize) -> Result<Value, OutputError> {
    let largest = |kind: Symbol| {
        let of_kind = arrows.iter().filter(|arrow| arrow.symbol == kind);
        let sizes = of_kind.flat_map(|arrow| &arrow.values).map(|(x, y)| x.abs().max(y.abs()));
        sizes.filter(|size| size.is_finite()).fold(f64::MIN_POSITIVE, f64::max)
    };
    let sizes = arrows.iter().map(|arrow| largest(arrow.symbol)).collect::<Vec<_>>();
    let value = |number: usize, frame: usize| {
        let (x, y) = arrows[number / 2].values[frame];
        [x, y][number % 2] / sizes[number / 2]
    };
    let scale = Quantisation { origin: -1.0, step: 2.0 / f64::from(LOAD_STEPS - 1) };
    let arrow = |arrow: &Arrow| json!({ "kind": arrow.symbol.name(), "name": arrow.name, "at": place(&arrow.at, 0) });
    Ok(json!({
        "all": arrows.iter().map(arrow).collect::<Vec<_>>(),
        "values": pack(scale, (2 * arrows.len(), frames), value)?,
    }))
}

fn packed_field(field: &ColourField) -> Result<Value, OutputError> {
    let scale = Quantisation::over(field.values.iter().flatten().copied(), SHADES);
    let shape = (field.values.first().map_or(0, Vec::len), field.values.len());
    let values = pack(scale, shape, |station, frame| field.values[frame][station])?;
    Ok(json!({ "name": field.name, "unit": field.unit, "values": values }))
}

fn packed_history(viewer_data: &ViewerData) -> Result<Value, OutputError> {
    let columns: Vec<&[f64]> =
        viewer_data.columns.iter().map(|column| column.values.as_slice()).collect();
    let kept = rows_to_keep(viewer_data.rows.len(), &columns);
    let column = |column: &TimeCurve| {
        let values = || kept.iter().map(|row| column.values[*row]);
        let packed = pack(Quantisation::over(values(), FINEST), (1, kept.len()), |_, row| {
            column.values[kept[row]]
        })?;
        Ok(json!({ "name": column.name, "unit": column.unit, "values": packed }))
    };
    let times: Vec<f64> = kept.iter().map(|row| viewer_data.rows[*row]).collect();
    let columns =
        viewer_data.columns.iter().map(column).collect::<Result<Vec<_>, OutputError>>()?;
    Ok(json!({ "times": times, "columns": columns }))
}

#[cfg(test)]
mod tests;
