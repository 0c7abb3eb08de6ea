//! What resists rates in a scene: damped materials and drag.

use super::Scene;
use crate::beams::Relaxation;
use crate::geometry::Vec2;
use crate::joints::Slider;
use crate::system::SystemError;
use crate::system::elements::{Drag, Element, MaterialDamping};

impl Scene {
    /// Drags, in the order in which they were added.
    pub fn drags(&self) -> impl Iterator<Item = &Drag> + Clone {
        self.elements.iter().filter_map(|element| match element {
            Element::Drag(drag) => Some(drag),
            _ => None,
        })
    }

    /// The names of what dissipates besides springs and dampers, in the order in which it was added: of a damped material that of the beam.
    pub fn dissipating(&self) -> impl Iterator<Item = &str> + Clone {
        let own = self.elements.iter().filter_map(|element| match element {
            Element::Damping(damping) => Some(&*damping.name),
            Element::Drag(drag) => Some(&*drag.name),
            _ => None,
        });
        own.chain(self.losing_sliders().map(|slider| slider.name.as_str()))
    }

    /// The sliders that lose energy where they bounce.
    pub fn losing_sliders(&self) -> impl Iterator<Item = &Slider> + Clone {
        self.sliders.iter().filter(|slider| slider.restitution < 1.0)
    }

    /// The names of what drags in a wind.
    pub fn blown(&self) -> impl Iterator<Item = &str> + Clone {
        self.elements.iter().filter_map(|element| match element {
            Element::Drag(drag) if drag.wind != Vec2::zeros() => Some(&*drag.name),
            _ => None,
        })
    }

    /// Gives the material of a beam, by its index, relaxation times: Kelvin–Voigt damping.
    ///
    /// # Errors
    /// When a time is negative or not finite, there is no such beam, or it has damping already.
    pub fn add_damping(&mut self, beam: usize, relaxation: Relaxation) -> Result<(), SystemError> {
        let name = self.beams.get(beam).map(|beam| beam.name.clone()).unwrap_or_default();
        self.add_element(Element::Damping(MaterialDamping { name, beam, relaxation }))
    }

    /// Adds drag.
    ///
    /// # Errors
    /// When something of that name exists, a number of it is out of its range, or a body is none of the scene.
    pub fn add_drag(&mut self, drag: Drag) -> Result<(), SystemError> {
        self.check_name("drag", &drag.name)?;
        self.add_element(Element::Drag(drag))
    }
}
