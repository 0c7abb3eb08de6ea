//! Schedules of loads.

use std::rc::Rc;

use rhai::{Dynamic, FnPtr};

use crate::loads::{LimitSide, Operation, SampleClock, Schedule};
use crate::script::bindings::arguments::Arguments;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Kind, NumberRange, Scripted, Type};
use crate::script::bindings::parameter::{
    Parameter, Presence, array, callback, number, numbers, object,
};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function, method, operator};
use crate::script::handles::function_of_time::FunctionOfTime;
use crate::script::handles::scene::SceneHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::as_number;
use crate::script::presentation::details;

pub const TABLE: BindingTable = BindingTable {
    name: "schedules",
    doc: "A schedule is a function of time that multiplies a load. Steps end where a schedule \
        jumps or has a kink.",
    types: &[SCHEDULE],
    setup: "",
    constants: &[],
    rows: &[
        function("constant", &[number("factor").or(Presence::Number(1.0))], |call| {
            schedule(Schedule::constant(call.number("factor")?)?)
        })
        .returns(Returns::object(SCHEDULE))
        .summary("Creates a schedule with the same factor at all times; constant(1) is the default \
            of loads.")
        .example("check(constant(2).at(5) == 2);")
        .with_related(&["hold_for"]),
        function("hold_for", &[TIME], |call| schedule(Schedule::hold_for(call.number("time")?)?))
            .returns(Returns::object(SCHEDULE))
            .summary("Creates a schedule that is 1 up to a time, then 0; a step ends there.")
            .example("let torque = hold_for(2.5);\ncheck(torque.at(2.4) == 1 && torque.at(2.5) == 0);")
            .with_related(&["pulse", "ramp"]),
        function("ramp", &[FROM, TO], |call| {
            schedule(Schedule::ramp(call.number("from")?, call.number("to")?)?)
        })
        .returns(Returns::object(SCHEDULE))
        .summary("Creates a schedule that is 0 before the first time, 1 after the second, and linear \
            between.")
        .example("check(ramp(0, 4).at(1) == 0.25);")
        .with_related(&["table"]),
        function("pulse", &[FROM, TO], |call| {
            schedule(Schedule::pulse(call.number("from")?, call.number("to")?)?)
        })
        .returns(Returns::object(SCHEDULE))
        .summary("Creates a schedule that is 1 between two times, else 0.")
        .example("check(pulse(1, 2).at(1.5) == 1);")
        .with_related(&["smooth_pulse", "hold_for"]),
        function("smooth_pulse", &[number("duration").positive().unit("time")], |call| {
            schedule(Schedule::smooth_pulse(call.number("duration")?)?)
        })
        .returns(Returns::object(SCHEDULE))
        .summary("Creates a schedule 16/5 sin(PI t / duration)^6 up to the duration, then 0: unit \
            mean, five continuous derivatives.")
        .example("check_close(smooth_pulse(2).at(1), 3.2, 1e-15);")
        .with_related(&["pulse"]),
        function("sine", &[number("amplitude"), number("rate").unit("rad/time"), PHASE], |call| {
            schedule(Schedule::sine(call.number("amplitude")?, call.number("rate")?, call.number("phase")?)?)
        })
        .returns(Returns::object(SCHEDULE))
        .summary("Creates a schedule amplitude sin(rate t + phase).")
        .example("check_close(sine(2, PI, 0).at(0.5), 2, 1e-15);"),
        function("table", &[array("rows").doc("[time, factor] pairs; the same time twice is a jump")], table)
            .returns(Returns::object(SCHEDULE))
            .summary("Creates a piecewise linear schedule through [time, factor] points, constant \
                before the first and after the last.")
            .example("let load = table([[0, 0], [1, 1], [1, 0.5], [3, 0]]);\ncheck(load.at(2) == 0.25);")
            .with_related(&["ramp"]),
        function("schedule", &[callback("function"), BREAKS], closure)
            .returns(Returns::object(SCHEDULE))
            .summary("Creates a schedule from a function of time, with optional times of its jumps \
                and kinks.")
            .doc("The function is called five times per step or substep (seven times with \
                trapezoidal() and generalized_alpha()), never inside the Newton iteration. A \
                note tells when it changes faster than these calls can see: declare jumps and \
                kinks, use a smaller dt, or a built-in schedule. Built-in schedules, their sums \
                and their products are integrated exactly over a step, so that their impulse \
                does not depend on dt.")
            .example("let load = schedule(|t| exp(-t) * sin(3 * t));\ncheck(load.at(0) == 0);"),
        method(SCHEDULE, "at", &[number("t").unit("time")], |call| {
            Ok(call.receiver::<Schedule>()?.value(call.number("t")?, LimitSide::After)?.into())
        })
        .returns(Returns::NUMBER)
        .summary("Returns the factor at a time; at a jump the value just after it.")
        .example("check(hold_for(1).at(0.5) == 1);"),
        operator("+", &[object("a", SCHEDULE), object("b", SCHEDULE)], |call| {
            schedule(Schedule::combined(Operation::Sum, call.get("a")?, call.get("b")?)?)
        })
        .returns(Returns::object(SCHEDULE))
        .summary("Adds schedules.")
        .example("let both = hold_for(1) + pulse(2, 3);\ncheck(both.at(2.5) == 1);"),
        operator("*", &[object("a", SCHEDULE), object("b", SCHEDULE)], |call| {
            schedule(Schedule::combined(Operation::Product, call.get("a")?, call.get("b")?)?)
        })
        .returns(Returns::object(SCHEDULE))
        .summary("Multiplies schedules.")
        .example("let half = hold_for(2) * ramp(0, 2);\ncheck(half.at(1) == 0.5);"),
        operator("*", &[number("a"), object("b", SCHEDULE)], |call| {
            schedule(scaled(call, call.number("a")?, "b")?)
        })
            .returns(Returns::object(SCHEDULE))
            .summary("Multiplies a schedule by a number.")
            .example("check((3 * hold_for(1)).at(0) == 3);"),
        operator("*", &[object("a", SCHEDULE), number("b")], |call| {
            schedule(scaled(call, call.number("b")?, "a")?)
        })
            .returns(Returns::object(SCHEDULE))
            .summary("Multiplies a schedule by a number.")
            .example("check((hold_for(1) * 3).at(0) == 3);"),
        operator("/", &[object("a", SCHEDULE), number("b")], |call| {
            schedule(scaled(call, 1.0 / call.number("b")?, "a")?)
        })
        .returns(Returns::object(SCHEDULE))
        .summary("Divides a schedule by a number.")
        .example("check((hold_for(1) / 2).at(0) == 0.5);"),
        operator("-", &[object("a", SCHEDULE), object("b", SCHEDULE)], |call| {
            let opposite = scaled(call, -1.0, "b")?;
            schedule(Schedule::combined(Operation::Sum, call.get("a")?, opposite)?)
        })
        .returns(Returns::object(SCHEDULE))
        .summary("Subtracts schedules.")
        .example("let later = hold_for(2) - hold_for(1);\ncheck(later.at(0.5) == 0 && later.at(1.5) == 1);"),
        operator("-", &[object("a", SCHEDULE)], |call| schedule(scaled(call, -1.0, "a")?))
            .returns(Returns::object(SCHEDULE))
            .summary("Negates a schedule.")
            .example("check((-hold_for(1)).at(0) == -1);"),
    ],
};

pub const SCHEDULE: Type = Type::of::<Schedule>();
/// Accepted types of a schedule argument: a schedule, a constant number, or a function of time.
pub const SCHEDULE_KINDS: &[Kind] =
    &[Kind::Object(SCHEDULE), Kind::Number(NumberRange::Finite), Kind::Function];

pub(super) const SAMPLE: Parameter = number("sample").positive().unit("time").doc(
    "sampling period of the controller |t, q| …, which is called at 0, sample, 2 sample, … with \
    its value held in between; steps end there; default: every step",
).optional();
pub(super) const DELAY: Parameter = number("delay")
    .non_negative()
    .unit("time")
    .doc(
        "dead time of the controller: a value acts this much later; before the first value nothing \
    acts",
    )
    .requires_key("sample")
    .optional();

const TIME: Parameter = number("time").positive().unit("time");
const FROM: Parameter = number("from").unit("time");
const TO: Parameter = number("to").unit("time");
const PHASE: Parameter = number("phase").unit("rad").or(Presence::Number(0.0));
const BREAKS: Parameter = numbers("breaks").unit("time").optional();

impl Scripted for Schedule {
    const NAME: &'static str = "schedule";
    const DOC: &'static str = "A function of time that multiplies a load.";

    fn show(&self) -> String {
        self.describe()
    }

    fn details(&self) -> Details {
        details::of_schedule(self)
    }
}

fn schedule(schedule: Schedule) -> Result<Dynamic, ScriptError> {
    Ok(Dynamic::from(schedule))
}

fn scaled(call: &Call, factor: f64, of: &str) -> Result<Schedule, ScriptError> {
    let factor = Schedule::constant(factor)?;
    Ok(Schedule::combined(Operation::Product, factor, call.get(of)?)?)
}

fn table(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let pair = |(row, value): (usize, Dynamic)| {
        let pair = value.read_lock::<rhai::Array>().and_then(|pair| match pair.as_slice() {
            [t, factor] => as_number(t).zip(as_number(factor)),
            _ => None,
        });
        pair.ok_or_else(|| {
            let parts = value.read_lock::<rhai::Array>();
            let wrong = parts.as_ref().filter(|pair| pair.len() == 2).and_then(|pair| {
                let names = ["time", "factor"].into_iter().zip(pair.iter());
                let mut wrong = names.filter(|(_, part)| as_number(part).is_none());
                wrong.next().map(|(name, part)| format!("its {name} is {}", call.describe(part)))
            });
            let wrong = wrong.unwrap_or_else(|| format!("got {}", call.describe(&value)));
            call.error(format!("row {row} must be [time, factor], {wrong}"))
        })
    };
    let rows = call.array("rows")?.into_iter().enumerate().map(pair).collect::<Result<_, _>>()?;
    schedule(Schedule::table(rows)?)
}

fn closure(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let breaks = if call.has("breaks") { call.numbers("breaks")? } else { Vec::new() };
    schedule(stored(call, call.callback("function")?, breaks)?)
}

fn stored(call: &Call, function: FnPtr, breaks: Vec<f64>) -> Result<Schedule, ScriptError> {
    call.expect_arguments(&function, 1, "|t| …, a function of time")?;
    let stored = call.store(function, "the function of a schedule");
    let function = Rc::new(FunctionOfTime::new(stored));
    Ok(Schedule::Function { function, breaks })
}

pub(super) fn schedule_of(
    call: &Call,
    arguments: &Arguments,
    name: &str,
) -> Result<Schedule, ScriptError> {
    if let Some(schedule) = arguments.get_if::<Schedule>(name) {
        return Ok(schedule);
    }
    match (arguments.get_if::<FnPtr>(name), arguments.optional_number(name)) {
        (Some(function), _) => stored(call, function, Vec::new()),
        (None, factor) => Ok(Schedule::constant(factor.unwrap_or(1.0))?),
    }
}

/// Schedule of a load or drive from an argument as for [`schedule_of`], or from a controller (a function of time and simulation).
pub(super) fn controlled_schedule_of(
    call: &Call,
    arguments: &Arguments,
    name: &str,
    scene: &SceneHandle,
    beat: Option<SampleClock>,
) -> Result<Schedule, ScriptError> {
    let Some(function) = arguments.get_if::<FnPtr>(name) else {
        return schedule_of(call, arguments, name);
    };
    if call.arguments_of(&function) != Some(2) {
        let shapes = "|t| …, a function of time, or |t, q| …, a controller";
        call.expect_arguments(&function, 1, shapes)?;
        return schedule_of(call, arguments, name);
    }
    let function = call.store(function, "the function of a controller");
    let value = scene.store_controller(function, beat);
    Ok(match beat {
        Some(beat) => Schedule::DigitalController { value, clock: beat },
        None => Schedule::Sampled(value),
    })
}

pub(super) fn sample_clock_of(options: &Arguments) -> Result<Option<SampleClock>, ScriptError> {
    let delay = options.optional_number("delay").unwrap_or(0.0);
    let beat = options.optional_number("sample").map(|period| SampleClock::new(period, delay));
    Ok(beat.transpose()?)
}

pub(super) fn expect_controller<'a>(
    call: &Call,
    beat: Option<SampleClock>,
    mut schedules: impl Iterator<Item = &'a Schedule>,
) -> Result<(), ScriptError> {
    if beat.is_none() || schedules.any(Schedule::is_sampled) {
        return Ok(());
    }
    let message = "the option sample is given without a controller";
    let hint = "give a function of time and simulation, |t, q| …, or leave out sample";
    Err(call.error(message).hint(hint).at(CallPart::Key("sample".into())))
}
