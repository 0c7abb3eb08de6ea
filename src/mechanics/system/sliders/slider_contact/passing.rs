//! Evaluation of the equations of a contact for trial values of the unknowns: in a time step, or between two equilibria.

use super::SliderContact;
use crate::geometry::Vec2;
use crate::joints::{CONTACT_UNKNOWNS, Contact, Equation, MovingSleeve, RotationSlopes, Unit};
use crate::system::bodies::Body;
use crate::system::sliders::SliderState;

/// Evaluation of a contact for trial values of the unknowns, in a time step ([`InStep`]) or between two equilibria ([`AtRest`]).
pub trait Passing {
    fn iterate<'s>(
        slider: &'s mut SliderContact,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
    ) -> (Contact<'s>, [Equation; CONTACT_UNKNOWNS]);

    /// Evaluates the contact: kinematics, and the residuals and units of its equations. The derivatives of the equations are not computed.
    fn iterate_values<'s>(
        slider: &'s mut SliderContact,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
    ) -> (Contact<'s>, [(f64, Unit); CONTACT_UNKNOWNS]) {
        let (contact, equations) = Self::iterate(slider, bodies, increments, unknowns);
        (contact, equations.map(|equation| (equation.value, equation.unit)))
    }

    fn forces<'c>(contact: &'c Contact<'_>) -> impl Iterator<Item = Vec2> + 'c;

    fn slopes<'c>(contact: &'c Contact<'_>) -> impl Iterator<Item = (f64, f64, Vec2)> + 'c;

    /// Derivatives of the equations with respect to rotations; `None` for sliders that are not sleeves, and for released ones.
    fn rotation_slopes(
        slider: &mut SliderContact,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
    ) -> Option<RotationSlopes>;

    /// Derivative of the weights of moments on the master by the sliding increment, as a fraction of the slopes of the basis functions [-].
    const MOMENT_SLOPE: f64;

    /// Length of the chord of the slider's path, as a fraction of the length of the path along the undeformed axis [-].
    fn chord(contact: &Contact<'_>) -> f64;
}

pub struct InStep;

pub struct AtRest;

impl Passing for InStep {
    fn iterate<'s>(
        slider: &'s mut SliderContact,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
    ) -> (Contact<'s>, [Equation; CONTACT_UNKNOWNS]) {
        let law = slider.law();
        let contact = slider.evaluate(bodies, increments, unknowns);
        let mut equations = law.equations(&contact);
        if let Some(friction) = &contact.friction {
            let [.., along] = &mut equations;
            *along = contact.with_friction(friction, *along);
        }
        (contact, equations)
    }

    fn iterate_values<'s>(
        slider: &'s mut SliderContact,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
    ) -> (Contact<'s>, [(f64, Unit); CONTACT_UNKNOWNS]) {
        if slider.active_friction().is_some() {
            let (contact, equations) = Self::iterate(slider, bodies, increments, unknowns);
            return (contact, equations.map(|equation| (equation.value, equation.unit)));
        }
        let law = slider.law();
        let contact = slider.evaluate(bodies, increments, unknowns);
        let values = law.values(&contact);
        (contact, values)
    }

    fn forces<'c>(contact: &'c Contact<'_>) -> impl Iterator<Item = Vec2> + 'c {
        contact.master_forces()
    }

    fn slopes<'c>(contact: &'c Contact<'_>) -> impl Iterator<Item = (f64, f64, Vec2)> + 'c {
        contact.master_force_slopes()
    }

    fn rotation_slopes(
        slider: &mut SliderContact,
        bodies: &[Body],
        increments: &[f64],
        unknowns: &[f64],
    ) -> Option<RotationSlopes> {
        let law = match slider.state {
            SliderState::Sliding => MovingSleeve::Sliding,
            SliderState::Held(_) => MovingSleeve::Held,
            SliderState::Released | SliderState::Separated => return None,
        };
        law.rotation_slopes(&slider.evaluate(bodies, increments, unknowns))
    }

    const MOMENT_SLOPE: f64 = 0.5;

    fn chord(contact: &Contact<'_>) -> f64 {
        contact.tangent().value.norm() / contact.length
    }
}
