//! Joints, which tie displacement components of two stations by a common unknown, or fix components of one station.
//! Inclined rollers and guides have a constraint force as an unknown instead.
//!
//! The two stations of a joint have the same increments in every step, for every integrator.
//! A joint has no gap, does no work, and transmits force and moment unchanged.

use serde::{Deserialize, Serialize};

use crate::beams::Station;
use crate::geometry::Vec2;

/// Component of the displacement and rotation of a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Component {
    /// Displacement along the first axis of the plane [length].
    X,
    /// Displacement along the second axis of the plane [length].
    Y,
    /// Rotation in the plane [rad].
    Rotation,
}

impl Component {
    /// All components, in the order in which increments store them.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Rotation];

    /// Name of the component in messages, such as `x`.
    pub fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Rotation => "angle",
        }
    }
}

/// Nonempty set of components of the displacement and rotation of a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Components {
    /// Displacement along the first axis.
    X,
    /// Displacement along the second axis.
    Y,
    /// Rotation.
    Rotation,
    /// Displacements along both axes.
    Position,
    /// Set of two components: the displacement along the first axis, and the rotation.
    XRotation,
    /// Set of two components: the displacement along the second axis, and the rotation.
    YRotation,
    /// Both displacements and the rotation.
    All,
}

impl Components {
    /// Set of the components for which a predicate is true; `None` if the set is empty.
    pub fn among(is_in: impl Fn(Component) -> bool) -> Option<Self> {
        match Component::ALL.map(is_in) {
            [false, false, false] => None,
            [true, false, false] => Some(Self::X),
            [false, true, false] => Some(Self::Y),
            [false, false, true] => Some(Self::Rotation),
            [true, true, false] => Some(Self::Position),
            [true, false, true] => Some(Self::XRotation),
            [false, true, true] => Some(Self::YRotation),
            [true, true, true] => Some(Self::All),
        }
    }

    /// Components of the set, in the order in which increments store them.
    pub fn list(self) -> &'static [Component] {
        match self {
            Self::X => &Component::ALL[..1],
            Self::Y => &Component::ALL[1..2],
            Self::Rotation => &Component::ALL[2..],
            Self::Position => &Component::ALL[..2],
            Self::XRotation => &[Component::X, Component::Rotation],
            Self::YRotation => &Component::ALL[1..],
            Self::All => &Component::ALL,
        }
    }
}

/// Type of a joint, which determines the components that it ties.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum JointKind {
    /// Hinge, which ties positions and leaves rotations free.
    Hinge,
    /// Rigid joint, which ties positions and rotations and keeps the initial angle between the sections.
    Rigid,
    /// Support, which fixes some components of a station and leaves the other components free.
    Support(Components),
    /// Inclined roller, which fixes the station across a unit vector that is not parallel to an axis.
    InclinedRoller(Vec2),
    /// Inclined guide, which is an inclined roller with fixed rotation.
    InclinedGuide(Vec2),
}

/// Object to which a joint ties its station.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Partner {
    /// Point of the ground at the initial position of the station of the joint.
    Ground,
    /// Station of another body, with the same initial position as the station of the joint.
    Station(Station),
}

/// Joint of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// Name of the joint in messages.
    pub name: String,
    /// Type of the joint, which determines the tied components.
    pub kind: JointKind,
    /// Station of the joint.
    pub station: Station,
    /// Partner of the station.
    pub partner: Partner,
}

enum MotionLine {
    Horizontal,
    Vertical,
    /// Unit vector that is not parallel to an axis [-].
    Inclined(Vec2),
}

impl MotionLine {
    fn along(direction: Vec2) -> Option<Self> {
        match (direction.x == 0.0, direction.y == 0.0) {
            (true, true) => None,
            (false, true) => Some(Self::Horizontal),
            (true, false) => Some(Self::Vertical),
            // The vector is scaled first, because the squares of very large or small numbers overflow or become zero.
            (false, false) => Some(Self::Inclined((direction / direction.amax()).normalize())),
        }
    }
}

impl JointKind {
    /// Roller that is free to move along a direction and free to rotate; `None` for a zero vector.
    /// If the direction is parallel to a coordinate axis, the result is a support of the other component.
    pub fn roller(along: Vec2) -> Option<Self> {
        Some(match MotionLine::along(along)? {
            MotionLine::Horizontal => Self::Support(Components::Y),
            MotionLine::Vertical => Self::Support(Components::X),
            MotionLine::Inclined(along) => Self::InclinedRoller(along),
        })
    }

    /// Guide that is free along a direction, with fixed rotation; a support for a direction parallel to an axis, `None` for a zero vector.
    pub fn guide(along: Vec2) -> Option<Self> {
        Some(match MotionLine::along(along)? {
            MotionLine::Horizontal => Self::Support(Components::YRotation),
            MotionLine::Vertical => Self::Support(Components::XRotation),
            MotionLine::Inclined(along) => Self::InclinedGuide(along),
        })
    }

    /// Components tied by a joint of this type. The direction across an inclined roller is not included.
    pub fn components(self) -> &'static [Component] {
        match self {
            Self::Hinge => &Component::ALL[..2],
            Self::Rigid => &Component::ALL,
            Self::Support(held) => held.list(),
            Self::InclinedRoller(_) => &[],
            Self::InclinedGuide(_) => Components::Rotation.list(),
        }
    }

    /// Unit vector of the free direction of an inclined roller or guide [-]; `None` for other types.
    pub fn inclined(self) -> Option<Vec2> {
        match self {
            Self::InclinedRoller(along) | Self::InclinedGuide(along) => Some(along),
            Self::Hinge | Self::Rigid | Self::Support(_) => None,
        }
    }

    pub(crate) fn ties_rotation(self) -> bool {
        self.components().contains(&Component::Rotation)
    }

    /// Description of the joint type for a partner, such as `clamp`.
    pub fn describe(self, partner: &Partner) -> &'static str {
        match (self, partner) {
            (Self::Hinge, _) => "hinge",
            (Self::Rigid, Partner::Ground) => "clamp",
            (Self::Rigid, Partner::Station(_)) => "rigid joint",
            (Self::Support(_), _) => "support",
            (Self::InclinedRoller(_), _) => "inclined roller",
            (Self::InclinedGuide(_), _) => "inclined guide",
        }
    }
}
