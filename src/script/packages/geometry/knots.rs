//! Knots and their basis functions.

use std::rc::Rc;

use rhai::{Dynamic, Map};

use super::{ORDER, TIMES, XI, all_functions, at_argument, brief, count, numbers, pair, plural};
use crate::geometry::{Basis, KnotVector, MAX_DEGREE, MAX_SPANS};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Kind, NumberRange, Scripted, Type};
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{self, Parameter, Presence, either, integer, object};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function, method, operator, property};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::presentation::details;

pub const TABLE: BindingTable = BindingTable {
    name: "knots",
    doc: "Knot vectors define the polynomial pieces of a spline and their smoothness. They are \
        open: the first and the last knot are repeated degree + 1 times. A spline of degree p \
        has p - m continuous derivatives at an interior knot of multiplicity m.",
    types: &[KNOTS],
    setup: "",
    constants: &[],
    rows: &[
        function("knots", &[UNIFORM], uniform)
            .returns(Returns::object(KNOTS))
            .summary("Creates a knot vector with equal spans on [0, 1], from a number of spans or \
                from options.")
            .doc("knots(7) has cubic splines with two continuous derivatives; options select \
                another degree or continuity.")
            .example("let smooth = knots(7);\nlet paper = knots(#{ spans: 7, continuity: 1 });\ncheck(smooth.functions == 10 && paper.functions == 16);")
            .with_related(&["curve", "basis"]),
        function("knots", &[DEGREE, VALUES], explicit)
            .returns(Returns::object(KNOTS))
            .summary("Creates a knot vector from an array in which knots are repeated by their \
                multiplicity.")
            .example("let k = knots(2, [0, 0, 0, 0.5, 1, 1, 1]);\ncheck(k.functions == 4 && k.multiplicity(0.5) == 1);")
            .with_related(&["curve", "basis"]),
        property(KNOTS, "degree", |call| Ok(count(knots(call)?.degree())))
            .returns(Returns::INTEGER)
            .summary("Polynomial degree.")
            .example("check(knots(7).degree == 3);"),
        property(KNOTS, "values", |call| Ok(numbers(knots(call)?.knots().iter().copied())))
            .returns(Returns::NUMBERS)
            .summary("Array of all knots, repeated by their multiplicity.")
            .example("check(knots(#{ spans: 2, degree: 1 }).values == [0, 0, 0.5, 1, 1]);")
            .with_related(&["breaks"]),
        property(KNOTS, "functions", |call| Ok(count(knots(call)?.functions())))
            .returns(Returns::INTEGER)
            .summary("Number of basis functions, equal to the number of control points of a curve.")
            .example("check(knots(7).functions == 10);"),
        property(KNOTS, "spans", |call| Ok(count(knots(call)?.spans().len())))
            .returns(Returns::INTEGER)
            .summary("Number of spans between distinct knots.")
            .example("check(knots(7).spans == 7);")
            .with_related(&["span"]),
        property(KNOTS, "continuity", |call| Ok(count(basis(call)?.continuity())))
            .returns(Returns::INTEGER)
            .summary("Number of continuous derivatives at the least smooth interior knot; the degree \
                if there is none.")
            .example("check(knots(7).continuity == 2);\ncheck(knots(7).insert(0.5, 3).continuity == 0);"),
        property(KNOTS, "domain", |call| Ok(pair(knots(call)?.domain())))
            .returns(Returns::ARRAY.with_remark(" [a, b]"))
            .summary("First and last knot.")
            .example("check(knots(7).domain == [0, 1]);"),
        property(KNOTS, "breaks", |call| Ok(numbers(knots(call)?.breaks())))
            .returns(Returns::NUMBERS)
            .summary("Distinct knots: the ends of the spans.")
            .example("check(knots(2).breaks == [0, 0.5, 1]);")
            .with_related(&["values"]),
        property(KNOTS, "greville", |call| Ok(numbers(knots(call)?.greville())))
            .returns(Returns::NUMBERS)
            .summary("Greville abscissae, one parameter for each function.")
            .doc("A straight line with control points at these places has uniform speed; they \
                are suitable interpolation points.")
            .example("check(knots(#{ spans: 2, degree: 2 }).greville == [0, 0.25, 0.75, 1]);"),
        method(KNOTS, "basis", &[XI, ORDER.or(Presence::Integer(0))], |call| all_functions(&basis(call)?, call))
            .returns(Returns::NUMBERS.with_remark(", one for each function"))
            .summary("Returns the values of all basis functions at ξ, or their derivatives of the \
                given order.")
            .doc("At most degree + 1 of them are not zero, starting at number span(xi).first. At \
                interior knots derivatives are those from the right.")
            .example("let k = knots(4);\ncheck_close(sum(k.basis(0.3)), 1, 1e-15);\ncheck_close(sum(k.basis(0.3, 1)), 0, 1e-13);\ncheck(k.basis(0)[0] == 1);")
            .with_related(&["span", "greville", "gauss"]),
        method(KNOTS, "span", &[XI], span)
            .returns(Returns::MAP.with_remark(" with first, start and end"))
            .summary("Returns the span that contains ξ: its ends, and the number of the first \
                function that is not zero there.")
            .doc("A knot belongs to the span on its right, the last knot to the last span.")
            .example("let s = knots(4).span(0.3);\ncheck(s.first == 1 && s.start == 0.25 && s.end == 0.5);")
            .with_related(&["spans", "basis"]),
        method(KNOTS, "multiplicity", &[XI], multiplicity)
            .returns(Returns::INTEGER)
            .summary("Returns the multiplicity of ξ among the knots.")
            .example("check(knots(4).multiplicity(0) == 4 && knots(4).multiplicity(0.3) == 0);"),
        method(KNOTS, "insert", &[XI, TIMES], insert)
            .returns(Returns::object(KNOTS))
            .summary("Returns the knot vector with ξ inserted once or several times.")
            .example("let k = knots(4).insert(0.3, 2);\ncheck(k.functions == 9 && k.multiplicity(0.3) == 2);"),
        operator("==", &[A, B], |call| Ok((a(call)? == b(call)?).into()))
            .returns(Returns::BOOLEAN)
            .summary("Compares knot vectors: true if degree and all knots are equal.")
            .example("check(knots(#{ spans: 1, degree: 1 }) == knots(1, [0, 0, 1, 1]));"),
        operator("!=", &[A, B], |call| Ok((a(call)? != b(call)?).into()))
            .returns(Returns::BOOLEAN)
            .summary("Compares knot vectors: true if the degree or a knot differs.")
            .example("check(knots(3) != knots(4));"),
    ],
};

/// Type of knot vectors, with the native value `Rc<KnotVector>`.
pub const KNOTS: Type = Type::of::<Rc<KnotVector>>();

const A: Parameter = object("a", KNOTS);
const B: Parameter = object("b", KNOTS);
const DEGREE: Parameter =
    integer("degree").between(1.0, MAX_DEGREE as f64).doc("polynomial degree");
const VALUES: Parameter = parameter::numbers("values")
    .doc("knots in ascending order, the first and the last degree + 1 times");
const SPANS: NumberRange = NumberRange::Between(1.0, MAX_SPANS as f64);
const UNIFORM: Parameter = either("spans", &[Kind::Integer(SPANS), Kind::Options(KEYS)])
    .doc("number of spans, or options");
const KEYS: &[Parameter] = &[
    integer("spans").between(1.0, MAX_SPANS as f64).doc("number of equal spans"),
    DEGREE.or(Presence::Integer(3)),
    integer("continuity")
        .non_negative()
        .doc("continuous derivatives at interior knots; default: degree - 1")
        .optional(),
];

const PRINTED: usize = 16;

impl Scripted for Rc<KnotVector> {
    const NAME: &'static str = "knots";
    const DOC: &'static str =
        "The knots of a spline: ends and smoothness of its polynomial pieces.";

    fn show(&self) -> String {
        let spans = self.spans().len();
        let smooth = match spans {
            1 => String::new(),
            _ => format!(", C{}", Basis::BSpline(KnotVector::clone(self)).continuity()),
        };
        let listed = listed(self.knots());
        format!("knots of degree {}, {}{smooth}: [{listed}]", self.degree(), plural(spans, "span"))
    }

    fn details(&self) -> Details {
        details::of_knots(self)
    }
}

fn listed(knots: &[f64]) -> String {
    let texts = |part: &[f64]| part.iter().copied().map(brief).collect::<Vec<_>>().join(", ");
    match knots.len() {
        count if count <= PRINTED => texts(knots),
        count => format!("{}, …, {}", texts(&knots[..PRINTED / 2]), brief(knots[count - 1])),
    }
}

fn knots(call: &Call) -> Result<Rc<KnotVector>, ScriptError> {
    call.receiver()
}

fn basis(call: &Call) -> Result<Basis, ScriptError> {
    Ok(Basis::BSpline(KnotVector::clone(&*knots(call)?)))
}

fn a(call: &Call) -> Result<Rc<KnotVector>, ScriptError> {
    call.get("a")
}

fn b(call: &Call) -> Result<Rc<KnotVector>, ScriptError> {
    call.get("b")
}

pub(super) fn shared(knots: KnotVector) -> Dynamic {
    Dynamic::from(Rc::new(knots))
}

fn uniform(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (spans, degree, continuity) = match call.get_if::<Options>("spans") {
        Some(options) => {
            let degree = options.count("degree")?;
            let continuity = options.count("continuity").unwrap_or(degree - 1);
            (options.count("spans")?, degree, continuity)
        }
        None => (call.count("spans")?, 3, 2),
    };
    // The continuity is the only argument that may be invalid here.
    let knots = KnotVector::uniform(spans, degree, continuity)
        .map_err(|error| ScriptError::from(error).at(CallPart::Key("continuity".into())))?;
    Ok(shared(knots))
}

fn explicit(call: &mut Call) -> Result<Dynamic, ScriptError> {
    at_argument(1, KnotVector::new(call.count("degree")?, call.numbers("values")?)).map(shared)
}

fn span(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let span = at_argument(0, basis(call)?.span_at(call.number("xi")?))?;
    let fields =
        [("first", count(span.first)), ("start", span.start.into()), ("end", span.end.into())];
    Ok(fields.into_iter().map(|(name, value)| (name.into(), value)).collect::<Map>().into())
}

fn multiplicity(call: &mut Call) -> Result<Dynamic, ScriptError> {
    Ok(count(knots(call)?.multiplicity(call.number("xi")?)))
}

fn insert(call: &mut Call) -> Result<Dynamic, ScriptError> {
    at_argument(0, knots(call)?.insert(call.number("xi")?, call.count("times")?)).map(shared)
}
