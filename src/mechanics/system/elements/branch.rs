//! On which branch of a law with corners a spring is.

/// Where a spring is on a law with corners, and how fast it goes on there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// The number of sharp corners of the law that are behind: a bumper is in touch on one branch and not on the next.
    pub index: usize,
    /// The rate of what the spring measures [length/time, rad/time].
    pub rate: f64,
    /// What the spring measures.
    pub along: Along,
}

/// What a law of a spring goes along.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Along {
    /// The law goes along a length.
    Length,
    /// The law goes along an angle.
    Angle,
}
