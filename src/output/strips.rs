//! Diagrams of section forces, drawn as strips normal to the beams.

use super::{
    axis::typeset_number,
    canvas::{Align, Area, Canvas, Point},
    colour::{Colour, INK, hue, tint},
    fonts,
    frame::{Frame, Margins},
    mechanism_outline::MechanismOutline,
    page::Panel,
    plane::{AxisLimits, View},
};
use crate::elementary::hypot;

const BEAM: f64 = 2.4;
const EDGE: f64 = 1.5;
const ORDINATE: f64 = 1.0;
/// Distance between ordinates [pixels].
const APART: f64 = 7.0;
const NUMBER: f64 = 12.0;
/// Length of the longest ordinate, as a fraction of the size of the beams.
const LARGEST: f64 = 0.2;
/// Smallest magnitude of an extreme value that has a label, as a fraction of the largest magnitude.
const SMALLEST_LABELLED: f64 = 0.03;
const DIGITS: usize = 4;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum BeamSide {
    #[default]
    Left,
    Right,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct BeamStrip {
    pub line: Vec<Point>,
    pub values: Vec<(Point, f64)>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct StripPicture {
    title: String,
    captions: Vec<String>,
    strips: Vec<BeamStrip>,
    side: BeamSide,
    outline: MechanismOutline,
}

#[derive(Clone, Copy)]
struct Ordinate {
    foot: Point,
    tip: Point,
    value: f64,
}

impl StripPicture {
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    pub fn caption(mut self, words: impl Into<String>) -> Self {
        self.captions.push(words.into());
        self
    }

    pub fn strip(mut self, strip: BeamStrip) -> Self {
        self.strips.push(strip);
        self
    }

    pub fn side(mut self, side: BeamSide) -> Self {
        self.side = side;
        self
    }

    pub fn outline(mut self, outline: MechanismOutline) -> Self {
        self.outline = outline;
        self
    }

    fn largest(&self) -> f64 {
        let values = self.strips.iter().flat_map(|strip| &strip.values);
        values.map(|(_, value)| value.abs()).filter(|value| value.is_finite()).fold(0.0, f64::max)
    }

    fn runs(&self, strip: &BeamStrip) -> Vec<Vec<Ordinate>> {
        let largest = self.largest();
        let scale = if largest > 0.0 { LARGEST * self.beam_size() / largest } else { 0.0 };
        let scale = match self.side {
            BeamSide::Left => scale,
            BeamSide::Right => -scale,
        };
        let runs = strip.values.chunk_by(|(a, _), (b, _)| a != b);
        let run = |places: &[(Point, f64)]| {
            let ordinate = |(at, &(foot, value)): (usize, &(Point, f64))| {
                let (before, after) = (at.saturating_sub(1), (at + 1).min(places.len() - 1));
                let (a, b) = (places[before].0, places[after].0);
                let (x, y) = (b.0 - a.0, b.1 - a.1);
                let length = hypot(x, y);
                let (x, y) = if length > 0.0 { (x / length, y / length) } else { (0.0, 0.0) };
                let tip = (foot.0 - scale * value * y, foot.1 + scale * value * x);
                Ordinate { foot, tip, value }
            };
            places.iter().enumerate().map(ordinate).collect::<Vec<_>>()
        };
        runs.map(run).collect()
    }

    /// Size of the bounding box of all beams, or the length of the longest beam if it is smaller.
    fn beam_size(&self) -> f64 {
        let points = || self.strips.iter().flat_map(|strip| strip.line.iter().copied());
        let side = |pick: fn(Point) -> f64| {
            super::axis::extent(points().map(pick)).map_or(0.0, |(low, high)| high - low)
        };
        let length = |strip: &BeamStrip| {
            let pairs = strip.line.windows(2);
            pairs.map(|pair| hypot(pair[1].0 - pair[0].0, pair[1].1 - pair[0].1)).sum::<f64>()
        };
        let longest = self.strips.iter().map(length).fold(0.0, f64::max);
        side(|point| point.0).max(side(|point| point.1)).min(longest)
    }

    fn view(&self) -> View {
        let lines = self.strips.iter().flat_map(|strip| strip.line.iter().copied());
        let runs = self.strips.iter().flat_map(|strip| self.runs(strip));
        let tips: Vec<Point> = runs.flatten().map(|ordinate| ordinate.tip).collect();
        let points: Vec<Point> = lines.chain(tips).collect();
        self.outline.view(points.into_iter(), &AxisLimits::default())
    }

    fn frame(&self, width: f64, height: f64) -> Frame {
        let (x, y) = self.view().axes(width, height);
        Frame {
            title: self.title.clone(),
            captions: self.captions.clone(),
            x_label: "x".into(),
            y_label: "y".into(),
            x,
            y,
            legend: Vec::new(),
        }
    }

    fn draw_run(
        canvas: &mut Canvas,
        frame: &Frame,
        plot: &Area,
        (run, colour): (&[Ordinate], Colour),
    ) {
        let line = |canvas: &mut Canvas, points: &[Point], width, colour| {
            let pieces = frame.curve(plot, points).into_iter();
            pieces.for_each(|piece| canvas.line(piece, width, colour));
        };
        for pair in run.windows(2) {
            let (a, b) = (frame.place(plot, pair[0].foot), frame.place(plot, pair[1].foot));
            let count = (hypot(b.0 - a.0, b.1 - a.1) / APART).ceil().clamp(1.0, 100.0) as usize;
            for index in 0..count {
                let at = between(&pair[0], &pair[1], index as f64 / count as f64);
                line(canvas, &[at.foot, at.tip], ORDINATE, tint(colour, 0.45));
            }
        }
        let ends = [run.first(), run.last()].map(|end| end.map(|end| end.foot));
        let tips = run.iter().map(|at| at.tip);
        let edge: Vec<Point> = ends[0].into_iter().chain(tips).chain(ends[1]).collect();
        line(canvas, &edge, EDGE, colour);
    }

    fn on_beams(&self, frame: &Frame, plot: &Area) -> Vec<Point> {
        let lines = self.strips.iter().flat_map(|strip| frame.curve(plot, &strip.line));
        let dense = |run: Vec<Point>| {
            let between = |pair: &[Point]| {
                let (a, b) = (pair[0], pair[1]);
                let count = (hypot(b.0 - a.0, b.1 - a.1) / NUMBER * 2.0).ceil().clamp(1.0, 500.0);
                (0..=count as usize).map(move |index| {
                    let part = index as f64 / count;
                    (a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1))
                })
            };
            run.windows(2).flat_map(between).collect::<Vec<_>>()
        };
        lines.flat_map(dense).collect()
    }

    fn draw_extremes(
        &self,
        canvas: &mut Canvas,
        frame: &Frame,
        plot: &Area,
        ordinates: &[Ordinate],
        (on_beams, taken): (&[Point], &mut Vec<Area>),
    ) {
        let finite = || ordinates.iter().filter(|ordinate| ordinate.value.is_finite());
        let most = finite().max_by(|a, b| a.value.total_cmp(&b.value)).filter(|at| at.value > 0.0);
        let least = finite().min_by(|a, b| a.value.total_cmp(&b.value)).filter(|at| at.value < 0.0);
        let is_telling = |at: &&Ordinate| at.value.abs() > SMALLEST_LABELLED * self.largest();
        for at in most.into_iter().chain(least).filter(is_telling) {
            if frame.curve(plot, &[at.tip]).is_empty() {
                continue;
            }
            let text = typeset_number(at.value, DIGITS);
            let (foot, tip) = (frame.place(plot, at.foot), frame.place(plot, at.tip));
            let length = hypot(tip.0 - foot.0, tip.1 - foot.1).max(1e-9);
            let outwards = ((tip.0 - foot.0) / length, (tip.1 - foot.1) / length);
            let half = (fonts::width(&text, NUMBER) / 2.0, 0.5 * NUMBER);
            let free = [1.0, 2.5, 4.0, 6.0, 9.0, 13.0].into_iter().map(|far| {
                let reach = 5.0 * far + half.0 * outwards.0.abs() + half.1 * outwards.1.abs();
                let (x, y) = (tip.0 + reach * outwards.0, tip.1 + reach * outwards.1);
                let x = x.clamp(plot.left + half.0 + 2.0, plot.right - half.0 - 2.0);
                let y = y.clamp(plot.top + half.1, plot.bottom - half.1 - 2.0);
                Area { left: x - half.0, top: y - half.1, right: x + half.0, bottom: y + half.1 }
            });
            let is_free = |area: &Area| {
                let is_clear = |at: &Point| !overlap(area, &Area::around(*at, 1.0));
                on_beams.iter().all(is_clear) && !taken.iter().any(|other| overlap(area, other))
            };
            let Some(area) = free.into_iter().find(is_free) else { continue };
            let paper = Area { left: area.left - 2.0, right: area.right + 2.0, ..area };
            canvas.fill(paper, super::colour::WHITE);
            let anchor = ((area.left + area.right) / 2.0, area.bottom - 0.14 * NUMBER);
            canvas.text(&text, anchor, NUMBER, Align::Middle, INK);
            taken.push(area);
        }
    }
}

fn between(a: &Ordinate, b: &Ordinate, part: f64) -> Ordinate {
    let mix = |a: f64, b: f64| a + part * (b - a);
    let point = |a: Point, b: Point| (mix(a.0, b.0), mix(a.1, b.1));
    Ordinate { foot: point(a.foot, b.foot), tip: point(a.tip, b.tip), value: mix(a.value, b.value) }
}

fn overlap(a: &Area, b: &Area) -> bool {
    a.left < b.right + 4.0
        && b.left < a.right + 4.0
        && a.top < b.bottom + 1.0
        && b.top < a.bottom + 1.0
}

impl Panel for StripPicture {
    fn size(&self) -> (f64, f64) {
        let (wide, tall) = self.view().size();
        let margins = self.margins(wide + 100.0, tall + 110.0);
        (wide + margins.left + margins.right, tall + margins.top + margins.bottom)
    }

    fn size_among(&self, _rows: usize, columns: usize) -> (f64, f64) {
        let (width, height) = self.size();
        if columns > 1 { (0.72 * width, 0.72 * height) } else { (width, height) }
    }

    fn margins(&self, width: f64, height: f64) -> Margins {
        self.frame((width - 100.0).max(50.0), (height - 110.0).max(50.0)).margins(width, height)
    }

    fn draw(&self, canvas: &mut Canvas, area: &Area, plot: &Area) {
        let frame = self.frame(plot.width(), plot.height());
        frame.draw(canvas, area, plot);
        if self.strips.iter().all(|strip| strip.line.is_empty()) {
            frame.draw_no_data(canvas, plot);
        }
        self.outline.draw_obstacles(canvas, &frame, plot);
        let runs: Vec<Vec<Vec<Ordinate>>> =
            self.strips.iter().map(|strip| self.runs(strip)).collect();
        for (index, runs) in runs.iter().enumerate() {
            for run in runs {
                Self::draw_run(canvas, &frame, plot, (run, hue(index)));
            }
        }
        for strip in &self.strips {
            for run in frame.curve(plot, &strip.line) {
                canvas.line(run, BEAM, INK);
            }
        }
        self.outline.draw(canvas, &frame, plot);
        let on_beams = self.on_beams(&frame, plot);
        let mut taken = Vec::new();
        for runs in &runs {
            self.draw_extremes(canvas, &frame, plot, &runs.concat(), (&on_beams, &mut taken));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn beam(value: impl Fn(f64) -> f64) -> BeamStrip {
        let places = (0..=8).map(|index| f64::from(index) / 8.0);
        BeamStrip {
            line: vec![(0.0, 0.0), (1.0, 0.0)],
            values: places.map(|s| ((s, 0.0), value(s))).collect(),
        }
    }

    #[test]
    fn largest_strip_value_has_its_height_on_the_chosen_side() {
        for (side, sign) in [(BeamSide::Left, 1.0), (BeamSide::Right, -1.0)] {
            let picture = StripPicture::new("").strip(beam(|s| 40.0 * s)).side(side);
            let runs = picture.runs(&picture.strips[0]);
            let tip = runs[0].last().unwrap().tip;
            assert!((tip.0 - 1.0).abs() < 1e-12 && (tip.1 - sign * LARGEST).abs() < 1e-12);
        }
    }

    #[test]
    fn strips_are_divided_at_jumps_and_extremes_are_labelled() {
        let mut strip = beam(|s| if s < 0.5 { 1.0 } else { -2.0 });
        strip.values.insert(4, ((0.5, 0.0), 1.0));
        let picture = StripPicture::new("Q").strip(strip);
        assert_eq!(picture.runs(&picture.strips[0]).len(), 2);
        let svg = picture.figure().unwrap().to_svg().unwrap();
        let texts = svg.split_once("<desc>").unwrap().1.split_once("</desc>").unwrap().0;
        assert!(texts.ends_with("| 1 | −2"), "{texts}");
        assert_eq!(svg, picture.figure().unwrap().to_svg().unwrap());
    }

    #[test]
    fn empty_and_nan_strips_give_a_picture() {
        StripPicture::new("").figure().unwrap().to_png().unwrap();
        StripPicture::new("").strip(beam(|_| f64::NAN)).figure().unwrap().to_png().unwrap();
        StripPicture::new("").strip(beam(|_| 0.0)).figure().unwrap().to_png().unwrap();
    }
}
