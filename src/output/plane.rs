//! Visible part of the plane for plots in which both axes have the same scale.

use super::{
    axis::{PlotAxis, extent},
    canvas::Point,
};

/// Preferred width of a separate plot [pixels].
const WIDTH: f64 = 740.0;
const HEIGHTS: (f64, f64) = (220.0, 700.0);
const LEAST_WIDTH: f64 = 300.0;
/// White space around the data, as a fraction of the size of the data.
const MARGIN: f64 = 0.05;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisLimits {
    pub x: Option<(f64, f64)>,
    pub y: Option<(f64, f64)>,
}

/// Box in the plane, given by its centre and its nonzero width and height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    centre: Point,
    needs: Point,
}

impl View {
    /// Box between the limits of both axes. An axis without limits is fitted to the points inside the limits of the other axis.
    pub fn of(points: impl Iterator<Item = Point> + Clone, limits: &AxisLimits) -> Self {
        let within = |value: f64, ends: Option<(f64, f64)>| {
            ends.is_none_or(|(low, high)| (low..=high).contains(&value))
        };
        let is_seen = |(x, y): &Point| {
            (limits.y.is_some() || within(*x, limits.x))
                && (limits.x.is_some() || within(*y, limits.y))
        };
        let seen = points.filter(is_seen);
        let side = |pick: fn(Point) -> f64, ends: Option<(f64, f64)>| match ends {
            Some((low, high)) => (low / 2.0 + high / 2.0, high - low),
            None => {
                let (low, high) = extent(seen.clone().map(pick)).unwrap_or((-0.5, 0.5));
                (low / 2.0 + high / 2.0, (high - low) * (1.0 + 2.0 * MARGIN))
            }
        };
        let (x, width) = side(|point| point.0, limits.x);
        let (y, height) = side(|point| point.1, limits.y);
        // The box is enlarged, because a horizontal line has no height and a point has no size.
        let size = width.max(height).max(1e-6 * x.abs().max(y.abs()));
        let size = if size > 1e-280 { size } else { 1.0 };
        Self { centre: (x, y), needs: (width.max(0.05 * size), height.max(0.05 * size)) }
    }

    /// Enlarges the box so that symbols drawn at the points `about` are not cut off. The argument `pixels` is the size of the symbols.
    /// Limits have precedence.
    pub fn with_room(
        self,
        about: impl Iterator<Item = Point> + Clone,
        pixels: f64,
        limits: &AxisLimits,
    ) -> Self {
        let (width, height) = self.size();
        let room = pixels * (self.needs.0 / width).max(self.needs.1 / height);
        let side = |(centre, size): (f64, f64), pick: fn(Point) -> f64, ends: Option<_>| {
            let (low, high) = (centre - size / 2.0, centre + size / 2.0);
            match extent(about.clone().map(pick)) {
                Some((least, most)) if least - room < low || most + room > high => {
                    let (low, high) = (low.min(least - room), high.max(most + room));
                    if ends.is_some() {
                        (centre, size)
                    } else {
                        (low / 2.0 + high / 2.0, high - low)
                    }
                }
                _ => (centre, size),
            }
        };
        let (x, width) = side((self.centre.0, self.needs.0), |point| point.0, limits.x);
        let (y, height) = side((self.centre.1, self.needs.1), |point| point.1, limits.y);
        Self { centre: (x, y), needs: (width, height) }
    }

    pub fn shows(&self, (x, y): Point) -> bool {
        let is_within = |at: f64, centre: f64, size: f64| (at - centre).abs() <= size / 2.0;
        is_within(x, self.centre.0, self.needs.0) && is_within(y, self.centre.1, self.needs.1)
    }

    pub fn ends(&self) -> [(f64, f64); 2] {
        let ends = |centre: f64, size: f64| (centre - size / 2.0, centre + size / 2.0);
        [ends(self.centre.0, self.needs.0), ends(self.centre.1, self.needs.1)]
    }

    pub fn limits(&self) -> AxisLimits {
        let [x, y] = self.ends().map(Some);
        AxisLimits { x, y }
    }

    /// Axes for a plot of the given size [pixels].
    pub fn axes(&self, width: f64, height: f64) -> (PlotAxis, PlotAxis) {
        let per_pixel = (self.needs.0 / width).max(self.needs.1 / height);
        let axis = |centre: f64, pixels: f64| {
            let half = per_pixel * pixels / 2.0;
            PlotAxis::between(centre - half, centre + half)
        };
        (axis(self.centre.0, width), axis(self.centre.1, height))
    }

    /// Size of a separate plot [pixels].
    pub fn size(&self) -> (f64, f64) {
        let aspect = self.needs.1 / self.needs.0;
        let tall = (WIDTH * aspect).clamp(HEIGHTS.0, HEIGHTS.1);
        ((tall / aspect).clamp(LEAST_WIDTH, WIDTH), tall)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn view_is_extended_for_symbols_at_an_edge_except_at_limits() {
        let points = [(0.0, 0.0), (10.0, 10.0)];
        for (limits, low) in
            [(AxisLimits::default(), -0.31), (AxisLimits { y: Some((0.0, 10.0)), x: None }, 0.0)]
        {
            let view = View::of(points.into_iter(), &limits);
            let seen = view.with_room([(5.0, 0.0)].into_iter(), 20.0, &limits);
            let bottom = seen.centre.1 - seen.needs.1 / 2.0;
            assert!((bottom - low).abs() < 0.25 && bottom <= 0.0, "{bottom}");
        }
        let view = View::of(points.into_iter(), &AxisLimits::default());
        assert_eq!(view.with_room([(5.0, 5.0)].into_iter(), 20.0, &AxisLimits::default()), view);
    }

    #[test]
    fn limits_of_one_axis_set_the_range_of_the_other() {
        let points = [(0.0, 0.0), (1.0, 1.0), (10.0, 100.0)];
        let view = View::of(points.into_iter(), &AxisLimits { x: Some((0.0, 2.0)), y: None });
        assert_eq!(view.centre, (1.0, 0.5));
        assert_eq!(view.needs.0, 2.0);
        assert!((view.needs.1 - 1.1).abs() < 1e-12);
        let limits = AxisLimits { x: Some((0.0, 2.0)), y: Some((-1.0, 3.0)) };
        assert_eq!(View::of(points.into_iter(), &limits).needs, (2.0, 4.0));
    }
}
