//! Parameters of a scene, and derivatives with respect to them.

use rhai::Dynamic;

use super::scenes::SCENE;
use crate::geometry::Vec2;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Type;
use crate::script::bindings::parameter::{Parameter, name, number, of_any_type, options, text};
use crate::script::bindings::parameter_variants::VariantValue;
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function, method};
use crate::script::handles::scene::SceneHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::format_number;
use crate::script::messages::suggest::nearest;

pub const TABLE: BindingTable = BindingTable {
    name: "derivatives",
    doc: "Derivatives of simulation results by parameters of a scene. A named parameter is used \
        like a number; everything that depends on it has derivatives.",
    types: &[VARIED],
    setup: "",
    constants: &[],
    rows: &[
        method(SCENE, "parameter", &[name("name"), number("value"), options("options", KEYS).optional()], declare)
        .returns(Returns::object(VARIED))
        .summary("Declares a named number of the scene by which derivatives are computed.")
        .doc(
            "Sections, loads, springs, masses, motors and velocities of the scene accept it as \
            a number. Declare all parameters of a scene before one is used. A simulation \
            started afterwards computes in each step the derivatives by each parameter with \
            the factorised equations of the step: two or three solves for each of two \
            neighbouring values, no factorisation. Its own steps are bitwise unchanged. Values \
            read from the simulation and its history, and values computed from them, have \
            derivatives; comparisons, checks, fixed and sci ignore them. Only fixed steps of \
            energy_momentum() or fourth_order() are allowed. Positions of particles, of points \
            of the ground and of sliders, and whole beams may depend on a parameter; lengths \
            of beams, places on them and times of jumps of loads may not, and functions |t, q| \
            … are not allowed. Derivatives end where a slider arrives, a condition releases an \
            object, or the script goes back; derivative_by then gives this reason.",
        )
        .example(
            "let scene = new_scene(\"rod\");\nlet EI = scene.parameter(\"EI\", 100);\n\
             let s = section(#{ EA: 1e4, GA: 1e4, EI: EI, rho_A: 1, rho_I: 0.1 });\n\
             let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });\n\
             scene.clamp(rod.start);\nscene.force(rod.end, [0, -5]);\n\
             let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(0.1);\n\
             let sag = sim.position(rod.end).y;\nprint(sag);\ncheck(sag < 0 && sag.derivative_by(\"EI\") > 0);",
        )
        .with_related(&["derivative_by", "value_of", "fit"]),
        function("derivative_by", &[X, text("parameter").doc("name of the parameter")], derivative_by)
            .returns(Returns::ANYTHING.with_description("a number, a vector, or an array of them"))
            .summary("Returns the derivative of a number or a vector by a parameter of a scene; for \
                an array those of its elements.")
            .doc("Zero for values that do not depend on a parameter, and for all values of a \
                simulation loaded from a file. Accurate to about eight digits where the motion \
                is smooth and depends on the parameter; for other cases use the option \
                `distance` of scene.parameter. Refused with an error: other values than \
                numbers, vectors and arrays of them; an unknown parameter; a value at a kink \
                or a jump of a function (abs(x) at 0, max(x, y) where both are equal, x % y) \
                or where its slope is infinite (sqrt(x) and 1 / x at 0); and a simulation \
                after a slider has arrived, a condition has released an object, or the script has \
                gone back (sim.history.before(t) has the earlier rows). A note is printed if a \
                function |t| … compares its argument with a parameter, such as if t < a: if \
                the function jumps there, derivatives are wrong.")
            .example(
                "let scene = new_scene(\"two\");\nlet k = scene.parameter(\"k\", 4);\nlet m = scene.parameter(\"m\", 1);\n\
                 let omega = sqrt(k / m);\ncheck_close(omega.derivative_by(\"k\"), 0.25, 1e-9);\ncheck_close(derivative_by(omega, \"m\"), -1, 1e-8);",
            )
            .with_related(&["parameter"]),
        function("value_of", &[X], |call| Ok(plain(&call.value("x")?)))
            .returns(Returns::ANYTHING.with_description("the same without derivatives"))
            .summary("Returns a number, vector, array or map without its derivatives.")
            .example(
                "let scene = new_scene(\"one\");\nlet k = scene.parameter(\"k\", 4);\ncheck(value_of(2 * k) == 8);",
            )
            .with_related(&["derivative_by"]),
    ],
};

const KEYS: &[Parameter] = &[number("distance").positive().doc(
    "distance of the two neighbouring values from which derivatives are computed; default: 1e-5 \
    of the magnitude (1e-5 for 0)",
).optional()];
const VARIED: Type = Type::of::<VariantValue>();
const X: Parameter = of_any_type("x");
/// Minimum perturbation of a parameter, as a fraction of the parameter, below which derivatives have too few digits.
const LEAST_DISTANCE: f64 = 1e-10;

fn declare(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (name, value) = (call.text("name")?, call.number("value")?);
    let distance = call.options_or_defaults("options")?.optional_number("distance");
    if let Some(distance) = distance.filter(|by| *by < LEAST_DISTANCE * value.abs()) {
        let [distance, value] = [distance, value].map(format_number);
        let message = format!(
            "the distance {distance} is too small: {value} plus or minus the distance is \
            rounded to {value}"
        );
        let hint = "use 1e-5 of the value, or 1e-7 to 1e-3 of it";
        return Err(call.error(message).hint(hint).at(CallPart::Key("distance".into())));
    }
    let scene = call.receiver::<SceneHandle>()?;
    Ok(Dynamic::from(scene.declare(&name, value, distance)?))
}

fn derivative_by(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (value, name) = (call.value("x")?, call.text("parameter")?);
    derivative(call, &value, &name)
}

fn derivative(call: &Call, value: &Dynamic, name: &str) -> Result<Dynamic, ScriptError> {
    if let Some(varied) = value.read_lock::<VariantValue>() {
        let family = varied.parameter_set();
        let Some(number) = family.number_of(name) else {
            let names: Vec<String> =
                family.parameters().into_iter().map(|(name, _)| name).collect();
            let meant = nearest(name, names.iter().map(String::as_str));
            let meant = meant.map(|name| format!("did you mean \"{name}\"? ")).unwrap_or_default();
            let message = format!("there is no parameter '{name}'");
            let hint = format!("{meant}parameters: {}", names.join(", "));
            return Err(call.error(message).hint(hint).at(CallPart::Argument(1)));
        };
        return varied.derivative(number);
    }
    if let Some(array) = value.read_lock::<rhai::Array>() {
        let each = array.iter().map(|element| derivative(call, element, name));
        return Ok(each.collect::<Result<rhai::Array, _>>()?.into());
    }
    if value.is_float() || value.is_int() {
        return Ok(0.0.into());
    }
    match value.is::<Vec2>() {
        true => Ok(Dynamic::from(Vec2::zeros())),
        false => {
            let message = format!("{} has no derivatives", call.describe(value));
            Err(call
                .error(message)
                .hint("derivatives exist of numbers, vectors and arrays of them")
                .at(CallPart::Argument(0)))
        }
    }
}

fn plain(value: &Dynamic) -> Dynamic {
    VariantValue::project(value, 0)
}
