//! Releases of joints, drives, sliders and springs during a run.

use super::Numbering;
use super::assemble::joined;
use crate::beams::BodyDynamics;
use crate::integrators::Constraints;
use crate::joints::Releasable;
use crate::system::mechanism::DofNumbers;
use crate::system::{Scene, System, SystemError};

impl System {
    /// Releases an object of the scene at the present time. Positions and rates are continuous.
    /// `released` lists the objects released earlier. The energy stored in a released spring counts as dissipated.
    /// After a release, the caller must allocate a new work space of the integrator.
    ///
    /// # Errors
    /// Fails if a station lies outside its beam, which cannot occur in a checked scene.
    pub fn release(
        &mut self,
        scene: &Scene,
        released: &[Releasable],
        hold: Releasable,
    ) -> Result<(), SystemError> {
        match hold {
            Releasable::Slider(slider) => self.release_slider(slider),
            Releasable::Spring(spring) => self.release_spring(spring),
            Releasable::Joint(_) | Releasable::Drive(_) => {
                let all: Vec<Releasable> = released.iter().copied().chain([hold]).collect();
                let numbers = self.numbers(scene, &all)?;
                self.renumber(numbers);
            }
        }
        Ok(())
    }

    /// Marks the given joints, drives and springs as released and all others as attached, before a state is restored.
    /// Releases of sliders are part of the state.
    ///
    /// # Errors
    /// Fails if a station lies outside its beam, which cannot occur in a checked scene.
    pub fn restore_releases(
        &mut self,
        scene: &Scene,
        released: &[Releasable],
    ) -> Result<(), SystemError> {
        let numbers = self.numbers(scene, released)?;
        self.renumber(numbers);
        self.detach_springs(released);
        Ok(())
    }

    fn numbers(&self, scene: &Scene, released: &[Releasable]) -> Result<DofNumbers, SystemError> {
        let border = self.constraint_shape().width;
        let meshes = self.meshes();
        let bodies: Vec<&dyn BodyDynamics> =
            self.bodies().iter().map(|body| &*body.dynamics).collect();
        let place = |station: &_| scene.place(station, meshes);
        let numbering = Numbering::new(scene, released, &bodies, border, place)?;
        let (prescribed, held, unknowns) = numbering.supports_and_unknowns(scene, released, border);
        Ok(DofNumbers {
            joined: joined(scene, released, meshes)?,
            contacts: numbering.contact_blocks(scene, self.sliders()),
            links: numbering.links.iter().map(|link| link.force).collect(),
            rollers: numbering
                .rollers
                .iter()
                .map(|roller| roller.map(|(force, _)| force))
                .collect(),
            degrees_of_freedom: numbering.degrees_of_freedom,
            prescribed,
            held,
            unknowns,
        })
    }
}
