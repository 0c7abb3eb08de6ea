//! Dissipative elements of a scene: material damping, drag, obstacles and contacts.

use super::Scene;
use crate::beams::Relaxation;
use crate::system::SystemError;
use crate::system::elements::{Drag, Element, MaterialDamping, Obstacle, PairContact};

impl Scene {
    /// Drag elements, in the order of addition.
    pub fn drags(&self) -> impl Iterator<Item = &Drag> + Clone {
        self.elements.iter().filter_map(|element| match element {
            Element::Drag(drag) => Some(drag),
            _ => None,
        })
    }

    /// Names of dissipative elements other than springs, dampers and brakes, in the order of addition, followed by dissipating sliders.
    /// Material damping has the name of its beam.
    pub fn dissipating(&self) -> impl Iterator<Item = &str> + Clone {
        let own = self.elements.iter().filter_map(|element| match element {
            Element::Damping(damping) => Some(&*damping.name),
            Element::Drag(drag) => Some(&*drag.name),
            Element::Obstacle(obstacle) => Some(&*obstacle.name),
            Element::Contact(contact) => Some(&*contact.name),
            _ => None,
        });
        let sliders = self.sliders.iter().filter(|slider| slider.dissipates());
        own.chain(sliders.map(|slider| slider.name.as_str()))
    }

    /// Adds Kelvin–Voigt material damping to a beam.
    ///
    /// # Errors
    /// Fails if a relaxation time is negative or not finite, or if the beam does not exist or is already damped.
    pub fn add_damping(&mut self, beam: usize, relaxation: Relaxation) -> Result<(), SystemError> {
        let name = self.beams.get(beam).map(|beam| beam.name.clone()).unwrap_or_default();
        self.add_element(Element::Damping(MaterialDamping { name, beam, relaxation }))
    }

    /// Adds drag on a beam or a point.
    ///
    /// # Errors
    /// Fails if the name is taken, a number is out of range, or a body does not exist.
    pub fn add_drag(&mut self, drag: Drag) -> Result<(), SystemError> {
        self.check_name("drag", &drag.name)?;
        self.add_element(Element::Drag(drag))
    }

    /// Obstacles, in the order of addition.
    pub fn obstacles(&self) -> impl Iterator<Item = &Obstacle> + Clone {
        self.elements.iter().filter_map(|element| match element {
            Element::Obstacle(obstacle) => Some(obstacle),
            _ => None,
        })
    }

    /// Contacts among bodies, in the order of addition.
    pub fn contacts(&self) -> impl Iterator<Item = &PairContact> + Clone {
        self.elements.iter().filter_map(|element| match element {
            Element::Contact(contact) => Some(contact),
            _ => None,
        })
    }

    /// Type and name of an obstacle or a contact between bodies with the given name.
    pub fn contact_object(&self, name: &str) -> Option<String> {
        let obstacle = self.obstacles().find(|one| one.name == name).map(Obstacle::object);
        let contact = || self.contacts().find(|one| one.name == name).map(PairContact::object);
        obstacle.or_else(contact)
    }

    /// Adds contact between bodies.
    ///
    /// # Errors
    /// Fails if the name is taken or invalid, a number is out of range, a body does not exist or is listed twice, or there are too few bodies.
    /// Also fails if two particles would have friction.
    pub fn add_contact(&mut self, contact: PairContact) -> Result<(), SystemError> {
        self.check_name("contact", &contact.name)?;
        self.add_element(Element::Contact(contact))
    }

    /// Types and names of sliders with friction.
    pub fn sliders_with_friction(&self) -> impl Iterator<Item = String> {
        let sliders = self.sliders.iter().filter(|slider| slider.has_friction());
        sliders.map(|slider| format!("slider '{}'", slider.name))
    }

    /// Types and names of brakes, and of obstacles and contacts between bodies with friction.
    pub fn elements_with_friction(&self) -> impl Iterator<Item = String> {
        self.elements.iter().filter_map(|element| match element {
            Element::Obstacle(obstacle) if obstacle.friction > 0.0 => Some(obstacle.object()),
            Element::Contact(contact) if contact.friction > 0.0 => Some(contact.object()),
            Element::Spring(brake) if brake.kind.is_brake() => Some(brake.object()),
            _ => None,
        })
    }

    /// Adds an obstacle.
    ///
    /// # Errors
    /// Fails if the name is taken, a number is out of range, or a body does not exist.
    pub fn add_obstacle(&mut self, obstacle: Obstacle) -> Result<(), SystemError> {
        self.check_name("obstacle", &obstacle.name)?;
        self.add_element(Element::Obstacle(obstacle))
    }
}
