//! Loads of a scene.

use super::Scene;
use crate::loads::{Load, LoadKind, Schedule};
use crate::system::SystemError;
use crate::system::elements::Element;

impl Scene {
    /// Adds a load with a generated name.
    pub fn add_load(&mut self, kind: LoadKind, schedule: Schedule) {
        let name = self.name_of_load(&kind);
        self.elements.push(Element::Load(Load { name, kind, schedule, title: None }));
        self.choose_meshes_under(self.elements.len() - 1);
    }

    /// Adds a named load. The history contains columns for the work and the value of a named load.
    ///
    /// # Errors
    /// Fails if the name is taken or invalid, a number is not finite, or a station does not exist.
    pub fn add_named_load(
        &mut self,
        title: String,
        kind: LoadKind,
        schedule: Schedule,
    ) -> Result<(), SystemError> {
        self.check_name("load", &title)?;
        let name = self.name_of_load(&kind);
        self.add_element(Element::Load(Load { name, kind, schedule, title: Some(title) }))
    }

    /// Description of the element or drive to which a schedule belongs, from its name in [`schedules`](Self::schedules).
    pub fn source_of_schedule(&self, name: &str) -> String {
        let titles = self.loads().filter(|load| load.name == name);
        let title = titles.filter_map(|load| load.title.as_ref()).next();
        match title {
            Some(title) => format!("'{title}', the {name},"),
            None if self.drives.iter().any(|drive| drive.name == name) => format!("'{name}'"),
            None => format!("the {name}"),
        }
    }

    pub(super) fn name_of_load(&self, kind: &LoadKind) -> String {
        match kind {
            LoadKind::Force { station, .. } => format!("force at {}", self.describe(station)),
            LoadKind::Moment { station, .. } => format!("moment at {}", self.describe(station)),
            LoadKind::Line { beam, .. } => {
                format!("line load on beam '{}'", self.beams[*beam].name)
            }
        }
    }
}
