//! Pictures of motion, with their options, for files and for the prompt.

use rhai::{Dynamic, Map};

use super::files::write_picture;
use super::options::{SYMBOLS, X_LIMITS, Y_LIMITS, limits, symbols};
use super::subjects::{simulations, stations};
use crate::output::{AxisLimits, MotionPicture, TerminalStyle};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Scripted;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{Parameter, array, boolean, number, text};
use crate::script::handles::simulation::SimulationHandle;
use crate::script::handles::station::StationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::packages::recording::expect_near;
use crate::script::presentation::motion::{MotionOptions, MotionView, Times};

pub const MOTION: &[Parameter] = &[
    number("every")
        .positive()
        .unit("time")
        .doc("time between snapshots; default: 1/20 of the time shown")
        .optional(),
    number("from").unit("time").doc("time of the first snapshot; default: the start").optional(),
    number("to").unit("time").doc("time of the last snapshot; default: the present").optional(),
    array("trace").doc("stations whose paths are plotted").optional(),
    number("magnify")
        .positive()
        .doc(
            "magnification factor of deformations since the start; rigid motions of bodies that \
            joints do not hold in place are not magnified",
        )
        .optional(),
    boolean("dots")
        .doc("true to mark knots or nodes; default: true for up to 40 spans in total")
        .optional(),
    SYMBOLS,
    X_LIMITS,
    Y_LIMITS,
    text("title").doc("title; default: the name of the simulation").optional(),
];

pub fn plot_motion(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let simulations = simulations(call)?;
    let options = call.options_or_defaults("options")?;
    let limits = limits(&options).map_err(|wrong| wrong.in_call(call))?;
    let picture = |of: &SimulationHandle| {
        call.proceed()?;
        let traced = options.array("trace").unwrap_or_default();
        let traced = stations(call, &traced, CallPart::Key("trace".into()))?;
        let wanted = wanted(of, &options, &traced, limits)?;
        let every = wanted.times.every;
        let expect = |time, recorded| expect_near(call, of, (time, recorded), every);
        let motion = MotionView::of(&of.simulation(), wanted, expect);
        let motion = motion.map_err(|error| match error {
            ScriptError::Failure(failure) if !failure.message.contains(": ") => {
                let error = call.error(failure.message);
                failure.hint.into_iter().fold(error, ScriptError::hint)
            }
            other => other,
        })?;
        Ok(motion.picture(title(of, &options)?))
    };
    let mut pictures = simulations.iter().map(picture).collect::<Result<Vec<_>, ScriptError>>()?;
    match pictures.len() {
        1 => write_picture(call, &pictures.remove(0)),
        _ => write_picture(call, &MotionPicture::side_by_side(pictures)),
    }
}

/// Picture as text for a terminal, with options typed at the prompt.
/// Without the options `every` and `from`, only one configuration is shown: that at the time `to`, by default the present one.
pub fn motion_text(
    engine: &rhai::Engine,
    of: &SimulationHandle,
    map: &Map,
    style: &TerminalStyle,
) -> Result<String, ScriptError> {
    let options = Options::read(engine, ":show", MOTION, map)?;
    let traced = options.array("trace").unwrap_or_default();
    let traced: Option<Vec<StationHandle>> =
        traced.iter().map(|value| value.clone().try_cast()).collect();
    let traced = traced.ok_or_else(|| {
        ScriptError::new(":show: 'trace' must be an array of stations")
            .hint("for example #{ trace: [rod.end] }")
    })?;
    let limits = limits(&options).map_err(|wrong| wrong.in_command(":show"))?;
    let mut wanted = wanted(of, &options, &traced, limits)?;
    if !options.has("every") && !options.has("from") {
        wanted.times.from = wanted.times.to.min(of.time());
    }
    let motion = MotionView::of(&of.simulation(), wanted, |_, _| Ok(()))?;
    Ok(motion.text(title(of, &options)?, style))
}

fn title(of: &SimulationHandle, options: &Options) -> Result<String, ScriptError> {
    let given = options.optional_text("title")?;
    Ok(given.unwrap_or_else(|| of.name().to_owned()))
}

fn wanted(
    of: &SimulationHandle,
    options: &Options,
    traced: &[StationHandle],
    limits: AxisLimits,
) -> Result<MotionOptions, ScriptError> {
    let given = |name: &str| options.optional_number(name);
    let (from, to) = (given("from").unwrap_or(0.0), given("to").unwrap_or(of.time()));
    let every = given("every").unwrap_or_else(|| ((to - from) / 20.0).max(f64::MIN_POSITIVE));
    let trace = |station: &StationHandle| Ok((station.show(), station.place_in(of)?));
    Ok(MotionOptions {
        times: Times { from, to, every },
        traces: traced.iter().map(trace).collect::<Result<_, ScriptError>>()?,
        magnify: given("magnify"),
        dots: options.boolean("dots").ok(),
        symbols: symbols(options),
        limits,
    })
}
