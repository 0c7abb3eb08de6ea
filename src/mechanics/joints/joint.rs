//! Joints that tie whole components of movement, so that the tied ones share an unknown.
//!
//! Both partners then have the same increments at every step, whatever the method: the joint has no gap, does no
//! work, and passes on force and moment unchanged.

use serde::{Deserialize, Serialize};

use crate::beams::Station;
use crate::geometry::Vec2;

/// A component of the movement of a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Component {
    /// The movement of a section along the first axis [length].
    X,
    /// The movement of a section along the second axis [length].
    Y,
    /// The rotation of a section about the third axis [rad].
    Rotation,
}

impl Component {
    /// All components of the movement of a section, in the order of a movement.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Rotation];

    /// The component in messages, such as `x`.
    pub fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Rotation => "angle",
        }
    }
}

/// Some of the components of the movement of a section: at least one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Components {
    /// The first axis alone.
    X,
    /// The second axis alone.
    Y,
    /// The rotation alone.
    Rotation,
    /// Both axes.
    Position,
    /// The first axis and the rotation.
    XRotation,
    /// The second axis and the rotation.
    YRotation,
    /// Everything.
    All,
}

impl Components {
    /// The set in which a component is that is named; none if there is none.
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

    /// The components of the set, in the order of a movement.
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

/// Which components of movement a joint ties.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum JointKind {
    /// A hinge ties positions; sections turn freely against each other.
    Hinge,
    /// A rigid joint ties positions and rotations; the angle between the sections stays as drawn. With the ground: a clamp.
    Rigid,
    /// A support holds some components of a station on the ground, and leaves the others free.
    Support(Components),
    /// An inclined roller lets a station move along a direction that is no axis, a unit vector, and holds it across; sections turn freely.
    InclinedRoller(Vec2),
    /// An inclined guide is an inclined roller that holds the angle besides.
    InclinedGuide(Vec2),
}

/// What a joint ties a station to.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Partner {
    /// The joint ties to the ground, at the place of the station as drawn.
    Ground,
    /// The joint ties to a station at the same place, of another beam or of the same one.
    Station(Station),
}

/// A joint of a scene: what it ties, and to what.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// The name of the joint, for messages.
    pub name: String,
    /// Which components of movement the joint ties.
    pub kind: JointKind,
    /// The station that the joint ties.
    pub station: Station,
    /// What the joint ties its station to.
    pub partner: Partner,
}

/// The line on which something may move.
enum MotionLine {
    Horizontal,
    Vertical,
    /// Along a unit vector [-].
    Inclined(Vec2),
}

impl MotionLine {
    /// The line along a direction of any length; none where it is zero.
    fn along(direction: Vec2) -> Option<Self> {
        match (direction.x == 0.0, direction.y == 0.0) {
            (true, true) => None,
            (false, true) => Some(Self::Horizontal),
            (true, false) => Some(Self::Vertical),
            // Of numbers that are very large or small the squares are not.
            (false, false) => Some(Self::Inclined((direction / direction.amax()).normalize())),
        }
    }
}

impl JointKind {
    /// A roller that lets a station move along a direction and turn: a support where the direction is an axis. None where it is zero.
    pub fn roller(along: Vec2) -> Option<Self> {
        Some(match MotionLine::along(along)? {
            MotionLine::Horizontal => Self::Support(Components::Y),
            MotionLine::Vertical => Self::Support(Components::X),
            MotionLine::Inclined(along) => Self::InclinedRoller(along),
        })
    }

    /// A guide that lets a station move along a direction, and not turn: a support where the direction is an axis. None where it is zero.
    pub fn guide(along: Vec2) -> Option<Self> {
        Some(match MotionLine::along(along)? {
            MotionLine::Horizontal => Self::Support(Components::YRotation),
            MotionLine::Vertical => Self::Support(Components::XRotation),
            MotionLine::Inclined(along) => Self::InclinedGuide(along),
        })
    }

    /// The components of movement that a joint of this kind ties; that across an inclined roller is none of them.
    pub fn components(self) -> &'static [Component] {
        match self {
            Self::Hinge => &Component::ALL[..2],
            Self::Rigid => &Component::ALL,
            Self::Support(held) => held.list(),
            Self::InclinedRoller(_) => &[],
            Self::InclinedGuide(_) => Components::Rotation.list(),
        }
    }

    /// The only direction in which a joint of this kind lets its station move, a unit vector, if that is no axis [-].
    pub fn inclined(self) -> Option<Vec2> {
        match self {
            Self::InclinedRoller(along) | Self::InclinedGuide(along) => Some(along),
            Self::Hinge | Self::Rigid | Self::Support(_) => None,
        }
    }

    /// Whether a joint of this kind ties rotations, so that it transmits moments.
    pub fn ties_rotation(self) -> bool {
        self.components().contains(&Component::Rotation)
    }

    /// The kind of joint in words, with what it ties to, such as `clamp`.
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
