//! Conversion of script values to curves.

use rhai::{Array, Dynamic};

use super::editor::completeness::is_command;
use crate::geometry::Vec2;
use crate::output::{Point, significant};
use crate::script::source::scanner::{TokenKind, scan};

const DIGITS: usize = 6;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveAbscissa {
    Time,
    Index,
    Numbers,
}

impl CurveAbscissa {
    pub fn label(self) -> &'static str {
        match self {
            Self::Time => "t",
            Self::Index => "index",
            Self::Numbers => "x",
        }
    }

    pub fn in_words(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Index => "the index of an array",
            Self::Numbers => "values of x",
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct PlotCurve {
    pub name: String,
    pub over: CurveAbscissa,
    pub dimension: Option<&'static str>,
    pub points: Vec<Point>,
}

impl PlotCurve {
    pub fn has_points(&self) -> bool {
        self.points.iter().any(|(x, y)| x.is_finite() && y.is_finite())
    }
}

#[derive(Clone, Debug, PartialEq)]
pub enum PlotShape {
    Whole(CurveAbscissa, Vec<Point>),
    Number(f64),
    Vector(Vec2),
    None(String),
}

pub fn shape(value: &Dynamic, of: &str) -> PlotShape {
    if let Some(number) = number(value) {
        return PlotShape::Number(number);
    }
    if let Some(vector) = value.read_lock::<Vec2>() {
        return PlotShape::Vector(*vector);
    }
    match value.read_lock::<Array>() {
        Some(array) => shape_of_array(&array),
        None => PlotShape::None(format!("it is {of}")),
    }
}

fn shape_of_array(array: &Array) -> PlotShape {
    if array.is_empty() {
        return PlotShape::None("it is an empty array".into());
    }
    if let Some(values) = numbers(array) {
        let points = values.into_iter().enumerate().map(|(index, value)| (index as f64, value));
        return PlotShape::Whole(CurveAbscissa::Index, points.collect());
    }
    let inner = |value: &Dynamic| value.read_lock::<Array>().and_then(|array| numbers(&array));
    let rows: Option<Vec<Vec<f64>>> = array.iter().map(inner).collect();
    match rows.as_deref() {
        Some([x, y]) if x.len() == y.len() => {
            return PlotShape::Whole(
                CurveAbscissa::Numbers,
                x.iter().copied().zip(y.iter().copied()).collect(),
            );
        }
        Some([x, y]) => {
            let message = format!("its two arrays have {} and {} numbers", x.len(), y.len());
            return PlotShape::None(message);
        }
        Some(rows) if rows.iter().all(|row| row.len() == 2) => {
            return PlotShape::Whole(
                CurveAbscissa::Numbers,
                rows.iter().map(|row| (row[0], row[1])).collect(),
            );
        }
        _ => (),
    }
    let vectors: Option<Vec<Point>> =
        array.iter().map(|value| value.read_lock::<Vec2>().map(|at| (at.x, at.y))).collect();
    match vectors {
        Some(points) => PlotShape::Whole(CurveAbscissa::Numbers, points),
        None => PlotShape::None("it is an array with entries that are not numbers".into()),
    }
}

fn number(value: &Dynamic) -> Option<f64> {
    // Shared values, such as variables captured by closures, must be locked for reading.
    let value = value.flatten_clone();
    value.as_float().ok().or_else(|| value.as_int().ok().map(|whole| whole as f64))
}

fn numbers(array: &Array) -> Option<Vec<f64>> {
    array.iter().map(|value| if value.is_array() { None } else { number(value) }).collect()
}

pub fn parts(operand: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    let (mut depth, mut begin, mut is_between_bars, mut before) =
        (0_usize, 0, false, TokenKind::Symbol);
    for token in scan(operand) {
        match (token.kind, token.of(operand)) {
            (TokenKind::Open(_), _) => depth += 1,
            (TokenKind::Close(_), _) => depth = depth.saturating_sub(1),
            (TokenKind::Symbol, "|") => {
                let is_operator =
                    matches!(before, TokenKind::Word | TokenKind::Number | TokenKind::Close(_));
                is_between_bars = !is_between_bars && !is_operator;
            }
            (TokenKind::Symbol, ",") if depth == 0 && !is_between_bars => {
                parts.push(operand[begin..token.start].trim());
                begin = token.end;
            }
            _ => (),
        }
        if token.is_significant() {
            before = token.kind;
        }
    }
    parts.push(operand[begin..].trim().trim_end_matches(';').trim_end());
    parts.retain(|part| !part.is_empty() && !is_command(part));
    parts
}

pub fn summary(curve: &PlotCurve) -> String {
    let values = curve.points.iter().map(|(_, value)| *value);
    let shown = |value: Option<f64>| value.map_or_else(String::new, |x| significant(x, DIGITS));
    let [first, last] = [values.clone().next(), values.clone().next_back()].map(shown);
    let [least, most] = [values.clone().reduce(f64::min), values.reduce(f64::max)].map(shown);
    let count = curve.points.len();
    let (begin, end, what) = match curve.over {
        CurveAbscissa::Time => ("at the start", "now", "state"),
        CurveAbscissa::Index | CurveAbscissa::Numbers => ("at the first", "at the last", "point"),
    };
    let plural = if count == 1 { "" } else { "s" };
    let end = match curve.over {
        CurveAbscissa::Time => format!("{end} {last}"),
        _ => format!("{last} {end}"),
    };
    format!(
        "{}: {first} {begin}, minimum {least}, maximum {most}, {end} ({count} {what}{plural})",
        curve.name
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn array(values: &[f64]) -> Dynamic {
        Dynamic::from_array(values.iter().map(|value| Dynamic::from_float(*value)).collect())
    }

    #[test]
    fn values_are_classified_by_plot_shape() {
        let of = |value: Dynamic| shape(&value, "a text");
        assert_eq!(of(2.into()), PlotShape::Number(2.0));
        assert_eq!(
            of(array(&[3.0, 5.0])),
            PlotShape::Whole(CurveAbscissa::Index, vec![(0.0, 3.0), (1.0, 5.0)])
        );
        let pair = Dynamic::from_array(vec![array(&[1.0, 2.0, 3.0]), array(&[4.0, 5.0, 6.0])]);
        let points = vec![(1.0, 4.0), (2.0, 5.0), (3.0, 6.0)];
        assert_eq!(of(pair), PlotShape::Whole(CurveAbscissa::Numbers, points.clone()));
        let listed: Vec<Dynamic> = points.iter().map(|(x, y)| array(&[*x, *y])).collect();
        assert_eq!(
            of(Dynamic::from_array(listed)),
            PlotShape::Whole(CurveAbscissa::Numbers, points.clone())
        );
        let vectors = points.iter().map(|(x, y)| Dynamic::from(Vec2::new(*x, *y))).collect();
        assert_eq!(
            of(Dynamic::from_array(vectors)),
            PlotShape::Whole(CurveAbscissa::Numbers, points)
        );
        assert_eq!(of(Dynamic::from(Vec2::new(1.0, 2.0))), PlotShape::Vector(Vec2::new(1.0, 2.0)));
        let uneven = Dynamic::from_array(vec![array(&[1.0]), array(&[1.0, 2.0])]);
        for (value, why) in [
            (uneven, "1 and 2 numbers"),
            (Dynamic::from_array(vec![]), "empty"),
            (Dynamic::from_array(vec![1.into(), "x".into()]), "with entries that are not numbers"),
            ("x".into(), "it is a text"),
            (true.into(), "it is a text"),
        ] {
            assert!(
                matches!(&of(value), PlotShape::None(message) if message.contains(why)),
                "{why}"
            );
        }
    }

    #[test]
    fn only_top_level_commas_separate_expressions() {
        assert_eq!(parts("energy, f(a, b), [1, 2]"), ["energy", "f(a, b)", "[1, 2]"]);
        assert_eq!(parts("a.map(|x, y| x), \"a,b\","), ["a.map(|x, y| x)", "\"a,b\""]);
        assert_eq!(parts("a | b, c | d;"), ["a | b", "c | d"]);
        assert_eq!(parts(" , "), Vec::<&str>::new());
    }

    #[test]
    fn curve_summary_states_ends_and_extremes() {
        let points = vec![(0.0, 2.0), (0.1, -1.0), (0.2, 1.5)];
        let curve =
            |over| PlotCurve { name: "f".into(), over, dimension: None, points: points.clone() };
        let message = "f: 2 at the start, minimum -1, maximum 2, now 1.5 (3 states)";
        assert_eq!(summary(&curve(CurveAbscissa::Time)), message);
        let message = "f: 2 at the first, minimum -1, maximum 2, 1.5 at the last (3 points)";
        assert_eq!(summary(&curve(CurveAbscissa::Index)), message);
    }
}
