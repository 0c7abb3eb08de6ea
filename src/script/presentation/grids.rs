//! VTK grids of a simulation, with beams as lines through their knots and three points between them, and point masses and rigid bodies as dots.

use crate::beams::BodyPoint;
use crate::geometry::Vec2;
use crate::output::{Point, VtkCell, VtkField, VtkGrid, VtkValues};
use crate::simulation::Simulation;
use crate::system::{BeamPlaces, BeamSample, SystemError};

/// Sample positions on all beams, computed once for all frames.
pub struct Grids {
    names: Vec<String>,
    beams: Vec<BeamPlaces>,
}

const OF_A_PARTICLE: f64 = 0.0;

impl Grids {
    pub fn of(simulation: &Simulation) -> Result<Self, SystemError> {
        let scene = simulation.scene();
        let beams = (0..scene.beams.len())
            .map(|beam| simulation.places_along(beam, BeamPlaces::WITHIN_A_SPAN));
        let names = scene.beams.iter().map(|beam| beam.name.clone());
        let particles = scene.particles.iter().map(|particle| particle.name.clone());
        let bodies = scene.rigid_bodies.iter().map(|body| body.name.clone());
        Ok(Self {
            names: names.chain(particles).chain(bodies).collect(),
            beams: beams.collect::<Result<_, _>>()?,
        })
    }

    pub fn of_configuration(&self, simulation: &Simulation, index: usize) -> VtkGrid {
        let bodies = simulation.control_points_at(index);
        let (of_beams, of_particles) = bodies.split_at(self.beams.len());
        let lines = self.beams.iter().zip(of_beams);
        let lines = lines.map(|(along, points)| along.positions(points).map(plain).collect());
        let centres = of_particles.iter().map(|points| points.iter().take(1));
        let dots = centres.map(|centre| centre.copied().map(plain).collect());
        VtkGrid { cells: self.cells(lines.chain(dots)), fields: vec![self.arc_lengths()] }
    }

    pub fn of_state(&self, simulation: &Simulation) -> VtkGrid {
        let model = simulation.model();
        let samples: Vec<Vec<BeamSample>> =
            self.beams.iter().map(|along| simulation.sample_along(along)).collect();
        let particles: Vec<BodyPoint> =
            (self.beams.len()..self.names.len()).map(BodyPoint::of_particle).collect();
        let lines = samples.iter().map(|line| line.iter().map(|at| plain(at.position)).collect());
        let dots = particles.iter().map(|at| vec![plain(model.position(at))]);
        let along = || samples.iter().flatten();
        let numbers = |name: &str, value: fn(&BeamSample) -> f64| {
            let values = along().map(value);
            let beyond = particles.iter().map(|_| OF_A_PARTICLE);
            field(name, VtkValues::Numbers(values.chain(beyond).collect()))
        };
        let velocities = along().map(|at| plain(at.velocity));
        let velocities = velocities.chain(particles.iter().map(|at| plain(model.velocity(at))));
        let fields = vec![
            self.arc_lengths(),
            field("velocity", VtkValues::Vectors(velocities.collect())),
            numbers("angle", |at| at.angle),
            numbers("N", |at| at.forces.axial),
            numbers("Q", |at| at.forces.shear),
            numbers("M", |at| at.forces.moment),
        ];
        VtkGrid { cells: self.cells(lines.chain(dots)), fields }
    }

    fn cells(&self, points: impl Iterator<Item = Vec<Point>>) -> Vec<VtkCell> {
        let names = self.names.iter().cloned();
        names.zip(points).map(|(name, points)| VtkCell { name, points }).collect()
    }

    fn arc_lengths(&self) -> VtkField {
        let particles = self.names.len() - self.beams.len();
        let along = self.beams.iter().flat_map(BeamPlaces::arc_lengths);
        let values = along.chain(std::iter::repeat_n(OF_A_PARTICLE, particles));
        field("arc_length", VtkValues::Numbers(values.collect()))
    }
}

fn field(name: &str, values: VtkValues) -> VtkField {
    VtkField { name: name.to_owned(), values }
}

fn plain(point: Vec2) -> Point {
    (point.x, point.y)
}
