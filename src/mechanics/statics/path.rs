//! Paths of equilibria that start with the unloaded scene.

use crate::system::SystemState;

/// Equilibrium on a path.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPoint {
    /// Load factor of the equilibrium [-].
    pub load_factor: f64,
    /// Strain energy of the equilibrium [energy].
    pub strain_energy: f64,
    /// Distance of the equilibrium from the previous equilibrium [-, rad].
    /// The distance between equilibria is the root mean square of displacements and rotations over all control points.
    /// Displacements are divided by the length of the longest beam, or by the extent of a scene without beams.
    pub distance: f64,
    /// Number of Newton iterations from the previous point of the path.
    pub iterations: usize,
    /// State of the model at the point of the path.
    pub state: SystemState,
}

/// Sequence of equilibria that starts with the unloaded scene.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct EquilibriumPath {
    points: Vec<PathPoint>,
}

impl EquilibriumPath {
    pub(super) fn push(&mut self, point: PathPoint) {
        self.points.push(point);
    }

    pub(super) fn pop(&mut self) {
        self.points.pop();
    }

    pub(super) fn append_dry_point(&mut self, load_factor: f64) {
        let last = self.points.last().cloned();
        self.points.extend(last.map(|point| PathPoint { load_factor, ..point }));
    }

    /// Points of the path of equilibria, in order.
    pub fn points(&self) -> &[PathPoint] {
        &self.points
    }

    /// Load factor at the end of the path [-].
    pub fn load_factor(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.load_factor)
    }

    /// Limit points: extrema of the load factor along the path [-], computed from parabolas through three points.
    ///
    /// If the load increases beyond a limit point, the structure snaps through.
    pub fn limit_points(&self) -> Vec<f64> {
        let turn = |three: &[PathPoint]| {
            let factors = [0, 1, 2].map(|at: usize| three[at].load_factor);
            Some(vertex(factors, [three[1].distance, three[2].distance])?.load_factor)
        };
        self.points.windows(3).filter_map(turn).collect()
    }
}

pub(super) struct LoadTurningPoint {
    /// Distance from the first of three equilibria to the extremum of the parabola through their load factors,
    /// in the norm of displacements and rotations.
    pub(super) distance: f64,
    pub(super) load_factor: f64,
}

pub(super) fn vertex(
    [first, second, third]: [f64; 3],
    [before, after]: [f64; 2],
) -> Option<LoadTurningPoint> {
    let (rise, fall) = ((second - first) / before, (third - second) / after);
    let curvature = (fall - rise) / (before + after);
    let at = 0.5 * (before - rise / curvature);
    let load_factor = first + rise * at + curvature * at * (at - before);
    (rise * fall < 0.0).then_some(LoadTurningPoint { distance: at, load_factor })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(places: &[f64], load_factor: impl Fn(f64) -> f64) -> EquilibriumPath {
        let before = std::iter::once(&0.0).chain(places);
        let point = |(at, before): (&f64, &f64)| PathPoint {
            load_factor: load_factor(*at),
            strain_energy: 0.0,
            distance: at - before,
            iterations: 0,
            state: SystemState::default(),
        };
        EquilibriumPath { points: places.iter().zip(before).map(point).collect() }
    }

    #[test]
    fn limit_points_are_parabola_vertices_for_any_step_lengths() {
        let limits = path(&[0.0, 0.9, 1.7, 3.0, 3.5, 5.0], |s| 2.0 - (s - 2.25).powi(2));
        let limits = limits.limit_points();
        assert!(limits.len() == 1 && (limits[0] - 2.0).abs() < 1e-14, "{limits:?}");
        assert!(path(&[0.0, 0.5, 1.0], |s| s).limit_points().is_empty());
        assert_eq!(path(&[], |s| s).load_factor(), 0.0);
    }
}
