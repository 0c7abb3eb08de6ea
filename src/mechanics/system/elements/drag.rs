//! Definition of drag in air or water in a scene.

use serde::{Deserialize, Serialize};

use super::drag_forces::DragForces;
use super::drag_law::{DragLaw, SpeedLaw};
use super::drag_point::DragPoint;
use super::element::{AssemblyContext, BuiltElement, ElementDef, SceneChecks};
use crate::beams::Station;
use crate::geometry::{GaussRule, Vec2};
use crate::system::SystemError;
use crate::system::errors::finite;

/// Object that experiences drag, with its drag law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Dragged {
    /// A beam with drag along its whole length, with separate drag laws across and along its axis.
    Beam {
        /// Index of the beam with drag.
        beam: usize,
        /// Force per length across the axis.
        normal: SpeedLaw,
        /// Force per length along the axis.
        tangent: SpeedLaw,
    },
    /// A particle, or a station of a beam or a rigid body, with the same drag law in every direction.
    Point {
        /// Station with drag.
        station: Station,
        /// Drag law: force opposite to the velocity as a function of the speed.
        law: SpeedLaw,
    },
}

/// Drag force opposite to the velocity relative to a medium that moves at a uniform velocity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Drag {
    /// Name of the drag element in messages and columns.
    pub name: String,
    /// Object that experiences drag.
    pub on: Dragged,
    /// Velocity of the medium [length/time].
    pub wind: Vec2,
}

impl Drag {
    /// Type and name of the drag element for messages.
    pub fn object(&self) -> String {
        format!("drag '{}'", self.name)
    }

    fn check_law(&self, law: &SpeedLaw, names: [&'static str; 2]) -> Result<(), SystemError> {
        let values = [law.linear, law.quadratic];
        let wrong = names.into_iter().zip(values).find(|(_, x)| !(x.is_finite() && *x >= 0.0));
        match wrong {
            Some((name, value)) => {
                let (object, allowed) = (self.object(), "zero or a positive finite number");
                Err(SystemError::Value { object, name, value, allowed })
            }
            None => Ok(()),
        }
    }
}

impl ElementDef for Drag {
    fn check(&self, setting: &dyn SceneChecks) -> Result<(), SystemError> {
        finite(&self.name, "wind", self.wind.as_slice())?;
        match &self.on {
            Dragged::Beam { beam, normal, tangent } => {
                setting.check_station("a drag", &Station::on_beam(*beam, 0.0))?;
                self.check_law(normal, ["normal", "quadratic normal"])?;
                self.check_law(tangent, ["tangent", "quadratic tangent"])
            }
            Dragged::Point { station, law } => {
                setting.check_station("a drag", station)?;
                self.check_law(law, ["linear", "quadratic"])
            }
        }
    }

    fn coupled(&self, _scene: &dyn SceneChecks) -> Vec<Vec<Station>> {
        match &self.on {
            Dragged::Beam { .. } => Vec::new(),
            Dragged::Point { station, .. } => vec![vec![*station]],
        }
    }

    fn build(&self, site: &dyn AssemblyContext) -> Result<BuiltElement, SystemError> {
        let (law, points) = match &self.on {
            Dragged::Beam { beam, normal, tangent } => {
                let law = DragLaw::Line { normal: *normal, tangent: *tangent };
                (law, points_of_beam(site, *beam)?)
            }
            Dragged::Point { station, law } => {
                (DragLaw::Point(*law), vec![DragPoint::at(&site.place(station)?)])
            }
        };
        let forces = DragForces::new(self.name.clone(), law, points, self.wind);
        Ok(BuiltElement::Resistance(Box::new(forces)))
    }
}

fn points_of_beam(site: &dyn AssemblyContext, beam: usize) -> Result<Vec<DragPoint>, SystemError> {
    let basis = site.mesh(beam).basis();
    let rule = GaussRule::new(basis.degree() + 1).map_err(|error| site.wrong(beam, error))?;
    let controls = site.body(beam).control_points();
    let mut points = Vec::new();
    for span in basis.spans() {
        for (xi, weight) in rule.iter_on(span.start, span.end) {
            let values = basis.evaluate_in(&span, xi);
            let speed = values.combine(1, controls).norm();
            let slope = values.slopes().iter().map(|slope| slope / speed).collect();
            let shape = values.values().to_vec();
            points.push(DragPoint::new((beam, span.first), shape, slope, weight * speed));
        }
    }
    Ok(points)
}
