//! Laws of springs and dampers from options: numbers, tables or functions.

use rhai::{Dynamic, FnPtr};

use super::drives::place_of;
use super::schedules::{controlled_schedule_of, expect_controller, sample_clock_of};
use super::sliding::meant;
use crate::geometry::Vec2;
use crate::loads::{LimitSide, PrescribedMotion};
use crate::output::significant;
use crate::script::bindings::call::Call;
use crate::script::bindings::options::Options;
use crate::script::handles::scene::SceneHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::as_number;
use crate::system::{DampingLaw, Origin, PrescribedRest, SpringKind, SpringLaw};

pub(super) const ACTS: [(&str, Acts); 3] =
    [("both", Acts::Both), ("pull", Acts::Pull), ("push", Acts::Push)];

#[derive(Debug, Clone, Copy, Default)]
pub(super) enum Acts {
    #[default]
    Both,
    Pull,
    Push,
}

/// Options of a spring: law, configuration of zero elongation, and prescribed rest length.
pub(super) struct ParsedLaw {
    /// Force as a function of the elongation; `None` for a pure damper.
    pub(super) law: Option<SpringLaw>,
    pub(super) origin: Origin,
    /// Rest length or rest angle as a function of time.
    pub(super) rest: Option<PrescribedRest>,
}

impl From<Option<(SpringLaw, Origin)>> for ParsedLaw {
    fn from(law: Option<(SpringLaw, Origin)>) -> Self {
        let (law, origin) = law.map_or((None, Origin::Zero), |(law, at)| (Some(law), at));
        Self { law, origin, rest: None }
    }
}

/// Option keys for the rest length or rest angle of a spring, and for its rate.
#[derive(Clone, Copy)]
struct RestKeys {
    value: &'static str,
    rate: &'static str,
}

/// Reads a spring law from the options; `None` for a pure damper.
pub(super) fn law(
    call: &Call,
    options: &Options,
    kind: &SpringKind,
) -> Result<ParsedLaw, ScriptError> {
    let (keys, acts) = match kind {
        SpringKind::Torsion(_) | SpringKind::Brake { .. } => {
            (RestKeys { value: "angle", rate: "angle_rate" }, Acts::Both)
        }
        SpringKind::Length(_) => {
            let keys = RestKeys { value: "length", rate: "length_rate" };
            (keys, meant(&ACTS, &options.text("acts")?))
        }
    };
    let rest = prescribed_rest(call, options, keys)?;
    let natural = options.optional_number(keys.value);
    let law =
        unshifted_law(call, options, keys, acts)?.map(|(law, origin)| match (natural, origin) {
            _ if rest.is_some() => (law, Origin::Zero),
            (Some(natural), Origin::AsBuilt) => (law.shifted(natural), Origin::Zero),
            _ => (law, origin),
        });
    Ok(ParsedLaw { rest, ..law.into() })
}

/// Reads a spring law whose argument is the elongation from the rest length; `None` for a pure damper.
/// The argument of a table is the length itself.
fn unshifted_law(
    call: &Call,
    options: &Options,
    keys: RestKeys,
    acts: Acts,
) -> Result<Option<(SpringLaw, Origin)>, ScriptError> {
    if options.has("law") {
        return Ok(Some((sampled(call, options)?, Origin::AsBuilt)));
    }
    if options.has("table") {
        let odd = match acts {
            Acts::Both => {
                ["stiffness", keys.value, keys.rate].into_iter().find(|key| options.has(key))
            }
            Acts::Pull | Acts::Push => Some("acts"),
        };
        if let Some(odd) = odd {
            let message =
                format!("both a table and {odd} are given, but the table determines the force");
            let hint = format!("leave out {odd}, or the table");
            return Err(call.error(message).hint(hint).at(CallPart::Key(odd.into())));
        }
        let points = options.points("table")?.iter().map(|at: &Vec2| (at.x, at.y)).collect();
        return Ok(Some((SpringLaw::Table { points }, Origin::Zero)));
    }
    let Some(stiffness) = options.optional_number("stiffness") else {
        let has_rest = options.has(keys.value) || options.has(keys.rate);
        if damping(call, options)?.is_active() && !has_rest {
            return Ok(None);
        }
        let hint = format!("give stiffness: a number, or table: [[{}, …], …]", keys.value);
        return Err(call.error("the stiffness, law or table is missing").hint(hint));
    };
    let side = |before: f64, after: f64| SpringLaw::Table {
        points: vec![(-1.0, before), (0.0, 0.0), (1.0, after)],
    };
    let law = match acts {
        Acts::Both => SpringLaw::Linear { stiffness, natural: 0.0 },
        Acts::Pull => side(0.0, stiffness),
        Acts::Push => side(-stiffness, 0.0),
    };
    Ok(Some((law, Origin::AsBuilt)))
}

/// Reads the rest length or rest angle of a spring as a function of time; `None` if it is constant.
fn prescribed_rest(
    call: &Call,
    options: &Options,
    keys: RestKeys,
) -> Result<Option<PrescribedRest>, ScriptError> {
    let clock = sample_clock_of(options)?;
    let constant = options.optional_number(keys.value);
    let is_function = options.has(keys.value) && constant.is_none();
    let rest = match (is_function, options.has(keys.rate)) {
        (true, true) => {
            let message =
                format!("{} is a function of time, but {} is also given", keys.value, keys.rate);
            let hint = format!("give a number for {}, or leave out {}", keys.value, keys.rate);
            return Err(call.error(message).hint(hint).at(CallPart::Key(keys.rate.into())));
        }
        (true, false) => {
            let rate = format!("{}: |t, q| …", keys.rate);
            let schedule = place_of(call, options, keys.value, &rate)?;
            let start = Some(schedule.value(0.0, LimitSide::After)?);
            Some(PrescribedRest { start, motion: PrescribedMotion::Position(schedule) })
        }
        (false, true) => {
            let scene = call.receiver::<SceneHandle>()?;
            let rate = controlled_schedule_of(call, options, keys.rate, &scene, clock)?;
            Some(PrescribedRest { start: constant, motion: PrescribedMotion::Rate(rate) })
        }
        (false, false) => None,
    };
    expect_controller(call, clock, rest.iter().map(|rest| rest.motion.schedule()))?;
    Ok(rest)
}

pub(super) fn damping(call: &Call, options: &Options) -> Result<DampingLaw, ScriptError> {
    let Some(function) = options.get_if::<FnPtr>("damping") else {
        if options.has("rates") {
            let message = "rates are given, but damping is not a function";
            return Err(call
                .error(message)
                .hint("leave out rates")
                .at(CallPart::Key("rates".into())));
        }
        return Ok(match options.get_if::<Vec<Vec2>>("damping") {
            Some(points) => {
                let points = points.iter().map(|at| (at.x, at.y)).collect();
                DampingLaw::Curve(SpringLaw::Table { points })
            }
            None => DampingLaw::Linear(options.number("damping")?),
        });
    };
    call.expect_arguments(&function, 1, "damping: |rate| 3 * rate * abs(rate)")?;
    if !options.has("rates") {
        let message = "the range of rates for the damping function is missing";
        let hint = "give rates: [-10, 10], from the fastest approach to the fastest separation";
        return Err(call.error(message).hint(hint).at(CallPart::Key("damping".into())));
    }
    let rates = options.point("rates")?;
    if !(rates.x < 0.0 && rates.y > 0.0) {
        let message = format!("the rates [{}, {}] do not contain 0 between them", rates.x, rates.y);
        let hint = "give a negative and a positive rate: [-10, 10]";
        return Err(call.error(message).hint(hint).at(CallPart::Key("rates".into())));
    }
    let force = force_of(call, &function, ("damping", "rate"));
    let law = DampingLaw::sampled((rates.x, rates.y), force)?;
    if let DampingLaw::Curve(curve) = &law {
        let hint = "replace a jump by a short ramp, for example tanh(rate / 0.01) for dry friction";
        expect_smooth(call, curve, ("damping", hint))?;
    }
    Ok(law)
}

/// Law from a function, which is sampled over a range of elongations now and not called later.
fn sampled(call: &Call, options: &Options) -> Result<SpringLaw, ScriptError> {
    let function = options.callback("law")?;
    call.expect_arguments(&function, 1, "law: |e| 100 * e, where e is the elongation")?;
    let odd = options.present_names().find(|key| ["stiffness", "table"].contains(key));
    if let Some(odd) = odd {
        let message = format!("both a law and {odd} are given, but the law determines the force");
        let hint = format!("leave out {odd}, or the law");
        return Err(call.error(message).hint(hint).at(CallPart::Key(odd.into())));
    }
    if !options.has("range") {
        let message = "the range of elongations for the law is missing";
        let hint = "give range: [-0.1, 0.1], from the shortest to the longest";
        return Err(call.error(message).hint(hint).at(CallPart::Key("law".into())));
    }
    let range = options.point("range")?;
    if range.x >= range.y {
        let message = format!("the range [{}, {}] is not ascending", range.x, range.y);
        let hint = "give the smaller elongation first";
        return Err(call.error(message).hint(hint).at(CallPart::Key("range".into())));
    }
    let force = force_of(call, &function, ("law", "elongation"));
    let law = SpringLaw::sampled((range.x, range.y), force)?;
    expect_smooth(call, &law, ("law", "replace a jump by a short ramp"))?;
    Ok(law)
}

fn force_of<'a>(
    call: &'a Call,
    function: &'a FnPtr,
    (key, over): (&'static str, &'static str),
) -> impl FnMut(f64) -> Result<f64, ScriptError> + 'a {
    move |at| {
        let value = call.invoke(function, [Dynamic::from(at)])?;
        as_number(&value).filter(|force| force.is_finite()).ok_or_else(|| {
            let message = format!("the {key} does not return a finite number at the {over} {at}");
            call.error(message).at(CallPart::Key(key.into()))
        })
    }
}

fn expect_smooth(
    call: &Call,
    polygon: &SpringLaw,
    (key, hint): (&'static str, &'static str),
) -> Result<(), ScriptError> {
    let Some((error, largest)) = polygon.sampling_error() else { return Ok(()) };
    let [error, largest] = [error, largest].map(|force| significant(force, 3));
    let message = format!(
        "the {key} has a jump or varies too fast: the finest polygon has an error of {error} at \
        a largest force of {largest}"
    );
    Err(call.error(message).hint(hint).at(CallPart::Key(key.into())))
}
