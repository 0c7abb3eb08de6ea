//! What a viewer shows, as plain data.

use crate::output::canvas::Point;
use crate::output::symbol::Symbol;

/// A place of a body: a combination of points of the film, such as control points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointCombination {
    /// The first of its points, by its index in a frame.
    pub first: usize,
    /// The weights of the points from the first one on, whose weighted sum is the place.
    pub weights: Vec<f64>,
}

impl PointCombination {
    /// The place among the points of a frame.
    pub fn among(&self, points: &[Point]) -> Point {
        let sum = |pick: fn(&Point) -> f64| {
            self.weights.iter().zip(&points[self.first..]).map(|(w, point)| w * pick(point)).sum()
        };
        (sum(|point| point.0), sum(|point| point.1))
    }
}

/// A beam.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BeamShape {
    /// The name of the beam.
    pub name: String,
    /// The centre line of the beam, from its start to its end.
    pub line: Vec<PointCombination>,
    /// Knots or nodes: indices of the line.
    pub marks: Vec<usize>,
    /// Where the values of fields belong: indices of the line, increasing.
    pub stations: Vec<usize>,
}

/// A body without extent.
#[derive(Clone, Debug, PartialEq)]
pub struct ParticleShape {
    /// The name of the particle.
    pub name: String,
    /// The place of the particle.
    pub at: PointCombination,
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyShape {
    /// The name of the body.
    pub name: String,
    /// Where its centre of mass is.
    pub centre: PointCombination,
    /// The points of the body, with their names.
    pub points: Vec<(String, PointCombination)>,
    /// The outline of the body: closed where it ends where it begins, a line otherwise; nothing where it has no points.
    pub outline: Vec<PointCombination>,
    /// Where the body has a polygon of its own, and its outline is the line from its centre to one of its points: the corners, along and to the left of
    /// that line in its lengths, the first one again at the end.
    pub corners: Vec<(f64, f64)>,
}

/// A symbol at a place: what holds, joins, slides or drives.
#[derive(Clone, Debug, PartialEq)]
pub struct SymbolMark {
    /// What it means.
    pub symbol: Symbol,
    /// What it is called.
    pub name: String,
    /// The place of the symbol.
    pub at: PointCombination,
    /// The direction in which it points [rad].
    pub angle: f64,
    /// When it is gone: a slider that has left its beam, a joint that has let go.
    pub until: Option<f64>,
}

/// Where a spring is attached.
#[derive(Clone, Debug, PartialEq)]
pub enum SpringEnd {
    /// A place of a body.
    Moving(PointCombination),
    /// A point of the ground.
    Ground(Point),
}

/// A spring or what acts like one.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringShape {
    /// How it is drawn.
    pub symbol: Symbol,
    /// What it is called.
    pub name: String,
    /// The places where the spring is attached, in order.
    pub anchors: Vec<SpringEnd>,
    /// When it is gone: one that has let go.
    pub until: Option<f64>,
}

/// A load over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    /// What it stands for; of a moment, counter-clockwise, the first component counts.
    pub symbol: Symbol,
    /// What it is called.
    pub name: String,
    /// The place where the load acts.
    pub at: PointCombination,
    /// The value of the load in each frame.
    pub values: Vec<Point>,
}

/// A place whose path is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Trail {
    /// What it is called.
    pub name: String,
    /// The place of the trail.
    pub at: PointCombination,
}

/// A quantity along all beams, by which they are coloured.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourField {
    /// The name of the field.
    pub name: String,
    /// The unit or dimension of the field; empty for a pure number.
    pub unit: String,
    /// The values of the field in each frame: at the stations of the first beam, then of the next one. What is not finite is not coloured.
    pub values: Vec<Vec<f64>>,
}

/// A quantity over time, drawn below the motion.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeCurve {
    /// The name of the column.
    pub name: String,
    /// The unit or dimension of the column; those that have the same are drawn together.
    pub unit: String,
    /// The values of the column in each row.
    pub values: Vec<f64>,
}

/// A motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ViewerData {
    /// What it is called among others.
    pub label: String,
    /// The time of each frame.
    pub times: Vec<f64>,
    /// The points of all bodies in each frame, always in the same order.
    pub points: Vec<Vec<Point>>,
    /// Beams.
    pub beams: Vec<BeamShape>,
    /// Bodies without extent.
    pub particles: Vec<ParticleShape>,
    /// Rigid bodies.
    pub bodies: Vec<BodyShape>,
    /// Supports, joints, sliders, drives.
    pub signs: Vec<SymbolMark>,
    /// Springs, dampers, tendons.
    pub springs: Vec<SpringShape>,
    /// Loads.
    pub arrows: Vec<Arrow>,
    /// Paths.
    pub trails: Vec<Trail>,
    /// What beams can be coloured by.
    pub fields: Vec<ColourField>,
    /// The times of the rows.
    pub rows: Vec<f64>,
    /// What is drawn over them.
    pub columns: Vec<TimeCurve>,
}
