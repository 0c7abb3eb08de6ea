//! Pictures of motion: snapshots at several times in one plot, from pale (early) to dark (late).

use super::{
    canvas::{Area, Canvas, Point},
    colour::{Colour, HUE_COUNT, INK, hue, ramp, tint},
    colour_bar::ColourBar,
    frame::{Frame, Margins},
    legend::LegendEntry,
    marker::Marker,
    page::{Page, Panel},
    plane::{AxisLimits, View},
    stroke::Stroke,
    symbol::PlacedSymbol,
};

const LINE: f64 = 2.0;
const OUTLINE: f64 = 1.6;
const TRACE: f64 = 1.4;
const MARK: f64 = 2.4;
const PARTICLE: f64 = 4.5;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionFrame {
    pub time: f64,
    pub lines: Vec<Vec<Point>>,
    pub marks: Vec<Point>,
    pub particles: Vec<Point>,
    pub bodies: Vec<Vec<Point>>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionPicture {
    title: String,
    time_label: String,
    beams: Vec<String>,
    snapshots: Vec<MotionFrame>,
    traces: Vec<(String, Vec<Point>)>,
    symbols: Vec<PlacedSymbol>,
    captions: Vec<String>,
    limits: AxisLimits,
}

impl MotionPicture {
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), time_label: "t".into(), ..Self::default() }
    }

    pub fn time_label(mut self, label: impl Into<String>) -> Self {
        self.time_label = label.into();
        self
    }

    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    pub fn beams(mut self, names: impl IntoIterator<Item = impl Into<String>>) -> Self {
        self.beams = names.into_iter().map(Into::into).collect();
        self
    }

    pub fn snapshot(mut self, snapshot: MotionFrame) -> Self {
        self.snapshots.push(snapshot);
        self
    }

    pub fn trace(mut self, name: impl Into<String>, points: Vec<Point>) -> Self {
        self.traces.push((name.into(), points));
        self
    }

    pub fn symbols(mut self, symbols: impl IntoIterator<Item = PlacedSymbol>) -> Self {
        self.symbols.extend(symbols);
        self
    }

    pub fn caption(mut self, words: impl Into<String>) -> Self {
        self.captions.push(words.into());
        self
    }

    /// Sets the ends of the axes. Because both axes have the same scale, one of them may show more than requested.
    pub fn limits(mut self, limits: AxisLimits) -> Self {
        self.limits = limits;
        self
    }

    pub fn side_by_side(pictures: impl IntoIterator<Item = MotionPicture>) -> Page {
        let pictures: Vec<MotionPicture> = pictures.into_iter().collect();
        let limits = Self::shared_limits(&pictures);
        let framed = pictures.into_iter().map(|picture| picture.limits(limits));
        framed.fold(Page::row(), Page::panel)
    }

    pub fn shared_limits(pictures: &[Self]) -> AxisLimits {
        let given = pictures.first().map_or_else(AxisLimits::default, |first| first.limits);
        let points = pictures.iter().flat_map(Self::points);
        let symbols: Vec<PlacedSymbol> =
            pictures.iter().flat_map(|picture| &picture.symbols).copied().collect();
        PlacedSymbol::view(&symbols, points, &given).limits()
    }

    fn points(&self) -> impl Iterator<Item = Point> + Clone {
        let snapshots = self.snapshots.iter().flat_map(|snapshot| {
            let lines = snapshot.lines.iter().chain(&snapshot.bodies).flatten();
            lines.chain(&snapshot.marks).chain(&snapshot.particles)
        });
        let traces = self.traces.iter().flat_map(|(_, points)| points);
        snapshots.chain(traces).copied().filter(|(x, y)| x.is_finite() && y.is_finite())
    }

    fn view(&self) -> View {
        PlacedSymbol::view(&self.symbols, self.points(), &self.limits)
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
            legend: self.legend(),
        }
    }

    fn legend(&self) -> Vec<LegendEntry> {
        let beams =
            self.beams.iter().take(self.beam_count()).enumerate().filter(|_| self.beam_count() > 1);
        let beams = beams.map(|(index, name)| LegendEntry {
            name: name.clone(),
            colour: hue(index),
            stroke: Stroke::of_palette_pass(index / HUE_COUNT),
            marker: Marker::Disc,
        });
        let traces = self.traces.iter().enumerate().map(|(index, (name, _))| {
            let (colour, stroke) = self.trace_style(index);
            LegendEntry { name: name.clone(), colour, stroke, marker: Marker::Disc }
        });
        beams.chain(traces).filter(|entry| !entry.name.is_empty()).collect()
    }

    fn beam_count(&self) -> usize {
        self.snapshots.iter().map(|snapshot| snapshot.lines.len()).max().unwrap_or(0)
    }

    fn trace_style(&self, index: usize) -> (Colour, Stroke) {
        let first = if self.beam_count() > 1 { self.beam_count() } else { 1 };
        (hue(first + index), if index < HUE_COUNT { Stroke::Dashed } else { Stroke::Dotted })
    }

    fn colour(&self, index: usize, part: f64) -> Colour {
        if self.beam_count() > 1 { tint(hue(index), part) } else { ramp(part) }
    }

    fn stroke(&self, index: usize) -> Stroke {
        if self.beam_count() > 1 {
            Stroke::of_palette_pass(index / HUE_COUNT)
        } else {
            Stroke::Solid
        }
    }

    fn time_bar(&self) -> ColourBar {
        let shade = if self.beam_count() > 1 { |part| tint(INK, part) } else { ramp };
        ColourBar::new(&self.time_label, self.snapshots.iter().map(|snapshot| snapshot.time), shade)
    }

    fn draw_snapshot(
        &self,
        canvas: &mut Canvas,
        frame: &Frame,
        plot: &Area,
        snapshot: &MotionFrame,
        part: f64,
    ) {
        let shade = if self.beam_count() > 1 { tint(INK, part) } else { self.colour(0, part) };
        for run in snapshot.bodies.iter().flat_map(|body| frame.curve(plot, body)) {
            canvas.line(run, OUTLINE, shade);
        }
        for (index, line) in snapshot.lines.iter().enumerate() {
            for run in frame.curve(plot, line) {
                self.stroke(index).draw(canvas, &run, LINE, self.colour(index, part));
            }
        }
        for (places, radius) in [(&snapshot.marks, MARK), (&snapshot.particles, PARTICLE)] {
            for place in frame_marks(frame, plot, places) {
                canvas.disc(place, radius, shade);
            }
        }
    }
}

fn frame_marks(frame: &Frame, plot: &Area, marks: &[Point]) -> impl Iterator<Item = Point> {
    marks.iter().flat_map(|&mark| frame.curve(plot, &[mark])).flatten()
}

impl Panel for MotionPicture {
    fn size(&self) -> (f64, f64) {
        let (wide, tall) = self.view().size();
        let margins = self.margins(wide + 140.0, tall + 110.0);
        (wide + margins.left + margins.right, tall + margins.top + margins.bottom)
    }

    fn margins(&self, width: f64, height: f64) -> Margins {
        let frame = self.frame((width - 140.0).max(50.0), (height - 110.0).max(50.0));
        frame.margins_beside(self.time_bar().width(), width, height)
    }

    fn draw(&self, canvas: &mut Canvas, area: &Area, plot: &Area) {
        let frame = self.frame(plot.width(), plot.height());
        frame.draw(canvas, area, plot);
        if self.points().next().is_none() {
            frame.draw_no_data(canvas, plot);
        }
        let bar = self.time_bar();
        bar.draw(canvas, plot);
        PlacedSymbol::draw_obstacles(&self.symbols, canvas, &frame, plot);
        let mut snapshots: Vec<&MotionFrame> = self.snapshots.iter().collect();
        snapshots.sort_by(|a, b| a.time.total_cmp(&b.time));
        for snapshot in snapshots {
            self.draw_snapshot(canvas, &frame, plot, snapshot, bar.part(snapshot.time));
        }
        for (index, (_, points)) in self.traces.iter().enumerate() {
            let (colour, stroke) = self.trace_style(index);
            frame
                .curve(plot, points)
                .iter()
                .for_each(|run| stroke.draw(canvas, run, TRACE, colour));
        }
        self.symbols.iter().for_each(|symbol| symbol.draw(canvas, &frame, plot));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn snapshot(time: f64, lines: Vec<Vec<Point>>) -> MotionFrame {
        MotionFrame { time, lines, ..MotionFrame::default() }
    }

    #[test]
    fn motion_picture_has_equal_scales_and_fits_the_data() {
        let tall =
            MotionPicture::new("").snapshot(snapshot(0.0, vec![vec![(0.0, 0.0), (1.0, 3.0)]]));
        let flat =
            MotionPicture::new("").snapshot(snapshot(0.0, vec![vec![(0.0, 0.0), (4.0, 2.0)]]));
        assert!(tall.size().1 > tall.size().0 && flat.size().0 > flat.size().1);
        for picture in [tall, flat] {
            let (frame, plot) = (
                picture.frame(400.0, 300.0),
                Area { left: 0.0, top: 0.0, right: 400.0, bottom: 300.0 },
            );
            let (a, b, c) = (
                frame.place(&plot, (0.0, 0.0)),
                frame.place(&plot, (1.0, 0.0)),
                frame.place(&plot, (0.0, 1.0)),
            );
            assert!(((b.0 - a.0) - (a.1 - c.1)).abs() < 1e-9);
        }
    }

    #[test]
    fn pictures_side_by_side_have_equal_axes() {
        let picture = |x: f64| {
            MotionPicture::new("").snapshot(snapshot(0.0, vec![vec![(0.0, 0.0), (x, 1.0)]]))
        };
        let page = MotionPicture::side_by_side([picture(1.0), picture(3.0)]);
        let svg = page.figure().unwrap().to_svg().unwrap();
        let texts = svg.split_once("<desc>").unwrap().1.split_once("</desc>").unwrap().0;
        let texts: Vec<&str> = texts.split(" | ").collect();
        let (left, right) = texts.split_at(texts.len() / 2);
        assert_eq!(left, right, "the numbers along the axes are the same");
    }

    #[test]
    fn obstacles_are_drawn_behind_bodies_and_enlarge_the_view() {
        use crate::output::symbol::Symbol;
        let frame = snapshot(0.0, vec![vec![(0.0, 0.0), (2.0, 1.0)]]);
        let bare = MotionPicture::new("").snapshot(frame);
        let place = |symbol, at, direction| PlacedSymbol { symbol, at, direction };
        let floor = place(Symbol::Wall, (0.0, -0.2), (0.0, 1.0));
        let peg = place(Symbol::Disc, (3.0, 0.5), (0.3, 0.0));
        let picture = bare.clone().symbols([floor, peg]);
        let [(_, right), (low, _)] = picture.view().ends();
        assert!(low < -0.2 && right > 3.3, "{low} {right}");
        let shapes = |picture: &MotionPicture| {
            let area = Area { left: 0.0, top: 0.0, right: 500.0, bottom: 400.0 };
            let mut canvas = Canvas::default();
            picture.draw(&mut canvas, &area, &picture.margins(500.0, 400.0).inside(&area));
            canvas.shapes().to_vec()
        };
        let limits = picture.view().limits();
        let (with, without) = (shapes(&picture), shapes(&bare.limits(limits)));
        assert!(with.len() > without.len() + 40);
        assert_eq!(with.last(), without.last(), "the beam is drawn last");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]
        #[test]
        fn any_points_give_a_valid_motion_picture(
            points in prop::collection::vec((proptest::num::f64::ANY, proptest::num::f64::ANY), 0..8),
            times in prop::collection::vec(proptest::num::f64::ANY, 0..4),
        ) {
            let mut picture = MotionPicture::new("").beams(["a", "b"]).trace("tip", points.clone());
            for &time in &times {
                let lines = vec![points.clone(); points.len() % 3];
                let (marks, particles) = (points.clone(), points.clone());
                let bodies = lines.clone();
                picture = picture.snapshot(MotionFrame { time, lines, marks, particles, bodies });
            }
            let figure = picture.figure().unwrap();
            figure.to_png().unwrap();
            figure.to_svg().unwrap();
        }
    }
}
