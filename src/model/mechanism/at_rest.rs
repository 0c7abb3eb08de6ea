//! The model without inertia: what balances at rest, and how it resists small movements.
//!
//! Movements are counted from the present configuration; rotations are increments of the angle itself, for which the stiffness
//! is the Hessian of the potential energy.

use crate::beams::{Place, RotationIncrement};
use crate::geometry::{Vec2, larger};
use crate::integrators::{Mechanism, Stage};
use crate::joints::Component;
use crate::linalg::BandedMatrix;
use crate::loads::LoadError;
use crate::model::Model;
use crate::model::bodies::Body;
use crate::model::elements::{Action, AppliedLoad};

/// A function that is smaller than this at a place is zero there.
const NO_WEIGHT: f64 = 1e-12;

/// The largest of the forces that meet at rest.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StaticForces {
    /// The largest force: in a section, or of a load [force].
    pub force: f64,
    /// The largest moment: in a section, or of a load [force·length].
    pub moment: f64,
    /// The largest mismatch between the strain of a section force and that of the configuration [-].
    pub strain_mismatch: f64,
}

impl Model {
    /// Gives all loads the values that they have just after a time.
    ///
    /// # Errors
    /// When one has no finite value then: its name, and why.
    pub fn hold_loads_at(&mut self, time: f64) -> Result<(), (String, LoadError)> {
        let hold = |load: &mut AppliedLoad| {
            load.hold_at(time).map_err(|reason| (load.name.clone(), reason))
        };
        self.loads.iter_mut().try_for_each(hold)
    }

    /// The first load that turns with a section, which has no potential.
    pub fn follower(&self) -> Option<&str> {
        let turns = |load: &&AppliedLoad| matches!(load.action, Action::Follower(_));
        self.loads.iter().find(turns).map(|load| load.name.as_str())
    }

    /// Which unknown movements are rotations.
    pub fn rotations(&self) -> &[bool] {
        &self.is_rotation
    }

    /// Takes the section forces of the last movement for a start of the next.
    pub fn begin_movement(&mut self) {
        self.bodies.iter_mut().for_each(|body| body.dynamics.begin_step());
    }

    /// Adds the internal forces minus `load_factor` times the loads, with the section forces as they are.
    pub fn add_static_forces(
        &mut self,
        movements: &[f64],
        load_factor: f64,
        out: &mut [f64],
    ) -> StaticForces {
        let summary = self.add_internal_forces(Stage::End, movements, 1.0, out);
        let (force, moment) = self.subtract_static_loads(movements, load_factor, out);
        StaticForces {
            force: larger(summary.force, load_factor.abs() * force),
            moment: larger(summary.moment, load_factor.abs() * moment),
            strain_mismatch: summary.strain_mismatch,
        }
    }

    /// Adds the condensed internal forces minus `load_factor` times the loads, and their derivative by the movements.
    pub fn add_linearised_static_forces(
        &mut self,
        movements: &[f64],
        load_factor: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    ) {
        self.add_linearised_internal_forces(Stage::End, movements, 1.0, out, tangent);
        self.subtract_linearised_loads(Stage::End, movements, load_factor, out, tangent);
    }

    /// Subtracts `load_factor` times the loads and the weight; returns the largest force and moment of a whole load on a
    /// control point.
    pub fn subtract_static_loads(
        &mut self,
        movements: &[f64],
        load_factor: f64,
        out: &mut [f64],
    ) -> (f64, f64) {
        self.subtract_loads(Stage::End, movements, load_factor, out)
    }

    /// Moves everything, and leaves it at rest there.
    pub fn move_by(&mut self, movements: &[f64]) {
        for body in &mut self.bodies {
            body.gather(movements);
        }
        self.move_gathered(RotationIncrement::Angle);
        self.rates.fill(0.0);
    }

    /// The displacements of the control points of all bodies in a movement [length].
    pub fn displacements(&self, movements: &[f64]) -> Vec<Vec<Vec2>> {
        let of_body = |body: &Body| {
            (0..body.degrees_of_freedom.len()).map(|at| body.vector_at(at, movements)).collect()
        };
        self.bodies.iter().map(of_body).collect()
    }

    /// The forces of the supports on the scene at a place, from forces at rest: force and moment; none where nothing is held.
    ///
    /// Where several bodies are tied to the place, the supports hold all of them.
    pub fn support_force(&self, place: &Place, forces: &[f64]) -> Option<(Vec2, f64)> {
        let first = self.degrees_of_freedom() - self.supports.len();
        let tied = self.tied_nodes(node_of(place)?);
        let mut held = self
            .supports
            .iter()
            .zip(&forces[first..])
            .filter(|(support, _)| tied.contains(&(support.body, support.point)))
            .peekable();
        held.peek()?;
        let mut sum = (Vec2::zeros(), 0.0);
        for (support, force) in held {
            match support.component {
                Component::X => sum.0.x += force,
                Component::Y => sum.0.y += force,
                Component::Rotation => sum.1 += force,
            }
        }
        Some(sum)
    }

    /// A node, and all that joints hold there: bodies and control points.
    fn tied_nodes(&self, node: (usize, usize)) -> Vec<(usize, usize)> {
        let mut nodes = vec![node];
        let mut next = 0;
        while let Some(&at) = nodes.get(next) {
            next += 1;
            for (one, other) in &self.joined {
                for (here, there) in [(one, other), (other, one)] {
                    let there = node_of(there).filter(|there| !nodes.contains(there));
                    if node_of(here) == Some(at) {
                        nodes.extend(there);
                    }
                }
            }
        }
        nodes
    }

    /// Moves trackers and bodies by the movements that the bodies gathered last.
    pub(in crate::model) fn move_gathered(&mut self, rotations: RotationIncrement) {
        let Self { trackers, loads, bodies, .. } = self;
        for tracker in
            trackers.iter_mut().chain(loads.iter_mut().flat_map(AppliedLoad::trackers_mut))
        {
            tracker.advance(bodies[tracker.place.body].moved(), rotations);
        }
        self.bodies.iter_mut().for_each(|body| body.advance(rotations));
    }
}

/// The body and the control point of a place, if it is where a control point is.
fn node_of(place: &Place) -> Option<(usize, usize)> {
    let point = place.nearest_control_point();
    let is_node = place.weights().all(|(at, weight)| at == point || weight.abs() < NO_WEIGHT);
    is_node.then_some((place.body, point))
}
