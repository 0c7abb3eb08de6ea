//! Heat maps: cells in rows and columns, coloured by a number on a logarithmic scale. Cells without a number are hatched.

use super::{
    axis::power_of_ten,
    canvas::{Align, Area, Canvas},
    colour::{Colour, GREY, INK, WHITE, mix, ramp},
    fonts,
    frame::Margins,
    hatching::{hatch, outline},
    page::Panel,
};
use crate::elementary::log10;

const TITLE: f64 = 16.0;
const LABEL: f64 = 13.0;
const TEXT: f64 = 12.0;
const EDGE: f64 = 14.0;
const KEY: f64 = 26.0;
const BAR: (f64, f64) = (110.0, 13.0);
const SAMPLE: f64 = 24.0;
const GAP: (f64, f64) = (7.0, 10.0);
const CELL: (f64, f64) = (104.0, 52.0);
const CELL_IN_COLUMNS: (f64, f64) = (76.0, 50.0);
const WIDEST_CELL: f64 = 200.0;
/// White space around a text in a cell, and around the name of a column [pixels].
const AROUND_TEXT: f64 = 8.0;
const AROUND_NAME: f64 = 5.0;
const LINE: f64 = 14.0;

#[derive(Clone, Debug, PartialEq)]
pub struct HeatCell {
    /// Number that determines the colour; `None` for a hatched cell.
    pub value: Option<f64>,
    pub text: String,
}

#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    title: String,
    pub(super) columns: (String, Vec<String>),
    pub(super) rows: (String, Vec<String>),
    pub(super) scale: (String, i32, i32),
    pub(super) hatched: String,
    pub(super) cells: Vec<Vec<HeatCell>>,
}

impl HeatMap {
    /// Creates a heat map without cells. The colour scale from pale to dark goes from the first to the second power of ten.
    pub fn new(title: impl Into<String>, shows: impl Into<String>, powers: (i32, i32)) -> Self {
        Self {
            title: title.into(),
            columns: (String::new(), Vec::new()),
            rows: (String::new(), Vec::new()),
            scale: (shows.into(), powers.0, powers.1.max(powers.0 + 1)),
            hatched: "no value".into(),
            cells: Vec::new(),
        }
    }

    pub fn columns(mut self, label: impl Into<String>, names: Vec<String>) -> Self {
        self.columns = (label.into(), names);
        self
    }

    pub fn rows(mut self, label: impl Into<String>) -> Self {
        self.rows.0 = label.into();
        self
    }

    pub fn hatched(mut self, meaning: impl Into<String>) -> Self {
        self.hatched = meaning.into();
        self
    }

    /// Adds a row at the bottom. Missing cells are white, and surplus cells are not shown.
    pub fn row(mut self, name: impl Into<String>, cells: Vec<HeatCell>) -> Self {
        self.rows.1.push(name.into());
        self.cells.push(cells);
        self
    }

    pub fn title(&self) -> &str {
        &self.title
    }

    pub(super) fn part(&self, value: f64) -> Option<f64> {
        let (low, high) = (f64::from(self.scale.1), f64::from(self.scale.2));
        let place = (log10(value.max(0.0)) - low) / (high - low);
        (!value.is_nan()).then(|| place.clamp(0.0, 1.0))
    }

    pub(super) fn ends(&self) -> (String, String) {
        let power = |power: i32| power_of_ten(f64::from(power));
        (format!("≤ {}", power(self.scale.1)), format!("≥ {}", power(self.scale.2)))
    }

    fn with_cells(&self, cell: (f64, f64)) -> (f64, f64) {
        let Margins { left, top, right, bottom } = self.margins(0.0, 0.0);
        let lines = self.cells.iter().flatten().flat_map(|cell| cell.text.lines());
        let texts = lines.map(|line| fonts::width(line, TEXT) + AROUND_TEXT);
        let names = self.columns.1.iter().map(|name| fonts::width(name, TEXT) + AROUND_NAME);
        let widest = texts.chain(names).fold(cell.0, f64::max).min(WIDEST_CELL);
        let (columns, rows) = (self.columns.1.len().max(1), self.rows.1.len().max(1));
        let width = (widest * columns as f64).max(self.key_width());
        (left + right + width, top + bottom + cell.1 * rows as f64)
    }

    fn key_width(&self) -> f64 {
        let (low, high) = self.ends();
        let written = |text: &str| fonts::width(text, TEXT) + GAP.0;
        let colours = written(&self.scale.0) + written(&low) + BAR.0 + GAP.0 + written(&high);
        let hatching = GAP.1 + SAMPLE + GAP.0 + written(&self.hatched);
        colours + if self.has_hatching() { hatching } else { 0.0 }
    }

    fn has_hatching(&self) -> bool {
        self.cells.iter().flatten().any(|cell| cell.value.is_none())
    }

    fn colour(&self, part: f64) -> Colour {
        // The palest colours are mixed with white, so that texts in the cells are readable.
        if part < 0.06 { mix(WHITE, ramp(0.0), 0.35) } else { ramp(part) }
    }

    fn draw_key(&self, canvas: &mut Canvas, plot: &Area, room: f64) {
        let middle = plot.top - KEY * 0.5 - 4.0;
        let baseline = middle + 0.36 * TEXT;
        let (low, high) = self.ends();
        let mut x = plot.left;
        let write = |canvas: &mut Canvas, text: &str, x: &mut f64, room: f64| {
            let text = fonts::fit(text, TEXT, room);
            canvas.text(&text, (*x, baseline), TEXT, Align::Start, INK);
            *x += fonts::width(&text, TEXT) + GAP.0;
        };
        let shows = fonts::width(&self.scale.0, TEXT);
        // The additional pixel keeps rounding from cutting off a letter.
        write(canvas, &self.scale.0, &mut x, room - (self.key_width() - shows) + 1.0);
        write(canvas, &low, &mut x, f64::INFINITY);
        let steps = 22;
        let width = BAR.0 / f64::from(steps);
        for step in 0..steps {
            let left = x + f64::from(step) * width;
            let bar = Area {
                left,
                top: middle - BAR.1 / 2.0,
                right: left + width + 0.3,
                bottom: middle + BAR.1 / 2.0,
            };
            canvas.fill(bar, self.colour(f64::from(step) / f64::from(steps - 1)));
        }
        x += BAR.0 + GAP.0;
        write(canvas, &high, &mut x, f64::INFINITY);
        if !self.has_hatching() {
            return;
        }
        x += GAP.1;
        let sample = Area {
            left: x,
            top: middle - BAR.1 / 2.0,
            right: x + SAMPLE,
            bottom: middle + BAR.1 / 2.0,
        };
        hatch(canvas, &sample);
        outline(canvas, &sample);
        x += SAMPLE + GAP.0;
        let rest = plot.left + room - x + 1.0;
        write(canvas, &self.hatched, &mut x, rest);
    }

    fn draw_cell(&self, canvas: &mut Canvas, cell: &HeatCell, area: &Area) {
        let part = cell.value.and_then(|value| self.part(value));
        let lines: Vec<String> = cell
            .text
            .lines()
            .map(|line| fonts::fit(line, TEXT, area.width() - AROUND_TEXT + 1.0))
            .collect();
        let middle = ((area.left + area.right) / 2.0, (area.top + area.bottom) / 2.0);
        let height = LINE * lines.len() as f64;
        let ink = match part {
            Some(part) => {
                canvas.fill(*area, self.colour(part));
                if part > 0.36 { WHITE } else { INK }
            }
            None => {
                hatch(canvas, area);
                let widest = lines.iter().map(|line| fonts::width(line, TEXT)).fold(0.0, f64::max);
                let paper = Area {
                    left: middle.0 - widest / 2.0 - 3.0,
                    top: middle.1 - height / 2.0 - 1.0,
                    right: middle.0 + widest / 2.0 + 3.0,
                    bottom: middle.1 + height / 2.0 + 1.0,
                };
                canvas.fill(paper, WHITE);
                INK
            }
        };
        for (index, line) in lines.iter().enumerate() {
            let baseline = middle.1 - height / 2.0 + LINE * (index as f64 + 0.5) + 0.36 * TEXT;
            canvas.text(line, (middle.0, baseline), TEXT, Align::Middle, ink);
        }
    }
}

impl Panel for HeatMap {
    fn size(&self) -> (f64, f64) {
        self.with_cells(CELL)
    }

    fn size_among(&self, _rows: usize, columns: usize) -> (f64, f64) {
        self.with_cells(if columns > 1 { CELL_IN_COLUMNS } else { CELL })
    }

    fn margins(&self, _width: f64, _height: f64) -> Margins {
        let widest =
            self.rows.1.iter().map(|name| fonts::width(name, TEXT)).fold(0.0, f64::max).min(220.0);
        let label = |text: &str| if text.is_empty() { 0.0 } else { LABEL + 10.0 };
        Margins {
            left: EDGE + label(&self.rows.0) + widest + 8.0,
            top: EDGE + TITLE + 12.0 + KEY + 4.0,
            right: EDGE,
            bottom: EDGE + TEXT + 8.0 + label(&self.columns.0),
        }
    }

    fn draw(&self, canvas: &mut Canvas, area: &Area, plot: &Area) {
        let title = fonts::fit(&self.title, TITLE, area.right - plot.left - EDGE);
        canvas.text(&title, (plot.left, area.top + EDGE + TITLE * 0.8), TITLE, Align::Start, INK);
        self.draw_key(canvas, plot, plot.width());
        let (rows, columns) = (self.rows.1.len().max(1), self.columns.1.len().max(1));
        let (width, height) = (plot.width() / columns as f64, plot.height() / rows as f64);
        let place = |column: usize, row: usize| Area {
            left: plot.left + width * column as f64,
            top: plot.top + height * row as f64,
            right: plot.left + width * (column + 1) as f64,
            bottom: plot.top + height * (row + 1) as f64,
        };
        for (row, cells) in self.cells.iter().enumerate() {
            for (column, cell) in cells.iter().take(columns).enumerate() {
                self.draw_cell(canvas, cell, &place(column, row));
            }
        }
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)))
        {
            outline(canvas, &place(column, row));
        }
        for (row, name) in self.rows.1.iter().enumerate() {
            let name = fonts::fit(name, TEXT, 220.0);
            let y = plot.top + height * (row as f64 + 0.5) + 0.36 * TEXT;
            canvas.text(&name, (plot.left - 8.0, y), TEXT, Align::End, INK);
        }
        let baseline = plot.bottom + 8.0 + TEXT * 0.8;
        for (column, name) in self.columns.1.iter().enumerate() {
            let name = fonts::fit(name, TEXT, width - AROUND_NAME + 1.0);
            let x = plot.left + width * (column as f64 + 0.5);
            canvas.text(&name, (x, baseline), TEXT, Align::Middle, INK);
        }
        let below = ((plot.left + plot.right) / 2.0, baseline + LABEL + 10.0);
        let label = fonts::fit(&self.columns.0, LABEL, plot.width());
        canvas.text(&label, below, LABEL, Align::Middle, GREY);
        let beside = (area.left + EDGE + LABEL * 0.8, (plot.top + plot.bottom) / 2.0);
        let label = fonts::fit(&self.rows.0, LABEL, plot.height() + 20.0);
        canvas.text_upwards(&label, beside, LABEL, Align::Middle, GREY);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::canvas::Shape;
    use crate::output::page::Page;

    fn cell(value: Option<f64>, text: &str) -> HeatCell {
        HeatCell { value, text: text.into() }
    }

    fn map() -> HeatMap {
        HeatMap::new("growth", "of energy", (-14, 0))
            .columns("dt", vec!["0.1".into(), "0.2".into()])
            .rows("EA")
            .row("1e4", vec![cell(Some(1e-16), "1e-16"), cell(Some(1e-7), "1e-7")])
            .row("1e8", vec![cell(Some(7.0), "7"), cell(None, "failed\nt = 2")])
    }

    #[test]
    fn values_are_placed_logarithmically_on_the_colour_scale() {
        let part = |value| map().part(value);
        assert_eq!((part(0.0), part(-1.0), part(1e-20)), (Some(0.0), Some(0.0), Some(0.0)));
        assert_eq!((part(1e-7), part(1.0), part(f64::INFINITY)), (Some(0.5), Some(1.0), Some(1.0)));
        assert_eq!(part(f64::NAN), None);
        assert_eq!(map().ends(), ("≤ 10⁻¹⁴".to_owned(), "≥ 10⁰".to_owned()));
    }

    #[test]
    fn heat_map_draws_all_cells_including_cells_without_a_value() {
        let figure = map().figure().unwrap();
        let svg = figure.to_svg().unwrap();
        for text in ["growth", "of energy", "1e-16", "failed", "t = 2", "no value", "EA", "dt"] {
            assert!(svg.contains(text), "{text}");
        }
        assert_eq!(figure.to_svg().unwrap(), map().figure().unwrap().to_svg().unwrap());
    }

    #[test]
    fn texts_on_a_page_of_heat_maps_are_not_cut() {
        let narrow = |text: &str| {
            HeatMap::new("trapezoidal", "Newton iterations a step", (-12, 0))
                .columns("EA L²/EI", vec!["1e4".into(), "a long name of a column".into()])
                .rows("basis")
                .hatched("did not finish")
                .row("linear", vec![cell(Some(1.0), text), cell(None, "failed")])
        };
        let page = Page::grid(2).panel(narrow("3e-1\n12 it.\n203841 halved")).panel(narrow("1"));
        let mut canvas = Canvas::default();
        let (width, height) = page.size();
        let area = Area { left: 0.0, top: 0.0, right: width, bottom: height };
        page.draw(&mut canvas, &area, &page.margins(width, height).inside(&area));
        let texts: Vec<&str> = canvas.shapes().iter().filter_map(text_of).collect();
        for whole in ["203841 halved", "did not finish", "≤ 10⁻¹²", "a long name of a column"]
        {
            assert!(texts.contains(&whole), "{whole}: {texts:?}");
        }
        assert!(!texts.iter().any(|text| text.contains('…')), "{texts:?}");
    }

    fn text_of(shape: &Shape) -> Option<&str> {
        match shape {
            Shape::Text(text) => Some(&text.text),
            _ => None,
        }
    }

    #[test]
    fn empty_and_incomplete_heat_maps_give_a_picture() {
        let ragged = map().row("a very long name ".repeat(9), vec![]);
        for map in [HeatMap::new("", "", (0, 0)), ragged] {
            map.figure().unwrap().to_png().unwrap();
        }
    }
}
