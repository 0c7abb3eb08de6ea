//! Planar vectors, with their scalar and cross product.

use crate::elementary::sin_cos;

/// Planar vector or point.
pub type Vec2 = nalgebra::Vector2<f64>;

/// Vector `J a = (-a2, a1)`: the vector `a` rotated by +90°.
#[inline]
pub fn perpendicular(a: Vec2) -> Vec2 {
    Vec2::new(-a.y, a.x)
}

/// Cross product `a × b = a1 b2 - a2 b1` of two vectors, positive if `b` is counter-clockwise from `a`.
#[inline]
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Unit vector at `angle` [rad] from the first axis.
#[inline]
pub fn unit(angle: f64) -> Vec2 {
    let (sin, cos) = sin_cos(angle);
    Vec2::new(cos, sin)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cross_product_is_the_dot_product_with_the_perpendicular() {
        let (a, b) = (Vec2::new(2.0, -3.0), Vec2::new(0.5, 7.0));
        assert_eq!(cross(a, b), perpendicular(a).dot(&b));
        assert_eq!(cross(a, a), 0.0);
    }
}
