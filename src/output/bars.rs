//! Bar charts. Horizontal bars start at zero, with a name before and a number after each bar.

use super::{
    canvas::{Align, Area, Canvas},
    colour::{AXIS, GREY, INK, WHITE, hue, tint},
    fonts,
    frame::Margins,
    page::Panel,
};

const TITLE: f64 = 16.0;
const TEXT: f64 = 12.5;
const EDGE: f64 = 14.0;
const ROW: (f64, f64) = (26.0, 16.0);
const NAME: f64 = 260.0;

#[derive(Clone, Debug, PartialEq)]
struct Bar {
    name: String,
    value: f64,
    text: String,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct BarChart {
    title: String,
    label: String,
    bars: Vec<Bar>,
    mark: Option<f64>,
}

impl BarChart {
    pub fn new(title: impl Into<String>, label: impl Into<String>) -> Self {
        Self { title: title.into(), label: label.into(), ..Self::default() }
    }

    pub fn bar(mut self, name: impl Into<String>, value: f64, text: impl Into<String>) -> Self {
        self.bars.push(Bar { name: name.into(), value, text: text.into() });
        self
    }

    pub fn mark(mut self, value: f64) -> Self {
        self.mark = Some(value);
        self
    }

    fn widest(&self, text: fn(&Bar) -> &str) -> f64 {
        self.bars.iter().map(|bar| fonts::width(text(bar), TEXT)).fold(0.0, f64::max).min(NAME)
    }
}

impl Panel for BarChart {
    fn size(&self) -> (f64, f64) {
        let Margins { top, bottom, .. } = self.margins(0.0, 0.0);
        (900.0, (top + bottom + ROW.0 * self.bars.len() as f64).max(100.0))
    }

    fn margins(&self, _width: f64, _height: f64) -> Margins {
        Margins {
            left: EDGE + self.widest(|bar| &bar.name) + 8.0,
            top: EDGE + TITLE + 14.0,
            right: EDGE + self.widest(|bar| &bar.text) + 8.0,
            bottom: EDGE + TEXT + 10.0,
        }
    }

    fn draw(&self, canvas: &mut Canvas, area: &Area, plot: &Area) {
        let title = fonts::fit(&self.title, TITLE, area.right - plot.left - EDGE);
        canvas.text(&title, (plot.left, area.top + EDGE + TITLE * 0.8), TITLE, Align::Start, INK);
        let values = self.bars.iter().map(|bar| bar.value).chain(self.mark);
        let longest = values.filter(|value| value.is_finite()).fold(0.0, f64::max);
        let place = |value: f64| plot.left + plot.width() * (value / longest).clamp(0.0, 1.0);
        let row = plot.height() / self.bars.len().max(1) as f64;
        let mut texts = Vec::new();
        for (index, bar) in self.bars.iter().enumerate() {
            let middle = plot.top + row * (index as f64 + 0.5);
            let baseline = middle + 0.36 * TEXT;
            let name = fonts::fit(&bar.name, TEXT, NAME);
            canvas.text(&name, (plot.left - 8.0, baseline), TEXT, Align::End, INK);
            let right =
                if bar.value.is_finite() && longest > 0.0 { place(bar.value) } else { plot.left };
            let (top, bottom) = (middle - ROW.1 / 2.0, middle + ROW.1 / 2.0);
            canvas.fill(Area { left: plot.left, top, right, bottom }, tint(hue(0), 0.7));
            texts.push((fonts::fit(&bar.text, TEXT, NAME), (right + 6.0, baseline)));
        }
        if let Some(mark) = self.mark.filter(|mark| mark.is_finite() && longest > 0.0) {
            let x = place(mark);
            canvas.line([(x, plot.top), (x, plot.bottom)], 1.0, GREY);
        }
        for (text, (left, baseline)) in texts {
            // White boxes behind the texts interrupt the reference line where it would cross a text.
            let (top, bottom) = (baseline - TEXT, baseline + 0.3 * TEXT);
            let right = left + fonts::width(&text, TEXT);
            canvas.fill(Area { left: left - 2.0, top, right: right + 2.0, bottom }, WHITE);
            canvas.text(&text, (left, baseline), TEXT, Align::Start, INK);
        }
        canvas.line([(plot.left, plot.top), (plot.left, plot.bottom)], 1.0, AXIS);
        let below = (plot.left, plot.bottom + 8.0 + TEXT * 0.8);
        canvas.text(&self.label, below, TEXT, Align::Start, GREY);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::canvas::Shape;

    #[test]
    fn bar_chart_shows_names_and_numbers() {
        let chart = BarChart::new("Cost of a step", "µs")
            .bar("the scene alone", 30.0, "30 µs")
            .bar("slider", 60.0, "60 µs")
            .bar("lost", f64::NAN, "failed")
            .mark(30.0);
        let figure = chart.figure().unwrap();
        let svg = figure.to_svg().unwrap();
        for text in ["Cost of a step", "slider", "60 µs", "failed"] {
            assert!(svg.contains(text), "{text}");
        }
        figure.to_png().unwrap();
        BarChart::new("", "").figure().unwrap().to_png().unwrap();
    }

    #[test]
    fn reference_line_is_drawn_behind_bar_texts() {
        let chart = BarChart::new("Cost", "µs").bar("short", 20.0, "20 µs").bar("long", 60.0, "60");
        let chart = chart.mark(21.0);
        let mut canvas = Canvas::default();
        let (width, height) = chart.size();
        let area = Area { left: 0.0, top: 0.0, right: width, bottom: height };
        chart.draw(&mut canvas, &area, &chart.margins(width, height).inside(&area));
        let shapes = canvas.shapes();
        let is_mark = |of: &Shape| matches!(of, Shape::Line { colour, .. } if *colour == GREY);
        let mark = shapes.iter().position(is_mark).unwrap();
        let is_text = |of: &Shape| matches!(of, Shape::Text(text) if text.text == "20 µs");
        let text = shapes.iter().position(is_text).unwrap();
        assert!(mark < text && matches!(shapes[text - 1], Shape::Fill { .. }), "{shapes:?}");
    }
}
