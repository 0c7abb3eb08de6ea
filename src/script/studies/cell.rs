//! Result that the script function of a stability map returns for one cell, that is, for one combination of parameter values.

use rhai::{Dynamic, EvalAltResult, Map};

use super::options::StabilityOptions;
use super::parameters::label;
use crate::analysis::Case;
use crate::integrators::Method;
use crate::newton::Tolerance;
use crate::script::bindings::call::Call;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::step_size::{STEP_SIZE, step_size};
use crate::script::messages::error::{CallPart, Failure, ScriptError};
use crate::script::messages::numbers::as_number;
use crate::script::messages::suggest::nearest;
use crate::simulation::SimulationSettings;

const KEYS: [&str; 4] = ["scene", "dt", "end", "integrator"];

/// Message of a thrown value or a native error; `None` for other errors.
pub fn thrown(call: &Call, error: &EvalAltResult) -> Option<String> {
    match error {
        EvalAltResult::ErrorInFunctionCall(_, _, inner, _) => thrown(call, inner),
        EvalAltResult::ErrorRuntime(value, _) => Some(match value.read_lock::<Failure>() {
            Some(failure) => failure.message.clone(),
            None => value.clone().into_string().unwrap_or_else(|_| call.show(value)),
        }),
        _ => None,
    }
}

/// Creates a case from a scene, or from a map with a scene and settings.
/// Missing settings are those of the cell or, if it lacks them, of the options of the study.
pub fn case(
    call: &Call,
    options: &StabilityOptions,
    values: &Map,
    given: Dynamic,
) -> Result<Case, ScriptError> {
    let own = given.read_lock::<Map>().map(|map| map.clone()).unwrap_or_default();
    expect_known_keys(call, &own)?;
    let scene = own.get("scene").cloned().unwrap_or_else(|| given.clone());
    let find = |name: &str| own.get(name).or_else(|| values.get(name)).cloned();
    let scene = scene.try_cast::<SceneHandle>().ok_or_else(|| {
        let got = call.describe(&given);
        call.error(format!("the function returns {got} instead of a scene"))
            .hint(
                "its last expression must be the scene, or a map: #{ scene: scene, dt: 0.1, \
                end: 5 }",
            )
            .at(CallPart::Key("scene".into()))
    })?;
    scene.expect_no_callbacks()?;
    let missing = |name: &str| {
        call.error(format!("the setting '{name}' is missing")).hint(format!(
            "give it as an option of the study, among its values, or in the result of the \
            function: #{{ scene: scene, {name}: 0.1 }}"
        ))
    };
    let wrong = |name: &str, value: &Dynamic, hint: &str| {
        call.error(format!("the '{name}' of a cell is {}", call.describe(value))).hint(hint)
    };
    expect_no_other_value(call, &own, values)?;
    let method = match find("integrator") {
        Some(value) => value
            .clone()
            .try_cast::<Method>()
            .ok_or_else(|| wrong("integrator", &value, "for example trapezoidal()"))?,
        None => options.integrator.unwrap_or_default(),
    };
    let dt = match find("dt") {
        Some(value) => step_size(&value).ok_or_else(|| wrong("dt", &value, STEP_SIZE))?,
        None => options.dt.ok_or_else(|| missing("dt"))?.into(),
    };
    let end = match find("end") {
        Some(value) => as_number(&value)
            .filter(|end| end.is_finite() && *end > 0.0)
            .ok_or_else(|| wrong("end", &value, "give a positive number"))?,
        None => options.end.ok_or_else(|| missing("end"))?,
    };
    let settings = SimulationSettings { method, dt, tolerance: Tolerance::default() };
    let stops = vec![end];
    let scene = scene.scene().borrow().clone();
    Ok(Case { scene, settings, stops })
}

fn expect_no_other_value(call: &Call, own: &Map, values: &Map) -> Result<(), ScriptError> {
    let pair = |name| own.get(name).zip(values.get(name));
    fn differ<T: PartialEq>(
        read: impl Fn(&Dynamic) -> Option<T>,
        of: (&Dynamic, &Dynamic),
    ) -> bool {
        read(of.0).zip(read(of.1)).is_some_and(|(own, labelled)| own != labelled)
    }
    let method = |value: &Dynamic| value.clone().try_cast::<Method>();
    let other = [
        pair("dt").filter(|of| differ(step_size, *of)).map(|of| ("dt", of)),
        pair("end").filter(|of| differ(as_number, *of)).map(|of| ("end", of)),
        pair("integrator").filter(|of| differ(method, *of)).map(|of| ("integrator", of)),
    ];
    let Some((name, (own, labelled))) = other.into_iter().flatten().next() else { return Ok(()) };
    let (own, labelled) = (label(call, own), label(call, labelled));
    let message =
        format!("the function returns {name}: {own} for the cell with the value {name} {labelled}");
    let hint = format!("omit '{name}' in its result, or give the values of the cells another name");
    Err(call.error(message).hint(hint).at(CallPart::Key("scene".into())))
}

fn expect_known_keys(call: &Call, given: &Map) -> Result<(), ScriptError> {
    let Some(unknown) = given.keys().find(|key| !KEYS.contains(&key.as_str())) else {
        return Ok(());
    };
    let meant = nearest(unknown, KEYS);
    let suggestion = meant.map(|name| format!("did you mean '{name}'? ")).unwrap_or_default();
    Err(call
        .error(format!("the function returns a map with the unknown key '{unknown}'"))
        .hint(format!("{suggestion}known keys: {}", KEYS.join(", ")))
        .at(CallPart::Key("scene".into())))
}
