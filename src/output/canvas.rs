//! Shapes of a picture: lines, discs, boxes and texts. Coordinates are in pixels from the top left corner.
//! Charts draw on a canvas, which painters write to a file, so that the drawing library can be replaced.

use super::{colour::Colour, fonts};

pub type Point = (f64, f64);

/// Magnitude to which coordinates are limited to prevent overflow, far outside every picture [pixels].
const FAR: f64 = 20_000.0;

/// Box with sides along the axes. `top` is less than `bottom`, because `y` increases downwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Area {
    pub fn within(&self, other: &Self) -> Self {
        Self {
            left: self.left.clamp(other.left, other.right),
            top: self.top.clamp(other.top, other.bottom),
            right: self.right.clamp(other.left, other.right),
            bottom: self.bottom.clamp(other.top, other.bottom),
        }
    }

    /// Square of side length `2 · reach` around a point.
    pub fn around((x, y): Point, reach: f64) -> Self {
        Self { left: x - reach, top: y - reach, right: x + reach, bottom: y + reach }
    }

    pub fn width(&self) -> f64 {
        self.right - self.left
    }

    pub fn height(&self) -> f64 {
        self.bottom - self.top
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Align {
    Start,
    Middle,
    End,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TextDirection {
    Level,
    Upwards,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    pub text: String,
    /// Left end of the baseline after alignment [pixels].
    pub start: Point,
    /// Size of the text [pixels per em].
    pub size: f64,
    pub colour: Colour,
    pub direction: TextDirection,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    Line {
        points: Vec<Point>,
        /// Width of the line [pixels].
        width: f64,
        colour: Colour,
    },
    Disc {
        centre: Point,
        /// Radius of the circle [pixels].
        radius: f64,
        colour: Colour,
    },
    Fill {
        area: Area,
        colour: Colour,
    },
    Text(Text),
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Canvas {
    shapes: Vec<Shape>,
}

impl Canvas {
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    pub fn line(&mut self, points: impl IntoIterator<Item = Point>, width: f64, colour: Colour) {
        let points: Vec<Point> = points.into_iter().filter_map(reachable).collect();
        if !points.is_empty() {
            self.shapes.push(Shape::Line { points, width, colour });
        }
    }

    pub fn disc(&mut self, centre: Point, radius: f64, colour: Colour) {
        if let Some(centre) = reachable(centre) {
            self.shapes.push(Shape::Disc { centre, radius, colour });
        }
    }

    pub fn fill(&mut self, area: Area, colour: Colour) {
        let corners = reachable((area.left, area.top)).zip(reachable((area.right, area.bottom)));
        if let Some(((left, top), (right, bottom))) = corners {
            self.shapes.push(Shape::Fill { area: Area { left, top, right, bottom }, colour });
        }
    }

    pub fn text(&mut self, text: &str, anchor: Point, size: f64, align: Align, colour: Colour) {
        self.write(text, anchor, size, align, TextDirection::Level, colour);
    }

    pub fn text_upwards(
        &mut self,
        text: &str,
        anchor: Point,
        size: f64,
        align: Align,
        colour: Colour,
    ) {
        self.write(text, anchor, size, align, TextDirection::Upwards, colour);
    }

    fn write(
        &mut self,
        text: &str,
        anchor: Point,
        size: f64,
        align: Align,
        direction: TextDirection,
        colour: Colour,
    ) {
        let back = match align {
            Align::Start => 0.0,
            Align::Middle => fonts::width(text, size) / 2.0,
            Align::End => fonts::width(text, size),
        };
        let start = match direction {
            TextDirection::Level => (anchor.0 - back, anchor.1),
            TextDirection::Upwards => (anchor.0, anchor.1 + back),
        };
        if let Some(start) = reachable(start).filter(|_| !text.is_empty()) {
            self.shapes.push(Shape::Text(Text {
                text: text.into(),
                start,
                size,
                colour,
                direction,
            }));
        }
    }
}

fn reachable((x, y): Point) -> Option<Point> {
    (x.is_finite() && y.is_finite()).then(|| (x.clamp(-FAR, FAR), y.clamp(-FAR, FAR)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::colour::INK;

    #[test]
    fn nonfinite_shapes_are_not_drawn() {
        let mut canvas = Canvas::default();
        canvas.line([(f64::NAN, 0.0), (1.0, f64::INFINITY)], 1.0, INK);
        canvas.disc((f64::NAN, 0.0), 1.0, INK);
        canvas.text("lost", (0.0, f64::NEG_INFINITY), 12.0, Align::Start, INK);
        canvas.text("", (0.0, 0.0), 12.0, Align::Start, INK);
        assert!(canvas.shapes().is_empty());
        canvas.line([(1e300, 0.0), (f64::NAN, 0.0), (1.0, 1.0)], 1.0, INK);
        let expected =
            Shape::Line { points: vec![(FAR, 0.0), (1.0, 1.0)], width: 1.0, colour: INK };
        assert_eq!(canvas.shapes(), [expected]);
    }

    #[test]
    fn text_alignment_shifts_the_start_along_the_text() {
        let mut canvas = Canvas::default();
        canvas.text("abc", (100.0, 50.0), 12.0, Align::End, INK);
        canvas.text_upwards("abc", (100.0, 50.0), 12.0, Align::Middle, INK);
        let width = fonts::width("abc", 12.0);
        let starts = canvas.shapes().iter().map(|shape| match shape {
            Shape::Text(text) => text.start,
            other => panic!("{other:?}"),
        });
        assert_eq!(
            starts.collect::<Vec<_>>(),
            [(100.0 - width, 50.0), (100.0, 50.0 + width / 2.0)]
        );
    }
}
