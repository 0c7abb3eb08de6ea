//! Path of a point relative to a disc, for steps that would pass through the disc.

use crate::elementary::square;
use crate::geometry::Vec2;

/// Smallest ratio of the length of a path to its chord in the disc for which the path only grazes the disc [-].
const LONGEST_PATH: f64 = 1e3;

/// Largest chord of a path that only grazes the disc, as a fraction of the radius of the disc [-].
const GRAZING: f64 = 0.1;

pub struct DiscPath {
    /// Vector from the centre of the disc to the point at the start [length].
    pub start: Vec2,
    /// Displacement of the point relative to the centre of the disc [length].
    pub movement: Vec2,
    /// Radius of the disc plus radius of the body around the point [length].
    pub radius: f64,
    pub is_closed: bool,
}

impl DiscPath {
    /// Returns true if the path leads through the disc: from outside to outside, or around its centre by more than 60°.
    /// A chord that is longer than the distance of its ends from the centre subtends more than 60°.
    pub fn passes_through(&self) -> bool {
        let Self { start, movement, radius, is_closed } = *self;
        let length = movement.norm();
        let fraction = -start.dot(&movement) / square(length);
        let is_within = fraction > 0.0 && fraction < 1.0;
        let deepest = start + movement * fraction;
        let nearest_end = start.norm().min((start + movement).norm());
        let half_chord_squared = square(nearest_end.min(radius)) - deepest.norm_squared();
        let is_open = nearest_end >= radius && !is_closed;
        let grazing = (length / LONGEST_PATH).min(GRAZING * radius);
        let allowed = if is_open { grazing } else { nearest_end };
        is_within && 2.0 * half_chord_squared.max(0.0).sqrt() > allowed
    }
}
