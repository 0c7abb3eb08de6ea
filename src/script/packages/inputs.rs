//! Inputs of a script, whose values can be given from outside.

use rhai::{Array, Dynamic};

use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Kind;
use crate::script::bindings::option_set::option_set;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{Parameter, array, either, number, of_any_type, text};
use crate::script::bindings::parameter_variants::VariantValue;
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::state::inputs::{InputDeclaration, InputValue, NAMES, is_input_name};

pub const TABLE: BindingTable = BindingTable {
    name: "inputs",
    doc: "Inputs of a script: withy run FILE --set NAME=VALUE gives them other values than their \
        defaults, withy check FILE lists them, and studies can vary them.",
    types: &[],
    setup: "",
    constants: &[],
    rows: &[function("input", &[NAME, DEFAULT, UNIT], input)
        .returns(Returns::ANYTHING.with_description("the given value, or the default"))
        .summary("Declares an input of the script and returns its value: the one given by \
            `--set NAME=VALUE`, or the default.")
        .doc(
            "The default fixes the type: a number, a whole number, a boolean, a text or an array \
            of numbers (`--set spans=1,2.5`). An input with a unit is a number, even if its \
            default is whole. A value that is set has no unit. In a run of `study_sweep`, `fit` \
            and other studies, an input with the name of a parameter has the value of that \
            parameter, so that a function of the script can be studied as it is. Repeated calls \
            for a name must be equal. At the prompt `:load FILE --set NAME=VALUE` sets inputs.",
        )
        .example(
            "let load = input(\"load\", 100, \"N\");\n\
             let shape = input(\"shape\", \"ring\", #{ choices: [\"ring\", \"line\"], about: \"axis of the rod\" });\n\
             let spans = input(\"spans\", 8, #{ min: 2, max: 100 });\n\
             check(load == 100 && shape == \"ring\" && spans == 8);",
        )
        .with_related(&["study_sweep", "fit"])],
};

const NAME: Parameter = text("name").doc("name, as in --set NAME=VALUE");
const DEFAULT: Parameter = of_any_type("default").doc("value without --set; it fixes the type");
const UNIT: Parameter = either("unit", &[Kind::Text, Kind::Options(InputFunctionOptions::KEYS)])
    .doc("unit, such as \"N\", or a map of options")
    .optional();

option_set! {
    struct InputFunctionOptions {
        unit: Option<String> = text("unit").doc("unit of the value, for messages and lists").optional(),
        min: Option<f64> = number("min").doc("smallest allowed number").optional(),
        max: Option<f64> = number("max").doc("largest allowed number").optional(),
        choices: Option<Array> = array("choices").doc("allowed values, of the type of the default").optional(),
        about: Option<String> = text("about").doc("description for withy check").optional(),
    }
}

fn input(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let declaration = declaration(call)?;
    let varied = call.context().varied(&declaration.name);
    let value = call.context().inputs().declare(declaration.clone())?;
    let Some(varied) = varied else { return Ok(value.to_dynamic()) };
    // In a fit, the value may depend on parameters and contain derivatives. It is checked without derivatives, and returned with them.
    let plain = VariantValue::project(&varied, 0);
    match declaration.default.convert(&plain).filter(|value| declaration.allows(value)) {
        Some(_) if varied.is::<VariantValue>() => Ok(varied),
        Some(value) => Ok(value.to_dynamic()),
        None => {
            let (name, got) = (&declaration.name, call.describe(&plain));
            let message =
                format!("the input '{name}' must be {}, got {got}", declaration.expectation());
            Err(ScriptError::new(message)
                .hint(format!("change the values of '{name}' in the parameters of the study")))
        }
    }
}

fn declaration(call: &Call) -> Result<InputDeclaration, ScriptError> {
    let name = call.text("name")?.to_string();
    if !is_input_name(&name) {
        let message = format!("\"{name}\" is not allowed as the name of an input");
        return Err(call.error(message).hint(NAMES).at(CallPart::Argument(0)));
    }
    let given = call.value("default")?;
    let Some(default) = InputValue::of(&given) else {
        let message = format!("the default of '{name}' is {}", call.describe(&given));
        let hint = "give a finite number, true or false, a text or an array of finite numbers";
        return Err(call.error(message).hint(hint).at(CallPart::Argument(1)));
    };
    let options = match call.get_if::<Options>("unit") {
        Some(options) => InputFunctionOptions::of(&options)?,
        None => InputFunctionOptions {
            unit: call.optional_text("unit")?,
            ..InputFunctionOptions::of(&Options::defaults(InputFunctionOptions::KEYS))?
        },
    };
    let unit = options.unit.unwrap_or_default();
    let default = match default {
        InputValue::Integer(whole) if !unit.is_empty() => InputValue::Number(whole as f64),
        default => default,
    };
    let choices = options.choices.unwrap_or_default();
    let choices = choices.iter().map(|choice| {
        default.convert(choice).ok_or_else(|| {
            let message = format!(
                "a choice is {}, and the default is {}",
                call.describe(choice),
                default.type_words()
            );
            at_option(call, "choices", message, "give values of the type of the default")
        })
    });
    let choices = choices.collect::<Result<_, _>>()?;
    let about = options.about.unwrap_or_default();
    let (min, max) = (options.min, options.max);
    let declaration = InputDeclaration { name, default, unit, min, max, choices, about };
    expect_consistent(call, &declaration)?;
    Ok(declaration)
}

fn expect_consistent(call: &Call, declaration: &InputDeclaration) -> Result<(), ScriptError> {
    let InputDeclaration { name, default, min, max, .. } = declaration;
    let limit = match (min, max) {
        (Some(_), _) => Some("min"),
        (None, Some(_)) => Some("max"),
        (None, None) => None,
    };
    if let (Some(limit), InputValue::Boolean(_) | InputValue::Text(_)) = (limit, default) {
        let message = format!("'{name}' is {}, which has no range", default.type_words());
        return Err(at_option(call, limit, message, "omit min and max, or give choices"));
    }
    if declaration.allows(default) {
        return Ok(());
    }
    let message = format!(
        "the default of '{name}' is {default}, but {} is required",
        declaration.expectation()
    );
    Err(call
        .error(message)
        .hint("change the default, the range or the choices")
        .at(CallPart::Argument(1)))
}

fn at_option(call: &Call, key: &str, message: String, hint: &str) -> ScriptError {
    call.error(message).hint(hint).at(CallPart::Key(key.to_owned()))
}
