//! Viewer data as plain structs.

use crate::output::canvas::Point;
use crate::output::symbol::Symbol;

/// A linear combination of points of a frame, such as control points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointCombination {
    pub first: usize,
    /// Weights of the points from `first` on.
    pub weights: Vec<f64>,
}

impl PointCombination {
    /// Evaluates the place for the points of a frame.
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
    /// Centre line of the beam, from start to end.
    pub line: Vec<PointCombination>,
    /// Knots or nodes, as indices of `line`.
    pub marks: Vec<usize>,
    /// Positions of the field values, as increasing indices of `line`.
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
    /// Outline of the body: closed if it ends at its start, otherwise a line; empty without points.
    pub outline: Vec<PointCombination>,
    /// Corners of the polygon of the body, if it has one. `outline` is then the line from the centre to one of its points. The corners are given
    /// along that line and to its left, in units of its length. The last corner repeats the first.
    pub corners: Vec<(f64, f64)>,
}

/// A symbol at a point: a support, joint, slider or drive.
#[derive(Clone, Debug, PartialEq)]
pub struct SymbolMark {
    pub symbol: Symbol,
    pub name: String,
    pub at: PointCombination,
    /// Direction of the symbol [rad].
    pub angle: f64,
    /// Time at which the symbol disappears, because a slider has left its beam or a joint was released.
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
    /// Time at which the element is released.
    pub until: Option<f64>,
}

/// A load over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    /// Kind of symbol. For a moment, only the first component of the value is used, positive counter-clockwise.
    pub symbol: Symbol,
    pub name: String,
    pub at: PointCombination,
    pub values: Vec<Point>,
}

/// A point whose path is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Trail {
    pub name: String,
    /// Point that draws the path.
    pub at: PointCombination,
}

/// A quantity along all beams that sets their colours.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourField {
    pub name: String,
    /// Unit or dimension of the field; empty for a pure number.
    pub unit: String,
    /// Values in each frame: at the stations of the first beam, then of the next one. Places whose values are not finite are not coloured.
    pub values: Vec<Vec<f64>>,
}

/// A quantity over time, plotted below the motion.
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
    /// Points of all bodies in each frame, in a fixed order.
    pub points: Vec<Vec<Point>>,
    pub beams: Vec<BeamShape>,
    pub particles: Vec<ParticleShape>,
    pub bodies: Vec<BodyShape>,
    /// Supports, joints, sliders, drives.
    pub signs: Vec<SymbolMark>,
    pub springs: Vec<SpringShape>,
    pub arrows: Vec<Arrow>,
    pub trails: Vec<Trail>,
    /// Quantities that can colour the beams.
    pub fields: Vec<ColourField>,
    /// Times of the rows of the columns.
    pub rows: Vec<f64>,
    /// Quantities plotted over `rows`.
    pub columns: Vec<TimeCurve>,
}
