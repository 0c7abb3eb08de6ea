//! Line charts as text for a terminal.

use super::character_grid::{CharacterGrid, TerminalColour};
use super::dots::{ACROSS, CurveStyle, DOWN, Dots};
use super::{Colours, Glyphs, TerminalStyle};
use crate::output::axis::{Factor, PlotAxis, Tick};
use crate::output::chart::LineChart;
use crate::output::frame::Frame;
use crate::output::width::columns;

/// Distance between ticks on the horizontal axis [characters] and on the vertical axis [lines].
const TICK_EVERY: (usize, usize) = (9, 4);
/// Size of the smallest plot with axes and a legend [characters].
const LEAST: (usize, usize) = (8, 3);
const MOST_ROWS: usize = 3;
const BETWEEN: usize = 3;
/// Distance between the letters that identify a curve on a terminal without colours [characters].
const LETTER_SPACING: usize = 16;

impl LineChart {
    /// Text of the chart for a terminal, at most as wide and as high as `style` allows.
    ///
    /// Without colours, several curves are distinguished by letters. Braille curves carry letters at intervals.
    /// ASCII curves are drawn with letters instead of dots.
    pub fn text(&self, style: &TerminalStyle) -> String {
        let layout = Layout::new(self, style);
        let mut sheet = CharacterGrid::new(style);
        layout.draw_heading(&mut sheet);
        if layout.has_axes {
            layout.draw_y_axis(&mut sheet);
            layout.draw_x_axis(&mut sheet);
        }
        layout.draw_series(&mut sheet, self);
        sheet.render()
    }

    fn has_letters(&self, style: &TerminalStyle) -> bool {
        self.series.len() > 1 && style.colours == Colours::None
    }
}

fn letter(index: usize) -> char {
    char::from(b'a' + (index % 26) as u8)
}

struct Layout {
    style: TerminalStyle,
    frame: Frame,
    heading: String,
    legend: Vec<Vec<(usize, usize, String)>>,
    has_letters: bool,
    has_axes: bool,
    y_ticks: Vec<Tick>,
    x_label: String,
    gutter: usize,
    top: usize,
    columns: usize,
    rows: usize,
}

impl Layout {
    fn new(chart: &LineChart, style: &TerminalStyle) -> Self {
        let (frame, glyphs) = (chart.frame(), style.glyphs);
        let has_letters = chart.has_letters(style);
        let (y_ticks, factor) = frame.y.ticks((style.height / TICK_EVERY.1).clamp(2, 8));
        let gutter = y_ticks.iter().map(|tick| columns(&glyphs.typeset(&tick.label))).max();
        let gutter = gutter.unwrap_or(0) + 1;
        let heading = heading(&frame, &factor, style);
        let legend = if frame.legend.is_empty() { vec![] } else { legend(chart, style) };
        let (_, x_factor) = frame.x.ticks(6);
        let x_label = glyphs.fit(&x_factor.after(&frame.x_label), style.width / 4);
        let beside = gutter + 1 + if x_label.is_empty() { 0 } else { columns(&x_label) + 1 };
        let top = usize::from(!heading.is_empty()) + legend.len();
        let (columns, rows) =
            (style.width.saturating_sub(beside), style.height.saturating_sub(top + 2));
        let has_axes = columns >= LEAST.0 && rows >= LEAST.1;
        let layout = Self {
            style: *style,
            frame,
            heading,
            legend,
            has_letters,
            has_axes,
            y_ticks,
            x_label,
            gutter,
            top,
            columns,
            rows,
        };
        if has_axes { layout } else { layout.bare() }
    }

    fn bare(self) -> Self {
        let (columns, rows) = (self.style.width, self.style.height);
        Self { heading: String::new(), legend: vec![], top: 0, columns, rows, ..self }
    }

    fn draw_heading(&self, sheet: &mut CharacterGrid) {
        sheet.write(0, 0, &self.heading, TerminalColour::Plain);
        let first = usize::from(!self.heading.is_empty());
        for (row, names) in self.legend.iter().enumerate() {
            for (column, series, name) in names {
                let ink = if self.has_letters {
                    TerminalColour::Plain
                } else {
                    TerminalColour::Series(*series)
                };
                sheet.write(*column, first + row, name, ink);
            }
        }
    }

    fn draw_y_axis(&self, sheet: &mut CharacterGrid) {
        let glyphs = self.style.glyphs;
        let (line, mark) = glyphs.choose(('│', '┤'), ('|', '+'));
        for row in 0..self.rows {
            sheet.put(self.gutter, self.top + row, line, TerminalColour::Plain);
        }
        let mut last = usize::MAX;
        for tick in &self.y_ticks {
            let row = ((1.0 - tick.place) * (DOWN * self.rows - 1) as f64).round() as usize / DOWN;
            if row != last {
                let label = glyphs.typeset(&tick.label);
                let start = self.gutter.saturating_sub(1 + columns(&label));
                sheet.write(start, self.top + row, &label, TerminalColour::Plain);
                sheet.put(self.gutter, self.top + row, mark, TerminalColour::Plain);
            }
            last = row;
        }
    }

    fn draw_x_axis(&self, sheet: &mut CharacterGrid) {
        let glyphs = self.style.glyphs;
        let (corner, line, mark) = glyphs.choose(('└', '─', '┬'), ('+', '-', '+'));
        let row = self.top + self.rows;
        sheet.put(self.gutter, row, corner, TerminalColour::Plain);
        (0..self.columns)
            .for_each(|at| sheet.put(self.gutter + 1 + at, row, line, TerminalColour::Plain));
        sheet.write(self.gutter + self.columns + 2, row, &self.x_label, TerminalColour::Plain);
        let (ticks, _) = self.frame.x.ticks((self.columns / TICK_EVERY.0).clamp(2, 12));
        let mut free = 0;
        for tick in &ticks {
            let dot = (tick.place * (ACROSS * self.columns - 1) as f64).round() as usize;
            let at = self.gutter + 1 + dot / ACROSS;
            sheet.put(at, row, mark, TerminalColour::Plain);
            let label = glyphs.typeset(&tick.label);
            let room = self.style.width.saturating_sub(columns(&label));
            let start = at.saturating_sub(columns(&label) / 2).min(room);
            if start >= free {
                sheet.write(start, row + 1, &label, TerminalColour::Plain);
                free = start + columns(&label) + 1;
            }
        }
    }

    fn draw_series(&self, sheet: &mut CharacterGrid, chart: &LineChart) {
        let glyphs = self.style.glyphs;
        let (left, top) = if self.has_axes { (self.gutter + 1, self.top) } else { (0, self.top) };
        let rasters: Vec<Dots> = (0..chart.series.len())
            .map(|index| self.raster(&self.frame.x, &self.frame.y, chart, [index]))
            .collect();
        if rasters.iter().all(|dots| dots.drawn().next().is_none()) {
            let message = glyphs.fit("no data", self.columns);
            let start = left + (self.columns - columns(&message)) / 2;
            sheet.write(start, top + self.rows / 2, &message, TerminalColour::Plain);
        }
        let all = self.raster(&self.frame.x, &self.frame.y, chart, 0..chart.series.len());
        for (column, row, mask, ink) in all.drawn() {
            sheet.put(left + column, top + row, glyphs.of_dots(mask), ink);
        }
        if self.has_letters {
            for (index, raster) in rasters.iter().enumerate() {
                for (column, row) in self.lettered(index, rasters.len(), raster) {
                    sheet.put(left + column, top + row, letter(index), TerminalColour::Plain);
                }
            }
        }
    }

    fn raster(
        &self,
        x: &PlotAxis,
        y: &PlotAxis,
        chart: &LineChart,
        series: impl IntoIterator<Item = usize>,
    ) -> Dots {
        let mut dots = Dots::new(self.columns, self.rows);
        let (right, bottom) = dots.last();
        for index in series {
            // A curve has a gap at an infinite value. Without this check, `place` would move the value to the end of the axis.
            let seen = |&(a, b): &(f64, f64)| match a.is_finite() && b.is_finite() {
                true => (x.place(a) * right, (1.0 - y.place(b)) * bottom),
                false => (f64::NAN, f64::NAN),
            };
            let points = chart.series[index].points.iter().map(seen);
            dots.curve(points, CurveStyle::Solid, TerminalColour::Series(index));
        }
        dots
    }

    fn lettered(&self, index: usize, count: usize, raster: &Dots) -> Vec<(usize, usize)> {
        let mut places: Vec<(usize, usize)> =
            raster.drawn().map(|(column, row, ..)| (column, row)).collect();
        if self.style.glyphs == Glyphs::Ascii {
            return places;
        }
        places.sort_unstable();
        places.dedup_by_key(|(column, _)| *column);
        let first = places.first().copied();
        let offset = LETTER_SPACING / 4 + index * LETTER_SPACING / count;
        places.retain(|(column, _)| column % LETTER_SPACING == offset % LETTER_SPACING);
        if places.is_empty() { first.into_iter().collect() } else { places }
    }
}

fn heading(frame: &Frame, factor: &Factor, style: &TerminalStyle) -> String {
    let parts = [frame.title.clone(), factor.after(&frame.y_label)];
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.trim().is_empty()).collect();
    style.glyphs.fit(&parts.join("  "), style.width)
}

fn legend(chart: &LineChart, style: &TerminalStyle) -> Vec<Vec<(usize, usize, String)>> {
    let glyphs = style.glyphs;
    let sample = |index| match chart.has_letters(style) {
        true => letter(index).to_string(),
        false => glyphs.choose("──", "--").to_owned(),
    };
    let mut rows = vec![vec![]];
    let mut column = 0;
    for (index, series) in chart.series.iter().enumerate().filter(|(_, one)| !one.name.is_empty()) {
        let entry = glyphs.fit(&format!("{} {}", sample(index), series.name), style.width);
        if column + columns(&entry) > style.width {
            if rows.len() == MOST_ROWS {
                let end = style.width.saturating_sub(3);
                let more = (column.min(end), index, glyphs.choose("…", "...").to_owned());
                rows.iter_mut().next_back().into_iter().for_each(|row| row.push(more.clone()));
                break;
            }
            rows.push(vec![]);
            column = 0;
        }
        let next = column + columns(&entry) + BETWEEN;
        rows.iter_mut()
            .next_back()
            .into_iter()
            .for_each(|row| row.push((column, index, entry.clone())));
        column = next;
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{AxisScale, Series};
    use proptest::prelude::*;

    const PLAIN: TerminalStyle =
        TerminalStyle { glyphs: Glyphs::Braille, colours: Colours::None, width: 40, height: 10 };

    fn chart() -> LineChart {
        let wave = |phase: f64| {
            (0..=60).map(|i| (0.1 * f64::from(i), (0.1 * f64::from(i) + phase).sin())).collect()
        };
        LineChart::new("waves")
            .x_label("t")
            .series(Series::new("sine", wave(0.0)))
            .series(Series::new("cosine", wave(1.57)))
    }

    #[test]
    fn ascii_chart_equals_the_reference() {
        let style = TerminalStyle { glyphs: Glyphs::Ascii, ..PLAIN };
        let expected = [
            "waves",
            "a sine   b cosine",
            " 1 +bbbb aaaaaaaa                   bb",
            "   |  aabbb      aaa             bbb",
            "   |aaa   bbb      aaa        bbb",
            " 0 +a        bb       aa    bbb      a",
            "   |           bbb      abbbb     aaa",
            "-1 +              bbbbbbbb aaaaaaa",
            "   ++----------+----------+----------+ t",
            "    0          2          4          6",
        ];
        assert_eq!(chart().text(&style).lines().collect::<Vec<_>>(), expected);
    }

    #[test]
    fn braille_chart_equals_the_reference() {
        let expected = [
            "waves",
            "a sine   b cosine",
            " 1 ┤⠒⠢⠤⢄ ⣀⠤⠤⠒⠒⠤⢄⣀                   ⡠⠤",
            "   │  ⢀⡠a⠢⡀      ⠑⠢⡀             ⡠⠊⠉",
            "   │⢠⠊⠁   ⠈⠒⢄      ⠈⠢⢄        ⢀⡠b",
            " 0 ┤⠁        ⠑⢄       ⠑⢄    ⢀⠔⠁      ⡠",
            "   │           ⠑b⢄      a⢄⣠⠒⠁     ⣀⠤⠊",
            "−1 ┤              ⠉⠒⠢⠤⠤⠒⠊⠁ ⠉⠒⠤⠤⠤⠒⠊",
            "   └┬──────────┬──────────┬──────────┬ t",
            "    0          2          4          6",
        ];
        assert_eq!(chart().text(&PLAIN).lines().collect::<Vec<_>>(), expected);
    }

    #[test]
    fn colours_replace_curve_letters() {
        let text = chart().text(&TerminalStyle { colours: Colours::Ansi, ..PLAIN });
        assert!(text.contains("\x1b[36m── sine\x1b[0m"), "{text}");
        assert!(text.contains("\x1b[33m── cosine\x1b[0m"), "{text}");
        assert!(!text.contains("a sine"));
    }

    #[test]
    fn logarithmic_terminal_axis_has_powers_of_ten() {
        let points = (1..50).map(|i| (f64::from(i), 10f64.powi(-i / 5))).collect();
        let chart = LineChart::new("drift").y_scale(AxisScale::Logarithmic);
        let chart = chart.series(Series::new("energy", points));
        assert!(chart.text(&PLAIN).contains("10⁻⁵ ┤"), "{}", chart.text(&PLAIN));
        let ascii = chart.text(&TerminalStyle { glyphs: Glyphs::Ascii, ..PLAIN });
        assert!(ascii.is_ascii() && ascii.contains("1e-5 +"), "{ascii}");
    }

    #[test]
    fn empty_terminal_chart_shows_no_data() {
        let nothing = LineChart::new("none").series(Series::new("a", vec![(f64::NAN, 1.0)]));
        assert!(nothing.text(&PLAIN).contains("no data"));
        assert!(LineChart::new("").text(&PLAIN).contains("no data"));
    }

    pub fn seen(line: &str) -> usize {
        let mut inside = false;
        let visible = line.chars().filter(|&letter| {
            let counts = !inside && letter != '\x1b';
            inside = letter == '\x1b' || (inside && letter != 'm');
            counts
        });
        visible.count()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn terminal_chart_of_any_data_fits_any_size(
            series in prop::collection::vec(prop::collection::vec(
                (value(), value()), 0..6), 0..5),
            name in ".{0,30}",
            width in 0usize..90, height in 0usize..30,
            choices in 0usize..8,
        ) {
            let style = TerminalStyle {
                glyphs: if choices & 1 == 0 { Glyphs::Braille } else { Glyphs::Ascii },
                colours: if choices & 2 == 0 { Colours::None } else { Colours::Ansi },
                width, height,
            };
            let scale = if choices & 4 == 0 { AxisScale::Linear } else { AxisScale::Logarithmic };
            let empty = LineChart::new(name.clone()).y_scale(scale).x_label("t").y_label(name.clone());
            let chart = series.into_iter().fold(empty, |chart, points| chart.series(Series::new(name.clone(), points)));
            let text = chart.text(&style);
            prop_assert!(text.lines().count() <= height);
            for line in text.lines() {
                prop_assert!(seen(line) <= width, "{} of {width}: {line}", seen(line));
            }
            prop_assert!(choices & 1 == 0 || text.is_ascii(), "{text}");
            prop_assert_eq!(text, chart.text(&style));
        }
    }

    fn value() -> impl Strategy<Value = f64> {
        prop_oneof![
            Just(0.0),
            Just(f64::NAN),
            Just(f64::INFINITY),
            Just(1e308),
            Just(-1e308),
            Just(1e-300),
            proptest::num::f64::ANY,
            -10.0..10.0
        ]
    }
}
