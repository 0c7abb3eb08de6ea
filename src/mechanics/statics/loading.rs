//! How loads are put on, and how the path of equilibria is followed.

use super::StaticsError;
use crate::newton::Tolerance;

/// The fewest points of a path: one that is not loaded and two that say where it goes.
pub(super) const LEAST_PATH: usize = 3;

/// How loads are put on a scene: from nothing to the whole of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loading {
    /// The time at which loads are taken from their schedules, just after it [time].
    pub time: f64,
    /// The load factor at the end: the loads themselves for 1 [-].
    pub factor: f64,
    /// The number of equal steps in which loads are put on; under arc-length control the first step is to the load factor over this.
    pub steps: usize,
    /// The quantity that is prescribed in a step.
    pub control: Control,
    /// The tolerance of the Newton solver.
    pub tolerance: Tolerance,
}

/// What is prescribed in a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Control {
    /// The load factor is prescribed in a step. The path ends at a limit point.
    #[default]
    Load,
    /// The distance by which the scene moves is prescribed in a step; the load factor follows, and may fall.
    ArcLength(ArcLength),
}

/// Steps of arc-length control along the path of equilibria.
///
/// E. Riks, An incremental approach to the solution of snapping and buckling problems, Int. J. Solids Struct. 15 (1979)
/// 529–551, with the normal plane of Keller (1977); the size of steps as in Crisfield, Comput. Struct. 13 (1981) 55–62.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcLength {
    /// The longest step along the path: root mean square of the displacements, relative to the longest beam, and the rotations of all
    /// control points [-, rad].
    pub longest: f64,
    /// The largest number of points of the path, which ends with them wherever it is.
    pub points: usize,
}

impl Default for Loading {
    fn default() -> Self {
        Self {
            time: 0.0,
            factor: 1.0,
            steps: 1,
            control: Control::default(),
            tolerance: Tolerance::default(),
        }
    }
}

impl Default for ArcLength {
    fn default() -> Self {
        Self { longest: 0.05, points: 1000 }
    }
}

impl Loading {
    /// Checks the numbers of the loading.
    ///
    /// # Errors
    /// When a number is out of its range.
    pub(super) fn check(&self) -> Result<(), StaticsError> {
        let value = |name, value, allowed| Err(StaticsError::Value { name, value, allowed });
        if self.steps == 0 {
            return value("load_steps", 0.0, "at least 1");
        }
        if !(self.factor.is_finite() && self.factor != 0.0) {
            return value("load_factor", self.factor, "a finite number other than 0");
        }
        if !self.time.is_finite() {
            return value("time", self.time, "a finite number");
        }
        match self.control {
            Control::ArcLength(ArcLength { longest, .. }) if longest.is_nan() || longest <= 0.0 => {
                value("longest", longest, "a positive number")
            }
            Control::ArcLength(ArcLength { points, .. }) if points < LEAST_PATH => {
                value("points", points as f64, "at least 3")
            }
            _ => Ok(()),
        }
    }
}
