//! Pictures of beams coloured by a quantity along them. Larger values are darker and wider.

use super::{
    axis::typeset_number,
    canvas::{Align, Area, Canvas, Point},
    colour::{INK, WHITE, ramp},
    colour_bar::ColourBar,
    fonts,
    frame::{Frame, Margins},
    marker::Marker,
    mechanism_outline::MechanismOutline,
    page::Panel,
    plane::{AxisLimits, View},
};
use crate::elementary::hypot;

const WIDTHS: (f64, f64) = (2.0, 10.0);
/// Length of a beam piece of a single colour [pixels]; longer if there would be too many pieces.
const PIECE: f64 = 3.0;
const MOST_PIECES: f64 = 4000.0;
const NUMBER: f64 = 12.0;
const DIGITS: usize = 4;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct FieldPicture {
    title: String,
    label: String,
    beams: Vec<Vec<(Point, f64)>>,
    outline: MechanismOutline,
    limits: AxisLimits,
}

impl FieldPicture {
    pub fn new(title: impl Into<String>, label: impl Into<String>) -> Self {
        Self { title: title.into(), label: label.into(), ..Self::default() }
    }

    pub fn beam(mut self, values: Vec<(Point, f64)>) -> Self {
        self.beams.push(values);
        self
    }

    pub fn outline(mut self, outline: MechanismOutline) -> Self {
        self.outline = outline;
        self
    }

    /// Sets the ends of the axes. Because both axes have the same scale, one of them may show more than requested.
    pub fn limits(mut self, limits: AxisLimits) -> Self {
        self.limits = limits;
        self
    }

    fn places(&self) -> impl Iterator<Item = &(Point, f64)> {
        self.beams.iter().flatten().filter(|(_, value)| value.is_finite())
    }

    fn largest(&self) -> Option<(Point, f64)> {
        self.places().copied().reduce(|a, b| if b.1 > a.1 { b } else { a })
    }

    fn frame(&self, width: f64, height: f64) -> Frame {
        let (x, y) = self.view().axes(width, height);
        Frame {
            title: self.title.clone(),
            captions: Vec::new(),
            x_label: "x".into(),
            y_label: "y".into(),
            x,
            y,
            legend: Vec::new(),
        }
    }

    fn view(&self) -> View {
        let points = self.beams.iter().flatten().map(|(at, _)| *at);
        self.outline.view(points, &self.limits)
    }

    fn bar(&self) -> ColourBar {
        let most = self.largest().map(|(_, value)| value);
        ColourBar::new(&self.label, [0.0].into_iter().chain(most), ramp)
            .with_wedge(WIDTHS.0, WIDTHS.1)
    }

    fn draw_beam(canvas: &mut Canvas, piece: f64, pixels: &[(Point, f64)]) {
        for pair in pixels.windows(2) {
            let ((a, from), (b, to)) = (pair[0], pair[1]);
            let count = (hypot(b.0 - a.0, b.1 - a.1) / piece).ceil().clamp(1.0, 1000.0) as usize;
            let at = |part: f64| (a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1));
            for index in 0..count {
                let (begin, end) = (index as f64, (index + 1) as f64);
                let part = from + (to - from) * (begin + 0.5) / count as f64;
                let width = WIDTHS.0 + (WIDTHS.1 - WIDTHS.0) * part;
                canvas.line([at(begin / count as f64), at(end / count as f64)], width, ramp(part));
            }
        }
    }

    fn draw_largest(
        &self,
        canvas: &mut Canvas,
        frame: &Frame,
        plot: &Area,
        beams: &[Vec<(Point, f64)>],
    ) {
        let Some((at, value)) = self.largest().filter(|(_, value)| *value > 0.0) else { return };
        if frame.curve(plot, &[at]).is_empty() {
            return;
        }
        let (x, y) = frame.place(plot, at);
        Marker::Ring.draw(canvas, (x, y), 6.0, INK);
        let text = typeset_number(value, DIGITS);
        let width = fonts::width(&text, NUMBER);
        let area = |away: f64, (right, down): (f64, f64)| {
            let left = x - 0.5 * width + right * (away + 0.5 * width);
            let top = y - 0.5 * NUMBER + down * (away + 0.2 * NUMBER);
            Area { left: left - 2.0, top, right: left + width + 2.0, bottom: top + NUMBER + 3.0 }
        };
        let away = [14.0, 22.0, 32.0].into_iter();
        let places = away.flat_map(|away| AROUND.map(|direction| area(away, direction)));
        let is_seen = |area: &Area| {
            area.left > plot.left
                && area.right < plot.right
                && area.top > plot.top
                && area.bottom < plot.bottom
        };
        let seen: Vec<Area> = places.filter(is_seen).collect();
        let free = seen.iter().find(|area| !beams.iter().any(|beam| crosses(beam, area)));
        let Some(paper) = free.or(seen.first()) else { return };
        canvas.fill(*paper, WHITE);
        canvas.text(&text, (paper.left + 2.0, paper.bottom - 3.0), NUMBER, Align::Start, INK);
    }
}

const AROUND: [(f64, f64); 8] = [
    (1.0, -1.0),
    (-1.0, -1.0),
    (1.0, 1.0),
    (-1.0, 1.0),
    (1.0, 0.0),
    (-1.0, 0.0),
    (0.0, -1.0),
    (0.0, 1.0),
];

fn crosses(beam: &[(Point, f64)], area: &Area) -> bool {
    beam.windows(2).any(|pair| {
        let (a, b) = (pair[0].0, pair[1].0);
        let count = (hypot(b.0 - a.0, b.1 - a.1) / PIECE).ceil().clamp(1.0, 500.0);
        let reach = 0.5 * WIDTHS.1;
        (0..=count as usize).any(|index| {
            let part = index as f64 / count;
            let (x, y) = (a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1));
            x > area.left - reach
                && x < area.right + reach
                && y > area.top - reach
                && y < area.bottom + reach
        })
    })
}

impl Panel for FieldPicture {
    fn size(&self) -> (f64, f64) {
        let (wide, tall) = self.view().size();
        let margins = self.margins(wide + 140.0, tall + 110.0);
        (wide + margins.left + margins.right, tall + margins.top + margins.bottom)
    }

    fn margins(&self, width: f64, height: f64) -> Margins {
        let frame = self.frame((width - 140.0).max(50.0), (height - 110.0).max(50.0));
        frame.margins_beside(self.bar().width(), width, height)
    }

    fn draw(&self, canvas: &mut Canvas, area: &Area, plot: &Area) {
        let frame = self.frame(plot.width(), plot.height());
        frame.draw(canvas, area, plot);
        if self.places().next().is_none() {
            frame.draw_no_data(canvas, plot);
        }
        let bar = self.bar();
        bar.draw(canvas, plot);
        self.outline.draw_obstacles(canvas, &frame, plot);
        let is_zero = self.largest().is_none_or(|(_, value)| value <= 0.0);
        let part = |value: f64| if is_zero { 0.0 } else { bar.part(value) };
        let on_paper = |(at, value): &(Point, f64)| (frame.place(plot, *at), part(*value));
        let beams: Vec<Vec<(Point, f64)>> =
            self.beams.iter().map(|beam| beam.iter().map(on_paper).collect()).collect();
        let length = |beam: &Vec<(Point, f64)>| {
            let pairs = beam.windows(2);
            pairs
                .map(|pair| hypot(pair[1].0.0 - pair[0].0.0, pair[1].0.1 - pair[0].0.1))
                .sum::<f64>()
        };
        let piece = PIECE.max(beams.iter().map(length).sum::<f64>() / MOST_PIECES);
        let is_inside = |at: Point| {
            (plot.left..=plot.right).contains(&at.0) && (plot.top..=plot.bottom).contains(&at.1)
        };
        for beam in &beams {
            for seen in beam.chunk_by(|(a, _), (b, _)| is_inside(*a) && is_inside(*b)) {
                Self::draw_beam(canvas, piece, seen);
            }
        }
        self.outline.draw(canvas, &frame, plot);
        self.draw_largest(canvas, &frame, plot, &beams);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::canvas::Shape;

    fn picture(value: fn(f64) -> f64) -> FieldPicture {
        let places = (0..=8).map(|index| f64::from(index) / 8.0);
        FieldPicture::new("field", "speed").beam(places.map(|s| ((s, 0.0), value(s))).collect())
    }

    #[test]
    fn larger_field_values_have_wider_lines_and_the_maximum_is_labelled() {
        let picture = picture(|s| 3.0 * s);
        let (area, plot) = (
            Area { left: 0.0, top: 0.0, right: 500.0, bottom: 300.0 },
            Area { left: 60.0, top: 40.0, right: 400.0, bottom: 250.0 },
        );
        let mut canvas = Canvas::default();
        picture.draw(&mut canvas, &area, &plot);
        let lines = canvas.shapes().iter().filter_map(|shape| match shape {
            Shape::Line { width, points, .. } if points.len() == 2 && *width >= WIDTHS.0 => {
                Some(*width)
            }
            _ => None,
        });
        let widths: Vec<f64> = lines.collect();
        assert!(widths.len() > 50 && widths.is_sorted(), "{widths:?}");
        let svg = picture.figure().unwrap().to_svg().unwrap();
        assert!(svg.contains("| speed | 3</desc>"), "{}", &svg[..600]);
    }

    #[test]
    fn empty_and_nan_fields_give_a_picture() {
        for value in [|_| 0.0, |_| f64::NAN] {
            picture(value).figure().unwrap().to_png().unwrap();
        }
        FieldPicture::new("", "").figure().unwrap().to_svg().unwrap();
    }
}
