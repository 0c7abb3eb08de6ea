//! Line charts: series of points over a horizontal axis, linear or logarithmic.

use super::{
    axis::{AxisScale, DEFAULT_FLOOR, PlotAxis},
    canvas::{Align, Area, Canvas, Point},
    colour::{Colour, GREY, HUE_COUNT, INK, hue, tint},
    frame::{Frame, Margins},
    legend::LegendEntry,
    marker::Marker,
    page::Panel,
    plane::AxisLimits,
    stroke::Stroke,
};

const LINE: f64 = 2.0;
const MARK: f64 = 3.5;
/// Line width of pale series, marker radius of pale and thin series [pixels], and argument `part` of [`tint`] for pale series.
const FAINT: (f64, f64, f64) = (0.9, 2.4, 0.15);
const THIN: f64 = 1.3;
const NOTE: f64 = 12.0;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum SeriesColour {
    #[default]
    Next,
    OfSeries(usize),
    Black,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum SeriesEmphasis {
    #[default]
    Full,
    Thin,
    Pale,
}

/// Named curve of a chart. Points that are not finite leave a gap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    pub name: String,
    pub points: Vec<Point>,
    /// Line style; if `None`, the line is continuous until all colours of the palette are used, and then has the next style.
    pub stroke: Option<Stroke>,
    pub marker: Marker,
    pub ink: SeriesColour,
    pub weight: SeriesEmphasis,
}

impl Series {
    /// Series through `points`. A series with an empty name is not listed in the legend.
    pub fn new(name: impl Into<String>, points: Vec<Point>) -> Self {
        Self { name: name.into(), points, ..Self::default() }
    }

    pub fn marker(mut self, marker: Marker) -> Self {
        self.marker = marker;
        self
    }

    pub fn ink(mut self, ink: SeriesColour) -> Self {
        self.ink = ink;
        self
    }

    pub fn thin(mut self) -> Self {
        self.weight = SeriesEmphasis::Thin;
        self
    }

    pub fn pale(mut self) -> Self {
        self.weight = SeriesEmphasis::Pale;
        self
    }

    pub fn stroke(mut self, stroke: Stroke) -> Self {
        self.stroke = Some(stroke);
        self
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct LineChart {
    title: String,
    x_label: String,
    y_label: String,
    x_scale: AxisScale,
    y_scale: AxisScale,
    limits: AxisLimits,
    size: (f64, f64),
    pub(super) series: Vec<Series>,
    captions: Vec<String>,
    notes: Vec<(Point, String)>,
}

impl LineChart {
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            x_label: String::new(),
            y_label: String::new(),
            x_scale: AxisScale::Linear,
            y_scale: AxisScale::Linear,
            limits: AxisLimits::default(),
            size: (900.0, 560.0),
            series: Vec::new(),
            captions: Vec::new(),
            notes: Vec::new(),
        }
    }

    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    pub fn x_label(mut self, label: impl Into<String>) -> Self {
        self.x_label = label.into();
        self
    }

    pub fn y_label(mut self, label: impl Into<String>) -> Self {
        self.y_label = label.into();
        self
    }

    pub fn x_scale(mut self, scale: AxisScale) -> Self {
        self.x_scale = scale;
        self
    }

    pub fn y_scale(mut self, scale: AxisScale) -> Self {
        self.y_scale = scale;
        self
    }

    /// Fixes the ends of the axes and clips the data to them. An axis without limits is fitted to the visible points.
    pub fn limits(mut self, limits: AxisLimits) -> Self {
        self.limits = limits;
        self
    }

    /// Sets the size of the chart as a stand-alone picture [pixels].
    pub fn sized(mut self, width: f64, height: f64) -> Self {
        self.size = (width, height);
        self
    }

    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Combines the series of several charts in the axes of the first chart.
    /// Each series gets the name of its chart, followed by its own name if the chart has several series.
    /// Unless a series has its own line style, lines of the second chart are dashed, and lines of the third chart are dotted.
    pub fn shared(
        title: impl Into<String>,
        charts: impl IntoIterator<Item = (String, Self)>,
    ) -> Self {
        let mut charts = charts.into_iter().peekable();
        let empty = charts.peek().map_or_else(|| Self::new(""), |(_, first)| first.clone());
        let empty = Self { title: title.into(), series: Vec::new(), ..empty };
        charts.enumerate().fold(empty, |shared, (which, (whose, chart))| {
            let is_alone = chart.series.len() == 1;
            chart.series.into_iter().fold(shared, |shared, series| {
                let name =
                    if is_alone { whose.clone() } else { format!("{whose}: {}", series.name) };
                // An equal curve of the first chart remains visible in the gaps of a dashed curve.
                let stroke = series.stroke.or((which > 0).then(|| Stroke::of_palette_pass(which)));
                shared.series(Series { name, stroke, ..series })
            })
        })
    }

    pub fn each(mut self, change: impl Fn(usize, Series) -> Series) -> Self {
        let series = self.series.into_iter().enumerate();
        self.series = series.map(|(index, series)| change(index, series)).collect();
        self
    }

    pub fn add_band(&mut self, index: usize, distances: &[f64]) {
        for sign in [1.0, -1.0] {
            let points = self.series[index].points.iter().zip(distances);
            let edge = points.map(|((x, y), distance)| (*x, y + sign * distance)).collect();
            self.series.push(Series::new("", edge).ink(SeriesColour::OfSeries(index)).thin());
        }
    }

    pub fn caption(mut self, words: impl Into<String>) -> Self {
        self.captions.push(words.into());
        self
    }

    pub fn annotate(mut self, at: Point, text: impl Into<String>) -> Self {
        self.notes.push((at, text.into()));
        self
    }

    fn points(&self) -> impl Iterator<Item = Point> {
        let points = self.series.iter().flat_map(|series| series.points.iter().copied());
        points.filter(|(x, y)| x.is_finite() && y.is_finite())
    }

    pub(super) fn frame(&self) -> Frame {
        let marked = self.series.iter().any(|series| series.stroke.is_some_and(Stroke::has_marks));
        let axis = |scale, values: &mut dyn Iterator<Item = f64>, margin| match scale {
            AxisScale::Linear => PlotAxis::linear(values, margin),
            AxisScale::Logarithmic => PlotAxis::logarithmic(values, DEFAULT_FLOOR),
        };
        let fixed = |scale, ends: Option<(f64, f64)>| {
            let (low, high) = ends.filter(|(low, high)| low < high)?;
            Some(match scale {
                AxisScale::Linear => PlotAxis::between(low, high),
                AxisScale::Logarithmic if low > 0.0 => PlotAxis::powers_between(low, high),
                AxisScale::Logarithmic => PlotAxis::logarithmic([low, high], DEFAULT_FLOOR),
            })
        };
        let is_between = |x: f64| self.limits.x.is_none_or(|(low, high)| (low..=high).contains(&x));
        let mut seen = self.points().filter(|(x, _)| is_between(*x)).map(|point| point.1);
        let x_margin = if marked { 0.04 } else { 0.0 };
        let x = fixed(self.x_scale, self.limits.x).unwrap_or_else(|| {
            axis(self.x_scale, &mut self.points().map(|point| point.0), x_margin)
        });
        let y = fixed(self.y_scale, self.limits.y)
            .unwrap_or_else(|| axis(self.y_scale, &mut seen, 0.06));
        Frame {
            title: self.title.clone(),
            captions: self.captions.clone(),
            x_label: self.x_label.clone(),
            y_label: self.y_label.clone(),
            x,
            y,
            legend: self.legend(),
        }
    }

    fn legend(&self) -> Vec<LegendEntry> {
        let entry = |(index, series): (usize, &Series)| {
            let (colour, stroke) = default_style(index, series);
            LegendEntry { name: series.name.clone(), colour, stroke, marker: series.marker }
        };
        let is_axis = |name: &str| {
            let unit = self.y_label.strip_prefix(name);
            unit.is_some_and(|unit| unit.is_empty() || unit.starts_with(" ["))
        };
        match self.series.as_slice() {
            [only] if only.name == self.title || is_axis(&only.name) => Vec::new(),
            all => all
                .iter()
                .enumerate()
                .filter(|(_, series)| !series.name.is_empty())
                .map(entry)
                .collect(),
        }
    }
}

fn default_style(index: usize, series: &Series) -> (Colour, Stroke) {
    let colour = match series.ink {
        SeriesColour::Next => hue(index),
        SeriesColour::OfSeries(number) => hue(number),
        SeriesColour::Black => INK,
    };
    (colour, series.stroke.unwrap_or(Stroke::of_palette_pass(index / HUE_COUNT)))
}

impl Panel for LineChart {
    fn size(&self) -> (f64, f64) {
        self.size
    }

    fn margins(&self, width: f64, height: f64) -> Margins {
        self.frame().margins(width, height)
    }

    fn draw(&self, canvas: &mut Canvas, area: &Area, plot: &Area) {
        let frame = self.frame();
        frame.draw(canvas, area, plot);
        if self.points().next().is_none() {
            frame.draw_no_data(canvas, plot);
        }
        let faint_first = [SeriesEmphasis::Pale, SeriesEmphasis::Thin, SeriesEmphasis::Full]
            .into_iter()
            .flat_map(|weight| {
                self.series.iter().enumerate().filter(move |(_, series)| series.weight == weight)
            });
        for (index, series) in faint_first {
            let (colour, stroke) = default_style(index, series);
            let (line, mark, colour) = match series.weight {
                SeriesEmphasis::Full => (LINE, MARK, colour),
                SeriesEmphasis::Thin => (THIN, FAINT.1, colour),
                SeriesEmphasis::Pale => (FAINT.0, FAINT.1, tint(colour, FAINT.2)),
            };
            for run in frame.curve(plot, &series.points) {
                match run.as_slice() {
                    [dot] if !stroke.has_marks() => canvas.disc(*dot, mark, colour),
                    _ => stroke.draw(canvas, &run, line, colour),
                }
            }
            if stroke.has_marks() {
                let marks = frame.marks(plot, &series.points);
                marks.into_iter().for_each(|at| series.marker.draw(canvas, at, mark, colour));
            }
        }
        for (at, text) in &self.notes {
            let (x, y) = frame.place(plot, *at);
            canvas.text(text, (x + 8.0, y + 1.2 * NOTE), NOTE, Align::Start, GREY);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn equal_charts_give_equal_bytes() {
        let points = (0..200).map(|i| (f64::from(i) * 0.05, (f64::from(i) * 0.1).sin())).collect();
        let chart = LineChart::new("sine").x_label("t [s]").series(Series::new("sin", points));
        let pictures = || {
            let figure = chart.figure().unwrap();
            (figure.to_svg().unwrap(), figure.to_png().unwrap())
        };
        assert_eq!(pictures(), pictures());
        assert!(pictures().0.contains("<desc>sine | sin | 0 |"), "{}", pictures().0);
    }

    #[test]
    fn chart_of_half_a_million_points_is_a_small_file() {
        let noise =
            (0..500_000u32).map(|i| (f64::from(i), f64::from(i % 1000 * 919 % 1000))).collect();
        let figure = LineChart::new("noise").series(Series::new("noise", noise)).figure().unwrap();
        assert!(figure.to_svg().unwrap().len() < 200_000);
        figure.to_png().unwrap();
    }

    #[test]
    fn empty_chart_shows_no_data() {
        let nothing = Series::new("nothing", vec![(f64::NAN, 1.0), (1.0, f64::INFINITY)]);
        let svg = LineChart::new("").series(nothing).figure().unwrap().to_svg().unwrap();
        assert!(svg.contains("no data"));
    }

    #[test]
    fn single_series_named_like_the_axis_has_no_legend() {
        let chart = LineChart::new("t").y_label("energy").series(Series::new("energy", vec![]));
        assert!(chart.legend().is_empty());
        assert!(chart.clone().y_label("energy [J]").legend().is_empty());
        assert_eq!(chart.clone().y_label("energy loss").legend().len(), 1);
        assert_eq!(chart.series(Series::new("work", vec![])).legend().len(), 2);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]
        #[test]
        fn any_points_give_a_valid_chart(
            points in prop::collection::vec((proptest::num::f64::ANY, proptest::num::f64::ANY), 0..12),
            name in ".*",
            scales in (0..4usize, 0..5usize),
        ) {
            let scale = |which| if which == 0 { AxisScale::Linear } else { AxisScale::Logarithmic };
            let stroke = [Stroke::Solid, Stroke::Dashed, Stroke::Dotted, Stroke::Marked][scales.0];
            let chart = LineChart::new(name.clone()).x_label(name.clone()).y_label("y").x_scale(scale(scales.0 % 2))
                .y_scale(scale(scales.1 % 2)).sized(300.0, 200.0)
                .series(Series::new(name.clone(), points.clone()).stroke(stroke)).series(Series::new(name, points));
            let figure = chart.figure().unwrap();
            figure.to_png().unwrap();
            figure.to_svg().unwrap();
        }
    }
}
