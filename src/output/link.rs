//! Symbols between two points: springs and dampers, in pixels.

use super::canvas::Point;
use crate::elementary::hypot;

pub const LINK: f64 = 1.2;
/// Largest length of the straight ends of a spring: in pixels, and as a fraction of the length of the spring.
const LEAD: (f64, f64) = (8.0, 0.15);
/// Preferred length of a coil of a spring [pixels].
const TURN: f64 = 12.0;
const TURNS: (f64, f64) = (3.0, 12.0);
/// Half width of a spring and of the cylinder of a damper [pixels].
const BREADTH: f64 = 5.0;
/// Largest half length of the cylinder of a damper: in pixels, and as a fraction of the length of the damper.
const CYLINDER: (f64, f64) = (9.0, 0.2);

pub struct Link {
    from: Point,
    along: Point,
    length: f64,
}

impl Link {
    pub fn between(from: Point, to: Point) -> Self {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let length = hypot(x, y);
        let along = if length > 0.0 { (x / length, y / length) } else { (1.0, 0.0) };
        Self { from, along, length }
    }

    fn at(&self, (ahead, aside): (f64, f64)) -> Point {
        let (x, y) = self.along;
        (self.from.0 + ahead * x - aside * y, self.from.1 + ahead * y + aside * x)
    }

    pub fn ends(&self) -> Vec<Point> {
        vec![self.from, self.at((self.length, 0.0))]
    }

    /// Zigzag line whose number of coils increases, within limits, with the distance of its ends.
    pub fn spring(&self) -> Vec<Vec<Point>> {
        let lead = LEAD.0.min(LEAD.1 * self.length);
        let teeth = 2.0 * (self.length / TURN).round().clamp(TURNS.0, TURNS.1);
        let tooth = |index: u32| {
            let ahead = lead + (f64::from(index) + 0.5) * (self.length - 2.0 * lead) / teeth;
            (ahead, if index.is_multiple_of(2) { BREADTH } else { -BREADTH })
        };
        let zigzag = (0..teeth as u32).map(tooth);
        let (begin, end) =
            ([(0.0, 0.0), (lead, 0.0)], [(self.length - lead, 0.0), (self.length, 0.0)]);
        vec![begin.into_iter().chain(zigzag).chain(end).map(|at| self.at(at)).collect()]
    }

    pub fn damper(&self) -> Vec<Vec<Point>> {
        let (middle, half) = (0.5 * self.length, CYLINDER.0.min(CYLINDER.1 * self.length));
        let (bottom, rim) = (middle - half, middle + half);
        let lines: [&[(f64, f64)]; 4] = [
            &[(0.0, 0.0), (bottom, 0.0)],
            &[(rim, BREADTH), (bottom, BREADTH), (bottom, -BREADTH), (rim, -BREADTH)],
            &[(middle, 0.8 * BREADTH), (middle, -0.8 * BREADTH)],
            &[(middle, 0.0), (self.length, 0.0)],
        ];
        lines.into_iter().map(|line| line.iter().map(|at| self.at(*at)).collect()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawn_spring_has_more_turns_with_length_and_constant_width() {
        let teeth = |length: f64| {
            let spring = Link::between((0.0, 0.0), (0.0, length)).spring().concat();
            assert!(spring.iter().all(|(x, _)| x.abs() <= BREADTH));
            assert_eq!((spring[0], spring[spring.len() - 1]), ((0.0, 0.0), (0.0, length)));
            spring.len() - 4
        };
        assert_eq!([teeth(10.0), teeth(60.0), teeth(1000.0)], [6, 10, 24]);
    }

    #[test]
    fn links_of_zero_length_are_drawn_with_finite_points() {
        let link = Link::between((3.0, 4.0), (3.0, 4.0));
        let all = link.damper().into_iter().chain(link.spring()).flatten();
        assert!(all.into_iter().all(|(x, y)| x.is_finite() && y.is_finite()));
    }
}
