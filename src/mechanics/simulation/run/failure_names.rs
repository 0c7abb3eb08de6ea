//! Names of the object or degree of freedom at which a step failed.

use super::Simulation;
use crate::beams::Station;
use crate::integrators::{FailureSource, StepError};
use crate::joints::CONTACT_UNKNOWNS;

const MOVEMENTS: [&str; 3] = ["x", "y", "the angle"];

impl Simulation {
    pub(super) fn with_name(&self, mut error: StepError) -> StepError {
        if let StepError::Newton { failure_source, .. } = &mut error {
            let name = failure_source.take().and_then(|failure_source| match *failure_source {
                FailureSource::Unknown(unknown) => self.name_of_unknown(unknown),
                FailureSource::Named(name) => Some(name),
            });
            *failure_source = name.map(|name| Box::new(FailureSource::Named(name)));
        }
        error
    }

    fn name_of_unknown(&self, unknown: usize) -> Option<String> {
        if let Some(of_contact) = unknown.checked_sub(self.model.unknown_count()) {
            let slider = self.scene.sliders.get(of_contact / CONTACT_UNKNOWNS)?;
            return Some(format!("slider '{}'", slider.name));
        }
        if let Some((body, point)) = self.model.linked_by(unknown) {
            return Some(format!("what holds {}", self.name_of_point(body, point)));
        }
        let (body, point, component) = self.model.movement(unknown)?;
        Some(format!("{} of {}", MOVEMENTS[component], self.name_of_point(body, point)))
    }

    fn name_of_point(&self, body: usize, point: usize) -> String {
        if let Some(rigid) = body.checked_sub(self.scene.first_rigid_body()) {
            return self.scene.describe(&Station::on_rigid_body(rigid, point));
        }
        let name = self.scene.name_of_body_at(body);
        match self.model.control_points().nth(body).map_or(1, <[_]>::len) {
            1 => name,
            _ if point == 0 => format!("the start of {name}"),
            count if point + 1 == count => format!("the end of {name}"),
            count => format!("control point {} of {count} of {name}", point + 1),
        }
    }
}
