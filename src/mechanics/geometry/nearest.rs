//! Nearest point of a curve.

use super::{Curve, GeometryError, Vec2};

const SAMPLES: usize = 512;

/// Number of bisections after which the parameter is accurate to rounding.
const HALVINGS: usize = 60;

/// Parameter of the point on a curve that is nearest to a given point. If several points are equally near, the first one is returned.
///
/// Details of the curve may be missed if they are shorter than about 1/500 of the curve.
///
/// # Errors
/// Fails if the curve cannot be evaluated.
pub fn nearest(curve: &Curve, point: Vec2) -> Result<f64, GeometryError> {
    let (start, end) = curve.domain();
    let sample = |index: usize| start + (end - start) * (index as f64 / SAMPLES as f64);
    let mut best = (f64::INFINITY, 0);
    for index in 0..=SAMPLES {
        let distance = (curve.point(sample(index))? - point).norm_squared();
        if distance < best.0 {
            best = (distance, index);
        }
    }
    // Between the neighbours of the nearest sample, the derivative of the squared distance changes sign, unless an end of the curve is nearest.
    let slope = |xi: f64| Ok((curve.point(xi)? - point).dot(&curve.derivative(xi, 1)?));
    let mut low = sample(best.1.saturating_sub(1));
    let mut high = sample((best.1 + 1).min(SAMPLES));
    if slope(low)? >= 0.0 {
        return Ok(low);
    }
    if slope(high)? <= 0.0 {
        return Ok(high);
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if slope(middle)? < 0.0 { low = middle } else { high = middle }
    }
    Ok(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::unit;

    #[test]
    fn nearest_point_to_a_curve_point_is_itself() {
        let arc = Curve::arc(Vec2::new(1.0, 2.0), 3.0, 0.2, 2.9).unwrap();
        let wave =
            Curve::through(&[0.0, 1.0, 2.0, 3.0].map(|x| Vec2::new(x, (2.0 * x).sin()))).unwrap();
        let line = Curve::line(Vec2::zeros(), Vec2::new(3.0, 1.0)).unwrap();
        for curve in [arc, wave, line] {
            let (start, end) = curve.domain();
            for t in [0.0, 1e-3, 0.3, 0.5, 0.95, 1.0] {
                let xi = start + (end - start) * t;
                let found = nearest(&curve, curve.point(xi).unwrap()).unwrap();
                assert!((found - xi).abs() < 1e-14 * (end - start), "{found} for {xi}");
            }
        }
    }

    #[test]
    fn nearest_point_is_the_perpendicular_projection() {
        let arc = Curve::arc(Vec2::zeros(), 2.0, 0.0, 3.0).unwrap();
        let found = arc.point(nearest(&arc, unit(1.2) * 5.0).unwrap()).unwrap();
        assert!((found - unit(1.2) * 2.0).norm() < 1e-14);
        let beyond = arc.point(nearest(&arc, unit(-0.5) * 2.0).unwrap()).unwrap();
        assert!((beyond - Vec2::new(2.0, 0.0)).norm() < 1e-15);
    }
}
