//! Colour bars: legends of continuous colour scales.

use super::{
    axis::{PlotAxis, extent},
    canvas::{Align, Area, Canvas},
    colour::{Colour, GREY, INK},
    fonts,
};

const TEXT: f64 = 12.0;
const LABEL: f64 = 13.0;
/// Distance of the bar from the plot [pixels].
const GAP: f64 = 22.0;
const BREADTH: f64 = 12.0;
const NUMBERS: f64 = 8.0;
const EDGE: f64 = 14.0;
const PIECES: usize = 100;

#[derive(Clone, Copy, Debug, PartialEq)]
enum BarWidth {
    Even,
    Wedge(f64, f64),
}

/// Colour scale with its bar, which is drawn only if there are at least two different numbers.
pub struct ColourBar {
    label: String,
    axis: Option<PlotAxis>,
    shade: fn(f64) -> Colour,
    form: BarWidth,
}

impl ColourBar {
    pub fn new(
        label: &str,
        numbers: impl IntoIterator<Item = f64>,
        shade: fn(f64) -> Colour,
    ) -> Self {
        let axis = extent(numbers)
            .filter(|(first, last)| last > first)
            .map(|(first, last)| PlotAxis::between(first, last));
        Self { label: label.into(), axis, shade, form: BarWidth::Even }
    }

    /// Makes the bar a wedge whose width increases from `least` to `most` [pixels].
    pub fn with_wedge(mut self, least: f64, most: f64) -> Self {
        self.form = BarWidth::Wedge(least, most);
        self
    }

    pub fn part(&self, number: f64) -> f64 {
        self.axis.map_or(1.0, |axis| axis.place(number))
    }

    /// Space that the bar needs to the right of the plot [pixels].
    pub fn width(&self) -> f64 {
        let Some(axis) = self.axis else { return 0.0 };
        let (ticks, factor) = axis.ticks(8);
        let numbers = ticks.iter().map(|tick| fonts::width(&tick.label, TEXT)).fold(0.0, f64::max);
        let label = fonts::width(&factor.after(&self.label), LABEL) - BREADTH - NUMBERS;
        GAP + BREADTH + NUMBERS + numbers.max(label) + EDGE
    }

    pub fn draw(&self, canvas: &mut Canvas, plot: &Area) {
        let Some(axis) = self.axis else { return };
        let (left, top) = (plot.right + GAP, plot.top + LABEL + 10.0);
        let height = plot.bottom - top;
        for piece in 0..PIECES {
            let (low, high) = (piece as f64 / PIECES as f64, (piece + 1) as f64 / PIECES as f64);
            // Each piece of the bar overlaps the piece below it, so that there are no visible seams.
            let (piece_top, bottom) = (plot.bottom - height * high, plot.bottom - height * low);
            let under = if piece == 0 { 0.0 } else { 0.5 };
            let right = left
                + match self.form {
                    BarWidth::Even => BREADTH,
                    BarWidth::Wedge(least, most) => least + (most - least) * (low + high) / 2.0,
                };
            let area = Area { left, top: piece_top, right, bottom: bottom + under };
            canvas.fill(area, (self.shade)((low + high) / 2.0));
        }
        let (ticks, factor) = axis.ticks((height / 45.0).clamp(2.0, 8.0) as usize);
        for tick in ticks {
            let y = plot.bottom - tick.place * height + 0.36 * TEXT;
            canvas.text(&tick.label, (left + BREADTH + NUMBERS, y), TEXT, Align::Start, INK);
        }
        canvas.text(
            &factor.after(&self.label),
            (left, plot.top + LABEL * 0.8),
            LABEL,
            Align::Start,
            GREY,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::colour::ramp;

    #[test]
    fn colour_bar_of_a_single_value_has_no_width() {
        let bar = ColourBar::new("t", [2.5, 2.5, f64::NAN], ramp);
        assert_eq!((bar.width(), bar.part(2.5)), (0.0, 1.0));
        let bar = ColourBar::new("t", [0.0, 5.0], ramp);
        assert!(bar.width() > 40.0);
        assert_eq!((bar.part(0.0), bar.part(2.5), bar.part(5.0)), (0.0, 0.5, 1.0));
    }
}
