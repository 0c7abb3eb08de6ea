//! Gauss rules.

use rhai::{Dynamic, Map};

use super::{at_argument, numbers};
use crate::geometry::GaussRule;
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Presence, integer, number};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function};
use crate::script::messages::error::ScriptError;

pub const TABLE: BindingTable = BindingTable {
    name: "quadrature",
    doc: "Points and weights for numerical integration.",
    types: &[],
    setup: "",
    constants: &[],
    rows: &[function(
        "gauss",
        &[
            integer("count").non_negative().doc("number of points, 1 to 64"),
            number("from").doc("start of the interval").or(Presence::Number(-1.0)),
            number("to").doc("end of the interval").or(Presence::Number(1.0)),
        ],
        gauss,
    )
    .returns(Returns::MAP.with_remark(" with the arrays points and weights"))
    .summary(
        "Returns the Gauss-Legendre rule with this many points, on [-1, 1] or another interval.",
    )
    .doc("A rule with n points integrates polynomials up to degree 2 n - 1 exactly.")
    .example(
        "let rule = gauss(2, 0, 3);\nlet integral = 0;\nfor i in 0..2 {\n    \
         integral += rule.weights[i] * rule.points[i]^2;\n}\ncheck_close(integral, 9, 1e-14);",
    )
    .with_related(&["basis"])],
};

fn gauss(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let rule = at_argument(0, GaussRule::new(call.count("count")?))?;
    let (points, weights): (Vec<_>, Vec<_>) =
        rule.iter_on(call.number("from")?, call.number("to")?).unzip();
    let fields = [("points".into(), numbers(points)), ("weights".into(), numbers(weights))];
    Ok(Map::from_iter(fields).into())
}
