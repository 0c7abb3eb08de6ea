//! Present branch of a spring on a piecewise linear law.

/// Present segment of a spring on a piecewise linear law, and the rate of its elongation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// Number of sharp corners of the law below the present elongation.
    pub index: usize,
    /// Rate of the elongation [length/time, rad/time].
    pub rate: f64,
    /// Quantity on which the law of the spring depends.
    pub along: Along,
}

/// Quantity on which the law of a spring depends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Along {
    /// Length of the spring.
    Length,
    /// Angle of the spring.
    Angle,
}
