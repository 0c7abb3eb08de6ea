//! Springs, dampers and tendons as a scene describes them.

use serde::{Deserialize, Serialize};

use super::damping_law::DampingLaw;
use super::element::{AssemblyContext, BuiltElement, ElementDef, SceneChecks};
use super::elongation::{Elongation, ElongationEnd};
use super::point_damper::PointDamper;
use super::spring_damper::SpringDamper;
use super::spring_law::SpringLaw;
use super::zero_length_spring::ZeroLengthSpring;
use crate::beams::{BodyIndex, Station};
use crate::geometry::Vec2;
use crate::system::{SystemError, Turning};

/// Where a spring is attached.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Anchor {
    /// A station of a beam, or a particle.
    Station(Station),
    /// A point of the ground [length].
    Ground(Vec2),
}

/// What a spring measures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum SpringKind {
    /// The length of the way over these places: two of a spring or a damper, more of a tendon, which slides over those between without friction.
    Way(Vec<Anchor>),
    /// The angle of the section of the second place less that of the first one; the ground does not turn.
    Torsion([Anchor; 2]),
}

/// What the elongations of a law are counted from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Origin {
    /// Nothing: they are lengths and angles.
    Zero,
    /// The length or the angle in the scene as it is built on its meshes: at zero it is as at the start.
    AsBuilt,
}

/// A spring, a damper, or both: a force along what it measures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Spring {
    /// What it is called in messages and columns.
    pub name: String,
    /// What it measures.
    pub kind: SpringKind,
    /// The force over what it measures; none of a damper alone.
    pub law: Option<SpringLaw>,
    /// What the elongations of the law are counted from.
    pub origin: Origin,
    /// The force of a damper over the rate of what it measures.
    pub damping: DampingLaw,
}

impl Spring {
    /// The places where it is attached, in their order.
    pub fn anchors(&self) -> &[Anchor] {
        match &self.kind {
            SpringKind::Way(anchors) => anchors,
            SpringKind::Torsion(anchors) => anchors,
        }
    }

    /// The anchors of the spring that are stations of bodies.
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
            if matches!(self.kind, SpringKind::Torsion(_)) && !station.turns() {
                let by = Turning::TorsionSpring;
                return Err(SystemError::ParticleTurned { object: self.object(), by });
            }
        }
        for anchor in self.anchors() {
            if let Anchor::Ground(at) = anchor
                && let Some(wrong) = at.iter().find(|value| !value.is_finite())
            {
                return refused("place on the ground", *wrong, "a finite number [length]");
            }
        }
        self.expect_movement(setting)?;
        match self.damping {
            DampingLaw::Linear(constant) if !(constant.is_finite() && constant >= 0.0) => {
                return refused("damping", constant, "zero or a positive finite number");
            }
            DampingLaw::Linear(_) => (),
            DampingLaw::Curve(_) => self.check_damping(self.damping.corners())?,
        }
        if let Some(feeding) = self.damping.feeds() {
            let (damper, feeding) = (self.object(), feeding.to_string());
            return Err(SystemError::FeedingDamper { damper, feeding });
        }
        match &self.law {
            Some(SpringLaw::Linear { stiffness, natural }) => {
                if !(stiffness.is_finite() && *stiffness > 0.0) {
                    return refused("stiffness", *stiffness, "a positive finite number");
                }
                let is_angle = matches!(self.kind, SpringKind::Torsion(_));
                let is_length = !is_angle && self.origin == Origin::Zero;
                if !(natural.is_finite() && (*natural >= 0.0 || !is_length)) {
                    let allowed = "zero or a positive finite number [length]";
                    return refused("length", *natural, allowed);
                }
            }
            Some(SpringLaw::Table { points } | SpringLaw::Sampled { points, .. }) => {
                if points.len() < 2 {
                    return refused("table", points.len() as f64, "at least two points");
                }
                if let Some(index) = falling_behind(points) {
                    let (elongation, before) = (points[index].0, points[index - 1].0);
                    let object = self.object();
                    return Err(SystemError::TableOrder { object, index, elongation, before });
                }
                self.check_finite("table", points)?;
            }
            None if !self.damping.acts() => {
                return refused("damping", 0.0, "a positive number where there is no stiffness");
            }
            None => (),
        }
        Ok(())
    }

    fn coupled(&self) -> Vec<Station> {
        self.stations().copied().collect()
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
            && matches!(self.kind, SpringKind::Way(_))
        {
            return Ok(BuiltElement::Resistance(Box::new(ZeroLengthSpring::new(
                &self.name,
                [from.clone(), to.clone()],
                [at[0], at[1]],
                &grounds,
                *stiffness,
                self.damping.with_rest(),
            ))));
        }
        if let (None, SpringKind::Way(_), [from, to]) = (&self.law, &self.kind, &terminals[..]) {
            return Ok(BuiltElement::Resistance(Box::new(PointDamper::new(
                self.name.clone(),
                [from.clone(), to.clone()],
                [at[0], at[1]],
                &grounds,
                self.damping.with_rest(),
            ))));
        }
        if let (Some(law), SpringKind::Way(_), [from, to]) = (&self.law, &self.kind, &terminals[..])
            && self.damping.acts()
        {
            let (from_to, places) = ([from.clone(), to.clone()], [at[0], at[1]]);
            let origin = match self.origin {
                Origin::Zero => 0.0,
                Origin::AsBuilt => (places[1] - places[0]).norm(),
            };
            if law.is_at_ease(-origin) {
                return Ok(BuiltElement::Resistance(Box::new(ZeroLengthSpring::of_law(
                    &self.name,
                    from_to,
                    places,
                    &grounds,
                    (law.clone(), origin),
                    self.damping.with_rest(),
                ))));
            }
        }
        let elongation = match (&self.kind, terminals.as_slice()) {
            (SpringKind::Torsion(_), [from, to]) => {
                Elongation::angle([from.clone(), to.clone()], angles[1] - angles[0])
            }
            _ => Elongation::way(terminals, &at),
        };
        let origin = match self.origin {
            Origin::Zero => 0.0,
            Origin::AsBuilt => elongation.drawn(),
        };
        Ok(BuiltElement::Resistance(Box::new(SpringDamper::new(
            self.name.clone(),
            elongation,
            grounds,
            self.law.clone().map(|law| (law, origin)),
            self.damping.with_rest(),
        ))))
    }
}

/// The index of the first point of a polygon that is not behind the one before.
fn falling_behind(points: &[(f64, f64)]) -> Option<usize> {
    points.windows(2).position(|pair| pair[1].0 <= pair[0].0).map(|before| before + 1)
}

impl Spring {
    /// Refuses points of a law of damping that make no polygon; where there are none, there is no polygon.
    fn check_damping(&self, points: &[(f64, f64)]) -> Result<(), SystemError> {
        let name = "damping";
        let refused =
            |value, allowed| SystemError::Value { object: self.object(), name, value, allowed };
        self.check_finite(name, points)?;
        if points.len() < 2 {
            return Err(refused(points.len() as f64, "at least two points"));
        }
        match falling_behind(points) {
            Some(index) => Err(refused(points[index].0, "rates that rise from point to point")),
            None => Ok(()),
        }
    }

    /// Refuses numbers of a polygon, called so, that are not finite.
    fn check_finite(&self, name: &'static str, points: &[(f64, f64)]) -> Result<(), SystemError> {
        let wrong = points.iter().flat_map(|(q, f)| [q, f]).find(|x| !x.is_finite());
        wrong.map_or(Ok(()), |wrong| {
            let (object, allowed) = (self.object(), "finite numbers");
            Err(SystemError::Value { object, name, value: *wrong, allowed })
        })
    }

    /// Refuses one whose ends cannot move against each other: neighbours that are one station, or nothing but ground.
    fn expect_movement(&self, setting: &dyn SceneChecks) -> Result<(), SystemError> {
        let idle = |[from, to]: [&Anchor; 2], why| {
            let [from, to] = [from, to].map(|anchor| match anchor {
                Anchor::Station(station) => setting.describe(station),
                Anchor::Ground(at) => format!("the ground at [{}, {}]", at.x, at.y),
            });
            Err(SystemError::IdleSpring { spring: self.object(), from, to, why })
        };
        if self.stations().next().is_none()
            && let [from, .., to] = self.anchors()
        {
            return idle([from, to], "where nothing moves");
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

    /// What it is, and its name.
    pub fn object(&self) -> String {
        match (&self.kind, &self.law) {
            (_, None) => format!("damper '{}'", self.name),
            (SpringKind::Torsion(_), _) => format!("torsion spring '{}'", self.name),
            (SpringKind::Way(anchors), _) if anchors.len() > 2 => format!("tendon '{}'", self.name),
            _ => format!("spring '{}'", self.name),
        }
    }
}
