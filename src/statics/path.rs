//! Equilibria one after another, from the unloaded scene on.

use crate::model::ModelState;

/// An equilibrium of a path.
#[derive(Debug, Clone, PartialEq)]
pub struct PathPoint {
    /// The part of the loads that acts [-].
    pub load_factor: f64,
    /// [energy]
    pub strain_energy: f64,
    /// Newton iterations that it took from the point before.
    pub iterations: usize,
    /// The configuration.
    pub state: ModelState,
}

/// Equilibria in the order in which they were found; the first is the unloaded scene.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Path {
    points: Vec<PathPoint>,
}

impl Path {
    pub(super) fn push(&mut self, point: PathPoint) {
        self.points.push(point);
    }

    /// Adds a point at which nothing has moved.
    pub(super) fn pretend(&mut self, load_factor: f64) {
        let last = self.points.last().cloned();
        self.points.extend(last.map(|point| PathPoint { load_factor, ..point }));
    }

    /// All points.
    pub fn points(&self) -> &[PathPoint] {
        &self.points
    }

    /// The load factor at its end [-].
    pub fn load_factor(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.load_factor)
    }

    /// The load factors at which it turns, by parabolas through three points each [-].
    ///
    /// A structure that is loaded further there snaps through.
    pub fn limit_points(&self) -> Vec<f64> {
        let factors: Vec<f64> = self.points.iter().map(|point| point.load_factor).collect();
        let turn = |three: &[f64]| {
            let (before, after) = (three[1] - three[0], three[2] - three[1]);
            // Where the parabola through the values at -1, 0 and 1 has its vertex.
            let (slope, curvature) = (0.5 * (before + after), after - before);
            (before * after < 0.0).then(|| three[1] - 0.5 * slope * slope / curvature)
        };
        factors.windows(3).filter_map(turn).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(factors: &[f64]) -> Path {
        let point = |load_factor: &f64| PathPoint {
            load_factor: *load_factor,
            strain_energy: 0.0,
            iterations: 0,
            state: ModelState::default(),
        };
        Path { points: factors.iter().map(point).collect() }
    }

    #[test]
    fn limit_points_are_vertices_of_parabolas() {
        let factors: Vec<f64> = (0..6).map(|i| 2.0 - (f64::from(i) - 2.25).powi(2)).collect();
        let limits = path(&factors).limit_points();
        assert!(limits.len() == 1 && (limits[0] - 2.0).abs() < 1e-15, "{limits:?}");
        assert!(path(&[0.0, 0.5, 1.0]).limit_points().is_empty());
        assert_eq!(path(&[]).load_factor(), 0.0);
    }
}
