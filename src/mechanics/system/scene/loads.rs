//! Loads as they are added to a scene.

use super::Scene;
use crate::loads::{Load, LoadKind, Schedule};
use crate::system::SystemError;
use crate::system::elements::Element;

impl Scene {
    /// Adds a load to the scene; its name is made of its kind.
    pub fn add_load(&mut self, kind: LoadKind, schedule: Schedule) {
        let name = self.name_of_load(&kind);
        self.elements.push(Element::Load(Load { name, kind, schedule, title: None }));
    }

    /// Adds a load with a name, by which columns of the history have its work.
    ///
    /// # Errors
    /// When something of that name exists, or a number of it is out of its range.
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

    /// What gives a schedule, in words, by the name under which [`schedules`](Self::schedules) has it: with its title, if it is a load that has one.
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
