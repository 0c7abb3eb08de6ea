//! Level maps: cells over two numeric axes, coloured by a number on a linear scale. Cells without a number are hatched.

use super::{
    axis::{AxisScale, PlotAxis},
    canvas::{Area, Canvas},
    colour::ramp,
    colour_bar::ColourBar,
    frame::{Frame, Margins},
    hatching::hatch,
    page::Panel,
};
use crate::elementary::ln;

/// Largest relative difference of two ratios of neighbouring numbers that count as equal.
const EQUAL_RATIOS: f64 = 1e-6;
/// Largest number of cells along an axis. Smaller cells would not be visible, and more cells would make the file large.
const MOST_CELLS: usize = 160;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct LevelAxis {
    pub label: String,
    pub middles: Vec<f64>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct LevelMap {
    title: String,
    captions: Vec<String>,
    label: String,
    x: LevelAxis,
    y: LevelAxis,
    values: Vec<Vec<f64>>,
}

/// Means of the finite values in blocks of `across` by `up` cells; NaN for a block without finite values.
fn means(values: &[Vec<f64>], (across, up): (usize, usize)) -> Vec<Vec<f64>> {
    let row = |rows: &[Vec<f64>]| {
        let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
        let mean = |start: usize| {
            let end = |row: &Vec<f64>| (start + across).min(row.len());
            let all = rows.iter().flat_map(|row| row.get(start..end(row)).unwrap_or_default());
            let (sum, count) = all
                .filter(|x| x.is_finite())
                .fold((0.0, 0_usize), |(sum, count), x| (sum + x, count + 1));
            if count == 0 { f64::NAN } else { sum / count as f64 }
        };
        (0..columns).step_by(across).map(mean).collect()
    };
    values.chunks(up).map(row).collect()
}

impl LevelAxis {
    /// Scale of the axis: logarithmic if all numbers are positive with equal ratios of neighbours, otherwise linear.
    pub fn scale(&self) -> AxisScale {
        let ratios: Vec<f64> = self.middles.windows(2).map(|pair| pair[1] / pair[0]).collect();
        let is_equal = |ratio: &f64| (ratio / ratios[0] - 1.0).abs() < EQUAL_RATIOS;
        let is_positive = self.middles.iter().all(|x| *x > 0.0);
        match is_positive && ratios.len() > 1 && ratios.iter().all(is_equal) {
            true => AxisScale::Logarithmic,
            false => AxisScale::Linear,
        }
    }

    fn ends(&self) -> Vec<f64> {
        self.ends_by(self.scale())
    }

    pub fn ends_halfway(&self) -> Vec<f64> {
        self.ends_by(AxisScale::Linear)
    }

    fn ends_by(&self, scale: AxisScale) -> Vec<f64> {
        let between = |a: f64, b: f64| match scale {
            AxisScale::Linear => 0.5 * a + 0.5 * b,
            AxisScale::Logarithmic => (a * b).sqrt(),
        };
        let beyond = |a: f64, end: f64| match scale {
            // If the extrapolated boundary exceeds the largest float, the outermost cell ends at its centre.
            AxisScale::Linear => Some(2.0 * a - end).filter(|far| far.is_finite()).unwrap_or(a),
            AxisScale::Logarithmic => a * a / end,
        };
        let mut ends: Vec<f64> =
            self.middles.windows(2).map(|pair| between(pair[0], pair[1])).collect();
        match (self.middles.as_slice(), ends.first().copied(), ends.last().copied()) {
            ([first, .., last], Some(low), Some(high)) => {
                ends.insert(0, beyond(*first, low));
                ends.push(beyond(*last, high));
            }
            ([only], ..) => {
                let half = if *only == 0.0 { 0.5 } else { only.abs() / 2.0 };
                ends = vec![only - half, only + half];
            }
            _ => ends = vec![0.0, 1.0],
        }
        ends
    }

    fn merged(&self) -> usize {
        self.middles.len().div_ceil(MOST_CELLS).max(1)
    }

    fn drawn_ends(&self) -> Vec<f64> {
        let ends = self.ends();
        let inner = ends.iter().copied().step_by(self.merged());
        let last = ends.last().copied().filter(|_| !(ends.len() - 1).is_multiple_of(self.merged()));
        inner.chain(last).collect()
    }

    fn axis(&self) -> PlotAxis {
        let ends = self.ends();
        let (low, high) = (ends[0], ends[ends.len() - 1]);
        match self.scale() {
            // An axis whose ends are almost equal is linear, because a logarithmic axis needs ends with a ratio above one.
            AxisScale::Logarithmic if ln(high / low) > 1e-3 => PlotAxis::powers_between(low, high),
            _ => PlotAxis::between(low, high),
        }
    }
}

impl LevelMap {
    /// Creates a map over two axes. `values` are rows of cells from the bottom, and `label` names the quantity.
    /// Cells with a value that is not finite are hatched.
    /// On axes with more than 160 numbers, neighbouring cells are merged to their mean value, which a caption states.
    pub fn new(
        title: impl Into<String>,
        label: impl Into<String>,
        (x, y): (LevelAxis, LevelAxis),
        values: Vec<Vec<f64>>,
    ) -> Self {
        let merged = (x.merged(), y.merged());
        let (captions, values) = match merged {
            (1, 1) => (Vec::new(), values),
            (across, up) => {
                let note = format!("each drawn cell is the mean of {across} × {up} cells");
                (vec![note], means(&values, merged))
            }
        };
        Self { title: title.into(), captions, label: label.into(), x, y, values }
    }

    pub fn caption(mut self, words: impl Into<String>) -> Self {
        self.captions.push(words.into());
        self
    }

    fn frame(&self) -> Frame {
        Frame {
            title: self.title.clone(),
            captions: self.captions.clone(),
            x_label: self.x.label.clone(),
            y_label: self.y.label.clone(),
            x: self.x.axis(),
            y: self.y.axis(),
            legend: Vec::new(),
        }
    }

    fn numbers(&self) -> impl Iterator<Item = f64> {
        self.values.iter().flatten().copied().filter(|x| x.is_finite())
    }

    fn bar(&self) -> ColourBar {
        ColourBar::new(&self.label, self.numbers(), ramp)
    }
}

impl Panel for LevelMap {
    fn size(&self) -> (f64, f64) {
        (760.0, 560.0)
    }

    fn margins(&self, width: f64, height: f64) -> Margins {
        self.frame().margins_beside(self.bar().width(), width, height)
    }

    fn draw(&self, canvas: &mut Canvas, area: &Area, plot: &Area) {
        let (frame, bar) = (self.frame(), self.bar());
        frame.draw(canvas, area, plot);
        if self.numbers().next().is_none() {
            frame.draw_no_data(canvas, plot);
        }
        let (x_ends, y_ends) = (self.x.drawn_ends(), self.y.drawn_ends());
        for (row, y) in self.values.iter().zip(y_ends.windows(2)) {
            for (value, x) in row.iter().zip(x_ends.windows(2)) {
                let (left, bottom) = frame.place(plot, (x[0], y[0]));
                let (right, top) = frame.place(plot, (x[1], y[1]));
                let cell = Area { left, top, right, bottom };
                match value.is_finite() {
                    // Cells overlap slightly, so that there are no visible seams.
                    true => {
                        let cell = Area {
                            right: (right + 0.3).min(plot.right),
                            bottom: (bottom + 0.3).min(plot.bottom),
                            ..cell
                        };
                        canvas.fill(cell, ramp(bar.part(*value)));
                    }
                    false => hatch(canvas, &cell.within(plot)),
                }
            }
        }
        bar.draw(canvas, plot);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::canvas::Shape;

    fn axis(label: &str, middles: &[f64]) -> LevelAxis {
        LevelAxis { label: label.into(), middles: middles.to_vec() }
    }

    #[test]
    fn cell_ends_are_finite_for_any_middles() {
        let axis = LevelAxis { label: "a".into(), middles: vec![-1.7e308, -1e308, 1.7e308] };
        assert!(axis.ends_halfway().iter().all(|end| end.is_finite()));
    }

    #[test]
    fn level_map_cells_end_halfway_between_middles() {
        assert_eq!(axis("", &[1.0, 2.0, 4.0]).scale(), AxisScale::Logarithmic);
        let ends = axis("", &[1.0, 2.0, 5.0]).ends();
        assert_eq!(ends, [0.5, 1.5, 3.5, 6.5]);
        let ends = axis("", &[0.1, 1.0, 10.0]).ends();
        assert!(
            (ends[1] * ends[1] - 0.1).abs() < 1e-15 && (ends[3] * ends[3] - 1000.0).abs() < 1e-9
        );
        assert_eq!(axis("", &[0.0]).ends(), [-0.5, 0.5]);
    }

    #[test]
    fn numerous_cells_are_averaged_with_their_neighbours() {
        let middles: Vec<f64> = (0..1000).map(f64::from).collect();
        let values = (0..3).map(|row| (0..1000).map(|x| f64::from(x + 1000 * row)).collect());
        let axes = (axis("x", &middles), axis("y", &[1.0, 2.0, 3.0]));
        let mut map = LevelMap::new("", "", axes, values.collect());
        assert_eq!(map.captions, ["each drawn cell is the mean of 7 × 1 cells"]);
        let ends = map.x.drawn_ends();
        assert_eq!((map.values[1].len(), ends.len()), (143, 144));
        assert_eq!((ends[0], ends[1], ends[143]), (-0.5, 6.5, 999.5));
        assert_eq!((map.values[1][0], map.values[2][142]), (1003.0, 2996.5));
        map.values[0][0] = f64::NAN;
        assert_eq!(
            means(&map.values, (2, 3))[0][0],
            (1003.0 + 1010.0 + 2003.0 + 2010.0 + 10.0) / 5.0
        );
    }

    #[test]
    fn level_map_colours_cells_and_hatches_cells_without_a_value() {
        let values = vec![vec![0.0, 1.0, 2.0], vec![f64::NAN, 4.0, 5.0]];
        let axes = (axis("speed", &[1.0, 2.0, 3.0]), axis("mass", &[0.1, 0.2]));
        let map = LevelMap::new("crane", "peak", axes, values);
        let mut canvas = Canvas::default();
        let area = Area { left: 0.0, top: 0.0, right: 500.0, bottom: 300.0 };
        let plot = Area { left: 60.0, top: 40.0, right: 360.0, bottom: 240.0 };
        map.draw(&mut canvas, &area, &plot);
        let cells = canvas.shapes().iter().filter(|shape| match shape {
            Shape::Fill { area, .. } => area.width() > 90.0 && area.width() < 110.0,
            _ => false,
        });
        assert_eq!(cells.count(), 5);
        let svg = map.figure().unwrap().to_svg().unwrap();
        assert!(svg.contains("speed") && svg.contains("peak"), "{svg}");
        LevelMap::new("", "", (axis("", &[]), axis("", &[])), vec![]).figure().unwrap();
    }
}
