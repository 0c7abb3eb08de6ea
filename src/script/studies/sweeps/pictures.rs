//! Pictures of sweeps: curves, points, maps, scatter matrices, and histograms.

use std::collections::BTreeMap;

use super::table::SweepTable;
use crate::analysis::{SweepColumn, SweptValues};
use crate::elementary::{exp, ln};
use crate::output::{
    AxisScale, LevelAxis, LevelMap, LineChart, Marker, Page, Series, Stroke, significant,
};
use crate::sampling::Random;

const MOST_CURVES: usize = 8;
const MOST_POINTS: usize = 2000;
const MOST_POINTS_AMONG: usize = 500;
const CELLS: usize = 20;
pub const MOST_COLUMNS: usize = 6;
const MOST_VALUES: usize = 64;
const DECADE: f64 = 10.0;

pub struct Picture<'t> {
    pub table: &'t SweepTable,
    pub title: String,
}

/// Ascending levels of a parameter with numeric levels; `None` for other columns.
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

fn ends(numbers: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    (numbers.clone().fold(f64::INFINITY, f64::min), numbers.fold(f64::NEG_INFINITY, f64::max))
}

fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len() as f64
}

fn pairs(table: &SweepTable, x: SweepColumn, y: SweepColumn) -> Vec<(usize, f64, f64)> {
    let all = table.rows().map(|row| (row, x.number(row), y.number(row)));
    all.filter(|(_, x, y)| x.is_finite() && y.is_finite()).collect()
}

/// Random subset of at most `most` items in order, the same in every run (C. T. Fan, M. E. Muller, I. Rezucha, 1962).
/// A regular subset of a grid or a Sobol' sequence could cover only a part of the range.
fn thinned<T: Copy>(all: &[T], most: usize) -> Vec<T> {
    let mut random = Random::seeded(0);
    let mut wanted = most.min(all.len());
    let is_chosen = |(at, _): &(usize, &T)| {
        let rest = (all.len() - at) as u64;
        let is_chosen = random.below(rest) < wanted as u64;
        wanted -= usize::from(is_chosen);
        is_chosen
    };
    all.iter().enumerate().filter(is_chosen).map(|(_, one)| *one).collect()
}

impl Picture<'_> {
    fn column(&self, name: &str) -> Option<SweepColumn<'_>> {
        self.table.sweep().column(name)
    }

    fn scale(&self, name: &str, column: SweepColumn) -> AxisScale {
        let by_ratios = match levels(column) {
            Some(middles) => {
                LevelAxis { label: String::new(), middles }.scale() == AxisScale::Logarithmic
            }
            None => self.table.is_spread_by_ratios(name),
        };
        let (least, largest) = ends(self.table.rows().map(|row| column.number(row)));
        match by_ratios && largest / least >= DECADE {
            true => AxisScale::Logarithmic,
            false => AxisScale::Linear,
        }
    }

    pub fn has_rows(&self, names: &[&str]) -> bool {
        let columns: Vec<_> = names.iter().filter_map(|name| self.column(name)).collect();
        self.table.rows().any(|row| columns.iter().all(|column| column.number(row).is_finite()))
    }

    /// Chart of the column `y_name` over the column `x_name`; `None` if a column is missing.
    /// The chart has curves if `x_name` is a parameter with several levels, and points otherwise.
    pub fn over(&self, x_name: &str, y_name: &str) -> Option<LineChart> {
        let (x, y) = (self.column(x_name)?, self.column(y_name)?);
        let found = pairs(self.table, x, y);
        let scale = self.scale(x_name, x);
        let empty = LineChart::new(&self.title).x_label(x_name).y_label(y_name).x_scale(scale);
        let is_grid = levels(x).is_some_and(|levels| levels.len() > 1);
        Some(match is_grid {
            true => self.curves(empty, x_name, &found),
            false => {
                let points: Vec<(f64, f64)> = found.iter().map(|(_, x, y)| (*x, *y)).collect();
                let shown = thinned(&points, MOST_POINTS);
                let message =
                    format!("{} of {} points, selected at random", shown.len(), points.len());
                let series =
                    Series::new("", shown).stroke(Stroke::MarkersOnly).marker(Marker::Ring).thin();
                let chart = empty.series(series);
                if points.len() > MOST_POINTS { chart.caption(message) } else { chart }
            }
        })
    }

    fn curves(&self, chart: LineChart, x_name: &str, found: &[(usize, f64, f64)]) -> LineChart {
        let others: Vec<_> =
            self.table.sweep().design.parameters.iter().filter(|of| of.name != x_name).collect();
        let name = |row: usize| {
            let words = others.iter().map(|of| {
                format!("{} {}", of.name, of.values.in_words(row, |number| significant(number, 4)))
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

    /// Map of a column over two other columns, with means of scattered points in cells; `None` if a column is missing.
    pub fn map(&self, x_name: &str, y_name: &str, z_name: &str) -> Option<LevelMap> {
        let [x, y, z] = [self.column(x_name)?, self.column(y_name)?, self.column(z_name)?];
        let rows: Vec<[f64; 3]> =
            self.table.rows().map(|row| [x.number(row), y.number(row), z.number(row)]).collect();
        let axis = |name: &str, column: SweepColumn, at: usize| {
            let numbers = || rows.iter().map(move |row| row[at]).filter(|x| x.is_finite());
            let middles = levels(column).unwrap_or_else(|| {
                let (low, high) = ends(numbers());
                let between = |low: f64, high: f64| {
                    let step = (high - low) / CELLS as f64;
                    (0..CELLS).map(move |cell| low + (cell as f64 + 0.5) * step)
                };
                match self.scale(name, column) {
                    AxisScale::Linear => between(low, high).collect(),
                    AxisScale::Logarithmic => between(ln(low), ln(high)).map(exp).collect(),
                }
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

    pub fn matrix(&self, names: &[&str]) -> Page {
        let columns: Vec<_> = names.iter().filter_map(|name| self.column(name)).collect();
        let is_whole = |row: &usize| columns.iter().all(|column| column.number(*row).is_finite());
        let whole: Vec<usize> = self.table.rows().filter(is_whole).collect();
        let shown = thinned(&whole, MOST_POINTS_AMONG);
        let title = match whole.len() > shown.len() {
            true => {
                format!(
                    "{}: {} of {} runs, selected at random",
                    self.title,
                    shown.len(),
                    whole.len()
                )
            }
            false => self.title.clone(),
        };
        let page = Page::grid(names.len()).title(title);
        let panels = names.iter().flat_map(|y| names.iter().map(move |x| (*x, *y)));
        panels.fold(page, |page, (x_name, y_name)| {
            let chart = match x_name == y_name {
                true => self.histogram(x_name),
                false => self.points_of(&shown, x_name, y_name),
            };
            page.panel(chart.title("").sized(300.0, 260.0))
        })
    }

    fn points_of(&self, rows: &[usize], x_name: &str, y_name: &str) -> LineChart {
        let columns = self.column(x_name).zip(self.column(y_name));
        let points =
            rows.iter().filter_map(|row| columns.map(|(x, y)| (x.number(*row), y.number(*row))));
        let series = Series::new("", points.collect()).stroke(Stroke::MarkersOnly).thin();
        LineChart::new("").x_label(x_name).y_label(y_name).series(series)
    }

    pub fn histogram(&self, name: &str) -> LineChart {
        let column = self.column(name);
        let numbers = self.table.rows().filter_map(|row| column.map(|column| column.number(row)));
        let numbers: Vec<f64> = numbers.filter(|x| x.is_finite()).collect();
        let chart = LineChart::new(&self.title).x_label(name).y_label("runs");
        let classes = classes(numbers);
        let mut outline: Vec<(f64, f64)> = Vec::new();
        for Class { from, to, count } in &classes {
            outline.extend([(*from, *count as f64), (*to, *count as f64)]);
        }
        if let (Some(first), Some(last)) = (classes.first(), classes.last()) {
            outline.insert(0, (first.from, 0.0));
            outline.push((last.to, 0.0));
        }
        chart.series(Series::new("", outline))
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Class {
    from: f64,
    to: f64,
    count: usize,
}

/// Bins of a histogram: one for each value if there are few distinct values, otherwise bins of equal width.
fn classes(mut numbers: Vec<f64>) -> Vec<Class> {
    numbers.sort_by(f64::total_cmp);
    let (Some(low), Some(high)) = (numbers.first().copied(), numbers.last().copied()) else {
        return Vec::new();
    };
    let values: Vec<&[f64]> = numbers.chunk_by(|a, b| a == b).collect();
    let is_discrete =
        values.len() > 1 && values.len() <= MOST_VALUES && 2 * values.len() <= numbers.len();
    if is_discrete {
        let middles = values.iter().map(|of| of[0]).collect();
        let ends = LevelAxis { label: String::new(), middles }.ends_halfway();
        let of =
            |(of, ends): (&&[f64], &[f64])| Class { from: ends[0], to: ends[1], count: of.len() };
        return values.iter().zip(ends.windows(2)).map(of).collect();
    }
    // The number of bins is twice that of H. A. Sturges (1926).
    let count = (2.0 * (1.0 + ln(numbers.len() as f64) / std::f64::consts::LN_2)).ceil().max(4.0);
    let width = if high > low { (high - low) / count } else { 1.0 };
    let at = |class: usize| low + class as f64 * width;
    let class = |class| Class { from: at(class), to: at(class) + width, count: 0 };
    let mut classes: Vec<Class> = (0..count as usize).map(class).collect();
    let last = classes.len() - 1;
    for x in &numbers {
        classes[(((x - low) / width) as usize).min(last)].count += 1;
    }
    classes
}

fn nearest(middles: &[f64], x: f64) -> Option<usize> {
    let above = middles.partition_point(|middle| *middle < x);
    let distance = |at: &usize| (middles[*at] - x).abs();
    let around = above.saturating_sub(1)..(above + 1).min(middles.len());
    around.min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_thinned_randomly_without_aliasing() {
        let all: Vec<usize> = (0..4000).collect();
        let shown = thinned(&all, 2000);
        assert_eq!(shown, thinned(&all, 2000));
        assert!(shown.len() == 2000 && shown.is_sorted());
        for period in [2, 4, 8] {
            for phase in 0..period {
                let count = shown.iter().filter(|at| *at % period == phase).count();
                let expected = 2000 / period;
                assert!(count.abs_diff(expected) < expected / 4, "{period} {phase}: {count}");
            }
        }
        assert_eq!(thinned(&all[..5], 5), [0, 1, 2, 3, 4]);
        assert!(thinned(&all[..0], 5).is_empty());
    }

    #[test]
    fn few_distinct_values_have_separate_classes() {
        let numbers: Vec<f64> = (0..32 * 10).map(|at| f64::from(at % 32)).collect();
        let found = classes(numbers);
        assert!(found.len() == 32 && found.iter().all(|of| of.count == 10), "{found:?}");
        assert_eq!((found[0].from, found[0].to, found[31].to), (-0.5, 0.5, 31.5));
        let found = classes((0..1000).map(|at| f64::from(at).sqrt()).collect());
        assert!(found.len() == 22 && found.iter().map(|of| of.count).sum::<usize>() == 1000);
        assert_eq!(classes(vec![3.0; 7])[0], Class { from: 3.0, to: 4.0, count: 7 });
        assert!(classes(Vec::new()).is_empty());
    }

    #[test]
    fn nearest_of_ascending_middles_is_found() {
        let middles = [1.0, 2.0, 4.0];
        let found = [-9.0, 1.4, 1.6, 2.0, 3.5, 9.0].map(|x| nearest(&middles, x));
        assert_eq!(found, [0, 0, 1, 1, 2, 2].map(Some));
        assert_eq!(nearest(&[], 1.0), None);
    }
}
