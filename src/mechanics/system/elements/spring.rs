//! Definitions of springs, dampers, tendons and brakes in a scene.

use serde::{Deserialize, Serialize};

use super::brake::{Brake, BrakeLaw};
use super::damping_law::DampingLaw;
use super::element::{AssemblyContext, BuiltElement, ElementDef, SceneChecks};
use super::elongation::{Elongation, ElongationEnd};
use super::point_damper::PointDamper;
use super::rest_motion::{PrescribedRest, RestMotion};
use super::spring_damper::SpringDamper;
use super::spring_law::SpringLaw;
use super::zero_length_spring::ZeroLengthSpring;
use crate::beams::{BodyIndex, Station};
use crate::geometry::Vec2;
use crate::loads::{DeclaredJump, LimitSide, LoadError, PrescribedMotion, Schedule};
use crate::system::{SystemError, Turning};

/// Attachment of a spring.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Anchor {
    /// Station of a beam or a rigid body, or a particle.
    Station(Station),
    /// Point of the ground [length].
    Ground(Vec2),
}

/// Quantity measured by a spring.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum SpringKind {
    /// Length of the path through the given points. A spring or damper has two points.
    /// A tendon has more than two points, and slides over its intermediate points without friction.
    Length(Vec<Anchor>),
    /// Angle of the section at the second point minus the angle of the section at the first point. The ground does not rotate.
    Torsion([Anchor; 2]),
    /// Angle as in [`Self::Torsion`], between the sections of a brake or clutch.
    Brake {
        /// Attachments of the brake.
        sections: [Anchor; 2],
        /// Friction of the brake.
        law: BrakeLaw,
    },
}

impl SpringKind {
    /// Returns true if the quantity is an angle.
    pub fn is_angle(&self) -> bool {
        !matches!(self, Self::Length(_))
    }

    /// Returns true for a brake or clutch.
    pub fn is_brake(&self) -> bool {
        matches!(self, Self::Brake { .. })
    }
}

/// Configuration of zero elongation in a force law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Origin {
    /// The argument of the law is the length or angle.
    Zero,
    /// The argument of the law is the change of the length or angle from the initial configuration on the meshes.
    AsBuilt,
}

/// Spring, damper, or both in parallel, or a brake.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Spring {
    /// Name in messages and columns.
    pub name: String,
    /// Quantity on which the forces depend.
    pub kind: SpringKind,
    /// Force as a function of the length or angle; `None` for a pure damper or a brake.
    pub law: Option<SpringLaw>,
    /// Configuration of zero elongation in the law.
    pub origin: Origin,
    /// Damping force as a function of the rate of the length or angle, minus the rate of a prescribed rest length or angle.
    pub damping: DampingLaw,
    /// Rest length or rest angle as a function of time, which is subtracted from the argument of the law; `None` if the law alone determines it.
    pub rest: Option<PrescribedRest>,
}

impl Spring {
    /// Attachments of the spring, in their order.
    pub fn anchors(&self) -> &[Anchor] {
        match &self.kind {
            SpringKind::Length(anchors) => anchors,
            SpringKind::Torsion(anchors) | SpringKind::Brake { sections: anchors, .. } => anchors,
        }
    }

    /// Attachments that are stations of bodies.
    pub fn stations(&self) -> impl Iterator<Item = &Station> {
        self.anchors().iter().filter_map(|anchor| match anchor {
            Anchor::Station(station) => Some(station),
            Anchor::Ground(_) => None,
        })
    }
}

impl ElementDef for Spring {
    fn check(&self, setting: &dyn SceneChecks) -> Result<(), SystemError> {
        let refused = |name, value, allowed| {
            Err(SystemError::Value { object: self.object(), name, value, allowed })
        };
        for station in self.stations() {
            setting.check_station("a spring", station)?;
            if self.kind.is_angle() && !station.turns() {
                let by = Turning::TorsionSpring;
                return Err(SystemError::ParticleTurned { object: self.object(), by });
            }
        }
        for anchor in self.anchors() {
            if let Anchor::Ground(at) = anchor
                && let Some(wrong) = at.iter().find(|value| !value.is_finite())
            {
                return refused("point on the ground", *wrong, "a finite number [length]");
            }
        }
        self.check_movable(setting)?;
        match self.damping {
            DampingLaw::Linear(constant) if !(constant.is_finite() && constant >= 0.0) => {
                return refused("damping", constant, "zero or a positive finite number");
            }
            DampingLaw::Linear(_) => (),
            DampingLaw::Curve(_) => self.check_damping(self.damping.corners())?,
        }
        if let Some(feeding) = self.damping.active_range() {
            let (damper, feeding) = (self.object(), feeding.to_string());
            return Err(SystemError::ActiveDamper { damper, active_range: feeding });
        }
        match &self.law {
            Some(SpringLaw::Linear { stiffness, natural }) => {
                if !(stiffness.is_finite() && *stiffness > 0.0) {
                    return refused("stiffness", *stiffness, "a positive finite number");
                }
                let is_length = !self.kind.is_angle() && self.origin == Origin::Zero;
                if !(natural.is_finite() && (*natural >= 0.0 || !is_length)) {
                    let allowed = "zero or a positive finite number [length]";
                    return refused("length", *natural, allowed);
                }
            }
            Some(SpringLaw::Table { points } | SpringLaw::Sampled { points, .. }) => {
                self.expect_points("table", points)?;
                if let Some(index) = first_non_increasing(points) {
                    let (elongation, before) = (points[index].0, points[index - 1].0);
                    let object = self.object();
                    return Err(SystemError::TableOrder { object, index, elongation, before });
                }
                self.check_finite("table", points)?;
            }
            None if let SpringKind::Brake { law, .. } = &self.kind => law.check(&self.object())?,
            None if !self.damping.is_active() => {
                return refused("damping", 0.0, "a positive number if there is no stiffness");
            }
            None => (),
        }
        self.check_rest()
    }

    fn coupled(&self, _scene: &dyn SceneChecks) -> Vec<Vec<Station>> {
        vec![self.stations().copied().collect()]
    }

    fn schedule(&self) -> Option<(&str, &Schedule)> {
        let of_brake = match &self.kind {
            SpringKind::Brake { law, .. } => Some(&law.limit),
            SpringKind::Length(_) | SpringKind::Torsion(_) => None,
        };
        let of_rest = self.rest.as_ref().map(|rest| rest.motion.schedule());
        Some((&self.name, of_brake.or(of_rest)?))
    }

    fn build(&self, site: &dyn AssemblyContext) -> Result<BuiltElement, SystemError> {
        let (mut terminals, mut at, mut grounds) = (Vec::new(), Vec::new(), Vec::new());
        let mut angles = Vec::new();
        for anchor in self.anchors() {
            match anchor {
                Anchor::Station(station) => {
                    let place = site.place(station)?;
                    at.push(place.interpolate(site.body(place.body).control_points()));
                    angles.push(place.tangent_angle);
                    terminals.push(ElongationEnd::Moving(place));
                    grounds.push(None);
                }
                Anchor::Ground(point) => {
                    at.push(*point);
                    angles.push(0.0);
                    terminals.push(ElongationEnd::Ground);
                    grounds.push(Some(*point));
                }
            }
        }
        if let (Some(SpringLaw::Linear { stiffness, natural: 0.0 }), Origin::Zero, [from, to]) =
            (&self.law, self.origin, terminals.as_slice())
            && matches!(self.kind, SpringKind::Length(_))
            && self.rest.is_none()
        {
            return Ok(BuiltElement::Resistance(Box::new(ZeroLengthSpring::new(
                &self.name,
                [from.clone(), to.clone()],
                [at[0], at[1]],
                &grounds,
                *stiffness,
                self.damping.with_corner_at_rest(),
            ))));
        }
        if let (None, SpringKind::Length(_), [from, to]) = (&self.law, &self.kind, &terminals[..]) {
            return Ok(BuiltElement::Resistance(Box::new(PointDamper::new(
                self.name.clone(),
                [from.clone(), to.clone()],
                [at[0], at[1]],
                &grounds,
                self.damping.with_corner_at_rest(),
            ))));
        }
        if let (Some(law), SpringKind::Length(_), [from, to]) =
            (&self.law, &self.kind, &terminals[..])
            && self.damping.is_active()
            && self.rest.is_none()
        {
            let (from_to, places) = ([from.clone(), to.clone()], [at[0], at[1]]);
            let origin = match self.origin {
                Origin::Zero => 0.0,
                Origin::AsBuilt => (places[1] - places[0]).norm(),
            };
            if law.is_unloaded_at(-origin) {
                return Ok(BuiltElement::Resistance(Box::new(ZeroLengthSpring::of_law(
                    &self.name,
                    from_to,
                    places,
                    &grounds,
                    (law.clone(), origin),
                    self.damping.with_corner_at_rest(),
                ))));
            }
        }
        let elongation = match (&self.kind, terminals.as_slice()) {
            (SpringKind::Torsion(_) | SpringKind::Brake { .. }, [from, to]) => {
                Elongation::angle([from.clone(), to.clone()], angles[1] - angles[0])
            }
            _ => Elongation::path_length(terminals, &at),
        };
        if let SpringKind::Brake { law, .. } = &self.kind {
            let brake = Brake::new(self.name.clone(), elongation, law.clone());
            return Ok(BuiltElement::Resistance(Box::new(brake)));
        }
        Ok(BuiltElement::Resistance(Box::new(self.build_spring_damper(elongation, grounds))))
    }
}

fn first_non_increasing(points: &[(f64, f64)]) -> Option<usize> {
    points.windows(2).position(|pair| pair[1].0 <= pair[0].0).map(|before| before + 1)
}

impl Spring {
    fn build_spring_damper(
        &self,
        mut elongation: Elongation,
        grounds: Vec<Option<Vec2>>,
    ) -> SpringDamper {
        let origin = match (&self.rest, self.origin) {
            (Some(rest), _) => rest.start.unwrap_or(elongation.drawn()),
            (None, Origin::Zero) => 0.0,
            (None, Origin::AsBuilt) => elongation.drawn(),
        };
        elongation.rest = self.rest.as_ref().map(|rest| {
            let lowest = if self.kind.is_angle() { f64::NEG_INFINITY } else { 0.0 };
            Box::new(RestMotion::new(rest.motion.clone(), origin, lowest))
        });
        let law = self.law.clone().map(|law| (law, origin));
        let damping = self.damping.with_corner_at_rest();
        SpringDamper::new(self.name.clone(), elongation, grounds, law, damping)
    }

    fn check_damping(&self, points: &[(f64, f64)]) -> Result<(), SystemError> {
        let name = "damping";
        let refused =
            |value, allowed| SystemError::Value { object: self.object(), name, value, allowed };
        self.check_finite(name, points)?;
        self.expect_points(name, points)?;
        match first_non_increasing(points) {
            Some(index) => Err(refused(points[index].0, "rates that increase from point to point")),
            None => Ok(()),
        }
    }

    fn expect_points(&self, name: &'static str, points: &[(f64, f64)]) -> Result<(), SystemError> {
        let (object, points) = (self.object(), points.len());
        if points < 2 { Err(SystemError::FewPoints { object, name, points }) } else { Ok(()) }
    }

    fn check_finite(&self, name: &'static str, points: &[(f64, f64)]) -> Result<(), SystemError> {
        let wrong = points.iter().flat_map(|(q, f)| [q, f]).find(|x| !x.is_finite());
        wrong.map_or(Ok(()), |wrong| {
            let (object, allowed) = (self.object(), "finite numbers");
            Err(SystemError::Value { object, name, value: *wrong, allowed })
        })
    }

    fn check_rest(&self) -> Result<(), SystemError> {
        let Some(PrescribedRest { start, motion }) = &self.rest else { return Ok(()) };
        let name = match (self.kind.is_angle(), motion) {
            (false, PrescribedMotion::Position(_)) => "length",
            (false, PrescribedMotion::Rate(_)) => "length_rate",
            (true, PrescribedMotion::Position(_)) => "angle",
            (true, PrescribedMotion::Rate(_)) => "angle_rate",
        };
        let refused = |source| SystemError::RestValue { spring: self.object(), name, source };
        let first = motion.schedule().value(0.0, LimitSide::After).map_err(refused)?;
        motion.check_start().map_err(refused)?;
        if let Some(start) = start
            && *start < 0.0
            && !self.kind.is_angle()
        {
            return Err(refused(LoadError::NegativeLength { length: *start }));
        }
        match motion.declared_jump(first.abs()).map_err(refused)? {
            Some(DeclaredJump { time, before, after }) => {
                Err(refused(LoadError::Jump { time, before, after }))
            }
            None => Ok(()),
        }
    }

    /// Rejects springs with two consecutive points at the same station, and springs with all points on the ground or on one rigid body.
    fn check_movable(&self, setting: &dyn SceneChecks) -> Result<(), SystemError> {
        let idle = |[from, to]: [&Anchor; 2], why| {
            let [from, to] = [from, to].map(|anchor| match anchor {
                Anchor::Station(station) => setting.describe(station),
                Anchor::Ground(at) => format!("the ground at [{}, {}]", at.x, at.y),
            });
            Err(SystemError::ImmovableSpring { spring: self.object(), from, to, reason: why })
        };
        if self.stations().next().is_none()
            && let [from, .., to] = self.anchors()
        {
            return idle([from, to], "which are both on the ground");
        }
        let bodies = || {
            self.anchors().iter().map(|anchor| match anchor {
                Anchor::Station(Station { body: BodyIndex::Rigid(body, _), .. }) => Some(*body),
                _ => None,
            })
        };
        let first = bodies().next().flatten();
        if first.is_some()
            && bodies().all(|body| body == first)
            && let [from, .., to] = self.anchors()
        {
            return idle([from, to], "which are points of one body");
        }
        for pair in self.anchors().windows(2) {
            if let [Anchor::Station(one), Anchor::Station(other)] = pair
                && one == other
            {
                return idle([&pair[0], &pair[1]], "which is the same place");
            }
        }
        Ok(())
    }

    /// Type and name for messages.
    pub fn object(&self) -> String {
        match (&self.kind, &self.law) {
            (SpringKind::Brake { .. }, _) => format!("brake '{}'", self.name),
            (_, None) => format!("damper '{}'", self.name),
            (SpringKind::Torsion(_), _) => format!("torsion spring '{}'", self.name),
            (SpringKind::Length(anchors), _) if anchors.len() > 2 => {
                format!("tendon '{}'", self.name)
            }
            _ => format!("spring '{}'", self.name),
        }
    }
}
