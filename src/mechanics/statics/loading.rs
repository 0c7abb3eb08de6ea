//! Load factor, load steps, and control of the path of equilibria.

use super::StaticsError;
use crate::newton::Tolerance;

/// Smallest number of points of a path: the unloaded configuration, and two equilibria that define a direction.
pub(super) const LEAST_PATH: usize = 3;

/// Loading of a scene: the loads are increased from zero to a load factor in several steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loading {
    /// Time at which the schedules of loads are evaluated [time]. If a schedule jumps, its value after the jump is used.
    pub time: f64,
    /// Final load factor [-]; 1 for the loads of the scene.
    pub factor: f64,
    /// Number of equal load steps. With arc-length control, only the first load step has this size, or the first two if only loads restrain the scene.
    pub steps: usize,
    /// Quantity that is prescribed in each load step.
    pub control: Control,
    /// Tolerance of the Newton solver.
    pub tolerance: Tolerance,
}

/// Quantity that is prescribed in each load step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Control {
    /// Load factor. The path cannot pass a limit point, which is an extremum of the load factor.
    #[default]
    Load,
    /// Distance along the path. The load factor is an unknown and may decrease.
    ArcLength(ArcLength),
}

/// Arc-length control along the path of equilibria.
///
/// References: E. Riks, Int. J. Solids Struct. 15 (1979) 529–551, with the normal plane of Keller (1977).
/// The step size is controlled as in Crisfield, Comput. Struct. 13 (1981) 55–62.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArcLength {
    /// Longest distance between consecutive equilibria [-, rad].
    /// The distance between equilibria is the root mean square of displacements and rotations over all control points.
    /// Displacements are divided by the length of the longest beam, or by the extent of a scene without beams.
    pub longest: f64,
    /// Largest number of points of the path.
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
