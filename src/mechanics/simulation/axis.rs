//! Deformation of beam axes, computed from their control points.

use super::Outline;
use crate::beams::Station;
use crate::geometry::{BasisValues, GeometryError, Vec2, cross};
use crate::system::{Scene, System, SystemError};

/// Initial axes of the beams of a scene.
pub struct Axes<'a> {
    scene: &'a Scene,
    drawn: System,
}

/// Station of a beam, with the slope and the curvature of the initial axis at this station.
#[derive(Debug, Clone)]
pub struct AxisStation {
    values: BasisValues,
    degree: usize,
    drawn_slope: Vec2,
    drawn_curvature: f64,
}

impl<'a> Axes<'a> {
    /// Computes the initial axes of the beams of a scene.
    ///
    /// # Errors
    /// Fails if the scene cannot be built.
    pub fn of(scene: &'a Scene) -> Result<Self, SystemError> {
        Ok(Self { scene, drawn: System::assemble(scene)? })
    }

    /// Returns stations along each beam.
    /// Station `k` of a beam is the point with number `k · Outline::places_a_station(degree)` of its outline.
    ///
    /// # Errors
    /// Fails if a station lies outside its mesh, which would be an internal error.
    pub fn stations(&self) -> Result<Vec<Vec<AxisStation>>, SystemError> {
        let of_beam = |(beam, mesh): (usize, &crate::beams::Mesh)| {
            let every = Outline::places_a_station(mesh.basis().degree());
            let parameters = Outline::parameters(mesh).into_iter().step_by(every);
            parameters.map(|xi| self.at_parameter(beam, xi)).collect()
        };
        self.drawn.meshes().iter().enumerate().map(of_beam).collect()
    }

    /// Returns the axis at a station of a beam; `None` for a particle or a rigid body.
    ///
    /// # Errors
    /// Fails if the station lies outside its beam.
    pub fn at(&self, station: &Station) -> Result<Option<AxisStation>, SystemError> {
        let Some(beam) = station.beam() else { return Ok(None) };
        let xi = station.parameter(&self.scene.beams[beam].axis, &self.drawn.meshes()[beam]);
        let xi = xi.map_err(|source| self.wrong(beam, source))?;
        self.at_parameter(beam, xi).map(Some)
    }

    fn at_parameter(&self, beam: usize, xi: f64) -> Result<AxisStation, SystemError> {
        let basis = self.drawn.meshes()[beam].basis();
        let values = basis.evaluate(xi).map_err(|source| self.wrong(beam, source))?;
        let points = self.drawn.control_points().nth(beam).unwrap_or_default();
        Ok(AxisStation::new(values, basis.degree(), points))
    }

    fn wrong(&self, beam: usize, source: GeometryError) -> SystemError {
        SystemError::Beam { beam: self.scene.beams[beam].name.clone(), source: source.into() }
    }
}

impl AxisStation {
    fn new(values: BasisValues, degree: usize, drawn: &[Vec2]) -> Self {
        let drawn_slope = values.combine(1, drawn);
        let mut station = Self { values, degree, drawn_slope, drawn_curvature: 0.0 };
        station.drawn_curvature = station.turning(drawn);
        station
    }

    /// Position of the station, computed from control points of the beam [length].
    pub fn position(&self, points: &[Vec2]) -> Vec2 {
        self.values.combine(0, points)
    }

    /// Elongation of the axis, `|r'| / |r0'| - 1` [-], with the derivatives `r'` and `r0'` of the present and the initial position.
    pub fn stretch(&self, points: &[Vec2]) -> f64 {
        self.values.combine(1, points).norm() / self.drawn_slope.norm() - 1.0
    }

    /// Change of the curvature of the axis per initial length [1/length], positive counter-clockwise; NaN for elements of degree one.
    /// The change of the curvature differs from the bending strain κ by the derivative of the shear angle.
    pub fn curvature(&self, points: &[Vec2]) -> f64 {
        match self.degree {
            ..=1 => f64::NAN,
            _ => self.turning(points) - self.drawn_curvature,
        }
    }

    /// Unit tangent of the axis, directed towards the end of the beam.
    pub fn direction(&self, points: &[Vec2]) -> Vec2 {
        self.values.combine(1, points).normalize()
    }

    /// Derivative of the axis angle with respect to the initial arc length [1/length].
    fn turning(&self, points: &[Vec2]) -> f64 {
        let (slope, second) = (self.values.combine(1, points), self.values.combine(2, points));
        cross(slope, second) / slope.norm_squared() / self.drawn_slope.norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elementary::{cos, sin};
    use crate::geometry::{Basis, KnotVector, LagrangeBasis};

    fn along(basis: &Basis, place: impl Fn(f64) -> Vec2) -> Vec<Vec2> {
        basis.abscissae().into_iter().map(|xi| place(2.0 * xi)).collect()
    }

    #[test]
    fn axis_station_has_stretch_and_direction_of_the_axis() {
        let basis = Basis::BSpline(KnotVector::uniform(3, 3, 2).unwrap());
        let drawn = along(&basis, |s| Vec2::new(s, 0.0));
        let now = along(&basis, |s| Vec2::new(1.0 - 1.1 * s * sin(0.3), 1.1 * s * cos(0.3)));
        for xi in [0.0, 0.4, 1.0] {
            let station = AxisStation::new(basis.evaluate(xi).unwrap(), 3, &drawn);
            assert!((station.stretch(&now) - 0.1).abs() < 1e-12);
            assert!(station.curvature(&now).abs() < 1e-12);
            assert!((station.direction(&now) - Vec2::new(-sin(0.3), cos(0.3))).norm() < 1e-12);
        }
    }

    #[test]
    fn axis_station_has_the_curvature_at_a_parabola_vertex() {
        let basis = Basis::BSpline(KnotVector::uniform(1, 2, 1).unwrap());
        let drawn = along(&basis, |s| Vec2::new(s, 0.0));
        let now = [Vec2::new(0.0, 0.25), Vec2::new(1.0, -0.25), Vec2::new(2.0, 0.25)];
        let station = AxisStation::new(basis.evaluate(0.5).unwrap(), 2, &drawn);
        assert!((station.curvature(&now) - 0.5).abs() < 1e-12);
        assert!((station.position(&now) - Vec2::new(1.0, 0.0)).norm() < 1e-12);
    }

    #[test]
    fn curvature_of_linear_elements_is_nan() {
        let basis = Basis::Lagrange(LagrangeBasis::uniform(2, 1).unwrap());
        let drawn = along(&basis, |s| Vec2::new(s, 0.0));
        let station = AxisStation::new(basis.evaluate(0.3).unwrap(), 1, &drawn);
        assert!(station.curvature(&drawn).is_nan());
    }
}
