//! Laws of springs and dampers from options: numbers, tables or functions.

use rhai::{Dynamic, FnPtr};

use super::sliding::meant;
use crate::geometry::Vec2;
use crate::output::significant;
use crate::script::bindings::call::Call;
use crate::script::bindings::options::Options;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::as_number;
use crate::system::{DampingLaw, Origin, SpringKind, SpringLaw};

pub(super) const ACTS: [(&str, Acts); 3] =
    [("both", Acts::Both), ("pull", Acts::Pull), ("push", Acts::Push)];

#[derive(Debug, Clone, Copy, Default)]
pub(super) enum Acts {
    #[default]
    Both,
    Pull,
    Push,
}

/// Spring law, and configuration in which the elongation is zero.
pub(super) type ParsedLaw = (Option<SpringLaw>, Origin);

/// Reads a spring law from the options; `None` for a pure damper.
pub(super) fn law(
    call: &Call,
    options: &Options,
    kind: &SpringKind,
) -> Result<ParsedLaw, ScriptError> {
    let (ease, acts) = match kind {
        SpringKind::Torsion(_) | SpringKind::Brake { .. } => ("angle", Acts::Both),
        SpringKind::Length(_) => ("length", meant(&ACTS, &options.text("acts")?)),
    };
    if options.has("law") {
        return sampled(call, options, ease);
    }
    if options.has("table") {
        let odd = match acts {
            Acts::Both => ["stiffness", ease].into_iter().find(|key| options.has(key)),
            Acts::Pull | Acts::Push => Some("acts"),
        };
        if let Some(odd) = odd {
            let message =
                format!("both a table and {odd} are given, but the table determines the force");
            let hint = format!("leave out {odd}, or the table");
            return Err(call.error(message).hint(hint).at(CallPart::Key(odd.into())));
        }
        let points = options.points("table")?.iter().map(|at: &Vec2| (at.x, at.y)).collect();
        return Ok((Some(SpringLaw::Table { points }), Origin::Zero));
    }
    let Some(stiffness) = options.optional_number("stiffness") else {
        if damping(call, options)?.is_active() && !options.has(ease) {
            return Ok((None, Origin::Zero));
        }
        let hint = format!("give stiffness: a number, or table: [[{ease}, …], …]");
        return Err(call.error("the stiffness, law or table is missing").hint(hint));
    };
    let (natural, origin) = match options.optional_number(ease) {
        Some(natural) => (natural, Origin::Zero),
        None => (0.0, Origin::AsBuilt),
    };
    let side = |before: f64, after: f64| SpringLaw::Table {
        points: vec![(natural - 1.0, before), (natural, 0.0), (natural + 1.0, after)],
    };
    let law = match acts {
        Acts::Both => SpringLaw::Linear { stiffness, natural },
        Acts::Pull => side(0.0, stiffness),
        Acts::Push => side(-stiffness, 0.0),
    };
    Ok((Some(law), origin))
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
fn sampled(call: &Call, options: &Options, ease: &str) -> Result<ParsedLaw, ScriptError> {
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
    Ok(match options.optional_number(ease) {
        Some(natural) => (Some(law.shifted(natural)), Origin::Zero),
        None => (Some(law), Origin::AsBuilt),
    })
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
