//! The legend: a strip of names between the title and the plot, where it hides no data.

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

/// More rows than this would leave no room for the plot; the last one then says how many names are missing.
const MOST_ROWS: usize = 4;

/// An entry of a legend: a name with a sample of its line.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The name of the entry.
    pub name: String,
    /// The colour of the line of the entry.
    pub colour: Colour,
    /// How the line of the entry is drawn.
    pub stroke: Stroke,
    /// The shape of the marks of the entry, if it has some.
    pub marker: Marker,
}

/// The height that a legend takes when it is `width` wide [pixels].
pub fn height(entries: &[Entry], width: f64) -> f64 {
    rows(entries, width).len() as f64 * ROW
}

/// Draws a legend from the top of `area` downwards.
pub fn draw(canvas: &mut Canvas, entries: &[Entry], area: &Area) {
    let rows = rows(entries, area.width());
    let shown: usize = rows.iter().map(Vec::len).sum();
    for (index, row) in rows.iter().enumerate() {
        let middle = area.top + (index as f64 + 0.5) * ROW;
        let mut x = area.left;
        for entry in row {
            entry.stroke.draw(canvas, &[(x, middle), (x + SAMPLE, middle)], 2.0, entry.colour);
            if entry.stroke.has_marks() {
                entry.marker.draw(canvas, (x + SAMPLE / 2.0, middle), 3.5, entry.colour);
            }
            let name = fitted(entry, area.width());
            canvas.text(&name, (x + SAMPLE + GAP, middle + 0.36 * TEXT), TEXT, Align::Start, INK);
            x += length(entry, area.width()) + BETWEEN;
        }
        if index + 1 == rows.len() && shown < entries.len() {
            let rest = format!("and {} more", entries.len() - shown);
            canvas.text(&rest, (x, middle + 0.36 * TEXT), TEXT, Align::Start, INK);
        }
    }
}

fn rows(entries: &[Entry], width: f64) -> Vec<Vec<&Entry>> {
    let mut rows: Vec<Vec<&Entry>> = Vec::new();
    let mut used = f64::INFINITY;
    for entry in entries {
        let length = length(entry, width);
        // The last row keeps room to say how many names are missing.
        let room = if rows.len() == MOST_ROWS { width - 110.0 } else { width };
        if used + length > room {
            if rows.len() == MOST_ROWS {
                break;
            }
            rows.push(Vec::new());
            used = 0.0;
        }
        used += length + BETWEEN;
        if let Some(row) = rows.last_mut() {
            row.push(entry);
        }
    }
    rows
}

fn length(entry: &Entry, width: f64) -> f64 {
    SAMPLE + GAP + fonts::width(&fitted(entry, width), TEXT)
}

fn fitted(entry: &Entry, width: f64) -> String {
    fonts::fit(&entry.name, TEXT, width - SAMPLE - GAP - 110.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries(count: usize, name: &str) -> Vec<Entry> {
        let (stroke, marker) = (Stroke::Solid, Marker::Disc);
        vec![Entry { name: name.into(), colour: INK, stroke, marker }; count]
    }

    #[test]
    fn names_flow_into_rows_and_stop_at_the_most() {
        assert_eq!(height(&[], 800.0), 0.0);
        assert_eq!(height(&entries(3, "energy"), 800.0), ROW);
        assert_eq!(height(&entries(12, "kinetic energy"), 800.0), 3.0 * ROW);
        assert_eq!(height(&entries(1000, "kinetic energy"), 800.0), 4.0 * ROW);
        let mut canvas = Canvas::default();
        draw(
            &mut canvas,
            &entries(1000, "e"),
            &Area { left: 0.0, top: 0.0, right: 500.0, bottom: 80.0 },
        );
        assert!(format!("{canvas:?}").contains("more"));
    }
}
