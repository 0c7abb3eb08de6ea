//! Data of the viewer, as plain structs.

use crate::output::canvas::Point;
use crate::output::symbol::{PlacedSymbol, Symbol};

/// Linear combination of points of a frame, for example of control points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointCombination {
    pub first: usize,
    /// Factors by which consecutive points are multiplied in the sum, beginning with the point `first` [-].
    pub weights: Vec<f64>,
}

impl PointCombination {
    pub fn among(&self, points: &[Point]) -> Point {
        let sum = |pick: fn(&Point) -> f64| {
            self.weights.iter().zip(&points[self.first..]).map(|(w, point)| w * pick(point)).sum()
        };
        (sum(|point| point.0), sum(|point| point.1))
    }
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct BeamShape {
    pub name: String,
    pub line: Vec<PointCombination>,
    /// Knots or nodes of the beam, as indices in `line`.
    pub marks: Vec<usize>,
    /// Indices in `line` of the positions of field values, in increasing order.
    pub stations: Vec<usize>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct ParticleShape {
    pub name: String,
    pub at: PointCombination,
}

#[derive(Clone, Debug, PartialEq)]
pub struct BodyShape {
    pub name: String,
    pub centre: PointCombination,
    pub points: Vec<(String, PointCombination)>,
    /// Outline of the body, closed if it ends at its start, otherwise a line; empty for a body without points.
    pub outline: Vec<PointCombination>,
    /// Corners of the polygon of the body, if it has one. The last corner repeats the first.
    /// The coordinates of a corner are its components along the line `outline`, from the centre to a point of the body, and to the left of this line.
    /// Both components are divided by the length of the line.
    pub corners: Vec<(f64, f64)>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct SymbolMark {
    pub symbol: Symbol,
    pub name: String,
    pub at: PointCombination,
    /// Direction of the symbol [rad].
    pub angle: f64,
    /// Time at which the symbol disappears by a release, or because a slider leaves its beam; `None` if it remains.
    pub until: Option<f64>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum SpringEnd {
    Moving(PointCombination),
    Ground(Point),
}

#[derive(Clone, Debug, PartialEq)]
pub struct SpringShape {
    pub symbol: Symbol,
    pub name: String,
    pub anchors: Vec<SpringEnd>,
    /// Time at which the spring, damper or tendon is released; `None` if it is not released.
    pub until: Option<f64>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    /// Symbol of the load. For a moment, only the first component of the value is used, positive counter-clockwise.
    pub symbol: Symbol,
    pub name: String,
    pub at: PointCombination,
    pub values: Vec<Point>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Trail {
    pub name: String,
    pub at: PointCombination,
}

#[derive(Clone, Debug, PartialEq)]
pub struct ColourField {
    pub name: String,
    /// Unit or dimension of the field; empty for a pure number.
    pub unit: String,
    /// Values in each frame at the stations of all beams, one beam after the other. Values that are not finite have no colour.
    pub values: Vec<Vec<f64>>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct TimeCurve {
    pub name: String,
    /// Unit or dimension of the column. Columns with the same unit share a plot.
    pub unit: String,
    pub values: Vec<f64>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct ViewerData {
    pub label: String,
    pub times: Vec<f64>,
    /// Points of all bodies in each frame, in the same order in all frames.
    pub points: Vec<Vec<Point>>,
    pub beams: Vec<BeamShape>,
    pub particles: Vec<ParticleShape>,
    pub bodies: Vec<BodyShape>,
    pub signs: Vec<SymbolMark>,
    pub springs: Vec<SpringShape>,
    pub obstacles: Vec<(String, PlacedSymbol)>,
    pub arrows: Vec<Arrow>,
    pub trails: Vec<Trail>,
    pub fields: Vec<ColourField>,
    pub rows: Vec<f64>,
    pub columns: Vec<TimeCurve>,
}
