//! Hatched areas and outlines.

use super::{
    canvas::{Area, Canvas},
    colour::AXIS,
};

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
    fn what_lies_beyond_a_plot_is_cut_off_before_it_is_hatched() {
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
