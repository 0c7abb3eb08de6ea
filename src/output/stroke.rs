//! Line styles of series.

use super::{
    canvas::{Canvas, Point},
    colour::Colour,
    curve,
};

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Stroke {
    #[default]
    Solid,
    Dashed,
    Dotted,
    Marked,
    MarkersOnly,
}

impl Stroke {
    /// Line style of a series; `round` counts how often the palette has been used completely.
    pub fn of_palette_pass(round: usize) -> Self {
        [Stroke::Solid, Stroke::Dashed, Stroke::Dotted][round % 3]
    }

    pub fn has_marks(self) -> bool {
        matches!(self, Stroke::Marked | Stroke::MarkersOnly)
    }

    /// Draws a piece of a curve [pixels] without its markers.
    pub fn draw(self, canvas: &mut Canvas, run: &[Point], width: f64, colour: Colour) {
        let pattern: &[f64] = match self {
            Stroke::Solid | Stroke::Marked => {
                return canvas.line(run.iter().copied(), width, colour);
            }
            Stroke::MarkersOnly => return,
            Stroke::Dashed => &[7.0, 5.0],
            Stroke::Dotted => &[1.0, 5.0],
        };
        for dash in curve::dashes(run, pattern) {
            canvas.line(dash, width, colour);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::colour::{HUE_COUNT, INK, hue};

    #[test]
    fn strokes_have_the_expected_number_of_dashes() {
        let count = |stroke: Stroke| {
            let mut canvas = Canvas::default();
            stroke.draw(&mut canvas, &[(0.0, 0.0), (24.0, 0.0)], 2.0, INK);
            canvas.shapes().len()
        };
        assert_eq!((count(Stroke::Solid), count(Stroke::Dashed), count(Stroke::Dotted)), (1, 2, 4));
        assert_eq!((count(Stroke::Marked), count(Stroke::MarkersOnly)), (1, 0));
        assert_eq!(Stroke::of_palette_pass(4), Stroke::Dashed);
    }

    #[test]
    fn colours_and_strokes_distinguish_three_times_as_many_beams_as_colours() {
        let looks = |index: usize| {
            format!("{:?} {:?}", hue(index), Stroke::of_palette_pass(index / HUE_COUNT))
        };
        let all: std::collections::BTreeSet<String> = (0..3 * HUE_COUNT).map(looks).collect();
        assert_eq!(all.len(), 3 * HUE_COUNT);
    }
}
