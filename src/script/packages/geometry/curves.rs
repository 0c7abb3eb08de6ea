//! Planar curves, used as beam axes.

use std::rc::Rc;

use rhai::{Array, Dynamic};

use super::super::vectors::VECTOR;
use super::knots::{KNOTS, shared as shared_knots};
use super::{ORDER, TIMES, XI, at_argument, brief, brief_point, pair, plural, vector};
use crate::geometry::{Curve, GeometryError, KnotVector, SplineCurve, Vec2};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Scripted, Type};
use crate::script::bindings::parameter::{Parameter, Presence, number, object, point, points};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, function, method, operator, property};
use crate::script::messages::error::ScriptError;
use crate::script::messages::nouns::with_article;
use crate::script::presentation::details;

pub const TABLE: BindingTable = BindingTable {
    name: "curves",
    doc: "Curves of the plane with a parameter ξ: from 0 to 1, or over the domain of the knots. \
        The axis of a beam is a curve.",
    types: &[CURVE],
    setup: "",
    constants: &[],
    rows: &[
        function(
            "line",
            &[
                point("from").unit("length").doc("start point"),
                point("to").unit("length").doc("end point"),
            ],
            |call| Ok(shared(Curve::line(call.point("from")?, call.point("to")?)?)),
        )
        .returns(Returns::object(CURVE))
        .summary("Creates a straight line between two points.")
        .example("let rod = line([0, 8], [6, 0]);\ncheck(rod.length == 10 && rod.at(0.5) == [3, 4]);")
        .with_related(&["arc", "through", "curve"]),
        function(
            "arc",
            &[
                point("center").unit("length").doc("center of the circle"),
                number("radius").positive().unit("length"),
                number("from_angle").unit("rad").doc("start angle, from the x axis"),
                number("to_angle").unit("rad").doc("end angle; counter-clockwise if larger"),
            ],
            arc,
        )
        .returns(Returns::object(CURVE))
        .summary("Creates a circular arc between two angles, at most a full turn.")
        .example("let quarter = arc([0, 0], 2, 0, PI / 2);\ncheck_close(quarter.length, PI, 1e-15);\ncheck(quarter.curvature(0.5) == 0.5);")
        .with_related(&["line", "through"]),
        function("through", &[points("points").unit("length").doc("two or more points")], through)
            .returns(Returns::object(CURVE))
            .summary("Creates a smooth cubic spline through points, by local interpolation.")
            .doc("Through n + 1 points it has 2 n + 2 control points, double interior knots and \
                a continuous tangent (The NURBS Book, section 9.3.4).")
            .example("let c = through([[0, 0], [1, 1], [2, 0]]);\ncheck(c.control_points.len() == 6);\ncheck_close(distance(c.at(0.5), [1, 1]), 0, 1e-12);")
            .with_related(&["curve", "line"]),
        function(
            "curve",
            &[
                object("knots", KNOTS),
                points("points").unit("length").doc("control points, one for each function"),
            ],
            spline,
        )
        .returns(Returns::object(CURVE))
        .summary("Creates a spline with these knots and control points.")
        .example("let parabola = curve(knots(#{ spans: 1, degree: 2 }), [[0, 0], [0.5, 0], [1, 1]]);\ncheck(parabola.at(0.5) == [0.5, 0.25]);")
        .with_related(&["knots", "through"]),
        property(CURVE, "length", |call| Ok(curve(call)?.length().into()))
            .returns(Returns::NUMBER.unit("length"))
            .summary("Length of the curve.")
            .example("check(line([0, 0], [3, 4]).length == 5);")
            .with_related(&["length_to", "parameter"]),
        property(CURVE, "start", |call| Ok(vector(ends(&*curve(call)?)?[0])))
            .returns(Returns::object(VECTOR))
            .summary("Start point of the curve.")
            .example("check(line([0, 8], [6, 0]).start == [0, 8]);")
            .with_related(&["end", "at"]),
        property(CURVE, "end", |call| Ok(vector(ends(&*curve(call)?)?[1])))
            .returns(Returns::object(VECTOR))
            .summary("End point of the curve.")
            .example("check(line([0, 8], [6, 0]).end == [6, 0]);")
            .with_related(&["start", "at"]),
        property(CURVE, "domain", |call| Ok(pair(curve(call)?.domain())))
            .returns(Returns::ARRAY.with_remark(" [a, b]"))
            .summary("Interval of the parameter ξ.")
            .example("check(line([0, 8], [6, 0]).domain == [0, 1]);"),
        property(CURVE, "knots", |call| Ok(shared_knots(of_spline(&*curve(call)?, call)?.knots().clone())))
            .returns(Returns::object(KNOTS))
            .summary("Knots of a spline; refused with an error for lines and arcs.")
            .example("check(through([[0, 0], [1, 1], [2, 0]]).knots.continuity == 1);")
            .with_related(&["control_points"]),
        property(CURVE, "control_points", control_points)
            .returns(Returns::array_of(&ValueKind::Object(VECTOR)))
            .summary("Control points of a spline; refused with an error for lines and arcs.")
            .example("let c = through([[0, 0], [1, 1], [2, 0]]);\ncheck(c.control_points[0] == [0, 0]);")
            .with_related(&["knots"]),
        method(CURVE, "at", &[XI], |call| Ok(vector(at_xi(call, Curve::point)?)))
            .returns(Returns::object(VECTOR))
            .summary("Returns the point at ξ.")
            .example("check(line([0, 8], [6, 0]).at(0.5) == [3, 4]);")
            .with_related(&["derivative", "parameter"]),
        method(CURVE, "derivative", &[XI, ORDER.or(Presence::Integer(1))], derivative)
            .returns(Returns::object(VECTOR))
            .summary("Returns the derivative by ξ of first or given order; at knots from the right.")
            .example("let c = line([0, 8], [6, 0]);\ncheck(c.derivative(0.5) == [6, -8]);\ncheck(c.derivative(0.5, 2) == [0, 0]);")
            .with_related(&["angle", "curvature"]),
        method(CURVE, "angle", &[XI], |call| Ok(at_xi(call, Curve::tangent_angle)?.into()))
            .returns(Returns::NUMBER.with_description("an angle from -PI to PI"))
            .summary("Returns the angle of the tangent from the x axis.")
            .example("check(line([0, 0], [0, 2]).angle(0.5) == PI / 2);")
            .with_related(&["derivative"]),
        method(CURVE, "curvature", &[XI], |call| Ok(at_xi(call, Curve::curvature)?.into()))
            .returns(Returns::NUMBER.unit("1/length"))
            .summary("Returns the curvature, positive if the curve turns counter-clockwise.")
            .example("check(arc([0, 0], 2, 0, -PI).curvature(0.5) == -0.5);")
            .with_related(&["derivative"]),
        method(CURVE, "length_to", &[XI], |call| Ok(at_xi(call, Curve::length_to)?.into()))
            .returns(Returns::NUMBER.unit("length"))
            .summary("Returns the length from the start to ξ.")
            .example("check(line([0, 8], [6, 0]).length_to(0.5) == 5);")
            .with_related(&["parameter", "length"]),
        method(CURVE, "parameter", &[number("s").unit("length").doc("length from the start")], parameter)
            .returns(Returns::NUMBER)
            .summary("Returns the parameter ξ at this length from the start.")
            .example("let c = line([0, 8], [6, 0]);\ncheck(c.at(c.parameter(5)) == [3, 4]);")
            .with_related(&["length_to", "at"]),
        method(CURVE, "insert", &[XI, TIMES], insert)
            .returns(Returns::object(CURVE))
            .summary("Returns the same spline with a knot inserted once or several times: the curve \
                is unchanged, the control points are computed.")
            .example("let c = through([[0, 0], [1, 1], [2, 0]]);\nlet finer = c.insert(0.3);\ncheck(finer.control_points.len() == 7);\ncheck_close(distance(finer.at(0.7), c.at(0.7)), 0, 1e-14);")
            .with_related(&["knots"]),
        operator("==", &[A, B], |call| Ok((a(call)? == b(call)?).into()))
            .returns(Returns::BOOLEAN)
            .summary("Compares curves: true if both are of the same kind with equal numbers.")
            .example("check(line([0, 0], [1, 0]) == line([0, 0], [1, 0]));"),
        operator("!=", &[A, B], |call| Ok((a(call)? != b(call)?).into()))
            .returns(Returns::BOOLEAN)
            .summary("Compares curves: true if the kind or a number differs.")
            .example("check(line([0, 0], [1, 0]) != line([0, 0], [2, 0]));"),
    ],
};

/// Type of curves, with the native value `Rc<Curve>`.
pub const CURVE: Type = Type::of::<Rc<Curve>>();

const A: Parameter = object("a", CURVE);
const B: Parameter = object("b", CURVE);

impl Scripted for Rc<Curve> {
    const NAME: &'static str = "curve";
    const DOC: &'static str = "A curve of the plane.";

    fn show(&self) -> String {
        let control = match &**self {
            Curve::Spline(spline) => {
                let points = plural(spline.control_points().len(), "control point");
                format!(" of degree {} with {points}", spline.knots().degree())
            }
            _ => String::new(),
        };
        let ends = ends(self).map_or_else(
            |_| String::new(),
            |[start, end]| format!(" from {} to {}", brief_point(start), brief_point(end)),
        );
        format!("{}{control}{ends}, length {}", kind(self), brief(self.length()))
    }

    fn details(&self) -> Details {
        details::of_curve(self)
    }
}

fn kind(curve: &Curve) -> &'static str {
    match curve {
        Curve::Line(_) => "line",
        Curve::Arc(_) => "arc",
        Curve::Spline(_) => "spline",
    }
}

fn ends(curve: &Curve) -> Result<[Vec2; 2], GeometryError> {
    let (start, end) = curve.domain();
    Ok([curve.point(start)?, curve.point(end)?])
}

fn of_spline<'a>(curve: &'a Curve, call: &Call) -> Result<&'a SplineCurve, ScriptError> {
    match curve {
        Curve::Spline(spline) => Ok(spline),
        Curve::Line(_) | Curve::Arc(_) => {
            let refusal = format!("{} has no knots", with_article(kind(curve)));
            Err(call.error(refusal).hint(
                "only splines have knots and control points: create one with through(points) or \
                curve(knots, points)",
            ))
        }
    }
}

fn curve(call: &Call) -> Result<Rc<Curve>, ScriptError> {
    call.receiver()
}

fn a(call: &Call) -> Result<Rc<Curve>, ScriptError> {
    call.get("a")
}

fn b(call: &Call) -> Result<Rc<Curve>, ScriptError> {
    call.get("b")
}

fn shared(curve: Curve) -> Dynamic {
    Dynamic::from(Rc::new(curve))
}

fn arc(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (from, to) = (call.number("from_angle")?, call.number("to_angle")?);
    Ok(shared(Curve::arc(call.point("center")?, call.number("radius")?, from, to)?))
}

fn through(call: &mut Call) -> Result<Dynamic, ScriptError> {
    at_argument(0, Curve::through(&call.points("points")?)).map(shared)
}

fn spline(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let knots = call.get::<Rc<KnotVector>>("knots")?;
    at_argument(1, Curve::spline(KnotVector::clone(&knots), call.points("points")?)).map(shared)
}

fn control_points(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let curve = curve(call)?;
    let points = of_spline(&curve, call)?.control_points();
    Ok(points.iter().copied().map(vector).collect::<Array>().into())
}

fn at_xi<T>(
    call: &Call,
    quantity: fn(&Curve, f64) -> Result<T, GeometryError>,
) -> Result<T, ScriptError> {
    at_argument(0, quantity(&*curve(call)?, call.number("xi")?))
}

fn derivative(call: &mut Call) -> Result<Dynamic, ScriptError> {
    at_argument(0, curve(call)?.derivative(call.number("xi")?, call.count("order")?)).map(vector)
}

fn parameter(call: &mut Call) -> Result<Dynamic, ScriptError> {
    Ok(at_argument(0, curve(call)?.parameter_at(call.number("s")?))?.into())
}

fn insert(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let curve = curve(call)?;
    let finer = of_spline(&curve, call)?.insert(call.number("xi")?, call.count("times")?);
    at_argument(0, finer).map(Curve::Spline).map(shared)
}
