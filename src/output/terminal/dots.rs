//! Raster of dots for curves in a terminal. Each character has two by four dots, so that the spacing of dots is about equal in both directions.

use super::Glyphs;
use super::character_grid::TerminalColour;
use crate::output::canvas::{Area, Point};
use crate::output::curve::pieces;

pub const ACROSS: usize = 2;
pub const DOWN: usize = 4;

const BITS: [[u8; DOWN]; ACROSS] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveStyle {
    Solid,
    Dotted,
}

#[derive(Clone, Debug)]
pub struct Dots {
    columns: usize,
    rows: usize,
    cells: Vec<(u8, TerminalColour)>,
}

impl Dots {
    pub fn new(columns: usize, rows: usize) -> Self {
        Self { columns, rows, cells: vec![(0, TerminalColour::Plain); columns * rows] }
    }

    /// Coordinates of the last dot of the raster, counted from zero.
    pub fn last(&self) -> Point {
        let last = |dots: usize| dots.saturating_sub(1) as f64;
        (last(ACROSS * self.columns), last(DOWN * self.rows))
    }

    /// Draws a curve through points [dots], with coordinates from the upper left. Points that are not finite leave a gap.
    pub fn curve(
        &mut self,
        points: impl IntoIterator<Item = Point>,
        trace: CurveStyle,
        ink: TerminalColour,
    ) {
        if self.cells.is_empty() {
            return;
        }
        let (right, bottom) = self.last();
        let every = match trace {
            CurveStyle::Solid => 1,
            CurveStyle::Dotted => 3,
        };
        for piece in pieces(points, &Area { left: 0.0, top: 0.0, right, bottom }) {
            let stops: Vec<(i64, i64)> =
                piece.iter().map(|(x, y)| (x.round() as i64, y.round() as i64)).collect();
            let ways = stops.windows(2).flat_map(|pair| line_dots(pair[0], pair[1]));
            for (x, y) in stops[..1].iter().copied().chain(ways).step_by(every) {
                self.dot(x, y, ink);
            }
        }
    }

    fn dot(&mut self, x: i64, y: i64, ink: TerminalColour) {
        let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) else { return };
        if x < ACROSS * self.columns && y < DOWN * self.rows {
            let (mask, own) = &mut self.cells[y / DOWN * self.columns + x / ACROSS];
            *mask |= BITS[x % ACROSS][y % DOWN];
            *own = ink;
        }
    }

    pub fn drawn(&self) -> impl Iterator<Item = (usize, usize, u8, TerminalColour)> {
        let of_cell = |(at, (mask, ink)): (usize, &(u8, TerminalColour))| {
            (*mask != 0).then(|| (at % self.columns, at / self.columns, *mask, *ink))
        };
        self.cells.iter().enumerate().filter_map(of_cell)
    }
}

/// Dots on the straight line between two dots, without the first (J. E. Bresenham, 1965).
fn line_dots(from: (i64, i64), to: (i64, i64)) -> impl Iterator<Item = (i64, i64)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let steps = dx.abs().max(dy.abs());
    let part = move |whole: i64, step: i64| {
        (2 * whole.abs() * step + steps) / (2 * steps).max(1) * whole.signum()
    };
    (1..=steps).map(move |step| (from.0 + part(dx, step), from.1 + part(dy, step)))
}

impl Glyphs {
    pub(super) fn of_dots(self, mask: u8) -> char {
        match self {
            Self::Braille => char::from_u32(0x2800 + u32::from(mask)).unwrap_or(' '),
            Self::Ascii => ascii_of_dots(mask),
        }
    }
}

fn ascii_of_dots(mask: u8) -> char {
    let rows = |column: usize| (0..DOWN).filter(move |&row| mask & BITS[column][row] != 0);
    let (left, right) = (rows(0).count(), rows(1).count());
    let sum = |column| rows(column).sum::<usize>();
    let (Some(top), Some(bottom)) = (rows(0).chain(rows(1)).min(), rows(0).chain(rows(1)).max())
    else {
        return ' ';
    };
    if left + right > 6 {
        return '#';
    }
    match bottom - top {
        0 | 1 => match top + bottom {
            0 | 1 => '\'',
            2..=4 => '-',
            5 => '.',
            _ => '_',
        },
        _ if left == 0 || right == 0 => '|',
        _ => match (sum(0) * right).cmp(&(sum(1) * left)) {
            std::cmp::Ordering::Less => '\\',
            std::cmp::Ordering::Greater => '/',
            std::cmp::Ordering::Equal => '|',
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(dots: &Dots, glyphs: Glyphs) -> String {
        let mut lines = vec![vec![' '; dots.columns]; dots.rows];
        for (column, row, mask, _) in dots.drawn() {
            lines[row][column] = glyphs.of_dots(mask);
        }
        lines.iter().map(|line| line.iter().collect::<String>()).collect::<Vec<_>>().join("\n")
    }

    fn curve(points: &[Point]) -> Dots {
        let mut dots = Dots::new(4, 2);
        dots.curve(points.iter().copied(), CurveStyle::Solid, TerminalColour::Plain);
        dots
    }

    #[test]
    fn lines_are_drawn_as_braille_dots_or_ascii_characters() {
        let down = curve(&[(0.0, 0.0), (7.0, 7.0)]);
        assert_eq!(drawn(&down, Glyphs::Braille), "⠑⢄  \n  ⠑⢄");
        let level = curve(&[(0.0, 0.0), (7.0, 0.0)]);
        assert_eq!(drawn(&level, Glyphs::Ascii), "''''\n    ");
        let steep = curve(&[(2.0, 7.0), (3.0, 0.0)]);
        assert_eq!(drawn(&steep, Glyphs::Ascii), " |  \n |  ");
        let up = curve(&[(0.0, 7.0), (3.0, 0.0)]);
        assert_eq!(drawn(&up, Glyphs::Ascii), " /  \n/   ");
    }

    #[test]
    fn dotted_line_reaches_its_end_without_gaps() {
        for to in [(7, 3), (-7, 3), (2, -9), (0, 5), (5, 5), (0, 0)] {
            let dots: Vec<_> = [(0, 0)].into_iter().chain(line_dots((0, 0), to)).collect();
            assert_eq!(dots.last(), Some(&to));
            let is_near = |pair: &[(i64, i64)]| {
                (pair[0].0 - pair[1].0).abs().max((pair[0].1 - pair[1].1).abs()) == 1
            };
            assert!(dots.windows(2).all(is_near), "{dots:?}");
        }
    }

    #[test]
    fn nan_points_are_gaps_and_curves_are_clipped() {
        let gap = curve(&[(0.0, 0.0), (f64::NAN, 0.0), (7.0, 0.0)]);
        assert_eq!(drawn(&gap, Glyphs::Ascii), "'  '\n    ");
        let beyond = curve(&[(-1e6, 0.0), (1e6, 0.0), (1e6, 1e6), (f64::INFINITY, 1.0)]);
        assert_eq!(drawn(&beyond, Glyphs::Ascii), "''''\n    ");
        let mut nothing = Dots::new(0, 3);
        nothing.curve([(0.0, 0.0)], CurveStyle::Solid, TerminalColour::Plain);
        assert_eq!(nothing.drawn().count(), 0);
    }
}
