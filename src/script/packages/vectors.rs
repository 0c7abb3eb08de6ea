//! Vectors of the plane. Every parameter that accepts a vector also accepts an array `[x, y]`.

use rhai::Dynamic;

use crate::elementary::atan2;
use crate::geometry::{Vec2, cross, unit};
use crate::output::significant;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Scripted, Type};
use crate::script::bindings::parameter::{Parameter, number, object, point};
use crate::script::bindings::parameter_variants::{
    at_branch_cut_of_vector, at_coinciding_points, at_zero_vector, near_zero_divisor,
};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function, operator, property};
use crate::script::messages::error::ScriptError;
use crate::script::presentation::details;

pub const TABLE: BindingTable = BindingTable {
    name: "vectors",
    doc: "Points and vectors of the plane, with components x and y.",
    types: &[VECTOR],
    setup: "",
    constants: &[],
    rows: &[
        function("vec", &[number("x"), number("y")], cartesian)
            .returns(Returns::object(VECTOR))
            .summary("Creates a vector with components x and y.")
            .doc(
                "An array [x, y] is accepted wherever a point is required; a vector can also be \
                added and multiplied by a number.",
            )
            .example("let a = vec(1, 2) + [3, 4];\ncheck(a == vec(4, 6));")
            .with_related(&["polar", "norm"]),
        function(
            "polar",
            &[number("length").doc("length of the vector"), number("angle").unit("rad")],
            polar,
        )
        .returns(Returns::object(VECTOR))
        .summary("Creates a vector from its length and its angle from the x axis.")
        .example("check(norm(polar(2, PI / 2) - [0, 2]) < 1e-15);")
        .with_related(&["angle"]),
        property(VECTOR, "x", |call| Ok(call.receiver::<Vec2>()?.x.into()))
            .writable(&[number("value")], |call| set(call, |vector, x| vector.x = x))
            .returns(Returns::NUMBER)
            .summary("First component.")
            .example("let a = vec(1, 2);\na.x = 5;\ncheck(a.x == 5);"),
        property(VECTOR, "y", |call| Ok(call.receiver::<Vec2>()?.y.into()))
            .writable(&[number("value")], |call| set(call, |vector, y| vector.y = y))
            .returns(Returns::NUMBER)
            .summary("Second component.")
            .example("check(vec(1, 2).y == 2);"),
        function("dot", &[A, B], |call| Ok(a(call)?.dot(&b(call)?).into()))
            .returns(Returns::NUMBER)
            .summary("Returns the scalar product of two vectors.")
            .example("check(dot([1, 2], [3, 4]) == 11);"),
        function("cross", &[A, B], |call| Ok(cross(a(call)?, b(call)?).into()))
            .returns(Returns::NUMBER)
            .summary("Returns a1 b2 - a2 b1, positive if b is counter-clockwise of a.")
            .example("check(cross([1, 0], [0, 1]) == 1);"),
        function("norm", &[A], |call| Ok(call.point("a")?.norm().into()))
            .returns(Returns::NUMBER)
            .summary("Returns the length of a vector.")
            .example("check(norm([3, 4]) == 5);\ncheck(vec(3, 4).norm() == 5);")
            .with_related(&["hypot", "distance"])
            .corner(at_zero_vector),
        function("angle", &[A], angle)
            .returns(Returns::NUMBER.with_description("an angle from -PI to PI"))
            .summary("Returns the angle of a vector from the x axis, counter-clockwise.")
            .example("check(angle([0, 2]) == PI / 2);")
            .with_related(&["polar", "atan2"])
            .corner(at_branch_cut_of_vector),
        function("distance", &[A, B], |call| Ok((b(call)? - a(call)?).norm().into()))
            .returns(Returns::NUMBER)
            .summary("Returns the distance of two points.")
            .example("check(distance([1, 1], [4, 5]) == 5);")
            .corner(at_coinciding_points),
        operator("+", &[A, B], |call| vector(a(call)? + b(call)?))
            .returns(Returns::object(VECTOR))
            .summary("Adds vectors; one of the two may be an array [x, y].")
            .example("check(vec(1, 2) + [1, 1] == vec(2, 3));"),
        operator("-", &[A, B], |call| vector(a(call)? - b(call)?))
            .returns(Returns::object(VECTOR))
            .summary("Subtracts vectors; one of the two may be an array [x, y].")
            .example("check(vec(1, 2) - [1, 1] == vec(0, 1));"),
        operator("-", &[object("a", VECTOR)], |call| vector(-call.point("a")?))
            .returns(Returns::object(VECTOR))
            .summary("Negates a vector.")
            .example("check(-vec(1, 2) == vec(-1, -2));"),
        operator("*", &[object("a", VECTOR), number("factor")], scaled)
            .returns(Returns::object(VECTOR))
            .summary("Multiplies a vector by a number.")
            .example("check(vec(1, 2) * 3 == vec(3, 6));"),
        operator("*", &[number("factor"), object("a", VECTOR)], scaled)
            .returns(Returns::object(VECTOR))
            .summary("Multiplies a vector by a number.")
            .example("check(3 * vec(1, 2) == vec(3, 6));"),
        operator("/", &[object("a", VECTOR), number("divisor")], divided)
            .returns(Returns::object(VECTOR))
            .summary("Divides a vector by a number.")
            .example("check(vec(1, 2) / 2 == vec(0.5, 1));")
            .corner(near_zero_divisor),
        operator("==", &[A, B], |call| Ok((a(call)? == b(call)?).into()))
            .returns(Returns::BOOLEAN)
            .summary("Compares vectors: true if both components are equal.")
            .example("check(vec(1, 2) == [1, 2]);"),
        operator("!=", &[A, B], |call| Ok((a(call)? != b(call)?).into()))
            .returns(Returns::BOOLEAN)
            .summary("Compares vectors: true if a component differs.")
            .example("check(vec(1, 2) != [1, 3]);"),
    ],
};

pub(super) const VECTOR: Type = Type::of::<Vec2>();
const A: Parameter = point("a");
const B: Parameter = point("b");

impl Scripted for Vec2 {
    const NAME: &'static str = "vector";
    const DOC: &'static str = "A vector or point of the plane.";

    fn show(&self) -> String {
        format!("[{}, {}]", significant(self.x, 7), significant(self.y, 7))
    }

    fn details(&self) -> Details {
        details::of_vector(self)
    }
}

fn a(call: &Call) -> Result<Vec2, ScriptError> {
    call.point("a")
}

fn b(call: &Call) -> Result<Vec2, ScriptError> {
    call.point("b")
}

fn vector(components: Vec2) -> Result<Dynamic, ScriptError> {
    Ok(Dynamic::from(components))
}

fn cartesian(call: &mut Call) -> Result<Dynamic, ScriptError> {
    vector(Vec2::new(call.number("x")?, call.number("y")?))
}

fn scaled(call: &mut Call) -> Result<Dynamic, ScriptError> {
    vector(a(call)? * call.number("factor")?)
}

fn divided(call: &mut Call) -> Result<Dynamic, ScriptError> {
    vector(a(call)? / call.number("divisor")?)
}

fn polar(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (length, angle) = (call.number("length")?, call.number("angle")?);
    vector(unit(angle) * length)
}

fn angle(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let a = a(call)?;
    Ok(atan2(a.y, a.x).into())
}

fn set(call: &mut Call, change: fn(&mut Vec2, f64)) -> Result<Dynamic, ScriptError> {
    let value = call.number("value")?;
    call.change_receiver(|vector| change(vector, value))?;
    Ok(Dynamic::UNIT)
}
