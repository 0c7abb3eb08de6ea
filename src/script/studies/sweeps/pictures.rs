//! Pictures of sweeps: lines, points and maps of a result over parameters, all columns over all, histograms.

use std::collections::BTreeMap;

use super::table::SweepTable;
use crate::analysis::{SweepColumn, SweptValues};
use crate::elementary::ln;
use crate::output::{
    LevelAxis, LevelMap, LineChart, Marker, Page, Scale, Series, Stroke, significant,
};

/// Curves of a chart; more are told as their mean, least and largest.
const MOST_CURVES: usize = 8;
/// Points of a scatter; of more rows some are shown, evenly spread over all.
const MOST_POINTS: usize = 2000;
/// Points of each panel among many.
const MOST_POINTS_AMONG: usize = 500;
/// Cells along an axis over which points are gathered.
const CELLS: usize = 20;
/// Columns of which all are drawn over all.
pub const MOST_COLUMNS: usize = 6;
/// A ratio of the ends of a parameter from which its axis is logarithmic.
const DECADES: f64 = 50.0;

/// Which columns a picture is of.
pub struct Picture<'t> {
    /// The rows that are drawn.
    pub table: &'t SweepTable,
    /// What stands above it.
    pub title: String,
}

/// The places of a column along an axis: few levels, or any numbers.
fn levels(column: SweepColumn) -> Option<Vec<f64>> {
    match column {
        SweepColumn::Parameter(SweptValues::Levels { numbers: Some(numbers), .. }) => {
            let mut numbers = numbers.clone();
            numbers.sort_by(f64::total_cmp);
            Some(numbers)
        }
        _ => None,
    }
}

/// Whether numbers are better seen by their ratios: positive ones over decades.
fn scale(numbers: &[f64]) -> Scale {
    let finite = || numbers.iter().copied().filter(|x| x.is_finite());
    let (least, most) = (finite().fold(f64::INFINITY, f64::min), finite().fold(0.0, f64::max));
    match least > 0.0 && most / least >= DECADES {
        true => Scale::Logarithmic,
        false => Scale::Linear,
    }
}

fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len() as f64
}

/// The numbers of two columns in the rows where both are finite, and the numbers of these rows.
fn pairs(table: &SweepTable, x: SweepColumn, y: SweepColumn) -> Vec<(usize, f64, f64)> {
    let all = table.rows().map(|row| (row, x.number(row), y.number(row)));
    all.filter(|(_, x, y)| x.is_finite() && y.is_finite()).collect()
}

/// So many points at most, evenly spread over all.
fn thinned(points: &[(f64, f64)], most: usize) -> Vec<(f64, f64)> {
    let every = points.len().div_ceil(most).max(1);
    points.iter().copied().step_by(every).collect()
}

impl Picture<'_> {
    fn column(&self, name: &str) -> Option<SweepColumn<'_>> {
        self.table.sweep().column(name)
    }

    /// One column over another: curves over the values of a grid, else points. None where a column is missing.
    pub fn over(&self, x_name: &str, y_name: &str) -> Option<LineChart> {
        let (x, y) = (self.column(x_name)?, self.column(y_name)?);
        let found = pairs(self.table, x, y);
        let xs: Vec<f64> = found.iter().map(|(_, x, _)| *x).collect();
        let empty = LineChart::new(&self.title).x_label(x_name).y_label(y_name).x_scale(scale(&xs));
        let is_grid = levels(x).is_some_and(|levels| levels.len() > 1);
        Some(match is_grid {
            true => self.curves(empty, x_name, &found),
            false => {
                let points: Vec<(f64, f64)> = found.iter().map(|(_, x, y)| (*x, *y)).collect();
                let shown = thinned(&points, MOST_POINTS);
                let told = format!("{} of {} points", shown.len(), points.len());
                let series =
                    Series::new("", shown).stroke(Stroke::Unjoined).marker(Marker::Ring).thin();
                let chart = empty.series(series);
                if points.len() > MOST_POINTS { chart.caption(told) } else { chart }
            }
        })
    }

    /// A curve for each combination of the other parameters, or what all of them say together.
    fn curves(&self, chart: LineChart, x_name: &str, found: &[(usize, f64, f64)]) -> LineChart {
        let others: Vec<_> =
            self.table.sweep().design.parameters.iter().filter(|of| of.name != x_name).collect();
        let name = |row: usize| {
            let words = others.iter().map(|of| {
                let number = || of.values.number(row).map(|x| significant(x, 4));
                let value = number().or_else(|| of.values.label(row).map(str::to_owned));
                format!("{} {}", of.name, value.unwrap_or_default())
            });
            words.collect::<Vec<_>>().join(", ")
        };
        let mut names: Vec<String> = Vec::new();
        let mut curves: BTreeMap<String, Vec<(f64, f64)>> = BTreeMap::new();
        for (row, x, y) in found {
            let name = name(*row);
            if !curves.contains_key(&name) {
                names.push(name.clone());
            }
            curves.entry(name).or_default().push((*x, *y));
        }
        if names.len() > MOST_CURVES {
            return Self::band(chart, found, names.len());
        }
        let curve = |name: String| {
            let mut points = curves.remove(&name).unwrap_or_default();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            Series::new(name, points).stroke(Stroke::Marked)
        };
        names.into_iter().map(curve).fold(chart, LineChart::series)
    }

    /// Mean, least and largest of all rows with one value.
    fn band(chart: LineChart, found: &[(usize, f64, f64)], count: usize) -> LineChart {
        let mut of_value: BTreeMap<u64, (f64, Vec<f64>)> = BTreeMap::new();
        for (_, x, y) in found {
            let entry = of_value.entry(x.to_bits()).or_insert_with(|| (*x, Vec::new()));
            entry.1.push(*y);
        }
        let curve = |tell: fn(&[f64]) -> f64| {
            let mut points: Vec<_> = of_value.values().map(|(x, ys)| (*x, tell(ys))).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            points
        };
        let least = curve(|ys| ys.iter().copied().fold(f64::INFINITY, f64::min));
        let largest = curve(|ys| ys.iter().copied().fold(f64::NEG_INFINITY, f64::max));
        chart
            .series(Series::new("mean", curve(mean)).stroke(Stroke::Marked))
            .series(Series::new("least", least).stroke(Stroke::Dashed).thin())
            .series(Series::new("largest", largest).stroke(Stroke::Dotted).thin())
            .caption(format!("over {count} combinations of the other parameters"))
    }

    /// A column as colours over two others: over the values of a grid, else over cells in which points are gathered; of several rows in a cell the mean.
    /// None where a column is missing.
    pub fn map(&self, x_name: &str, y_name: &str, z_name: &str) -> Option<LevelMap> {
        let [x, y, z] = [self.column(x_name)?, self.column(y_name)?, self.column(z_name)?];
        let rows: Vec<[f64; 3]> =
            self.table.rows().map(|row| [x.number(row), y.number(row), z.number(row)]).collect();
        let axis = |name: &str, column: SweepColumn, at: usize| {
            let numbers = || rows.iter().map(move |row| row[at]).filter(|x| x.is_finite());
            let middles = levels(column).unwrap_or_else(|| {
                let (low, high) = (
                    numbers().fold(f64::INFINITY, f64::min),
                    numbers().fold(f64::NEG_INFINITY, f64::max),
                );
                let step = (high - low) / CELLS as f64;
                (0..CELLS).map(|cell| low + (cell as f64 + 0.5) * step).collect()
            });
            LevelAxis { label: name.to_owned(), middles }
        };
        let (x_axis, y_axis) = (axis(x_name, x, 0), axis(y_name, y, 1));
        let mut cells = vec![vec![(0.0, 0_usize); x_axis.middles.len()]; y_axis.middles.len()];
        for [x, y, z] in rows.iter().filter(|row| row.iter().all(|x| x.is_finite())) {
            if let (Some(column), Some(row)) =
                (nearest(&x_axis.middles, *x), nearest(&y_axis.middles, *y))
            {
                let (sum, count) = &mut cells[row][column];
                *sum += z;
                *count += 1;
            }
        }
        let most = cells.iter().flatten().map(|(_, count)| *count).max().unwrap_or(0);
        let value =
            |(sum, count): &(f64, usize)| if *count == 0 { f64::NAN } else { sum / *count as f64 };
        let values = cells.iter().map(|row| row.iter().map(value).collect()).collect();
        let map = LevelMap::new(&self.title, z_name, (x_axis, y_axis), values);
        Some(if most > 1 {
            map.caption(format!("means of up to {most} runs in a cell"))
        } else {
            map
        })
    }

    /// All columns of numbers over all others, with histograms on the diagonal.
    pub fn matrix(&self, names: &[&str]) -> Page {
        let page = Page::grid(names.len()).title(&self.title);
        let panels = names.iter().flat_map(|y| names.iter().map(move |x| (*x, *y)));
        panels.fold(page, |page, (x_name, y_name)| {
            let chart = match x_name == y_name {
                true => self.histogram(x_name),
                false => self.points_among(x_name, y_name),
            };
            page.panel(chart.title("").sized(300.0, 260.0))
        })
    }

    fn points_among(&self, x_name: &str, y_name: &str) -> LineChart {
        let columns = self.column(x_name).zip(self.column(y_name));
        let found = columns.map(|(x, y)| pairs(self.table, x, y)).unwrap_or_default();
        let points: Vec<(f64, f64)> = found.into_iter().map(|(_, x, y)| (x, y)).collect();
        let series =
            Series::new("", thinned(&points, MOST_POINTS_AMONG)).stroke(Stroke::Unjoined).thin();
        LineChart::new("").x_label(x_name).y_label(y_name).series(series)
    }

    /// How often a column has which numbers.
    pub fn histogram(&self, name: &str) -> LineChart {
        let column = self.column(name);
        let numbers = self.table.rows().filter_map(|row| column.map(|column| column.number(row)));
        let numbers: Vec<f64> = numbers.filter(|x| x.is_finite()).collect();
        let chart = LineChart::new(&self.title).x_label(name).y_label("runs");
        let (low, high) = (
            numbers.iter().copied().fold(f64::INFINITY, f64::min),
            numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        );
        if numbers.is_empty() {
            return chart.series(Series::new("", Vec::new()));
        }
        // Sturges' rule (1926), with twice as many classes.
        let classes =
            (2.0 * (1.0 + ln(numbers.len() as f64) / std::f64::consts::LN_2)).ceil().max(4.0);
        let width = if high > low { (high - low) / classes } else { 1.0 };
        let mut counts = vec![0_usize; classes as usize];
        for x in &numbers {
            let class = ((x - low) / width) as usize;
            let last = counts.len() - 1;
            counts[class.min(last)] += 1;
        }
        let mut outline = vec![(low, 0.0)];
        for (class, count) in counts.iter().enumerate() {
            let left = low + class as f64 * width;
            outline.extend([(left, *count as f64), (left + width, *count as f64)]);
        }
        outline.push((low + counts.len() as f64 * width, 0.0));
        chart.series(Series::new("", outline))
    }
}

/// The number of the middle that is nearest to `x`.
fn nearest(middles: &[f64], x: f64) -> Option<usize> {
    let distance = |at: &usize| (middles[*at] - x).abs();
    (0..middles.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
}
