//! Straight lines.

use serde::{Deserialize, Serialize};

use super::error::{finite, finite_point};
use super::knots::check_inside;
use super::{GeometryError, Vec2};
use crate::elementary::hypot;

/// Line segment, `x(ξ) = (1 - ξ) from + ξ to` on `[0, 1]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "(Vec2, Vec2)")]
pub struct Line {
    from: Vec2,
    to: Vec2,
}

impl TryFrom<(Vec2, Vec2)> for Line {
    type Error = GeometryError;

    fn try_from((from, to): (Vec2, Vec2)) -> Result<Self, GeometryError> {
        Self::new(from, to)
    }
}

impl Line {
    pub(super) fn new(from: Vec2, to: Vec2) -> Result<Self, GeometryError> {
        let line = Self {
            from: finite_point("start of the line", from)?,
            to: finite_point("end of the line", to)?,
        };
        if finite("length of the line", line.length())? == 0.0 {
            return Err(GeometryError::ZeroLengthLine { point: from });
        }
        Ok(line)
    }

    pub(super) fn length(&self) -> f64 {
        let chord = self.to - self.from;
        hypot(chord.x, chord.y)
    }

    pub(super) fn derivative(&self, xi: f64, order: usize) -> Result<Vec2, GeometryError> {
        check_inside(xi, 0.0, 1.0)?;
        Ok(match order {
            0 => (1.0 - xi) * self.from + xi * self.to,
            1 => self.to - self.from,
            _ => Vec2::zeros(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_starts_and_ends_exactly_at_its_points() {
        let (from, to) = (Vec2::new(0.1, 8.0), Vec2::new(6.3, -0.7));
        let line = Line::new(from, to).unwrap();
        assert_eq!(
            (line.derivative(0.0, 0).unwrap(), line.derivative(1.0, 0).unwrap()),
            (from, to)
        );
        assert_eq!(line.derivative(0.3, 1).unwrap(), to - from);
        assert_eq!(line.derivative(0.3, 2).unwrap(), Vec2::zeros());
    }

    #[test]
    fn lines_of_zero_or_nonfinite_length_are_rejected() {
        let refusal = |from, to| Line::new(from, to).unwrap_err().to_string();
        let point = Vec2::new(1.0, 2.0);
        assert_eq!(refusal(point, point), "line: start and end are both (1, 2), but must differ");
        assert_eq!(
            refusal(point, Vec2::new(f64::NAN, 0.0)),
            "end of the line is NaN, but must be a finite number"
        );
        assert!(
            refusal(Vec2::new(-1.5e308, 0.0), Vec2::new(1.5e308, 0.0))
                .starts_with("length of the line")
        );
    }
}
