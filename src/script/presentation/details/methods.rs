//! Summaries of integrators, step control, sliding rules, schedules and errors.

use super::entries::{line, number, numbers};
use crate::integrators::{EnergyClaim, Method};
use crate::joints::SlidingRule;
use crate::loads::{LimitSide, Schedule};
use crate::script::bindings::kind::Details;
use crate::script::messages::error::{CallPart, Failure};
use crate::simulation::StepControl;

pub fn of_integrator(method: &Method) -> Details {
    let entry = method.entry();
    let claims = entry.claims;
    let summary = line("does", entry.summary);
    let order = line("order", claims.order.to_string());
    let kept = claims.conserved_quantities().collect::<Vec<_>>().join(", ");
    let keeps = Some(kept).filter(|kept| !kept.is_empty());
    let damps =
        (claims.energy == EnergyClaim::NonIncreasing).then(|| line("energy", "never grows"));
    let parameter = entry.parameter.zip(method.parameter()).map(|(of, value)| {
        line(of.name, format!("{} ({}): {}", number(value), of.range(), of.meaning))
    });
    let optional = [keeps.map(|kept| line("keeps", kept)), damps, parameter];
    [summary, order]
        .into_iter()
        .chain(optional.into_iter().flatten())
        .chain(std::iter::once(line("source", entry.source)))
        .collect()
}

pub fn of_step_control(control: &StepControl) -> Details {
    let bound = |value: Option<f64>, otherwise: &str| value.map_or(otherwise.to_owned(), number);
    vec![
        line("tolerance", number(control.tolerance)),
        line("first step", bound(control.first, "from the scene")),
        line("smallest", bound(control.smallest, "a millionth of the first")),
        line("largest", bound(control.largest, "a million times the first")),
        line("estimate", "two steps against one; both are kept, the one is not"),
        line("controller", "PI; Gustafsson, ACM Trans. Math. Softw. 17 (1991) 533-554"),
    ]
}

pub fn of_rule(rule: &SlidingRule) -> Details {
    let entry = rule.entry();
    let kept = [
        (entry.claims.energy, "energy"),
        (true, "linear momentum"),
        (entry.claims.angular_momentum, "angular momentum"),
        (entry.claims.gap, "the gap"),
    ];
    vec![line("keeps", kept_of(kept)), line("source", entry.source)]
}

fn kept_of<const N: usize>(claims: [(bool, &str); N]) -> String {
    let kept: Vec<&str> =
        claims.into_iter().filter(|(keeps, _)| *keeps).map(|(_, what)| what).collect();
    kept.join(", ")
}

/// Summary of a schedule by its values and the times of its jumps and bends; script functions are not called.
pub fn of_schedule(schedule: &Schedule) -> Details {
    let mut breaks = schedule.breaks();
    breaks.sort_by(f64::total_cmp);
    breaks.dedup();
    let value = |time: f64| match schedule.functions() {
        0 => schedule.value(time, LimitSide::After).ok().map(number),
        _ => None,
    };
    let at = |label: &str, time| value(time).map(|value| line(label, value));
    let last = breaks.last().copied();
    let bends =
        (!breaks.is_empty()).then(|| line("steps end at", format!("t = {}", numbers(&breaks))));
    let lines = [at("at t = 0", 0.0), bends, last.and_then(|time| at("after the last", time))];
    lines.into_iter().flatten().collect()
}

pub fn of_failure(failure: &Failure) -> Details {
    let place = match &failure.place {
        CallPart::Call => None,
        CallPart::Argument(number) | CallPart::ArgumentOfMethod(number) => {
            Some(line("about", format!("argument {}", number + 1)))
        }
        CallPart::Key(key) => Some(line("about", format!("option {key}"))),
    };
    place.into_iter().chain(failure.hint.as_ref().map(|hint| line("help", hint))).collect()
}
