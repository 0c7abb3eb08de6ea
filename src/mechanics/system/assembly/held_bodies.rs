//! Check of rigid bodies without mass or inertia. Other objects of the scene must determine their motion.

use crate::beams::{BodyIndex, Station};
use crate::joints::Component;
use crate::system::elements::{Dragged, Element};
use crate::system::{Scene, System, SystemError};

impl System {
    /// Rejects a rigid body with a degree of freedom that has neither inertia nor a restraint, because its acceleration is undetermined.
    ///
    /// A restraint is a support, a drive or a tied degree of freedom, or a mass, spring, drag or slider at a point of the body.
    pub(super) fn check_movements_held(&self, scene: &Scene) -> Result<(), SystemError> {
        let inertia = self.diagonal_of_inertia();
        let first = scene.first_rigid_body();
        for (index, body) in scene.rigid_bodies.iter().enumerate() {
            let own = &self.bodies()[first + index].degrees_of_freedom;
            let is_shared = |degree: usize| {
                let others =
                    self.bodies().iter().enumerate().filter(|(at, _)| *at != first + index);
                others
                    .flat_map(|(_, other)| other.degrees_of_freedom.as_flattened())
                    .any(|at| *at == degree)
            };
            let is_met = |degree: usize| {
                degree >= inertia.len() || inertia[degree] > 0.0 || is_shared(degree)
            };
            let [x, y, turned] = own[0];
            let of_points = || own.iter().enumerate().skip(1);
            let is_point_met = |(at, [x, y, _]): (usize, &[usize; 3])| {
                is_met(*x) || is_met(*y) || is_touched(scene, index, at)
            };
            let turns_something = of_points().any(is_point_met) || is_turned(scene, index);
            if !is_met(turned) && !turns_something {
                return Err(SystemError::NoInertia { body: body.name.clone() });
            }
            let is_moved =
                is_met(x) && is_met(y) || (0..own.len()).any(|at| is_touched(scene, index, at));
            if !is_moved && !of_points().any(is_point_met) {
                return Err(SystemError::Massless { body: body.name.clone() });
            }
        }
        Ok(())
    }
}

fn is_touched(scene: &Scene, body: usize, point: usize) -> bool {
    let is_there = |station: &Station| station.body == BodyIndex::Rigid(body, point);
    let springs = scene.springs().filter(|spring| !spring.kind.is_angle());
    let is_dragged = |element: &Element| matches!(element, Element::Drag(drag) if matches!(&drag.on, Dragged::Point { station, .. } if is_there(station)));
    springs.into_iter().any(|spring| spring.stations().any(is_there))
        || scene.sliders.iter().any(|slider| is_there(&slider.slave))
        || scene.elements.iter().any(is_dragged)
}

fn is_turned(scene: &Scene, body: usize) -> bool {
    let is_own =
        |station: &Station| matches!(station.body, BodyIndex::Rigid(own, _) if own == body);
    let mut springs = scene.springs().filter(|spring| spring.kind.is_angle());
    springs.any(|spring| spring.stations().any(is_own))
        || scene
            .drives
            .iter()
            .any(|drive| is_own(&drive.station) && drive.drives(Component::Rotation))
}
