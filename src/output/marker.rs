//! Shapes of markers, which distinguish series without colours.

use super::{
    canvas::{Area, Canvas, Point},
    colour::{Colour, WHITE},
};

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Marker {
    #[default]
    Disc,
    Square,
    Diamond,
    Triangle,
    Ring,
    Cross,
}

impl Marker {
    const ALL: [Self; 6] =
        [Self::Disc, Self::Square, Self::Diamond, Self::Triangle, Self::Ring, Self::Cross];

    pub fn of_index(index: usize) -> Self {
        Self::ALL[index % Self::ALL.len()]
    }

    /// Draws a marker centred on a point, about as large as a disc of the given radius [pixels].
    pub fn draw(self, canvas: &mut Canvas, (x, y): Point, radius: f64, colour: Colour) {
        let width = 0.5 * radius;
        let half = 0.9 * radius;
        let mut outline = |corners: &[Point]| {
            let corners = corners.iter().chain(&corners[..2]);
            canvas.line(corners.map(|(dx, dy)| (x + dx * radius, y + dy * radius)), width, colour);
        };
        match self {
            Self::Disc => canvas.disc((x, y), radius, colour),
            Self::Square => {
                let (left, top, right, bottom) = (x - half, y - half, x + half, y + half);
                canvas.fill(Area { left, top, right, bottom }, colour);
            }
            Self::Diamond => outline(&[(0.0, -1.1), (1.1, 0.0), (0.0, 1.1), (-1.1, 0.0)]),
            Self::Triangle => outline(&[(0.0, -1.1), (1.05, 0.8), (-1.05, 0.8)]),
            Self::Ring => {
                canvas.disc((x, y), radius, colour);
                canvas.disc((x, y), 0.5 * radius, WHITE);
            }
            Self::Cross => {
                for side in [-1.0, 1.0] {
                    let ends = [(x - side * half, y - half), (x + side * half, y + half)];
                    canvas.line(ends, width, colour);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::colour::INK;

    #[test]
    fn every_marker_has_a_distinct_shape() {
        let drawn = |marker: Marker| {
            let mut canvas = Canvas::default();
            marker.draw(&mut canvas, (10.0, 10.0), 4.0, INK);
            format!("{:?}", canvas.shapes())
        };
        let all: std::collections::HashSet<String> = Marker::ALL.into_iter().map(drawn).collect();
        assert_eq!(all.len(), Marker::ALL.len());
        assert!(all.iter().all(|shapes| shapes != "[]"));
        assert_eq!(Marker::of_index(7), Marker::Square);
    }
}
