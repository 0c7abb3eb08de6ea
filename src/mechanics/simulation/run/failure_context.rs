//! Extreme conditions under which a step of any size may fail.

use super::Simulation;
use crate::beams::BodyIndex;
use crate::geometry::{larger, smaller};
use crate::integrators::Method;
use crate::joints::SlidingRule;
use crate::simulation::Axes;
use crate::simulation::warning::short;
use crate::system::{Element, SliderState};

/// Smallest local ratio of the deformed to the initial length of the axis that is not reported as extreme compression [-].
const COMPRESSED: f64 = 0.5;

/// Largest local ratio of the deformed to the initial length of the axis that is not reported as extreme stretching [-].
const STRETCHED: f64 = 1.5;

/// Largest contact force that is not reported as a possible cause of a failed step, as a fraction of the shear stiffness of the beam.
const FOLDING_FORCE: f64 = 0.1;

/// Smallest distance of a slider from an end of its master that is not reported, as a fraction of the length of the master.
/// Very close to an end of the master, a step with the sliding rule `kinked` may fail.
const END_DISTANCE: f64 = 5e-3;

impl Simulation {
    pub(super) fn conditions(&self) -> String {
        let extreme = self.extreme_axes().chain(self.extreme_contacts());
        let others = self.bodies_without_inertia().chain(self.driven_backwards());
        extreme.chain(others).map(|message| format!("; {message}")).collect()
    }

    fn bodies_without_inertia(&self) -> impl Iterator<Item = String> {
        let inertia = |body: usize| -> f64 {
            let masses = self.scene.elements.iter().filter_map(|element| match element {
                Element::PointMass(mass) => Some(mass),
                _ => None,
            });
            let own = masses
                .filter(|mass| matches!(mass.station.body, BodyIndex::Rigid(at, _) if at == body));
            own.map(|mass| mass.rotary_inertia).sum()
        };
        let bodies = self.scene.rigid_bodies.iter().enumerate();
        bodies.filter(move |(index, body)| !body.points.is_empty() && inertia(*index) == 0.0).map(
            |(_, body)| {
                format!(
                    "body '{}' has no rotary inertia, which forces off its centre require; give it an inertia",
                    body.name
                )
            },
        )
    }

    fn driven_backwards(&self) -> impl Iterator<Item = String> {
        let goes_back = self.settings.method == Method::FourthOrder;
        let damping = if goes_back { self.model.most_damping() } else { None };
        damping.into_iter().map(|(name, _)| {
            format!(
                "the method fourth_order has a backward substep, in which the damping of '{name}' adds energy and may prevent a solution; use energy_momentum"
            )
        })
    }

    fn extreme_axes(&self) -> impl Iterator<Item = String> {
        let stations = Axes::of(&self.scene).and_then(|axes| axes.stations()).unwrap_or_default();
        let beams = self.scene.beams.iter().zip(stations).zip(self.model.control_points());
        beams.flat_map(|((beam, stations), points)| {
            let lengths = || stations.iter().map(|station| 1.0 + station.stretch(points));
            let least = lengths().fold(f64::INFINITY, smaller);
            let most = lengths().fold(0.0, f64::max);
            let name = &beam.name;
            let compressed = (least < COMPRESSED).then(|| {
                format!(
                    "the axis of beam '{name}' is compressed to {} % of its initial length, where the direction of its tangent is ill-defined",
                    short(100.0 * least)
                )
            });
            let stretched = (most > STRETCHED).then(|| {
                format!("the axis of beam '{name}' is stretched to {} times its initial length", short(most))
            });
            compressed.into_iter().chain(stretched)
        })
    }

    fn extreme_contacts(&self) -> impl Iterator<Item = String> {
        let sliders = self.scene.sliders.iter().enumerate();
        let slides = |index: usize| self.model.slider_state(index) != SliderState::Released;
        sliders.filter(move |(index, _)| slides(*index)).flat_map(|(index, slider)| {
            let beam = &self.scene.beams[self.model.slider_beam(index)];
            let (name, master) = (&slider.name, &beam.name);
            let [mean, of_kink] = [self.model.contact_force(index), self.model.kink_force(index)];
            let force = larger(mean.norm(), of_kink.norm());
            let pressed = force / beam.section.mean().shear_stiffness;
            let place = self.model.slider_position(index);
            let left = smaller(place, 1.0 - place);
            let pressed = (pressed > FOLDING_FORCE).then(|| {
                format!(
                    "the contact force of slider '{name}' on beam '{master}' is {} times its shear stiffness GA, which folds the axis; reduce the force or increase GA",
                    short(pressed)
                )
            });
            let hovers = (slider.rule == SlidingRule::Kinked && left < END_DISTANCE).then(|| {
                format!(
                    "slider '{name}' is at a distance of {} of the length of beam '{master}' from its end, too close for the kinked rule; use the rule conserving()",
                    short(left)
                )
            });
            pressed.into_iter().chain(hovers)
        })
    }
}
