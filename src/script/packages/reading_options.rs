//! Checks of options and arguments of script functions, as for functions of the language.

use rhai::{Array, Dynamic, Map};

use crate::geometry::Vec2;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Kind, NumberRange};
use crate::script::bindings::parameter::{of_any_type, text};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::nouns::with_article;
use crate::script::messages::suggest::nearest;

pub const TABLE: BindingTable = BindingTable {
    name: "options of functions",
    doc: "Functions for scripts that check options and arguments in the same way as the \
        functions of withy.",
    types: &[],
    setup: "",
    constants: &[],
    rows: &[
        function(
            "read_options",
            &[
                text("owner").doc("name of the function that takes the options, for messages"),
                of_any_type("options").doc("the options, a map"),
                of_any_type("known").doc("map of the kind of each option, in words; [words, default] for optional \
                    ones"),
            ],
            read_options,
        )
        .returns(Returns::MAP)
        .summary("Checks the options of a function and adds defaults; unknown or missing options and \
            wrong kinds are refused with an error.")
        .doc(
            "Kinds are written as for read_argument. Points are returned as vectors. If the \
            default is (), () may also be given.",
        )
        .example(
            "fn mast(options) {\n    let given = read_options(\"mast\", options, #{\n        height: \"a positive number [length]\",\n        \
             spans: [\"a positive whole number\", 8],\n    });\n    \
             `${given.height} with ${given.spans} spans`\n}\ncheck(mast(#{ height: 3 }) == \"3 with 8 spans\");",
        )
        .with_related(&["read_argument"]),
        function(
            "read_argument",
            &[
                text("owner").doc("name of the function that takes the argument, for messages"),
                text("name").doc("name of the argument"),
                of_any_type("value").doc("value of the argument"),
                text("kind").doc("expected kind, in words"),
            ],
            read_argument,
        )
        .returns(Returns::ANYTHING)
        .summary("Checks an argument of a function and returns it, a point as a vector; a wrong kind \
            is refused with an error.")
        .doc(
            "Kinds are written in words: \"a number\", \"a positive number\", \"a number of \
            zero or more\", \"any number\" (including infinity and nan), \"a whole number\", \
            \"a positive whole number\", \"a whole number of zero or more\", \"a text\", \
            \"true or false\", \"a point\", \"a vector\", \"an array\", \"an array of \
            numbers\", \"an array of points\", \"a function\", \"a value\" (anything), \
            \"nothing\", or the name of a type, such as \"a section\". Several kinds are \
            joined by \"or\": \"a number or a schedule\". A unit may follow: \"a positive \
            number [length]\".",
        )
        .example(
            "fn half(size) { read_argument(\"half\", \"size\", size, \"a positive number\") / 2 }\n\
             check(half(3) == 1.5);\n\
             try { half(-1) } catch (problem) { print(problem.message); }",
        )
        .with_related(&["read_options"]),
    ],
};

/// Type descriptions in scripts; other words are type names.
const KINDS: &[(&str, Kind)] = &[
    ("a value", Kind::Any),
    ("a number", Kind::Number(NumberRange::Finite)),
    ("a positive number", Kind::Number(NumberRange::Positive)),
    ("a number of zero or more", Kind::Number(NumberRange::NonNegative)),
    ("any number", Kind::Number(NumberRange::Unlimited)),
    ("a whole number", Kind::Integer(NumberRange::Finite)),
    ("a positive whole number", Kind::Integer(NumberRange::Positive)),
    ("a whole number of zero or more", Kind::Integer(NumberRange::NonNegative)),
    ("a text", Kind::Text),
    ("true or false", Kind::Boolean),
    ("a point", Kind::Point),
    ("a vector", Kind::Point),
    ("an array", Kind::Array),
    ("an array of numbers", Kind::Numbers),
    ("an array of points", Kind::Points),
    ("a function", Kind::Function),
];

struct OptionInfo {
    name: String,
    wanted: String,
    /// Default value; `None` if the option is required.
    default: Option<Dynamic>,
}

fn read_options(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let owner = call.text("owner")?;
    let mut given = map(call, "options", &owner)?;
    let known = map(call, "known", "read_options")?;
    let known = known
        .into_iter()
        .map(|(name, description)| described(call, name.to_string(), &description));
    let known: Vec<OptionInfo> = known.collect::<Result<_, _>>()?;
    if let Some(unknown) = given.keys().find(|name| !known.iter().any(|key| key.name == **name)) {
        return Err(unknown_option(&owner, unknown, &known));
    }
    let mut options = Map::new();
    for OptionInfo { name, wanted, default } in known {
        let value = match (given.remove(name.as_str()), default) {
            (Some(value), Some(default)) if value.is_unit() && default.is_unit() => value,
            (Some(value), _) => accept(call, &owner, &name, &wanted, value)
                .map_err(|error| error.at(CallPart::Key(name.clone())))?,
            (None, Some(default)) => default,
            (None, None) => {
                let message = format!("{owner}: the option '{name}' is missing");
                return Err(ScriptError::new(message).hint(format!("add {name}: {wanted}")));
            }
        };
        options.insert(name.into(), value);
    }
    Ok(options.into())
}

fn read_argument(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let [owner, name, kind] = [call.text("owner")?, call.text("name")?, call.text("kind")?];
    accept(call, &owner, &name, &kind, call.value("value")?)
}

/// Reads a description in the form `"a number"` or `["a number", default]`.
fn described(call: &Call, name: String, description: &Dynamic) -> Result<OptionInfo, ScriptError> {
    let parts = description.read_lock::<Array>();
    let (wanted, default) = match parts.as_deref().map(Vec::as_slice) {
        Some([wanted, default]) => (wanted, Some(default.clone())),
        _ => (description, None),
    };
    let wanted = wanted.as_immutable_string_ref().map_err(|_| {
        let got = call.describe(description);
        call.error(format!("'{name}' must be given in words or as [words, default], got {got}"))
    })?;
    Ok(OptionInfo { name, wanted: wanted.to_string(), default })
}

fn unknown_option(owner: &str, unknown: &str, known: &[OptionInfo]) -> ScriptError {
    let meant = nearest(unknown, known.iter().map(|key| key.name.as_str()));
    let meant = meant.map(|name| format!("did you mean '{name}'? ")).unwrap_or_default();
    let names = known.iter().map(|key| match key.default {
        None => format!("{} (required)", key.name),
        Some(_) => key.name.clone(),
    });
    ScriptError::new(format!("{owner}: unknown option '{unknown}'"))
        .hint(format!("{meant}known options: {}", names.collect::<Vec<_>>().join(", ")))
        .at(CallPart::Key(unknown.to_owned()))
}

fn accept(
    call: &Call,
    owner: &str,
    name: &str,
    wanted: &str,
    value: Dynamic,
) -> Result<Dynamic, ScriptError> {
    let words = wanted.split(" [").next().unwrap_or(wanted);
    if let Some(kind) = kind_named(words) {
        return call.accept(owner, name, (kind, wanted), value).map(written);
    }
    let type_name = match value.is_unit() {
        true => "nothing".into(),
        false => with_article(&call.type_of(&value)),
    };
    for words in words.split(" or ") {
        if words == type_name {
            return Ok(value);
        }
        let accept = |kind| call.accept(owner, name, (kind, wanted), value.clone()).ok();
        if let Some(accepted) = kind_named(words).and_then(accept) {
            return Ok(written(accepted));
        }
    }
    let got = call.describe(&value);
    Err(ScriptError::new(format!("{owner}: '{name}' must be {wanted}, got {got}")))
}

fn kind_named(words: &str) -> Option<&'static Kind> {
    KINDS.iter().find(|(known, _)| *known == words).map(|(_, kind)| kind)
}

fn written(accepted: Dynamic) -> Dynamic {
    if let Some(numbers) = accepted.clone().try_cast::<Vec<f64>>() {
        return numbers.into_iter().map(Dynamic::from).collect::<Array>().into();
    }
    match accepted.clone().try_cast::<Vec<Vec2>>() {
        Some(points) => points.into_iter().map(Dynamic::from).collect::<Array>().into(),
        None => accepted,
    }
}

fn map(call: &Call, name: &str, owner: &str) -> Result<Map, ScriptError> {
    let value = call.value(name)?;
    value.clone().try_cast::<Map>().ok_or_else(|| {
        let message = format!("{owner}: '{name}' must be a map, got {}", call.describe(&value));
        ScriptError::new(message).hint("write #{ key: value, … }")
    })
}
