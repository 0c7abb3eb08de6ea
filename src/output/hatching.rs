//! Hatched areas and outlines.

use super::{
    canvas::{Area, Canvas, Point},
    colour::AXIS,
    curve,
};
use crate::elementary::hypot;

const HATCH: f64 = 6.0;

pub fn hatch(canvas: &mut Canvas, area: &Area) {
    let (width, height) = (area.width(), area.height());
    let count = ((width + height) / HATCH) as usize;
    for index in 1..=count {
        let along = index as f64 * HATCH;
        let from = if along <= height {
            (area.left, area.top + along)
        } else {
            (area.left + along - height, area.bottom)
        };
        let to = if along <= width {
            (area.left + along, area.top)
        } else {
            (area.right, area.top + along - width)
        };
        canvas.line([from, to], 1.0, AXIS);
    }
}

/// Draws short strokes on the side `(y, -x)` of a curve with the tangent `(x, y)`.
pub fn hatch_along(canvas: &mut Canvas, run: &[Point], plot: &Area) {
    let mut next = 0.5 * HATCH;
    for pair in run.windows(2) {
        let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        let length = hypot(dx, dy);
        while next <= length {
            let (x, y) = (dx / length, dy / length);
            let foot = (pair[0].0 + next * x, pair[0].1 + next * y);
            let end = (foot.0 + HATCH * (y - x), foot.1 - HATCH * (x + y));
            for piece in curve::pieces([foot, end], plot) {
                canvas.line(piece, 1.0, AXIS);
            }
            next += HATCH;
        }
        next -= length;
    }
}

pub fn outline(canvas: &mut Canvas, area: &Area) {
    let Area { left, top, right, bottom } = *area;
    let corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
    canvas.line(corners, 1.0, AXIS);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::canvas::Shape;

    #[test]
    fn areas_are_clipped_to_the_plot_before_hatching() {
        let plot = Area { left: 0.0, top: 0.0, right: 100.0, bottom: 50.0 };
        let cell = Area { left: -1e300, top: 10.0, right: 30.0, bottom: 1e300 };
        let seen = cell.within(&plot);
        assert_eq!((seen.left, seen.top, seen.right, seen.bottom), (0.0, 10.0, 30.0, 50.0));
    }

    #[test]
    fn a_hatching_stays_in_its_area() {
        let area = Area { left: 10.0, top: 20.0, right: 90.0, bottom: 41.0 };
        let mut canvas = Canvas::default();
        hatch(&mut canvas, &area);
        assert!(canvas.shapes().len() > 10);
        for shape in canvas.shapes() {
            let Shape::Line { points, .. } = shape else { panic!("{shape:?}") };
            for (x, y) in points {
                assert!((10.0..=90.0).contains(x) && (20.0..=41.0).contains(y), "{points:?}");
            }
        }
    }
}
