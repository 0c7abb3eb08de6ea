//! Definition of the contact between bodies in a scene.

use serde::{Deserialize, Serialize};

use super::forces::{CandidatePair, FrictionOfPair, PairForces};
use super::shape::{AllowedParts, ContactSite, Shape, WHOLE_AXIS};
use crate::beams::BodyIndex;
use crate::geometry::{Basis, Vec2};
use crate::system::SystemError;
use crate::system::elements::contact::{
    ContactLaw, ContactTarget, LEAST_RESTITUTION, NormalLaw, contact_parameters, damping_factor,
};
use crate::system::elements::element::{AssemblyContext, BuiltElement, ElementDef, SceneChecks};

/// Largest distance of the ends of a closed axis, as a fraction of its length.
const CLOSED: f64 = 1e-9;

/// Body, or point of a body, that can touch other bodies, with its radius.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ContactMember {
    /// Body, or point of a body.
    pub target: ContactTarget,
    /// Radius around the axis of a beam, such as half its thickness, or around a point [length].
    pub radius: f64,
}

/// Contact between bodies. Its contact force is a function of the gap between them.
///
/// Bodies that share a joint or a slider do not touch each other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairContact {
    /// Name of the contact in messages and columns.
    pub name: String,
    /// Bodies that can touch each other. A single beam can touch itself.
    pub members: Vec<ContactMember>,
    /// Force per penetration on a point [force/length], or force per length and penetration between two beams [force/length²].
    pub stiffness: f64,
    /// Coefficient of restitution of an impact that the steps resolve [-]; 1 for an elastic contact.
    pub restitution: f64,
    /// Coefficient of friction [-].
    pub friction: f64,
}

impl PairContact {
    /// Type and name of the contact for messages.
    pub fn object(&self) -> String {
        format!("contact '{}'", self.name)
    }

    fn refuse(&self, name: &'static str, value: f64, allowed: &'static str) -> SystemError {
        SystemError::Value { object: self.object(), name, value, allowed }
    }

    fn is_beam(&self, member: usize) -> bool {
        matches!(self.members[member].target, ContactTarget::Beam(_))
    }

    fn rotates(&self, member: usize) -> bool {
        !matches!(self.body(member), BodyIndex::Particle(_))
    }

    /// Friction between two members; `None` without friction.
    /// The total moment of friction on both members is divided between the members in the ratio of their radii.
    /// A particle does not rotate, so the whole moment of friction acts on the body that touches the particle.
    fn friction_of_pair(&self, own: usize, other: usize) -> Option<FrictionOfPair> {
        let radius =
            |member: usize| if self.rotates(member) { self.members[member].radius } else { 0.0 };
        let (own, other) = (radius(own), radius(other));
        let shares = [own, other].map(|radius| radius / (own + other));
        (self.friction > 0.0).then_some(FrictionOfPair { coefficient: self.friction, shares })
    }

    fn body(&self, member: usize) -> BodyIndex {
        match self.members[member].target {
            ContactTarget::Beam(beam) => BodyIndex::Beam(beam),
            ContactTarget::Point(station) => station.body,
        }
    }

    fn candidates(&self, scene: &dyn SceneChecks) -> Vec<CandidatePair> {
        let count = self.members.len();
        let pairs = (0..count).flat_map(|a| (0..count).map(move |b| (a, b)));
        let is_paired = |&(a, b): &(usize, usize)| match (self.is_beam(a), self.is_beam(b)) {
            _ if a == b => count == 1,
            _ if scene.are_connected(self.body(a), self.body(b)) => false,
            (true, false) => false,
            (_, true) => true,
            (false, false) => a < b,
        };
        let damping = damping_factor(self.restitution);
        let candidate = |(own, other): (usize, usize)| {
            let share = if self.is_beam(own) { 0.5 } else { 1.0 };
            let stiffness = share * self.stiffness;
            let radius = self.members[own].radius + self.members[other].radius;
            let elastic = ContactLaw::Disc { stiffness, radius };
            let (law, friction) =
                (NormalLaw { elastic, damping }, self.friction_of_pair(own, other));
            CandidatePair { shape: own, target: other, law, friction }
        };
        pairs.filter(is_paired).map(candidate).collect()
    }
}

impl ElementDef for PairContact {
    fn check(&self, scene: &dyn SceneChecks) -> Result<(), SystemError> {
        let Self { stiffness, restitution, friction, .. } = *self;
        if !(stiffness.is_finite() && stiffness > 0.0) {
            return Err(self.refuse("stiffness", stiffness, "a positive finite number"));
        }
        if !(LEAST_RESTITUTION..=1.0).contains(&restitution) {
            return Err(self.refuse("restitution", restitution, "a number from 0.05 to 1"));
        }
        if !(friction.is_finite() && friction >= 0.0) {
            return Err(self.refuse("friction", friction, "zero or a positive finite number"));
        }
        for ContactMember { target, radius } in &self.members {
            if !(radius.is_finite() && *radius > 0.0) {
                let allowed = "a positive finite number [length]";
                return Err(self.refuse("radius", *radius, allowed));
            }
            scene.check_station("a contact", &target.station())?;
        }
        if self.members.is_empty() || self.members.len() == 1 && !self.is_beam(0) {
            let (count, allowed) =
                (self.members.len() as f64, "at least 2, or 1 beam that touches itself");
            return Err(self.refuse("number of bodies", count, allowed));
        }
        for (at, member) in self.members.iter().enumerate() {
            if self.members[..at].iter().any(|other| other.target == member.target) {
                let body = member.target.describe(scene);
                return Err(SystemError::RepeatedBody { object: self.object(), body });
            }
        }
        let mut particles = (0..self.members.len()).filter(|member| !self.rotates(*member));
        if let (Some(first), Some(second), true) =
            (particles.next(), particles.next(), friction > 0.0)
        {
            let [first, second] = [first, second].map(|at| self.members[at].target.describe(scene));
            return Err(SystemError::FrictionOfParticles { object: self.object(), first, second });
        }
        Ok(())
    }

    fn build(&self, site: &dyn AssemblyContext) -> Result<BuiltElement, SystemError> {
        let candidates = self.candidates(site.scene());
        let shape = |member: &ContactMember| shape(site, member);
        let shapes = self.members.iter().map(shape).collect::<Result<_, _>>()?;
        let forces = PairForces::new(self.name.clone(), shapes, candidates);
        Ok(BuiltElement::Resistance(Box::new(forces)))
    }
}

fn shape(site: &dyn AssemblyContext, member: &ContactMember) -> Result<Shape, SystemError> {
    let radius = member.radius;
    match member.target {
        ContactTarget::Point(station) => {
            let place = site.place(&station)?;
            let touched = Vec::new();
            let site = ContactSite { place, weight: 1.0, allowed: WHOLE_AXIS, touched };
            Ok(Shape::of_point(radius, site))
        }
        ContactTarget::Beam(beam) => {
            let (mesh, controls) = (site.mesh(beam), site.body(beam).control_points());
            let parameters = contact_parameters(mesh, controls);
            let allowed = allowed_parts(mesh.basis(), controls, &parameters, radius);
            let sites = parameters.into_iter().zip(allowed).map(|((xi, weight), allowed)| {
                let place = site.place_at(beam, xi)?;
                Ok(ContactSite { place, weight, allowed, touched: Vec::new() })
            });
            let sites = sites.collect::<Result<_, SystemError>>()?;
            Ok(Shape::of_beam(beam, mesh.basis(), radius, sites))
        }
    }
}

/// Parts of the axis of a beam that each contact point of the same beam can touch.
/// Parts of the axis within the arc length `2π r` of the contact point are excluded, where `r` is the contact radius.
/// Otherwise, a bent beam would touch itself beside the contact point.
/// The arc length `2π r` is half the circumference of a circle with the radius `2r`.
fn allowed_parts(
    basis: &Basis,
    controls: &[Vec2],
    parameters: &[(f64, f64)],
    radius: f64,
) -> Vec<AllowedParts> {
    let spans = basis.spans();
    let position = |xi: f64| {
        let span = spans.iter().find(|span| xi <= span.end).unwrap_or(&spans[spans.len() - 1]);
        basis.evaluate_in(span, xi).combine(0, controls)
    };
    let (mut arc, mut length, mut last): (Vec<(f64, f64)>, _, _) = (Vec::new(), 0.0, None);
    for &(xi, _) in parameters {
        let here = position(xi);
        length += last.map_or(0.0, |last: Vec2| (here - last).norm());
        arc.push((xi, length));
        last = Some(here);
    }
    let parameter = |along: f64| {
        let after = arc.partition_point(|(_, s)| *s < along).clamp(1, arc.len() - 1);
        let ((xi0, s0), (xi1, s1)) = (arc[after - 1], arc[after]);
        xi0 + (xi1 - xi0) * (along - s0) / (s1 - s0)
    };
    let (first, end) = (parameters[0].0, parameters[parameters.len() - 1].0);
    let is_closed = (position(first) - position(end)).norm() <= CLOSED * length;
    let half_circle = 2.0 * std::f64::consts::PI * radius;
    let none = (f64::INFINITY, f64::NEG_INFINITY);
    let before = |along: f64| (f64::NEG_INFINITY, parameter(along));
    let after = |along: f64| (parameter(along), f64::INFINITY);
    let parts = |(_, along): &(f64, f64)| {
        let (low, high) = (along - half_circle, along + half_circle);
        match (low > 0.0, high < length) {
            (true, true) => [before(low), after(high)],
            (false, false) => [none, none],
            (true, false) if is_closed => [(parameter(high - length), parameter(low)), none],
            (false, true) if is_closed => [(parameter(high), parameter(low + length)), none],
            (true, false) => [before(low), none],
            (false, true) => [after(high), none],
        }
    };
    arc.iter().map(parts).collect()
}
