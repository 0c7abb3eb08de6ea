//! Frame around the data of a panel: title, grid, axis lines, labels and legend.

use super::{
    axis::{Factor, PlotAxis, Tick},
    canvas::{Align, Area, Canvas, Point},
    colour::{AXIS, GREY, GRID, INK},
    curve, fonts, legend,
    legend::LegendEntry,
};

const TITLE: f64 = 16.0;
const CAPTION: f64 = 12.0;
const LABEL: f64 = 13.0;
const NUMBER: f64 = 12.0;
const EDGE: f64 = 14.0;
/// Smallest size of a text, as a fraction of its normal size, below which the text is broken into lines.
const SMALLEST: f64 = 0.8;
const MOST_LINES: usize = 4;
/// Largest number of points of a curve with a marker at every point. On longer curves, only points that remain after thinning have markers.
const MOST_MARKS: usize = 2000;
/// Distance between ticks on the horizontal and on the vertical axis [pixels].
const TICK_EVERY: (f64, f64) = (85.0, 50.0);

/// Space between the border of a panel and its plot [pixels].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Margins {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Margins {
    pub fn widest(self, other: Self) -> Self {
        Self {
            left: self.left.max(other.left),
            top: self.top.max(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// Box inside the margins of `area`; never empty.
    pub fn inside(&self, area: &Area) -> Area {
        let (left, top) = (area.left + self.left, area.top + self.top);
        let (right, bottom) = (area.right - self.right, area.bottom - self.bottom);
        Area { left, top, right: right.max(left + 10.0), bottom: bottom.max(top + 10.0) }
    }
}

#[derive(Clone, Debug, Default)]
pub struct Frame {
    pub title: String,
    pub captions: Vec<String>,
    pub x_label: String,
    pub y_label: String,
    pub x: PlotAxis,
    pub y: PlotAxis,
    pub legend: Vec<LegendEntry>,
}

impl Frame {
    pub fn margins(&self, width: f64, height: f64) -> Margins {
        let (x_ticks, _) = self.x.ticks(count(width - 120.0, TICK_EVERY.0));
        let (y_ticks, _) = self.y.ticks(count(height - 110.0, TICK_EVERY.1));
        let numbers =
            y_ticks.iter().map(|tick| fonts::width(&tick.label, NUMBER)).fold(0.0, f64::max);
        let last = x_ticks.last().map_or(0.0, |tick| fonts::width(&tick.label, NUMBER));
        let y_label =
            FittedText::of(&self.y_ticks(height).after(&self.y_label), LABEL, height - 90.0);
        let left = EDGE + numbers + 10.0 + y_label.height(10.0);
        let right = (EDGE + last / 2.0).max(24.0);
        let x_label =
            FittedText::of(&self.x_ticks(width).after(&self.x_label), LABEL, width - left - right);
        let title = FittedText::of(&self.title, TITLE, width - left - EDGE).height(10.0);
        let title = title + self.caption_lines(width - left - EDGE).len() as f64 * (CAPTION + 5.0);
        Margins {
            left,
            top: EDGE + title + legend::height(&self.legend, width - left - right) + 6.0,
            right,
            bottom: EDGE + NUMBER + 8.0 + x_label.height(8.0),
        }
    }

    pub fn margins_beside(&self, bar: f64, width: f64, height: f64) -> Margins {
        let alone = self.margins(width, height).right;
        let right = alone.max(bar);
        Margins { right, ..self.margins(width - (right - alone), height) }
    }

    pub fn draw_no_data(&self, canvas: &mut Canvas, plot: &Area) {
        let middle = ((plot.left + plot.right) / 2.0, (plot.top + plot.bottom) / 2.0);
        canvas.text("no data", middle, 14.0, Align::Middle, GREY);
    }

    /// Draws the frame without the data. `plot` is `area` without its margins.
    pub fn draw(&self, canvas: &mut Canvas, area: &Area, plot: &Area) {
        let room = area.right - plot.left - EDGE;
        let title = FittedText::of(&self.title, TITLE, room);
        let mut baseline = area.top + EDGE + TITLE * 0.8;
        for (index, line) in title.lines.iter().enumerate() {
            baseline += if index == 0 { 0.0 } else { title.apart() };
            canvas.text(line, (plot.left, baseline), title.size, Align::Start, INK);
        }
        for caption in self.caption_lines(room) {
            baseline += CAPTION + 5.0;
            canvas.text(&caption, (plot.left, baseline + 2.0), CAPTION, Align::Start, GREY);
        }
        let legend_top = plot.top - 6.0 - legend::height(&self.legend, plot.width());
        legend::draw(canvas, &self.legend, &Area { top: legend_top, bottom: plot.top, ..*plot });
        self.draw_x_axis(canvas, area, plot);
        self.draw_y_axis(canvas, area, plot);
        let corner = [(plot.left, plot.top), (plot.left, plot.bottom), (plot.right, plot.bottom)];
        canvas.line(corner.map(pixel_aligned), 1.0, AXIS);
    }

    /// Position of a data point on the canvas [pixels].
    pub fn place(&self, plot: &Area, (x, y): Point) -> Point {
        (plot.left + self.x.place(x) * plot.width(), plot.bottom - self.y.place(y) * plot.height())
    }

    /// Pieces of a data curve inside the plot [pixels].
    pub fn curve(&self, plot: &Area, points: &[Point]) -> Vec<Vec<Point>> {
        // The window is slightly larger than the plot, so that rounding does not clip a line along a side of the plot.
        let window = Area {
            left: plot.left - 0.01,
            top: plot.top - 0.01,
            right: plot.right + 0.01,
            bottom: plot.bottom + 0.01,
        };
        // A curve has a gap at an infinite value. Without this check, `place` would move the value to the end of the axis.
        let place = |&(x, y): &Point| {
            let is_somewhere = x.is_finite() && y.is_finite();
            if is_somewhere { self.place(plot, (x, y)) } else { (f64::NAN, f64::NAN) }
        };
        curve::pieces(points.iter().map(place), &window)
    }

    /// Positions of the markers of a curve: its data points, but not the points where the curve is clipped.
    pub fn marks(&self, plot: &Area, points: &[Point]) -> Vec<Point> {
        if points.len() > MOST_MARKS {
            return self.curve(plot, points).concat();
        }
        points.iter().flat_map(|&point| self.curve(plot, &[point])).flatten().collect()
    }

    fn draw_x_axis(&self, canvas: &mut Canvas, area: &Area, plot: &Area) {
        let (ticks, factor) = self.x.ticks(count(plot.width(), TICK_EVERY.0));
        let baseline = plot.bottom + 8.0 + NUMBER * 0.8;
        let label_width = |tick: &Tick| fonts::width(&tick.label, NUMBER);
        let widest = ticks.iter().map(label_width).fold(0.0, f64::max);
        let spacing = plot.width() / ticks.len().max(2) as f64;
        let keep = ((widest + 12.0) / spacing).ceil().clamp(1.0, 100.0) as usize;
        for (index, tick) in ticks.iter().enumerate() {
            let x = plot.left + tick.place * plot.width();
            canvas.line([(x, plot.top), (x, plot.bottom)].map(pixel_aligned), 1.0, GRID);
            if index % keep == 0 {
                canvas.text(&tick.label, (x, baseline), NUMBER, Align::Middle, INK);
            }
        }
        let label = FittedText::of(&factor.after(&self.x_label), LABEL, plot.width());
        let middle = (plot.left + plot.right) / 2.0;
        for (index, line) in label.lines.iter().enumerate() {
            let y = baseline + LABEL + 11.0 + index as f64 * label.apart();
            canvas.text(line, (middle, area.bottom.min(y)), label.size, Align::Middle, GREY);
        }
    }

    fn draw_y_axis(&self, canvas: &mut Canvas, area: &Area, plot: &Area) {
        let (ticks, factor) = self.y.ticks(count(plot.height(), TICK_EVERY.1));
        for tick in &ticks {
            let y = plot.bottom - tick.place * plot.height();
            canvas.line([(plot.left, y), (plot.right, y)].map(pixel_aligned), 1.0, GRID);
            canvas.text(&tick.label, (plot.left - 8.0, y + NUMBER * 0.36), NUMBER, Align::End, INK);
        }
        let label = FittedText::of(&factor.after(&self.y_label), LABEL, plot.height() + 20.0);
        let middle = (plot.top + plot.bottom) / 2.0;
        for (index, line) in label.lines.iter().enumerate() {
            let x = area.left + EDGE + LABEL * 0.8 + index as f64 * label.apart();
            canvas.text_upwards(line, (x, middle), label.size, Align::Middle, GREY);
        }
    }

    fn x_ticks(&self, width: f64) -> Factor {
        self.x.ticks(count(width - 120.0, TICK_EVERY.0)).1
    }

    fn y_ticks(&self, height: f64) -> Factor {
        self.y.ticks(count(height - 110.0, TICK_EVERY.1)).1
    }

    fn caption_lines(&self, room: f64) -> Vec<String> {
        let lines = |caption: &String| fonts::lines(caption, CAPTION, room);
        self.captions.iter().flat_map(lines).take(MOST_LINES).collect()
    }
}

struct FittedText {
    lines: Vec<String>,
    /// Size of the letters of a reduced title or label [pixels].
    size: f64,
    full: f64,
}

impl FittedText {
    fn of(text: &str, size: f64, room: f64) -> Self {
        let full = size;
        let smallest = fonts::shrunk(text, full, room);
        let size = smallest.max(SMALLEST * full);
        let lines = fonts::lines(text, size, room);
        let (mut lines, size) = match lines.len() > MOST_LINES {
            true => (fonts::lines(text, smallest, room), smallest),
            false => (lines, size),
        };
        if lines.len() > MOST_LINES {
            let rest = lines.split_off(MOST_LINES - 1).join(" ");
            lines.push(fonts::fit(&rest, size, room));
        }
        Self { lines, size, full }
    }

    fn apart(&self) -> f64 {
        1.25 * self.size
    }

    fn height(&self, paper: f64) -> f64 {
        match self.lines.len() {
            0 => 0.0,
            count => self.full + paper + (count - 1) as f64 * self.apart(),
        }
    }
}

fn count(length: f64, every: f64) -> usize {
    (length / every).clamp(2.0, 16.0) as usize
}

/// Moves a point to the centre of its pixel, so that thin vertical and horizontal lines are sharp.
fn pixel_aligned((x, y): Point) -> Point {
    (x.floor() + 0.5, y.floor() + 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_title_is_shrunk_before_it_is_cut() {
        let title = "drift of energy, momenta and gap of the flying spaghetti";
        let frame = Frame { title: title.into(), ..Frame::default() };
        let area = Area { left: 0.0, top: 0.0, right: 500.0, bottom: 300.0 };
        assert!(fonts::width(title, TITLE) > 440.0);
        let mut canvas = Canvas::default();
        frame.draw(&mut canvas, &area, &frame.margins(500.0, 300.0).inside(&area));
        let is_title = |shape: &super::super::canvas::Shape| matches!(shape, super::super::canvas::Shape::Text(text) if text.text == title);
        assert!(canvas.shapes().iter().any(is_title), "the whole title is drawn");
    }

    #[test]
    fn all_texts_of_a_frame_stay_inside_the_panel() {
        let frame = Frame {
            title: "A title that is far too long for its panel ".repeat(9),
            captions: vec!["a line below it ".repeat(30); 2],
            x_label: "t [s]".into(),
            y_label: "energy [J]".repeat(30),
            x: PlotAxis::between(0.0, 1e5),
            y: PlotAxis::between(-12345.678, 1.0),
            legend: Vec::new(),
        };
        let area = Area { left: 0.0, top: 0.0, right: 500.0, bottom: 300.0 };
        let mut canvas = Canvas::default();
        frame.draw(&mut canvas, &area, &frame.margins(500.0, 300.0).inside(&area));
        for shape in canvas.shapes() {
            let super::super::canvas::Shape::Text(text) = shape else { continue };
            let length = fonts::width(&text.text, text.size);
            let (x, y) = text.start;
            match text.direction {
                super::super::canvas::TextDirection::Level => {
                    assert!(x >= 0.0 && x + length <= 500.0, "{text:?}")
                }
                super::super::canvas::TextDirection::Upwards => {
                    assert!(y <= 300.0 && y - length >= 0.0, "{text:?}")
                }
            }
        }
    }
}
