//! Walls and discs that are fixed to the ground.

use std::f64::consts::PI;

use super::{PlacedSymbol, Symbol};
use crate::elementary::{atan2, cos, hypot, sin};
use crate::output::canvas::{Area, Canvas, Point};
use crate::output::colour::INK;
use crate::output::curve;
use crate::output::frame::Frame;
use crate::output::hatching::hatch_along;
use crate::output::plane::View;

const OUTLINE: f64 = 1.5;
/// Largest diameter of a disc that is drawn without hatching [pixels].
const SMALL: f64 = 20.0;
/// Number of segments of a circle, or of the part of a large circle near the plot.
const SEGMENTS: u32 = 96;
/// Largest distance of an obstacle from the bodies at which the picture shows it, as a fraction of the picture size.
const NEAR: f64 = 0.2;

impl PlacedSymbol {
    pub(in crate::output) fn draw_obstacles(
        symbols: &[Self],
        canvas: &mut Canvas,
        frame: &Frame,
        plot: &Area,
    ) {
        for obstacle in symbols.iter().filter(|placed| placed.symbol.is_obstacle()) {
            let outline = obstacle.outline(|point| frame.place(plot, point), plot);
            let (start, middle) = (outline[0], outline[outline.len() / 2]);
            let width = hypot(middle.0 - start.0, middle.1 - start.1);
            for run in curve::pieces(outline, plot) {
                // A disc of a few pixels has no hatching, whose strokes would leave the disc.
                if width > SMALL {
                    hatch_along(canvas, &run, plot);
                }
                canvas.line(run, OUTLINE, INK);
            }
        }
    }

    /// Polyline along the boundary of an obstacle in `window`. For a tangent `(x, y)`, the ground is on the side `(y, -x)`.
    pub(in crate::output) fn outline(
        &self,
        place: impl Fn(Point) -> Point,
        window: &Area,
    ) -> Vec<Point> {
        let (at, tip) = (place(self.at), place(self.tip()));
        let middle = (0.5 * (window.left + window.right), 0.5 * (window.top + window.bottom));
        let (x, y) = (middle.0 - at.0, middle.1 - at.1);
        let diagonal = hypot(window.width(), window.height());
        if self.symbol == Symbol::Wall {
            let length = hypot(self.direction.0, self.direction.1);
            let normal = (self.direction.0 / length, -self.direction.1 / length);
            let gap = x * normal.0 + y * normal.1;
            let foot = (middle.0 - gap * normal.0, middle.1 - gap * normal.1);
            let end = |along: f64| (foot.0 + along * normal.1, foot.1 - along * normal.0);
            return vec![end(-diagonal), end(diagonal)];
        }
        let radius = hypot(tip.0 - at.0, tip.1 - at.1);
        let (facing, half) = (atan2(y, x), PI * (0.5 * diagonal / radius).min(1.0));
        let point = |index: u32| {
            let angle = facing + half * (1.0 - f64::from(2 * index) / f64::from(SEGMENTS));
            (at.0 + radius * cos(angle), at.1 + radius * sin(angle))
        };
        (0..=SEGMENTS).map(point).collect()
    }

    /// Points of an obstacle that a picture shows besides the bodies in the box `bodies`: a small disc, or the nearest point if it is near.
    pub(in crate::output) fn shown_points(&self, bodies: &View) -> Vec<Point> {
        let [(left, right), (low, high)] = bodies.ends();
        let size = (right - left).max(high - low);
        let ((x, y), (along, up)) = (self.at, self.direction);
        let length = hypot(along, up);
        let (nearest, normal, gap) = match self.symbol {
            Symbol::Disc if 2.0 * length <= size => {
                let (left, right) = ((x - length, y), (x + length, y));
                return vec![left, right, (x, y - length), (x, y + length)];
            }
            Symbol::Disc => {
                let nearest = (x.max(left).min(right), y.max(low).min(high));
                let (along, up) = (nearest.0 - x, nearest.1 - y);
                let distance = hypot(along, up);
                (nearest, (along / distance, up / distance), distance - length)
            }
            Symbol::Wall => {
                let nearest =
                    (if along > 0.0 { left } else { right }, if up > 0.0 { low } else { high });
                let normal = (along / length, up / length);
                (nearest, normal, (nearest.0 - x) * normal.0 + (nearest.1 - y) * normal.1)
            }
            _ => return Vec::new(),
        };
        match gap > 0.0 && gap <= NEAR * size {
            true => vec![(nearest.0 - gap * normal.0, nearest.1 - gap * normal.1)],
            false => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::axis::PlotAxis;
    use crate::output::canvas::Shape;
    use crate::output::plane::AxisLimits;

    const PLOT: Area = Area { left: 100.0, top: 100.0, right: 300.0, bottom: 300.0 };

    fn wall(at: Point, direction: Point) -> PlacedSymbol {
        PlacedSymbol { symbol: Symbol::Wall, at, direction }
    }

    fn disc(at: Point, radius: f64) -> PlacedSymbol {
        PlacedSymbol { symbol: Symbol::Disc, at, direction: (radius, 0.0) }
    }

    fn drawn(obstacle: PlacedSymbol) -> (Vec<Vec<Point>>, Vec<Vec<Point>>) {
        let axis = PlotAxis::between(0.0, 1.0);
        let frame = Frame { x: axis, y: axis, ..Frame::default() };
        let mut canvas = Canvas::default();
        PlacedSymbol::draw_obstacles(&[obstacle], &mut canvas, &frame, &PLOT);
        let lines = canvas.shapes().iter().map(|shape| match shape {
            Shape::Line { points, colour, .. } => (points.clone(), *colour == INK),
            other => panic!("{other:?}"),
        });
        let (outlines, strokes): (Vec<_>, Vec<_>) = lines.partition(|(_, is_outline)| *is_outline);
        let points = |lines: Vec<(Vec<Point>, bool)>| lines.into_iter().map(|(line, _)| line);
        (points(strokes).collect(), points(outlines).collect())
    }

    fn distance((x, y): Point, (to_x, to_y): Point) -> f64 {
        hypot(x - to_x, y - to_y)
    }

    #[test]
    fn wall_crosses_the_plot_with_hatching_behind_its_normal() {
        for (normal, is_behind) in [
            ((0.0, 1.0), (|(_, y)| y >= 250.0) as fn(Point) -> bool),
            ((0.0, -1.0), |(_, y)| y <= 250.0),
        ] {
            let (strokes, outlines) = drawn(wall((-1e6, 0.25), normal));
            let mut ends = outlines.concat();
            ends.sort_by(|a, b| a.0.total_cmp(&b.0));
            assert_eq!(ends.len(), 2);
            let far = |at: usize, to: Point| distance(ends[at], to);
            assert!(far(0, (100.0, 250.0)) < 1e-6 && far(1, (300.0, 250.0)) < 1e-6, "{ends:?}");
            assert!(strokes.len() > 30);
            assert!(strokes.concat().into_iter().all(is_behind), "{normal:?} {strokes:?}");
        }
        assert_eq!(drawn(wall((0.0, 1.5), (0.0, 1.0))), (vec![], vec![]));
    }

    #[test]
    fn inclined_wall_is_clipped_to_the_plot() {
        let (strokes, outlines) = drawn(wall((0.5, 0.5), (-0.6, 0.8)));
        let ends = [(100.0, 275.0), (300.0, 125.0)];
        let is_end = |at: &Point| ends.iter().any(|end| distance(*at, *end) < 1e-9);
        assert!(outlines.len() == 1 && outlines[0].iter().all(is_end), "{outlines:?}");
        let side = |(x, y): Point| 0.6 * (x - 200.0) + 0.8 * (y - 200.0);
        assert!(strokes.concat().into_iter().all(|at| side(at) > -1e-9));
    }

    #[test]
    fn a_disc_is_a_closed_outline_with_hatching_inside() {
        let (strokes, outlines) = drawn(disc((0.5, 0.5), 0.2));
        let radius = |at: &Point| distance(*at, (200.0, 200.0));
        let [outline] = outlines.as_slice() else { panic!("{outlines:?}") };
        assert!(distance(outline[0], outline[outline.len() - 1]) < 1e-9);
        assert!(outline.iter().all(|at| (radius(at) - 40.0).abs() < 1e-9));
        assert!(strokes.len() > 30);
        assert!(strokes.concat().iter().all(|at| radius(at) < 40.0 + 1e-9));
    }

    #[test]
    fn a_small_disc_has_no_hatching() {
        assert!(drawn(disc((0.5, 0.5), 0.04)).0.is_empty());
        let (strokes, _) = drawn(disc((0.5, 0.5), 0.06));
        assert!(strokes.concat().iter().all(|at| distance(*at, (200.0, 200.0)) < 12.0 + 1e-9));
    }

    #[test]
    fn large_disc_is_drawn_accurately_inside_the_plot() {
        for radius in [1.0, 1e2, 1e6] {
            let (_, outlines) = drawn(disc((0.5, 0.25 - radius), radius));
            let [outline] = outlines.as_slice() else { panic!("{radius}: {outlines:?}") };
            let centre = (200.0, 250.0 + 200.0 * radius);
            let sag = |pair: &[Point]| {
                let middle = (0.5 * (pair[0].0 + pair[1].0), 0.5 * (pair[0].1 + pair[1].1));
                200.0 * radius - distance(middle, centre)
            };
            assert!(outline.windows(2).all(|pair| sag(pair) < 0.2), "{radius}");
            let (first, last) = (outline[0], outline[outline.len() - 1]);
            let is_edge =
                |at: Point| (at.0 - 100.0).min(300.0 - at.0).min(300.0 - at.1).abs() < 1e-6;
            assert!(is_edge(first) && is_edge(last), "{radius}: {first:?} {last:?}");
        }
    }

    #[test]
    fn view_is_enlarged_for_discs_and_near_walls() {
        let corners = [(0.0, 0.0), (10.0, 5.0)];
        let bodies = View::of(corners.into_iter(), &AxisLimits::default());
        let shown = |obstacle: PlacedSymbol| obstacle.shown_points(&bodies);
        let [near, ..] = shown(wall((4.0, -1.0), (0.0, 1.0)))[..] else { panic!() };
        assert!((near.1 + 1.0).abs() < 1e-12);
        for hidden in [(4.0, -3.0), (4.0, 2.0), (4.0, 9.0)] {
            assert_eq!(shown(wall(hidden, (0.0, 1.0))), [], "far, across and behind");
        }
        assert_eq!(shown(disc((30.0, 0.0), 2.0))[..2], [(28.0, 0.0), (32.0, 0.0)]);
        let [top] = shown(disc((5.0, -101.0), 100.0))[..] else { panic!() };
        assert!(distance(top, (5.0, -1.0)) < 1e-9, "{top:?}");
        assert_eq!(shown(disc((5.0, -110.0), 100.0)), []);
        let limits = AxisLimits { x: None, y: Some((0.0, 5.0)) };
        let floor = [wall((4.0, -1.0), (0.0, 1.0))];
        let [_, y] = PlacedSymbol::view(&floor, corners.into_iter(), &limits).ends();
        assert_eq!(y, (0.0, 5.0), "limits have precedence");
    }
}
