//! Drag of air or water on beams, point masses and stations.

use rhai::Dynamic;

use super::scenes::{BEAM, SCENE, STATION};
use crate::geometry::Vec2;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Kind, NumberRange};
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{Parameter, either, number, options, point, text};
use crate::script::bindings::table::{BindingTable, method};
use crate::script::handles::beam::BeamHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::station::StationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::system::{Drag, Dragged, SpeedLaw, SystemError};

pub const TABLE: BindingTable = BindingTable {
    name: "drag",
    doc: "Drag of air or water on beams, particles and stations. Its energy is part of the \
        balance: E - W + D stays constant to rounding with energy_momentum() and \
        fourth_order(), at any step size, and its impulse counts like that of a load.",
    types: &[],
    setup: super::scenes::ROD,
    constants: &[],
    rows: &[
        method(SCENE, "drag", &[either("on", DRAGGED), options("options", DRAG_KEYS)], drag)
            .summary("Adds a force against the velocity: per length of a beam, normal and tangential \
                to its axis, or on a particle or a station, independent of direction.")
            .doc(
                "The force on a beam is -normal v_n - tangent v_t per length; quadratic: #{ \
                normal: …, tangent: … } adds -k |v| v for each component. The force on a \
                particle or a station is -linear v - quadratic |v| v. With a wind, v is the \
                velocity relative to it: the energy dissipated in the medium is D, and force \
                times wind is work W. Default names: drag1, drag2, … The dissipated energy is \
                in the column dissipated.NAME. Equilibria ignore drag; modes use its linear \
                part.",
            )
            .example(
                "scene.drag(rod, #{ normal: 0.2, tangent: 0.01 });\nlet stone = scene.particle([0, 3], 0.5);\n\
                 scene.drag(stone, #{ quadratic: 0.1, wind: [2, 0], name: \"air\" });\nscene.gravity([0, -9.81]);\n\
                 let sim = scene.start(#{ dt: 0.01 });\nsim.run_to(1);\ncheck(sim.history.last(\"dissipated.drag1\") > 0);\n\
                 check(sim.history.drift(\"energy\") < 1e-12);",
            )
            .with_related(&["damper", "line_load", "particle"]),
    ],
};

const DRAGGED: &[Kind] = &[Kind::Object(BEAM), Kind::Object(STATION)];
const DRAG_KEYS: &[Parameter] = &[
    number("normal")
        .non_negative()
        .unit("force·time/length²")
        .doc("coefficient normal to the axis of a beam")
        .optional(),
    number("tangent")
        .non_negative()
        .unit("force·time/length²")
        .doc("coefficient tangential to the axis of a beam")
        .optional(),
    number("linear")
        .non_negative()
        .unit("force·time/length")
        .doc("linear coefficient for a particle or a station")
        .optional(),
    either("quadratic", &[Kind::Number(NumberRange::NonNegative), Kind::Options(QUADRATIC_KEYS)])
        .doc(
            "quadratic coefficient: for a particle or a station a number [force·time²/length²], \
            for a beam #{ normal: …, tangent: … } [force·time²/length³]",
        )
        .optional(),
    point("wind").unit("length/time").doc("velocity of the medium; default: at rest").optional(),
    text("name").optional(),
];
const QUADRATIC_KEYS: &[Parameter] = &[
    number("normal").non_negative().unit("force·time²/length³").optional(),
    number("tangent").non_negative().unit("force·time²/length³").optional(),
];

fn drag(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let options = call.options("options")?;
    let on = match call.get_if::<BeamHandle>("on") {
        Some(beam) => of_beam(call, beam.index_in(&scene)?, &options)?,
        None => of_point(call, &scene, &options)?,
    };
    let name = options.optional_text("name")?;
    let name = name.unwrap_or_else(|| scene.scene().borrow().free_name("drag"));
    let wind = if options.has("wind") { options.point("wind")? } else { Vec2::zeros() };
    let added = scene.change().add_drag(Drag { name, on, wind });
    added.map_err(|error| {
        let place = match &error {
            SystemError::Unnamed { .. } | SystemError::DuplicateName { .. } => {
                CallPart::Key("name".into())
            }
            _ => CallPart::Argument(1),
        };
        ScriptError::from(error).at(place)
    })?;
    Ok(Dynamic::UNIT)
}

fn of_beam(call: &Call, beam: usize, options: &Options) -> Result<Dragged, ScriptError> {
    let advice = "drag on a beam needs normal and tangent coefficients";
    refuse(call, options, &["linear"], advice)?;
    let ways = ["normal", "tangent", "quadratic"];
    expect_one(
        call,
        options,
        &ways,
        "give normal, tangent, or quadratic: #{ normal: …, tangent: … }",
    )?;
    if call_number(options, "quadratic").is_some() {
        let message = "quadratic is a number, but a beam needs one coefficient for each direction";
        let hint = "give quadratic: #{ normal: …, tangent: … }";
        return Err(call.error(message).hint(hint).at(CallPart::Key("quadratic".into())));
    }
    let quadratic = options.get_if::<Options>("quadratic");
    let along = |name: &str| SpeedLaw {
        linear: options.optional_number(name).unwrap_or(0.0),
        quadratic: quadratic.as_ref().and_then(|of| of.optional_number(name)).unwrap_or(0.0),
    };
    Ok(Dragged::Beam { beam, normal: along("normal"), tangent: along("tangent") })
}

fn of_point(call: &Call, scene: &SceneHandle, options: &Options) -> Result<Dragged, ScriptError> {
    let advice = "drag on a point needs coefficients without direction";
    refuse(call, options, &["normal", "tangent"], advice)?;
    expect_one(call, options, &["linear", "quadratic"], "give linear, quadratic or both")?;
    if options.get_if::<Options>("quadratic").is_some() {
        let message = "quadratic has directions, but drag on a point has none";
        let hint = "give quadratic: a number";
        return Err(call.error(message).hint(hint).at(CallPart::Key("quadratic".into())));
    }
    let station = scene.own_station(&call.get::<StationHandle>("on")?)?;
    let law = SpeedLaw {
        linear: options.optional_number("linear").unwrap_or(0.0),
        quadratic: call_number(options, "quadratic").unwrap_or(0.0),
    };
    Ok(Dragged::Point { station, law })
}

fn call_number(options: &Options, name: &str) -> Option<f64> {
    options.get_if::<f64>(name)
}

fn expect_one(
    call: &Call,
    options: &Options,
    ways: &[&str],
    hint: &str,
) -> Result<(), ScriptError> {
    if ways.iter().any(|key| options.has(key)) {
        return Ok(());
    }
    let message = "a drag coefficient is missing";
    Err(call.error(message).hint(hint).at(CallPart::Argument(1)))
}

fn refuse(call: &Call, options: &Options, odd: &[&str], advice: &str) -> Result<(), ScriptError> {
    match odd.iter().find(|key| options.has(key)) {
        Some(key) => {
            let message = format!("'{key}' has no effect here");
            Err(call.error(message).hint(advice).at(CallPart::Key((*key).into())))
        }
        None => Ok(()),
    }
}
