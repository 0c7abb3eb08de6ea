//! Legends: names of the curves, between title and plot.

use super::{
    canvas::{Align, Area, Canvas},
    colour::{Colour, INK},
    fonts,
    marker::Marker,
    stroke::Stroke,
};

const TEXT: f64 = 12.5;
const ROW: f64 = 20.0;
const SAMPLE: f64 = 24.0;
const GAP: f64 = 7.0;
const BETWEEN: f64 = 20.0;
const LINE: f64 = 16.0;
const REST: f64 = 110.0;

const MOST_ROWS: usize = 4;
const MOST_LINES: usize = 3;

#[derive(Clone, Debug, PartialEq)]
pub struct LegendEntry {
    pub name: String,
    pub colour: Colour,
    pub stroke: Stroke,
    pub marker: Marker,
}

struct Item<'a> {
    entry: &'a LegendEntry,
    lines: Vec<String>,
}

impl<'a> Item<'a> {
    fn of(entry: &'a LegendEntry, width: f64) -> Self {
        let room = (width - SAMPLE - GAP).max(ROW);
        let mut lines = fonts::lines(&entry.name, TEXT, room);
        if lines.len() > MOST_LINES {
            let rest = lines.split_off(MOST_LINES - 1).join(" ");
            lines.push(fonts::fit(&rest, TEXT, room));
        }
        Self { entry, lines }
    }

    fn length(&self) -> f64 {
        let lines = self.lines.iter().map(|line| fonts::width(line, TEXT));
        SAMPLE + GAP + lines.fold(0.0, f64::max)
    }

    fn draw(&self, canvas: &mut Canvas, (x, middle): (f64, f64)) {
        let LegendEntry { colour, stroke, marker, .. } = *self.entry;
        stroke.draw(canvas, &[(x, middle), (x + SAMPLE, middle)], 2.0, colour);
        if stroke.has_marks() {
            marker.draw(canvas, (x + SAMPLE / 2.0, middle), 3.5, colour);
        }
        for (index, line) in self.lines.iter().enumerate() {
            let baseline = middle + 0.36 * TEXT + index as f64 * LINE;
            canvas.text(line, (x + SAMPLE + GAP, baseline), TEXT, Align::Start, INK);
        }
    }
}

/// Height of a legend of width `width` [pixels].
pub fn height(entries: &[LegendEntry], width: f64) -> f64 {
    rows(entries, width).iter().map(|row| height_of(row)).sum()
}

fn height_of(row: &[Item]) -> f64 {
    let lines = row.iter().map(|item| item.lines.len()).max().unwrap_or(1);
    ROW + lines.saturating_sub(1) as f64 * LINE
}

pub fn draw(canvas: &mut Canvas, entries: &[LegendEntry], area: &Area) {
    let rows = rows(entries, area.width());
    let shown: usize = rows.iter().map(Vec::len).sum();
    let mut top = area.top;
    for (index, row) in rows.iter().enumerate() {
        let middle = top + 0.5 * ROW;
        let mut x = area.left;
        for item in row {
            item.draw(canvas, (x, middle));
            x += item.length() + BETWEEN;
        }
        if index + 1 == rows.len() && shown < entries.len() {
            let rest = format!("and {} more", entries.len() - shown);
            canvas.text(&rest, (x, middle + 0.36 * TEXT), TEXT, Align::Start, INK);
        }
        top += height_of(row);
    }
}

fn rows(entries: &[LegendEntry], width: f64) -> Vec<Vec<Item<'_>>> {
    let mut rows: Vec<Vec<Item>> = Vec::new();
    let mut used = f64::INFINITY;
    for entry in entries {
        let is_last = rows.len() == MOST_ROWS;
        let room = if is_last { width - REST } else { width };
        let item = Item::of(entry, width);
        let length = item.length();
        if used + length > room {
            if is_last {
                break;
            }
            rows.push(Vec::new());
            used = 0.0;
        }
        used += length + BETWEEN;
        if let Some(row) = rows.last_mut() {
            row.push(item);
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries(count: usize, name: &str) -> Vec<LegendEntry> {
        let (stroke, marker) = (Stroke::Solid, Marker::Disc);
        vec![LegendEntry { name: name.into(), colour: INK, stroke, marker }; count]
    }

    #[test]
    fn legend_entries_wrap_into_rows_up_to_the_maximum() {
        assert_eq!(height(&[], 800.0), 0.0);
        assert_eq!(height(&entries(3, "energy"), 800.0), ROW);
        assert_eq!(height(&entries(12, "kinetic energy"), 800.0), 3.0 * ROW);
        assert_eq!(height(&entries(1000, "kinetic energy"), 800.0), 4.0 * ROW);
        let long = entries(2, "the path of the end of a beam with a name");
        assert_eq!(height(&long, 200.0), 2.0 * (ROW + LINE), "a long name has two lines");
        let mut canvas = Canvas::default();
        draw(
            &mut canvas,
            &entries(1000, "e"),
            &Area { left: 0.0, top: 0.0, right: 500.0, bottom: 80.0 },
        );
        assert!(format!("{canvas:?}").contains("more"));
    }
}
